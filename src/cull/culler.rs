//! Plane by plane: the conservative test of a volume, decided exactly.
//!
//! # Source
//! Assarsson and Moller, "Optimized view frustum culling algorithms for bounding
//! boxes" (2000): the corners farthest along a plane's normal, plane masks, the plane
//! that rejected last time first.
//!
//! # Idea
//! ```text
//! for each face that is asked for, the last one that rejected first:
//!     greatest value over the volume < 0     outside
//!     least value over the volume < 0        crossing, and this face is crossed
//! no face crossed: inside
//! ```
//! *Outside* and *inside* are what they say. *Crossing* may be wrong in one way: a
//! volume beyond an edge or a corner may be apart from the frustum and outside of no
//! face. What it costs to know is in [`super::separation`].
//!
//! # Degenerate volumes
//! A box of no size is a point, flat ones are rectangles and edges; nothing is divided.

use super::separation::Separation;
use super::support::{Extent, with_extent};
use super::volume::{Volume, VolumeError};
use super::{Containment, VolumeCounts};
use crate::frustum::eval::half_space::{HalfSpace, MOST, size, threshold, value};
use crate::frustum::eval::planes::FacePlanesPair;
use crate::frustum::{Face, FaceSet, Frustum};
use crate::math::Vec3;
use wide::f64x2;

/// A frustum made ready to be asked about volumes.
///
/// It answers as the [`Frustum`] that it is made from would, which is a closed set; to
/// make it takes some ten microseconds.
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
    half_spaces: Box<[HalfSpace]>,
    /// What is in them, rounded, face by face: all are looked at before the first
    /// decision.
    planes: Planes,
    /// The same for batches.
    rows: FacePlanesPair,
    /// For [`Culler::classify_exact`].
    apart: Separation,
}

/// The rounded half spaces, two side by side.
#[derive(Clone, Debug)]
pub(super) struct Planes {
    /// Normals and offsets; where there is no face, one that everything is inside of.
    numbers: [[f64x2; 4]; 3],
    lengths: [f64x2; 3],
    /// The greatest of the thresholds' constant parts.
    constant: f64,
}

impl Planes {
    fn new(half_spaces: &[HalfSpace]) -> Self {
        let mut numbers = [[0.0, 0.0, 0.0, MOST]; 6];
        let mut lengths = [0.0; 6];
        let mut constant = 0.0_f64;
        for (i, h) in half_spaces.iter().enumerate().take(6) {
            numbers[i] = h.rounded();
            lengths[i] = h.length();
            constant = constant.max(h.constant());
        }
        let two = |k: usize, of: &dyn Fn(usize) -> f64| f64x2::new([of(2 * k), of(2 * k + 1)]);
        Self {
            numbers: [0, 1, 2].map(|k| [0, 1, 2, 3].map(|j| two(k, &|i| numbers[i][j]))),
            lengths: [0, 1, 2].map(|k| two(k, &|i| lengths[i])),
            constant,
        }
    }

    /// Whether a point is certainly inside of all.
    #[inline(always)]
    pub(super) fn certainly_have(&self, p: Vec3<f64>) -> bool {
        let mut least = f64x2::splat(MOST);
        for numbers in self.numbers {
            least = least.fast_min(value(numbers, p));
        }
        lesser(least) > threshold(size(p), self.constant)
    }

    /// What is certain of a volume by rounded values, if it is ordered; nothing then if a number
    /// is not finite.
    #[inline(always)]
    fn settle<V: Extent>(&self, middle: &V::Middle, size: f64) -> Option<Containment> {
        let (mut least, mut greatest) = (f64x2::splat(MOST), f64x2::splat(MOST));
        for (numbers, length) in self.numbers.into_iter().zip(self.lengths) {
            let [low, high] = V::values(middle, numbers, length);
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

/// The lesser of two numbers side by side.
#[inline(always)]
fn lesser(pair: f64x2) -> f64 {
    let [a, b] = pair.to_array();
    if b < a { b } else { a }
}

/// How a volume lies to a frustum, and to which of its faces it still has to be held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaskedContainment {
    /// As of all faces, if the volume lies inside of those that were not asked for.
    pub containment: Containment,
    /// The faces asked for that the volume is not wholly inside of: what is in it has
    /// to be held to these alone. All that were asked for if it is outside.
    pub faces: FaceSet,
}

impl Culler {
    /// Prepares a frustum's faces.
    #[must_use]
    pub fn new(frustum: &Frustum) -> Self {
        let half_spaces = HalfSpace::of_faces(frustum);
        Self {
            frustum: frustum.clone(),
            planes: Planes::new(&half_spaces),
            rows: FacePlanesPair::new(&half_spaces),
            half_spaces,
            apart: Separation::default(),
        }
    }

    /// The frustum.
    #[must_use]
    pub fn frustum(&self) -> &Frustum {
        &self.frustum
    }

    pub(super) fn apart(&self) -> &Separation {
        &self.apart
    }

    pub(super) fn planes(&self) -> &Planes {
        &self.planes
    }

    pub(crate) fn half_spaces(&self) -> &[HalfSpace] {
        &self.half_spaces
    }

    pub(crate) fn rows(&self) -> &FacePlanesPair {
        &self.rows
    }

    /// How a volume lies to the frustum, plane by plane: exactly `Outside` where the
    /// plane of some face has all of it strictly outside, `Inside` where the frustum
    /// contains it, else `Crossing`.
    ///
    /// A volume that is `Crossing` may be apart from the frustum, beyond an edge or a
    /// corner: [`Culler::classify_exact`] knows.
    ///
    /// # Errors
    /// What [`Volume::check`] finds.
    #[inline]
    pub fn classify(&self, volume: impl Into<Volume>) -> Result<Containment, VolumeError> {
        self.classify_counted(volume, &mut VolumeCounts::default())
    }

    /// As [`Culler::classify`], and adds what it needed to counts.
    ///
    /// # Errors
    /// What [`Volume::check`] finds.
    #[inline]
    pub fn classify_counted(
        &self,
        volume: impl Into<Volume>,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        let volume = volume.into();
        with_extent!(&volume, v => self.settled_or_checked(v, &volume, counts))
    }

    /// What is settled needs no other check than that of its order.
    #[inline(always)]
    fn settled_or_checked<V: Extent>(
        &self,
        v: &V,
        volume: &Volume,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        let middle = v.middle();
        let size = V::size(&middle);
        match self.planes.settle::<V>(&middle, size) {
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
        let middle = v.middle();
        Ok(self.plane_by_plane(v, &middle, V::size(&middle), counts))
    }

    #[inline(always)]
    pub(super) fn by_planes<V: Extent>(&self, v: &V, counts: &mut VolumeCounts) -> Containment {
        let middle = v.middle();
        let size = V::size(&middle);
        match self.planes.settle::<V>(&middle, size) {
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
        for half_space in &self.half_spaces {
            match v.side(middle, size, half_space, counts) {
                Containment::Outside => return Containment::Outside,
                Containment::Crossing => all = Containment::Crossing,
                Containment::Inside => {}
            }
        }
        all
    }

    /// The same for trees of volumes: among faces that are still open, with the one
    /// that rejected this volume last time first.
    ///
    /// Start with [`Frustum::faces`]; give what is in a volume the `faces` of its
    /// answer. `hint` is the volume's own and outlives the frame: it is the face that
    /// rejects it, where one does. Neither changes an answer.
    ///
    /// ```
    /// use frusta::{Aabb, Containment, Culler, EndRect, Face, FaceSet, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// let all: FaceSet = frustum.faces().iter().copied().collect();
    /// let room = Aabb::new([1.0, -1.0, 2.0], [2.0, 1.0, 4.0]);
    /// let mut hint = None;
    /// let answer = culler.classify_masked(room, all, &mut hint)?;
    /// assert_eq!(answer.containment, Containment::Crossing);
    /// assert_eq!(answer.faces.to_string(), "far");
    /// // What is in the room is held to one face.
    /// let lamp = Aabb::new([1.4, -0.1, 3.5], [1.6, 0.1, 3.9]);
    /// let answer = culler.classify_masked(lamp, answer.faces, &mut hint)?;
    /// assert_eq!((answer.containment, hint), (Containment::Outside, Some(Face::Far)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// What [`Volume::check`] finds.
    pub fn classify_masked(
        &self,
        volume: impl Into<Volume>,
        faces: FaceSet,
        hint: &mut Option<Face>,
    ) -> Result<MaskedContainment, VolumeError> {
        let volume = volume.into();
        volume.check()?;
        with_extent!(&volume, v => Ok(self.among(v, faces, hint)))
    }

    fn among<V: Extent>(
        &self,
        v: &V,
        faces: FaceSet,
        hint: &mut Option<Face>,
    ) -> MaskedContainment {
        let counts = &mut VolumeCounts::default();
        let middle = v.middle();
        let size = V::size(&middle);
        let mut crossed = FaceSet::EMPTY;
        let first = hint.filter(|&face| faces.contains(face));
        let all = self.frustum.faces().iter().zip(&self.half_spaces);
        let is_first = |(face, _): &(&Face, &HalfSpace)| Some(**face) == first;
        let is_asked = |(face, _): &(&Face, &HalfSpace)| faces.contains(**face);
        let rest = all.clone().filter(|pair| !is_first(pair));
        for (&face, half_space) in all.filter(is_first).chain(rest).filter(is_asked) {
            match v.side(&middle, size, half_space, counts) {
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
