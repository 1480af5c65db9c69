//! Integers times powers of two: every finite `f64`, every sum and product.
//!
//! There is no limit of the exponent and no reduction by common divisors. The numbers
//! allocate; decisions reach them only if an expansion overflows or the exponents leave
//! its safe range.

use super::Number;
use super::float::{decompose, exp2};
use crate::math::Real;
use dashu_int::{IBig, Sign, UBig, ops::BitTest, ops::DivRem};
use std::cmp::Ordering;
use std::convert::Infallible;

/// `mantissa * 2^exponent`.
#[derive(Clone, Debug)]
pub(crate) struct Dyadic {
    mantissa: IBig,
    exponent: i32,
}

impl Dyadic {
    pub(crate) fn abs(self) -> Self {
        if self.mantissa.sign() == Sign::Negative {
            self.neg()
        } else {
            self
        }
    }

    /// The larger of two numbers.
    pub(crate) fn max(self, other: Self) -> Self {
        if (&self - &other).sign() == Ordering::Less {
            other
        } else {
            self
        }
    }

    /// The value times `2^shift`.
    pub(crate) fn shifted(&self, shift: i32) -> Self {
        Self {
            mantissa: self.mantissa.clone(),
            exponent: self.exponent + shift,
        }
    }

    /// The least `e` with `|self| < 2^e`; `None` for zero.
    pub(crate) fn top(&self) -> Option<i32> {
        match i32::try_from(self.mantissa.bit_len()) {
            Ok(0) => None,
            Ok(bits) => Some(bits + self.exponent),
            Err(_) => Some(i32::MAX),
        }
    }

    /// The quotient rounded to nearest, ties to even; infinite beyond the
    /// range, zero for a zero numerator. The denominator must not be zero.
    pub(crate) fn round_quotient<T: Real>(&self, denominator: &Dyadic) -> T {
        let (sign_n, n) = self.mantissa.clone().into_parts();
        let (sign_d, d) = denominator.mantissa.clone().into_parts();
        let magnitude = round_ratio::<T>(n, d, self.exponent - denominator.exponent);
        T::from_f64(if sign_n == sign_d {
            magnitude
        } else {
            -magnitude
        })
    }
}

/// `n / d * 2^exponent`, rounded to the type's nearest.
fn round_ratio<T: Real>(n: UBig, d: UBig, exponent: i32) -> f64 {
    if n.is_zero() {
        return 0.0;
    }
    let bits = |v: &UBig| i32::try_from(v.bit_len()).unwrap_or(i32::MAX);
    // 2^(top-1) < n/d < 2^(top+1): the quotient shifted by `shift` has DIGITS+1
    // or DIGITS+2 bits, fewer only among the subnormals.
    let top = bits(&n) - bits(&d);
    let least = if T::DIGITS == 24 { -149 } else { -1074 };
    let digits = T::DIGITS.cast_signed() + 1;
    let unit = (top + exponent - digits).max(least - 1);
    let shift = exponent - unit;
    let (n, d) = if shift >= 0 {
        (n << shift.unsigned_abs() as usize, d)
    } else {
        (n, d << shift.unsigned_abs() as usize)
    };
    let (quotient, remainder) = n.div_rem(&d);
    let quotient = u64::try_from(quotient).unwrap_or(u64::MAX);
    round_units::<T>(quotient, !remainder.is_zero(), unit, least)
}

/// `(quotient + some of one unit if inexact) * 2^unit`, rounded.
fn round_units<T: Real>(quotient: u64, inexact: bool, unit: i32, least: i32) -> f64 {
    let length = (u64::BITS - quotient.leading_zeros()).cast_signed();
    // Number of low bits that do not fit.
    let drop = (length - T::DIGITS.cast_signed()).max(least - unit).max(0);
    let kept = quotient >> drop;
    let rest = quotient & ((1_u64 << drop) - 1);
    let half = if drop == 0 { 0 } else { 1_u64 << (drop - 1) };
    let up = drop > 0
        && match rest.cmp(&half) {
            Ordering::Greater => true,
            Ordering::Equal => inexact || kept & 1 == 1,
            Ordering::Less => false,
        };
    // At most 2^53, so exact; two factors since 2^exponent may be subnormal.
    #[allow(clippy::cast_precision_loss, reason = "at most 53 bits")]
    let kept = (kept + u64::from(up)) as f64;
    let exponent = unit + drop;
    let half_way = exponent / 2;
    kept * exp2(half_way) * exp2(exponent - half_way)
}

impl Number for Dyadic {
    type Overflow = Infallible;

    fn from_f64(value: f64) -> Self {
        let (mantissa, exponent) = decompose(value);
        let zeros = if mantissa == 0 {
            0
        } else {
            mantissa.trailing_zeros()
        };
        let magnitude = IBig::from(mantissa >> zeros);
        Dyadic {
            mantissa: if value < 0.0 { -magnitude } else { magnitude },
            exponent: exponent + zeros.cast_signed(),
        }
    }

    fn difference(a: f64, b: f64) -> Self {
        let (a, b) = (Dyadic::from_f64(a), Dyadic::from_f64(-b));
        sum(&a, &b)
    }

    fn add(&self, other: &Self) -> Result<Self, Infallible> {
        Ok(sum(self, other))
    }

    fn mul(&self, other: &Self) -> Result<Self, Infallible> {
        Ok(product(self, other))
    }

    fn neg(self) -> Self {
        Dyadic {
            mantissa: -self.mantissa,
            exponent: self.exponent,
        }
    }

    fn sign(&self) -> Ordering {
        self.mantissa.cmp(&IBig::ZERO)
    }
}

impl From<f64> for Dyadic {
    fn from(value: f64) -> Self {
        Number::from_f64(value)
    }
}

// Operators beside the methods of `Number`: nothing overflows here.

impl std::ops::Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: Self) -> Dyadic {
        sum(self, other)
    }
}

impl std::ops::Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: Self) -> Dyadic {
        sum(self, &-other)
    }
}

impl std::ops::Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: Self) -> Dyadic {
        product(self, other)
    }
}

impl std::ops::Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Number::neg(self.clone())
    }
}

fn product(a: &Dyadic, b: &Dyadic) -> Dyadic {
    Dyadic {
        mantissa: &a.mantissa * &b.mantissa,
        exponent: a.exponent + b.exponent,
    }
}

fn sum(a: &Dyadic, b: &Dyadic) -> Dyadic {
    if a.mantissa.is_zero() {
        return b.clone();
    }
    if b.mantissa.is_zero() {
        return a.clone();
    }
    let (low, high) = if a.exponent <= b.exponent {
        (a, b)
    } else {
        (b, a)
    };
    let shift = (high.exponent - low.exponent).unsigned_abs() as usize;
    Dyadic {
        mantissa: (&high.mantissa << shift) + &low.mantissa,
        exponent: low.exponent,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn d(v: f64) -> Dyadic {
        Dyadic::from_f64(v)
    }

    #[test]
    fn quotients_round_as_the_hardware_does() {
        let values = [
            1.0,
            3.0,
            -7.0,
            0.1,
            1e-300,
            1e300,
            5e-324,
            -2.2250738585072014e-308,
            f64::MAX,
            1e-160,
            123456.789,
            4.9e-320,
        ];
        for a in values {
            for b in values {
                assert_eq!(d(a).round_quotient::<f64>(&d(b)), a / b, "{a} / {b}");
                let (a, b) = (a as f32, b as f32);
                if b != 0.0 && a.is_finite() && b.is_finite() {
                    let q = d(a.into()).round_quotient::<f32>(&d(b.into()));
                    assert_eq!(q, a / b, "{a} / {b} in f32");
                }
            }
        }
        assert_eq!(d(0.0).round_quotient::<f64>(&d(-3.0)), 0.0);
    }

    #[test]
    fn ties_go_to_even() {
        let half_ulp = &d(1.0) + &d(f64::EPSILON / 2.0);
        assert_eq!(half_ulp.round_quotient::<f64>(&d(1.0)), 1.0);
        let more = &half_ulp + &d(1e-300);
        assert_eq!(more.round_quotient::<f64>(&d(1.0)), 1.0 + f64::EPSILON);
        assert_eq!(d(2.0 + 1e-9).round_quotient::<f32>(&d(1.0)), 2.0);
    }

    #[test]
    fn sums_products_and_signs() {
        let order = |a: &Dyadic, v: f64| (a - &d(v)).sign();
        let a = Dyadic::difference(1e300, 1e-300);
        let b = &a + &d(-1e300);
        assert_eq!(order(&b, -1e-300), Ordering::Equal);
        assert_eq!(b.sign(), Ordering::Less);
        assert_eq!(b.clone().abs().sign(), Ordering::Greater);
        let square = &b * &b;
        assert_eq!(square.sign(), Ordering::Greater);
        assert_eq!(order(&square, 5e-324), Ordering::Less);
        assert_eq!(d(-0.0).sign(), Ordering::Equal);
    }
}
