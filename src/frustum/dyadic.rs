//! Exact arithmetic for constructing: integers times powers of two.
//!
//! A double is such a number, and sums and products of them are again, so
//! that a determinant, or a difference of far points, loses nothing; one
//! rounding ends each computation. Used once a frustum, not once a segment,
//! which is why allocating is no concern here. Input must be finite; callers
//! check that first.

use crate::math::Vec3;
use dashu_int::ops::BitTest;
use dashu_int::{IBig, Sign, UBig};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// `integer * 2^exponent`.
#[derive(Clone, Debug)]
pub(super) struct Dyadic {
    integer: IBig,
    exponent: i64,
}

/// Three exact coordinates.
pub(super) type Dyadic3 = [Dyadic; 3];

impl From<f64> for Dyadic {
    fn from(value: f64) -> Self {
        debug_assert!(value.is_finite());
        let bits = value.to_bits();
        let fraction = bits & ((1 << 52) - 1);
        let biased = ((bits >> 52) & 0x7ff) as i64;
        let (magnitude, exponent) = match biased {
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, biased - 1075),
        };
        let zeros = if magnitude == 0 {
            0
        } else {
            magnitude.trailing_zeros()
        };
        let integer = IBig::from(magnitude >> zeros);
        Self {
            integer: if value < 0.0 { -integer } else { integer },
            exponent: exponent + i64::from(zeros),
        }
    }
}

impl Dyadic {
    /// How the number compares with zero.
    pub(super) fn sign(&self) -> Ordering {
        self.integer.cmp(&IBig::ZERO)
    }

    /// The nearest double, ties to even; infinite beyond the range.
    pub(super) fn to_f64(&self) -> f64 {
        self.scaled(0)
    }

    /// The nearest double to `self * 2^shift`.
    fn scaled(&self, shift: i64) -> f64 {
        let (sign, magnitude) = self.integer.clone().into_parts();
        signed(sign, round(&magnitude, self.exponent + shift, false))
    }

    /// The nearest double to `self / other`; infinite if `other` is zero.
    pub(super) fn ratio(&self, other: &Self) -> f64 {
        let (sign, dividend) = self.integer.clone().into_parts();
        let (other_sign, divisor) = other.integer.clone().into_parts();
        if divisor.is_zero() {
            return f64::INFINITY;
        }
        // A quotient of at least 64 bits and whether anything is left over
        // decide every rounding to 53.
        let shift = (64 + divisor.bit_len()).saturating_sub(dividend.bit_len());
        let dividend = dividend << shift;
        let quotient = &dividend / &divisor;
        let rest = dividend - &quotient * &divisor;
        let exponent = self.exponent - other.exponent - shift as i64;
        signed(
            sign * other_sign,
            round(&quotient, exponent, !rest.is_zero()),
        )
    }

    /// The least `e` with `|self| < 2^e`; `None` for zero.
    fn top(&self) -> Option<i64> {
        match self.integer.bit_len() {
            0 => None,
            n => Some(n as i64 + self.exponent),
        }
    }

    /// Both integers over the smaller exponent.
    fn aligned(&self, other: &Self) -> (IBig, IBig, i64) {
        let exponent = self.exponent.min(other.exponent);
        let lift = |d: &Self| &d.integer << (d.exponent - exponent) as usize;
        (lift(self), lift(other), exponent)
    }
}

/// The nearest double to `magnitude * 2^exponent`, a little more if `sticky`;
/// `magnitude` then needs at least 55 bits.
fn round(magnitude: &UBig, exponent: i64, sticky: bool) -> f64 {
    let bits = magnitude.bit_len() as i64;
    if bits == 0 {
        return 0.0;
    }
    if bits + exponent > 1024 {
        return f64::INFINITY;
    }
    // The weight of the result's last bit.
    let last = (bits + exponent - 53).max(-1074);
    let drop = last - exponent;
    let kept: u64 = if drop <= 0 {
        low_word(&(magnitude << (-drop) as usize))
    } else {
        let drop = drop as usize;
        let kept = low_word(&(magnitude >> drop));
        let half = magnitude.bit(drop - 1);
        let rest = sticky || magnitude.trailing_zeros().is_some_and(|z| z < drop - 1);
        kept + u64::from(half && (rest || kept & 1 == 1))
    };
    // `kept <= 2^53`, so both products are exact, or overflow as they should.
    kept as f64 * power_of_two(last / 2) * power_of_two(last - last / 2)
}

/// A number of at most 54 bits.
fn low_word(n: &UBig) -> u64 {
    u64::try_from(n).unwrap_or(u64::MAX)
}

fn signed(sign: Sign, magnitude: f64) -> f64 {
    // A zero is always positive: -0 would only show in printing.
    match sign {
        Sign::Negative if magnitude != 0.0 => -magnitude,
        _ => magnitude,
    }
}

/// `2^e` for `-1022 <= e <= 1023`.
fn power_of_two(e: i64) -> f64 {
    f64::from_bits(((e + 1023) as u64) << 52)
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: Self) -> Dyadic {
        let (a, b, exponent) = self.aligned(other);
        Dyadic {
            integer: a + b,
            exponent,
        }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: Self) -> Dyadic {
        let (a, b, exponent) = self.aligned(other);
        Dyadic {
            integer: a - b,
            exponent,
        }
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: Self) -> Dyadic {
        Dyadic {
            integer: &self.integer * &other.integer,
            exponent: self.exponent + other.exponent,
        }
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic {
            integer: -&self.integer,
            exponent: self.exponent,
        }
    }
}

/// The exact coordinates of a point.
pub(super) fn exact(v: Vec3<f64>) -> Dyadic3 {
    v.to_array().map(Dyadic::from)
}

/// `p - q`.
pub(super) fn difference(p: Vec3<f64>, q: Vec3<f64>) -> Dyadic3 {
    let (p, q) = (exact(p), exact(q));
    std::array::from_fn(|i| &p[i] - &q[i])
}

/// The inner product.
pub(super) fn dot(a: &Dyadic3, b: &Dyadic3) -> Dyadic {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

/// The cross product.
pub(super) fn cross(a: &Dyadic3, b: &Dyadic3) -> Dyadic3 {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The vector times the power of two that brings its largest coordinate to
/// `1/2 <= |x| < 1`, and the exponent of that power; `None` for the zero
/// vector. Each coordinate is rounded once.
pub(super) fn normalised_by_power(v: &Dyadic3) -> Option<(Vec3<f64>, i64)> {
    let shift = -v.iter().filter_map(Dyadic::top).max()?;
    let [x, y, z] = [0, 1, 2].map(|i| v[i].scaled(shift));
    Some((Vec3::new(x, y, z), shift))
}

/// The unit vector in this direction, each coordinate within 4 ulp; `None` for
/// the zero vector. A vector along a coordinate axis gives exactly 1 or -1.
pub(super) fn unit(v: &Dyadic3) -> Option<Vec3<f64>> {
    let (v, _) = normalised_by_power(v)?;
    let length = v.dot(v).sqrt();
    Some(Vec3::new(v.x / length, v.y / length, v.z / length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every finite double, subnormals and both ends of the range included.
    fn finite() -> impl Strategy<Value = f64> {
        any::<u64>().prop_filter_map("infinite or NaN", |bits| {
            Some(f64::from_bits(bits)).filter(|x| x.is_finite())
        })
    }

    proptest! {
        #[test]
        fn one_operation_rounds_as_the_machine_does(a in finite(), b in finite()) {
            let (x, y) = (Dyadic::from(a), Dyadic::from(b));
            prop_assert_eq!(x.to_f64(), a);
            prop_assert_eq!((&x + &y).to_f64(), a + b);
            prop_assert_eq!((&x - &y).to_f64(), a - b);
            prop_assert_eq!((&x * &y).to_f64(), a * b);
            if b != 0.0 {
                prop_assert_eq!(x.ratio(&y), a / b);
            }
        }

        #[test]
        fn close_numbers_too(a in 1u64..1 << 53, b in 1u64..1 << 53, e in -1073i32..-1000) {
            // Products and quotients that land among the subnormals.
            let scale = libm::ldexp(1.0, e);
            let (a, b) = (a as f64, b as f64 * scale);
            let (x, y) = (Dyadic::from(a), Dyadic::from(b));
            prop_assert_eq!(y.ratio(&x), b / a);
            prop_assert_eq!((&x * &y).to_f64(), a * b);
        }
    }

    #[test]
    fn nothing_cancels() {
        let tiny = Dyadic::from(5e-324);
        let huge = Dyadic::from(f64::MAX);
        let sum = &huge + &tiny;
        assert_eq!((&sum - &huge).to_f64(), 5e-324);
        assert_eq!(tiny.sign(), Ordering::Greater);
        assert_eq!((&tiny - &tiny).sign(), Ordering::Equal);
    }

    #[test]
    fn a_unit_vector_needs_no_range() {
        let v = Vec3::new(3e300, 0.0, -4e300);
        assert_eq!(unit(&exact(v)), Some(Vec3::new(0.6, 0.0, -0.8)));
        let v = Vec3::new(0.0, 5e-324, 0.0);
        assert_eq!(unit(&exact(v)), Some(Vec3::new(0.0, 1.0, 0.0)));
        assert_eq!(unit(&exact(Vec3::new(0.0, 0.0, 0.0))), None);
    }
}
