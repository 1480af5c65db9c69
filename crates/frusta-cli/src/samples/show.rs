//! `frusta samples show`: one sample in full, as text, JSON or a picture.

use super::case::{Case, point, sets};
use super::choice;
use super::labels;
use super::pictures;
use crate::draw::{Theme, save};
use crate::failure::Failure;
use crate::io::number::short;
use crate::terminal::print;
use clap::Args;
use frusta::math::hex::Hex;
use frusta::samples::{Placement, Solid};
use frusta::{EndRect, FaceSet, Frustum, Interval, Segment, SegmentClip, Shape};
use serde_json::json;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// One sample: its numbers, its exact answer and why, and what this program answers
///
/// With -o also a picture: the frustum with the feature marked and the segment cut by it, and the
/// two trapezoids that it is projected to.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct ShowArgs {
    /// The sample, such as edge-near-top/crossing; `frusta samples list` has all of them, and
    /// .../apart is the feature's near miss
    name: String,
    /// The frustum that the sample is about
    #[arg(long, value_name = "NAME", default_value = "symmetric", value_parser = choice::solid())]
    solid: Solid,
    /// Draw it: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The picture's colours
    #[arg(long, default_value = "light")]
    theme: Theme,
    /// All there is about it as JSON on the standard output
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub(super) fn run(args: &ShowArgs) -> Result<ExitCode, Failure> {
    let placement = Placement::IDENTITY;
    let frustum = placement.place(&args.solid).map_err(Failure::new)?;
    let case = Case::new(choice::find(&args.solid, &args.name)?, &placement)?;
    let found = frustum.clip_segment(&case.segment).map_err(Failure::new)?;
    if let Some(file) = &args.output {
        let page = pictures::page(&args.solid, &frustum, &case, args.theme.palette());
        save(file, &page)?;
    }
    print(&if args.json {
        let mut object = case.to_json(&args.solid, "identity", &frustum);
        object["found"] = json!(found);
        object["agrees"] = agrees(&found, &case).into();
        format!("{object:#}\n")
    } else {
        text(&args.solid, &frustum, &case, &found)
    })?;
    Ok(if agrees(&found, &case) {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(crate::WRONG)
    })
}

/// Class, sets, parameters and points.
fn agrees(found: &SegmentClip<f64>, case: &Case) -> bool {
    *found == case.expected
}

/// The expected and the found answer, for people.
fn text(solid: &Solid, frustum: &Frustum, case: &Case, found: &SegmentClip<f64>) -> String {
    let sample = &case.sample;
    let mut out = format!("{} of the solid {}\n\n", sample.name(), solid.name);
    let mut row = |name: &str, value: &str| {
        // Writing into memory cannot fail.
        let _ = writeln!(out, "{name:<14}{value}");
    };
    let kind = sample.feature.kind().name();
    row("feature", &format!("{kind} of {}", sample.feature.faces()));
    row("paper", &labels::phrase(sample));
    for (i, line) in shape(frustum.shape()).iter().enumerate() {
        row(if i == 0 { "frustum" } else { "" }, line);
    }
    let Segment { start, end } = case.segment;
    for (name, p) in [("from", start), ("to", end)] {
        row(name, &point(p));
        row("", &Hex(p).to_string());
    }
    let [on_v, on_w] = intervals(frustum, &case.segment);
    let both = on_v.zip(on_w).and_then(|(v, w)| v.intersection(w));
    row("t inside TV", &interval(on_v));
    row("t inside TW", &interval(on_w));
    row("t inside both", &interval(both));
    describe(&case.expected, "expected", &mut row);
    row("reason", sample.reason);
    if agrees(found, case) {
        row("clip_segment", "answers the same, in every bit");
    } else {
        describe(found, "clip_segment", &mut row);
        row("", "THIS IS NOT THE EXACT ANSWER");
    }
    out
}

/// The ends of the frustum in its frame, which is the world here.
fn shape(shape: &Shape) -> Vec<String> {
    let end = |name: &str, EndRect { z, rect }: EndRect| {
        let [left, right, bottom, top] = rect.to_array().map(short);
        format!(
            "{name} z = {}, x {left} to {right}, y {bottom} to {top}",
            short(z)
        )
    };
    let far = match *shape {
        Shape::Finite { far, .. } => end("far ", far),
        Shape::Infinite {
            slopes, direction, ..
        } => {
            let [left, right, bottom, top] = slopes.to_array().map(short);
            let sign = if direction.sign() > 0.0 { '+' } else { '-' };
            format!(
                "endless along {sign}z; for each unit of it left changes by {left}, right by \
                 {right}, bottom by {bottom}, top by {top}"
            )
        }
    };
    vec![end("near", shape.near()), far]
}

/// The parameters of the segment's projections that are in the two trapezoids.
pub(super) fn intervals(frustum: &Frustum, segment: &Segment<f64>) -> [Option<Interval>; 2] {
    let [p, q] = [segment.start, segment.end].map(|p| frustum.pose().to_frame(p));
    [
        frustum.tv().clip_segment([p.x, p.z], [q.x, q.z]),
        frustum.tw().clip_segment([p.y, p.z], [q.y, q.z]),
    ]
}

fn interval(found: Option<Interval>) -> String {
    found.map_or_else(
        || "none".to_owned(),
        |i| format!("{} to {}", short(i.start()), short(i.end())),
    )
}

/// The rows of an answer.
fn describe(clip: &SegmentClip<f64>, name: &str, row: &mut impl FnMut(&str, &str)) {
    row(name, clip.class.name());
    let Some(part) = &clip.part else {
        return;
    };
    let on = |faces: FaceSet| {
        if faces.is_empty() {
            "on no face".to_owned()
        } else {
            format!("on {faces}")
        }
    };
    for (name, end) in [("  enters", &part.entry), ("  leaves", &part.exit)] {
        let verb = if end.clipped {
            "clipped"
        } else {
            "not clipped"
        };
        let place = point(end.point);
        row(
            name,
            &format!("t = {} at {place}, {}, {verb}", short(end.t), on(end.faces)),
        );
    }
    let [.., coplanar] = sets(Some(part));
    if !coplanar.is_empty() {
        row("  lies in", &coplanar.to_string());
    }
}

const EXAMPLES: &str = "\
Pictures
  On the left the frustum from outside, hidden edges dashed, the feature highlighted; the part of
  the segment that is inside in the colour of its class, the rest dashed. On the right the
  trapezoids TV (x over z) and TW (y over z) with the projected segment; below them the parameters
  that are inside TV, inside TW, and inside both, which is the answer.

Examples
  frusta samples show vertex-near-left-top/touching
  frusta samples show face-top/contained --json
  frusta samples show edge-left-bottom/crossing --solid infinite -o crossing.svg --theme dark

Exit codes:
  0  done
  1  the library's answer is not the exact one
  2  wrong usage, an unknown sample, or a file that cannot be written";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plain_steps_give_the_exact_parameters_of_these_samples() {
        for solid in Solid::ALL {
            let frustum = Placement::IDENTITY.place(&solid).unwrap();
            for sample in choice::samples(&solid, true) {
                let [on_v, on_w] = intervals(&frustum, &sample.segment);
                let both = on_v.zip(on_w).and_then(|(v, w)| v.intersection(w));
                let t = both.map(|both| [both.start(), both.end()]);
                let expected = sample.expected.part.map(|part| part.t);
                assert_eq!(t, expected, "{} {}", solid.name, sample.name());
            }
        }
    }
}
