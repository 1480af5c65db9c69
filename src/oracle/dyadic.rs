//! Integers times powers of two: the values of `f64`, and of all their sums and
//! products.
//!
//! Slow and obvious: a big integer and an exponent, no normal form, no
//! rounding, no limits. Every finite `f64`, subnormals included, converts
//! exactly.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// `integer * 2^exponent`.
#[derive(Clone, Debug)]
pub(crate) struct Dyadic {
    integer: BigInt,
    exponent: i64,
}

impl Dyadic {
    pub(crate) fn new(integer: BigInt, exponent: i64) -> Self {
        Self { integer, exponent }
    }

    pub(crate) fn zero() -> Self {
        Self::new(BigInt::zero(), 0)
    }

    /// `2^exponent`.
    pub(crate) fn power_of_two(exponent: i64) -> Self {
        Self::new(BigInt::one(), exponent)
    }

    /// The value of a finite `f64`; `None` for infinities and NaN.
    pub(crate) fn from_f64(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        let bits = value.to_bits();
        let stored_exponent = ((bits >> 52) & 0x7ff) as i64;
        let fraction = bits & ((1 << 52) - 1);
        let (significand, exponent) = match stored_exponent {
            0 => (fraction, -1074),
            e => (fraction | 1 << 52, e - 1075),
        };
        // Short integers keep the arithmetic that follows short.
        let zeros = if significand == 0 {
            return Some(Self::zero());
        } else {
            significand.trailing_zeros()
        };
        let magnitude = BigInt::from(significand >> zeros);
        let integer = if value < 0.0 { -magnitude } else { magnitude };
        Some(Self::new(integer, exponent + i64::from(zeros)))
    }

    /// The exponent; `None` for zero, which has none of its own.
    pub(crate) fn exponent(&self) -> Option<i64> {
        (!self.is_zero()).then_some(self.exponent)
    }

    /// The same number over a power of two that is not greater than its own.
    pub(crate) fn over_power(&self, exponent: i64) -> Self {
        let integer = match self.exponent() {
            Some(own) => &self.integer << (own - exponent),
            None => BigInt::zero(),
        };
        Self::new(integer, exponent)
    }

    /// Both numbers as integers over the smaller of the two powers of two.
    pub(crate) fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponents = self.exponent().into_iter().chain(other.exponent());
        let exponent = exponents.min().unwrap_or(0);
        let integer_of = |d: &Self| d.over_power(exponent).integer;
        (integer_of(self), integer_of(other), exponent)
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.integer.is_zero()
    }

    pub(crate) fn is_negative(&self) -> bool {
        self.integer.is_negative()
    }

    /// -1, 0 or 1.
    pub(crate) fn signum(&self) -> i32 {
        match self.integer.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    pub(crate) fn abs(&self) -> Self {
        Self::new(self.integer.abs(), self.exponent)
    }

    /// `self / divisor`, not reduced to lowest terms: reducing costs more than
    /// everything else here together.
    pub(crate) fn over(&self, divisor: &BigInt) -> BigRational {
        if self.exponent >= 0 {
            BigRational::new_raw(&self.integer << self.exponent, divisor.clone())
        } else {
            BigRational::new_raw(self.integer.clone(), divisor << -self.exponent)
        }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: &Dyadic) -> Dyadic {
        match self.exponent.cmp(&other.exponent) {
            Ordering::Equal => Dyadic::new(&self.integer + &other.integer, self.exponent),
            _ => {
                let (a, b, exponent) = self.aligned(other);
                Dyadic::new(a + b, exponent)
            }
        }
    }
}

/// In the first number's memory, where the powers of two are the same.
impl Add for Dyadic {
    type Output = Dyadic;
    fn add(self, other: Dyadic) -> Dyadic {
        if self.exponent == other.exponent {
            Dyadic::new(self.integer + other.integer, self.exponent)
        } else {
            &self + &other
        }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: &Dyadic) -> Dyadic {
        match self.exponent.cmp(&other.exponent) {
            Ordering::Equal => Dyadic::new(&self.integer - &other.integer, self.exponent),
            _ => {
                let (a, b, exponent) = self.aligned(other);
                Dyadic::new(a - b, exponent)
            }
        }
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: &Dyadic) -> Dyadic {
        Dyadic::new(
            &self.integer * &other.integer,
            self.exponent + other.exponent,
        )
    }
}

impl Mul<&BigInt> for &Dyadic {
    type Output = Dyadic;
    fn mul(self, factor: &BigInt) -> Dyadic {
        Dyadic::new(&self.integer * factor, self.exponent)
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic::new(-&self.integer, self.exponent)
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        match self.signum().cmp(&other.signum()) {
            Ordering::Equal => {
                let (a, b, _) = self.aligned(other);
                a.cmp(&b)
            }
            unequal => unequal,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dyadic(value: f64) -> Dyadic {
        Dyadic::from_f64(value).unwrap()
    }

    #[test]
    fn doubles_convert_exactly() {
        assert_eq!(dyadic(5e-324), Dyadic::power_of_two(-1074));
        assert_eq!(dyadic(-6.0), Dyadic::new(BigInt::from(-3), 1));
        assert_eq!(dyadic(f64::MAX), {
            &Dyadic::power_of_two(1024) - &Dyadic::power_of_two(971)
        });
        assert!(dyadic(-0.0).is_zero());
        assert!(Dyadic::from_f64(f64::NAN).is_none());
        assert!(Dyadic::from_f64(f64::INFINITY).is_none());
    }

    #[test]
    fn sums_and_products_are_exact() {
        let tiny = dyadic(5e-324);
        let huge = dyadic(1e300);
        let sum = &huge + &tiny;
        assert!(sum > huge);
        assert_eq!(&sum - &huge, tiny);
        assert_eq!(&tiny * &tiny, Dyadic::power_of_two(-2148));
        assert_eq!(&dyadic(0.75) * &dyadic(-4.0), dyadic(-3.0));
        assert!(dyadic(-1e300) < tiny && tiny < dyadic(1e-300));
    }
}
