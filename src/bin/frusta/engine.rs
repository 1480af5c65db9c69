//! The algorithms by name.

use clap::ValueEnum;
use frusta::{
    Frustum, NonFinite, Real, Segment, SegmentClip, SegmentClipper, StageCounts, VwProjection,
};

/// `--algorithm`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Algorithm {
    /// Projection on two planes (V/W)
    Vw,
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
    /// Never outside the frustum
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

/// What clips.
pub(crate) enum Engine<T> {
    /// Exact V/W, which counts the stages of its decisions.
    Counted(frusta::Accuracy),
    /// Any other.
    Other(Box<dyn SegmentClipper<T> + Send + Sync>, frusta::Arithmetic),
}

impl<T: Real> Engine<T> {
    /// The clipper of these names.
    pub(crate) fn new(algorithm: Algorithm, arithmetic: Arithmetic, accuracy: Accuracy) -> Self {
        match (algorithm, arithmetic) {
            (Algorithm::Vw, Arithmetic::Exact) => Self::Counted(accuracy.into()),
            (Algorithm::Vw, Arithmetic::Plain) => {
                Self::Other(Box::new(VwProjection::plain()), frusta::Arithmetic::Plain)
            }
        }
    }

    /// The algorithm's name.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Counted(_) => "vw",
            Self::Other(clipper, _) => clipper.name(),
        }
    }

    /// Arithmetic and, if that is exact, accuracy.
    pub(crate) fn arithmetic(&self) -> (&'static str, Option<&'static str>) {
        let accuracy = match self {
            Self::Counted(accuracy) => accuracy,
            Self::Other(_, frusta::Arithmetic::Exact(accuracy)) => accuracy,
            Self::Other(_, frusta::Arithmetic::Plain) => return ("plain", None),
        };
        let accuracy = match accuracy {
            frusta::Accuracy::Fast => "fast",
            frusta::Accuracy::Nearest => "nearest",
            frusta::Accuracy::Inward => "inward",
        };
        ("exact", Some(accuracy))
    }

    /// Whether clipping counts the stages of its decisions.
    pub(crate) fn counts(&self) -> bool {
        matches!(self, Self::Counted(_))
    }

    /// Clips a segment.
    #[inline]
    pub(crate) fn clip(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        stages: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        match self {
            Self::Counted(accuracy) => frustum.clip_segment_counted(segment, *accuracy, stages),
            Self::Other(clipper, _) => clipper.clip_segment(frustum, segment),
        }
    }
}
