//! A frustum's coefficients, rounded to the scalar type of the segments.
//!
//! They are prepared once per frustum, so that the plain tier of every clipper
//! starts from the same coefficients. In the frame a point `(x, y, z)` has the
//! depth `w = s z - s z_near` (`s` is the direction), and six boundary values,
//! each zero on its face and positive inside:
//!
//! ```text
//! near: w        left:  x - (left  + slope w)      bottom: y - (bottom + slope w)
//! far:  s z_far - s z    right: (right + slope w) - x      top:    (top + slope w) - y
//! ```
//!
//! A symmetric frustum has one half-width for two sides, `u = right + slope w`,
//! with values `u + x` and `u - x`; an orthographic one has no slopes, an
//! infinite one no far value. In the world each value is a plane `n . p + d`.
//!
//! Coefficients beyond the range of the scalar type are clamped to it, so that
//! none is infinite or NaN. The results of plain arithmetic are then meaningless,
//! but finite.

use crate::frustum::{Face, Shape};
use crate::math::{PerReal, Pose, Real, Vec3};
use std::ops::{Add, Mul, Sub};
use wide::f64x2;

/// The form of a frustum, which decides how cheaply its values can be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Opposite sides mirror each other.
    Symmetric,
    /// Any two rectangles.
    General,
    /// No slopes.
    Orthographic,
    /// No far face; opposite sides mirror each other.
    InfiniteSymmetric,
    /// No far face.
    Infinite,
}

impl Form {
    /// The cheapest form that fits.
    pub(crate) fn of(shape: &Shape) -> Self {
        match shape {
            Shape::Finite { near, far } if near.rect == far.rect => Form::Orthographic,
            Shape::Finite { near, far } if near.rect.is_symmetric() && far.rect.is_symmetric() => {
                Form::Symmetric
            }
            Shape::Finite { .. } => Form::General,
            Shape::Infinite { near, slopes, .. }
                if near.rect.is_symmetric() && slopes.is_symmetric() =>
            {
                Form::InfiniteSymmetric
            }
            Shape::Infinite { .. } => Form::Infinite,
        }
    }
}

/// The points with `normal . p + offset >= 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane<T> {
    pub(crate) normal: Vec3<T>,
    pub(crate) offset: T,
}

impl<T: Real> Plane<T> {
    /// Positive inside, zero on the plane.
    #[inline(always)]
    pub(crate) fn value(&self, p: Vec3<T>) -> T {
        self.normal.dot(p) + self.offset
    }
}

/// A frustum for plain arithmetic in `T`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlainFrustum<T> {
    pub(crate) form: Form,
    /// Whether world coordinates are frame coordinates.
    pub(crate) identity: bool,
    /// The direction of growing depth, `1` or `-1`.
    pub(crate) sign: T,
    /// `sign * z_near`.
    pub(crate) near: T,
    /// `sign * z_far`; unused in an infinite frustum.
    pub(crate) far: T,
    /// Bounds at the near end: left, right, bottom, top.
    pub(crate) bounds: [T; 4],
    /// Their change for each unit of depth.
    pub(crate) slopes: [T; 4],
    /// The pose.
    pub(crate) origin: Vec3<T>,
    pub(crate) axes: [Vec3<T>; 3],
    /// The faces' planes in the world; `Far` is unused in an infinite frustum.
    pub(crate) planes: [Plane<T>; 6],
    /// If the sum of the magnitudes of a segment's coordinates is below this, no
    /// intermediate result of its clip overflows.
    pub(crate) limit: T,
}

/// The nearest finite value of `T`; zero for NaN.
fn nearest<T: Real>(value: f64) -> T {
    let rounded = T::from_f64(value);
    if rounded.is_finite() {
        // Adding zero turns -0 into 0: values at a boundary are never -0 then.
        rounded + T::ZERO
    } else if rounded > T::ZERO {
        rounded.next_down()
    } else if rounded < T::ZERO {
        rounded.next_up()
    } else {
        T::ZERO
    }
}

fn nearest_vec<T: Real>(v: Vec3<f64>) -> Vec3<T> {
    Vec3::new(nearest(v.x), nearest(v.y), nearest(v.z))
}

impl<T: Real> PlainFrustum<T> {
    pub(crate) fn new(pose: &Pose, shape: &Shape) -> Self {
        let sign = shape.direction().sign();
        let near = shape.near();
        let (far, slopes) = match *shape {
            Shape::Finite { near, far } => {
                let (a, b) = (near.rect.to_array(), far.rect.to_array());
                let depth = (far.z - near.z).abs();
                let slope = |i: usize| {
                    let whole = (b[i] - a[i]) / depth;
                    // Halved, in case a difference overflows.
                    let halves = (b[i] / 2.0 - a[i] / 2.0) / (far.z / 2.0 - near.z / 2.0).abs();
                    if whole.is_finite() && depth.is_finite() {
                        whole
                    } else {
                        halves
                    }
                };
                (far.z, [0, 1, 2, 3].map(slope))
            }
            Shape::Infinite { slopes, .. } => (0.0, slopes.to_array()),
        };
        let bounds = near.rect.to_array();
        let planes = Face::ALL.map(|face| {
            plane_in_frame(face, sign, [near.z, far], bounds, slopes).to_world::<T>(pose)
        });
        let mut plain = Self {
            form: Form::of(shape),
            identity: pose.is_identity(),
            sign: nearest(sign),
            near: nearest(sign * near.z),
            far: nearest(sign * far),
            bounds: bounds.map(nearest),
            slopes: slopes.map(nearest),
            origin: nearest_vec(pose.origin),
            axes: pose.axes.map(nearest_vec),
            planes,
            limit: T::ZERO,
        };
        plain.limit = plain.find_limit();
        plain
    }

    /// The largest size for which nothing overflows. A value is at most three products
    /// with an axis, one of them times a slope, plus constants; a difference of two
    /// values, or of two points, is at most twice as large.
    fn find_limit(&self) -> T {
        let largest = |numbers: &[T]| numbers.iter().fold(0.0, |m, v| v.to_f64().abs().max(m));
        let axes = self.axes.map(|a| largest(&a.to_array()));
        let axis = axes.into_iter().fold(1.0, f64::max);
        let constants = largest(&[self.near, self.far])
            .max(largest(&self.bounds))
            .max(largest(&self.origin.to_array()));
        let factor = 16.0 * axis * (1.0 + largest(&self.slopes));
        let limit = nearest::<T>(f64::INFINITY).to_f64() / factor - 4.0 * constants;
        nearest(limit.max(0.0))
    }

    /// Frame coordinates.
    #[inline(always)]
    pub(crate) fn to_frame(&self, p: Vec3<T>) -> Vec3<T> {
        if self.identity {
            return p;
        }
        let c = p - self.origin;
        let [a, b, n] = self.axes;
        Vec3::new(a.dot(c), b.dot(c), n.dot(c))
    }

    /// The near and the far value at frame coordinate `z`; the far one is
    /// positive where there is no far face.
    #[inline(always)]
    pub(crate) fn depths<L: Layout>(&self, z: T) -> [T; 2] {
        let z = self.sign * z;
        let far = if L::FAR { self.far - z } else { T::ONE };
        [z - self.near, far]
    }

    /// The values of sides `i` and `i + 1` (0: left and right, 2: bottom and
    /// top) at depth `w` and frame coordinate `c`.
    #[inline(always)]
    pub(crate) fn sides<L: Layout>(&self, i: usize, w: T, c: T) -> [T; 2] {
        L::sides(&self.bounds, &self.slopes, i, w, c)
    }

    /// The frustum's faces.
    #[inline(always)]
    pub(crate) fn faces(&self) -> &'static [Face] {
        match self.form {
            Form::Symmetric | Form::General | Form::Orthographic => &Face::ALL,
            Form::InfiniteSymmetric | Form::Infinite => &Face::WITHOUT_FAR,
        }
    }
}

/// The face's boundary value as a plane over frame coordinates.
fn plane_in_frame(
    face: Face,
    sign: f64,
    [near, far]: [f64; 2],
    bounds: [f64; 4],
    slopes: [f64; 4],
) -> Plane<f64> {
    // bound + slope (sign z - sign near), as a plane over z alone
    let side = |i: usize| {
        let slope = slopes[i] * sign;
        (slope, bounds[i] - slope * near)
    };
    let (normal, offset) = match face {
        Face::Near => ([0.0, 0.0, sign], -sign * near),
        Face::Far => ([0.0, 0.0, -sign], sign * far),
        Face::Left => ([1.0, 0.0, -side(0).0], -side(0).1),
        Face::Right => ([-1.0, 0.0, side(1).0], side(1).1),
        Face::Bottom => ([0.0, 1.0, -side(2).0], -side(2).1),
        Face::Top => ([0.0, -1.0, side(3).0], side(3).1),
    };
    let normal = normal.into();
    Plane { normal, offset }
}

impl Plane<f64> {
    /// The same plane over world coordinates, rounded.
    fn to_world<T: Real>(self, pose: &Pose) -> Plane<T> {
        let [a, b, c] = pose.axes;
        let n = a * self.normal.x + b * self.normal.y + c * self.normal.z;
        Plane {
            normal: nearest_vec(n),
            offset: nearest(self.offset - n.dot(pose.origin)),
        }
    }
}

/// The coefficients in both scalar types.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlainPair {
    single: PlainFrustum<f32>,
    double: PlainFrustum<f64>,
}

impl PlainPair {
    pub(crate) fn new(pose: &Pose, shape: &Shape) -> Self {
        Self {
            single: PlainFrustum::new(pose, shape),
            double: PlainFrustum::new(pose, shape),
        }
    }
}

impl PerReal for PlainPair {
    type Of<T: Real> = PlainFrustum<T>;
    #[inline(always)]
    fn single(&self) -> &PlainFrustum<f32> {
        &self.single
    }
    #[inline(always)]
    fn double(&self) -> &PlainFrustum<f64> {
        &self.double
    }
}

/// The type of a value: a scalar, or several side by side.
pub(crate) trait Term:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
}
impl<T: Real> Term for T {}
impl Term for f64x2 {}

/// The computation of the values of two opposite sides. Each form of frustum
/// omits what it does not need, with the same bits as the general one.
pub(crate) trait Layout {
    /// Whether there is a far face.
    const FAR: bool = true;
    /// The values of sides `i` and `i + 1` at depth `w`, coordinate `c`.
    fn sides<T: Term>(bounds: &[T; 4], slopes: &[T; 4], i: usize, w: T, c: T) -> [T; 2];
}

/// The layout with one half-width for two sides.
pub(crate) struct Symmetric<const FAR: bool>;
/// The layout of any frustum.
pub(crate) struct General<const FAR: bool>;
/// The layout without slopes.
pub(crate) struct Orthographic;

impl<const FAR: bool> Layout for Symmetric<FAR> {
    const FAR: bool = FAR;
    #[inline(always)]
    fn sides<T: Term>(bounds: &[T; 4], slopes: &[T; 4], i: usize, w: T, c: T) -> [T; 2] {
        let u = slopes[i + 1] * w + bounds[i + 1];
        [u + c, u - c]
    }
}

impl<const FAR: bool> Layout for General<FAR> {
    const FAR: bool = FAR;
    #[inline(always)]
    fn sides<T: Term>(bounds: &[T; 4], slopes: &[T; 4], i: usize, w: T, c: T) -> [T; 2] {
        let low = slopes[i] * w + bounds[i];
        let high = slopes[i + 1] * w + bounds[i + 1];
        [c - low, high - c]
    }
}

impl Layout for Orthographic {
    #[inline(always)]
    fn sides<T: Term>(bounds: &[T; 4], _: &[T; 4], i: usize, _: T, c: T) -> [T; 2] {
        [c - bounds[i], bounds[i + 1] - c]
    }
}
