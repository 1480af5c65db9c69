//! Where segments cross a face: the rule of `clip/exact/points.rs`, four at a time.
//!
//! The rule takes magnitudes A and B of the face's values in double-double. Of singles that
//! precision is hardly ever needed: with the values of doubles, off by E at most, t is off by
//! `E / (A + B)` and some roundings; where both ends of that interval are the same
//! single, so is what the rule gives, which lies in it (Ziv's test). Of doubles nothing could
//! be said so.

use super::open::Open;
use super::run::Asked;
use crate::exact::float::{Lanes, Single};
use crate::frustum::Frustum;
use crate::math::{Real, Segment};
use crate::volume::Rows;
use fearless_simd::f64x4;
use fearless_simd::prelude::*;

/// What t is off beside its values' errors, and the rule's own error of 2.5 u, with some room:
/// 16 u.
const ROUNDINGS: f64 = 1.7763568394002505e-15;

/// Parameters of four segments with certain values of different signs.
#[inline(always)]
pub(super) fn parameters<S: Simd, T: Real>(
    simd: S,
    asked: Asked<'_, T>,
    open: &Open<T>,
    face: usize,
    places: [usize; 4],
) -> [T; 4] {
    if T::DIGITS > 24 {
        let t: [f64; 4] = precisely(simd, asked.frustum, open, face, places).into();
        return [
            T::from_f64(t[0]),
            T::from_f64(t[1]),
            T::from_f64(t[2]),
            T::from_f64(t[3]),
        ];
    }
    let [low, high] = interval(simd, asked.doubles, open, face, places);
    let (low, high): ([f64; 4], [f64; 4]) = (low.into(), high.into());
    let mut found = [
        T::from_f64(low[0]),
        T::from_f64(low[1]),
        T::from_f64(low[2]),
        T::from_f64(low[3]),
    ];
    let open_lanes = (found[0] != T::from_f64(high[0]))
        | (found[1] != T::from_f64(high[1]))
        | (found[2] != T::from_f64(high[2]))
        | (found[3] != T::from_f64(high[3]));
    if open_lanes {
        for (t, place) in found.iter_mut().zip(places) {
            *t = T::from_f64(alone(asked.frustum, &open.segment(place), face));
        }
    }
    found
}

/// By doubles: t is between these.
#[inline(always)]
fn interval<S: Simd, T: Real>(
    simd: S,
    rows: &Rows<f64>,
    open: &Open<T>,
    face: usize,
    places: [usize; 4],
) -> [f64x4<S>; 2] {
    let ([x, y, z], offset) = rows.face(face);
    let p = [
        open.doubles(simd, 0, places),
        open.doubles(simd, 1, places),
        open.doubles(simd, 2, places),
    ];
    let q = [
        open.doubles(simd, 3, places),
        open.doubles(simd, 4, places),
        open.doubles(simd, 5, places),
    ];
    let all = p[0].all(offset);
    let a = p[0].mul_add(x, p[1].mul_add(y, p[2].mul_add(z, all)));
    let b = q[0].mul_add(x, q[1].mul_add(y, q[2].mul_add(z, all)));
    let size = (Lanes::abs(p[0]) + Lanes::abs(p[1]) + Lanes::abs(p[2]))
        + (Lanes::abs(q[0]) + Lanes::abs(q[1]) + Lanes::abs(q[2]));
    let scale = p[0].all(1.0) / (a - b);
    let t = a * scale;
    let error = size.mul_add(rows.factor, p[0].all(rows.constant));
    let error = Lanes::abs(scale).mul_add(error, p[0].all(ROUNDINGS));
    [t - error, t + error]
}

/// The rule.
#[inline(always)]
fn precisely<S: Simd, T: Real>(
    simd: S,
    frustum: &Frustum,
    open: &Open<T>,
    face: usize,
    places: [usize; 4],
) -> f64x4<S> {
    let precise = &frustum.filter().precise;
    let a = precise.magnitude(
        face,
        #[inline(always)]
        |axis| open.doubles(simd, axis, places),
    );
    let b = precise.magnitude(
        face,
        #[inline(always)]
        |axis| open.doubles(simd, axis + 3, places),
    );
    let mut from_end = b.simd_lt(a);
    let ties = a.simd_eq(b);
    if ties.any_true() {
        let lesser = places.map(|place| -i64::from(end_is_lesser(&open.segment(place))));
        from_end |= ties & lesser.simd_into(simd);
    }
    let tau = a.min(b) / (a + b);
    from_end.select(a.all(1.0) - tau, tau)
}

/// The rule, for one.
#[cold]
fn alone<T: Real>(frustum: &Frustum, segment: &Segment<T>, face: usize) -> f64 {
    let precise = &frustum.filter().precise;
    let magnitude = |p| precise.magnitudes(Single, [face], [p]);
    let Segment { start, end } = segment.to_f64();
    let (a, b) = (magnitude(start), magnitude(end));
    let tau = a.min(b) / (a + b);
    if b < a || a == b && end_is_lesser(segment) {
        1.0 - tau
    } else {
        tau
    }
}

/// Whether the end is lexicographically smaller than the start.
#[cold]
fn end_is_lesser<T: Real>(segment: &Segment<T>) -> bool {
    segment.start.to_array() > segment.end.to_array()
}
