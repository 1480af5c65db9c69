//! Face plane by face plane: the conservative test of a volume, decided exactly.
//!
//! # Source
//! Assarsson and Moller, "Optimized view frustum culling algorithms for bounding
//! boxes" (2000): the corners farthest along a plane's normal, plane masks, the plane
//! that rejected last time first.
//!
//! # Idea
//! ```text
//! for each face in question, the one that rejected last time first:
//!     greatest value over the volume < 0     outside
//!     least value over the volume < 0        crossing, and this face is crossed
//! no face crossed: inside
//! ```
//! *Outside* and *inside* are exact. *Crossing* may be wrong in one way: a volume beyond an
//! edge or a corner may be separate from the frustum although no face plane rejects it. The
//! test that finds this is in [`super::separation`].
//!
//! # Degenerate volumes
//! A box of zero size is a point, flat boxes are rectangles and edges; nothing is divided.

use super::separation::Separation;
use super::support::{Extent, with_extent};
use super::unbounded::Unbounded;
use super::volume::{Volume, VolumeError};
use super::{Containment, VolumeCounts};
use crate::frustum::eval::half_space::{
    HalfSpace, HalfSpaces, OFFSET_LIMIT, size, threshold, value,
};
use crate::frustum::eval::planes::FacePlanesPair;
use crate::frustum::{Face, FaceSet, Frustum};
use crate::math::Vec3;
use wide::f64x2;

/// A frustum that is prepared to classify volumes.
///
/// | volumes | call | answer |
/// |---|---|---|
/// | one | [`classify`](Self::classify) | exact plane by plane; *crossing* includes volumes beyond an edge or a corner |
/// | one, in a tree | [`classify_masked`](Self::classify_masked) | the same, by the faces that its parent crosses |
/// | one | [`classify_exact`](Self::classify_exact) | exact: *crossing* only where frustum and volume meet |
/// | many, a draw list | [`over`](Self::over)`(..).visible(..)` | the indices of those that are not outside |
/// | many | [`over`](Self::over)`(..).classes(..)`, `.masks(..)` | the answer of `classify`, as a class or two bits for each |
/// | many, exactly | `over(..).exact()` | the answer of `classify_exact` |
/// | many, on threads | `over(..).parallel()` | the same (feature `parallel`) |
/// | many segments | [`clip_intervals`](Self::clip_intervals) | class and parameters |
///
/// The fastest source of a query is a [`BoxSet`](super::BoxSet), for boxes that are kept from
/// frame to frame; then [`BoxArrays`](super::BoxArrays); slices are slowest. A query is
/// several times as fast as a loop over `classify`.
///
/// Answers are those for the [`Frustum`] it is made from, a closed set. To make a culler takes
/// one or two microseconds, and allocates nothing.
///
/// ```
/// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape, Sphere};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let culler = Culler::new(&frustum);
/// let inside = Aabb::new([-1.0, -1.0, 1.0], [1.0, 1.0, 3.0]);
/// assert_eq!(culler.classify(inside)?, Containment::Inside);
/// // It touches the face at z = 3 from outside.
/// let touching = Sphere::new([0.0_f32, 0.0, 5.0], 2.0);
/// assert_eq!(culler.classify(touching)?, Containment::Crossing);
/// let beyond = Sphere::new([0.0_f32, 0.0, 5.0], 1.999_999_9);
/// assert_eq!(culler.classify(beyond)?, Containment::Outside);
/// assert!(culler.classify(Sphere::new([0.0, 0.0, f64::NAN], 1.0)).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Culler {
    frustum: Frustum,
    /// The faces' half spaces, in the order of [`Frustum::faces`].
    half_spaces: HalfSpaces,
    /// The same, rounded: all are evaluated before the first decision.
    planes: PlanePairs,
    /// The same for many volumes or segments.
    face_planes: FacePlanesPair,
    /// For [`Culler::classify_exact`].
    separation: Separation,
}

/// The rounded half spaces, two side by side.
#[derive(Clone, Debug)]
pub(super) struct PlanePairs {
    /// Normals and offsets; a missing face is a half space that contains everything.
    coefficients: [[f64x2; 4]; 3],
    lengths: [f64x2; 3],
    /// The greatest of the thresholds' constant parts.
    constant: f64,
}

impl PlanePairs {
    fn new(half_spaces: &[HalfSpace]) -> Self {
        let mut coefficients = [[0.0, 0.0, 0.0, OFFSET_LIMIT]; 6];
        let mut lengths = [0.0; 6];
        let mut constant = 0.0_f64;
        for (i, h) in half_spaces.iter().enumerate().take(6) {
            coefficients[i] = h.rounded();
            lengths[i] = h.length();
            constant = constant.max(h.constant());
        }
        let two = |k: usize, of: &dyn Fn(usize) -> f64| f64x2::new([of(2 * k), of(2 * k + 1)]);
        Self {
            coefficients: [0, 1, 2].map(|k| [0, 1, 2, 3].map(|j| two(k, &|i| coefficients[i][j]))),
            lengths: [0, 1, 2].map(|k| two(k, &|i| lengths[i])),
            constant,
        }
    }

    /// Whether a point is certainly inside of all planes.
    #[inline(always)]
    pub(super) fn certainly_contain(&self, p: Vec3<f64>) -> bool {
        let mut least = f64x2::splat(OFFSET_LIMIT);
        for coefficients in self.coefficients {
            least = least.fast_min(value(coefficients, p));
        }
        lesser(least) > threshold(size(p), self.constant)
    }

    /// The class of an ordered volume, if rounded values decide it; never if a component is
    /// not finite.
    #[inline(always)]
    fn classify<V: Extent>(&self, middle: &V::Middle, size: f64) -> Option<Containment> {
        let mut least = f64x2::splat(OFFSET_LIMIT);
        let mut greatest = f64x2::splat(OFFSET_LIMIT);
        for (coefficients, length) in self.coefficients.into_iter().zip(self.lengths) {
            let [low, high] = V::values(middle, coefficients, length);
            least = least.fast_min(low);
            greatest = greatest.fast_min(high);
        }
        let (least, greatest) = (lesser(least), lesser(greatest));
        let threshold = threshold(size, self.constant);
        let is_within = greatest > threshold;
        if greatest < -threshold {
            Some(Containment::Outside)
        } else if is_within && least > threshold {
            Some(Containment::Inside)
        } else if is_within && least < -threshold {
            Some(Containment::Crossing)
        } else {
            None
        }
    }
}

/// [`Extent::size`], where the type is not named.
#[inline(always)]
fn size_of<V: Extent>(_: &V, middle: &V::Middle) -> f64 {
    V::size(middle)
}

/// The lesser of two values side by side.
#[inline(always)]
fn lesser(pair: f64x2) -> f64 {
    let [a, b] = pair.to_array();
    if b < a { b } else { a }
}

/// The position of a volume relative to a frustum, and the faces that matter for its content.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaskedContainment {
    /// The class by all faces, if the volume is inside of those that were not given.
    pub containment: Containment,
    /// The given faces that the volume is not wholly inside of: its content needs to be tested
    /// against these alone. All given faces if it is outside.
    pub faces: FaceSet,
}

impl Culler {
    /// Prepares a frustum's faces.
    #[must_use]
    pub fn new(frustum: &Frustum) -> Self {
        let half_spaces = HalfSpaces::new(frustum);
        Self {
            frustum: frustum.clone(),
            planes: PlanePairs::new(&half_spaces),
            face_planes: FacePlanesPair::new(&half_spaces),
            half_spaces,
            separation: Separation::default(),
        }
    }

    /// The frustum.
    #[must_use]
    pub fn frustum(&self) -> &Frustum {
        &self.frustum
    }

    pub(super) fn separation(&self) -> &Separation {
        &self.separation
    }

    pub(super) fn planes(&self) -> &PlanePairs {
        &self.planes
    }

    pub(crate) fn half_spaces(&self) -> &[HalfSpace] {
        &self.half_spaces
    }

    pub(crate) fn face_planes(&self) -> &FacePlanesPair {
        &self.face_planes
    }

    /// Classifies a volume plane by plane: `Outside` exactly where some face plane has all of
    /// it strictly outside, `Inside` exactly where the frustum contains it, else `Crossing`.
    ///
    /// A volume that is `Crossing` may be separate from the frustum, beyond an edge or a
    /// corner: [`Culler::classify_exact`] decides that, too.
    ///
    /// # Errors
    /// Those of [`Volume::check`].
    #[inline]
    pub fn classify(&self, volume: impl Into<Volume>) -> Result<Containment, VolumeError> {
        self.classify_counted(volume, &mut VolumeCounts::default())
    }

    /// As [`Culler::classify`], and adds to `counts` how often each stage was needed.
    ///
    /// # Errors
    /// Those of [`Volume::check`].
    #[inline]
    pub fn classify_counted(
        &self,
        volume: impl Into<Volume>,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        let volume = volume.into();
        with_extent!(&volume, v => self.rounded_or_checked(v, &volume, counts))
    }

    /// Where rounded values decide, the order of components is all that is left to check.
    #[inline(always)]
    fn rounded_or_checked<V: Extent>(
        &self,
        v: &V,
        volume: &Volume,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        let middle = v.middle();
        let size = V::size(&middle);
        match self.planes.classify::<V>(&middle, size) {
            Some(class) if v.is_ordered() => Ok(class),
            _ => self.checked(v, volume, counts),
        }
    }

    #[inline(never)]
    fn checked<V: Extent>(
        &self,
        v: &V,
        volume: &Volume,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        volume.check()?;
        if let Some(unbounded) = Unbounded::of(volume) {
            return Ok(unbounded.classify(&self.half_spaces, counts));
        }
        let middle = v.middle();
        Ok(self.plane_by_plane(v, &middle, V::size(&middle), counts))
    }

    #[inline(always)]
    pub(super) fn by_planes<V: Extent>(&self, v: &V, counts: &mut VolumeCounts) -> Containment {
        let middle = v.middle();
        let size = V::size(&middle);
        match self.planes.classify::<V>(&middle, size) {
            Some(class) => class,
            None => self.plane_by_plane(v, &middle, size, counts),
        }
    }

    #[inline(never)]
    fn plane_by_plane<V: Extent>(
        &self,
        v: &V,
        middle: &V::Middle,
        size: f64,
        counts: &mut VolumeCounts,
    ) -> Containment {
        let mut all = Containment::Inside;
        for half_space in self.half_spaces.iter() {
            match v.side(middle, size, half_space, counts) {
                Containment::Outside => return Containment::Outside,
                Containment::Crossing => all = Containment::Crossing,
                Containment::Inside => {}
            }
        }
        all
    }

    /// Classifies a volume of a tree by some faces, first by the one that rejected this volume
    /// last time.
    ///
    /// Start at the root with all of [`Frustum::faces`], and give the children of a volume the `faces`
    /// of its answer. Keep a `hint` for each volume from frame to frame: it is set to the face
    /// that rejects the volume, if one does. Neither changes an answer.
    ///
    /// ```
    /// use frusta::{Aabb, Containment, Culler, EndRect, Face, FaceSet, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// let all: FaceSet = frustum.faces().iter().copied().collect();
    /// let room = Aabb::new([1.0, -1.0, 2.0], [2.0, 1.0, 4.0]);
    /// let (mut room_hint, mut lamp_hint) = (None, None);
    /// let answer = culler.classify_masked(room, all, &mut room_hint)?;
    /// assert_eq!(answer.containment, Containment::Crossing);
    /// assert_eq!(answer.faces.to_string(), "far");
    /// // A lamp in the room is tested against that face alone.
    /// let lamp = Aabb::new([1.4, -0.1, 3.5], [1.6, 0.1, 3.9]);
    /// let answer = culler.classify_masked(lamp, answer.faces, &mut lamp_hint)?;
    /// assert_eq!((answer.containment, lamp_hint), (Containment::Outside, Some(Face::Far)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Volume::check`].
    pub fn classify_masked(
        &self,
        volume: impl Into<Volume>,
        faces: FaceSet,
        hint: &mut Option<Face>,
    ) -> Result<MaskedContainment, VolumeError> {
        let volume = volume.into();
        volume.check()?;
        let counts = &mut VolumeCounts::default();
        if let Some(unbounded) = Unbounded::of(&volume) {
            let mut answer = self.by_some_planes(faces, hint, |h| unbounded.side(h, counts));
            if let Unbounded::Empty = unbounded {
                answer.containment = Containment::Outside;
            }
            return Ok(answer);
        }
        with_extent!(&volume, v => {
            let middle = v.middle();
            let size = size_of(v, &middle);
            Ok(self.by_some_planes(faces, hint, |h| v.side(&middle, size, h, counts)))
        })
    }

    #[inline(always)]
    fn by_some_planes(
        &self,
        faces: FaceSet,
        hint: &mut Option<Face>,
        mut side: impl FnMut(&HalfSpace) -> Containment,
    ) -> MaskedContainment {
        let mut crossed = FaceSet::EMPTY;
        let first = hint.filter(|&face| faces.contains(face));
        let all = self.frustum.faces().iter().zip(self.half_spaces.iter());
        let is_first = |(face, _): &(&Face, &HalfSpace)| Some(**face) == first;
        let is_asked = |(face, _): &(&Face, &HalfSpace)| faces.contains(**face);
        let rest = all.clone().filter(|pair| !is_first(pair));
        for (&face, half_space) in all.filter(is_first).chain(rest).filter(is_asked) {
            match side(half_space) {
                Containment::Outside => {
                    *hint = Some(face);
                    return MaskedContainment {
                        containment: Containment::Outside,
                        faces,
                    };
                }
                Containment::Crossing => crossed = crossed.union(face.into()),
                Containment::Inside => {}
            }
        }
        let containment = if crossed.is_empty() {
            Containment::Inside
        } else {
            Containment::Crossing
        };
        MaskedContainment {
            containment,
            faces: crossed,
        }
    }
}
