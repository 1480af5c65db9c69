//! From a frustum to a matrix.
//!
//! With the eye's distance W from a point along the depth, the center c = e + k W between left and
//! right and half their distance h W, clip X is (x - c) / h. The depth range goes from n at near, W = N,
//! to f at far, W = F: clip Z is a W + b with a = (f F - n N) / (F - N), b = (n - f) N F / (F - N);
//! without far a = f, b = (n - f) N. Parallel sides: W = 1, and X, Y, Z are linear.
//!
//! Everything is formed exactly from the frustum's numbers, as a quotient, and rounded once per entry.

use super::eye::Eye;
use crate::exact::dyadic::Dyadic;
use crate::exact::float::exp2;
use crate::frustum::eval::exact_vec::{Dyadic3, Rounded, dot, exact};
use crate::frustum::{
    Camera, ClipSpace, ClipY, EndRect, Frustum, FrustumError, MatrixLayout, Shape, ViewProjection,
};
use crate::math::Real;
use std::cmp::Ordering;

/// A linear function of points: coefficients and constant, over a common denominator.
struct Row {
    linear: Dyadic3,
    constant: Dyadic,
    denominator: Dyadic,
}

impl Row {
    /// `x . (p - o)`, for an axis of the frame.
    fn along(frustum: &Frustum, axis: usize) -> Self {
        let axis = exact(frustum.pose().axes[axis]);
        let constant = -&dot(&axis, &exact(frustum.pose().origin));
        Self {
            linear: axis,
            constant,
            denominator: 1.0.into(),
        }
    }

    fn scaled(&self, factor: &Dyadic) -> Self {
        Self {
            linear: self.linear.each_ref().map(|x| x * factor),
            constant: &self.constant * factor,
            denominator: self.denominator.clone(),
        }
    }

    /// The sum of two rows over the same denominator.
    fn plus(&self, other: &Self) -> Self {
        Self {
            linear: std::array::from_fn(|i| &self.linear[i] + &other.linear[i]),
            constant: &self.constant + &other.constant,
            denominator: self.denominator.clone(),
        }
    }

    fn plus_constant(mut self, constant: &Dyadic) -> Self {
        self.constant = &self.constant + constant;
        self
    }

    fn over(mut self, denominator: Dyadic) -> Self {
        self.denominator = denominator;
        self
    }

    fn constant(value: f64) -> Self {
        Self {
            linear: [0.0; 3].map(Dyadic::from),
            constant: value.into(),
            denominator: 1.0.into(),
        }
    }

    fn rounded(&self) -> Result<[f64; 4], FrustumError> {
        let [a, b, c] = &self.linear;
        let entries = [a, b, c, &self.constant].map(|x| x.ratio(&self.denominator));
        if entries.iter().all(|x| x.is_finite()) {
            Ok(entries)
        } else {
            Err(FrustumError::Overflow {
                what: "an entry of the matrix",
            })
        }
    }
}

impl Frustum {
    /// The view-projection matrix of this frustum, in any convention: it maps the frustum to the clip volume
    /// of `clip`.
    ///
    /// For cameras of world units, clip `W` is the distance from the eye along the view. Take the entries
    /// with [`ViewProjection::to_array`], those in single precision with [`ViewProjection::to_f32`].
    /// Points need no matrix: see [`Projector`](crate::Projector).
    ///
    /// Error: each entry is that of the frustum's own exact matrix, rounded once. The sides' bounds may differ from
    /// those of one eye by their rounding, `8 u`; then it is the matrix of that eye. In single
    /// precision a translation far from the origin costs digits; [`ViewProjection::frustum`] tells
    /// what is left.
    ///
    /// ```
    /// use frusta::{Camera, ClipSpace, MatrixLayout, Projection};
    ///
    /// let camera = Camera {
    ///     eye: [0.0, 0.0, 2.0].into(),
    ///     target: [0.0, 0.0, 0.0].into(),
    ///     up: [0.0, 1.0, 0.0].into(),
    ///     projection: Projection::OffAxis { rect: frusta::Rect::centred(1.0, 0.5) },
    ///     near: 1.0,
    ///     far: f64::INFINITY,
    /// };
    /// // As WebGPU wants it, with depth reversed.
    /// let matrix = camera.frustum()?.view_projection(ClipSpace::ZERO_TO_ONE.reversed())?;
    /// let columns = matrix.to_f32().to_array(MatrixLayout::ColumnMajorColumnVectors);
    /// assert_eq!(columns[0], [1.0, 0.0, 0.0, 0.0]);
    /// assert_eq!(columns[1], [0.0, 2.0, 0.0, 0.0]);
    /// assert_eq!(columns[2], [0.0, 0.0, 0.0, -1.0]);
    /// assert_eq!(columns[3], [0.0, 0.0, 1.0, 2.0]);
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    ///
    /// # Errors
    /// [`FrustumError::NoEye`] if the sides do not converge at one eye before near, nor are parallel;
    /// [`FrustumError::NearAtEye`] for a pyramid, and [`FrustumError::NoFarPlane`] for parallel sides without far: depth
    /// has no range there; [`FrustumError::Overflow`].
    pub fn view_projection(&self, clip: ClipSpace) -> Result<ViewProjection<f64>, FrustumError> {
        let near = self.shape().near();
        let [x, y, z, w] = match (Eye::of(self.shape()), self.shape()) {
            (Eye::Central { near: 0.0, .. }, _) => return Err(FrustumError::NearAtEye),
            (Eye::Central { near, far }, _) => self.central(near, far, clip),
            (Eye::Parallel { .. }, &Shape::Finite { far, .. }) => self.parallel(near, far, clip),
            (Eye::Parallel { .. }, _) => return Err(FrustumError::NoFarPlane),
            (Eye::None { .. }, _) => return Err(FrustumError::NoEye),
        };
        let y = match clip.y {
            ClipY::Up => y,
            ClipY::Down => y.scaled(&(-1.0).into()),
        };
        let rows = [x.rounded()?, y.rounded()?, z.rounded()?, w.rounded()?];
        Ok(ViewProjection::new(
            rows,
            MatrixLayout::RowMajorColumnVectors,
        ))
    }

    fn central(&self, near: f64, far: Option<f64>, clip: ClipSpace) -> [Row; 4] {
        let sigma = self.shape().direction().sign();
        let [n, f] = [Some(near), far].map(|w| w.map(Dyadic::from));
        let n = n.unwrap_or_else(|| 0.0.into());
        // W = sigma z + N - sigma z_near.
        let offset = &n - &Dyadic::from(sigma * self.shape().near().z);
        let w = Row::along(self, 2)
            .scaled(&sigma.into())
            .plus_constant(&offset);
        let [x, y] = [0, 1].map(|axis| self.across(axis, &n, f.as_ref(), &w));
        let (dn, df) = clip.depths();
        let (dn, df) = (Dyadic::from(dn), Dyadic::from(df));
        let z = match &f {
            Some(f) => {
                let slope = &(&df * f) - &(&dn * &n);
                let constant = &(&dn - &df) * &(&n * f);
                w.scaled(&slope).plus_constant(&constant).over(f - &n)
            }
            None => w.scaled(&df).plus_constant(&(&(&dn - &df) * &n)),
        };
        [x, y, z, w]
    }

    /// Clip `X` or `Y` of a central projection: `(x - e - k W) / h`.
    fn across(&self, axis: usize, n: &Dyadic, f: Option<&Dyadic>, w: &Row) -> Row {
        let (near, last) = match self.shape() {
            Shape::Finite { near, far } => (near.rect.to_array(), far.rect.to_array()),
            Shape::Infinite { near, slopes, .. } => (near.rect.to_array(), slopes.to_array()),
        };
        let i = 2 * axis;
        let sum = |r: [f64; 4]| &Dyadic::from(r[i]) + &Dyadic::from(r[i + 1]);
        let width = &Dyadic::from(last[i + 1]) - &Dyadic::from(last[i]);
        // Twice the center at the eye, times F - N (without far: times 1).
        let (one, depth): (Dyadic, Dyadic) = match f {
            Some(f) => (f.clone(), f - n),
            None => (1.0.into(), 1.0.into()),
        };
        let mut eye = &(&sum(near) * &one) - &(&sum(last) * n);
        let largest = |r: [f64; 4]| Dyadic::from(r[i].abs().max(r[i + 1].abs()));
        let rounding = &(&largest(near) * &one) + &(&largest(last) * n);
        let rounding = &rounding * &exp2(-50).into();
        if (&eye.clone().abs() - &rounding).order() != Ordering::Greater {
            eye = 0.0.into();
        }
        // h = width / (2 F), k = (center at far - e) / F; multiplied out by 2 F depth.
        let twice = &(&one * &depth) * &2.0.into();
        let k = &(&sum(last) * &depth) - &eye;
        let k = match f {
            Some(_) => k,
            None => &sum(last) * &depth,
        };
        Row::along(self, axis)
            .scaled(&twice)
            .plus_constant(&-&(&eye * &one))
            .plus(&w.scaled(&-&k))
            .over(&width * &depth)
    }

    fn parallel(&self, near: EndRect, far: EndRect, clip: ClipSpace) -> [Row; 4] {
        let sigma = self.shape().direction().sign();
        let from_near = Row::along(self, 2).plus_constant(&Dyadic::from(-near.z));
        // The distance from near, and the whole, both positive.
        let from_near = from_near.scaled(&sigma.into());
        let depth = (&Dyadic::from(far.z) - &Dyadic::from(near.z)).abs();
        let across = |axis: usize| {
            let i = 2 * axis;
            let (n, f) = (near.rect.to_array(), far.rect.to_array());
            let sum = |r: [f64; 4]| &Dyadic::from(r[i]) + &Dyadic::from(r[i + 1]);
            let width = &Dyadic::from(n[i + 1]) - &Dyadic::from(n[i]);
            let shear = &sum(n) - &sum(f);
            Row::along(self, axis)
                .scaled(&(&depth * &2.0.into()))
                .plus_constant(&-&(&sum(n) * &depth))
                .plus(&from_near.scaled(&shear))
                .over(&width * &depth)
        };
        let (dn, df) = clip.depths();
        let z = from_near
            .scaled(&(&Dyadic::from(df) - &Dyadic::from(dn)))
            .plus_constant(&(&Dyadic::from(dn) * &depth))
            .over(depth.clone());
        [across(0), across(1), z, Row::constant(1.0)]
    }
}

impl Camera {
    /// The view-projection matrix of this camera, in any convention: that of its frustum (see
    /// [`Frustum::view_projection`]).
    ///
    /// # Errors
    /// Those of [`Camera::frustum`] and of [`Frustum::view_projection`].
    pub fn view_projection(&self, clip: ClipSpace) -> Result<ViewProjection<f64>, FrustumError> {
        self.frustum()?.view_projection(clip)
    }
}

impl<T: Real> ViewProjection<T> {
    /// The matrix of the same projection in another convention: depth of another range or direction,
    /// `Y` the other way.
    ///
    /// Error: entries of the depth's row are rounded once; all others are the same.
    ///
    /// ```
    /// use frusta::{ClipSpace, MatrixLayout, ViewProjection};
    /// let rows = [
    ///     [1.0_f32, 0.0, 0.0, 0.0],
    ///     [0.0, 1.0, 0.0, 0.0],
    ///     [0.0, 0.0, -1.25, -2.25],
    ///     [0.0, 0.0, -1.0, 0.0],
    /// ];
    /// let opengl = ViewProjection::new(rows, MatrixLayout::RowMajorColumnVectors);
    /// let vulkan = opengl.converted(ClipSpace::OPENGL, ClipSpace::VULKAN);
    /// let rows = vulkan.to_array(MatrixLayout::RowMajorColumnVectors);
    /// assert_eq!(rows[1], [0.0, -1.0, 0.0, 0.0]);
    /// assert_eq!(rows[2], [0.0, 0.0, -1.125, -1.125]);
    /// ```
    #[must_use]
    pub fn converted(&self, from: ClipSpace, to: ClipSpace) -> Self {
        let [x, y, z, w] = self.to_array(MatrixLayout::RowMajorColumnVectors);
        let ((a, b), (c, d)) = (from.depths(), to.depths());
        // 1/2, 1 or 2, and -1 to 1 in halves: the products are exact, except for underflow.
        let slope = (d - c) / (b - a);
        let (slope, shift) = (T::from_f64(slope), T::from_f64(c - slope * a));
        let z = std::array::from_fn(|i| slope * z[i] + shift * w[i]);
        let y = if from.y == to.y {
            y
        } else {
            y.map(|e| T::ZERO - e)
        };
        Self::new([x, y, z, w], MatrixLayout::RowMajorColumnVectors)
    }

    /// The same matrix in `f64`; always exact.
    #[must_use]
    pub fn to_f64(&self) -> ViewProjection<f64> {
        self.map(T::to_f64)
    }

    /// The matrix in `f32`, each entry rounded; infinite beyond the range.
    #[must_use]
    pub fn to_f32(&self) -> ViewProjection<f32> {
        self.map(|e| f32::from_f64(e.to_f64()))
    }

    fn map<U: Real>(&self, f: impl Fn(T) -> U) -> ViewProjection<U> {
        let rows = self.to_array(MatrixLayout::RowMajorColumnVectors);
        ViewProjection::new(
            rows.map(|row| row.map(&f)),
            MatrixLayout::RowMajorColumnVectors,
        )
    }
}
