//! The algorithms by name.

use clap::ValueEnum;
use frusta::clip::{
    self, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::{Frustum, NonFiniteAt, Real, Segment, SegmentClip, StageCounts};

/// `--algorithm`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Algorithm {
    /// Projection on two planes
    Vw,
    /// Liang-Barsky that divides only where the signs require it
    LiangBarsky,
    /// Liang-Barsky with a division for each side that is not parallel
    LiangBarskyTextbook,
    /// Intersection with each face's plane, points kept that are inside
    SixPlanes,
    /// Entering and leaving parameters against oriented planes
    CyrusBeck,
    /// Region codes in the frustum's frame
    CohenSutherland,
}

/// `--arithmetic`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Arithmetic {
    /// The textbook's algorithm in floating point: classes and points may be wrong
    Plain,
    /// Every decision is an exact sign
    Exact,
}

/// `--accuracy`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Accuracy {
    /// Within 8 roundoffs of the segment's largest coordinate
    Fast,
    /// Each coordinate and parameter correctly rounded
    Nearest,
    /// Never outside, where any representable point near is inside; the rest are counted
    Inward,
}

impl From<Accuracy> for frusta::Accuracy {
    fn from(accuracy: Accuracy) -> Self {
        match accuracy {
            Accuracy::Fast => Self::Fast,
            Accuracy::Nearest => Self::Nearest,
            Accuracy::Inward => Self::Inward,
        }
    }
}

/// The chosen clipper.
pub(crate) struct Engine<T> {
    clipper: Box<dyn SegmentClipper<T> + Send + Sync>,
    arithmetic: clip::Arithmetic,
}

impl<T: Real> Engine<T> {
    /// The clipper of these names.
    pub(crate) fn new(algorithm: Algorithm, arithmetic: Arithmetic, accuracy: Accuracy) -> Self {
        let arithmetic = match arithmetic {
            Arithmetic::Plain => clip::Arithmetic::Plain,
            Arithmetic::Exact => clip::Arithmetic::Exact(accuracy.into()),
        };
        let liang_barsky = |variant| {
            Box::new(LiangBarsky {
                arithmetic,
                variant,
            })
        };
        let clipper: Box<dyn SegmentClipper<T> + Send + Sync> = match algorithm {
            Algorithm::Vw => Box::new(VwProjection { arithmetic }),
            Algorithm::LiangBarsky => liang_barsky(LiangBarskyVariant::Tuned),
            Algorithm::LiangBarskyTextbook => liang_barsky(LiangBarskyVariant::Textbook),
            Algorithm::SixPlanes => Box::new(SixPlanes { arithmetic }),
            Algorithm::CyrusBeck => Box::new(CyrusBeck { arithmetic }),
            Algorithm::CohenSutherland => Box::new(CohenSutherland { arithmetic }),
        };
        Self {
            clipper,
            arithmetic,
        }
    }

    /// The algorithm's name.
    pub(crate) fn name(&self) -> &'static str {
        self.clipper.name()
    }

    /// The arithmetic and, if it is exact, the accuracy.
    pub(crate) fn arithmetic(&self) -> (&'static str, Option<&'static str>) {
        match self.arithmetic {
            clip::Arithmetic::Exact(accuracy) => ("exact", Some(accuracy.name())),
            clip::Arithmetic::Plain => ("plain", None),
        }
    }

    /// Whether there are stages of decisions to count.
    pub(crate) fn counts(&self) -> bool {
        self.arithmetic != clip::Arithmetic::Plain
    }

    /// Clips segments: `clips` is cleared, then gets a clip a segment. Adds to `stages`.
    pub(crate) fn clip(
        &self,
        frustum: &Frustum,
        segments: &[Segment<T>],
        clips: &mut Vec<SegmentClip<T>>,
        stages: &mut StageCounts,
    ) -> Result<(), NonFiniteAt> {
        let clipper = &self.clipper;
        clipper.clip_segments_counted(frustum, segments, clips, stages)
    }
}
