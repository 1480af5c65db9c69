//! Error-free transformations: a rounded result and its rounding error.
//!
//! Sources: Dekker (1971), Knuth (TAOCP 2, 4.2.2), Shewchuk (1997). They are exact
//! unless something overflows or the low part of a product underflows. None uses a
//! fused multiply-add, so the bits are the same on every machine.

#[cfg(all(target_arch = "x86", not(target_feature = "sse2")))]
compile_error!("x87 registers have more bits than an f64: frusta needs SSE2 on 32-bit x86");

use std::ops::{Add, Mul, Sub};
use wide::f64x2;

/// An `f64`, or several side by side in a vector register: every operation acts
/// on each, with the same bits.
pub(crate) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// The same value in each lane.
    fn splat(self, value: f64) -> Self;

    /// Magnitudes.
    fn abs(self) -> Self;

    /// The exact rounding error of the product `p = a * b`, given the halves of `a`,
    /// which is `self`.
    #[inline(always)]
    fn product_rest(self, (ah, al): (Self, Self), b: Self, p: Self) -> Self {
        let (bh, bl) = split(b);
        al * bl - (((p - ah * bh) - al * bh) - ah * bl)
    }
}

impl Lanes for f64 {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
}

impl Lanes for f64x2 {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        f64x2::splat(value)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
}

/// A register width of N lanes.
pub(crate) trait Width<const N: usize>: Copy {
    /// The register type.
    type Lanes: Lanes;

    /// A register of these values.
    fn lanes(self, values: [f64; N]) -> Self::Lanes;
}

/// One lane.
#[derive(Clone, Copy)]
pub(crate) struct Single;

impl Width<1> for Single {
    type Lanes = f64;

    #[inline(always)]
    fn lanes(self, [value]: [f64; 1]) -> f64 {
        value
    }
}

/// Two lanes.
#[derive(Clone, Copy)]
pub(crate) struct Pair;

impl Width<2> for Pair {
    type Lanes = f64x2;

    #[inline(always)]
    fn lanes(self, values: [f64; 2]) -> f64x2 {
        f64x2::new(values)
    }
}

/// `a + b` rounded, and the rounding error: `s + e = a + b`.
#[inline(always)]
pub(crate) fn two_sum<F: Lanes>(a: F, b: F) -> (F, F) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// As [`two_sum`], for `|a| >= |b|` or `a = 0`.
#[inline(always)]
pub(crate) fn fast_two_sum<F: Lanes>(a: F, b: F) -> (F, F) {
    let s = a + b;
    (s, b - (s - a))
}

/// `a - b` rounded, and the rounding error.
#[inline(always)]
pub(crate) fn two_diff<F: Lanes>(a: F, b: F) -> (F, F) {
    let s = a - b;
    let bb = s - a;
    (s, (a - (s - bb)) - (b + bb))
}

/// 2^27 + 1, which splits 53 bits into 26 and 26 with a sign.
const SPLITTER: f64 = 134_217_729.0;

/// The upper and the lower half of the significand, as two values whose sum is `a`.
#[inline(always)]
pub(crate) fn split<F: Lanes>(a: F) -> (F, F) {
    let c = a.splat(SPLITTER) * a;
    let high = c - (c - a);
    (high, a - high)
}

/// `a * b` rounded, and the rounding error: `p + e = a * b`.
#[inline(always)]
pub(crate) fn two_prod<F: Lanes>(a: F, b: F) -> (F, F) {
    two_prod_split(a, split(a), b)
}

/// As [`two_prod`], given the halves of `a`.
#[inline(always)]
pub(crate) fn two_prod_split<F: Lanes>(a: F, halves: (F, F), b: F) -> (F, F) {
    let p = a * b;
    (p, a.product_rest(halves, b, p))
}

/// The exponent of the lowest set bit; `None` for zero.
pub(crate) fn lowest_bit(value: f64) -> Option<i32> {
    let (mantissa, exponent) = decompose(value);
    (mantissa != 0).then(|| exponent + mantissa.trailing_zeros().cast_signed())
}

/// The magnitude of a finite value as `mantissa * 2^exponent`.
pub(crate) fn decompose(value: f64) -> (u64, i32) {
    let bits = value.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    let biased = i32::try_from((bits >> 52) & 0x7ff).unwrap_or(0);
    if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, biased - 1075)
    }
}

/// The least exponent whose power of two exceeds a positive normal value.
pub(crate) fn exponent_above(value: f64) -> i32 {
    decompose(value).1 + 53
}

/// 2 to an integer power; 0 below the subnormals, infinite above the range.
pub(crate) const fn exp2(exponent: i32) -> f64 {
    match exponent {
        1024.. => f64::INFINITY,
        -1022.. => f64::from_bits(((exponent + 1023) as u64) << 52),
        -1074.. => f64::from_bits(1 << (exponent + 1074)),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_products_lose_nothing() {
        let (s, e) = two_sum(1e16, 1.5);
        assert_eq!((s, e), (1e16 + 2.0, -0.5));
        let a = 1.0 + f64::EPSILON;
        let (p, e) = two_prod(a, a);
        assert_eq!(
            (p, e),
            (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON)
        );
        assert_eq!(two_diff(1.0, 1e-30), (1.0, -1e-30));
    }

    #[test]
    fn values_are_decomposed() {
        assert_eq!(lowest_bit(0.0), None);
        assert_eq!(lowest_bit(-6.0), Some(1));
        assert_eq!(lowest_bit(5e-324), Some(-1074));
        assert_eq!(decompose(-1.0), (1 << 52, -52));
        assert_eq!((exponent_above(1.0), exponent_above(0.99)), (1, 0));
        for e in -1074..1024 {
            assert_eq!(lowest_bit(exp2(e)), Some(e));
        }
        assert_eq!((exp2(-1075), exp2(1024)), (0.0, f64::INFINITY));
    }
}
