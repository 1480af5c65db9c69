//! A frustum's half spaces in registers: values and what they may be off.
//!
//! # The error bound
//! A value is off by less than 5.01 u S + 4.01 u |d| (see `batch/boxes.rs`), and the
//! threshold has 8 of each; S here is the sum of both ends' magnitudes. Beside that it has
//! what the filter of a segment alone would ask for (`Filter::certain_beyond`), so
//! that what is certain here is certain there, and constructed by the same rule.
//!
//! A crossing's parameter `a / (a - b)`, of values with different signs each off by E at
//! most, is off by `E / |a - b|` and three roundings, which [`ROUNDINGS`] covers.

use crate::frustum::filter::Filter;
use crate::math::Real;
use crate::volume::{Row, Rows};
use fearless_simd::prelude::*;

/// How many u a parameter's own operations are off, more than enough.
const ROUNDINGS: f64 = 16.0;

/// A half space `n . p + d`, everywhere the same.
#[derive(Clone, Copy)]
struct Plane<V> {
    normal: [V; 3],
    offset: V,
}

impl<V: Copy> Plane<V> {
    #[inline(always)]
    fn value<S: Simd, T>(&self, p: &[V; 3], offset: V) -> V
    where
        V: SimdFloat<S, Element = T>,
    {
        let [x, y, z] = self.normal;
        p[0].mul_add(x, p[1].mul_add(y, p[2].mul_add(z, offset)))
    }
}

/// What one frustum needs, in each lane.
#[derive(Clone, Copy)]
pub(super) struct Planes<V> {
    near: Plane<V>,
    far: V,
    sides: [Plane<V>; 4],
    factor: V,
    constant: V,
    limit: V,
    /// What parameters are off beside what values are.
    rounding: V,
    pub(super) zero: V,
    pub(super) one: V,
    /// The faces' numbers.
    pub(super) numbers: [V; 6],
}

/// The six faces' values at both ends of a register of segments.
pub(super) struct Values<V> {
    pub(super) start: [V; 6],
    pub(super) end: [V; 6],
    /// How far from zero a value's sign is certain.
    pub(super) threshold: V,
    size: V,
}

impl<V: Copy> Planes<V> {
    #[inline(always)]
    pub(super) fn new<S, T>(simd: S, rows: &Rows<T>, filter: &Filter) -> Self
    where
        S: Simd,
        T: Real,
        V: SimdFloat<S, Element = T>,
    {
        let all = |v: T| V::splat(simd, v);
        let plane = |row: &Row<T>| Plane {
            normal: [all(row.normal[0]), all(row.normal[1]), all(row.normal[2])],
            offset: all(row.offset),
        };
        let [a, b, c, d] = &rows.sides;
        let beyond = filter.certain_beyond();
        let up = |v: f64| T::from_f64(v).next_up();
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
            numbers: [
                all(T::ZERO),
                all(T::ONE),
                all(T::from_f64(2.0)),
                all(T::from_f64(3.0)),
                all(T::from_f64(4.0)),
                all(T::from_f64(5.0)),
            ],
        }
    }

    /// In the order of [`crate::Face::ALL`].
    #[inline(always)]
    fn at<S, T>(&self, p: [V; 3]) -> [V; 6]
    where
        S: Simd,
        T: Real,
        V: SimdFloat<S, Element = T>,
    {
        let along = self.near.value::<S, T>(&p, self.zero);
        let [a, b, c, d] = &self.sides;
        [
            along + self.near.offset,
            self.far - along,
            a.value::<S, T>(&p, a.offset),
            b.value::<S, T>(&p, b.offset),
            c.value::<S, T>(&p, c.offset),
            d.value::<S, T>(&p, d.offset),
        ]
    }

    #[inline(always)]
    pub(super) fn values<S, T>(&self, p: [V; 3], q: [V; 3]) -> Values<V>
    where
        S: Simd,
        T: Real,
        V: SimdFloat<S, Element = T>,
    {
        let size = (p[0].abs() + p[1].abs() + p[2].abs()) + (q[0].abs() + q[1].abs() + q[2].abs());
        Values {
            start: self.at(p),
            end: self.at(q),
            threshold: size.mul_add(self.factor, self.constant),
            size,
        }
    }

    /// What a crossing's parameter is off at most, of the greatest reciprocal of a
    /// difference of values.
    #[inline(always)]
    pub(super) fn error<S, T>(&self, values: &Values<V>, scales: V) -> V
    where
        S: Simd,
        T: Real,
        V: SimdFloat<S, Element = T>,
    {
        values.threshold.mul_add(scales, self.rounding)
    }

    /// Where the error bound holds: everywhere but at sizes near the largest number, and
    /// nowhere for NaN.
    #[inline(always)]
    pub(super) fn covers<S, T>(&self, values: &Values<V>) -> V::Mask
    where
        S: Simd,
        T: Real,
        V: SimdFloat<S, Element = T>,
    {
        values.size.simd_lt(self.limit)
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
