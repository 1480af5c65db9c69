//! The error type of all frustum constructors.

use crate::math::{Short, Vec3};
use std::fmt;

/// The reason why a description does not define a frustum.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FrustumError {
    /// A number is infinite or NaN.
    NonFinite {
        /// The name of the number.
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
        /// The name of the rectangle: `near`, `far`, `slopes`, `rect` (a camera's), `window`.
        end: &'static str,
        /// The pair of bounds, such as `left..right`.
        what: &'static str,
        /// The lower bound.
        low: f64,
        /// The upper bound.
        high: f64,
    },
    /// A pair of bounds coincides at both ends, so that nothing lies strictly between.
    Flat {
        /// The pair of bounds, such as `left..right`.
        what: &'static str,
    },
    /// The three axes do not span space (their exact determinant is zero).
    DependentAxes,
    /// The camera's target is its eye, so that there is no view direction.
    EyeIsTarget {
        /// The common point.
        eye: Vec3<f64>,
    },
    /// The camera's `up` is zero or exactly along the view direction.
    UpAlongView {
        /// The camera's `up`.
        up: Vec3<f64>,
    },
    /// The field of view is not strictly between 0 and `PI` radians.
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
    /// The rectangle of an off-axis perspective is at distance 0.
    OffAxisAtEye,
    /// The far distance is not greater than the near distance.
    FarNotBeyondNear {
        /// The near distance.
        near: f64,
        /// The far distance.
        far: f64,
    },
    /// A computed number is too large for an `f64`.
    Overflow {
        /// The name of the computed number.
        what: &'static str,
    },
    /// A computed number is not zero, but too close to it for an `f64` of full precision.
    Underflow {
        /// The name of the computed number.
        what: &'static str,
    },
    /// Two points that must differ are the same.
    SamePoint {
        /// Their names.
        what: [&'static str; 2],
        /// Their common position.
        at: Vec3<f64>,
    },
    /// Two edges that must be at a right angle are at another one.
    Skew {
        /// The names of the points to which the edges lead from their centres.
        what: [&'static str; 2],
        /// The cosine of their angle.
        cosine: f64,
    },
    /// A point of the top lies opposite its counterpart on the base.
    WrongSide {
        /// The point's name.
        what: &'static str,
    },
    /// The tile's column or row is beyond the last one.
    NoSuchTile {
        /// The requested column, counted from 0.
        column: u32,
        /// The requested row, counted from 0.
        row: u32,
        /// Number of columns.
        columns: u32,
        /// Number of rows.
        rows: u32,
    },
    /// The distance of convergence is 0 or NaN.
    Convergence {
        /// The requested distance.
        convergence: f64,
    },
    /// The matrix is exactly singular: clip coordinates do not determine the point.
    SingularMatrix,
    /// The `W` of an orthographic matrix is not positive, so that nothing is in
    /// view.
    NegativeW {
        /// The constant `W`.
        w: f64,
    },
    /// The near and far planes of the matrix are not parallel to its picture.
    TiltedDepth {
        /// The sine of the angle between the `Z` and the `W` row.
        sine: f64,
    },
    /// The same, but those of the transposed matrix are: most likely the layout is another one.
    Transposed {
        /// The sine of the angle between the `Z` and the `W` row.
        sine: f64,
    },
    /// The near plane of the matrix is not in front of the eye. The cause is a
    /// wrong depth range or reversal, or a negated matrix.
    NoNearPlane {
        /// The clip `W` of the near plane.
        w: f64,
    },
    /// The far plane of the matrix is behind the eye, by more than rounding explains.
    FarBehindEye {
        /// The clip `W` of the far plane.
        w: f64,
    },
    /// The sides neither converge at one eye before near nor are parallel, so that no matrix
    /// projects this frustum.
    NoEye,
    /// Near is at the eye (a pyramid), where no matrix has a depth.
    NearAtEye,
    /// Parallel sides without a far end: no matrix has a depth for them.
    NoFarPlane,
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
    // Long, with one arm for each variant.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NonFinite { what, value } => {
                write!(f, "{what} is {}; it must be finite", Short(*value))
            }
            Self::NoDepth { z } => write!(
                f,
                "near and far are both at z = {}; they must differ",
                Short(*z)
            ),
            Self::Inverted {
                end,
                what,
                low,
                high,
            } => write!(
                f,
                "{end} {what} is {}..{}; the lower bound must not exceed the upper",
                Short(*low),
                Short(*high)
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
                "fovy is {} radians; it must be between 0 and pi, exclusive",
                Short(*fovy)
            ),
            Self::Aspect { aspect } => {
                write!(
                    f,
                    "aspect is {}; it must be positive and finite",
                    Short(*aspect)
                )
            }
            Self::Height { height } => {
                write!(
                    f,
                    "height is {}; it must be positive and finite",
                    Short(*height)
                )
            }
            Self::NearBehindEye { near } => write!(
                f,
                "near is {}; for a perspective camera it must be 0 or greater",
                Short(*near)
            ),
            Self::OffAxisAtEye => {
                f.write_str("near is 0; for an off-axis rectangle it must be greater than 0")
            }
            Self::FarNotBeyondNear { near, far } => {
                write!(
                    f,
                    "far is {}; it must be beyond near, {}",
                    Short(*far),
                    Short(*near)
                )
            }
            Self::Overflow { what } => write!(f, "{what} is too large for an f64"),
            Self::Underflow { what } => {
                write!(f, "{what} is too close to zero for an f64")
            }
            Self::SamePoint { what: [a, b], at } => {
                write!(f, "{a} and {b} are both {at}; they must differ")
            }
            Self::Skew {
                what: [a, b],
                cosine,
            } => write!(
                f,
                "the edges to {a} and {b} meet at cosine {}; they must be at a right angle",
                Short(*cosine)
            ),
            Self::WrongSide { what } => {
                write!(f, "{what} lies opposite its counterpart on the base")
            }
            Self::NoSuchTile {
                column,
                row,
                columns,
                rows,
            } => write!(
                f,
                "there is no tile {column}, {row} in {columns} by {rows} tiles, counted from 0"
            ),
            Self::Convergence { convergence } => write!(
                f,
                "the convergence is {}; it must be a number other than 0",
                Short(*convergence)
            ),
            Self::SingularMatrix => f.write_str("the matrix is singular"),
            Self::NegativeW { w } => {
                write!(
                    f,
                    "the matrix gives W = {} everywhere; W must be positive",
                    Short(*w)
                )
            }
            Self::TiltedDepth { sine } => write!(
                f,
                "the matrix's near and far planes are not parallel to its picture (sine {})",
                Short(*sine)
            ),
            Self::Transposed { sine } => write!(
                f,
                "the matrix looks transposed (rows and columns exchanged): its near and far planes \
                 are not parallel to its picture (sine {}), those of its transpose are",
                Short(*sine)
            ),
            Self::NoNearPlane { w } => write!(
                f,
                "the matrix's near plane is not in front of the eye (W = {}): wrong depth range, \
                 reversal or sign?",
                Short(*w)
            ),
            Self::FarBehindEye { w } => write!(
                f,
                "the matrix's far plane is behind the eye (W = {}): wrong depth range or reversal?",
                Short(*w)
            ),
            Self::NoEye => f.write_str(
                "the sides neither converge at one eye before near nor are parallel: no matrix projects them",
            ),
            Self::NearAtEye => f.write_str("near is at the eye: a matrix needs it before the eye"),
            Self::NoFarPlane => {
                f.write_str("a parallel projection without far has no matrix: give it a far distance")
            }
        }
    }
}

impl std::error::Error for FrustumError {}

/// The names of a matrix's entries, in messages.
pub(super) const MATRIX_ENTRIES: [[&str; 4]; 4] = [
    [
        "row 0, column 0",
        "row 0, column 1",
        "row 0, column 2",
        "row 0, column 3",
    ],
    [
        "row 1, column 0",
        "row 1, column 1",
        "row 1, column 2",
        "row 1, column 3",
    ],
    [
        "row 2, column 0",
        "row 2, column 1",
        "row 2, column 2",
        "row 2, column 3",
    ],
    [
        "row 3, column 0",
        "row 3, column 1",
        "row 3, column 2",
        "row 3, column 3",
    ],
];
