//! Strokes, shapes and text, drawn one by one.

use super::Palette;
use super::svg::{Element, Svg};

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

    fn on(self, element: Element<'_>) -> Element<'_> {
        let Self { colour, width, .. } = self;
        let element = element
            .attribute("stroke", colour)
            .attribute("stroke-width", width);
        if !self.dashed {
            return element;
        }
        let (on, off) = (width * 2.2 + 1.5, width * 1.4 + 1.8);
        element
            .attribute("stroke-dasharray", format_args!("{on:.1} {off:.1}"))
            .attribute("stroke-linecap", "butt")
    }
}

/// How text is set.
#[derive(Clone, Copy)]
pub(crate) struct Font {
    pub(crate) size: f64,
    pub(crate) bold: bool,
    pub(crate) colour: &'static str,
}

impl Font {
    /// In the palette's ink.
    pub(crate) fn new(palette: &Palette, size: f64, bold: bool) -> Self {
        Self {
            size,
            bold,
            colour: palette.ink,
        }
    }
}

/// A picture in the making: strokes, shapes and text in a theme's colours.
pub(crate) struct Canvas {
    svg: Svg,
    pub(crate) palette: &'static Palette,
}

impl Canvas {
    /// An empty picture on the page's colour.
    pub(crate) fn new([width, height]: Place, palette: &'static Palette) -> Self {
        let mut svg = Svg::new();
        let page = svg.document();
        page.attribute("width", width)
            .attribute("height", height)
            .attribute("viewBox", format_args!("0 0 {width} {height}"))
            .attribute("font-family", "'DejaVu Sans', sans-serif")
            .attribute("stroke-linecap", "round")
            .attribute("stroke-linejoin", "round")
            .open();
        let page = svg.element("rect").attribute("width", "100%");
        page.attribute("height", "100%")
            .attribute("fill", palette.page)
            .empty();
        Self { svg, palette }
    }

    /// The file's text.
    pub(crate) fn finish(mut self) -> String {
        self.svg.close("svg");
        self.svg.finish()
    }

    /// Draws in a rectangle with its own coordinates; what leaves it is not shown.
    pub(crate) fn inside(&mut self, corner: Place, size: Place, draw: impl FnOnce(&mut Self)) {
        let svg = self.svg.element("svg");
        svg.rectangle(corner, size).open();
        draw(self);
        self.svg.close("svg");
    }

    /// A rectangle of paper.
    pub(crate) fn paper(&mut self, corner: Place, size: Place) {
        let Palette { paper, faint, .. } = self.palette;
        let rect = self.svg.element("rect");
        rect.rectangle(corner, size)
            .attribute("rx", 3)
            .attribute("fill", paper)
            .attribute("stroke", faint)
            .attribute("stroke-width", 0.6)
            .empty();
    }

    /// A straight line.
    pub(crate) fn line(&mut self, [x0, y0]: Place, [x1, y1]: Place, pen: Pen) {
        let d = format!("M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}");
        let path = self.svg.element("path").attribute("d", d);
        path.attribute("fill", "none").with(|e| pen.on(e)).empty();
    }

    /// An area, filled to a share of opaque, with an outline if its width is not 0.
    pub(crate) fn polygon(&mut self, corners: &[Place], fill: &str, opacity: f64, outline: f64) {
        let points = corners.iter().map(|[x, y]| format!("{x:.2},{y:.2}"));
        let polygon = self.svg.element("polygon");
        polygon
            .attribute("points", points.collect::<Vec<_>>().join(" "))
            .attribute("fill", fill)
            .attribute("stroke", fill)
            .attribute("stroke-width", outline)
            .attribute("opacity", opacity)
            .empty();
    }

    /// A filled circle.
    pub(crate) fn disc(&mut self, centre: Place, radius: f64, fill: &str) {
        self.circle(centre, radius).attribute("fill", fill).empty();
    }

    /// A circle that hides what is below it.
    pub(crate) fn ring(&mut self, centre: Place, radius: f64, pen: Pen) {
        let paper = self.palette.paper;
        let circle = self.circle(centre, radius).attribute("fill", paper);
        circle.with(|e| pen.on(e)).empty();
    }

    fn circle(&mut self, [x, y]: Place, radius: f64) -> Element<'_> {
        let circle = self.svg.element("circle");
        circle
            .attribute("cx", format_args!("{x:.2}"))
            .attribute("cy", format_args!("{y:.2}"))
            .attribute("r", radius)
    }

    /// A diagonal cross.
    pub(crate) fn cross(&mut self, [x, y]: Place, radius: f64, pen: Pen) {
        for side in [radius, -radius] {
            self.line([x - radius, y - side], [x + radius, y + side], pen);
        }
    }

    /// A line of text that begins at a place.
    pub(crate) fn text(&mut self, place: Place, text: &str, font: Font) {
        self.set(place, "start", text, font);
    }

    /// A line of text that ends at a place.
    pub(crate) fn text_before(&mut self, place: Place, text: &str, font: Font) {
        self.set(place, "end", text, font);
    }

    fn set(&mut self, [x, y]: Place, anchor: &str, text: &str, font: Font) {
        let Font { size, bold, colour } = font;
        let element = self.svg.element("text");
        element
            .attribute("x", format_args!("{x:.2}"))
            .attribute("y", format_args!("{y:.2}"))
            .attribute("font-size", size)
            .attribute("text-anchor", anchor)
            .attribute("fill", colour)
            .attribute_if("font-weight", bold.then_some("bold"))
            .text(text);
    }
}
