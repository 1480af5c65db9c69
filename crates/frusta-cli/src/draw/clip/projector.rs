//! From world points to places in a picture.
//!
//! A point's place is its place between the frustum's sides at its depth. Where
//! left/right and bottom/top converge at the same depth this is the central
//! projection from the apex, and straight lines stay straight; elsewhere (a
//! sheared frustum) they are drawn as short pieces.

use super::density::LIGHTEST;
use frusta::{Direction, Frustum, Pose, Shape, Vec3};

/// A picture is drawn at most this many times longer than wide.
const MOST_OBLONG: f64 = 8.0;
/// Pieces of a part that may be curved.
const PIECES: u32 = 24;

/// Pixels from the left and from the top of the drawing.
pub(super) type Place = [f32; 2];

/// The projection of a frustum on a rectangle of pixels.
#[derive(Clone, Debug)]
pub(super) struct Projector {
    pose: Pose,
    /// Left, right, bottom, top at the near end, and their change per unit of
    /// `s`, the scaled depth.
    near: [f64; 4],
    change: [f64; 4],
    z: f64,
    s_per_z: f64,
    mirrored: bool,
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
        let left_handed = a.dot(b.cross(c)) < 0.0;
        Self {
            pose,
            near,
            change,
            z: shape.near().z,
            s_per_z,
            // Seen along +z, a right-handed frame has x to the left.
            mirrored: left_handed != (shape.direction() == Direction::PlusZ),
            pieces: if straight { 1 } else { PIECES },
            size: [longer * ratio.min(1.0), longer / ratio.max(1.0)].map(|s| s.round().max(1.0)),
        }
    }

    /// Width and height in whole pixels.
    pub(super) fn size(&self) -> [f64; 2] {
        self.size
    }

    /// A point's place; always within the rectangle.
    pub(super) fn place(&self, point: Vec3<f64>) -> Place {
        self.place_and_depth(point).0
    }

    /// A point's place and its scaled depth.
    #[inline]
    fn place_and_depth(&self, point: Vec3<f64>) -> (Place, f64) {
        let q = self.pose.to_frame(point);
        let s = (q.z - self.z) * self.s_per_z;
        let between = |value: f64, low: usize| {
            let bound = |i: usize| self.near[i] + s * self.change[i];
            let at = (value - bound(low)) / (bound(low + 1) - bound(low));
            // At an apex, where the sides meet, any place is right.
            if at.is_nan() { 0.5 } else { at.clamp(0.0, 1.0) }
        };
        let (u, v) = (between(q.x, 0), between(q.y, 2));
        let u = if self.mirrored { 1.0 - u } else { u };
        let place = [(u * self.size[0]) as f32, ((1.0 - v) * self.size[1]) as f32];
        (place, s)
    }

    /// The weight of a stroke at a scaled depth: the farther, the less. With
    /// the third power of the distance far strokes fade, although by the second
    /// power more of them share a pixel.
    #[inline]
    fn weight(&self, s: f64) -> f32 {
        let (width, change) = (self.near[1] - self.near[0], self.change[1] - self.change[0]);
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
