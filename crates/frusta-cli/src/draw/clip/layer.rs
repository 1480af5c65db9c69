//! The layers of a picture, from the lowest to the topmost, and their looks.
//!
//! Rare layers come after common ones, so that a few clipped edges stay in
//! sight among millions. Besides its colour each layer has a thickness or a
//! shape of its own.

use crate::draw::Palette;
use crate::draw::svg::Element;
use frusta::Class;

/// A kind of stroke or mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layer {
    /// Segments without a point inside.
    Outside,
    /// The parts of clipped segments that were cut away.
    Rest,
    /// Segments inside.
    Inside,
    /// Parts in a face.
    Boundary,
    /// Parts of clipped segments.
    Cross,
    /// Single points on the surface.
    Touch,
    /// Where segments were cut.
    Cut,
}

/// How strokes of a layer look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// `#rrggbb`.
    pub(super) colour: &'static str,
    /// In units of the picture's stroke width.
    pub(super) width: f64,
    /// Lengths of dashes and gaps, in the same unit.
    pub(super) dashes: Option<[f64; 2]>,
    /// From 0 to 1.
    pub(super) opacity: f64,
}

impl Style {
    /// Appends the attributes of a path, for a picture's stroke width.
    pub(super) fn on(self, path: Element<'_>, width: f64) -> Element<'_> {
        let dashes = self.dashes.map(|d| d.map(|d| d * width));
        let stroke = path.attribute("stroke", self.colour);
        stroke
            .attribute("stroke-width", format_args!("{:.1}", self.width * width))
            .attribute_if(
                "stroke-dasharray",
                dashes.map(|[dash, gap]| format!("{dash:.1} {gap:.1}")),
            )
            .attribute_if(
                "stroke-opacity",
                (self.opacity < 1.0).then_some(self.opacity),
            )
    }
}

impl Layer {
    /// All, in the order of drawing.
    pub(super) const ALL: [Layer; 7] = [
        Layer::Outside,
        Layer::Rest,
        Layer::Inside,
        Layer::Boundary,
        Layer::Cross,
        Layer::Touch,
        Layer::Cut,
    ];

    /// Where the parts of a class go.
    #[inline]
    pub(super) fn of(class: Class) -> Self {
        match class {
            Class::Outside => Self::Outside,
            Class::Touch => Self::Touch,
            Class::Boundary => Self::Boundary,
            Class::Inside => Self::Inside,
            Class::Cross => Self::Cross,
        }
    }

    /// The name, as in the file and in the legend.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Outside => "outside",
            Self::Rest => "cut away",
            Self::Inside => "inside",
            Self::Boundary => "boundary",
            Self::Cross => "cross",
            Self::Touch => "touch",
            Self::Cut => "cut points",
        }
    }

    /// Its look.
    pub(super) fn style(self, palette: &Palette) -> Style {
        let [outside, touch, boundary, inside, cross] = palette.classes;
        let (colour, width, dashes, opacity) = match self {
            Self::Outside => (outside, 0.7, Some([2.2, 2.8]), 0.8),
            Self::Rest => (cross, 0.8, Some([4.0, 3.0]), 0.7),
            Self::Inside => (inside, 1.0, None, 1.0),
            Self::Boundary => (boundary, 2.8, None, 1.0),
            Self::Cross => (cross, 1.6, None, 1.0),
            Self::Touch => (touch, 4.5, None, 1.0),
            Self::Cut => (palette.cut, 0.8, None, 1.0),
        };
        Style {
            colour,
            width,
            dashes,
            opacity,
        }
    }
}
