//! Numbers whose sums and products are exact, and correct rounding.
//!
//! Knows numbers, not frusta. Three ways, from fast to general:
//! [`double_double`] (106 bits, small known error), [`expansion`] (exact inside
//! a safe range of exponents, on the stack), [`dyadic`] (exact always, big
//! integers; the only place that allocates).

pub(crate) mod double_double;
pub(crate) mod dyadic;
pub(crate) mod expansion;
pub(crate) mod float;

use std::cmp::Ordering;

/// A number type in which a polynomial can be evaluated without error, or not
/// at all.
pub(crate) trait Number: Sized {
    /// Why there is no result: `Infallible` for a type that has room for all.
    type Overflow;
    /// The value of a double.
    fn from_f64(value: f64) -> Self;
    /// `a - b` of two doubles.
    fn difference(a: f64, b: f64) -> Self;
    /// The sum.
    fn add(&self, other: &Self) -> Result<Self, Self::Overflow>;
    /// The product.
    fn mul(&self, other: &Self) -> Result<Self, Self::Overflow>;
    /// The additive inverse.
    fn neg(self) -> Self;
    /// The order to zero.
    fn sign(&self) -> Ordering;

    /// `self - other`.
    fn sub(&self, other: Self) -> Result<Self, Self::Overflow> {
        self.add(&other.neg())
    }
}
