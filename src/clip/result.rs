//! The result of clipping a segment, and the choice of its accuracy.

use crate::frustum::FaceSet;
use crate::math::{Real, Vec3};
use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign};

/// Position of a closed segment S relative to a closed frustum F.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Class {
    /// S and F have no point in common.
    Outside,
    /// They have one point in common, and it is on F's surface.
    Touch,
    /// They have a positive length in common, and the plane of at least one
    /// face contains all of S.
    Boundary,
    /// F contains all of S, and S is not `Boundary`.
    Inside,
    /// They have a positive length in common, clipped at one end or both.
    Cross,
}

impl Class {
    /// All classes.
    pub const ALL: [Class; 5] = [
        Class::Outside,
        Class::Touch,
        Class::Boundary,
        Class::Inside,
        Class::Cross,
    ];

    /// The class's name in lower case.
    pub const fn name(self) -> &'static str {
        ["outside", "touch", "boundary", "inside", "cross"][self as usize]
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One end of the part of a segment that is in a frustum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct PartEnd<T> {
    /// The segment's parameter, `0..=1`.
    pub t: T,
    /// The point; an end that was not clipped is the input's point, bit for bit.
    pub point: Vec3<T>,
    /// Whether the segment goes on beyond this end.
    pub clipped: bool,
    /// The faces whose planes contain the end, if the end is on the surface.
    pub faces: FaceSet,
    /// With [`Accuracy::Inward`]: whether `point` satisfies every face exactly.
    /// Always true for an end that was not clipped; with the other accuracies,
    /// false for one that was. With [`Arithmetic::Plain`] it proves nothing: an end that is
    /// outside may count as not clipped.
    pub inward: bool,
}

/// The part of a segment that is in a frustum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Part<T> {
    /// Where the segment enters the frustum; `entry.faces` is the entry set.
    pub entry: PartEnd<T>,
    /// Where it leaves the frustum; `exit.faces` is the exit set. `entry.t <= exit.t`.
    pub exit: PartEnd<T>,
    /// The faces whose planes contain the whole segment; empty for a segment
    /// of zero length.
    pub coplanar: FaceSet,
}

/// The result of clipping a segment by a frustum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
#[must_use]
pub struct SegmentClip<T> {
    /// The position of the segment relative to the frustum.
    pub class: Class,
    /// The part in the frustum; `None` exactly if the class is `Outside`.
    pub part: Option<Part<T>>,
}

impl<T: Real> SegmentClip<T> {
    /// The result for a segment that has no point in the frustum.
    pub const OUTSIDE: Self = Self {
        class: Class::Outside,
        part: None,
    };

    /// Whether all of the segment is in the frustum, so that it can be drawn as it was given.
    ///
    /// ```
    /// use frusta::{EndRect, Frustum, Pose, Segment, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let whole = |to| frustum.clip_segment(&Segment::new([0.0, 0.0, 2.0], to)).map(|c| c.is_whole());
    /// assert_eq!(whole([2.0, 0.0, 2.0]), Ok(true));
    /// assert_eq!(whole([3.0, 0.0, 2.0]), Ok(false));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    #[must_use]
    pub fn is_whole(&self) -> bool {
        let part = self.part.as_ref();
        part.is_some_and(|part| !part.entry.clipped && !part.exit.clipped)
    }

    /// The entry point and the exit point, if the segment meets the frustum.
    #[must_use]
    pub fn points(&self) -> Option<[Vec3<T>; 2]> {
        self.part.map(|p| [p.entry.point, p.exit.point])
    }
}

/// How accurately the points and parameters of a clipped segment are computed. Classes and face
/// sets are exact with each accuracy.
///
/// `u` is the unit roundoff of the segment's scalar type: 2^-24 for `f32`, 2^-53 for `f64`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum Accuracy {
    /// Each coordinate within `8 u` times the segment's largest coordinate,
    /// plus the smallest subnormal; each parameter within `4 u`.
    #[default]
    Fast,
    /// Each coordinate and each parameter correctly rounded (to nearest, ties
    /// to even).
    Nearest,
    /// A representable point within 2 ulp a coordinate of the exact one that
    /// satisfies every face exactly; where there is none, as `Nearest`, with
    /// [`PartEnd::inward`] false. Parameters as with `Nearest`.
    Inward,
}

impl Accuracy {
    /// The accuracy's name in lower case.
    pub const fn name(self) -> &'static str {
        ["fast", "nearest", "inward"][self as usize]
    }
}

impl fmt::Display for Accuracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The arithmetic that a clipper decides with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// Floating point of the segment's own type, as in textbooks:
    /// classes, sets and points may be wrong.
    Plain,
    /// Every decision is an exact sign; points have the given accuracy.
    Exact(Accuracy),
}

impl Default for Arithmetic {
    fn default() -> Self {
        Arithmetic::Exact(Accuracy::Fast)
    }
}

/// How often each stage of the exact predicates was needed.
///
/// With [`Accuracy::Inward`] the counts of the later stages include the signs of candidate points.
/// Counts of segments add up: with `+`, `+=` and [`Iterator::sum`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct StageCounts {
    /// Segments on a grid so coarse that plain arithmetic makes no error. They
    /// need no other stage, except to round their points.
    pub lattice: u64,
    /// Segments with at least one sign that the floating-point filter left open,
    /// whichever later stage decided it: mostly double-double.
    pub filter_failures: u64,
    /// Signs taken from double-double values.
    pub double_doubles: u64,
    /// Signs and values taken from floating-point expansions.
    pub expansions: u64,
    /// Signs and values taken from big integers.
    pub integers: u64,
}

impl AddAssign for StageCounts {
    fn add_assign(&mut self, other: Self) {
        self.lattice += other.lattice;
        self.filter_failures += other.filter_failures;
        self.double_doubles += other.double_doubles;
        self.expansions += other.expansions;
        self.integers += other.integers;
    }
}

impl Add for StageCounts {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl Sum for StageCounts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), Add::add)
    }
}
