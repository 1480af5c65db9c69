//! The picture of a case: the frustum in space, its two trapezoids, the segment with the
//! part that is truly inside, and wrong answers; enlarged, the spot where they differ from
//! the truth.

mod exact;
mod scene;
mod spot;
mod zoom;

use super::answers::Replay;
use super::decimal::decimal;
use super::text::figure;
use crate::draw::{
    Camera, Canvas, Entries, Font, Frame, Pen, Place, Plane, Sizes, Subject, all_corners,
    class_colour, draw_legend, draw_planar, draw_spatial,
};
use crate::draw::{Palette, wrapped};
use exact::between;
use frusta::{Class, Segment, SegmentClip, Vec3};
use frusta_lab::SurveyTier;
use scene::{Scene, points};
use spot::Spot;
use zoom::Zoom;

const WIDTH: f64 = 1180.0;
const MARGIN: f64 = 24.0;
const GAP: f64 = 12.0;
const TOP: f64 = 92.0;
/// The frustum's picture.
const LARGE: Place = [560.0, 420.0];
/// A trapezoid's picture.
const SMALL: Place = [
    (WIDTH - 2.0 * MARGIN - LARGE[0] - 2.0 * GAP) / 2.0,
    LARGE[1],
];
/// A spot's picture.
const SPOT: f64 = 330.0;
/// The heights of lines of small and of usual text.
const LINE: f64 = 18.0;
const WORDS: f64 = 22.0;

/// The picture of a case; with its line below, or without where that stands beside.
pub(super) fn picture(
    replay: &Replay,
    title: &str,
    palette: &'static Palette,
    with_line: bool,
) -> String {
    let scene = Scene::new(replay);
    let spot = spot::find(replay, &scene);
    let line = if with_line {
        wrapped(&replay.case.to_string(), 128)
    } else {
        Vec::new()
    };
    let summary = summary(replay);
    let below = TOP + LARGE[1] + 56.0;
    let bottom = match &spot {
        Some(_) => below + SPOT + 42.0,
        None => below + WORDS * summary.len() as f64 + 10.0,
    };
    let height = bottom + 26.0 + LINE * line.len() as f64;
    let mut canvas = Canvas::new([WIDTH, height], palette);
    heading(&mut canvas, replay, title);
    whole(&mut canvas, replay, &scene);
    stretched(&mut canvas, &scene);
    match &spot {
        Some(spot) => closely(&mut canvas, replay, &scene, spot, below),
        None => words(&mut canvas, [MARGIN, below], &summary),
    }
    let entries = Entries {
        feature: false,
        classes: false,
    };
    draw_legend(&mut canvas, [MARGIN, bottom], 13.0, entries);
    let small = Font::new(canvas.palette, 12.0, false);
    for (i, text) in line.iter().enumerate() {
        canvas.text([MARGIN, bottom + 34.0 + LINE * i as f64], text, small);
    }
    canvas.finish()
}

fn heading(canvas: &mut Canvas, replay: &Replay, title: &str) {
    let class = replay.truth.class;
    let large = Font::new(canvas.palette, 24.0, true);
    let title = if title.is_empty() {
        "A replayed case"
    } else {
        title
    };
    canvas.text([MARGIN, 46.0], title, large);
    let coloured = Font {
        colour: class_colour(canvas.palette, class),
        ..large
    };
    canvas.text_before([WIDTH - MARGIN, 46.0], &format!("truth: {class}"), coloured);
    let wrong = |exact: bool| {
        let of = replay.answers.iter().filter(|a| a.tier.is_exact() == exact);
        let wrong = of.clone().filter(|a| !a.verdict.is_right()).count();
        format!("{wrong} of {}", of.count())
    };
    let line = format!(
        "Class or faces wrong: {} answers of plain arithmetic, {} of exact arithmetic",
        wrong(false),
        wrong(true)
    );
    let plain = Font::new(canvas.palette, 15.0, false);
    canvas.text([MARGIN, 74.0], &line, plain);
}

/// All of the frustum, in space and in the two planes.
fn whole(canvas: &mut Canvas, replay: &Replay, scene: &Scene) {
    let piece = scene.near_piece(replay);
    let wrong = wrong_pieces(replay, scene);
    let mut fit = all_corners(&scene.solid);
    fit.extend(piece.iter().flat_map(|s| [s.segment.start, s.segment.end]));
    fit.extend(wrong.iter().flatten());
    // Without a piece near the frustum there is a piece that nothing is drawn of.
    let nothing = SegmentClip::OUTSIDE;
    let aside = Segment::new(fit[0], fit[0]);
    let subject = Subject {
        solid: &scene.solid,
        feature: None,
        segment: piece.as_ref().map_or(aside, |s| s.segment),
        clip: piece.as_ref().map_or(&nothing, |s| &s.clip),
        shown: piece.as_ref().map_or([0.0, 0.0], |s| s.shown),
    };
    canvas.paper([MARGIN, TOP], LARGE);
    canvas.inside([MARGIN, TOP], LARGE, |canvas| {
        let camera = Camera::new(&scene.solid, &fit, LARGE, 34.0);
        mark(canvas, &wrong, |p| camera.place(p));
        draw_spatial(canvas, &camera, &subject, Sizes::LARGE);
    });
    let frames = Frame::both(&scene.solid, &fit, SMALL, 30.0);
    for (i, plane) in [Plane::V, Plane::W].into_iter().enumerate() {
        let corner = [MARGIN + LARGE[0] + GAP + i as f64 * (SMALL[0] + GAP), TOP];
        canvas.paper(corner, SMALL);
        canvas.inside(corner, SMALL, |canvas| {
            mark(canvas, &wrong, |p| frames[i].place(p));
            draw_planar(canvas, frames[i], &subject, Sizes::LARGE);
            name(canvas, plane, SMALL, scene);
        });
    }
}

fn name(canvas: &mut Canvas, plane: Plane, size: Place, scene: &Scene) {
    let bold = Font::new(canvas.palette, 15.0, true);
    canvas.text([12.0, 24.0], plane.name(), bold);
    let small = Font::new(canvas.palette, 12.0, false);
    canvas.text([46.0, 24.0], &format!("{} upwards", plane.across()), small);
    let sign = if scene.solid.shape.direction().sign() > 0.0 {
        ""
    } else {
        "-"
    };
    let depth = format!("{sign}z to the right");
    canvas.text_before([size[0] - 12.0, size[1] - 12.0], &depth, small);
}

/// The parts of wrong answers, as far as they are near the frustum.
fn wrong_pieces(replay: &Replay, scene: &Scene) -> Vec<[Vec3<f64>; 2]> {
    let wrong = replay.answers.iter().filter(|a| !a.verdict.is_right());
    let mut pieces: Vec<[Vec3<f64>; 2]> = Vec::new();
    for [a, b] in wrong.filter_map(|a| points(replay, a)) {
        let Some(range) = scene.near(&a, &b) else {
            continue;
        };
        let piece = range.map(|t| scene.place(&between(&a, &b, &t)));
        if !pieces.contains(&piece) {
            pieces.push(piece);
        }
    }
    pieces
}

/// A band with a cross at either end.
fn mark(canvas: &mut Canvas, pieces: &[[Vec3<f64>; 2]], place: impl Fn(Vec3<f64>) -> Place) {
    let colour = canvas.palette.wrong;
    for piece in pieces {
        let [a, b] = piece.map(&place);
        canvas.polygon(&[a, b], colour, 0.35, 11.0);
        for end in [a, b] {
            canvas.cross(end, 7.0, Pen::new(colour, 2.4));
        }
    }
}

/// A line about axes that are not to one scale.
fn stretched(canvas: &mut Canvas, scene: &Scene) {
    let names = ["x", "y", "z"].into_iter().zip(scene.window.stretch());
    let names: Vec<String> = names
        .filter(|(_, s)| *s > 1.01)
        .map(|(name, s)| match s.is_finite() {
            true => format!("{name} {} times", figure(s)),
            false => format!("{name} beyond the range of f64"),
        })
        .collect();
    let text = if names.is_empty() {
        "In the frustum's frame, all axes to one scale.".to_owned()
    } else {
        format!(
            "In the frustum's frame. Thin frusta are widened: drawn larger are {}.",
            names.join(" and ")
        )
    };
    let small = Font::new(canvas.palette, 13.0, false);
    canvas.text([MARGIN, TOP + LARGE[1] + 22.0], &text, small);
}

/// The spot in both planes, and words beside it.
fn closely(canvas: &mut Canvas, replay: &Replay, scene: &Scene, spot: &Spot, top: f64) {
    let title = format!(
        "Closely, {}: both windows are {} wide and high.",
        spot.name,
        decimal(&(&spot.half * exact::exact(2.0)), 3)
    );
    let bold = Font::new(canvas.palette, 14.0, true);
    canvas.text([MARGIN, top - 6.0], &title, bold);
    for (i, plane) in [Plane::V, Plane::W].into_iter().enumerate() {
        let corner = [MARGIN + i as f64 * (SPOT + GAP), top + 8.0];
        canvas.paper(corner, [SPOT, SPOT]);
        canvas.inside(corner, [SPOT, SPOT], |canvas| {
            let zoom = Zoom {
                replay,
                scene,
                spot,
                plane,
                side: SPOT,
            };
            zoom.draw(canvas);
            name(canvas, plane, [SPOT, SPOT], scene);
        });
    }
    let left = 2.0 * MARGIN + 2.0 * SPOT + GAP;
    let palette = canvas.palette;
    let small = Font::new(canvas.palette, 14.0, false);
    let mut y = top + 24.0;
    canvas.cross([left + 8.0, y - 5.0], 5.0, Pen::new(palette.wrong, 2.2));
    canvas.text([left + 24.0, y], "plain arithmetic's points", small);
    y += 24.0;
    canvas.disc([left + 8.0, y - 5.0], 3.6, palette.ink);
    canvas.text([left + 24.0, y], "exact arithmetic's points", small);
    y += 24.0;
    canvas.disc([left + 8.0, y - 5.0], 1.6, palette.classes[0]);
    canvas.text([left + 24.0, y], "representable points (where few)", small);
    words(canvas, [left, y + 34.0], &summary(replay));
}

fn words(canvas: &mut Canvas, [x, y]: Place, lines: &[String]) {
    let font = Font::new(canvas.palette, 14.0, false);
    for (i, line) in lines.iter().enumerate() {
        canvas.text([x, y + WORDS * i as f64], line, font);
    }
}

/// A line for each tier: who is wrong, and how far the right ones are off.
fn summary(replay: &Replay) -> Vec<String> {
    let mut lines = Vec::new();
    for tier in SurveyTier::ALL {
        let answers = || replay.answers.iter().filter(|a| a.tier == tier);
        let count = answers().count();
        if count == 0 {
            continue;
        }
        let wrong = answers().filter(|a| !a.verdict.is_right()).count();
        let errors = answers().filter_map(|a| a.verdict.errors).flatten();
        let largest = errors.map(|e| e.u_scale).fold(0.0, f64::max);
        let off = if replay.truth.class == Class::Outside || wrong == count {
            String::new()
        } else {
            format!("; points up to {} u*scale off", figure(largest))
        };
        lines.push(match wrong {
            0 => format!("{tier}: all right{off}"),
            _ => format!("{tier}: {wrong} of {count} wrong{off}"),
        });
    }
    lines
}
