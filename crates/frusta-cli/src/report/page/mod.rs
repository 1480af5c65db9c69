//! `report.html` and the panels: one page that needs nothing else, not even its script.
//!
//! ```text
//! words    numbers as the page says them      totals   sums over families
//! axes     logarithmic axes                   marks    shapes and colours
//! panel    a family's panel, the overview     worst    which cases are drawn
//! everyday times on everyday segments         peers    other libraries
//! volumes  boxes, balls and batches
//! tables   most tables                        style    the style sheet, the script
//! text     what stands between them
//! ```

mod axes;
mod everyday;
mod marks;
mod panel;
mod peers;
mod style;
mod tables;
mod text;
mod totals;
mod volumes;
mod words;
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

/// Whether there is something to show of a file of other libraries' results.
pub(crate) fn shows(peers: &Value) -> bool {
    peers::rows(peers).is_some()
}
