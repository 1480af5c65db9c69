//! The first chart: error against run time over all families, a mark for each algorithm in each
//! arithmetic.
//!
//! ```text
//! up      the largest error of all families; on a rail of its own above, the share of wrong
//!         answers, which have no error that could be averaged
//! across  nanoseconds a segment: the geometric mean over the families of the ratio to the
//!         reference, times the reference's own mean
//! ```

use super::axes::{Decades, label};
use super::drawing::{Anchor, Drawing};
use super::marks::colour;
use super::panel::{FAST, KEY, LEAST_SHARE};
use super::totals::Total;
use super::words::{figure, percent};
use frusta_lab::{Survey, SurveyAlgorithm, SurveyTier, geometric_mean};

const SIZE: [f64; 2] = [1000.0, 600.0];
const LEFT: f64 = 92.0;
const RIGHT: f64 = 752.0;
/// Top and bottom of the rail of wrong answers.
const WRONG: [f64; 2] = [58.0, 178.0];
/// Top and bottom of the area of errors.
const ERRORS: [f64; 2] = [192.0, 520.0];
/// Where the legend begins.
const LEGEND: f64 = 776.0;
/// A mark's radius.
const RADIUS: f64 = 6.0;

/// Where a clipper is in the chart.
struct Point {
    algorithm: SurveyAlgorithm,
    tier: SurveyTier,
    nanoseconds: f64,
    total: Total,
}

impl Point {
    fn share(&self) -> f64 {
        self.total.share(self.total.wrong())
    }
}

struct Axes {
    time: Decades,
    error: Decades,
    share: Decades,
    /// Nanoseconds of the reference, the unit of the ratios.
    reference: f64,
}

impl Axes {
    fn new(points: &[Point], reference: f64) -> Self {
        let times = || points.iter().map(|p| p.nanoseconds).filter(|t| *t > 0.0);
        let low = times().fold(0.5 * reference, f64::min);
        let high = times().fold(5.0 * reference, f64::max);
        let errors = points.iter().map(|p| p.total.max_u_scale);
        Self {
            time: Decades::between(low / 1.2, high * 1.2, [LEFT, RIGHT]),
            error: Decades::around(errors, [0.1, 10.0], [ERRORS[1], ERRORS[0]]),
            share: Decades::between(LEAST_SHARE, 1.0, [WRONG[1] - 10.0, WRONG[0] + 10.0]),
            reference,
        }
    }
}

/// The chart; empty without rows.
pub(super) fn chart(survey: &Survey) -> String {
    let is_reference =
        |algorithm, tier| algorithm == SurveyAlgorithm::REFERENCE && tier == SurveyTier::PlainF64;
    let rows = survey.rows.iter();
    let own = rows.filter(|row| is_reference(row.algorithm, row.tier));
    let reference = geometric_mean(own.map(|row| row.ns_median)).unwrap_or(1.0);
    let mut points = Vec::new();
    for tier in SurveyTier::ALL {
        for algorithm in SurveyAlgorithm::ALL {
            let total = Total::of_clipper(survey, algorithm, tier);
            if total.cases > 0 {
                let ratio = total.time_ratio.map_or(0.0, |spread| spread.median);
                points.push(Point {
                    algorithm,
                    tier,
                    nanoseconds: ratio * reference,
                    total,
                });
            }
        }
    }
    if points.is_empty() {
        return String::new();
    }
    let mut drawing = Drawing::new(SIZE, "Error against run time over all families");
    let axes = Axes::new(&points, reference);
    rails(&axes, &mut drawing);
    times(&axes, &mut drawing);
    names(&mut drawing);
    points
        .iter()
        .for_each(|point| marks(&axes, point, &mut drawing));
    legend(&mut drawing);
    drawing.finish()
}

/// Frames and horizontal lines.
fn rails(axes: &Axes, drawing: &mut Drawing) {
    drawing.rect("rail", [LEFT, WRONG[0]], [RIGHT, WRONG[1]]);
    drawing.rect("frame", [LEFT, ERRORS[0]], [RIGHT, ERRORS[1]]);
    let mut tick = |y: f64, text: &str| {
        drawing.line("grid", [LEFT, y], [RIGHT, y]);
        drawing.text("", [LEFT - 8.0, y + 4.0], 13, Anchor::End, text);
    };
    for share in [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
        tick(axes.share.place(share), &percent(share));
    }
    for error in axes.error.ticks(9) {
        tick(axes.error.place(error), &label(error));
    }
    let bound = axes.error.place(FAST);
    drawing.line("bound", [LEFT, bound], [RIGHT, bound]);
    let place = [RIGHT - 5.0, bound - 5.0];
    drawing.text("soft", place, 12, Anchor::End, "exact, fast promises 8");
}

/// Vertical lines; nanoseconds below, multiples of the reference above.
fn times(axes: &Axes, drawing: &mut Drawing) {
    let is_inside = |x: f64| x > LEFT + 1.0 && x < RIGHT - 1.0;
    let steps = [1.0, 2.0, 5.0];
    let decades = (-1..7).map(|e| 10_f64.powi(e));
    for time in decades.flat_map(|d| steps.map(|s| s * d)) {
        let x = axes.time.place(time);
        if is_inside(x) {
            drawing.line("grid", [x, WRONG[0]], [x, ERRORS[1]]);
            let place = [x, ERRORS[1] + 18.0];
            drawing.text("", place, 13, Anchor::Middle, &label(time));
        }
        let x = axes.time.place(time * 0.1 * axes.reference);
        if is_inside(x) {
            drawing.line("frame", [x, WRONG[0] - 5.0], [x, WRONG[0]]);
            let place = [x, WRONG[0] - 9.0];
            drawing.text("soft", place, 12, Anchor::Middle, &label(time * 0.1));
        }
    }
    let one = axes.time.place(axes.reference);
    drawing.line("bound", [one, WRONG[0]], [one, ERRORS[1]]);
}

/// What the axes are.
fn names(drawing: &mut Drawing) {
    let middle = 0.5 * (LEFT + RIGHT);
    let below = "run time, nanoseconds a segment (logarithmic; slower to the right)";
    drawing.text("", [middle, ERRORS[1] + 42.0], 14, Anchor::Middle, below);
    let above = "run time as a multiple of textbook Liang-Barsky's in plain f64";
    drawing.text("soft", [middle, WRONG[0] - 30.0], 13, Anchor::Middle, above);
    let up = |[top, bottom]: [f64; 2]| [24.0, 0.5 * (top + bottom)];
    drawing.upwards("", up(WRONG), 14, "wrong answers");
    drawing.upwards("", up(ERRORS), 14, "largest error of the others, u·scale");
    let note = "geometric means over the families; dashed upwards: textbook Liang-Barsky";
    drawing.text("soft", [middle, ERRORS[1] + 62.0], 12, Anchor::Middle, note);
}

/// One mark for the errors of the right answers, one for the wrong ones.
fn marks(axes: &Axes, point: &Point, drawing: &mut Drawing) {
    let Point {
        algorithm, tier, ..
    } = *point;
    let (error, share) = (point.total.max_u_scale, point.share());
    let title = format!(
        "{algorithm} {tier}: {} ns, largest error {} u*scale, wrong {} ({} of {})",
        figure(point.nanoseconds),
        figure(error),
        percent(share),
        point.total.wrong(),
        point.total.cases,
    );
    let (x, y) = (axes.time.place(point.nanoseconds), axes.error.place(error));
    if share > 0.0 {
        let up = axes.share.place(share);
        drawing.line(&format!("tie {}", colour(tier)), [x, up], [x, y]);
        drawing.mark((algorithm, tier), [x, up], RADIUS, &title);
    }
    drawing.mark((algorithm, tier), [x, y], RADIUS, &title);
}

fn legend(drawing: &mut Drawing) {
    let mut y = WRONG[0] + 6.0;
    let heading = |drawing: &mut Drawing, y: &mut f64, text: &str| {
        drawing.text("bold", [LEGEND, *y], 14, Anchor::Start, text);
        *y += 24.0;
    };
    let entry = |drawing: &mut Drawing, y: &mut f64, class: &str, algorithm, tier, text: &str| {
        let place = [LEGEND + 8.0, *y - 4.0];
        drawing.group(class, |drawing| {
            drawing.mark((algorithm, tier), place, RADIUS, "")
        });
        drawing.text("", [LEGEND + 24.0, *y], 13, Anchor::Start, text);
        *y += 22.0;
    };
    heading(drawing, &mut y, "Colour: arithmetic");
    for (tier, name) in KEY {
        entry(drawing, &mut y, "", SurveyAlgorithm::Vw, tier, name);
    }
    let hollow = SurveyTier::ExactFastF32;
    entry(
        drawing,
        &mut y,
        "",
        SurveyAlgorithm::Vw,
        hollow,
        "hollow: in f32, else f64",
    );
    y += 14.0;
    heading(drawing, &mut y, "Shape: algorithm");
    for algorithm in SurveyAlgorithm::ALL {
        let name = match algorithm {
            SurveyAlgorithm::Vw => "V/W, projection reduction",
            other => other.name(),
        };
        entry(
            drawing,
            &mut y,
            "any",
            algorithm,
            SurveyTier::PlainF64,
            name,
        );
    }
    y += 14.0;
    heading(drawing, &mut y, "Better: lower, farther left");
    for line in [
        "A clipper with wrong answers has",
        "two marks, tied by a thin line:",
        "one on the rail at the top, one for",
        "the errors of its right answers.",
        "Point at a mark for its numbers.",
    ] {
        drawing.text("soft", [LEGEND, y - 4.0], 12, Anchor::Start, line);
        y += 17.0;
    }
}
