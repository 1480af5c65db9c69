//! Vectors of exact numbers.

use super::dyadic::Dyadic;
use crate::math::Vec3;

pub(crate) type Vector = [Dyadic; 3];

/// The exact coordinates of a vector; a number that is not finite counts as zero.
pub(crate) fn exact_point(p: Vec3<f64>) -> Vector {
    p.to_array().map(exact)
}

pub(crate) fn exact(value: f64) -> Dyadic {
    Dyadic::from_f64(value).unwrap_or_else(Dyadic::zero)
}

/// Brings all coordinates over one power of two. Sums of them, and of their products, then
/// need no shifts, which would take most of the time.
pub(crate) fn align(vectors: &mut [Vector]) {
    let exponents = vectors.iter().flatten().filter_map(Dyadic::exponent);
    if let Some(least) = exponents.min() {
        for c in vectors.iter_mut().flatten() {
            *c = c.over_power(least);
        }
    }
}

/// The inner product. It skips zeros, because many vectors here are along an axis.
pub(crate) fn dot(a: &Vector, b: &Vector) -> Dyadic {
    let factors = a.iter().zip(b);
    factors
        .filter(|(a, b)| !a.is_zero() && !b.is_zero())
        .map(|(a, b)| a * b)
        .reduce(|sum, term| sum + term)
        .unwrap_or_else(Dyadic::zero)
}

pub(crate) fn cross([a, b, c]: &Vector, [d, e, f]: &Vector) -> Vector {
    let minor = |a: &Dyadic, b: &Dyadic, c: &Dyadic, d: &Dyadic| &(a * b) - &(c * d);
    [minor(b, f, c, e), minor(c, d, a, f), minor(a, e, b, d)]
}

pub(crate) fn plus([a, b, c]: &Vector, [d, e, f]: &Vector) -> Vector {
    [a + d, b + e, c + f]
}

pub(crate) fn minus([a, b, c]: &Vector, [d, e, f]: &Vector) -> Vector {
    [a - d, b - e, c - f]
}

pub(crate) fn times(a: &Vector, factor: &Dyadic) -> Vector {
    a.each_ref().map(|c| c * factor)
}

/// The combination of three vectors with these coefficients.
pub(crate) fn combine(coefficients: &Vector, [a, b, c]: &[Vector; 3]) -> Vector {
    [0, 1, 2].map(|j| dot(coefficients, &[a[j].clone(), b[j].clone(), c[j].clone()]))
}

pub(crate) fn is_zero(a: &Vector) -> bool {
    a.iter().all(Dyadic::is_zero)
}
