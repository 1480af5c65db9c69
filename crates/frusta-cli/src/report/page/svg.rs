//! Building SVG: the few elements that the charts consist of.
//!
//! Classes carry all colours and line widths: see `style`.

use crate::draw::escaped;
use std::fmt::Write;

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
#[derive(Debug)]
pub(super) struct Svg(String);

impl Svg {
    /// An empty drawing of a size; `label` is read to those who cannot see it.
    pub(super) fn new([width, height]: [f64; 2], label: &str) -> Self {
        let label = escaped(label).replace('"', "&quot;");
        Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"panel\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{label}\">\n"
        ))
    }

    /// Markup as it is.
    pub(super) fn raw(&mut self, markup: &str) {
        self.0.push_str(markup);
    }

    /// A line.
    pub(super) fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        // Writing into memory cannot fail, here and below.
        let _ = writeln!(
            self.0,
            "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        );
    }

    /// A rectangle from its upper left to its lower right corner.
    pub(super) fn rect(&mut self, class: &str, [x, y]: [f64; 2], [right, bottom]: [f64; 2]) {
        let (width, height) = (right - x, bottom - y);
        let _ = writeln!(
            self.0,
            "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>"
        );
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
        let (anchor, text) = (anchor.name(), escaped(text));
        let _ = writeln!(
            self.0,
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" \
             text-anchor=\"{anchor}\">{text}</text>"
        );
    }

    /// A line of text that runs upwards, its middle at a position.
    pub(super) fn upwards(&mut self, class: &str, [x, y]: [f64; 2], size: u32, text: &str) {
        let text = escaped(text);
        let _ = writeln!(
            self.0,
            "<text class=\"{class}\" transform=\"translate({x:.1} {y:.1}) rotate(-90)\" \
             font-size=\"{size}\" text-anchor=\"middle\">{text}</text>"
        );
    }

    /// The markup.
    pub(super) fn finish(self) -> String {
        self.0 + "</svg>"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use resvg::usvg::roxmltree::Document;

    #[test]
    fn drawings_are_well_formed() {
        let mut svg = Svg::new([10.0, 20.0], "a \"<&>\"");
        svg.line("grid", [0.0, 1.0], [2.0, 3.0]);
        svg.rect("rail", [1.0, 2.0], [4.0, 8.0]);
        svg.text("soft", [1.0, 2.0], 12, Anchor::End, "<b>");
        svg.upwards("", [1.0, 2.0], 12, "&");
        let text = svg.finish();
        let document = Document::parse(&text).unwrap();
        assert_eq!(
            document.root_element().attribute("aria-label"),
            Some("a \"<&>\"")
        );
        assert!(text.contains("width=\"3.0\" height=\"6.0\"") && text.contains("&lt;b&gt;"));
    }
}
