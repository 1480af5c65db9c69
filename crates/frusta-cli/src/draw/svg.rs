//! The writer of SVG: the one place that knows the format's syntax.
//!
//! An [`Svg`] is a document or a part of one. [`Svg::element`] begins an element; its attributes
//! follow, and then what ends it: [`Element::empty`], [`Element::text`], or [`Element::open`] for an
//! element with children, which [`Svg::close`] ends.

use std::fmt::{self, Display, Write};

/// SVG in the making.
pub(crate) struct Svg {
    text: String,
    /// Written after each element, so that files can be read by people.
    line_end: &'static str,
}

impl Svg {
    /// Nothing yet; each element will have a line of its own.
    pub(crate) fn new() -> Self {
        Self {
            text: String::new(),
            line_end: "\n",
        }
    }

    /// Nothing yet; all elements will be in one line, as Markdown needs it.
    pub(crate) fn in_one_line() -> Self {
        Self {
            line_end: "",
            ..Self::new()
        }
    }

    /// Begins an element.
    pub(crate) fn element(&mut self, name: &'static str) -> Element<'_> {
        self.text.push('<');
        self.text.push_str(name);
        Element { svg: self, name }
    }

    /// Begins the outermost element, without a size.
    pub(crate) fn document(&mut self) -> Element<'_> {
        let svg = self.element("svg");
        svg.attribute("xmlns", "http://www.w3.org/2000/svg")
    }

    /// Appends text to an element that [`Element::begin`] began.
    pub(crate) fn text(&mut self, text: &str) {
        push_text(text, &mut self.text);
    }

    /// Ends an element with children.
    pub(crate) fn close(&mut self, name: &str) {
        self.text.push_str("</");
        self.text.push_str(name);
        self.text.push('>');
        self.text.push_str(self.line_end);
    }

    /// Appends another part.
    pub(crate) fn append(&mut self, part: &Self) {
        self.text.push_str(&part.text);
    }

    /// The text.
    pub(crate) fn finish(self) -> String {
        self.text
    }
}

/// An element whose attributes are being written.
#[must_use = "an element must be ended"]
pub(crate) struct Element<'a> {
    svg: &'a mut Svg,
    name: &'static str,
}

impl Element<'_> {
    /// Appends an attribute.
    pub(crate) fn attribute(self, name: &str, value: impl Display) -> Self {
        let text = &mut self.svg.text;
        text.push(' ');
        text.push_str(name);
        text.push_str("=\"");
        // Writing into memory cannot fail.
        let _ = write!(Value(text), "{value}");
        text.push('"');
        self
    }

    /// Appends an attribute if there is a value for it.
    pub(crate) fn attribute_if(self, name: &str, value: Option<impl Display>) -> Self {
        match value {
            Some(value) => self.attribute(name, value),
            None => self,
        }
    }

    /// Appends the attributes of a rectangle: its corner, its width and height.
    pub(crate) fn rectangle(self, [x, y]: [impl Display; 2], size: [impl Display; 2]) -> Self {
        let [width, height] = size;
        let corner = self.attribute("x", x).attribute("y", y);
        corner.attribute("width", width).attribute("height", height)
    }

    /// Appends attributes that several elements share.
    pub(crate) fn with(self, attributes: impl FnOnce(Self) -> Self) -> Self {
        attributes(self)
    }

    /// Ends an element without content.
    pub(crate) fn empty(self) {
        self.svg.text.push_str("/>");
        self.svg.text.push_str(self.svg.line_end);
    }

    /// Ends an element whose content is a text.
    pub(crate) fn text(self, text: &str) {
        let name = self.name;
        let svg = self.begin();
        svg.text(text);
        svg.close(name);
    }

    /// The same for an element inside a text, where a line end would be a space.
    pub(crate) fn span(self, text: &str) {
        let name = self.name;
        let svg = self.begin();
        svg.text(text);
        svg.text.push_str("</");
        svg.text.push_str(name);
        svg.text.push('>');
    }

    /// Ends the attributes of an element with children.
    pub(crate) fn open(self) {
        self.svg.text.push('>');
        self.svg.text.push_str(self.svg.line_end);
    }
}

impl<'a> Element<'a> {
    /// Ends the attributes of an element whose content is text and spans.
    pub(crate) fn begin(self) -> &'a mut Svg {
        self.svg.text.push('>');
        self.svg
    }
}

/// Writes the value of an attribute.
struct Value<'a>(&'a mut String);

impl fmt::Write for Value<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let mut rest = text;
        while let Some(at) = rest.find(['&', '<', '>', '"']) {
            self.0.push_str(&rest[..at]);
            self.0.push_str(match rest.as_bytes()[at] {
                b'&' => "&amp;",
                b'<' => "&lt;",
                b'>' => "&gt;",
                _ => "&quot;",
            });
            rest = &rest[at + 1..];
        }
        self.0.push_str(rest);
        Ok(())
    }
}

/// Appends text that stands between tags. Control characters and noncharacters, which XML does not
/// allow, become spaces.
fn push_text(text: &str, out: &mut String) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '\u{fffe}' | '\u{ffff}' => out.push(' '),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_with_attributes_text_and_children() {
        let mut svg = Svg::new();
        svg.document().attribute("width", 4).open();
        let text = svg
            .element("text")
            .attribute("x", format_args!("{:.1}", 2.0));
        let line = text.begin();
        line.element("tspan")
            .attribute_if("fill", Some("a\"b"))
            .span("1 < 2");
        line.text(" & more");
        line.close("text");
        svg.element("g").attribute_if("fill", None::<&str>).empty();
        svg.close("svg");
        assert_eq!(
            svg.finish(),
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\">\n\
             <text x=\"2.0\"><tspan fill=\"a&quot;b\">1 &lt; 2</tspan> &amp; more</text>\n\
             <g/>\n</svg>\n"
        );
        let mut line = Svg::in_one_line();
        line.element("rect").empty();
        line.element("rect").empty();
        assert_eq!(line.finish(), "<rect/><rect/>");
    }

    #[test]
    fn text_is_escaped() {
        let mut svg = Svg::new();
        svg.text("a<b>&\u{7}c\u{ffff}");
        assert_eq!(svg.finish(), "a&lt;b&gt;&amp; c ");
    }
}
