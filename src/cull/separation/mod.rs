//! Whether a volume that is outside of no face is apart from the frustum all the same, decided
//! exactly: separating axes for boxes, feet of perpendiculars for balls.
//!
//! # Source
//! Gottschalk, Lin, Manocha, "OBBTree" (1996): two convex polyhedra are apart exactly if
//! they are along the normal of a face of one of them or the cross product of two of
//! their edges. That is Minkowski's sum: the difference of frustum and box is a polyhedron,
//! closed and, as a frustum is never flat, with an inside; its faces' normals are these,
//! and it holds the origin exactly if frustum and box meet. So flat boxes, edges and points
//! need no case of their own, and neither does an infinite frustum, whose rays bound
//! along which normals it reaches to infinity.
//!
//! ```text
//! hull        the frustum as points, rays and edges in its frame
//! aligned     axis-aligned boxes: their axes are known before they are
//! oriented    oriented boxes
//! ball        balls
//! ```
//! What each needs of a frustum is made when first asked for.

mod aligned;
mod hull;
mod oriented;
mod sphere;

use super::support::with_extent;
use super::volume::{Aabb, Obb, Sphere, Volume, VolumeError};
use super::{Containment, Culler, VolumeCounts};
use crate::frustum::Frustum;
use crate::frustum::eval::half_space::HalfSpace;
use crate::math::Vec3;
use aligned::Aligned;
use oriented::Oriented;
use sphere::SphereSeparation;
use std::sync::OnceLock;

/// Whether a product of six such numbers is within the range of doubles.
fn ordinary(v: f64) -> bool {
    /// 2^150.
    const LARGE: f64 = 1.427_247_692_705_96e45;
    v == 0.0 || (v.abs() < LARGE && v.abs() > 1.0 / LARGE)
}

/// What the exact test needs of a frustum.
#[derive(Clone, Debug, Default)]
pub(super) struct Separation {
    aligned: OnceLock<Aligned>,
    oriented: OnceLock<Oriented>,
    balls: OnceLock<SphereSeparation>,
}

/// What is asked about.
struct Asked<'a> {
    frustum: &'a Frustum,
    half_spaces: &'a [HalfSpace],
    apart: &'a Separation,
}

/// A volume of which that can be known.
trait Separable {
    /// One of its points, rounded or not.
    fn point(&self) -> Vec3<f64>;

    fn is_apart(&self, asked: &Asked<'_>, counts: &mut VolumeCounts) -> bool;
}

impl Separable for Aabb<f64> {
    /// A rounded middle is not beyond what it is the middle of.
    fn point(&self) -> Vec3<f64> {
        (self.min + self.max) * 0.5
    }

    fn is_apart(&self, asked: &Asked<'_>, counts: &mut VolumeCounts) -> bool {
        let made = asked
            .apart
            .aligned
            .get_or_init(|| Aligned::new(asked.frustum, asked.half_spaces));
        made.is_apart(self, counts)
    }
}

impl Separable for Obb<f64> {
    fn point(&self) -> Vec3<f64> {
        self.center
    }

    fn is_apart(&self, asked: &Asked<'_>, counts: &mut VolumeCounts) -> bool {
        let made = asked
            .apart
            .oriented
            .get_or_init(|| Oriented::new(asked.frustum));
        made.is_apart(self, counts)
    }
}

impl Separable for Sphere<f64> {
    fn point(&self) -> Vec3<f64> {
        self.center
    }

    fn is_apart(&self, asked: &Asked<'_>, counts: &mut VolumeCounts) -> bool {
        let half_spaces = asked.half_spaces;
        let make = || SphereSeparation::new(asked.frustum, half_spaces);
        let made = asked.apart.balls.get_or_init(make);
        made.is_apart(half_spaces, self, counts)
    }
}

impl Culler {
    /// How a volume lies to the frustum, exactly: `Crossing` only where they have a point in
    /// common and the frustum does not contain the volume.
    ///
    /// Costs what [`Culler::classify`] does where that settles it, a few times that where it
    /// says `Crossing` (tens of microseconds where rounding leaves it open, as where an oriented box
    /// or a ball touches); some hundred microseconds more the first time.
    ///
    /// ```
    /// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape, Sphere};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// // Beyond the edge between right and far, outside of neither.
    /// let beyond = Aabb::new([3.5, -9.0, 2.0], [9.0, 9.0, 9.0]);
    /// assert_eq!(culler.classify(beyond)?, Containment::Crossing);
    /// assert_eq!(culler.classify_exact(beyond)?, Containment::Outside);
    /// let touching = Aabb::new([3.0, -9.0, 2.0], [9.0, 9.0, 9.0]);
    /// assert_eq!(culler.classify_exact(touching)?, Containment::Crossing);
    /// // Beyond the same edge: four away along x, three along z.
    /// let ball = |radius| Sphere::new([7.0, 0.0, 6.0], radius);
    /// assert_eq!(culler.classify_exact(ball(5.0))?, Containment::Crossing);
    /// assert_eq!(culler.classify_exact(ball(4.999_999_999))?, Containment::Outside);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// What [`Volume::check`] finds.
    #[inline]
    pub fn classify_exact(&self, volume: impl Into<Volume>) -> Result<Containment, VolumeError> {
        self.classify_exact_counted(volume, &mut VolumeCounts::default())
    }

    /// As [`Culler::classify_exact`], and adds what it needed to counts, and how many volumes
    /// that are outside of no face it found to be outside.
    ///
    /// # Errors
    /// What [`Volume::check`] finds.
    #[inline]
    pub fn classify_exact_counted(
        &self,
        volume: impl Into<Volume>,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        let volume = volume.into();
        volume.check()?;
        with_extent!(&volume, v => {
            let class = self.by_planes(v, counts);
            if class == Containment::Crossing && self.is_apart(v, counts) {
                return Ok(Containment::Outside);
            }
            Ok(class)
        })
    }

    /// Of a volume that is outside of no face.
    fn is_apart(&self, volume: &impl Separable, counts: &mut VolumeCounts) -> bool {
        let asked = Asked {
            frustum: self.frustum(),
            half_spaces: self.half_spaces(),
            apart: self.apart(),
        };
        // Most volumes that meet the frustum have their middle in it.
        let is_apart =
            !self.planes().certainly_have(volume.point()) && volume.is_apart(&asked, counts);
        counts.asked += 1;
        counts.false_accepts += u64::from(is_apart);
        is_apart
    }
}
