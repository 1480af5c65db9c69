//! Cyrus-Beck: entering and leaving parameters against oriented planes.
//!
//! # Source
//! M. Cyrus, J. Beck, "Generalized two- and three-dimensional clipping",
//! Computers & Graphics 3 (1978).
//!
//! # Idea
//! No computing frame: each face is a plane in the world, its normal inwards.
//! ```text
//! for each plane: value a at the start, b at the end
//!     both negative: outside
//!     a negative: entering at t = a / (a - b), t0 = max(t0, t)
//!     b negative: leaving  at t = a / (a - b), t1 = min(t1, t)
//! t0 > t1: outside
//! ```
//! This is the sound variant of clipping by six planes; the unsound one, which is
//! often described, is [`SixPlanes`](super::SixPlanes).
//!
//! # Deviations
//! The signs at both ends decide whether a plane is entered or left, so that
//! only planes that are crossed need a division.
//!
//! # Complexity
//! Constant: 12 plane values at most, a division for each plane crossed.
//!
//! # Degenerate input
//! A segment parallel to a plane has two values of one sign there: it is
//! rejected or not bounded. The same holds for a segment of zero length and every plane.

use super::plain::{self, Found};
use super::predicates::{Predicates, Role, Span};
use super::result::{Accuracy, Arithmetic, SegmentClip, StageCounts};
use super::whole::outside;
use super::{SegmentClipper, exact};
use crate::frustum::{Frustum, PlainFrustum};
use crate::math::{NonFinite, Real, Segment};

/// Clips by entering and leaving parameters against six oriented planes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CyrusBeck {
    /// The arithmetic of its decisions.
    pub arithmetic: Arithmetic,
}

impl CyrusBeck {
    /// Decisions in floating point of the segment's own type.
    #[must_use]
    pub const fn plain() -> Self {
        Self {
            arithmetic: Arithmetic::Plain,
        }
    }

    /// Exact decisions.
    #[must_use]
    pub const fn exact(accuracy: Accuracy) -> Self {
        Self {
            arithmetic: Arithmetic::Exact(accuracy),
        }
    }
}

impl<T: Real> SegmentClipper<T> for CyrusBeck {
    fn name(&self) -> &'static str {
        "cyrus-beck"
    }

    #[inline]
    fn clip_segment_counted(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        match self.arithmetic {
            Arithmetic::Plain => plain::run(frustum, segment, clip),
            Arithmetic::Exact(accuracy) => {
                exact::clip(frustum, segment, accuracy, counts, |p| span(p))
            }
        }
    }
}

/// The plain tier.
#[inline(always)]
pub(crate) fn clip<T: Real>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T> {
    let mut found = Found::WHOLE;
    for &face in f.faces() {
        let plane = &f.planes[face as usize];
        let (a, b) = (plane.value(segment.start), plane.value(segment.end));
        if !found.face_by_signs(face, a, b) {
            return outside();
        }
    }
    if found.t[0] > found.t[1] {
        return outside();
    }
    found.build(segment)
}

/// The control flow on exact predicates.
pub(super) fn span(p: &mut impl Predicates) -> Option<Span> {
    let mut span = Span::default();
    for &face in p.faces() {
        match p.role(face) {
            Role::Outside => return None,
            Role::Enter => span.enter(p, face),
            Role::Leave => span.leave(p, face),
            Role::Inside => {}
        }
    }
    span.unless_empty(p)
}
