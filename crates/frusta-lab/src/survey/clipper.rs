//! A clipper as a survey calls it, for a close look at one case.

use super::entrant::{AnyClipper, Entrant};
use super::row::{SurveyAlgorithm, SurveyTier};
use frusta::clip::{SegmentClip, StageCounts};
use frusta::frustum::Frustum;
use frusta::math::{NonFinite, Segment};

/// An algorithm in a tier, made ready for a frustum.
///
/// ```
/// use frusta_lab::{SurveyAlgorithm, SurveyClipper, SurveyTier};
/// use frusta::samples::Family;
/// let (frustum, segment) = Family::Shear.case(1, 0);
/// let clipper = SurveyClipper::new(SurveyAlgorithm::Vw, SurveyTier::PlainF64, &frustum);
/// assert!(clipper.clip_f64(&segment, &mut Default::default()).unwrap().is_ok());
/// assert!(clipper.clip_f32(&Default::default(), &mut Default::default()).is_none());
/// ```
pub struct SurveyClipper {
    clipper: AnyClipper,
    frustum: Frustum,
}

impl SurveyClipper {
    /// A clipper for a frustum.
    pub fn new(algorithm: SurveyAlgorithm, tier: SurveyTier, frustum: &Frustum) -> Self {
        Self {
            clipper: Entrant::new(algorithm, tier).clipper,
            frustum: frustum.clone(),
        }
    }

    /// Clips, and adds the stages that an exact tier's predicates needed to `counts`; `None` if
    /// the tier is in `f32`.
    pub fn clip_f64(
        &self,
        segment: &Segment<f64>,
        counts: &mut StageCounts,
    ) -> Option<Result<SegmentClip<f64>, NonFinite>> {
        match &self.clipper {
            AnyClipper::Double(clipper) => {
                Some(clipper.clip_segment_counted(&self.frustum, segment, counts))
            }
            AnyClipper::Single(_) => None,
        }
    }

    /// The same in `f32`; `None` if the tier is in `f64`.
    pub fn clip_f32(
        &self,
        segment: &Segment<f32>,
        counts: &mut StageCounts,
    ) -> Option<Result<SegmentClip<f32>, NonFinite>> {
        match &self.clipper {
            AnyClipper::Single(clipper) => {
                Some(clipper.clip_segment_counted(&self.frustum, segment, counts))
            }
            AnyClipper::Double(_) => None,
        }
    }
}
