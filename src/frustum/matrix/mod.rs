//! A frustum from a view-projection matrix.
//!
//! A point is in view if its clip coordinates `(X, Y, Z, W) = M p` satisfy
//! `W > 0`, `-W <= X <= W`, `-W <= Y <= W` and the two bounds of the
//! [`ClipSpace`]'s depth. `X`, `Y`, `W` are linear in `p`, so they can *be* the
//! frame: the axes are the matrix's own rows, unrounded, whatever their lengths
//! and angles; the sides are `x = +-z`, `y = +-z`. Three things remain:
//!
//! 1. the eye, where `X = Y = W = 0`: an exact 3x3 system, each coordinate
//!    rounded once;
//! 2. `Z = c X + d Y + a W + b`, exactly. The depth bounds are then `W >= near`,
//!    `W <= far` along the middle of the view, each rounded once. Nothing cancels
//!    that did not cancel when the matrix was made;
//! 3. `c` and `d`: zero, unless rounding of the matrix tilted the near and far
//!    planes relative to the picture. [`Deviation`] reports their effect; it is not
//!    corrected.
//!
//! Where `W` is constant the projection is parallel, and `X`, `Y`, `Z` are the
//! frame. Conventions are types, because a wrong one can give a frustum that
//! looks right: see [`ClipSpace`] and [`MatrixLayout`]. Handedness needs no
//! convention; the rows determine it.

//! [`proved`] finds the numbers in double-double with a bound on their error, which nearly always proves how
//! they round; else, and for every error, [`integers`] does. [`deviation`] is computed when it is asked for.

mod deviation;
mod integers;
mod proved;

pub use deviation::{Deviation, MatrixFrustum};

use super::error::MATRIX_ENTRIES;
use super::{Direction, EndRect, Frustum, FrustumError, Shape};
use crate::math::{Pose, Real, Rect, Vec3};

/// The storage order of a matrix, and the side on which it multiplies points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MatrixLayout {
    /// `m[i]` is row `i`, and clip coordinates are `M p`: mathematics, C arrays
    /// of HLSL `row_major` matrices with `mul(M, p)`.
    RowMajorColumnVectors,
    /// `m[j]` is column `j`, and clip coordinates are `M p`: OpenGL, GLSL, WGSL
    /// memory, glam's `to_cols_array_2d`, nalgebra's storage, three.js.
    ColumnMajorColumnVectors,
    /// `m[i]` is row `i`, and clip coordinates are `p M`: DirectXMath, XNA,
    /// `System.Numerics`. The same memory as `ColumnMajorColumnVectors`.
    RowMajorRowVectors,
    /// `m[j]` is column `j`, and clip coordinates are `p M`. The same memory as
    /// `RowMajorColumnVectors`.
    ColumnMajorRowVectors,
}

impl MatrixLayout {
    fn holds_columns(self) -> bool {
        matches!(
            self,
            Self::ColumnMajorColumnVectors | Self::RowMajorRowVectors
        )
    }
}

/// The range of `Z / W` in view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DepthRange {
    /// `0 <= Z <= W`: Direct3D, Vulkan, Metal, WebGPU.
    ZeroToOne,
    /// `-W <= Z <= W`: OpenGL, WebGL.
    MinusOneToOne,
}

/// The direction of clip `Y` in the picture. It only decides which side is the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ClipY {
    /// Larger `Y` is higher: all interfaces except Vulkan.
    Up,
    /// Larger `Y` is lower: Vulkan, unless its viewport is flipped.
    Down,
}

/// The conventions of the clip space that a view-projection matrix maps to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClipSpace {
    /// The range of depths.
    pub depth: DepthRange,
    /// Whether the near face has the *largest* depth (reversed depth).
    pub reversed: bool,
    /// The direction of clip `Y`.
    pub y: ClipY,
}

impl ClipSpace {
    /// OpenGL, WebGL: depth `-1..1`, near at -1.
    pub const OPENGL: Self = Self {
        depth: DepthRange::MinusOneToOne,
        reversed: false,
        y: ClipY::Up,
    };
    /// Direct3D, Metal, WebGPU: depth `0..1`, near at 0.
    pub const ZERO_TO_ONE: Self = Self {
        depth: DepthRange::ZeroToOne,
        reversed: false,
        y: ClipY::Up,
    };
    /// Vulkan: depth `0..1`, near at 0, `Y` down.
    pub const VULKAN: Self = Self {
        depth: DepthRange::ZeroToOne,
        reversed: false,
        y: ClipY::Down,
    };

    /// The same clip space with near at the largest depth.
    #[must_use]
    pub const fn reversed(self) -> Self {
        Self {
            reversed: true,
            ..self
        }
    }

    /// The least `Z / W` in view.
    fn lowest_depth(self) -> f64 {
        match self.depth {
            DepthRange::ZeroToOne => 0.0,
            DepthRange::MinusOneToOne => -1.0,
        }
    }
}

/// A world-to-clip matrix whose layout is known.
///
/// ```
/// use frusta::{ClipSpace, MatrixLayout, ViewProjection};
/// // 90 degrees, looking along -z from the origin, near 1, far at infinity,
/// // depth reversed.
/// let matrix = ViewProjection::new(
///     [
///         [1.0_f32, 0.0, 0.0, 0.0],
///         [0.0, 1.0, 0.0, 0.0],
///         [0.0, 0.0, 0.0, 1.0],
///         [0.0, 0.0, -1.0, 0.0],
///     ],
///     MatrixLayout::RowMajorColumnVectors,
/// );
/// let found = matrix.frustum(ClipSpace::ZERO_TO_ONE.reversed())?;
/// assert_eq!(found.frustum.shape().near().z, 1.0);
/// assert!(found.frustum.shape().far().is_none());
/// assert_eq!(found.deviation().sides, 0.0);
/// # Ok::<(), frusta::FrustumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewProjection<T> {
    rows: [[T; 4]; 4],
}

/// The rows of a matrix: linear parts and constants.
#[derive(Clone, Copy, Debug)]
struct Rows {
    x: Vec3<f64>,
    y: Vec3<f64>,
    z: Vec3<f64>,
    w: Vec3<f64>,
    /// The constants of the four rows, in the same order.
    constants: [f64; 4],
}

impl<T: Real> ViewProjection<T> {
    /// Creates a matrix from its entries in the given layout.
    #[must_use]
    pub fn new(entries: [[T; 4]; 4], layout: MatrixLayout) -> Self {
        Self {
            rows: if layout.holds_columns() {
                transposed(entries)
            } else {
                entries
            },
        }
    }

    /// Creates a matrix from its entries in memory order: four rows or four columns,
    /// depending on the layout.
    ///
    /// ```
    /// use frusta::{MatrixLayout, ViewProjection};
    /// let entries: [f64; 16] = std::array::from_fn(|i| i as f64);
    /// let matrix = ViewProjection::from_flat(entries, MatrixLayout::ColumnMajorColumnVectors);
    /// let rows = matrix.to_array(MatrixLayout::RowMajorColumnVectors);
    /// assert_eq!(rows[0], [0.0, 4.0, 8.0, 12.0]);
    /// ```
    #[must_use]
    pub fn from_flat(entries: [T; 16], layout: MatrixLayout) -> Self {
        let entries = std::array::from_fn(|i| std::array::from_fn(|j| entries[4 * i + j]));
        Self::new(entries, layout)
    }

    /// The entries in the given layout.
    #[must_use]
    pub fn to_array(&self, layout: MatrixLayout) -> [[T; 4]; 4] {
        if layout.holds_columns() {
            transposed(self.rows)
        } else {
            self.rows
        }
    }

    /// The frustum that the matrix maps to the clip volume.
    ///
    /// A far plane at infinity, or beyond it by no more than rounding explains, gives
    /// an infinite frustum. An `f32` matrix for `near = 1e-6, far = 1e6` without
    /// reversed depth is such a case: its entries do not determine the far plane.
    ///
    /// Error: [`Deviation`] bounds it, for each matrix. It is relative to the exact
    /// clip volume of the given entries; errors of those entries are not part of it
    /// (in `f32`, a near plane at 0.1 seen from an eye at 1e7 is lost).
    ///
    /// # Errors
    /// [`FrustumError::NonFinite`], which names the entry;
    /// [`FrustumError::SingularMatrix`]; [`FrustumError::NegativeW`];
    /// [`FrustumError::TiltedDepth`] for near and far planes that are not
    /// parallel to the picture, by more than `64 u` (`u` of `T`), or
    /// [`FrustumError::Transposed`] if those of the transposed matrix are;
    /// [`FrustumError::NoNearPlane`] and [`FrustumError::FarBehindEye`], mostly for a
    /// wrong [`ClipSpace`]; [`FrustumError::FarNotBeyondNear`];
    /// [`FrustumError::Overflow`].
    pub fn frustum(&self, clip: ClipSpace) -> Result<MatrixFrustum, FrustumError> {
        let transposed = || Self {
            rows: transposed(self.rows),
        };
        match self.frustum_as_it_stands(clip) {
            Err(FrustumError::TiltedDepth { sine })
                if !self.axes_are_square()
                    && transposed().axes_are_square()
                    && transposed().frustum_as_it_stands(clip).is_ok() =>
            {
                Err(FrustumError::Transposed { sine })
            }
            done => done,
        }
    }

    /// Whether the picture's axes are at a right angle, as every camera's are; seen along the view
    /// direction, to which an off-axis rectangle tilts them. A guess, for a message.
    fn axes_are_square(&self) -> bool {
        let [x, y, _, w] = self.rows.map(|[a, b, c, _]| Vec3::new(a, b, c).to_f64());
        let across = |v: Vec3<f64>| {
            let along = v.dot(w) / w.dot(w);
            let along = if along.is_finite() { along } else { 0.0 };
            Vec3::new(v.x - along * w.x, v.y - along * w.y, v.z - along * w.z)
        };
        let (x, y) = (across(x), across(y));
        let cosine = x.dot(y) / (x.dot(x) * y.dot(y)).sqrt();
        cosine.abs() < 1e-3
    }

    fn frustum_as_it_stands(&self, clip: ClipSpace) -> Result<MatrixFrustum, FrustumError> {
        let mut rows = [[0.0; 4]; 4];
        for (i, row) in self.rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                rows[i][j] = entry.to_f64();
                FrustumError::check_finite(MATRIX_ENTRIES[i][j], rows[i][j])?;
            }
        }
        if clip.y == ClipY::Down {
            rows[1] = rows[1].map(|e| 0.0 - e);
        }
        let [x, y, z, w] = rows.map(|[a, b, c, _]| Vec3::new(a, b, c));
        let rows = Rows {
            x,
            y,
            z,
            w,
            constants: rows.map(|row| row[3]),
        };
        let frustum = if w == Vec3::default() {
            parallel(&rows, clip)?
        } else {
            perspective(&rows, clip, 64.0 * T::UNIT_ROUNDOFF)?
        };
        Ok(MatrixFrustum::new(frustum, rows, clip))
    }
}

/// What a perspective matrix determines.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Eye {
    origin: Vec3<f64>,
    near: f64,
    far: Option<f64>,
}

#[inline(always)]
fn perspective(rows: &Rows, clip: ClipSpace, slack: f64) -> Result<Frustum, FrustumError> {
    let Eye { origin, near, far } = match proved::eye(rows, clip, slack) {
        Some(eye) => eye,
        None => integers::eye(rows, clip, slack)?,
    };
    let square = |z| EndRect {
        z,
        rect: Rect::centred(z, z),
    };
    let shape = match far {
        Some(far) => Shape::Finite {
            near: square(near),
            far: square(far),
        },
        None => Shape::Infinite {
            near: square(near),
            slopes: Rect::centred(1.0, 1.0),
            direction: Direction::PlusZ,
        },
    };
    Frustum::new(Pose::new(origin, [rows.x, rows.y, rows.w]), shape)
}

#[inline(always)]
fn parallel(rows: &Rows, clip: ClipSpace) -> Result<Frustum, FrustumError> {
    let [x, y, z, w] = rows.constants;
    if w <= 0.0 {
        return Err(FrustumError::NegativeW { w });
    }
    let axes = [rows.x, rows.y, rows.z];
    let origin = match proved::zero(axes, [x, y, z]) {
        Some(origin) => origin,
        None => integers::System::new(axes)?.zero([x, y, z])?,
    };
    let low = clip.lowest_depth() * w;
    let (near, far) = if clip.reversed { (w, low) } else { (low, w) };
    let rect = Rect::centred(w, w);
    let shape = Shape::Finite {
        near: EndRect { z: near, rect },
        far: EndRect { z: far, rect },
    };
    Frustum::new(Pose::new(origin, axes), shape)
}

fn transposed<T: Copy>(m: [[T; 4]; 4]) -> [[T; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}
