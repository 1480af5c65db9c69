//! A family's panel: error up, time across, both logarithmic.
//!
//! ```text
//! wrong class   share of the cases, a rail of its own at the top: a wrong class has
//!               no error that could be averaged
//! error         the largest of the other answers, in u*scale
//! 0, exact      a rail at the bottom: zero is on no logarithmic axis
//! ```
//! A clipper with wrong classes has a mark on the rail and one for what is left, tied
//! by a thin line.

use super::axes::{Decades, label};
use super::marks::mark;
use super::style;
use super::words::{figure, percent};
use crate::draw::escaped;
use frusta_lab::{SurveyAlgorithm, SurveyRow, SurveyTier};
use std::fmt::Write;

const SIZE: [f64; 2] = [640.0, 470.0];
/// Of the key below a panel that stands alone.
const KEY_HEIGHT: f64 = 84.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 16.0;
/// Where the rail of wrong classes begins and ends.
const WRONG: [f64; 2] = [48.0, 128.0];
/// Where the errors' area begins and ends.
const ERRORS: [f64; 2] = [138.0, 372.0];
/// Where the rail of exact points begins and ends.
const ZERO: [f64; 2] = [380.0, 404.0];

/// The lowest share on the rail of wrong classes.
const LEAST_SHARE: f64 = 1e-5;

/// `Accuracy::Fast` promises this.
const FAST: f64 = 8.0;

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
        let times = rows.iter().map(|row| row.time_ratio);
        let errors = rows.iter().map(|row| row.error_u_scale.max);
        // Time is not widened to whole decades: it would leave most of them empty.
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
    let mut svg = opening(SIZE[1]);
    body(rows, &mut svg);
    svg + "</svg>"
}

/// The panel as a file.
pub(super) fn file(rows: &[&SurveyRow]) -> String {
    let mut svg = opening(SIZE[1] + KEY_HEIGHT);
    let (colours, panels) = (style::COLOURS, style::PANELS);
    // Writing into memory cannot fail.
    let _ = writeln!(svg, "<style>{colours}{panels}</style>");
    svg += "<rect width=\"100%\" height=\"100%\" style=\"fill:var(--paper)\"/>\n";
    body(rows, &mut svg);
    key(&mut svg);
    svg + "</svg>\n"
}

/// The marks' meaning, below a panel that stands alone.
fn key(svg: &mut String) {
    let mut entry = |x: f64, row: f64, algorithm, tier, name: &str| {
        let y = SIZE[1] + 8.0 + 20.0 * row;
        let mark = mark(algorithm, tier, [x, y], 5.0, "");
        // A shape stands for an algorithm in every colour, so it has none here.
        let class = if row < 2.0 { "any" } else { "" };
        let _ = writeln!(svg, "<g class=\"{class}\">{mark}</g>");
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{}\" font-size=\"12\">{name}</text>",
            x + 10.0,
            y + 4.0
        );
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

fn opening(height: f64) -> String {
    let width = SIZE[0];
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"panel\" viewBox=\"0 0 {width} {height}\" \
         role=\"img\">\n"
    )
}

fn body(rows: &[&SurveyRow], svg: &mut String) {
    let axes = Axes::new(rows);
    let name = rows.first().map_or("", |row| row.family.name());
    let cases = rows.first().map_or(0, |row| row.cases);
    let mut text = |x: f64, y: f64, attributes: &str, text: &str| {
        let text = escaped(text);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" {attributes}>{text}</text>"
        );
    };
    text(16.0, 27.0, "font-size=\"19\" font-weight=\"bold\"", name);
    let count = format!("{cases} cases");
    text(
        SIZE[0] - RIGHT,
        27.0,
        "font-size=\"13\" text-anchor=\"end\" class=\"soft\"",
        &count,
    );
    scales(&axes, svg);
    // Exact answers last: they are what is looked for among the others.
    let mut order: Vec<&&SurveyRow> = rows.iter().collect();
    order.sort_by_key(|row| row.tier.is_exact());
    for row in order {
        marks(&axes, row, svg);
    }
}

/// Frames, grids and labels.
fn scales(axes: &Axes, svg: &mut String) {
    let (left, right) = (LEFT, SIZE[0] - RIGHT);
    let width = right - left;
    for ([top, bottom], class) in [(WRONG, "rail"), (ZERO, "rail")] {
        let height = bottom - top;
        let _ = writeln!(
            svg,
            "<rect class=\"{class}\" x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/>"
        );
    }
    let mut tick = |y: f64, text: &str| {
        let base = y + 4.0;
        let x = left - 8.0;
        let _ = writeln!(
            svg,
            "<line class=\"grid\" x1=\"{left}\" x2=\"{right}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>\
             <text x=\"{x}\" y=\"{base:.1}\" font-size=\"12\" text-anchor=\"end\">{text}</text>"
        );
    };
    for share in [1.0, 1e-2, 1e-4] {
        tick(axes.share.place(share), &percent(share));
    }
    for error in axes.error.ticks(7) {
        tick(axes.error.place(error), &label(error));
    }
    let middle = 0.5 * (ZERO[0] + ZERO[1]);
    tick(middle, "0");
    for ratio in [
        0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 1e4,
    ] {
        let x = axes.time.place(ratio);
        if x <= left + 1.0 || x >= right - 1.0 {
            continue;
        }
        let (top, bottom, base, text) = (WRONG[0], ZERO[1], ZERO[1] + 17.0, label(ratio));
        let _ = writeln!(
            svg,
            "<line class=\"grid\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{top}\" y2=\"{bottom}\"/>\
             <text x=\"{x:.1}\" y=\"{base}\" font-size=\"12\" text-anchor=\"middle\">{text}</text>"
        );
    }
    let bound = axes.error.place(FAST);
    let _ = writeln!(
        svg,
        "<line class=\"bound\" x1=\"{left}\" x2=\"{right}\" y1=\"{bound:.1}\" y2=\"{bound:.1}\"/>\
         <text class=\"soft\" x=\"{}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"end\">\
         exact-fast promises 8</text>",
        right - 4.0,
        bound - 4.0
    );
    names(svg);
}

/// What the axes are.
fn names(svg: &mut String) {
    let (left, right) = (LEFT, SIZE[0] - RIGHT);
    for ([top, bottom], name) in [(WRONG, "wrong class"), (ERRORS, "largest error, u·scale")] {
        let y = 0.5 * (top + bottom);
        let _ = writeln!(
            svg,
            "<text class=\"soft\" font-size=\"12\" text-anchor=\"middle\" \
             transform=\"translate(18 {y}) rotate(-90)\">{name}</text>"
        );
    }
    let middle = 0.5 * (left + right);
    let y = SIZE[1] - 12.0;
    let _ = writeln!(
        svg,
        "<text class=\"soft\" font-size=\"12\" x=\"{middle}\" y=\"{y}\" text-anchor=\"middle\">\
         run time, in times of textbook Liang-Barsky in plain f64 (slower to the right)</text>"
    );
    let _ = writeln!(
        svg,
        "<text class=\"soft\" font-size=\"11\" x=\"{}\" y=\"{}\" text-anchor=\"end\">exact</text>",
        right - 4.0,
        0.5 * (ZERO[0] + ZERO[1]) + 4.0
    );
}

/// A row's one or two marks.
fn marks(axes: &Axes, row: &SurveyRow, svg: &mut String) {
    let x = axes.time.place(row.time_ratio);
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
        figure(row.time_ratio),
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
        let _ = writeln!(
            svg,
            "<line class=\"tie {colour}\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{up:.1}\" y2=\"{y:.1}\"/>"
        );
        svg.push_str(&mark(row.algorithm, row.tier, [x, up], 5.0, &title));
    }
    // Without a right answer there is no error to show.
    if share < 1.0 {
        svg.push_str(&mark(row.algorithm, row.tier, [x, y], 5.0, &title));
    }
}

/// A family in the overview: the same in little, on axes that all families share.
pub(super) struct Little {
    time: Decades,
    error: Decades,
    share: Decades,
}

/// The size of a family in the overview.
pub(super) const LITTLE: [f64; 2] = [170.0, 150.0];

impl Little {
    /// Axes for all these rows.
    pub(super) fn new(rows: &[SurveyRow]) -> Self {
        let finite = |t: &f64| t.is_finite() && *t > 0.0;
        let times = rows.iter().map(|row| row.time_ratio).filter(finite);
        let low = times.clone().fold(0.5, f64::min);
        let high = times.fold(5.0, f64::max);
        // What is nearly exact would take most of the axis.
        let errors = rows.iter().map(|row| row.error_u_scale.max.max(1e-3));
        Self {
            time: Decades::between(low / 1.3, high * 1.3, [4.0, LITTLE[0] - 4.0]),
            error: Decades::around(errors, [0.1, 10.0], [126.0, 56.0]),
            share: Decades::between(LEAST_SHARE, 1.0, [46.0, 28.0]),
        }
    }

    /// A family's rows.
    pub(super) fn draw(&self, rows: &[&SurveyRow]) -> String {
        let [width, height] = LITTLE;
        let name = rows.first().map_or("", |row| row.family.name());
        let mut svg = format!(
            "<rect class=\"rail\" x=\"0\" y=\"24\" width=\"{width}\" height=\"26\"/>\
             <rect class=\"rail\" x=\"0\" y=\"132\" width=\"{width}\" height=\"12\"/>\
             <rect class=\"frame\" x=\"0\" y=\"24\" width=\"{width}\" height=\"{}\"/>\
             <text x=\"2\" y=\"16\" font-size=\"13\">{name}</text>\n",
            height - 30.0
        );
        let one = self.time.place(1.0);
        let bound = self.error.place(FAST);
        let _ = writeln!(
            svg,
            "<line class=\"grid\" x1=\"{one:.1}\" x2=\"{one:.1}\" y1=\"24\" y2=\"144\"/>\
             <line class=\"bound\" x1=\"0\" x2=\"{width}\" y1=\"{bound:.1}\" y2=\"{bound:.1}\"/>"
        );
        let mut order: Vec<&&SurveyRow> = rows.iter().collect();
        order.sort_by_key(|row| row.tier.is_exact());
        for row in order {
            let x = self.time.place(row.time_ratio);
            let (share, error) = (wrong_share(row), row.error_u_scale.max);
            if share > 0.0 {
                let place = [x, self.share.place(share)];
                svg += &mark(row.algorithm, row.tier, place, 2.2, "");
            }
            if share < 1.0 {
                let y = if error > 0.0 {
                    self.error.place(error)
                } else {
                    138.0
                };
                svg += &mark(row.algorithm, row.tier, [x, y], 2.2, "");
            }
        }
        svg
    }
}

/// All families, small, each a link to its panel.
pub(super) fn overview(rows: &[SurveyRow]) -> String {
    const COLUMNS: usize = 7;
    let families: Vec<Vec<&SurveyRow>> = by_family(rows);
    let little = Little::new(rows);
    let [width, height] = LITTLE;
    let step = [width + 14.0, height + 10.0];
    let size = [
        COLUMNS.min(families.len().max(1)) as f64 * step[0] + 6.0,
        families.len().div_ceil(COLUMNS) as f64 * step[1] + 6.0,
    ];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"panel\" viewBox=\"0 0 {} {}\">\n",
        size[0], size[1]
    );
    for (i, rows) in families.iter().enumerate() {
        let (x, y) = (
            10.0 + (i % COLUMNS) as f64 * step[0],
            6.0 + (i / COLUMNS) as f64 * step[1],
        );
        let name = rows.first().map_or("", |row| row.family.name());
        let _ = writeln!(
            svg,
            "<a href=\"#{name}\"><g transform=\"translate({x} {y})\">{}</g></a>",
            little.draw(rows)
        );
    }
    svg + "</svg>"
}

/// The rows, family by family.
pub(super) fn by_family(rows: &[SurveyRow]) -> Vec<Vec<&SurveyRow>> {
    rows.chunk_by(|a, b| a.family == b.family)
        .map(|rows| rows.iter().collect())
        .collect()
}

/// Whether `f32` is hollow is told in the key; so are all tiers of a colour.
pub(super) const KEY: [(SurveyTier, &str); 4] = [
    (SurveyTier::PlainF64, "plain arithmetic"),
    (SurveyTier::ExactFast, "exact, fast"),
    (SurveyTier::ExactNearest, "exact, nearest"),
    (SurveyTier::ExactInward, "exact, inward"),
];
