//! Strokes as vectors, where they are few: one path for each layer, and marks.

use super::Palette;
use super::layer::{Layer, Style};
use super::projector::Place;
use std::fmt::Write;

/// Grid steps in a pixel: places are written as whole numbers of these.
pub(super) const STEPS: f64 = 10.0;

/// A straight stroke; a mark's two ends are the same.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    pub(super) layer: Layer,
    pub(super) from: Place,
    pub(super) to: Place,
    /// How much ink it leaves on a density, at most 1.
    pub(super) weight: f32,
}

/// Pixels: thick enough to see a few strokes, thin enough to part many.
fn stroke_width(strokes: usize) -> f64 {
    match strokes {
        0..=300 => 2.2,
        301..=3_000 => 1.2,
        _ => 0.75,
    }
}

/// Pixels: the radius of a mark at a clipped end.
fn ring_radius(marks: usize) -> f64 {
    match marks {
        0..=30 => 4.2,
        31..=300 => 2.4,
        _ => 1.6,
    }
}

/// Draws all strokes, layer by layer; `unit`: the picture's own pixel.
pub(super) fn draw(svg: &mut String, strokes: &[Stroke], palette: &Palette, unit: f64) {
    let width = stroke_width(strokes.len()) * unit;
    for layer in Layer::ALL {
        let own = strokes.iter().filter(|s| s.layer == layer);
        match layer {
            _ if own.clone().next().is_none() => {}
            Layer::Cut => draw_rings(svg, own, palette, unit),
            _ => draw_path(svg, own, layer.name(), layer.style(palette), width),
        }
    }
}

/// Attributes of a path.
pub(super) fn attributes(style: Style, width: f64) -> String {
    let mut text = format!(
        "stroke=\"{}\" stroke-width=\"{:.1}\"",
        style.colour,
        style.width * width
    );
    // Writing into memory cannot fail.
    if let Some([dash, gap]) = style.dashes {
        let _ = write!(
            text,
            " stroke-dasharray=\"{:.1} {:.1}\"",
            dash * width,
            gap * width
        );
    }
    if style.opacity < 1.0 {
        let _ = write!(text, " stroke-opacity=\"{}\"", style.opacity);
    }
    text
}

fn steps(place: Place) -> [i32; 2] {
    place.map(|c| (f64::from(c) * STEPS).round() as i32)
}

/// One path for all strokes of a layer; a stroke that begins where the last one
/// ended goes on from there.
fn draw_path<'a>(
    svg: &mut String,
    strokes: impl Iterator<Item = &'a Stroke>,
    name: &str,
    style: Style,
    width: f64,
) {
    let class = name.replace(' ', "-");
    let _ = write!(
        svg,
        "<path class=\"{class}\" {} d=\"",
        attributes(style, width * STEPS)
    );
    let mut last = None;
    for (i, stroke) in strokes.enumerate() {
        let (from, to) = (steps(stroke.from), steps(stroke.to));
        let line = if i % 16 == 15 { "\n" } else { "" };
        if last != Some(from) {
            let _ = write!(svg, "M{} {}", from[0], from[1]);
        }
        let _ = write!(svg, "l{} {}{line}", to[0] - from[0], to[1] - from[1]);
        last = Some(to);
    }
    svg.push_str("\"/>\n");
}

/// Circles at clipped ends.
fn draw_rings<'a>(
    svg: &mut String,
    marks: impl Iterator<Item = &'a Stroke> + Clone,
    palette: &Palette,
    unit: f64,
) {
    let radius = ring_radius(marks.clone().count()) * unit * STEPS;
    let _ = writeln!(
        svg,
        "<g class=\"cut\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.1}\">",
        palette.paper,
        palette.cut,
        radius * 0.38
    );
    for mark in marks {
        let [x, y] = steps(mark.from);
        let _ = writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius:.0}\"/>");
    }
    svg.push_str("</g>\n");
}
