//! The place of a point between opposite faces, with exact signs.
//!
//! For each of the three pairs of faces with values a and b (see the
//! [filter](crate::frustum::eval::filter)) the place is a / (a + b). Rounded values serve where they
//! are certain of both signs. Otherwise a value is computed in double-double, and if that is 0 or close to
//! it, exactly. Where the filter does not apply at all, the quotients are formed from exact values, too.
//! a + b, the distance between the faces, is positive in front of the eye. For a point of the
//! frustum that is certain; outside of it, within rounding of the eye's plane, its sign is not.
//!
//! # Error
//! A rounded value errs by e = 9.2 u s at most, s the filter's scale. For A, B >= 0,
//! ```text
//! |(A + e1) / (A + B + e1 + e2) - A / (A + B)| = |e1 B - e2 A| / ((A + B) (A + B + e1 + e2)) <= e / (a + b)
//! ```
//! The sum and the quotient add 2 u of a quotient of at most 1/2, the window's extent, the product and the
//! last sum 2 u of the extent and u of the greater side. The quotient is taken from the nearer side: it is 0 on
//! the side, and otherwise an image between the sides stays there, because half of the extent
//! is far less than what is left.

use super::Projector;
use crate::exact::Number;
use crate::exact::dyadic::Dyadic;
use crate::exact::expansion::{Expansion, in_safe_range};
use crate::exact::float::exp2;
use crate::frustum::eval::boundary::boundary;
use crate::frustum::eval::exact_vec::Rounded;
use crate::frustum::eval::filter::{DOUBLE_DOUBLE_ERROR_PER_THRESHOLD, Filter};
use crate::frustum::{Face, Frustum, General, Shape};
use crate::math::Vec3;
use std::cmp::Ordering;

/// The values of two opposite faces, with the exact signs, up to a common positive factor.
type Pair = [f64; 2];

/// The pairs in the order of a result's coordinates.
const PAIRS: [[Face; 2]; 3] = [
    [Face::Left, Face::Right],
    [Face::Bottom, Face::Top],
    [Face::Near, Face::Far],
];

impl Projector {
    /// The image of a finite point.
    #[inline]
    pub(super) fn image(&self, p: Vec3<f64>) -> Option<Vec3<f64>> {
        let filter = self.frustum.filter();
        let ([near, far, left, right, bottom, top], size) = match self.frustum.shape() {
            Shape::Finite { .. } => filter.values_at::<General<true>, f64>(p),
            Shape::Infinite { .. } => filter.values_at::<General<false>, f64>(p),
        };
        let pairs = [[left, right], [bottom, top], [near, far]];
        let is_certain = |[a, b]: Pair, threshold: f64| a.abs() > threshold && b.abs() > threshold;
        let (across, along) = filter.thresholds(size);
        if is_certain(pairs[0], across)
            && is_certain(pairs[1], across)
            && is_certain(pairs[2], along)
            && filter.covers(size)
        {
            self.image_of(pairs, self.depth)
        } else {
            self.image_close_to_a_face(p, pairs, size)
        }
    }

    /// The image of a point with these values, those of near and far with this sum.
    #[inline(always)]
    fn image_of(&self, [x, y, z]: [Pair; 3], depth: f64) -> Option<Vec3<f64>> {
        let (z, depth) = self.eye.depths(z, depth);
        let values = [(x, x[0] + x[1]), (y, y[0] + y[1]), (z, depth)];
        // Written so that NaN fails.
        if !values.iter().all(|&(_, sum)| sum > 0.0) {
            return None;
        }
        let image = std::array::from_fn(|axis| {
            let ([a, b], sum) = values[axis];
            // From the nearer side, so that both ends are exact; looked up, because a branch on it
            // would be mispredicted half of the time.
            let side = usize::from(b < a);
            let (from, extent) = self.sides[axis][side];
            from + extent * ([a, b][side] / sum)
        });
        let image = Vec3::from(image);
        image.is_finite().then_some(image)
    }

    /// As [`Projector::image`], where rounded values are not certain of all signs.
    #[cold]
    #[inline(never)]
    fn image_close_to_a_face(
        &self,
        p: Vec3<f64>,
        rounded: [Pair; 3],
        size: f64,
    ) -> Option<Vec3<f64>> {
        let filter = self.frustum.filter();
        if !filter.covers(size) {
            return self.image_of(exact_places(&self.frustum, p)?, 1.0);
        }
        let mut pairs = rounded;
        let (across, along) = filter.thresholds(size);
        for (pair, faces) in pairs.iter_mut().zip(PAIRS) {
            let threshold = if faces[0] == Face::Near {
                along
            } else {
                across
            };
            for (value, face) in pair.iter_mut().zip(faces) {
                if value.abs() <= threshold {
                    *value = value_close_to(&self.frustum, face, p, threshold);
                }
            }
        }
        self.image_of(pairs, self.depth)
    }
}

/// A face's value at a point that is closer to it than the filter's threshold, with the exact sign.
fn value_close_to(frustum: &Frustum, face: Face, p: Vec3<f64>, threshold: f64) -> f64 {
    let filter = frustum.filter();
    let value = filter.precise.value(face as usize, p).hi;
    if value.abs() > DOUBLE_DOUBLE_ERROR_PER_THRESHOLD * threshold {
        return value;
    }
    // Almost always zero.
    if is_zero_by_expansions(filter, frustum, face, p) {
        return 0.0;
    }
    let (value, unit) = exact_value(frustum, face, p);
    rounded_with_sign(&value, &unit)
}

fn is_zero_by_expansions(filter: &Filter, frustum: &Frustum, face: Face, p: Vec3<f64>) -> bool {
    filter.expansions
        && p.to_array().into_iter().all(in_safe_range)
        && boundary::<Expansion>(frustum, face, p).is_ok_and(|v| v.sign() == Ordering::Equal)
}

/// A quotient, rounded, but not to zero.
fn rounded_with_sign(value: &Dyadic, unit: &Dyadic) -> f64 {
    let rounded = value.ratio(unit);
    match value.sign() {
        Ordering::Greater => rounded.max(exp2(-1074)),
        Ordering::Less => rounded.min(-exp2(-1074)),
        Ordering::Equal => 0.0,
    }
}

/// A face's boundary value, and the boundary value of a point at distance 1.
fn exact_value(frustum: &Frustum, face: Face, p: Vec3<f64>) -> (Dyadic, Dyadic) {
    let Ok(value) = boundary::<Dyadic>(frustum, face, p);
    (value, unit_of(frustum.shape(), face))
}

/// What a boundary function is a multiple of: the depth, for a side that slopes.
fn unit_of(shape: &Shape, face: Face) -> Dyadic {
    match shape {
        Shape::Finite { near, far } if shape.constant_coordinate(face).is_none() => {
            (&Dyadic::from(far.z) - &Dyadic::from(near.z)).abs()
        }
        _ => 1.0.into(),
    }
}

/// The exact values of two opposite faces, by a common factor.
fn exact_pair(frustum: &Frustum, [low, high]: [Face; 2], p: Vec3<f64>) -> [Dyadic; 2] {
    let [(a, a_unit), (b, b_unit)] = [low, high].map(|face| exact_value(frustum, face, p));
    [&a * &b_unit, &b * &a_unit]
}

/// The places of a point by exact values, as values whose sum is 1. (For near and far of an infinite
/// frustum, the values themselves.)
fn exact_places(frustum: &Frustum, p: Vec3<f64>) -> Option<[Pair; 3]> {
    let mut places = [[0.0; 2]; 3];
    for (place, faces) in places.iter_mut().zip(PAIRS) {
        let [a, b] = exact_pair(frustum, faces, p);
        if faces[1] == Face::Far && frustum.shape().far().is_none() {
            *place = [
                rounded_with_sign(&a, &1.0.into()).clamp(-f64::MAX, f64::MAX),
                1.0,
            ];
            continue;
        }
        let sum = &a + &b;
        if sum.sign() != Ordering::Greater {
            return None;
        }
        *place = [a, b].map(|v| rounded_with_sign(&v, &sum));
    }
    Some(places)
}
