//! The coefficients of the faces' boundary functions, to 106 bits and with a bound on their error.
//!
//! They are those of [`boundary`](super::boundary), as linear functions in the world: with frame coordinates
//! `x_k = a_k . p - a_k . o`, D = z_far - z_near and a side's bound going from n at the near to f
//! at the far end,
//! ```text
//! near    +- (a_z . p - a_z . o - z_near)          far the same, with z_far
//! side    +- (D (a_x . p - a_x . o - n) - (f - n) (a_z . p - a_z . o - z_near))
//! ```
//! with D = 1 and the slope for f - n in an infinite frustum, and neither where f = n.

use crate::exact::ball::{Ball, dot};
use crate::frustum::{Face, Shape};
use crate::math::{Pose, Vec3};

/// What the faces' coefficients have in common.
pub(super) struct FaceCoefficients<'a> {
    shape: &'a Shape,
    axes: [[Ball; 3]; 3],
    /// The axes' inner products with the origin.
    at_origin: [Ball; 3],
}

fn balls(v: Vec3<f64>) -> [Ball; 3] {
    v.to_array().map(Ball::from)
}

impl<'a> FaceCoefficients<'a> {
    pub(super) fn new(pose: &Pose, shape: &'a Shape) -> Self {
        let axes = pose.axes.map(balls);
        let origin = balls(pose.origin);
        Self {
            shape,
            axes,
            at_origin: axes.map(|axis| dot(&axis, &origin)),
        }
    }

    /// A face's normal and offset.
    pub(super) fn of(&self, face: Face) -> [Ball; 4] {
        let near = self.shape.near();
        let is_reversed = self.shape.direction().sign() < 0.0;
        let (axis, side) = match face {
            Face::Near => return signed(self.plane(2, near.z), is_reversed),
            Face::Far => {
                let z = self.shape.far().map_or(near.z, |far| far.z);
                return signed(self.plane(2, z), !is_reversed);
            }
            Face::Left => (0, 0),
            Face::Right => (0, 1),
            Face::Bottom => (1, 2),
            Face::Top => (1, 3),
        };
        let n = near.rect.to_array()[side];
        let across = self.plane(axis, n);
        let (factor, growth) = match self.shape {
            Shape::Finite { far, .. } => (
                Ball::difference(far.z, near.z),
                Ball::difference(far.rect.to_array()[side], n),
            ),
            Shape::Infinite { slopes, .. } => {
                let slope = slopes.to_array()[side];
                let slope = if is_reversed { -slope } else { slope };
                (Ball::from(1.0), Ball::from(slope))
            }
        };
        let is_upper = side % 2 == 1;
        if growth.is_zero() {
            return signed(across, is_upper);
        }
        let depth = self.plane(2, near.z);
        let low = std::array::from_fn(|i| factor * across[i] - growth * depth[i]);
        let is_finite = matches!(self.shape, Shape::Finite { .. });
        signed(low, is_upper != (is_finite && is_reversed))
    }

    /// `a_k . (p - o) - at`.
    fn plane(&self, k: usize, at: f64) -> [Ball; 4] {
        let [x, y, z] = self.axes[k];
        [x, y, z, -(self.at_origin[k] + Ball::from(at))]
    }
}

fn signed(coefficients: [Ball; 4], is_negative: bool) -> [Ball; 4] {
    if is_negative {
        coefficients.map(|n| -n)
    } else {
        coefficients
    }
}
