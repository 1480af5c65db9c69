//! `report.html` and the panels: one page that needs no other file, and not even its script.
//!
//! ```text
//! text      the page from top to bottom        style     the style sheet, the script
//! chart     error against run time, the first  overview  thumbnails of all panels
//! panel     a family's panel                   drawing   the elements of all three
//! axes      logarithmic axes                   marks     shapes and colours
//! words     numbers as text                    totals    sums over families
//! tables    most tables                        worst     the cases that are drawn
//! everyday  times on everyday segments         volumes   boxes, spheres and batches
//! peers     other libraries
//! ```

mod axes;
mod chart;
mod drawing;
mod everyday;
mod marks;
mod overview;
mod panel;
mod peers;
mod style;
mod tables;
mod text;
mod totals;
mod volumes;
pub(super) mod words;
mod worst;

#[cfg(test)]
mod tests;

use super::Page;
use crate::failure::Failure;
use frusta::samples::Family;
use frusta_lab::SurveyRow;
use serde_json::Value;

/// `report.html`.
pub(crate) fn html(page: &Page<'_>) -> Result<String, Failure> {
    text::page(page)
}

/// A family's panel, as a file of its own.
pub(crate) fn panel(page: &Page<'_>, family: Family) -> String {
    let rows = page.measured.survey.rows.iter();
    let rows: Vec<&SurveyRow> = rows.filter(|row| row.family == family).collect();
    panel::file(&rows)
}

/// Whether a file of other libraries' results has anything that can be shown.
pub(crate) fn shows(peers: &Value) -> bool {
    peers::rows(peers).is_some()
}
