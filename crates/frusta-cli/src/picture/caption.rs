//! What stands below a picture: the title, a legend with numbers, notes.
//!
//! Widths of texts are estimated, a little above the usual, since the viewer
//! chooses the font; what would not fit goes to the next line.

use super::{Palette, escaped, wrapped};
use std::fmt::Write;

/// A sans-serif letter's width, of its size: text, bold text.
const GLYPH: f64 = 0.6;
const BOLD_GLYPH: f64 = 0.72;
/// The size of text, in the picture's units; that of a long title.
const SIZE: f64 = 15.0;
const LEAST: f64 = 10.0;
/// From line to line, of the size.
const LEADING: f64 = 1.6;
/// What a sample takes, and what parts two entries; of the size.
const SAMPLE: f64 = 2.6;
const GAP: f64 = 1.4;

/// An entry of the legend.
pub(super) struct Entry {
    /// Attributes of what stands before the text, if anything does.
    pub(super) sample: Sample,
    /// In bold and in this colour.
    pub(super) name: (&'static str, &'static str),
    /// After the name.
    pub(super) text: String,
}

/// A piece of what the picture shows.
pub(super) enum Sample {
    Nothing,
    /// A stroke with these attributes.
    Line(String),
    /// A circle with these attributes, its radius among them.
    Circle(String),
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

/// Writes title and entries; the answer is where the caption ends.
pub(super) fn draw(
    svg: &mut String,
    title: &str,
    entries: &[Entry],
    palette: &Palette,
    area: Area,
) -> f64 {
    let size = SIZE * area.unit;
    // Writing into memory cannot fail.
    let _ = writeln!(
        svg,
        "<g font-family=\"sans-serif\" font-size=\"{size:.1}\" fill=\"{}\">",
        palette.ink
    );
    let fitting = area.room / (GLYPH * title.chars().count().max(1) as f64);
    let small = fitting.clamp(LEAST * area.unit, size);
    let mut y = area.top + 0.4 * size;
    for line in wrapped(title, (area.room / (GLYPH * small)) as usize) {
        y += LEADING * small;
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{y:.1}\" font-size=\"{small:.1}\">{}</text>",
            area.left,
            escaped(&line)
        );
    }
    y = draw_entries(svg, entries, area, y);
    svg.push_str("</g>\n");
    y + 0.5 * size
}

/// The entries side by side, in as many lines as they need.
fn draw_entries(svg: &mut String, entries: &[Entry], area: Area, mut y: f64) -> f64 {
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
        let _ = write!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\">");
        if !name.is_empty() {
            let _ = write!(
                svg,
                "<tspan fill=\"{colour}\" font-weight=\"bold\">{name}</tspan> "
            );
        }
        let _ = writeln!(svg, "{}</text>", escaped(&entry.text));
        x += text + GAP * size;
    }
    y
}

/// A sample from `x` on around the height `y`.
fn draw_sample(svg: &mut String, sample: &Sample, x: f64, y: f64, size: f64) {
    let width = (SAMPLE - 0.6) * size;
    let _ = match sample {
        Sample::Nothing => Ok(()),
        Sample::Line(attributes) => writeln!(
            svg,
            "<path {attributes} fill=\"none\" d=\"M{x:.1} {y:.1}h{width:.1}\"/>"
        ),
        Sample::Circle(attributes) => {
            let x = x + 0.5 * width;
            writeln!(svg, "<circle {attributes} cx=\"{x:.1}\" cy=\"{y:.1}\"/>")
        }
        Sample::Ramp(colours) => {
            let step = width / colours.len() as f64;
            let (top, height) = (y - 0.3 * size, 0.6 * size);
            colours.iter().enumerate().try_for_each(|(i, colour)| {
                let x = x + i as f64 * step;
                writeln!(
                    svg,
                    "<rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"{step:.1}\" \
                     height=\"{height:.1}\" fill=\"{colour}\"/>"
                )
            })
        }
    };
}
