//! Bounding volumes: closed sets, defined exactly by the stored values.

use crate::math::{Axis, Real, Short, Vec3};
use std::fmt;

/// An axis-aligned box: the points `p` with `min <= p <= max` in every coordinate.
///
/// A box may be flat, an edge or a point. Its sides may be infinite: `min` from negative infinity,
/// `max` to infinity, up to all of space, [`Aabb::UNBOUNDED`]. [`Aabb::EMPTY`] contains no point, and is outside
/// of every frustum; any other box with a `min` above its `max` is invalid, as is NaN.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Aabb<T> {
    /// The least x, y and z.
    pub min: Vec3<T>,
    /// The greatest x, y and z.
    pub max: Vec3<T>,
}

/// An oriented box: the points `center + s u + t v + w n` with `s, t, w` in `-1..=1`
/// and `u, v, n` the half axes.
///
/// Half axes may have any lengths and angles between them, and may be zero.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Obb<T> {
    /// The center.
    pub center: Vec3<T>,
    /// The vectors from the center to the centers of three faces.
    pub half_axes: [Vec3<T>; 3],
}

/// A solid sphere: the points no farther than `radius` from `center`.
///
/// A sphere of radius 0 is a point.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Sphere<T> {
    /// The center.
    pub center: Vec3<T>,
    /// The radius, not negative.
    pub radius: T,
}

/// Any bounding volume, in `f64`: `f32` is promoted exactly.
///
/// There is a `From` for [`Aabb`], [`Obb`], [`Sphere`] and, as a point, [`Vec3`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Volume {
    /// An axis-aligned box.
    Aabb(Aabb<f64>),
    /// An oriented box.
    Obb(Obb<f64>),
    /// A sphere.
    Sphere(Sphere<f64>),
}

/// The position of a bounding volume relative to a frustum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Containment {
    /// The two have no point in common.
    Outside,
    /// Neither rejected nor inside. From [`Culler::classify`] and [`Culler::over`] the volume may
    /// still be separate from the frustum, beyond an edge or a corner; from
    /// [`Culler::classify_exact`] the two meet.
    ///
    /// [`Culler::classify`]: crate::Culler::classify
    /// [`Culler::over`]: crate::Culler::over
    /// [`Culler::classify_exact`]: crate::Culler::classify_exact
    Crossing,
    /// The frustum contains the volume, which may touch its surface from inside.
    Inside,
}

impl Containment {
    /// All three, in ascending order.
    pub const ALL: [Containment; 3] = [
        Containment::Outside,
        Containment::Crossing,
        Containment::Inside,
    ];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        ["outside", "crossing", "inside"][self as usize]
    }
}

impl fmt::Display for Containment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Why a bounding volume is invalid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum VolumeError {
    /// A component is NaN, or infinite where only a box's sides may be: `min` downwards, `max` upwards.
    NonFinite {
        /// Which component.
        what: &'static str,
        /// The value found.
        value: f64,
    },
    /// A box's `min` is greater than its `max`, and it is not [`Aabb::EMPTY`].
    Inverted {
        /// The coordinate.
        axis: Axis,
        /// The value of `min`, the greater one.
        min: f64,
        /// The value of `max`, the lesser one.
        max: f64,
    },
    /// A sphere's radius is negative.
    NegativeRadius {
        /// The radius.
        radius: f64,
    },
}

impl fmt::Display for VolumeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NonFinite { what, value } => {
                write!(
                    f,
                    "{what} = {value}; a bounding volume must be finite, except a box outwards"
                )
            }
            Self::Inverted { axis, min, max } => write!(
                f,
                "min.{axis} = {} is greater than max.{axis} = {}; the box is inverted",
                Short(min),
                Short(max)
            ),
            Self::NegativeRadius { radius } => {
                write!(f, "radius = {}; it must not be negative", Short(radius))
            }
        }
    }
}

impl std::error::Error for VolumeError {}

/// The first invalid volume of many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeErrorAt {
    /// Its index.
    pub index: usize,
    /// Why it is invalid.
    pub error: VolumeError,
}

impl fmt::Display for VolumeErrorAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "volume {}: {}", self.index, self.error)
    }
}

impl std::error::Error for VolumeErrorAt {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.error)
    }
}

const MIN: [&str; 3] = ["min.x", "min.y", "min.z"];
const MAX: [&str; 3] = ["max.x", "max.y", "max.z"];
const CENTER: [&str; 3] = ["center.x", "center.y", "center.z"];
const HALF_AXES: [[&str; 3]; 3] = [
    ["half_axes[0].x", "half_axes[0].y", "half_axes[0].z"],
    ["half_axes[1].x", "half_axes[1].y", "half_axes[1].z"],
    ["half_axes[2].x", "half_axes[2].y", "half_axes[2].z"],
];

#[inline(always)]
fn check_finite<T: Real>(names: [&'static str; 3], v: Vec3<T>) -> Result<(), VolumeError> {
    if v.is_finite() {
        return Ok(());
    }
    non_finite(names, v.to_f64())
}

#[cold]
fn non_finite(names: [&'static str; 3], v: Vec3<f64>) -> Result<(), VolumeError> {
    for (what, value) in names.into_iter().zip(v.to_array()) {
        if !value.is_finite() {
            return Err(VolumeError::NonFinite { what, value });
        }
    }
    Ok(())
}

impl<T: Real> Aabb<T> {
    /// No point: what a union begins with. In each coordinate `min` is infinity and `max` is negative infinity.
    ///
    /// ```
    /// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// let unit = Aabb::new([0.0_f32; 3], [1.0; 3]);
    /// assert_eq!(Aabb::EMPTY.union(unit), unit);
    /// assert_eq!(culler.classify(Aabb::<f32>::EMPTY)?, Containment::Outside);
    /// assert_eq!(culler.classify(Aabb::<f32>::UNBOUNDED)?, Containment::Crossing);
    /// // The ground, everywhere: below the left half of this frustum's lower side.
    /// let low = [f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    /// let ground = Aabb::new(low, [f64::INFINITY, -3.5, f64::INFINITY]);
    /// assert_eq!(culler.classify_exact(ground)?, Containment::Outside);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const EMPTY: Self = Self {
        min: Vec3::new(T::INFINITY, T::INFINITY, T::INFINITY),
        max: Vec3::new(T::NEG_INFINITY, T::NEG_INFINITY, T::NEG_INFINITY),
    };

    /// All points: for what is never culled.
    pub const UNBOUNDED: Self = Self {
        min: Self::EMPTY.max,
        max: Self::EMPTY.min,
    };

    /// Whether it is [`Aabb::EMPTY`].
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::EMPTY
    }

    /// The smallest box that contains two boxes. A coordinate that is NaN may be ignored.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let less = |a: T, b: T| if b < a { b } else { a };
        let more = |a: T, b: T| if b > a { b } else { a };
        Self {
            min: Vec3::new(
                less(a.min.x, b.min.x),
                less(a.min.y, b.min.y),
                less(a.min.z, b.min.z),
            ),
            max: Vec3::new(
                more(a.max.x, b.max.x),
                more(a.max.y, b.max.y),
                more(a.max.z, b.max.z),
            ),
        }
    }

    /// Makes a box from its least and its greatest coordinates, unchecked.
    ///
    /// ```
    /// use frusta::Aabb;
    /// let unit = Aabb::new([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]);
    /// assert!(unit.check().is_ok());
    /// assert_eq!(Aabb::around([[1.0, 0.0, 1.0], [0.0, 1.0, 0.0]]), Some(unit));
    /// let inverted = Aabb::new([0.0, 2.0, 0.0], [1.0, 1.0, 1.0]).check().unwrap_err();
    /// assert_eq!(inverted.to_string(), "min.y = 2 is greater than max.y = 1; the box is inverted");
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn new(min: impl Into<Vec3<T>>, max: impl Into<Vec3<T>>) -> Self {
        Self {
            min: min.into(),
            max: max.into(),
        }
    }

    /// The smallest box with coordinates of this type that contains the points no farther than
    /// `half_extents` from `center` in each coordinate, unchecked.
    ///
    /// Each side is rounded outwards, to infinity beyond the largest number, so that nothing of an object between them
    /// is lost.
    ///
    /// ```
    /// use frusta::Aabb;
    /// let unit = Aabb::from_center([0.5_f32, 0.5, 0.5], [0.5, 0.5, 0.5]);
    /// assert_eq!(unit, Aabb::new([0.0; 3], [1.0; 3]));
    /// let thin = Aabb::from_center([1.0_f32; 3], [1e-9; 3]);
    /// assert!(thin.min.x < 1.0 && 1.0 < thin.max.x);
    /// ```
    #[must_use]
    pub fn from_center(center: impl Into<Vec3<T>>, half_extents: impl Into<Vec3<T>>) -> Self {
        let (c, h) = (center.into(), half_extents.into());
        // The sum, and what rounding left of it, exactly.
        let high = |a: T, b: T| {
            let sum = a + b;
            let part = sum - a;
            let rest = (a - (sum - part)) + (b - part);
            if rest > T::ZERO { sum.next_up() } else { sum }
        };
        let low = |a: T, b: T| -high(-a, b);
        Self {
            min: Vec3::new(low(c.x, h.x), low(c.y, h.y), low(c.z, h.z)),
            max: Vec3::new(high(c.x, h.x), high(c.y, h.y), high(c.z, h.z)),
        }
    }

    /// The smallest box that contains these points; `None` if there are none. A coordinate that
    /// is NaN may be ignored.
    #[must_use]
    pub fn around<P: Into<Vec3<T>>>(points: impl IntoIterator<Item = P>) -> Option<Self> {
        let mut points = points.into_iter().map(Into::into);
        let first = points.next()?;
        Some(points.fold(Self::new(first, first), |all, p| all.union(Self::new(p, p))))
    }

    /// The same box in `f64`; always exact.
    #[must_use]
    #[inline(always)]
    pub fn to_f64(self) -> Aabb<f64> {
        Aabb::new(self.min.to_f64(), self.max.to_f64())
    }

    /// Checks that the box is one: finite, with infinite sides, or [`Aabb::EMPTY`].
    ///
    /// # Errors
    /// The first component that is NaN, or infinite on the wrong side; else the first coordinate in which
    /// `min` is greater than `max`.
    #[inline]
    pub fn check(&self) -> Result<(), VolumeError> {
        let (a, b) = (self.min, self.max);
        let is_ordered = (a.x <= b.x) & (a.y <= b.y) & (a.z <= b.z);
        if is_ordered && a.is_finite() && b.is_finite() {
            return Ok(());
        }
        self.check_unusual()
    }

    #[cold]
    fn check_unusual(&self) -> Result<(), VolumeError> {
        if self.is_empty() {
            return Ok(());
        }
        let (a, b) = (self.min.to_f64(), self.max.to_f64());
        for (names, values, wrong) in [(MIN, a, f64::INFINITY), (MAX, b, f64::NEG_INFINITY)] {
            for (what, value) in names.into_iter().zip(values.to_array()) {
                if value.is_nan() || value == wrong {
                    return Err(VolumeError::NonFinite { what, value });
                }
            }
        }
        let (axis, min, max) = if a.x > b.x {
            (Axis::X, a.x, b.x)
        } else if a.y > b.y {
            (Axis::Y, a.y, b.y)
        } else if a.z > b.z {
            (Axis::Z, a.z, b.z)
        } else {
            return Ok(());
        };
        Err(VolumeError::Inverted { axis, min, max })
    }
}

impl<T: Real> Obb<T> {
    /// Makes a box from its center and its half axes, unchecked.
    ///
    /// ```
    /// use frusta::Obb;
    /// let rod = Obb::new([0.0, 0.0, 5.0], [[3.0, 4.0, 0.0], [-0.4, 0.3, 0.0], [0.0, 0.0, 0.5]]);
    /// assert!(rod.check().is_ok());
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn new(center: impl Into<Vec3<T>>, half_axes: [impl Into<Vec3<T>>; 3]) -> Self {
        Self {
            center: center.into(),
            half_axes: half_axes.map(Into::into),
        }
    }

    /// The image of a box under an affine transformation, as of an object's own bounds in its place in the world:
    /// turned, moved, scaled and skewed. `columns` are the images of the axes, and the image of the origin.
    ///
    /// Each coordinate is within 6 u of the sum of the magnitudes of the products in it (in `f32`: rounded once
    /// from `f64`). What is stored is then the box, exactly. The image of a box that is not finite, or one beyond the range of
    /// numbers, is not finite, and invalid: [`Obb::check`] finds it.
    ///
    /// ```
    /// use frusta::{Aabb, Obb};
    /// // Turned by a quarter around z, twice as high, moved along x.
    /// let columns = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [10.0, 0.0, 0.0]];
    /// let local = Aabb::new([0.0, 0.0, 0.0], [2.0, 4.0, 6.0]);
    /// let placed = Obb::from_affine(local, columns);
    /// assert_eq!(placed.center, [8.0, 1.0, 6.0].into());
    /// assert_eq!(placed.half_axes[1], [-2.0, 0.0, 0.0].into());
    /// ```
    #[must_use]
    pub fn from_affine(local: Aabb<T>, columns: [impl Into<Vec3<T>>; 4]) -> Self {
        let [x, y, z, origin] = columns.map(|column| column.into().to_f64());
        let (min, max) = (local.min.to_f64(), local.max.to_f64());
        // Halves first: no overflow, and exact but for subnormals.
        let center = min * 0.5 + max * 0.5;
        let half = max * 0.5 - min * 0.5;
        let along = x * center.x + y * center.y + z * center.z;
        Self {
            center: Vec3::from_f64(along + origin),
            half_axes: [x * half.x, y * half.y, z * half.z].map(Vec3::from_f64),
        }
    }

    /// The same box in `f64`; always exact.
    #[must_use]
    #[inline(always)]
    pub fn to_f64(self) -> Obb<f64> {
        Obb {
            center: self.center.to_f64(),
            half_axes: self.half_axes.map(Vec3::to_f64),
        }
    }

    /// Checks that the box is finite.
    ///
    /// # Errors
    /// The first component that is infinite or NaN.
    pub fn check(&self) -> Result<(), VolumeError> {
        check_finite(CENTER, self.center)?;
        for (names, axis) in HALF_AXES.into_iter().zip(self.half_axes) {
            check_finite(names, axis)?;
        }
        Ok(())
    }
}

impl<T: Real> Sphere<T> {
    /// Makes a sphere from its center and its radius, unchecked.
    ///
    /// ```
    /// use frusta::Sphere;
    /// assert!(Sphere::new([0.0, 0.0, 5.0], 0.0).check().is_ok());
    /// assert!(Sphere::new([0.0, 0.0, 5.0], -1.0).check().is_err());
    /// assert!(Sphere::new([0.0, f32::NAN, 5.0], 1.0).check().is_err());
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn new(center: impl Into<Vec3<T>>, radius: T) -> Self {
        Self {
            center: center.into(),
            radius,
        }
    }

    /// The same sphere in `f64`; always exact.
    #[must_use]
    #[inline(always)]
    pub fn to_f64(self) -> Sphere<f64> {
        Sphere {
            center: self.center.to_f64(),
            radius: self.radius.to_f64(),
        }
    }

    /// Checks that the sphere is finite and its radius not negative.
    ///
    /// # Errors
    /// The first component that is infinite or NaN; else a negative radius.
    pub fn check(&self) -> Result<(), VolumeError> {
        check_finite(CENTER, self.center)?;
        let radius = self.radius.to_f64();
        if !radius.is_finite() {
            let what = "radius";
            return Err(VolumeError::NonFinite {
                what,
                value: radius,
            });
        }
        if radius < 0.0 {
            return Err(VolumeError::NegativeRadius { radius });
        }
        Ok(())
    }
}

impl Volume {
    /// Checks that the volume is valid.
    ///
    /// # Errors
    /// Those of [`Aabb::check`], [`Obb::check`] and [`Sphere::check`].
    #[inline]
    pub fn check(&self) -> Result<(), VolumeError> {
        match self {
            Volume::Aabb(v) => v.check(),
            Volume::Obb(v) => v.check(),
            Volume::Sphere(v) => v.check(),
        }
    }
}

impl<T: Real> From<Aabb<T>> for Volume {
    #[inline(always)]
    fn from(v: Aabb<T>) -> Self {
        Volume::Aabb(v.to_f64())
    }
}

impl<T: Real> From<Obb<T>> for Volume {
    #[inline(always)]
    fn from(v: Obb<T>) -> Self {
        Volume::Obb(v.to_f64())
    }
}

impl<T: Real> From<Sphere<T>> for Volume {
    #[inline(always)]
    fn from(v: Sphere<T>) -> Self {
        Volume::Sphere(v.to_f64())
    }
}

/// A point is a box of zero size.
impl<T: Real> From<Vec3<T>> for Volume {
    #[inline(always)]
    fn from(p: Vec3<T>) -> Self {
        Volume::Aabb(Aabb::new(p.to_f64(), p.to_f64()))
    }
}

impl<T: Real> From<Aabb<T>> for Obb<T> {
    /// The same box with its center and half axes rounded.
    fn from(v: Aabb<T>) -> Self {
        let half = T::from_f64(0.5);
        let middle = |a: T, b: T| a * half + b * half;
        let extent = |a: T, b: T| b * half - a * half;
        let zero = T::ZERO;
        let (a, b) = (v.min, v.max);
        Self {
            center: Vec3::new(middle(a.x, b.x), middle(a.y, b.y), middle(a.z, b.z)),
            half_axes: [
                Vec3::new(extent(a.x, b.x), zero, zero),
                Vec3::new(zero, extent(a.y, b.y), zero),
                Vec3::new(zero, zero, extent(a.z, b.z)),
            ],
        }
    }
}
