//! Drawings made of the few elements that the charts consist of.
//!
//! Classes carry all colours and line widths: see `style`.

use super::marks::{colour, shape};
use crate::draw::svg::Svg;
use frusta_lab::{SurveyAlgorithm, SurveyTier};

/// Where a text is relative to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    const fn name(self) -> &'static str {
        ["start", "middle", "end"][self as usize]
    }
}

/// A drawing that grows.
pub(super) struct Drawing(Svg);

impl Drawing {
    /// An empty drawing of a size; `label` is read to those who cannot see it.
    pub(super) fn new([width, height]: [f64; 2], label: &str) -> Self {
        let mut svg = Svg::new();
        svg.document()
            .attribute("class", "panel")
            .attribute("viewBox", format_args!("0 0 {width} {height}"))
            .attribute("role", "img")
            .attribute("aria-label", label)
            .open();
        Self(svg)
    }

    /// A drawing of a size that nobody needs to have read out.
    pub(super) fn icon(size: u32) -> Self {
        let mut svg = Svg::new();
        svg.document()
            .attribute("class", "panel")
            .attribute("viewBox", format_args!("0 0 {size} {size}"))
            .attribute("aria-hidden", true)
            .open();
        Self(svg)
    }

    /// A style sheet, and paper behind all that follows.
    pub(super) fn style(&mut self, sheet: &str) {
        self.0.element("style").text(sheet);
        self.0
            .element("rect")
            .attribute("width", "100%")
            .attribute("height", "100%")
            .attribute("style", "fill:var(--paper)")
            .empty();
    }

    /// What `draw` adds, in a group of a class.
    pub(super) fn group(&mut self, class: &str, draw: impl FnOnce(&mut Self)) {
        self.0.element("g").attribute("class", class).open();
        draw(self);
        self.0.close("g");
    }

    /// What `draw` adds, with its origin at a position; it leads to a place on the page.
    pub(super) fn link(&mut self, id: &str, [x, y]: [f64; 2], draw: impl FnOnce(&mut Self)) {
        let href = format_args!("#{id}");
        self.0.element("a").attribute("href", href).open();
        let moved = format_args!("translate({x} {y})");
        self.0.element("g").attribute("transform", moved).open();
        draw(self);
        self.0.close("g");
        self.0.close("a");
    }

    /// A line.
    pub(super) fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        self.0
            .element("line")
            .attribute("class", class)
            .attribute("x1", format_args!("{x1:.1}"))
            .attribute("y1", format_args!("{y1:.1}"))
            .attribute("x2", format_args!("{x2:.1}"))
            .attribute("y2", format_args!("{y2:.1}"))
            .empty();
    }

    /// A rectangle from its upper left to its lower right corner.
    pub(super) fn rect(&mut self, class: &str, [x, y]: [f64; 2], [right, bottom]: [f64; 2]) {
        let (width, height) = (right - x, bottom - y);
        let rect = self.0.element("rect").attribute("class", class);
        rect.attribute("x", format_args!("{x:.1}"))
            .attribute("y", format_args!("{y:.1}"))
            .attribute("width", format_args!("{width:.1}"))
            .attribute("height", format_args!("{height:.1}"))
            .empty();
    }

    /// A mark (see `marks`), with a text that is shown when it is pointed at.
    pub(super) fn mark(
        &mut self,
        (algorithm, tier): (SurveyAlgorithm, SurveyTier),
        [x, y]: [f64; 2],
        radius: f64,
        title: &str,
    ) {
        let fill = if tier.is_single() { "h" } else { "m" };
        let class = format!("{} {fill}", colour(tier));
        let outline = shape(algorithm);
        let name = if outline.is_empty() { "circle" } else { "path" };
        let element = self.0.element(name).attribute("class", class);
        let element = if outline.is_empty() {
            element
                .attribute("cx", format_args!("{x:.1}"))
                .attribute("cy", format_args!("{y:.1}"))
                .attribute("r", format_args!("{radius:.1}"))
        } else {
            let steps = outline.iter().enumerate().map(|(i, [dx, dy])| {
                let step = if i == 0 { 'M' } else { 'L' };
                format!("{step}{:.1} {:.1}", x + dx * radius, y + dy * radius)
            });
            element.attribute("d", steps.collect::<String>() + "Z")
        };
        if title.is_empty() {
            return element.empty();
        }
        let inner = element.begin();
        inner.element("title").span(title);
        inner.close(name);
    }

    /// A line of text.
    pub(super) fn text(
        &mut self,
        class: &str,
        [x, y]: [f64; 2],
        size: u32,
        anchor: Anchor,
        text: &str,
    ) {
        self.0
            .element("text")
            .attribute("class", class)
            .attribute("x", format_args!("{x:.1}"))
            .attribute("y", format_args!("{y:.1}"))
            .attribute("font-size", size)
            .attribute("text-anchor", anchor.name())
            .text(text);
    }

    /// A line of text that runs upwards, its middle at a position.
    pub(super) fn upwards(&mut self, class: &str, [x, y]: [f64; 2], size: u32, text: &str) {
        let turned = format_args!("translate({x:.1} {y:.1}) rotate(-90)");
        self.0
            .element("text")
            .attribute("class", class)
            .attribute("transform", turned)
            .attribute("font-size", size)
            .attribute("text-anchor", "middle")
            .text(text);
    }

    /// The markup.
    pub(super) fn finish(mut self) -> String {
        self.0.close("svg");
        self.0.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use resvg::usvg::roxmltree::Document;

    #[test]
    fn drawings_are_well_formed() {
        let mut drawing = Drawing::new([10.0, 20.0], "a \"<&>\"");
        drawing.style("a { b: c }");
        drawing.line("grid", [0.0, 1.0], [2.0, 3.0]);
        drawing.rect("rail", [1.0, 2.0], [4.0, 8.0]);
        drawing.text("soft", [1.0, 2.0], 12, Anchor::End, "<b>");
        drawing.upwards("", [1.0, 2.0], 12, "&");
        let clipper = (SurveyAlgorithm::Vw, SurveyTier::PlainF64);
        drawing.link("there", [1.0, 2.0], |drawing| {
            drawing.group("any", |drawing| {
                drawing.mark(clipper, [1.0, 2.0], 3.0, "1 < 2");
            });
        });
        let text = drawing.finish();
        let document = Document::parse(&text).unwrap();
        assert_eq!(
            document.root_element().attribute("aria-label"),
            Some("a \"<&>\"")
        );
        assert!(text.contains("width=\"3.0\" height=\"6.0\"") && text.contains("&lt;b&gt;"));
        let mark = "<circle class=\"plain m\" cx=\"1.0\" cy=\"2.0\" r=\"3.0\">\
                    <title>1 &lt; 2</title></circle>";
        assert!(text.contains(mark), "{text}");
    }
}
