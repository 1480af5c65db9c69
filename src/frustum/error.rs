//! Everything that can be wrong with a frustum's description.

use std::fmt;

/// Why something is no frustum.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FrustumError {
    /// A number is infinite or NaN.
    NonFinite {
        /// Which number.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// Both ends are at the same `z`.
    NoDepth {
        /// The common `z`.
        z: f64,
    },
    /// A lower bound is above its upper bound.
    Inverted {
        /// Which end (`near`, `far.z` for the far end, `slopes`).
        end: &'static str,
        /// Which pair of bounds.
        what: &'static str,
        /// The lower bound.
        low: f64,
        /// The upper bound.
        high: f64,
    },
    /// Bounds coincide at both ends, so that nothing lies strictly between.
    Flat {
        /// Which pair of bounds.
        what: &'static str,
    },
    /// The three axes do not span space (their exact determinant is zero).
    DependentAxes,
}

impl fmt::Display for FrustumError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NonFinite { what, value } => write!(f, "{what} is {value}; it must be finite"),
            Self::NoDepth { z } => write!(f, "near and far are both at z = {z}; they must differ"),
            Self::Inverted {
                end,
                what,
                low,
                high,
            } => write!(
                f,
                "{end} {what} is {low}..{high}; the lower bound must not exceed the upper"
            ),
            Self::Flat { what } => {
                write!(
                    f,
                    "{what} has no extent at either end; one end must have some"
                )
            }
            Self::DependentAxes => f.write_str("the three axes are linearly dependent"),
        }
    }
}

impl std::error::Error for FrustumError {}
