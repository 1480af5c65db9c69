//! `report.html` and the panels: one page that needs nothing else, not even its script.
//!
//! ```text
//! words    numbers as the page says them      totals   sums over families
//! axes     logarithmic axes                   marks    shapes and colours
//! panel    a family's panel, the overview     worst    which cases are drawn
//! tables   all tables                         style    the style sheet, the script
//! text     what stands between them
//! ```

mod axes;
mod marks;
mod panel;
mod style;
mod tables;
mod text;
mod totals;
mod words;
mod worst;

#[cfg(test)]
mod tests;

use super::Page;
use crate::failure::Failure;
use crate::whole_file::WholeFile;
use std::path::Path;

/// Writes `report.html` and `panels/<family>.svg`; none of them has its name before all
/// are whole.
pub(crate) fn write(dir: &Path, page: &Page<'_>) -> Result<(), Failure> {
    let panels = dir.join("panels");
    std::fs::create_dir_all(&panels).map_err(|e| {
        let why = format!("cannot be made a folder: {}", e.kind());
        Failure::in_file(&panels, why)
    })?;
    let mut files = Vec::new();
    let mut add = |path: &Path, content: &str| {
        let mut file = WholeFile::create(path)?;
        file.write(content.as_bytes())?;
        files.push(file);
        Ok::<(), Failure>(())
    };
    for rows in panel::by_family(&page.survey.rows) {
        if let Some(first) = rows.first() {
            let name = format!("{}.svg", first.family);
            add(&panels.join(name), &panel::file(&rows))?;
        }
    }
    add(&dir.join("report.html"), &text::page(page)?)?;
    files.into_iter().try_for_each(WholeFile::finish)
}
