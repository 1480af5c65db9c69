//! Numbers whose sums and products are exact, and correct rounding.
//!
//! This module knows numbers, not frusta. It has three number types, from fast to general:
//! [`double_double`] (106 bits, small known error), [`expansion`] (exact inside
//! a safe range of exponents, on the stack), [`dyadic`] (always exact, big
//! integers; the only one that allocates).

pub(crate) mod ball;
pub(crate) mod double_double;
pub(crate) mod dyadic;
pub(crate) mod expansion;
pub(crate) mod float;

use std::cmp::Ordering;

/// A number type in which each operation is exact or reports overflow.
pub(crate) trait Number: Sized {
    /// The error for a result that does not fit; `Infallible` for an unbounded type.
    type Overflow;
    /// The value of an `f64`.
    fn from_f64(value: f64) -> Self;
    /// `a - b`.
    fn difference(a: f64, b: f64) -> Self;
    /// The sum.
    fn add(&self, other: &Self) -> Result<Self, Self::Overflow>;
    /// The product.
    fn mul(&self, other: &Self) -> Result<Self, Self::Overflow>;
    /// The additive inverse.
    fn neg(self) -> Self;
    /// The order relative to zero.
    fn sign(&self) -> Ordering;

    /// `self - other`.
    fn sub(&self, other: Self) -> Result<Self, Self::Overflow> {
        self.add(&other.neg())
    }
}
