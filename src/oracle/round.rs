//! Correct rounding of rationals, and the floating-point numbers near a rational.
//!
//! `x = n/d` lies in a binade `2^b <= |x| < 2^(b+1)`; its unit in the last place
//! is `ulp(x) = 2^(b - digits + 1)`, never below the smallest subnormal. Rounding
//! is one integer division by the ulp and a comparison of the remainder. A value
//! beyond the largest finite number by half an ulp or more becomes infinite; one
//! at or below half the smallest subnormal becomes zero with its sign.

use super::dyadic::Dyadic;
use crate::math::Real;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;

/// The value of `T` nearest to a rational, ties to even.
///
/// Values beyond the range become infinite, as IEEE 754 has it.
pub fn round_nearest<T: Real>(x: &BigRational) -> T {
    let (n, d) = (x.numer().magnitude(), x.denom().magnitude());
    if n.is_zero() || d.is_zero() {
        return T::ZERO;
    }
    let exponent = ulp_exponent::<T>(n, d);
    let (mut quotient, doubled_remainder, divisor) = divide_by_power(n, d, exponent);
    let up = match doubled_remainder.cmp(&divisor) {
        Ordering::Less => false,
        Ordering::Equal => quotient.bit(0),
        Ordering::Greater => true,
    };
    if up {
        quotient += 1_u32;
    }
    // At most 2^digits, so the conversion is exact.
    let significand = quotient.iter_u64_digits().next().unwrap_or(0);
    let magnitude = T::from_f64(scale(significand, exponent));
    let negative = x.numer().is_negative() != x.denom().is_negative();
    if negative { -magnitude } else { magnitude }
}

/// The unit in the last place of `T` at a rational, as an exponent of two; at
/// zero the smallest subnormal's.
pub(crate) fn ulp_exponent_at<T: Real>(x: &BigRational) -> i64 {
    let (n, d) = (x.numer().magnitude(), x.denom().magnitude());
    if n.is_zero() || d.is_zero() {
        least_exponent::<T>()
    } else {
        ulp_exponent::<T>(n, d)
    }
}

/// The unit in the last place of `T` at a rational.
pub(crate) fn ulp_at<T: Real>(x: &BigRational) -> f64 {
    scale(1, ulp_exponent_at::<T>(x))
}

/// All finite values of `T` within `ulps` units in the last place of `x`, in
/// ascending order.
pub(crate) fn neighbours<T: Real>(x: &BigRational, ulps: u32) -> Vec<T> {
    let exponent = ulp_exponent_at::<T>(x);
    let reach = Dyadic::new(BigInt::from(ulps), exponent);
    let near = |v: &T| is_within(x, *v, &reach);
    let middle = round_nearest::<T>(x);
    let below = std::iter::successors(Some(middle.next_down()), |v| Some(v.next_down()));
    let mut all: Vec<T> = below.take_while(near).collect();
    all.reverse();
    let above = std::iter::successors(Some(middle), |v| Some(v.next_up()));
    all.extend(above.take_while(near));
    all
}

/// Whether `|value - x| <= tolerance`.
pub(crate) fn is_within<T: Real>(x: &BigRational, value: T, tolerance: &Dyadic) -> bool {
    let Some(value) = Dyadic::from_f64(value.to_f64()) else {
        return false;
    };
    let difference = &(&value * x.denom()) - &Dyadic::new(x.numer().clone(), 0);
    let tolerance = tolerance * &x.denom().abs();
    difference.abs() <= tolerance
}

/// The exponent of `T`'s smallest subnormal.
fn least_exponent<T: Real>() -> i64 {
    if T::DIGITS == f32::MANTISSA_DIGITS {
        -149
    } else {
        -1074
    }
}

fn ulp_exponent<T: Real>(n: &BigUint, d: &BigUint) -> i64 {
    // n/d is in [2^(guess - 1), 2^(guess + 1)).
    let guess = n.bits() as i64 - d.bits() as i64;
    let below = if guess >= 0 {
        *n < d << guess
    } else {
        n << -guess < *d
    };
    let binade = if below { guess - 1 } else { guess };
    (binade - i64::from(T::DIGITS) + 1).max(least_exponent::<T>())
}

/// `n / (d 2^exponent)`: the integer part, twice the remainder, the divisor.
fn divide_by_power(n: &BigUint, d: &BigUint, exponent: i64) -> (BigUint, BigUint, BigUint) {
    let (n, d) = if exponent >= 0 {
        (n.clone(), d << exponent)
    } else {
        (n << -exponent, d.clone())
    };
    let quotient = &n / &d;
    let remainder = n - &quotient * &d;
    (quotient, remainder << 1, d)
}

/// `significand * 2^exponent`, exactly, or infinity; `significand <= 2^53` and
/// `exponent >= -1074`.
fn scale(significand: u64, exponent: i64) -> f64 {
    if significand == 0 {
        return 0.0;
    }
    let length = 64 - i64::from(significand.leading_zeros());
    let binade = exponent + length - 1;
    if binade > 1023 {
        return f64::INFINITY;
    }
    if binade < -1022 {
        return f64::from_bits(significand << (exponent + 1074));
    }
    let fraction = if length <= 53 {
        significand << (53 - length)
    } else {
        significand >> (length - 53)
    };
    f64::from_bits((((binade + 1023) as u64) << 52) | (fraction & ((1 << 52) - 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(value: f64) -> BigRational {
        BigRational::from_float(value).unwrap()
    }

    #[test]
    fn representable_values_stay() {
        for v in [0.0, 1.0, -3.5, 5e-324, f64::MAX, f64::MIN_POSITIVE, -1e-310] {
            assert_eq!(round_nearest::<f64>(&rational(v)), v);
        }
        for v in [1.0_f32, -1e-45, f32::MAX, f32::MIN_POSITIVE] {
            assert_eq!(round_nearest::<f32>(&rational(f64::from(v))), v);
        }
    }

    #[test]
    fn agrees_with_the_hardware() {
        // IEEE 754 rounds products and quotients correctly.
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695);
            let exponent = 1023 - 700 + (state >> 20) % 1400;
            f64::from_bits((state >> 12) | exponent << 52 | (state << 63))
        };
        for _ in 0..20_000 {
            let (a, b) = (next(), next());
            if (a * b).is_finite() {
                let exact = rational(a) * rational(b);
                assert_eq!(round_nearest::<f64>(&exact), a * b, "{a:e} * {b:e}");
            }
            let exact = BigRational::new_raw(
                rational(a).numer() * rational(b).denom(),
                rational(a).denom() * rational(b).numer(),
            );
            assert_eq!(round_nearest::<f64>(&exact), a / b, "{a:e} / {b:e}");
            assert_eq!(round_nearest::<f32>(&rational(a)), a as f32, "{a:e} as f32");
        }
    }

    #[test]
    fn ties_go_to_even() {
        let half_ulp = BigRational::new(1.into(), BigInt::from(1_u64 << 53));
        let one = BigRational::from_integer(1.into());
        assert_eq!(round_nearest::<f64>(&(&one + &half_ulp)), 1.0);
        let odd = rational(1.0_f64.next_up());
        assert_eq!(
            round_nearest::<f64>(&(odd + &half_ulp)),
            1.0_f64.next_up().next_up()
        );
    }

    #[test]
    fn the_ends_of_the_range() {
        let half = BigRational::new(1.into(), 2.into());
        let tiny = rational(5e-324);
        assert_eq!(round_nearest::<f64>(&(&tiny * &half)), 0.0);
        assert_eq!(
            round_nearest::<f64>(&(&tiny * &half * rational(1.5))),
            5e-324
        );
        let beyond = rational(f64::MAX) + rational(2.0_f64.powi(970));
        assert_eq!(round_nearest::<f64>(&beyond), f64::INFINITY);
        let inside = rational(f64::MAX) + rational(2.0_f64.powi(969));
        assert_eq!(round_nearest::<f64>(&-inside), f64::MIN);
        assert_eq!(round_nearest::<f32>(&rational(1e300)), f32::INFINITY);
    }

    #[test]
    fn neighbours_on_both_sides_of_a_power_of_two() {
        let u = f64::EPSILON;
        let found = neighbours::<f64>(&rational(1.0), 1);
        assert_eq!(found, [1.0 - u, 1.0 - u / 2.0, 1.0, 1.0 + u]);
        let third = BigRational::new(1.into(), 3.into());
        let found = neighbours::<f64>(&third, 2);
        let near = 1.0_f64 / 3.0;
        let expected = [
            near.next_down(),
            near,
            near.next_up(),
            near.next_up().next_up(),
        ];
        assert_eq!(found, expected);
        let zero = BigRational::from_integer(0.into());
        assert_eq!(neighbours::<f64>(&zero, 1), [-5e-324, 0.0, 5e-324]);
        assert_eq!(neighbours::<f32>(&zero, 2).len(), 5);
    }
}
