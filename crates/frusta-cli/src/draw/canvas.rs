//! Strokes, shapes and text as SVG.

use crate::picture::{Palette, escaped};
use std::fmt::Write;

/// A place in a picture: pixels to the right and downwards.
pub(crate) type Place = [f64; 2];

/// How a line is drawn.
#[derive(Clone, Copy)]
pub(crate) struct Pen {
    pub(crate) colour: &'static str,
    pub(crate) width: f64,
    pub(crate) dashed: bool,
}

impl Pen {
    /// A full line.
    pub(crate) fn new(colour: &'static str, width: f64) -> Self {
        Self {
            colour,
            width,
            dashed: false,
        }
    }

    /// The same line, dashed.
    pub(crate) fn dashed(self) -> Self {
        Self {
            dashed: true,
            ..self
        }
    }

    fn attributes(self) -> String {
        let Self { colour, width, .. } = self;
        let dash = if self.dashed {
            let (on, off) = (width * 2.2 + 1.5, width * 1.4 + 1.8);
            format!(" stroke-dasharray=\"{on:.1} {off:.1}\" stroke-linecap=\"butt\"")
        } else {
            String::new()
        };
        format!("stroke=\"{colour}\" stroke-width=\"{width}\"{dash}")
    }
}

/// How text is set.
#[derive(Clone, Copy)]
pub(crate) struct Type {
    pub(crate) size: f64,
    pub(crate) bold: bool,
    pub(crate) colour: &'static str,
}

impl Type {
    /// In the palette's ink.
    pub(crate) fn new(palette: &Palette, size: f64, bold: bool) -> Self {
        Self {
            size,
            bold,
            colour: palette.ink,
        }
    }
}

/// A picture in the making.
pub(crate) struct Canvas {
    svg: String,
    pub(crate) palette: &'static Palette,
}

// Writing into memory cannot fail, so no result of it is looked at.
impl Canvas {
    /// An empty picture on the page's colour.
    pub(crate) fn new([width, height]: Place, palette: &'static Palette) -> Self {
        let page = palette.page;
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"'DejaVu Sans', sans-serif\" \
             stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"{page}\"/>\n"
        );
        Self { svg, palette }
    }

    /// The file's text.
    pub(crate) fn finish(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }

    /// Draws in a rectangle with coordinates of its own; what leaves it is not
    /// seen.
    pub(crate) fn inside(
        &mut self,
        [x, y]: Place,
        [width, height]: Place,
        draw: impl FnOnce(&mut Self),
    ) {
        let _ = writeln!(
            self.svg,
            "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\">"
        );
        draw(self);
        self.svg.push_str("</svg>\n");
    }

    /// A rectangle of paper.
    pub(crate) fn paper(&mut self, [x, y]: Place, [width, height]: Place) {
        let Palette { paper, faint, .. } = self.palette;
        let _ = writeln!(
            self.svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"3\" \
             fill=\"{paper}\" stroke=\"{faint}\" stroke-width=\"0.6\"/>"
        );
    }

    /// A straight line.
    pub(crate) fn line(&mut self, [x0, y0]: Place, [x1, y1]: Place, pen: Pen) {
        let pen = pen.attributes();
        let _ = writeln!(
            self.svg,
            "<path d=\"M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}\" fill=\"none\" {pen}/>"
        );
    }

    /// An area, filled to a share of opaque, with an outline if its width is
    /// not 0.
    pub(crate) fn polygon(&mut self, corners: &[Place], fill: &str, opacity: f64, outline: f64) {
        let points: Vec<_> = corners
            .iter()
            .map(|[x, y]| format!("{x:.2},{y:.2}"))
            .collect();
        let _ = writeln!(
            self.svg,
            "<polygon points=\"{}\" fill=\"{fill}\" stroke=\"{fill}\" stroke-width=\"{outline}\" \
             opacity=\"{opacity}\"/>",
            points.join(" ")
        );
    }

    /// A filled circle.
    pub(crate) fn disc(&mut self, [x, y]: Place, radius: f64, fill: &str) {
        let _ = writeln!(
            self.svg,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{fill}\"/>"
        );
    }

    /// A circle that hides what is below it.
    pub(crate) fn ring(&mut self, [x, y]: Place, radius: f64, pen: Pen) {
        let (paper, pen) = (self.palette.paper, pen.attributes());
        let _ = writeln!(
            self.svg,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{paper}\" {pen}/>"
        );
    }

    /// A diagonal cross.
    pub(crate) fn cross(&mut self, [x, y]: Place, radius: f64, pen: Pen) {
        for side in [radius, -radius] {
            self.line([x - radius, y - side], [x + radius, y + side], pen);
        }
    }

    /// A line of text that begins at a place.
    pub(crate) fn text(&mut self, [x, y]: Place, text: &str, font: Type) {
        self.set(x, y, "start", text, font);
    }

    /// A line of text that ends at a place.
    pub(crate) fn text_before(&mut self, [x, y]: Place, text: &str, font: Type) {
        self.set(x, y, "end", text, font);
    }

    fn set(&mut self, x: f64, y: f64, anchor: &str, text: &str, font: Type) {
        let Type { size, bold, colour } = font;
        let weight = if bold { " font-weight=\"bold\"" } else { "" };
        let text = escaped(text);
        let _ = writeln!(
            self.svg,
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
             fill=\"{colour}\"{weight}>{text}</text>"
        );
    }
}
