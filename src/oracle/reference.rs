//! The reference clipper: right, and slow.
//!
//! Tests compare the fast clippers with it where they need a whole answer, and show with
//! it that the checks accept a right one. Its `Fast` answers are correctly rounded too,
//! which is more than the accuracy promises.

use super::{Oracle, OracleEnd, round_nearest};
use crate::clip::{Accuracy, Part, PartEnd, SegmentClip, SegmentClipper, StageCounts};
use crate::frustum::{Face, FaceSet, Frustum};
use crate::math::{NonFinite, Real, Segment, Vec3};

/// Clips by rational arithmetic and rounds once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OracleClipper {
    /// The accuracy of the points.
    pub accuracy: Accuracy,
}

impl<T: Real> SegmentClipper<T> for OracleClipper {
    fn name(&self) -> &'static str {
        "oracle"
    }

    fn clip_segment_counted(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        _: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        Oracle::new(frustum).answer(segment, self.accuracy)
    }
}

impl Oracle {
    /// The exact answer, rounded.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    pub fn answer<T: Real>(
        &self,
        segment: &Segment<T>,
        accuracy: Accuracy,
    ) -> Result<SegmentClip<T>, NonFinite> {
        let truth = self.clip(segment)?;
        let end = |exact: &OracleEnd, input: Vec3<T>| {
            let (point, inward) = match (exact.clipped, accuracy) {
                (false, _) => (input, true),
                (true, Accuracy::Inward) => self.inward_or_nearest(exact),
                (true, Accuracy::Fast | Accuracy::Nearest) => (nearest(exact), false),
            };
            PartEnd {
                t: round_nearest(&exact.t),
                point,
                clipped: exact.clipped,
                faces: exact.faces,
                inward,
            }
        };
        Ok(SegmentClip {
            class: truth.class,
            part: truth.part.map(|part| Part {
                entry: end(&part.entry, segment.start),
                exit: end(&part.exit, segment.end),
                coplanar: part.coplanar,
            }),
        })
    }

    /// An inward point if there is one, or else the nearest one. At a near or far hit in
    /// the identity pose, points with that end's `z` come first.
    fn inward_or_nearest<T: Real>(&self, exact: &OracleEnd) -> (Vec3<T>, bool) {
        let depth = self
            .end_depth(exact.faces)
            .and_then(|z| self.inward_point(&exact.point, Some(T::from_f64(z))));
        match depth.or_else(|| self.inward_point(&exact.point, None)) {
            Some(point) => (point, true),
            None => (nearest(exact), false),
        }
    }

    /// The `z` of a near or far hit, if frame coordinates are world coordinates.
    pub(crate) fn end_depth(&self, faces: FaceSet) -> Option<f64> {
        let [near, far] = self.world_ends?;
        match (faces.contains(Face::Near), faces.contains(Face::Far)) {
            (true, _) => near,
            (false, true) => far,
            (false, false) => None,
        }
    }
}

fn nearest<T: Real>(exact: &OracleEnd) -> Vec3<T> {
    Vec3::from(exact.point.each_ref().map(round_nearest::<T>))
}
