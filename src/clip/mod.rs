//! Clipping segments by a [`Frustum`]: which part of a segment is inside, and through which faces
//! it enters and leaves.
//!
//! | input | output | call |
//! |---|---|---|
//! | one segment | class, points, parameters, face sets | [`Frustum::clip_segment`] |
//! | one segment | the same, with a choice of [`Accuracy`] | [`Frustum::clip_segment_with`] |
//! | many: a slice, arrays, [`IndexedEdges`] | the same for each segment, faster than one by one | [`Frustum::clip_segments`] |
//! | many | class and parameters only, fastest | [`Frustum::clip_intervals`], [`Culler::clip_intervals`] |
//! | one segment or a slice | by a chosen algorithm | [`SegmentClipper`] |
//!
//! All but the last decide exactly, and give the same bits for the same segment.
//! [`SegmentClipper`] is for comparing algorithms, in exact or in plain arithmetic: in exact
//! arithmetic all of them give the same bits, too.
//!
//! Segments and frusta are closed sets: a segment that touches the frustum is not outside.
//!
//! ```
//! use frusta::{Accuracy, Class, EndRect, Face, Frustum, Pose, Segment, Shape};
//! let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
//! let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
//! let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
//! let edge = Segment::new([0.0, 0.0, 2.0], [4.0, 0.0, 2.0]);
//!
//! let clip = frustum.clip_segment(&edge)?;
//! let exit = clip.part.unwrap().exit;
//! assert_eq!((clip.class, exit.t, exit.faces), (Class::Cross, 0.5, Face::Right.into()));
//!
//! let mut clips = Vec::new();
//! frustum.clip_segments(&[edge, edge.reversed()], Accuracy::Fast, &mut clips)?;
//! assert_eq!(clips[0], clip);
//! assert_eq!(clips[1].part.unwrap().entry.point, exit.point);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Culler::clip_intervals`]: crate::Culler::clip_intervals

pub(crate) mod cohen_sutherland;
mod contains;
pub(crate) mod cyrus_beck;
mod exact;
pub(crate) mod liang_barsky;
pub(crate) mod many;
pub(crate) mod plain;
mod predicates;
mod result;
mod rules;
pub(crate) mod six_planes;
pub(crate) mod vw;
mod whole;

pub use cohen_sutherland::CohenSutherland;
pub use cyrus_beck::CyrusBeck;
pub use liang_barsky::{LiangBarsky, LiangBarskyVariant};
pub use many::intervals::SegmentIntervals;
pub use many::segments::{IndexError, IndexedEdges, SegmentArrays, Segments};
pub use result::{Accuracy, Arithmetic, Class, Part, PartEnd, SegmentClip, StageCounts};
pub use six_planes::SixPlanes;
pub use vw::VwProjection;

use crate::frustum::Frustum;
use crate::math::{NonFinite, NonFiniteAt, Real, Segment};
use crate::simd::Level;

/// An algorithm that clips segments by frusta.
///
/// All implementations take the same input and return results of the same form, so that
/// a caller can exchange them, also behind `dyn SegmentClipper<f64>`. In exact arithmetic the
/// results are the same, too.
///
/// ```
/// use frusta::clip::{CyrusBeck, SegmentClipper};
/// use frusta::{Accuracy, Class, EndRect, Frustum, Pose, Segment};
/// use frusta::clip::VwProjection;
/// use frusta::Shape;
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let clippers: [Box<dyn SegmentClipper<f64>>; 3] = [
///     Box::new(VwProjection::exact(Accuracy::Fast)),
///     Box::new(CyrusBeck::exact(Accuracy::Fast)),
///     Box::new(CyrusBeck::plain()),
/// ];
/// let segment = Segment::new([0.0, 0.0, 2.0], [4.0, 0.0, 2.0]);
/// for clipper in clippers {
///     let clip = clipper.clip_segment(&frustum, &segment)?;
///     assert_eq!(clip.class, Class::Cross, "{}", clipper.name());
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait SegmentClipper<T: Real> {
    /// The algorithm's name, in lower case with hyphens.
    fn name(&self) -> &'static str;

    /// The part of a segment that is in a frustum.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    #[inline]
    fn clip_segment(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
    ) -> Result<SegmentClip<T>, NonFinite> {
        self.clip_segment_counted(frustum, segment, &mut StageCounts::default())
    }

    /// As [`SegmentClipper::clip_segment`], and adds to `counts` which stages of
    /// the exact predicates were needed. Plain arithmetic has no such stages and adds nothing.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    fn clip_segment_counted(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite>;

    /// Clips a slice of segments: `clips` is cleared, then gets one clip for each segment, in
    /// order, with the same bits as from [`SegmentClipper::clip_segment`].
    ///
    /// [`VwProjection`] clips several at a time, in vector registers of the width
    /// that this processor has, which is faster than one by one. A buffer
    /// that is large enough is not allocated again; pieces of some thousand segments
    /// keep it in the processor's caches.
    ///
    /// # Errors
    /// A coordinate of a segment is infinite or NaN; `clips` is empty then.
    #[inline]
    fn clip_segments(
        &self,
        frustum: &Frustum,
        segments: &[Segment<T>],
        clips: &mut Vec<SegmentClip<T>>,
    ) -> Result<(), NonFiniteAt> {
        self.clip_segments_counted(frustum, segments, clips, &mut StageCounts::default())
    }

    /// As [`SegmentClipper::clip_segments`], and adds to `counts` what
    /// [`SegmentClipper::clip_segment_counted`] would add for each segment.
    ///
    /// # Errors
    /// A coordinate of a segment is infinite or NaN; `clips` is empty then.
    #[inline]
    fn clip_segments_counted(
        &self,
        frustum: &Frustum,
        segments: &[Segment<T>],
        clips: &mut Vec<SegmentClip<T>>,
        counts: &mut StageCounts,
    ) -> Result<(), NonFiniteAt> {
        clips.clear();
        clips.reserve(segments.len());
        for (index, segment) in segments.iter().enumerate() {
            match self.clip_segment_counted(frustum, segment, counts) {
                Ok(clip) => clips.push(clip),
                Err(found) => {
                    clips.clear();
                    return Err(NonFiniteAt { index, found });
                }
            }
        }
        Ok(())
    }
}

impl Frustum {
    /// The part of a segment that is in the frustum. Class and face sets are exact; points and
    /// parameters have [`Accuracy::Fast`].
    ///
    /// ```
    /// use frusta::{Class, EndRect, Face, Frustum, Pose, Segment, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// // Along a side, from inside the far face to beyond it.
    /// let clip = frustum.clip_segment(&Segment::new([2.0, 0.0, 2.0], [4.0, 0.0, 4.0]))?;
    /// assert_eq!(clip.class, Class::Boundary);
    /// let part = clip.part.unwrap();
    /// assert_eq!(part.coplanar, Face::Right.into());
    /// assert_eq!((part.exit.t, part.exit.point), (0.5, [3.0, 0.0, 3.0].into()));
    /// assert_eq!(part.exit.faces.to_string(), "far+right");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    #[inline]
    pub fn clip_segment<T: Real>(&self, segment: &Segment<T>) -> Result<SegmentClip<T>, NonFinite> {
        self.clip_segment_with(segment, Accuracy::Fast)
    }

    /// As [`Frustum::clip_segment`], with a choice of the points' accuracy.
    ///
    /// [`Accuracy::Inward`] gives points that are in the frustum, wherever there is a
    /// representable one nearby; [`PartEnd::inward`] is true if there is.
    ///
    /// ```
    /// use frusta::{Accuracy, EndRect, Frustum, Pose, Segment, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// // It leaves at x = 5/3, which no `f64` represents.
    /// let segment = Segment::new([0.0_f64, 0.0, 1.0], [5.0, 0.0, 3.0]);
    /// let nearest = frustum.clip_segment_with(&segment, Accuracy::Nearest)?;
    /// let inward = frustum.clip_segment_with(&segment, Accuracy::Inward)?;
    /// let [nearest, inward] = [nearest, inward].map(|clip| clip.part.unwrap().exit);
    /// assert!(!nearest.inward && inward.inward);
    /// assert!(frustum.contains(inward.point)?);
    /// assert!((inward.point.x - 5.0 / 3.0).abs() < 1e-15);
    ///
    /// // The tip of a needle at x = y = 1/3: no representable point near it is
    /// // inside, so the end is the nearest one, and `inward` is false.
    /// let mut pose = Pose::IDENTITY;
    /// pose.axes = [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 1.0]].map(Into::into);
    /// let near = EndRect::new(1.0, 1.0, 1.0, 1.0, 1.0);
    /// let far = EndRect::new(2.0, 0.999, 1.001, 0.999, 1.001);
    /// let needle = Frustum::new(pose, Shape::Finite { near, far })?;
    /// let segment = Segment::new([0.0, 0.0, 1.0], [1.0, 1.0, 1.0]);
    /// let tip = needle.clip_segment_with(&segment, Accuracy::Inward)?.part.unwrap().entry;
    /// assert!(!tip.inward && tip.point.x == 1.0 / 3.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    #[inline]
    pub fn clip_segment_with<T: Real>(
        &self,
        segment: &Segment<T>,
        accuracy: Accuracy,
    ) -> Result<SegmentClip<T>, NonFinite> {
        self.clip_segment_counted(segment, accuracy, &mut StageCounts::default())
    }

    /// The parts of many segments: `clips` is cleared, then gets one clip for each
    /// segment, in order, with the same bits as from [`Frustum::clip_segment_with`], in
    /// less time. Segments are a slice, arrays of coordinates or [`IndexedEdges`].
    ///
    /// A `clips` that is large enough is not allocated again. The first call with a large one costs more than the
    /// clipping: the system has to provide its pages, 104 bytes a segment in `f64`. Where only a
    /// few clips are of interest at a time, pieces of some thousand segments and one small `clips` avoid that, and stay in the
    /// processor's caches.
    ///
    /// ```
    /// use frusta::{Accuracy, Class, EndRect, Frustum, Pose, Segment, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let edges: Vec<Segment<f64>> = (0..1000)
    ///     .map(|i| Segment::new([0.0, 0.0, 2.0], [0.01 * f64::from(i), 0.0, 2.0]))
    ///     .collect();
    /// // A buffer for this slice and the next ones.
    /// let mut clips = Vec::new();
    /// frustum.clip_segments(&edges, Accuracy::Fast, &mut clips)?;
    /// let cut = clips.iter().filter(|clip| clip.class == Class::Cross);
    /// assert_eq!((clips.len(), cut.count()), (1000, 799));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate of a segment is infinite or NaN; `clips` is empty then.
    pub fn clip_segments<'a, T: Real>(
        &self,
        segments: impl Into<Segments<'a, T>>,
        accuracy: Accuracy,
        clips: &mut Vec<SegmentClip<T>>,
    ) -> Result<(), NonFiniteAt> {
        let (level, counts) = (Level::new(), &mut StageCounts::default());
        many::clip_exact(level, self, segments.into(), accuracy, clips, counts)
    }

    /// As [`Frustum::clip_segment_with`], and adds to `counts` which stages of
    /// the exact predicates were needed.
    ///
    /// ```
    /// use frusta::{Accuracy, EndRect, Frustum, Pose, Segment, Shape, StageCounts};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(4.0, -2.0, 2.0, -2.0, 2.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let mut counts = StageCounts::default();
    /// // Clearly inside; then with an end one ulp off a side of slope 1/3.
    /// for x in [0.5, 1.5_f64.next_down()] {
    ///     let segment = Segment::new([x, 0.3, 2.5], [0.0, 0.1, 2.0]);
    ///     let _ = frustum.clip_segment_counted(&segment, Accuracy::Fast, &mut counts)?;
    /// }
    /// assert_eq!(counts.filter_failures, 1);
    /// assert_eq!((counts.double_doubles, counts.integers), (1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    #[inline]
    pub fn clip_segment_counted<T: Real>(
        &self,
        segment: &Segment<T>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        exact::vw::clip(self, segment, accuracy, counts)
    }
}
