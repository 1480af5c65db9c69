//! Everything that can be wrong with a frustum's description.

use crate::math::Vec3;
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
    /// The camera's target is its eye, so that it looks nowhere.
    EyeIsTarget {
        /// The common point.
        eye: Vec3<f64>,
    },
    /// The camera's `up` is zero or exactly along the view direction.
    UpAlongView {
        /// The camera's `up`.
        up: Vec3<f64>,
    },
    /// The field of view is not between 0 and `PI` radians.
    FieldOfView {
        /// The full vertical angle, in radians.
        fovy: f64,
    },
    /// Width over height is not a positive finite number.
    Aspect {
        /// Width over height.
        aspect: f64,
    },
    /// The height of an orthographic view is not a positive finite number.
    Height {
        /// The full height.
        height: f64,
    },
    /// The near distance of a perspective camera is negative.
    NearBehindEye {
        /// The near distance.
        near: f64,
    },
    /// A rectangle at distance 0 gives no off-axis perspective.
    OffAxisAtEye,
    /// The far distance is not greater than the near distance.
    FarNotBeyondNear {
        /// The near distance.
        near: f64,
        /// The far distance.
        far: f64,
    },
    /// A computed number is too large for a double.
    Overflow {
        /// What was computed.
        what: &'static str,
    },
    /// A computed number that is not zero is too small for a double.
    Underflow {
        /// What was computed.
        what: &'static str,
    },
}

impl FrustumError {
    pub(super) fn check_finite(what: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() {
            Ok(())
        } else {
            Err(Self::NonFinite { what, value })
        }
    }
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
            Self::EyeIsTarget { eye } => {
                write!(f, "eye and target are both {eye}; they must differ")
            }
            Self::UpAlongView { up } => write!(
                f,
                "up is {up}; it must be neither zero nor along the view direction"
            ),
            Self::FieldOfView { fovy } => write!(
                f,
                "fovy is {fovy} radians; it must be between 0 and pi, exclusive"
            ),
            Self::Aspect { aspect } => {
                write!(f, "aspect is {aspect}; it must be positive and finite")
            }
            Self::Height { height } => {
                write!(f, "height is {height}; it must be positive and finite")
            }
            Self::NearBehindEye { near } => write!(
                f,
                "near is {near}; a perspective camera needs it at 0 or beyond"
            ),
            Self::OffAxisAtEye => {
                f.write_str("near is 0; an off-axis rectangle needs a near distance above 0")
            }
            Self::FarNotBeyondNear { near, far } => {
                write!(f, "far is {far}; it must be beyond near, {near}")
            }
            Self::Overflow { what } => write!(f, "{what} is too large for a double"),
            Self::Underflow { what } => {
                write!(f, "{what} is too close to zero for a double")
            }
        }
    }
}

impl std::error::Error for FrustumError {}
