//! A frustum's half spaces in registers: values and what they may be off.
//!
//! # The error bound
//! A value is off by less than 5.01 u S + 4.01 u |d| (see `batch/boxes.rs`), and the
//! threshold has 8 of each; S here is the sum of both ends' magnitudes. Beside that it has
//! what the filter of a segment alone would ask for (`Filter::certain_beyond`), so
//! that what is certain here is certain there, and constructed by the same rule.
//!
//! A crossing's parameter `a / (a - b)`, of values with different signs each off by E at
//! most, is off by `E / |a - b|`, three roundings and what a face's number takes the place of: 17 u
//! of a parameter up to 1, which [`ROUNDINGS`] covers.

use crate::frustum::eval::filter::Filter;
use crate::frustum::eval::planes::FacePlanes;
use crate::math::Real;
use crate::simd::plane_lanes::PlaneLanes;
use fearless_simd::prelude::*;

/// How many u a parameter's own operations are off, more than enough.
const ROUNDINGS: f64 = 32.0;

/// What one frustum needs, in each lane.
pub(super) struct Planes<S: Simd, V: SimdFloat<S>> {
    near: PlaneLanes<V>,
    far: V,
    sides: [PlaneLanes<V>; 4],
    factor: V,
    constant: V,
    limit: V,
    /// What parameters are off beside what values are.
    rounding: V,
    pub(super) zero: V,
    pub(super) one: V,
    /// The faces' numbers.
    numbers: [V::Bits; 6],
    /// A parameter's bits that a face's number takes the place of.
    room: V::Bits,
}

/// How large a register of segments' coordinates are.
pub(super) struct Size<V> {
    /// The sum of the magnitudes of both ends' coordinates.
    pub(super) sum: V,
    /// How far from zero a value's sign is certain.
    pub(super) threshold: V,
}

impl<S: Simd, T: Real, V: SimdFloat<S, Element = T>> Planes<S, V> {
    #[inline(always)]
    pub(super) fn new(simd: S, rows: &FacePlanes<T>, filter: &Filter) -> Self {
        let all = |v: T| V::splat(simd, v);
        let plane = |row| PlaneLanes::new(simd, row);
        let [a, b, c, d] = &rows.sides;
        let beyond = filter.certain_beyond();
        let up = |v: f64| T::from_f64(v).next_up();
        // The least numbers are counted by their bits.
        let bits = |n: usize| all((0..n).fold(T::ZERO, |v, _| v.next_up())).to_bits();
        // Each sum of two is rounded once, the factors have room for it.
        let more = T::ONE + T::from_f64(4.0 * T::UNIT_ROUNDOFF);
        Planes {
            near: plane(&rows.near),
            far: all(rows.far),
            sides: [plane(a), plane(b), plane(c), plane(d)],
            factor: all((rows.factor + up(beyond.factor)) * more),
            constant: all((rows.constant + up(beyond.constant)) * more),
            limit: all(limit::<T>(beyond.limit)),
            rounding: all(T::from_f64(ROUNDINGS * T::UNIT_ROUNDOFF)),
            zero: all(T::ZERO),
            one: all(T::ONE),
            numbers: [0, 1, 2, 3, 4, 5].map(bits),
            room: bits(7),
        }
    }

    /// A parameter with a face's number in its last bits.
    #[inline(always)]
    pub(super) fn numbered(&self, t: V, face: usize) -> V {
        V::from_bits((t.to_bits() & !self.room) | self.numbers[face])
    }

    /// The number of a parameter's face.
    #[inline(always)]
    pub(super) fn number(&self, t: V) -> V::Bits {
        t.to_bits() & self.room
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

    /// What a crossing's parameter is off at most, by the reciprocal of the smallest
    /// difference of values.
    #[inline(always)]
    pub(super) fn error(&self, size: &Size<V>, scale: V) -> V {
        size.threshold.mul_add(scale, self.rounding)
    }

    /// Where the error bound holds: everywhere but at sizes near the largest number, and
    /// nowhere for NaN.
    #[inline(always)]
    pub(super) fn covers(&self, size: &Size<V>) -> V::Mask {
        size.sum.simd_lt(self.limit)
    }
}

/// The sizes for which nothing overflows are less than this.
fn limit<T: Real>(filter: f64) -> T {
    // 2^120
    let most = if T::DIGITS == 24 {
        1.329227995784916e36
    } else {
        f64::INFINITY
    };
    T::from_f64(filter.min(most) * 0.5)
}
