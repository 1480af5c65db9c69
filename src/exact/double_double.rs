//! Double-double arithmetic: sums of two `f64`, about 106 bits, with a small relative error.
//!
//! Sources: Dekker (1971); error bounds from Joldes, Muller, Popescu, "Tight
//! and rigorous error bounds for basic building blocks of double-word
//! arithmetic" (2017), with u = 2^-53: `add` 3 u^2 + 13 u^3, `mul` 7 u^2,
//! `mul_f64` 3 u^2, `div` 15 u^2 + 56 u^3, each relative to the result,
//! unless something overflows or underflows. `div` computes its remainder by `add`,
//! no less precisely than theirs; `proofs/double_double.gappa` proves its bound.

use super::float::{fast_two_sum, two_diff, two_prod, two_sum};

/// An unevaluated sum `hi + lo` with `hi` the rounded sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dd {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

impl Dd {
    pub(crate) const fn new(hi: f64, lo: f64) -> Self {
        Dd { hi, lo }
    }

    /// `a - b`, exactly.
    #[inline(always)]
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        let (hi, lo) = two_diff(a, b);
        Dd { hi, lo }
    }

    /// The same value with `hi` the rounded sum.
    #[inline(always)]
    pub(crate) fn normal(self) -> Self {
        let (hi, lo) = two_sum(self.hi, self.lo);
        Dd { hi, lo }
    }

    #[inline(always)]
    pub(crate) fn neg(self) -> Self {
        Dd::new(-self.hi, -self.lo)
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        if self.hi < 0.0 { self.neg() } else { self }
    }

    #[inline(always)]
    pub(crate) fn add(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, other.hi);
        let (t, f) = two_sum(self.lo, other.lo);
        let (s, e) = fast_two_sum(s, e + t);
        let (hi, lo) = fast_two_sum(s, e + f);
        Dd { hi, lo }
    }

    #[inline(always)]
    pub(crate) fn mul(self, other: Self) -> Self {
        let (p, e) = two_prod(self.hi, other.hi);
        let (hi, lo) = fast_two_sum(p, e + (self.hi * other.lo + self.lo * other.hi));
        Dd { hi, lo }
    }

    #[inline(always)]
    pub(crate) fn mul_f64(self, b: f64) -> Self {
        let (p, e) = two_prod(self.hi, b);
        let (hi, lo) = fast_two_sum(p, e + self.lo * b);
        Dd { hi, lo }
    }

    #[inline(always)]
    pub(crate) fn div(self, other: Self) -> Self {
        let q = self.hi / other.hi;
        let rest = self.add(other.mul_f64(-q));
        let (hi, lo) = fast_two_sum(q, rest.hi / other.hi);
        Dd { hi, lo }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_a_hundred_bits() {
        let third = Dd::new(1.0, 0.0).div(Dd::new(3.0, 0.0));
        let one = third.mul_f64(3.0);
        assert!((one.hi - 1.0 + one.lo).abs() < 1e-31);
        let tiny = third.add(third.neg());
        assert_eq!((tiny.hi, tiny.lo), (0.0, 0.0));
        let square = Dd::difference(1.0, 1e-20).mul(Dd::difference(1.0, 1e-20));
        assert_eq!((square.hi, square.lo), (1.0, -2e-20));
        assert_eq!(Dd::new(-2.0, 1e-20).abs(), Dd::new(2.0, -1e-20));
    }
}
