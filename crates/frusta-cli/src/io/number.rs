//! Numbers from text and back, without losing a bit.

use crate::failure::quote;
use frusta::Real;
use frusta::math::hex::{self, HexError};
use std::str::FromStr;

/// A scalar type that can be read from text and written.
pub trait Scalar: Real + FromStr + zmij::Float {
    /// The type's name on the command line.
    const NAME: &'static str;
}

impl Scalar for f32 {
    const NAME: &'static str = "f32";
}

impl Scalar for f64 {
    const NAME: &'static str = "f64";
}

/// Reads a decimal, correctly rounded, or a hexadecimal float (`0x1.8p-3`),
/// which is rounded once for `f32` and refused if no `f64` equals it: whoever writes
/// one wants these bits.
pub(crate) fn parse<T: Scalar>(text: &str) -> Result<T, String> {
    let digits = text.trim_start_matches(['+', '-']);
    if digits.starts_with("0x") || digits.starts_with("0X") {
        match hex::parse_f64(text) {
            Ok(value) => return Ok(T::from_f64(value)),
            Err(HexError::Inexact) => {
                return Err(format!("no f64 equals {} exactly", quote(text)));
            }
            Err(_) => {}
        }
    } else if let Ok(value) = text.parse() {
        return Ok(value);
    }
    Err(format!("{} is not a number", quote(text)))
}

/// Reads a number that is neither infinite nor NaN.
pub(crate) fn parse_finite<T: Scalar>(text: &str) -> Result<T, String> {
    let value: T = parse(text)?;
    if value.is_finite() {
        Ok(value)
    } else if value.to_f64().is_nan() {
        Err("NaN; it must be finite".to_owned())
    } else {
        Err(format!(
            "{} is infinite in {}; it must be finite",
            quote(text),
            T::NAME
        ))
    }
}

/// Appends the shortest decimal that reads back to the same bits.
#[inline]
pub(crate) fn write<T: Scalar>(value: T, out: &mut Vec<u8>) {
    if value == T::ONE {
        return out.push(b'1');
    }
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format_finite(value);
    out.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
}

/// Appends an integer.
#[inline]
pub(crate) fn write_integer(value: u64, out: &mut Vec<u8>) {
    out.extend_from_slice(itoa::Buffer::new().format(value).as_bytes());
}

/// The same for flags and messages, in Rust's notation.
pub(crate) fn short(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written<T: Scalar>(value: T) -> String {
        let mut out = Vec::new();
        write(value, &mut out);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn what_is_written_reads_back_to_the_same_bits() {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..20_000 {
            bits ^= bits << 13;
            bits ^= bits >> 7;
            bits ^= bits << 17;
            let wide = f64::from_bits(bits);
            if wide.is_finite() {
                assert_eq!(parse::<f64>(&written(wide)).unwrap().to_bits(), bits);
            }
            let narrow = f32::from_bits(bits as u32);
            if narrow.is_finite() {
                let back: f32 = parse(&written(narrow)).unwrap();
                assert_eq!(back.to_bits(), narrow.to_bits());
            }
        }
        for value in [0.0, -0.0, 5e-324, f64::MAX, 0.1, 1e21] {
            let back: f64 = parse(&written(value)).unwrap();
            assert_eq!(back.to_bits(), value.to_bits());
        }
        assert_eq!(written(-0.0), "-0");
        assert_eq!(written(3.0), "3");
    }

    #[test]
    fn hexadecimal_floats_and_refusals() {
        assert_eq!(parse::<f64>("0x1.8p-3"), Ok(0.1875));
        assert_eq!(parse::<f32>("-0x1p1"), Ok(-2.0));
        assert!(parse::<f64>("0x").is_err());
        assert!(parse::<f64>("1,5").is_err());
        assert_eq!(
            parse_finite::<f32>("1e39").unwrap_err(),
            "\"1e39\" is infinite in f32; it must be finite"
        );
    }
}
