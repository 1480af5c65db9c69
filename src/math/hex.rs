//! Floating-point numbers as exact hexadecimal text: `0x1.8p-3` is 0.1875.
//!
//! The notation is C99's (`%a`): a hexadecimal significand and a power of two.
//! Decimal text may hide the last bit, which a witness for replay must show.
//! [`format()`] writes the shortest normalised form, subnormals
//! included (the smallest is `0x1p-1074`); [`parse_f64`] reads any number of
//! digits before and after the point, and fails if no `f64` equals the value, so
//! that nothing is rounded silently. Infinities and NaN are written `inf`,
//! `-inf`, `nan` (without payload) and read back.

use super::Segment;
use super::{Real, Vec3};
use std::fmt::{self, Write};

/// The error for a text that is not an exact hexadecimal number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HexError {
    /// The text is not of the form `[+-]0xH.HHp[+-]D`, `inf` or `nan`.
    Syntax,
    /// No value of the type equals the number: it has too many digits, or is too large
    /// or too small.
    Inexact,
}

impl fmt::Display for HexError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Syntax => "not a hexadecimal number such as -0x1.8p-3",
            Self::Inexact => "no floating-point value equals this number exactly",
        })
    }
}

impl std::error::Error for HexError {}

/// Displays a scalar in hexadecimal.
///
/// ```
/// use frusta::math::hex::Hex;
/// assert_eq!(format!("{}", Hex(0.1_f32)), "0x1.99999ap-4");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hex<T>(pub T);

impl<T: Real> fmt::Display for Hex<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_f64(f, self.0.to_f64())
    }
}

impl<T: Real> fmt::Display for Hex<Vec3<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.to_array().map(Hex);
        write!(f, "{x} {y} {z}")
    }
}

impl<T: Real> fmt::Display for Hex<Segment<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", Hex(self.0.start), Hex(self.0.end))
    }
}

/// The exact hexadecimal text of an `f64`.
///
/// ```
/// use frusta::math::hex;
/// assert_eq!(hex::format(-0.1875), "-0x1.8p-3");
/// assert_eq!(hex::format(0.0), "0x0p+0");
/// assert_eq!(hex::format(5e-324), "0x1p-1074");
/// ```
#[must_use]
pub fn format(value: f64) -> String {
    Hex(value).to_string()
}

fn write_f64(out: &mut impl Write, value: f64) -> fmt::Result {
    if value.is_nan() {
        return out.write_str("nan");
    }
    if value.is_sign_negative() {
        out.write_char('-')?;
    }
    if value.is_infinite() {
        return out.write_str("inf");
    }
    if value == 0.0 {
        return out.write_str("0x0p+0");
    }
    let bits = value.to_bits();
    let stored_exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let (significand, exponent) = if stored_exponent == 0 {
        // A subnormal: shift its leading one to the place of the hidden bit.
        let shift = fraction.leading_zeros() - 11;
        (fraction << shift, -1022 - shift as i32)
    } else {
        (fraction | 1 << 52, stored_exponent - 1023)
    };
    out.write_str("0x1")?;
    let digits = format!("{:013x}", significand & ((1 << 52) - 1));
    let digits = digits.trim_end_matches('0');
    if !digits.is_empty() {
        write!(out, ".{digits}")?;
    }
    write!(out, "p{exponent:+}")
}

/// The `f64` that a hexadecimal text denotes.
///
/// Upper and lower case, a leading sign and a missing exponent are accepted.
///
/// ```
/// use frusta::math::hex::{self, HexError};
/// assert_eq!(hex::parse_f64("0x1.8p-3"), Ok(0.1875));
/// assert_eq!(hex::parse_f64("0xC"), Ok(12.0));
/// assert_eq!(hex::parse_f64("0x1p-1075"), Err(HexError::Inexact));
/// assert_eq!(hex::parse_f64("1.5"), Err(HexError::Syntax));
/// ```
///
/// # Errors
/// The text has another form, or no `f64` equals its value.
pub fn parse_f64(text: &str) -> Result<f64, HexError> {
    let (negative, rest) = match text.as_bytes() {
        [b'-', ..] => (true, &text[1..]),
        [b'+', ..] => (false, &text[1..]),
        _ => (false, text),
    };
    let lower = rest.to_ascii_lowercase();
    let magnitude = match lower.as_str() {
        "inf" => f64::INFINITY,
        "nan" => f64::NAN,
        other => {
            let body = other.strip_prefix("0x").ok_or(HexError::Syntax)?;
            magnitude(body)?
        }
    };
    Ok(if negative { -magnitude } else { magnitude })
}

/// The `f32` that a hexadecimal text denotes.
///
/// # Errors
/// The text has another form, or no `f32` equals its value.
pub fn parse_f32(text: &str) -> Result<f32, HexError> {
    let wide = parse_f64(text)?;
    let narrow = f32::from_f64(wide);
    if wide.is_nan() || f64::from(narrow) == wide {
        Ok(narrow)
    } else {
        Err(HexError::Inexact)
    }
}

/// `H.HHpD` without sign and prefix, in lower case.
fn magnitude(body: &str) -> Result<f64, HexError> {
    let (digits, exponent) = match body.split_once('p') {
        Some((digits, exponent)) => (digits, parse_exponent(exponent)?),
        None => (body, 0),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if whole.is_empty() && fraction.is_empty() {
        return Err(HexError::Syntax);
    }
    // The digits as an integer of at most 64 bits times a power of two. Leading and
    // trailing zeros do not count.
    let (mut significand, mut exponent, mut zeros) = (0_u64, exponent, 0_i64);
    for (i, c) in whole.chars().chain(fraction.chars()).enumerate() {
        let digit = c.to_digit(16).ok_or(HexError::Syntax)?;
        if i >= whole.len() {
            exponent -= 4;
        }
        zeros += 1;
        if digit != 0 && significand != 0 && significand.leading_zeros() as i64 >= 4 * zeros {
            significand <<= 4 * zeros;
        } else if digit != 0 && significand != 0 {
            return Err(HexError::Inexact);
        }
        if digit != 0 {
            significand |= u64::from(digit);
            zeros = 0;
        }
    }
    if significand == 0 {
        return Ok(0.0);
    }
    exponent += 4 * zeros;
    let shift = significand.trailing_zeros();
    assemble(significand >> shift, exponent + i64::from(shift))
}

fn parse_exponent(text: &str) -> Result<i64, HexError> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(HexError::Syntax);
    }
    // Far outside the range of `f64`, whatever the digits before it are.
    let value = digits.parse::<i64>().unwrap_or(1 << 40).min(1 << 40);
    Ok(if text.starts_with('-') { -value } else { value })
}

/// `odd * 2^exponent`, if an `f64` equals it.
fn assemble(odd: u64, exponent: i64) -> Result<f64, HexError> {
    let length = 64 - i64::from(odd.leading_zeros());
    let leading = exponent + length - 1;
    if length > 53 || exponent < -1074 || leading > 1023 {
        return Err(HexError::Inexact);
    }
    Ok(if leading < -1022 {
        f64::from_bits(odd << (exponent + 1074))
    } else {
        let fraction = (odd << (53 - length)) & ((1 << 52) - 1);
        f64::from_bits((((leading + 1023) as u64) << 52) | fraction)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A simple full-period generator, so that bit patterns are all reached.
    fn bit_patterns() -> impl Iterator<Item = u64> {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        std::iter::repeat_with(move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            state ^ (state >> 29)
        })
    }

    #[test]
    fn every_kind_of_f64_reads_back() {
        let edges = [
            0.0,
            -0.0,
            5e-324,
            -5e-324,
            f64::MIN_POSITIVE,
            f64::MIN_POSITIVE.next_down(),
            f64::MAX,
            f64::MIN,
            1.0,
            1.0_f64.next_down(),
            f64::INFINITY,
            f64::NEG_INFINITY,
        ];
        let random = bit_patterns().take(20_000).map(f64::from_bits);
        let subnormal = bit_patterns().take(5_000).map(|b| f64::from_bits(b >> 13));
        for value in edges.into_iter().chain(random).chain(subnormal) {
            let back = parse_f64(&format(value)).unwrap();
            if value.is_nan() {
                assert!(back.is_nan());
            } else {
                assert_eq!(back.to_bits(), value.to_bits(), "{}", format(value));
            }
        }
    }

    #[test]
    fn f32_values_read_back() {
        for bits in bit_patterns().take(20_000) {
            let value = f32::from_bits(bits as u32);
            let back = parse_f32(&Hex(value).to_string()).unwrap();
            assert!(value.is_nan() && back.is_nan() || back.to_bits() == value.to_bits());
        }
        assert_eq!(parse_f32("0x1.000001p+0"), Err(HexError::Inexact));
        assert_eq!(parse_f32("0x1p+128"), Err(HexError::Inexact));
    }

    #[test]
    fn other_forms_of_the_same_number() {
        for text in [
            "0x1.8p1",
            "0x3",
            "0X3.",
            "+0x.3p+4",
            "0x0003.000",
            "0x30p-4",
            "0x300000000000000000000000p-92",
            "0x0.00000000000000000003p80",
        ] {
            assert_eq!(parse_f64(text), Ok(3.0), "{text}");
        }
        assert_eq!(parse_f64("-0x0p+7").map(f64::to_bits), Ok(1 << 63));
        assert_eq!(parse_f64("0x0p999999999999999999999999"), Ok(0.0));
    }

    #[test]
    fn other_texts_are_errors() {
        for text in [
            "", "-", "0x", "0xp3", "0x.p3", "0x1p", "0x1p+", "0x1p1.5", "0x1.8.8", "0xg", "1.0",
            "--0x1", "0x1p--3", "0x 1", "0x-1", "é", "0x1é",
        ] {
            assert_eq!(parse_f64(text), Err(HexError::Syntax), "{text}");
        }
        for text in [
            "0x1p-1075",
            "0x1p1024",
            "0x1.00000000000008p0",
            "0x100000000000000000001",
            "0x1p999999999999999999999999",
            "0x1p-999999999999999999999999",
        ] {
            assert_eq!(parse_f64(text), Err(HexError::Inexact), "{text}");
        }
    }
}
