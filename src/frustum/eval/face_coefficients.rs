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
use crate::frustum::Shape;
use crate::math::{Pose, Vec3};

fn balls(v: Vec3<f64>) -> [Ball; 3] {
    v.to_array().map(Ball::from)
}

/// The normals and offsets of all faces, in the order of [`Face::ALL`](crate::Face::ALL); for a missing far face
/// the near one's, negated.
pub(super) fn all(pose: &Pose, shape: &Shape) -> [[Ball; 4]; 6] {
    let axes = pose.axes.map(balls);
    let origin = balls(pose.origin);
    let at_origin = axes.map(|axis| dot(&axis, &origin));
    // `a_k . (p - o) - at`.
    let plane = |k: usize, at: f64| {
        let [x, y, z] = axes[k];
        [x, y, z, -(at_origin[k] + Ball::from(at))]
    };
    let near = shape.near();
    let far_z = shape.far().map_or(near.z, |far| far.z);
    let is_reversed = shape.direction().sign() < 0.0;
    let depth = plane(2, near.z);
    let mut far = depth;
    far[3] = plane(2, far_z)[3];
    let [left, right] = sides(shape, 0, &axes[0], at_origin[0], &depth);
    let [bottom, top] = sides(shape, 2, &axes[1], at_origin[1], &depth);
    let [near, far] = [signed(depth, is_reversed), signed(far, !is_reversed)];
    [near, far, left, right, bottom, top]
}

/// Two opposite sides, `first` and the next one in the order of a rectangle's; what they share is computed once.
fn sides(
    shape: &Shape,
    first: usize,
    axis: &[Ball; 3],
    at_origin: Ball,
    depth: &[Ball; 4],
) -> [[Ball; 4]; 2] {
    let is_reversed = shape.direction().sign() < 0.0;
    let at_near = shape.near().rect.to_array();
    let (factor, growths) = match shape {
        Shape::Finite { near, far } => {
            let at_far = far.rect.to_array();
            let growth = |side: usize| Ball::difference(at_far[side], at_near[side]);
            (
                Ball::difference(far.z, near.z),
                [growth(first), growth(first + 1)],
            )
        }
        Shape::Infinite { slopes, .. } => {
            let slopes = slopes.to_array();
            let slope = |side: usize| {
                let slope = slopes[side];
                Ball::from(if is_reversed { -slope } else { slope })
            };
            (Ball::from(1.0), [slope(first), slope(first + 1)])
        }
    };
    let across = axis.map(|n| factor * n);
    let is_flipped = is_reversed && matches!(shape, Shape::Finite { .. });
    let shift = |growth: Ball| depth.map(|n| growth * n);
    let low_shift = shift(growths[0]);
    [0, 1].map(|k| {
        let is_upper = k == 1;
        let offset = -(at_origin + Ball::from(at_near[first + k]));
        if growths[k].is_zero() {
            let [x, y, z] = *axis;
            return signed([x, y, z, offset], is_upper);
        }
        let shift = if !is_upper {
            low_shift
        } else if growths[1].is_opposite(growths[0]) {
            low_shift.map(|n| -n)
        } else {
            shift(growths[1])
        };
        let [x, y, z] = across;
        let all = [x, y, z, factor * offset];
        let low = std::array::from_fn(|i| all[i] - shift[i]);
        signed(low, is_upper != is_flipped)
    })
}

fn signed(coefficients: [Ball; 4], is_negative: bool) -> [Ball; 4] {
    if is_negative {
        coefficients.map(|n| -n)
    } else {
        coefficients
    }
}
