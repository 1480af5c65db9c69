//! One sample, large: the frustum, both trapezoids, the parameters, the words.

use crate::draw::Palette;
use crate::draw::wrapped;
use crate::draw::{
    Camera, Canvas, Entries, Font, Frame, Pen, Place, Plane, Sizes, all_corners, class_colour,
    draw_legend, draw_planar, draw_spatial,
};
use crate::io::number::short;
use crate::samples::case::{Case, sets};
use crate::samples::labels;
use crate::samples::show::intervals;
use frusta::samples::Solid;
use frusta::{Frustum, Interval};

const WIDTH: f64 = 1180.0;
const HEIGHT: f64 = 850.0;
const MARGIN: f64 = 24.0;
/// The frustum's picture.
const LARGE: Place = [640.0, 520.0];
/// A trapezoid's picture.
const SMALL: Place = [(WIDTH - 3.0 * MARGIN - LARGE[0] - GAP) / 2.0, LARGE[1]];
/// Between the trapezoids.
const GAP: f64 = 12.0;
const TOP: f64 = 92.0;

/// The picture of a sample.
pub(in crate::samples) fn page(
    solid: &Solid,
    frustum: &Frustum,
    case: &Case,
    palette: &'static Palette,
) -> String {
    let mut canvas = Canvas::new([WIDTH, HEIGHT], palette);
    heading(&mut canvas, solid, case);
    let mut fit = all_corners(solid);
    fit.extend([case.segment.start, case.segment.end]);
    canvas.paper([MARGIN, TOP], LARGE);
    canvas.inside([MARGIN, TOP], LARGE, |canvas| {
        let camera = Camera::new(solid, &fit, LARGE, 34.0);
        draw_spatial(canvas, &camera, &case.subject(solid), Sizes::LARGE);
    });
    let left = 2.0 * MARGIN + LARGE[0];
    let frames = Frame::both(solid, &fit, SMALL, 30.0);
    for (i, plane) in [Plane::V, Plane::W].into_iter().enumerate() {
        let corner = [left + i as f64 * (SMALL[0] + GAP), TOP];
        canvas.paper(corner, SMALL);
        canvas.inside(corner, SMALL, |canvas| {
            draw_planar(canvas, frames[i], &case.subject(solid), Sizes::LARGE);
            name_axes(canvas, plane, solid);
        });
    }
    let below = TOP + LARGE[1] + 34.0;
    parameters(&mut canvas, frustum, case, below);
    words(&mut canvas, case, below + 96.0);
    draw_legend(
        &mut canvas,
        [MARGIN, HEIGHT - 24.0],
        13.0,
        Entries {
            feature: true,
            classes: false,
        },
    );
    canvas.finish()
}

fn heading(canvas: &mut Canvas, solid: &Solid, case: &Case) {
    let class = case.expected.class;
    let name = case.sample.name();
    let large = Font::new(canvas.palette, 26.0, true);
    canvas.text([MARGIN, 46.0], &name, large);
    let coloured = Font {
        colour: class_colour(canvas.palette, class),
        ..large
    };
    canvas.text_before([WIDTH - MARGIN, 46.0], class.name(), coloured);
    let plain = Font::new(canvas.palette, 15.0, false);
    let line = format!("solid {}: {}", solid.name, labels::phrase(&case.sample));
    canvas.text([MARGIN, 74.0], &line, plain);
}

fn name_axes(canvas: &mut Canvas, plane: Plane, solid: &Solid) {
    let name = Font::new(canvas.palette, 15.0, true);
    canvas.text([12.0, 24.0], plane.name(), name);
    let axis = Font::new(canvas.palette, 13.0, false);
    canvas.text([46.0, 24.0], &format!("{} upwards", plane.across()), axis);
    let depth = if solid.shape.direction().sign() > 0.0 {
        "z to the right"
    } else {
        "-z to the right"
    };
    canvas.text_before([SMALL[0] - 12.0, SMALL[1] - 14.0], depth, axis);
}

/// Three bars from 0 to 1: the parameters in TV, in TW, in both.
fn parameters(canvas: &mut Canvas, frustum: &Frustum, case: &Case, top: f64) {
    let [on_v, on_w] = intervals(frustum, &case.segment);
    let answer = case.expected.part.as_ref();
    let both = answer.and_then(|p| Interval::new(p.entry.t, p.exit.t));
    let palette = canvas.palette;
    let rows = [
        ("t inside TV", on_v, palette.ink),
        ("t inside TW", on_w, palette.ink),
        (
            "t inside both",
            both,
            class_colour(palette, case.expected.class),
        ),
    ];
    let (left, right) = (MARGIN + 130.0, WIDTH - MARGIN - 150.0);
    let x = |t: f64| left + t * (right - left);
    let font = Font::new(canvas.palette, 15.0, false);
    for (i, (name, interval, colour)) in rows.into_iter().enumerate() {
        let y = top + 28.0 * i as f64;
        canvas.text([MARGIN, y + 5.0], name, font);
        canvas.line([left, y], [right, y], Pen::new(palette.faint, 1.5));
        let text = match interval {
            Some(interval) => {
                let [a, b] = [interval.start(), interval.end()];
                canvas.line([x(a), y], [x(b), y], Pen::new(colour, 7.0));
                canvas.disc([x(a), y], 5.0, colour);
                canvas.disc([x(b), y], 5.0, colour);
                match [rounded(a), rounded(b)] {
                    [a, b] if a == b => a,
                    [a, b] => format!("{a} to {b}"),
                }
            }
            None => "none".to_owned(),
        };
        canvas.text([right + 18.0, y + 5.0], &text, font);
    }
}

/// A parameter of one trapezoid alone need not be dyadic.
fn rounded(t: f64) -> String {
    short((t * 1e4).round() / 1e4)
}

/// The answer's sets, and why.
fn words(canvas: &mut Canvas, case: &Case, top: f64) {
    let font = Font::new(canvas.palette, 15.0, false);
    let [enter, leave, coplanar] = sets(case.expected.part.as_ref());
    let mut sets_by_verb = Vec::new();
    for (verb, set) in [
        ("enters on", enter),
        ("leaves on", leave),
        ("lies in", coplanar),
    ] {
        if !set.is_empty() {
            sets_by_verb.push(format!("{verb} {set}"));
        }
    }
    let mut lines = Vec::new();
    if !sets_by_verb.is_empty() {
        lines.push(sets_by_verb.join("; "));
    }
    lines.extend(wrapped(&format!("Reason: {}.", case.sample.reason), 125));
    for (i, line) in lines.iter().enumerate() {
        canvas.text([MARGIN, top + 26.0 * i as f64], line, font);
    }
}
