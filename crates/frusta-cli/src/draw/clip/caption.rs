//! The caption below a picture: the title, a legend with numbers, notes.
//!
//! Widths of texts are estimated, a little above the usual, since the viewer
//! chooses the font; what would not fit goes to the next line.

use super::layer::Style;
use crate::draw::svg::Svg;
use crate::draw::{Palette, wrapped};

/// A sans-serif letter's width relative to its size: text, bold text.
const GLYPH: f64 = 0.6;
const BOLD_GLYPH: f64 = 0.72;
/// The size of text, in the picture's units; that of a long title.
const SIZE: f64 = 15.0;
const LEAST: f64 = 10.0;
/// The distance of lines, relative to the size.
const LEADING: f64 = 1.6;
/// The width of a sample and the gap between entries, relative to the size.
const SAMPLE: f64 = 2.6;
const GAP: f64 = 1.4;

/// An entry of the legend.
pub(super) struct Entry {
    /// The sample before the text.
    pub(super) sample: Sample,
    /// In bold and in this colour.
    pub(super) name: (&'static str, &'static str),
    /// After the name.
    pub(super) text: String,
}

/// A piece of what the picture shows.
pub(super) enum Sample {
    Nothing,
    /// A stroke of this style; in it the picture's stroke width.
    Line(Style, f64),
    Circle {
        radius: f64,
        fill: &'static str,
        /// Colour and width, if it has one.
        outline: Option<(&'static str, f64)>,
    },
    /// Colours from left to right.
    Ramp(Vec<String>),
}

/// The caption's place: left, top, and room to the right; `unit` the picture's
/// own pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) room: f64,
    pub(super) unit: f64,
}

/// Writes title and entries; returns where the caption ends.
pub(super) fn draw(
    svg: &mut Svg,
    title: &str,
    entries: &[Entry],
    palette: &Palette,
    area: Area,
) -> f64 {
    let size = SIZE * area.unit;
    svg.element("g")
        .attribute("font-family", "sans-serif")
        .attribute("font-size", format_args!("{size:.1}"))
        .attribute("fill", palette.ink)
        .open();
    let fitting = area.room / (GLYPH * title.chars().count().max(1) as f64);
    let small = fitting.clamp(LEAST * area.unit, size);
    let mut y = area.top + 0.4 * size;
    for line in wrapped(title, (area.room / (GLYPH * small)) as usize) {
        y += LEADING * small;
        let text = svg.element("text").attribute("x", area.left);
        text.attribute("y", format_args!("{y:.1}"))
            .attribute("font-size", format_args!("{small:.1}"))
            .text(&line);
    }
    y = draw_entries(svg, entries, area, y);
    svg.close("g");
    y + 0.5 * size
}

/// The entries side by side, in as many lines as they need.
fn draw_entries(svg: &mut Svg, entries: &[Entry], area: Area, mut y: f64) -> f64 {
    let size = SIZE * area.unit;
    let mut x = f64::INFINITY;
    for entry in entries {
        let (name, colour) = entry.name;
        let sample = match entry.sample {
            Sample::Nothing => 0.0,
            _ => SAMPLE * size,
        };
        let letters = |text: &str, glyph: f64| text.chars().count() as f64 * glyph * size;
        let text = letters(name, BOLD_GLYPH) + letters(&entry.text, GLYPH);
        if x + sample + text > area.left + area.room {
            (x, y) = (area.left, y + LEADING * size);
        }
        draw_sample(svg, &entry.sample, x, y - 0.35 * size, size);
        x += sample;
        let line = svg.element("text").attribute("x", format_args!("{x:.1}"));
        let line = line.attribute("y", format_args!("{y:.1}")).begin();
        if !name.is_empty() {
            let bold = line.element("tspan").attribute("fill", colour);
            bold.attribute("font-weight", "bold").span(name);
            line.text(" ");
        }
        line.text(&entry.text);
        line.close("text");
        x += text + GAP * size;
    }
    y
}

/// A sample from `x` on around the height `y`.
fn draw_sample(svg: &mut Svg, sample: &Sample, x: f64, y: f64, size: f64) {
    let width = (SAMPLE - 0.6) * size;
    match sample {
        Sample::Nothing => {}
        Sample::Line(style, unit) => {
            let path = svg.element("path").with(|e| style.on(e, *unit));
            path.attribute("fill", "none")
                .attribute("d", format_args!("M{x:.1} {y:.1}h{width:.1}"))
                .empty();
        }
        Sample::Circle {
            radius,
            fill,
            outline,
        } => {
            let circle = svg.element("circle");
            circle
                .attribute("r", format_args!("{radius:.1}"))
                .attribute("fill", fill)
                .attribute_if("stroke", outline.map(|(colour, _)| colour))
                .attribute_if("stroke-width", outline.map(|(_, w)| format!("{w:.1}")))
                .attribute("cx", format_args!("{:.1}", x + 0.5 * width))
                .attribute("cy", format_args!("{y:.1}"))
                .empty();
        }
        Sample::Ramp(colours) => {
            let step = width / colours.len() as f64;
            let (top, height) = (y - 0.3 * size, 0.6 * size);
            for (i, colour) in colours.iter().enumerate() {
                let x = x + i as f64 * step;
                svg.element("rect")
                    .attribute("x", format_args!("{x:.1}"))
                    .attribute("y", format_args!("{top:.1}"))
                    .attribute("width", format_args!("{step:.1}"))
                    .attribute("height", format_args!("{height:.1}"))
                    .attribute("fill", colour)
                    .empty();
            }
        }
    }
}
