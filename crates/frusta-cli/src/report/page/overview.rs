//! All families at a glance: thumbnails of the panels, on axes that all of them share.

use super::axes::Decades;
use super::drawing::{Anchor, Drawing};
use super::panel::{FAST, LEAST_SHARE, by_family, wrong_share};
use super::words::figure;
use frusta_lab::SurveyRow;

/// The size of a thumbnail.
const SIZE: [f64; 2] = [170.0, 150.0];
const COLUMNS: usize = 7;

/// What is nearly exact would take most of the axis.
const LEAST_ERROR: f64 = 1e-3;

/// The axes of all thumbnails.
struct Thumbnail {
    time: Decades,
    error: Decades,
    share: Decades,
}

/// The lowest and the highest ratio of times.
fn times(rows: &[SurveyRow]) -> [f64; 2] {
    let finite = |t: &f64| t.is_finite() && *t > 0.0;
    let times = rows.iter().map(|row| row.time_ratio.median).filter(finite);
    let (low, high) = (times.clone().fold(0.5, f64::min), times.fold(5.0, f64::max));
    [low / 1.3, high * 1.3]
}

/// The axes in words, for a caption.
pub(super) fn axes(rows: &[SurveyRow]) -> String {
    let [low, high] = times(rows).map(figure);
    let errors = rows.iter().map(|row| row.error_u_scale.max);
    let errors = errors.filter(|e| e.is_finite()).fold(10.0, f64::max);
    format!(
        "Across: run time, from {low} to {high} times textbook Liang-Barsky's. Up: the largest error, \
         from {} to {} u·scale; above it, on the grey rail, wrong classes, from 0.001 % to 100 % of \
         the cases; below, answers without any error. All logarithmic.",
        figure(LEAST_ERROR),
        figure(10.0_f64.powf(errors.log10().ceil()))
    )
}

impl Thumbnail {
    /// Axes for all these rows.
    fn new(rows: &[SurveyRow]) -> Self {
        let [low, high] = times(rows);
        let errors = rows.iter().map(|row| row.error_u_scale.max);
        Self {
            time: Decades::between(low, high, [4.0, SIZE[0] - 4.0]),
            error: Decades::around(
                errors.map(|e| e.max(LEAST_ERROR)),
                [LEAST_ERROR, 10.0],
                [126.0, 56.0],
            ),
            share: Decades::between(LEAST_SHARE, 1.0, [46.0, 28.0]),
        }
    }

    /// A family's rows.
    fn draw(&self, rows: &[&SurveyRow], drawing: &mut Drawing) {
        let [width, height] = SIZE;
        let name = rows.first().map_or("", |row| row.family.name());
        drawing.rect("rail", [0.0, 24.0], [width, 50.0]);
        drawing.rect("rail", [0.0, 132.0], [width, 144.0]);
        drawing.rect("frame", [0.0, 24.0], [width, height - 6.0]);
        drawing.text("", [2.0, 16.0], 13, Anchor::Start, name);
        let one = self.time.place(1.0);
        drawing.line("grid", [one, 24.0], [one, 144.0]);
        let bound = self.error.place(FAST);
        drawing.line("bound", [0.0, bound], [width, bound]);
        let mut order: Vec<&&SurveyRow> = rows.iter().collect();
        order.sort_by_key(|row| row.tier.is_exact());
        for row in order {
            let x = self.time.place(row.time_ratio.median);
            let (share, error) = (wrong_share(row), row.error_u_scale.max);
            if share > 0.0 {
                let place = [x, self.share.place(share)];
                drawing.mark((row.algorithm, row.tier), place, 2.2, "");
            }
            if share < 1.0 {
                let y = if error > 0.0 {
                    self.error.place(error)
                } else {
                    138.0
                };
                drawing.mark((row.algorithm, row.tier), [x, y], 2.2, "");
            }
        }
    }
}

/// All families, small, each a link to its panel.
pub(super) fn overview(rows: &[SurveyRow]) -> String {
    let families: Vec<Vec<&SurveyRow>> = by_family(rows);
    let thumbnail = Thumbnail::new(rows);
    let step = [SIZE[0] + 14.0, SIZE[1] + 10.0];
    let size = [
        COLUMNS.min(families.len().max(1)) as f64 * step[0] + 6.0,
        families.len().div_ceil(COLUMNS) as f64 * step[1] + 6.0,
    ];
    let mut drawing = Drawing::new(size, "All families, each a link to its panel");
    for (i, rows) in families.iter().enumerate() {
        let x = 10.0 + (i % COLUMNS) as f64 * step[0];
        let y = 6.0 + (i / COLUMNS) as f64 * step[1];
        let name = rows.first().map_or("", |row| row.family.name());
        drawing.link(name, [x, y], |drawing| thumbnail.draw(rows, drawing));
    }
    drawing.finish()
}
