//! A segment in a picture: its parts before, in and behind the frustum, and where it
//! was cut.

use super::canvas::{Canvas, Pen, Place};
use crate::draw::Palette;
use frusta::{Class, SegmentClip};

/// Sizes in pixels.
#[derive(Clone, Copy)]
pub(crate) struct Sizes {
    /// The width of the part inside.
    pub(crate) thick: f64,
    /// The width of the parts outside, and of edges.
    pub(crate) thin: f64,
    /// The radius of a mark.
    pub(crate) mark: f64,
}

impl Sizes {
    /// For the picture of one sample.
    pub(crate) const LARGE: Self = Self {
        thick: 4.0,
        thin: 1.7,
        mark: 5.5,
    };
    /// For a cell of the sheet.
    pub(crate) const SMALL: Self = Self {
        thick: 2.6,
        thin: 1.2,
        mark: 3.2,
    };
}

/// Draws the segment of a clip; `place` gives the place of a parameter, and
/// `shown` the parameters that can be seen.
pub(crate) fn draw(
    canvas: &mut Canvas,
    clip: &SegmentClip<f64>,
    shown: [f64; 2],
    sizes: Sizes,
    place: impl Fn(f64) -> Place,
) {
    let palette = canvas.palette;
    let inside = clip.part.as_ref().map(|p| [p.entry.t, p.exit.t]);
    let away = Pen::new(palette.ink, sizes.thin).dashed();
    let [first, last] = inside.unwrap_or([1.0, 1.0]);
    for [from, to] in [[0.0, first], [last, 1.0]] {
        let (from, to) = (from.max(shown[0]), to.min(shown[1]));
        if from < to {
            canvas.line(place(from), place(to), away);
        }
    }
    let colour = palette.classes[clip.class as usize];
    if let Some([from, to]) = inside
        && clip.class != Class::Touch
    {
        canvas.line(place(from), place(to), Pen::new(colour, sizes.thick));
        // A projection along the segment is a point, which a line does not show.
        let ([x0, y0], [x1, y1]) = (place(from), place(to));
        if (x1 - x0).hypot(y1 - y0) < sizes.thick {
            canvas.disc(place(from), 0.9 * sizes.thick, colour);
        }
    }
    let tip = if last == 1.0 && inside.is_some_and(|[from, to]| from < to) {
        colour
    } else {
        palette.ink
    };
    if shown[1] == 1.0 {
        arrow(canvas, place(0.9 * shown[0] + 0.1), place(1.0), sizes, tip);
    }
    marks(canvas, clip, sizes, &place);
}

/// An arrowhead on the segment's end.
fn arrow(canvas: &mut Canvas, from: Place, to: Place, sizes: Sizes, colour: &str) {
    let d = [to[0] - from[0], to[1] - from[1]];
    let length = d[0].hypot(d[1]);
    if length < 1e-6 {
        return;
    }
    let size = 2.4 * sizes.thin + 1.4 * sizes.mark;
    let [x, y] = d.map(|c| c / length * size);
    let base = [to[0] - x, to[1] - y];
    let wing = |side: f64| [base[0] - 0.45 * side * y, base[1] + 0.45 * side * x];
    canvas.polygon(&[to, wing(1.0), wing(-1.0)], colour, 1.0, 0.0);
}

/// A ring where the segment enters, a disc where it leaves; both for a touch.
fn marks(
    canvas: &mut Canvas,
    clip: &SegmentClip<f64>,
    sizes: Sizes,
    place: &impl Fn(f64) -> Place,
) {
    let Some(part) = &clip.part else {
        return;
    };
    let palette = canvas.palette;
    if clip.class == Class::Touch {
        let colour = palette.classes[Class::Touch as usize];
        canvas.disc(place(part.entry.t), sizes.mark * 1.15, colour);
        return;
    }
    if part.entry.clipped {
        let pen = Pen::new(palette.cut, 0.4 * sizes.mark);
        canvas.ring(place(part.entry.t), 0.9 * sizes.mark, pen);
    }
    if part.exit.clipped {
        canvas.disc(place(part.exit.t), 1.1 * sizes.mark, palette.cut);
    }
}

/// The colour of a class's name; grey is too faint for text.
pub(crate) fn class_colour(palette: &Palette, class: Class) -> &'static str {
    match class {
        Class::Outside => palette.ink,
        _ => palette.classes[class as usize],
    }
}
