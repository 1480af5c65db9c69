//! A frustum's half spaces in registers: values, and bounds of their errors.
//!
//! # The error bound
//! A value is off by less than 5.01 u S + 4.01 u |d| (see `cull/many/boxes.rs`), and the
//! threshold has 8 of each; S here is the sum of both ends' magnitudes. The threshold also covers
//! the filter's for a segment alone (`Filter::certain_beyond`), so
//! that what is certain here is certain there, and constructed by the same rule.
//!
//! The error of a crossing's parameter is that of `clip/rules/certificate.rs`: here less than 17 u
//! of a parameter up to 1 besides its values' errors.

use crate::clip::rules::certificate::ROUNDINGS;
use crate::exact::float::exp2;
use crate::frustum::eval::filter::Filter;
use crate::frustum::eval::plane_lanes::PlaneLanes;
use crate::frustum::eval::planes::FacePlanes;
use crate::math::Real;
use fearless_simd::prelude::*;

/// A frustum in each lane.
pub(super) struct FrustumLanes<S: Simd, V: SimdFloat<S>> {
    near: PlaneLanes<V>,
    far: V,
    sides: [PlaneLanes<V>; 4],
    factor: V,
    constant: V,
    limit: V,
    /// Upper bound of a parameter's error besides its values' errors.
    rounding: V,
    pub(super) zero: V,
    pub(super) one: V,
    /// The faces' indices.
    tags: [V::Bits; 6],
    /// The bits of a parameter that a tag takes the place of.
    tag_bits: V::Bits,
}

/// The size of a register of segments.
pub(super) struct Size<V> {
    /// The sum of the magnitudes of both ends' coordinates.
    pub(super) sum: V,
    /// How far from zero a value's sign is certain.
    pub(super) threshold: V,
}

impl<S: Simd, T: Real, V: SimdFloat<S, Element = T>> FrustumLanes<S, V> {
    #[inline(always)]
    pub(super) fn new(simd: S, planes: &FacePlanes<T>, filter: &Filter) -> Self {
        let splat = |v: T| V::splat(simd, v);
        let plane = |plane| PlaneLanes::new(simd, plane);
        let [a, b, c, d] = &planes.sides;
        let beyond = filter.certain_beyond();
        let up = |v: f64| T::from_f64(v).next_up();
        // The n-th smallest positive number has the bits of n.
        let bits = |n: usize| splat((0..n).fold(T::ZERO, |v, _| v.next_up())).to_bits();
        // Covers the rounding of each sum of two.
        let more = T::ONE + T::from_f64(4.0 * T::UNIT_ROUNDOFF);
        FrustumLanes {
            near: plane(&planes.near),
            far: splat(planes.far),
            sides: [plane(a), plane(b), plane(c), plane(d)],
            factor: splat((planes.factor + up(beyond.factor)) * more),
            constant: splat((planes.constant + up(beyond.constant)) * more),
            limit: splat(limit::<T>(beyond.limit)),
            rounding: splat(T::from_f64(ROUNDINGS * T::UNIT_ROUNDOFF)),
            zero: splat(T::ZERO),
            one: splat(T::ONE),
            tags: [0, 1, 2, 3, 4, 5].map(bits),
            tag_bits: bits(7),
        }
    }

    /// A parameter tagged with a face's index: see `clip/rules/certificate.rs`.
    #[inline(always)]
    pub(super) fn tagged(&self, t: V, face: usize) -> V {
        V::from_bits((t.to_bits() & !self.tag_bits) | self.tags[face])
    }

    /// The index of a parameter's face.
    #[inline(always)]
    pub(super) fn face(&self, t: V) -> V::Bits {
        t.to_bits() & self.tag_bits
    }

    /// The values of near and far at a point.
    #[inline(always)]
    pub(super) fn near_far(&self, p: &[V; 3]) -> [V; 2] {
        let along = self.near.along::<S>(p, self.zero);
        [along + self.near.offset, self.far - along]
    }

    /// The value of left, right, bottom or top.
    #[inline(always)]
    pub(super) fn side(&self, side: usize, p: &[V; 3]) -> V {
        let plane = &self.sides[side];
        plane.along::<S>(p, plane.offset)
    }

    #[inline(always)]
    pub(super) fn size(&self, [p, q]: &[[V; 3]; 2]) -> Size<V> {
        let sum = (p[0].abs() + p[1].abs() + p[2].abs()) + (q[0].abs() + q[1].abs() + q[2].abs());
        Size {
            sum,
            threshold: sum.mul_add(self.factor, self.constant),
        }
    }

    /// Upper bound of the error of a crossing's parameter, from the reciprocal of the smallest
    /// difference of values.
    #[inline(always)]
    pub(super) fn error(&self, size: &Size<V>, scale: V) -> V {
        size.threshold.mul_add(scale, self.rounding)
    }

    /// Whether the error bound holds: false at sizes near the largest finite value, and for NaN.
    #[inline(always)]
    pub(super) fn covers(&self, size: &Size<V>) -> V::Mask {
        size.sum.simd_lt(self.limit)
    }
}

/// Upper bound of the sizes for which nothing overflows.
fn limit<T: Real>(filter: f64) -> T {
    let most = if T::DIGITS == 24 {
        exp2(120)
    } else {
        f64::INFINITY
    };
    T::from_f64(filter.min(most) * 0.5)
}
