//! A family's panel: error up, time across, both logarithmic.
//!
//! ```text
//! wrong class   share of the cases, a rail of its own at the top: a wrong class has
//!               no error that could be averaged
//! error         the largest of the other answers, in u*scale
//! 0, exact      a rail at the bottom: zero is on no logarithmic axis
//! ```
//! A clipper with wrong classes has a mark on the rail and one for its other answers, tied
//! by a thin line.

use super::axes::{Decades, label};
use super::drawing::{Anchor, Drawing};
use super::style;
use super::words::{figure, percent, times};
use frusta_lab::{SurveyAlgorithm, SurveyRow, SurveyTier};

const SIZE: [f64; 2] = [640.0, 470.0];
/// The height of the key below a panel that is a file of its own.
const KEY_HEIGHT: f64 = 84.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 16.0;
/// Top and bottom of the rail of wrong classes.
const WRONG: [f64; 2] = [48.0, 128.0];
/// Top and bottom of the errors' area.
const ERRORS: [f64; 2] = [138.0, 372.0];
/// Top and bottom of the rail of exact points.
const ZERO: [f64; 2] = [380.0, 404.0];

/// The lowest share on the rail of wrong classes.
pub(super) const LEAST_SHARE: f64 = 1e-5;

/// The error bound of `Accuracy::Fast`, in u times scale.
pub(super) const FAST: f64 = 8.0;

/// A row's share of wrong classes and refusals.
pub(super) fn wrong_share(row: &SurveyRow) -> f64 {
    (row.wrong_class + row.refused) as f64 / row.cases.max(1) as f64
}

/// The axes of a panel.
struct Axes {
    time: Decades,
    error: Decades,
    share: Decades,
}

impl Axes {
    fn new(rows: &[&SurveyRow]) -> Self {
        let times = rows.iter().map(|row| row.time_ratio.median);
        let errors = rows.iter().map(|row| row.error_u_scale.max);
        // Whole decades of time would leave most of the axis empty.
        let finite = |t: &f64| t.is_finite() && *t > 0.0;
        let low = times.clone().filter(finite).fold(0.5, f64::min);
        let high = times.filter(finite).fold(5.0, f64::max);
        Self {
            time: Decades::between(low / 1.15, high * 1.15, [LEFT, SIZE[0] - RIGHT]),
            error: Decades::around(errors, [0.1, 10.0], [ERRORS[1], ERRORS[0]]),
            share: Decades::between(LEAST_SHARE, 1.0, [WRONG[1] - 8.0, WRONG[0] + 8.0]),
        }
    }
}

/// The panel as it stands in the page.
pub(super) fn panel(rows: &[&SurveyRow]) -> String {
    let mut drawing = Drawing::new(SIZE, name(rows));
    body(rows, &mut drawing);
    drawing.finish()
}

/// The panel as a file.
pub(super) fn file(rows: &[&SurveyRow]) -> String {
    let mut drawing = Drawing::new([SIZE[0], SIZE[1] + KEY_HEIGHT], name(rows));
    let (colours, panels) = (style::COLOURS, style::PANELS);
    drawing.style(&format!("{colours}{panels}"));
    body(rows, &mut drawing);
    key(&mut drawing);
    drawing.finish()
}

fn name(rows: &[&SurveyRow]) -> &'static str {
    rows.first().map_or("", |row| row.family.name())
}

/// The meaning of the marks, below a panel that is a file of its own.
fn key(drawing: &mut Drawing) {
    let mut entry = |x: f64, row: f64, algorithm, tier, name: &str| {
        let y = SIZE[1] + 8.0 + 20.0 * row;
        // A shape stands for an algorithm in every colour, so it has none here.
        let class = if row < 2.0 { "any" } else { "" };
        drawing.group(class, |drawing| {
            drawing.mark((algorithm, tier), [x, y], 5.0, "")
        });
        drawing.text("", [x + 10.0, y + 4.0], 12, Anchor::Start, name);
    };
    for (i, algorithm) in SurveyAlgorithm::ALL.into_iter().enumerate() {
        let (x, row) = (24.0 + 200.0 * (i % 3) as f64, (i / 3) as f64);
        entry(x, row, algorithm, SurveyTier::PlainF64, algorithm.name());
    }
    let hollow = (SurveyTier::ExactFastF32, "hollow: in f32");
    for (i, (tier, name)) in KEY.into_iter().chain([hollow]).enumerate() {
        let (x, row) = (24.0 + 200.0 * (i % 3) as f64, 2.0 + (i / 3) as f64);
        entry(x, row, SurveyAlgorithm::Vw, tier, name);
    }
}

fn body(rows: &[&SurveyRow], drawing: &mut Drawing) {
    let axes = Axes::new(rows);
    let cases = rows.first().map_or(0, |row| row.cases);
    drawing.text("bold", [16.0, 27.0], 19, Anchor::Start, name(rows));
    let place = [SIZE[0] - RIGHT, 27.0];
    drawing.text("soft", place, 13, Anchor::End, &format!("{cases} cases"));
    scales(&axes, drawing);
    // Exact answers last, on top of the others.
    let mut order: Vec<&&SurveyRow> = rows.iter().collect();
    order.sort_by_key(|row| row.tier.is_exact());
    for row in order {
        marks(&axes, row, drawing);
    }
}

/// Frames, grids and labels.
fn scales(axes: &Axes, drawing: &mut Drawing) {
    let (left, right) = (LEFT, SIZE[0] - RIGHT);
    for [top, bottom] in [WRONG, ZERO] {
        drawing.rect("rail", [left, top], [right, bottom]);
    }
    let mut tick = |y: f64, text: &str| {
        drawing.line("grid", [left, y], [right, y]);
        drawing.text("", [left - 8.0, y + 4.0], 12, Anchor::End, text);
    };
    for share in [1.0, 1e-2, 1e-4] {
        tick(axes.share.place(share), &percent(share));
    }
    for error in axes.error.ticks(7) {
        tick(axes.error.place(error), &label(error));
    }
    tick(0.5 * (ZERO[0] + ZERO[1]), "0");
    for ratio in [
        0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 1e4,
    ] {
        let x = axes.time.place(ratio);
        if x <= left + 1.0 || x >= right - 1.0 {
            continue;
        }
        drawing.line("grid", [x, WRONG[0]], [x, ZERO[1]]);
        drawing.text("", [x, ZERO[1] + 17.0], 12, Anchor::Middle, &label(ratio));
    }
    let bound = axes.error.place(FAST);
    drawing.line("bound", [left, bound], [right, bound]);
    let place = [right - 4.0, bound - 4.0];
    drawing.text("soft", place, 11, Anchor::End, "exact-fast promises 8");
    names(drawing);
}

/// The names of the axes.
fn names(drawing: &mut Drawing) {
    let (left, right) = (LEFT, SIZE[0] - RIGHT);
    for ([top, bottom], name) in [(WRONG, "wrong class"), (ERRORS, "largest error, u·scale")] {
        drawing.upwards("soft", [18.0, 0.5 * (top + bottom)], 12, name);
    }
    let place = [0.5 * (left + right), SIZE[1] - 12.0];
    let name =
        "run time, as a multiple of textbook Liang-Barsky's in plain f64 (slower to the right)";
    drawing.text("soft", place, 12, Anchor::Middle, name);
    let place = [right - 4.0, 0.5 * (ZERO[0] + ZERO[1]) + 4.0];
    drawing.text("soft", place, 11, Anchor::End, "exact");
}

/// A row's one or two marks.
fn marks(axes: &Axes, row: &SurveyRow, drawing: &mut Drawing) {
    let x = axes.time.place(row.time_ratio.median);
    let share = wrong_share(row);
    let error = row.error_u_scale.max;
    let y = if error > 0.0 {
        axes.error.place(error)
    } else {
        0.5 * (ZERO[0] + ZERO[1])
    };
    let title = format!(
        "{} {}: {} ns ({} times), error {} u*scale, {} ulp, wrong class {} of {}, refused {}, \
         wrong faces {}",
        row.algorithm,
        row.tier,
        figure(row.ns_median),
        times(row.time_ratio),
        figure(error),
        figure(row.error_ulp.max),
        row.wrong_class,
        row.cases,
        row.refused,
        row.wrong_faces,
    );
    if share > 0.0 {
        let up = axes.share.place(share);
        let colour = super::marks::colour(row.tier);
        drawing.line(&format!("tie {colour}"), [x, up], [x, y]);
        drawing.mark((row.algorithm, row.tier), [x, up], 5.0, &title);
    }
    // Without a right answer there is no error to show.
    if share < 1.0 {
        drawing.mark((row.algorithm, row.tier), [x, y], 5.0, &title);
    }
}

/// The rows, family by family.
pub(super) fn by_family(rows: &[SurveyRow]) -> Vec<Vec<&SurveyRow>> {
    rows.chunk_by(|a, b| a.family == b.family)
        .map(|rows| rows.iter().collect())
        .collect()
}

/// A tier of each colour, and the colour's meaning.
pub(super) const KEY: [(SurveyTier, &str); 4] = [
    (SurveyTier::PlainF64, "plain arithmetic"),
    (SurveyTier::ExactFast, "exact, fast"),
    (SurveyTier::ExactNearest, "exact, nearest"),
    (SurveyTier::ExactInward, "exact, inward"),
];
