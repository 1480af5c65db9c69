//! Strokes as vectors, where they are few: one path for each layer, and marks.

use super::layer::{Layer, Style};
use super::projector::Place;
use crate::draw::Palette;
use crate::draw::svg::Svg;
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
pub(super) fn draw(svg: &mut Svg, strokes: &[Stroke], palette: &Palette, unit: f64) {
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

fn steps(place: Place) -> [i32; 2] {
    place.map(|c| (f64::from(c) * STEPS).round() as i32)
}

/// One path for all strokes of a layer; a stroke that begins where the last one
/// ended goes on from there.
fn draw_path<'a>(
    svg: &mut Svg,
    strokes: impl Iterator<Item = &'a Stroke>,
    name: &str,
    style: Style,
    width: f64,
) {
    let mut path = String::new();
    let mut last = None;
    for (i, stroke) in strokes.enumerate() {
        let (from, to) = (steps(stroke.from), steps(stroke.to));
        let line = if i % 16 == 15 { "\n" } else { "" };
        // Writing into memory cannot fail.
        if last != Some(from) {
            let _ = write!(path, "M{} {}", from[0], from[1]);
        }
        let _ = write!(path, "l{} {}{line}", to[0] - from[0], to[1] - from[1]);
        last = Some(to);
    }
    let element = svg
        .element("path")
        .attribute("class", name.replace(' ', "-"));
    let element = element.with(|e| style.on(e, width * STEPS));
    element.attribute("d", path).empty();
}

/// Circles at clipped ends.
fn draw_rings<'a>(
    svg: &mut Svg,
    marks: impl Iterator<Item = &'a Stroke> + Clone,
    palette: &Palette,
    unit: f64,
) {
    let radius = ring_radius(marks.clone().count()) * unit * STEPS;
    svg.element("g")
        .attribute("class", "cut")
        .attribute("fill", palette.paper)
        .attribute("stroke", palette.cut)
        .attribute("stroke-width", format_args!("{:.1}", radius * 0.38))
        .open();
    for mark in marks {
        let [x, y] = steps(mark.from);
        let circle = svg.element("circle").attribute("cx", x).attribute("cy", y);
        circle.attribute("r", format_args!("{radius:.0}")).empty();
    }
    svg.close("g");
}
