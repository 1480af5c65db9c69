//! line-clipping: a segment by a window in the plane.

use super::{Found, part};
use crate::peer::{Peer, Who};
use crate::scene::Block;
use frusta::Segment;
use line_clipping::cohen_sutherland::clip_line;
use line_clipping::{LineSegment, Point, Window};

/// The crate's Cohen-Sutherland. Segments lie in one plane across the view, where the frustum
/// is the window.
pub struct CohenSutherland2 {
    window: Window,
}

impl CohenSutherland2 {
    /// The window of a box.
    pub fn new(block: &Block) -> Self {
        let ([x0, y0, _], [x1, y1, _]) = (block.min, block.max);
        let window = Window::new(x0, x1, y0, y1);
        Self { window }
    }
}

impl Peer for CohenSutherland2 {
    type Case = Segment<f64>;
    type Input = LineSegment;
    type Output<'a> = Option<LineSegment>;

    fn who(&self) -> Who {
        Who {
            library: "line-clipping",
            function: "cohen_sutherland::clip_line",
            scalar: "f64",
            note: "two dimensions",
        }
    }

    fn prepare(&self, segment: &Segment<f64>) -> LineSegment {
        let [p, q] = [segment.start, segment.end].map(|p| Point::new(p.x, p.y));
        LineSegment::new(p, q)
    }

    fn run(&mut self, line: &LineSegment) -> Option<LineSegment> {
        clip_line(*line, self.window)
    }

    fn answer(&mut self, segment: &Segment<f64>) -> Found<f64> {
        let line = self.prepare(segment);
        match self.run(&line) {
            None => Found::Nothing,
            Some(line) => part(
                segment,
                [line.p1, line.p2].map(|p| [p.x, p.y, segment.start.z]),
            ),
        }
    }
}
