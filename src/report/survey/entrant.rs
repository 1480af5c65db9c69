//! Who takes part: every algorithm in every tier, all called the same way.
//!
//! A call goes through `dyn`, so that no tier gains by being inlined into a loop
//! that no program has.

use super::fused::{Fused, FusedClipper};
use super::row::{SurveyAlgorithm, SurveyTier};
use crate::clip::{
    Accuracy, Arithmetic, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClip,
    SegmentClipper, SixPlanes, StageCounts, VwProjection,
};
use crate::frustum::{Frustum, PlainFrustum};
use crate::math::{NonFinite, Real, Segment};

/// A frustum with what the tiers prepare once for it.
pub(super) struct Prepared {
    pub(super) frustum: Frustum,
    fused: PlainFrustum<Fused>,
}

impl Prepared {
    pub(super) fn new(frustum: &Frustum) -> Self {
        Self {
            frustum: frustum.clone(),
            fused: frustum.plain_scaled(1.0),
        }
    }
}

/// Clips as a survey asks it to.
pub(super) trait Clips<T>: Sync {
    fn clip(
        &self,
        frustum: &Prepared,
        segment: &Segment<T>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite>;
}

impl<T: Real, C: SegmentClipper<T> + Sync> Clips<T> for C {
    fn clip(
        &self,
        frustum: &Prepared,
        segment: &Segment<T>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        self.clip_segment_counted(&frustum.frustum, segment, counts)
    }
}

impl Clips<f64> for FusedClipper {
    fn clip(
        &self,
        frustum: &Prepared,
        segment: &Segment<f64>,
        _: &mut StageCounts,
    ) -> Result<SegmentClip<f64>, NonFinite> {
        FusedClipper::clip(*self, &frustum.frustum, &frustum.fused, segment)
    }
}

/// A clipper of either scalar type.
pub(super) enum AnyClipper {
    Single(Box<dyn Clips<f32>>),
    Double(Box<dyn Clips<f64>>),
}

/// An algorithm in a tier.
pub(super) struct Entrant {
    pub(super) algorithm: SurveyAlgorithm,
    pub(super) tier: SurveyTier,
    pub(super) clipper: AnyClipper,
}

impl Entrant {
    /// A clipper.
    pub(super) fn new(algorithm: SurveyAlgorithm, tier: SurveyTier) -> Self {
        let arithmetic = match tier {
            SurveyTier::PlainF32 | SurveyTier::PlainF64 | SurveyTier::FmaF64 => Arithmetic::Plain,
            SurveyTier::ExactFast | SurveyTier::ExactFastF32 => Arithmetic::Exact(Accuracy::Fast),
            SurveyTier::ExactNearest | SurveyTier::ExactNearestF32 => {
                Arithmetic::Exact(Accuracy::Nearest)
            }
            SurveyTier::ExactInward | SurveyTier::ExactInwardF32 => {
                Arithmetic::Exact(Accuracy::Inward)
            }
        };
        let clipper = if tier == SurveyTier::FmaF64 {
            AnyClipper::Double(Box::new(FusedClipper::new(algorithm)))
        } else if tier.is_single() {
            AnyClipper::Single(clipper(algorithm, arithmetic))
        } else {
            AnyClipper::Double(clipper(algorithm, arithmetic))
        };
        Self {
            algorithm,
            tier,
            clipper,
        }
    }

    /// Every algorithm in every tier, in the order of a family's rows.
    pub(super) fn all() -> Vec<Self> {
        let in_tiers = |algorithm| {
            SurveyTier::ALL
                .into_iter()
                .map(move |tier| Self::new(algorithm, tier))
        };
        SurveyAlgorithm::ALL
            .into_iter()
            .flat_map(in_tiers)
            .collect()
    }

    /// Whether times are compared with this one's.
    pub(super) fn is_reference(&self) -> bool {
        self.algorithm == SurveyAlgorithm::REFERENCE && self.tier == SurveyTier::PlainF64
    }
}

fn clipper<T: Real>(algorithm: SurveyAlgorithm, arithmetic: Arithmetic) -> Box<dyn Clips<T>> {
    let liang_barsky = |variant| LiangBarsky {
        arithmetic,
        variant,
    };
    match algorithm {
        SurveyAlgorithm::Vw => Box::new(VwProjection { arithmetic }),
        SurveyAlgorithm::LiangBarskyTuned => Box::new(liang_barsky(LiangBarskyVariant::Tuned)),
        SurveyAlgorithm::LiangBarskyTextbook => {
            Box::new(liang_barsky(LiangBarskyVariant::Textbook))
        }
        SurveyAlgorithm::CyrusBeck => Box::new(CyrusBeck { arithmetic }),
        SurveyAlgorithm::CohenSutherland => Box::new(CohenSutherland { arithmetic }),
        SurveyAlgorithm::SixPlanes => Box::new(SixPlanes { arithmetic }),
    }
}

/// A scalar type that entrants clip in.
pub(super) trait Scalar: Real {
    /// An entrant's clipper, if it is of this type.
    fn of(clipper: &AnyClipper) -> Option<&dyn Clips<Self>>;
}

impl Scalar for f32 {
    fn of(clipper: &AnyClipper) -> Option<&dyn Clips<Self>> {
        match clipper {
            AnyClipper::Single(clipper) => Some(clipper.as_ref()),
            AnyClipper::Double(_) => None,
        }
    }
}

impl Scalar for f64 {
    fn of(clipper: &AnyClipper) -> Option<&dyn Clips<Self>> {
        match clipper {
            AnyClipper::Double(clipper) => Some(clipper.as_ref()),
            AnyClipper::Single(_) => None,
        }
    }
}
