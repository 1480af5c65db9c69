//! Fractions in decimal: as many digits as asked for, rounded once, or fewer if
//! those are exact.

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// A fraction, rounded to a number of significant digits; trailing zeros are left out exactly if
/// nothing was rounded. A parameter just below 1 is written as `1 - 2.5e-31`, since
/// its own digits would be nines.
pub(super) fn parameter(t: &BigRational, digits: usize) -> String {
    let rest = BigRational::one() - t;
    let near_one = rest.is_positive()
        && &rest * BigRational::from_integer(1_000_000.into()) < BigRational::one();
    if near_one {
        format!("1 - {}", decimal(&rest, digits))
    } else {
        decimal(t, digits)
    }
}

/// A fraction, rounded to a number of significant digits.
pub(super) fn decimal(x: &BigRational, digits: usize) -> String {
    let (n, d) = (x.numer().magnitude(), x.denom().magnitude());
    if n.is_zero() || d.is_zero() {
        return "0".to_owned();
    }
    let sign = if x.is_negative() { "-" } else { "" };
    // Too small by at most 1: the powers of ten that surround a power of two.
    let bits = n.bits() as f64 - d.bits() as f64 - 1.0;
    let mut exponent = (bits * std::f64::consts::LOG10_2).floor() as i64;
    let (text, exact) = loop {
        let (rounded, exact) = scaled(n, d, digits as i64 - 1 - exponent);
        let text = rounded.to_string();
        if text.len() <= digits {
            break (text, exact);
        }
        exponent += 1;
    };
    let text = if exact {
        text.trim_end_matches('0')
    } else {
        &text
    };
    format!("{sign}{}", placed(text, exponent))
}

/// `n / d * 10^shift`, rounded, and whether it is exact.
fn scaled(n: &BigUint, d: &BigUint, shift: i64) -> (BigUint, bool) {
    let power = BigUint::from(10_u32).pow(shift.unsigned_abs() as u32);
    let (n, d) = if shift < 0 {
        (n.clone(), d * power)
    } else {
        (n * power, d.clone())
    };
    let (quotient, rest) = (&n / &d, &n % &d);
    let up = &rest * 2_u32 >= d;
    (quotient + u32::from(up), rest.is_zero())
}

/// Digits with the point in its place; of very large and small numbers after the
/// first digit.
fn placed(digits: &str, exponent: i64) -> String {
    let count = digits.len() as i64;
    let zeros = |n: i64| "0".repeat(n.max(0) as usize);
    match exponent {
        -5..=-1 => format!("0.{}{digits}", zeros(-exponent - 1)),
        0..=20 if count <= exponent + 1 => format!("{digits}{}", zeros(exponent + 1 - count)),
        0..=20 => {
            let (whole, fraction) = digits.split_at(exponent as usize + 1);
            format!("{whole}.{fraction}")
        }
        _ => {
            let (first, rest) = digits.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            format!("{first}{point}{rest}e{exponent}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fraction(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    #[test]
    fn digits_are_rounded_once_and_exact_ones_are_short() {
        for (n, d, text) in [
            (0, 7, "0"),
            (1, 3, "0.33333333333333333333"),
            (-2, 3, "-0.66666666666666666667"),
            (1, 8, "0.125"),
            (-40, 1, "-40"),
            (10_000_000_000_000_000, 1, "10000000000000000"),
            (1, 1_000_000, "1e-6"),
            (1, 30_000, "0.000033333333333333333333"),
            (
                999_999_999_999_999_999,
                1_000_000_000_000_000_000,
                "0.999999999999999999",
            ),
            (22, 7, "3.1428571428571428571"),
        ] {
            assert_eq!(decimal(&fraction(n, d), 20), text);
        }
        // Rounded up into one more digit.
        assert_eq!(decimal(&fraction(99_996, 10_000), 4), "10.00");
        let least = BigRational::from_float(5e-324).unwrap();
        assert_eq!(decimal(&least, 20), "4.9406564584124654418e-324");
        let most = BigRational::from_float(f64::MAX).unwrap();
        assert_eq!(decimal(&most, 6), "1.79769e308");
    }

    #[test]
    fn what_is_just_below_one_is_said_from_there() {
        let tiny = BigRational::from_float(2.0_f64.powi(-100)).unwrap();
        let t = BigRational::one() - &tiny;
        assert_eq!(parameter(&t, 4), "1 - 7.889e-31");
        assert_eq!(parameter(&BigRational::one(), 4), "1");
        assert_eq!(parameter(&tiny, 4), "7.889e-31");
    }

    #[test]
    fn doubles_read_back() {
        for exponent in (-1070..1020).step_by(37) {
            let value = 1.37 * 2.0_f64.powi(exponent);
            let exact = BigRational::from_float(value).unwrap();
            let text = decimal(&exact, 17);
            assert_eq!(text.parse::<f64>().unwrap(), value, "{text}");
        }
    }
}
