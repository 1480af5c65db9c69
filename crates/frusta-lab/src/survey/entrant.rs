//! The contestants: every algorithm in every tier, all called the same way.
//!
//! A call goes through `dyn`, so that no tier gains by being inlined into the timing loop.

use super::row::{SurveyAlgorithm, SurveyTier};
use frusta::clip::{
    Accuracy, Arithmetic, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant,
    SegmentClipper, SixPlanes, VwProjection,
};
use frusta::math::Real;

/// A clipper of one scalar type.
pub(super) type AnyAlgorithm<T> = dyn SegmentClipper<T> + Sync;

/// A clipper of either scalar type.
pub(super) enum AnyClipper {
    Single(Box<AnyAlgorithm<f32>>),
    Double(Box<AnyAlgorithm<f64>>),
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
            SurveyTier::PlainF32 | SurveyTier::PlainF64 => Arithmetic::Plain,
            SurveyTier::ExactFast | SurveyTier::ExactFastF32 => Arithmetic::Exact(Accuracy::Fast),
            SurveyTier::ExactNearest | SurveyTier::ExactNearestF32 => {
                Arithmetic::Exact(Accuracy::Nearest)
            }
            SurveyTier::ExactInward | SurveyTier::ExactInwardF32 => {
                Arithmetic::Exact(Accuracy::Inward)
            }
        };
        let clipper = if tier.is_single() {
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

fn clipper<T: Real>(algorithm: SurveyAlgorithm, arithmetic: Arithmetic) -> Box<AnyAlgorithm<T>> {
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
    fn of(clipper: &AnyClipper) -> Option<&AnyAlgorithm<Self>>;
}

impl Scalar for f32 {
    fn of(clipper: &AnyClipper) -> Option<&AnyAlgorithm<Self>> {
        match clipper {
            AnyClipper::Single(clipper) => Some(clipper.as_ref()),
            AnyClipper::Double(_) => None,
        }
    }
}

impl Scalar for f64 {
    fn of(clipper: &AnyClipper) -> Option<&AnyAlgorithm<Self>> {
        match clipper {
            AnyClipper::Double(clipper) => Some(clipper.as_ref()),
            AnyClipper::Single(_) => None,
        }
    }
}
