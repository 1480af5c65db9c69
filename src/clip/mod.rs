//! Clipping segments: one file an algorithm, behind one trait.

mod cohen_sutherland;
mod cyrus_beck;
mod exact;
mod liang_barsky;
mod plain;
mod predicates;
mod result;
mod six_planes;
mod vw;

pub use cohen_sutherland::CohenSutherland;
pub use cyrus_beck::CyrusBeck;
pub use liang_barsky::{LiangBarsky, LiangBarskyVariant};
pub use result::{Accuracy, Arithmetic, Class, Part, PartEnd, SegmentClip, StageCounts};
pub use six_planes::SixPlanes;
pub use vw::VwProjection;

use crate::frustum::Frustum;
use crate::math::{NonFinite, Real, Segment};

/// An algorithm that clips segments by frusta.
///
/// All implementations take the same input and return the same result, so that
/// a caller can swap them, also behind `dyn SegmentClipper<f64>`.
pub trait SegmentClipper<T: Real> {
    /// The algorithm's name, in lower case with hyphens.
    fn name(&self) -> &'static str;

    /// The part of a segment that is in a frustum.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    fn clip_segment(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
    ) -> Result<SegmentClip<T>, NonFinite>;
}

impl Frustum {
    /// The part of a segment that is in the frustum: class and face sets exact,
    /// points to [`Accuracy::Fast`].
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    #[inline]
    pub fn clip_segment<T: Real>(&self, segment: &Segment<T>) -> Result<SegmentClip<T>, NonFinite> {
        self.clip_segment_with(segment, Accuracy::Fast)
    }

    /// As [`Frustum::clip_segment`], with a choice of how exact the points are.
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

    /// As [`Frustum::clip_segment_with`], and adds to `counts` which stages of
    /// the predicates were needed.
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
