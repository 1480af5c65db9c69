//! The separating axis test: whether a volume that no face plane rejects is separate from the
//! frustum all the same, decided exactly. For spheres, feet of perpendiculars.
//!
//! # Source
//! Gottschalk, Lin, Manocha, "OBBTree" (1996): two convex polyhedra are separate exactly if
//! they are so along the normal of a face of one of them or along the cross product of two of
//! their edges. This follows from Minkowski's sum: the difference of frustum and box is a
//! polyhedron, closed and, since a frustum is never flat, with an interior; its faces' normals
//! are these, and it contains the origin exactly if frustum and box meet. So flat boxes, edges
//! and points need no case of their own. Neither does an infinite frustum: its rays bound the
//! normals along which it reaches to infinity.
//!
//! ```text
//! hull        the frustum as points, rays and edges in its frame
//! aligned     axis-aligned boxes, whose axes are the same for all of them
//! oriented    oriented boxes
//! sphere      spheres
//! ```
//! The data that each needs of a frustum is computed on first use.

mod aligned;
mod hull;
mod oriented;
mod sphere;

use super::support::with_extent;
use super::unbounded::Unbounded;
use super::volume::{Aabb, Obb, Sphere, Volume, VolumeError};
use super::{Containment, Culler, VolumeCounts};
use crate::exact::float::exp2;
use crate::frustum::Frustum;
use crate::frustum::eval::half_space::HalfSpace;
use crate::math::Vec3;
use aligned::Aligned;
use oriented::Oriented;
use sphere::SphereSeparation;
use std::sync::OnceLock;

/// Whether a value is zero or so moderate that a product of six is within the range of `f64`.
fn is_moderate(v: f64) -> bool {
    const LARGE: f64 = exp2(150);
    v == 0.0 || (v.abs() < LARGE && v.abs() > 1.0 / LARGE)
}

/// The data of a frustum that the exact test needs, computed on first use.
#[derive(Clone, Debug, Default)]
pub(super) struct Separation {
    aligned: OnceLock<Aligned>,
    oriented: OnceLock<Oriented>,
    spheres: OnceLock<SphereSeparation>,
}

/// The frustum of a test.
struct Context<'a> {
    frustum: &'a Frustum,
    half_spaces: &'a [HalfSpace],
    separation: &'a Separation,
}

impl<'a> Context<'a> {
    fn aligned(&self) -> &'a Aligned {
        let make = || Aligned::new(self.frustum, self.half_spaces);
        self.separation.aligned.get_or_init(make)
    }
}

/// A volume that can be tested.
trait Separable {
    /// A point of the volume.
    fn point(&self) -> Vec3<f64>;

    /// Whether the volume is separate from the frustum. Precondition: no face plane rejects it.
    fn is_separate(&self, context: &Context<'_>, counts: &mut VolumeCounts) -> bool;
}

impl Separable for Aabb<f64> {
    /// A rounded middle is not beyond the ends of its range.
    fn point(&self) -> Vec3<f64> {
        (self.min + self.max) * 0.5
    }

    fn is_separate(&self, context: &Context<'_>, counts: &mut VolumeCounts) -> bool {
        context.aligned().is_separate(self, counts)
    }
}

impl Separable for Obb<f64> {
    fn point(&self) -> Vec3<f64> {
        self.center
    }

    fn is_separate(&self, context: &Context<'_>, counts: &mut VolumeCounts) -> bool {
        let oriented = context
            .separation
            .oriented
            .get_or_init(|| Oriented::new(context.frustum));
        oriented.is_separate(self, counts)
    }
}

impl Separable for Sphere<f64> {
    fn point(&self) -> Vec3<f64> {
        self.center
    }

    fn is_separate(&self, context: &Context<'_>, counts: &mut VolumeCounts) -> bool {
        let half_spaces = context.half_spaces;
        let make = || SphereSeparation::new(context.frustum, half_spaces);
        let spheres = context.separation.spheres.get_or_init(make);
        spheres.is_separate(half_spaces, self, counts)
    }
}

impl Culler {
    /// Classifies a volume exactly: `Crossing` only where frustum and volume have a point in
    /// common and the frustum does not contain the volume.
    ///
    /// Takes as long as [`Culler::classify`] where that returns `Outside` or `Inside`, and a few
    /// times as long where it returns `Crossing`: tens of microseconds where rounding leaves the
    /// answer open, as where an oriented box or a sphere touches. The first call takes some
    /// hundred microseconds more.
    ///
    /// ```
    /// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape, Sphere};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// // Beyond the edge between right and far, outside neither of them.
    /// let beyond = Aabb::new([3.5, -9.0, 2.0], [9.0, 9.0, 9.0]);
    /// assert_eq!(culler.classify(beyond)?, Containment::Crossing);
    /// assert_eq!(culler.classify_exact(beyond)?, Containment::Outside);
    /// let touching = Aabb::new([3.0, -9.0, 2.0], [9.0, 9.0, 9.0]);
    /// assert_eq!(culler.classify_exact(touching)?, Containment::Crossing);
    /// // Beyond the same edge: four away along x, three along z.
    /// let sphere = |radius| Sphere::new([7.0, 0.0, 6.0], radius);
    /// assert_eq!(culler.classify_exact(sphere(5.0))?, Containment::Crossing);
    /// assert_eq!(culler.classify_exact(sphere(4.999_999_999))?, Containment::Outside);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Volume::check`].
    #[inline]
    pub fn classify_exact(&self, volume: impl Into<Volume>) -> Result<Containment, VolumeError> {
        self.classify_exact_counted(volume, &mut VolumeCounts::default())
    }

    /// As [`Culler::classify_exact`], and adds to `counts` how often each stage was needed.
    ///
    /// # Errors
    /// Those of [`Volume::check`].
    #[inline]
    pub fn classify_exact_counted(
        &self,
        volume: impl Into<Volume>,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        let volume = volume.into();
        volume.check()?;
        if let Some(unbounded) = Unbounded::of(&volume) {
            return Ok(self.classify_unbounded(&unbounded, counts));
        }
        with_extent!(&volume, v => {
            let class = self.by_planes(v, counts);
            if class == Containment::Crossing && self.is_separate(v, counts) {
                return Ok(Containment::Outside);
            }
            Ok(class)
        })
    }

    #[cold]
    fn classify_unbounded(&self, v: &Unbounded, counts: &mut VolumeCounts) -> Containment {
        let class = v.classify(self.half_spaces(), counts);
        if class == Containment::Crossing && self.is_separate_unbounded(v, counts) {
            return Containment::Outside;
        }
        class
    }

    fn is_separate_unbounded(&self, v: &Unbounded, counts: &mut VolumeCounts) -> bool {
        let is_separate = self.context().aligned().is_separate_unbounded(v, counts);
        counts.exact_tests += 1;
        counts.false_accepts += u64::from(is_separate);
        is_separate
    }

    /// Whether a valid volume is separate from the frustum. Precondition: no face plane rejects it.
    pub(super) fn is_separate_volume(&self, volume: &Volume, counts: &mut VolumeCounts) -> bool {
        if let Some(unbounded) = Unbounded::of(volume) {
            return self.is_separate_unbounded(&unbounded, counts);
        }
        with_extent!(volume, v => self.is_separate(v, counts))
    }

    fn context(&self) -> Context<'_> {
        Context {
            frustum: self.frustum(),
            half_spaces: self.half_spaces(),
            separation: self.separation(),
        }
    }

    /// Precondition: no face plane rejects the volume.
    fn is_separate(&self, volume: &impl Separable, counts: &mut VolumeCounts) -> bool {
        let context = self.context();
        // Most volumes that meet the frustum have their middle in it.
        let is_separate = !self.planes().certainly_contain(volume.point())
            && volume.is_separate(&context, counts);
        counts.exact_tests += 1;
        counts.false_accepts += u64::from(is_separate);
        is_separate
    }
}
