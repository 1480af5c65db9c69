//! Exact placements of the samples in the world.
//!
//! A placement has integer axes `a_k`, orthogonal and of equal squared length N,
//! an origin `o` and a power of two `s`. The image of the point with frame coordinates `c`
//! is `p = o + s (c_0 a_0 + c_1 a_1 + c_2 a_2)`, an integer combination; the pose
//! (o, a_k) has it at `a_k . (p - o) = s N c_k`, so the two rectangles are multiplied by
//! `s N`, and every relation is kept exactly. Integer axes come from integer
//! quaternions: those of the rotation by q, times |q|^2, are integers of squared
//! length |q|^4.

use super::solid::Solid;
use crate::frustum::{EndRect, Frustum, FrustumError, Shape};
use crate::math::{Pose, Rect, Segment, Vec3};

/// A similarity whose coefficients are exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    origin: Vec3<f64>,
    axes: [Vec3<f64>; 3],
    scale: f64,
}

impl Placement {
    /// The identity.
    pub const IDENTITY: Placement = Placement {
        origin: Vec3::new(0.0, 0.0, 0.0),
        axes: Pose::IDENTITY.axes,
        scale: 1.0,
    };

    /// All 48 signed permutations of the coordinates; the first is the identity.
    pub fn signed_permutations() -> Vec<Placement> {
        const ORDERS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ];
        let mut all = Vec::with_capacity(48);
        for order in ORDERS {
            for signs in 0..8_u32 {
                let axes = [0, 1, 2].map(|k| {
                    let mut axis = Vec3::new(0.0, 0.0, 0.0);
                    axis[order[k]] = if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
                    axis
                });
                all.push(Placement {
                    axes,
                    ..Self::IDENTITY
                });
            }
        }
        all
    }

    /// The rotation by an integer quaternion (w, x, y, z), not zero, times its squared
    /// length; entries up to 8 keep samples exact in `f32`.
    pub fn rotated([w, x, y, z]: [i8; 4]) -> Placement {
        let [w, x, y, z] = [w, x, y, z].map(f64::from);
        let axes = [
            Vec3::new(
                w * w + x * x - y * y - z * z,
                2.0 * (x * y + w * z),
                2.0 * (x * z - w * y),
            ),
            Vec3::new(
                2.0 * (x * y - w * z),
                w * w - x * x + y * y - z * z,
                2.0 * (y * z + w * x),
            ),
            Vec3::new(
                2.0 * (x * z + w * y),
                2.0 * (y * z - w * x),
                w * w - x * x - y * y + z * z,
            ),
        ];
        Placement {
            axes,
            ..Self::IDENTITY
        }
    }

    /// The placement with another origin; short integers keep samples exact.
    pub fn moved_to(self, origin: Vec3<f64>) -> Placement {
        Placement { origin, ..self }
    }

    /// The placement multiplied by `2^exponent`, origin included.
    pub fn scaled(self, exponent: i16) -> Placement {
        let factor = 2.0_f64.powi(i32::from(exponent));
        Placement {
            origin: self.origin * factor,
            scale: self.scale * factor,
            ..self
        }
    }

    /// The image of the point with these frame coordinates.
    pub fn point(&self, c: Vec3<f64>) -> Vec3<f64> {
        let [a, b, d] = self.axes;
        self.origin + (a * c.x + b * c.y + d * c.z) * self.scale
    }

    /// The image of a segment.
    pub fn segment(&self, segment: &Segment<f64>) -> Segment<f64> {
        Segment::new(self.point(segment.start), self.point(segment.end))
    }

    /// The image of the frustum with this shape in the identity pose.
    ///
    /// # Errors
    /// Those of [`Frustum::new`]. For a [`Solid`] they occur only if the scaled numbers are out
    /// of range.
    pub fn frustum(&self, shape: &Shape) -> Result<Frustum, FrustumError> {
        let [a, _, _] = self.axes;
        let factor = self.scale * a.dot(a);
        let rect = |r: Rect| {
            let [left, right, bottom, top] = r.to_array().map(|v| v * factor);
            Rect::new(left, right, bottom, top)
        };
        let end = |e: EndRect| EndRect {
            z: e.z * factor,
            rect: rect(e.rect),
        };
        let shape = match *shape {
            Shape::Finite { near, far } => Shape::Finite {
                near: end(near),
                far: end(far),
            },
            // Slopes are ratios of lengths.
            Shape::Infinite {
                near,
                slopes,
                direction,
            } => Shape::Infinite {
                near: end(near),
                slopes,
                direction,
            },
        };
        Frustum::new(Pose::new(self.origin, self.axes), shape)
    }

    /// The image of a solid.
    ///
    /// # Errors
    /// As [`Placement::frustum`].
    pub fn place(&self, solid: &Solid) -> Result<Frustum, FrustumError> {
        self.frustum(&solid.shape)
    }
}
