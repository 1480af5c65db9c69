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

use super::error::MATRIX_ENTRIES;
use super::eval::exact_vec::{Dyadic, Dyadic3, Rounded, cross, dot, exact, unit};
use super::{Direction, EndRect, Frustum, FrustumError, Shape};
use crate::math::{Pose, Real, Rect, Vec3};
use std::cmp::Ordering;

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
/// assert_eq!(found.deviation.sides, 0.0);
/// # Ok::<(), frusta::FrustumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewProjection<T> {
    rows: [[T; 4]; 4],
}

/// A frustum from a matrix, and its deviation from the exact clip volume.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixFrustum {
    /// The frustum. Frame `z` is clip `W`: the distance from the eye for the
    /// usual matrices, in any unit otherwise. (Orthographic: clip `Z`.)
    pub frustum: Frustum,
    /// The measured deviation.
    pub deviation: Deviation,
}

/// The largest deviation of a frustum's vertices from the exact clip volume of
/// its matrix.
///
/// Each number is the exact maximum, rounded up to the next `f64`: an upper
/// bound, and 0 only if there is no deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The deviation of `X / W` and `Y / W` from `+-1`, which rounding of the
    /// eye causes. Infinite if it moves a near vertex to `W <= 0`.
    pub sides: f64,
    /// The deviation of the near vertices from the matrix's near plane, along
    /// `W`, as a fraction of the near distance (orthographic: along `Z`, as a
    /// fraction of the depth). Rounding causes it, and the tilt of that plane.
    pub near: f64,
    /// The same for the far vertices and the far plane, as a fraction of the far
    /// distance (orthographic: of the depth). At 1 and above, rounding of the
    /// matrix's entries has left no usable far plane. For an infinite frustum:
    /// the near distance divided by the least `W` at which the matrix's far
    /// plane, tilted by rounding alone, enters the clip volume; 0 if it does
    /// not.
    pub far: f64,
}

/// The rows of a matrix: linear parts and constants.
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
        if w == Vec3::default() {
            parallel(&rows, clip)
        } else {
            perspective(&rows, clip, 64.0 * T::UNIT_ROUNDOFF)
        }
    }
}

fn transposed<T: Copy>(m: [[T; 4]; 4]) -> [[T; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// Three rows as a system of equations, solved by Cramer's rule.
struct System {
    /// Columns of the adjugate; the determinant is made positive.
    columns: [Dyadic3; 3],
    determinant: Dyadic,
}

impl System {
    fn new(rows: [Vec3<f64>; 3]) -> Result<Self, FrustumError> {
        let [a, b, c] = rows.map(exact);
        let columns = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
        let determinant = dot(&a, &columns[0]);
        match determinant.order() {
            Ordering::Equal => Err(FrustumError::SingularMatrix),
            Ordering::Greater => Ok(Self {
                columns,
                determinant,
            }),
            Ordering::Less => Ok(Self {
                columns: columns.map(|v| v.map(|x| -&x)),
                determinant: -&determinant,
            }),
        }
    }

    /// The point where `row . p + constant` is zero for all three, rounded.
    fn zero(&self, constants: [f64; 3]) -> Result<Vec3<f64>, FrustumError> {
        let c = constants.map(|c| Dyadic::from(0.0 - c));
        let p = Vec3::from(std::array::from_fn(|i| {
            let term = |k: usize| &self.columns[k][i] * &c[k];
            (&(&term(0) + &term(1)) + &term(2)).ratio(&self.determinant)
        }));
        if p.is_finite() {
            Ok(p)
        } else {
            Err(FrustumError::Overflow { what: "the origin" })
        }
    }

    /// The coefficients of a vector in terms of the three rows, times the determinant.
    fn coefficients(&self, v: Vec3<f64>) -> Dyadic3 {
        let v = exact(v);
        std::array::from_fn(|k| dot(&self.columns[k], &v))
    }
}

/// The exact value of a row at a point.
fn value(row: Vec3<f64>, constant: f64, p: Vec3<f64>) -> Dyadic {
    &dot(&exact(row), &exact(p)) + &constant.into()
}

fn parallel(rows: &Rows, clip: ClipSpace) -> Result<MatrixFrustum, FrustumError> {
    let [x, y, z, w] = rows.constants;
    if w <= 0.0 {
        return Err(FrustumError::NegativeW { w });
    }
    let axes = [rows.x, rows.y, rows.z];
    let origin = System::new(axes)?.zero([x, y, z])?;
    let low = match clip.depth {
        DepthRange::ZeroToOne => 0.0,
        DepthRange::MinusOneToOne => -w,
    };
    let (near, far) = if clip.reversed { (w, low) } else { (low, w) };
    let rect = Rect::centred(w, w);
    // A vertex is off by the clip coordinates of the rounded origin, which would be 0.
    let residual = |row, constant| value(row, constant, origin).abs();
    let sides = residual(rows.x, x).max(residual(rows.y, y));
    let w = Dyadic::from(w);
    let depth = residual(rows.z, z).ratio_up(&(&w - &low.into()));
    let shape = Shape::Finite {
        near: EndRect { z: near, rect },
        far: EndRect { z: far, rect },
    };
    Ok(MatrixFrustum {
        frustum: Frustum::new(Pose::new(origin, axes), shape)?,
        deviation: Deviation {
            sides: sides.ratio_up(&w),
            near: depth,
            far: depth,
        },
    })
}

/// A bound on depth, `z Z + w W >= 0`.
///
/// Along the middle of the view, where `X = Y = 0`, it is a function of `W`
/// alone: `slope * W + constant >= 0` (both times the determinant).
struct DepthBound {
    z: f64,
    w: f64,
    slope: Dyadic,
    constant: Dyadic,
}

/// `Z` in terms of `X, Y, W`, all times the determinant, which is positive.
struct Depth {
    /// `|c| + |d|`: the tilt.
    tilt: Dyadic,
    determinant: Dyadic,
    near: DepthBound,
    far: DepthBound,
}

impl Depth {
    fn new(rows: &Rows, system: &System, clip: ClipSpace) -> Self {
        let [c, d, a] = system.coefficients(rows.z);
        let [x, y, z, w] = rows.constants.map(Dyadic::from);
        let determinant = system.determinant.clone();
        let plane = &(&(&c * &x) + &(&d * &y)) + &(&a * &w);
        let at_eye = &(&z * &determinant) - &plane;
        let low = match clip.depth {
            DepthRange::ZeroToOne => 0.0,
            DepthRange::MinusOneToOne => -1.0,
        };
        let bound = |z: f64, w: f64| DepthBound {
            z,
            w,
            slope: &(&a * &z.into()) + &(&determinant * &w.into()),
            constant: &at_eye * &z.into(),
        };
        let above = bound(1.0, 0.0 - low);
        let below = bound(-1.0, 1.0);
        let (near, far) = if clip.reversed {
            (below, above)
        } else {
            (above, below)
        };
        Self {
            tilt: &c.abs() + &d.abs(),
            determinant,
            near,
            far,
        }
    }

    fn near_distance(&self) -> Result<f64, FrustumError> {
        let near = &self.near;
        let distance = (-&near.constant).ratio(&near.slope);
        if near.slope.order() != Ordering::Greater || near.constant.order() == Ordering::Greater {
            return Err(FrustumError::NoNearPlane { w: distance });
        }
        if near.constant.order() == Ordering::Equal {
            // Depth does not vary.
            return Err(FrustumError::SingularMatrix);
        }
        if distance == 0.0 {
            return Err(FrustumError::Underflow {
                what: "the near distance",
            });
        }
        if distance.is_infinite() {
            return Err(FrustumError::Overflow {
                what: "the near distance",
            });
        }
        Ok(distance)
    }

    /// The far distance; `None` for an infinite frustum.
    fn far_distance(&self, near: f64, slack: f64) -> Result<Option<f64>, FrustumError> {
        let far = &self.far;
        if far.slope.order() != Ordering::Less {
            // The plane is at infinity, or beyond it.
            let beyond = far.slope.ratio(&self.determinant);
            if beyond > slack {
                let w = far.constant.ratio(&-&far.slope);
                return Err(FrustumError::FarBehindEye { w });
            }
            return Ok(None);
        }
        let distance = far.constant.ratio(&-&far.slope);
        if distance.is_infinite() {
            return Err(FrustumError::Overflow {
                what: "the far distance",
            });
        }
        if distance <= near {
            return Err(FrustumError::FarNotBeyondNear {
                near,
                far: distance,
            });
        }
        Ok(Some(distance))
    }

    /// The distance along `W` between a bound's plane and the vertices at
    /// `distance`, as a fraction of it, rounded up. `z` and `w` are the clip
    /// coordinates of the frustum's origin.
    fn displacement(&self, bound: &DepthBound, distance: f64, z: &Dyadic, w: &Dyadic) -> f64 {
        // The vertices are at D (+-1, +-1, 1) in the frame, so the bound's value there is
        // +-c D +- d D + slope D + (its value at the origin). It changes by `slope` along W.
        let distance = Dyadic::from(distance);
        let at_origin = &(z * &bound.z.into()) + &(w * &bound.w.into());
        let middle = &(&bound.slope * &distance) + &(&at_origin * &self.determinant);
        let largest = &(&self.tilt * &distance) + &middle.abs();
        largest.ratio_up(&(&bound.slope.clone().abs() * &distance))
    }

    /// The near distance divided by the least `W` at which a tilted far plane
    /// enters the clip volume, rounded up.
    fn stray_far_plane(&self, near: f64) -> f64 {
        // Along the edges X, Y = +-W the bound is (slope - tilt) W + constant >= 0.
        let excess = &self.tilt - &self.far.slope;
        match excess.order() {
            Ordering::Greater => (&excess * &near.into()).ratio_up(&self.far.constant),
            _ => 0.0,
        }
    }
}

fn perspective(rows: &Rows, clip: ClipSpace, slack: f64) -> Result<MatrixFrustum, FrustumError> {
    let axes = [rows.x, rows.y, rows.w];
    let system = System::new(axes)?;
    check_tilt(rows, slack)?;
    let depth = Depth::new(rows, &system, clip);
    let near = depth.near_distance()?;
    let far = depth.far_distance(near, slack)?;
    let [x, y, z, w] = rows.constants;
    let origin = system.zero([x, y, w])?;
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

    // Clip coordinates of the rounded origin, where X, Y and W would be 0.
    let x = value(rows.x, x, origin).abs();
    let y = value(rows.y, y, origin).abs();
    let z = value(rows.z, z, origin);
    let w = value(rows.w, w, origin);
    let deviation = Deviation {
        sides: sides(x.max(y), &w, near),
        near: depth.displacement(&depth.near, near, &z, &w),
        far: match far {
            Some(far) => depth.displacement(&depth.far, far, &z, &w),
            None => depth.stray_far_plane(near),
        },
    };
    Ok(MatrixFrustum {
        frustum: Frustum::new(Pose::new(origin, axes), shape)?,
        deviation,
    })
}

/// [`Deviation::sides`], from the clip coordinates of the rounded origin: the
/// larger of `|X|` and `|Y|`, and `W`.
fn sides(across: Dyadic, w: &Dyadic, near: f64) -> f64 {
    // At a near vertex X is +-near + X_origin and W is near + W_origin, so |X / W -+ 1| is
    // |X_origin -+ W_origin| / W. At a far vertex W is larger.
    let at_vertex = w + &near.into();
    match at_vertex.order() {
        Ordering::Greater => (&across + &w.clone().abs()).ratio_up(&at_vertex),
        _ => f64::INFINITY,
    }
}

/// Near and far planes are combinations of the rows `Z` and `W`: parallel to
/// the picture if these two are.
fn check_tilt(rows: &Rows, slack: f64) -> Result<(), FrustumError> {
    let (Some(z), Some(w)) = (unit(&exact(rows.z)), unit(&exact(rows.w))) else {
        // `Z` is zero, for depth reversed to infinity; `W` is not.
        return Ok(());
    };
    let sine = z.cross(w);
    let sine = sine.dot(sine).sqrt();
    // The rounding error of `W` is part of a short `Z`, too. If the lengths differ by a
    // factor beyond the range of `f64`, the quotient is infinite.
    let largest = |v: Vec3<f64>| v.x.abs().max(v.y.abs()).max(v.z.abs());
    if sine > slack * (1.0 + largest(rows.w) / largest(rows.z)) {
        Err(FrustumError::TiltedDepth { sine })
    } else {
        Ok(())
    }
}
