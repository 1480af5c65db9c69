//! From world points to places in a picture.
//!
//! A point's place is its place between the frustum's sides at its depth. Where
//! left/right and bottom/top converge at the same depth this is the central
//! projection from the apex, and straight lines stay straight; elsewhere (a
//! sheared frustum) they are drawn as short pieces.

use super::density::LIGHTEST;
use frusta::{Direction, Frustum, Rect, Shape, Vec3};

/// A picture is drawn at most this many times longer than wide.
const MOST_OBLONG: f64 = 8.0;
/// Pieces of a part that may be curved.
const PIECES: u32 = 24;

/// Pixels from the left and from the top of the drawing.
pub(super) type Place = [f32; 2];

/// The projection of a frustum on a rectangle of pixels.
#[derive(Clone, Debug)]
pub(super) struct Projector {
    screen: frusta::Projector,
    /// The frame's depth axis and its offset, so that near is at 0, far at 1.
    depth: (Vec3<f64>, f64),
    /// Width at near, and its change to far.
    widths: [f64; 2],
    pieces: u32,
    size: [f64; 2],
}

impl Projector {
    /// The projection that shows all of a frustum, `longer` pixels along the
    /// longer side.
    pub(super) fn new(frustum: &Frustum, longer: f64) -> Self {
        let (pose, shape) = (*frustum.pose(), frustum.shape());
        let near = shape.near().rect.to_array();
        let (change, s_per_z) = match shape {
            Shape::Finite { near: n, far } => {
                let (depth, far) = (far.z - n.z, far.rect.to_array());
                let change = std::array::from_fn(|i| far[i] - near[i]);
                (change, 1.0 / depth)
            }
            Shape::Infinite {
                slopes, direction, ..
            } => (slopes.to_array(), direction.sign()),
        };
        let extent = |r: &[f64; 4]| [r[1] - r[0], r[3] - r[2]];
        let ([w, h], [dw, dh]) = (extent(&near), extent(&change));
        let straight = (w * dh - h * dw).abs() <= 1e-9 * (w * dh).abs().max((h * dw).abs());
        let [a, b, c] = pose.axes;
        let (right, up) = if w > 0.0 && h > 0.0 {
            (w, h)
        } else {
            (w + dw, h + dh)
        };
        let ratio = (right / a.dot(a).sqrt()) / (up / b.dot(b).sqrt());
        let ratio = if ratio > 0.0 { ratio } else { 1.0 };
        let ratio = ratio.clamp(1.0 / MOST_OBLONG, MOST_OBLONG);
        let size = [longer * ratio.min(1.0), longer / ratio.max(1.0)].map(|s| s.round().max(1.0));
        let [width, height] = size;
        let left_handed = a.dot(b.cross(c)) < 0.0;
        // Seen along +z, a right-handed frame has x to the left.
        let window = if left_handed == (shape.direction() == Direction::PlusZ) {
            Rect::new(0.0, width, height, 0.0)
        } else {
            Rect::new(width, 0.0, height, 0.0)
        };
        let screen = frusta::Projector::new(frustum).onto(window);
        let along = c * s_per_z;
        Self {
            screen: screen.expect("whole pixels"),
            depth: (along, -along.dot(pose.origin) - shape.near().z * s_per_z),
            widths: [w, dw],
            pieces: if straight { 1 } else { PIECES },
            size,
        }
    }

    /// Width and height in whole pixels.
    pub(super) fn size(&self) -> [f64; 2] {
        self.size
    }

    /// A point's place; always within the rectangle.
    pub(super) fn place(&self, point: Vec3<f64>) -> Place {
        let [w, h] = self.size;
        // At an apex, where the sides meet, any place is right.
        let image = self.screen.project(point).ok().flatten();
        let place = image.map_or([0.5 * w, 0.5 * h], |p| {
            [p.x.clamp(0.0, w), p.y.clamp(0.0, h)]
        });
        place.map(|x| x as f32)
    }

    /// A point's place and its scaled depth.
    #[inline]
    fn place_and_depth(&self, point: Vec3<f64>) -> (Place, f64) {
        (self.place(point), self.depth.0.dot(point) + self.depth.1)
    }

    /// The weight of a stroke at a scaled depth: the farther, the less. With
    /// the third power of the distance far strokes fade, although by the second
    /// power more of them share a pixel.
    #[inline]
    fn weight(&self, s: f64) -> f32 {
        let [width, change] = self.widths;
        // In a parallel projection the far end is as if five times as far.
        let distance = if change == 0.0 {
            1.0 + 4.0 * s
        } else {
            1.0 + s * change / width
        };
        let weight = 1.0 / (distance * distance * distance);
        // NaN, at an apex, becomes the least.
        if weight > LIGHTEST {
            weight.min(1.0) as f32
        } else {
            LIGHTEST as f32
        }
    }

    /// Gives the straight pieces of the line between two points, each with its
    /// weight by depth.
    #[inline]
    pub(super) fn pieces(
        &self,
        a: Vec3<f64>,
        b: Vec3<f64>,
        mut piece: impl FnMut(Place, Place, f32),
    ) {
        let (mut from, mut depth) = self.place_and_depth(a);
        for i in 1..=self.pieces {
            let t = f64::from(i) / f64::from(self.pieces);
            let point = if i == self.pieces {
                b
            } else {
                a * (1.0 - t) + b * t
            };
            let (to, next) = self.place_and_depth(point);
            piece(from, to, self.weight(0.5 * (depth + next)));
            (from, depth) = (to, next);
        }
    }
}
