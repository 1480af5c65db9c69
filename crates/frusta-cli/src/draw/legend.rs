//! The legend of strokes and marks, in a line.

use super::canvas::{Canvas, Font, Pen, Place};
use super::segment::Sizes;
use frusta::Class;

/// The width of a sample.
const SHOWN: f64 = 34.0;

/// Optional entries.
#[derive(Clone, Copy)]
pub(crate) struct Entries {
    /// The highlighted feature.
    pub(crate) feature: bool,
    /// Each class's colour.
    pub(crate) classes: bool,
}

/// Draws the line.
pub(crate) fn draw(canvas: &mut Canvas, [x, y]: Place, size: f64, entries: Entries) {
    let mut row = Row { x, y, size };
    let (palette, sizes) = (canvas.palette, Sizes::LARGE);
    let thin = Pen::new(palette.ink, sizes.thin);
    if entries.feature {
        let [a, b] = row.stroke();
        let within = [[a[0] + 6.0, a[1]], [b[0] - 6.0, b[1]]];
        canvas.line(within[0], within[1], Pen::new(palette.highlight, 12.0));
        canvas.line(within[0], within[1], thin);
        row.name(canvas, "the feature");
    }
    if entries.classes {
        for class in [Class::Boundary, Class::Inside, Class::Cross] {
            let [a, b] = row.stroke();
            let colour = palette.classes[class as usize];
            canvas.line(a, b, Pen::new(colour, sizes.thick));
            row.name(canvas, &format!("part inside: {class}"));
        }
    }
    let touch = palette.classes[Class::Touch as usize];
    canvas.disc(row.middle(), sizes.mark, touch);
    row.name(canvas, "touch");
    canvas.ring(row.middle(), sizes.mark, Pen::new(palette.cut, 2.2));
    row.name(canvas, "cut where it enters");
    canvas.disc(row.middle(), 1.1 * sizes.mark, palette.cut);
    row.name(canvas, "cut where it leaves");
    let [a, b] = row.stroke();
    canvas.line(a, b, thin.dashed());
    row.name(canvas, "outside");
    let [a, b] = row.stroke();
    let faint = Pen::new(palette.classes[0], 0.8 * sizes.thin);
    canvas.line(a, b, faint.dashed());
    row.name(canvas, "hidden edge, or no end");
}

/// Where the next entry begins.
struct Row {
    x: f64,
    y: f64,
    size: f64,
}

impl Row {
    fn stroke(&self) -> [Place; 2] {
        [[self.x, self.y], [self.x + SHOWN, self.y]]
    }

    fn middle(&self) -> Place {
        [self.x + 0.5 * SHOWN, self.y]
    }

    fn name(&mut self, canvas: &mut Canvas, text: &str) {
        let font = Font {
            size: self.size,
            bold: false,
            colour: canvas.palette.ink,
        };
        let baseline = self.y + 0.36 * self.size;
        canvas.text([self.x + SHOWN + 8.0, baseline], text, font);
        // A letter's usual width, and a gap.
        let wide = 0.58 * self.size * text.chars().count() as f64;
        self.x += SHOWN + 8.0 + wide + 1.2 * self.size;
    }
}
