//! Six planes: the "general algorithm", as it is described.
//!
//! # Source
//! The general method that the paper on projection reduction compares with, and which errs on
//! singular cases according to the paper. The plain tier follows the description and does err;
//! it is here to show that. The sound variant is [`CyrusBeck`](super::CyrusBeck).
//!
//! # Idea
//! ```text
//! for each face's plane in the world:
//!     intersect it with the segment's line (not if parallel)
//!     keep the point if it is between the ends, and inside the other planes
//! an end of the segment that is inside all planes is kept, too
//! the first and the last point kept bound the result; no point kept: outside
//! ```
//!
//! # Where it errs
//! Whether a computed point is inside the other planes is decided on its
//! rounded coordinates. On an edge or at a vertex both points that should be
//! kept may be lost (a hit is missed), or one of them (the segment shrinks to
//! a point). With exact predicates the same control flow is right: the point
//! on face i is inside face j unless i is crossed before j is entered or after
//! j is left.
//!
//! # Complexity
//! Constant: up to six divisions, and up to 5 plane values for each point; the
//! slowest algorithm here.
//!
//! # Degenerate input
//! A parallel plane is skipped; a segment that is outside it is rejected when
//! the other planes' points are tested. Only the ends of a segment of zero length
//! are tested.

use super::plain::{self, Found};
use super::predicates::{Predicates, Role, Span};
use super::result::{Accuracy, Arithmetic, SegmentClip, StageCounts};
use super::whole::outside;
use super::{SegmentClipper, exact};
use crate::frustum::{Face, FaceSet, Frustum, PlainFrustum};
use crate::math::{NonFinite, Real, Segment};
use std::cmp::Ordering;

/// Clips by intersecting with six planes and keeping the points that are inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SixPlanes {
    /// The arithmetic of its decisions.
    pub arithmetic: Arithmetic,
}

impl SixPlanes {
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

impl<T: Real> SegmentClipper<T> for SixPlanes {
    fn name(&self) -> &'static str {
        "six-planes"
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

/// The first and the last point kept.
struct Kept<T> {
    t: [T; 2],
    faces: [FaceSet; 2],
    any: bool,
}

impl<T: Real> Kept<T> {
    #[inline(always)]
    fn keep(&mut self, t: T, faces: FaceSet) {
        self.any = true;
        if t < self.t[0] {
            (self.t[0], self.faces[0]) = (t, faces);
        } else if t == self.t[0] {
            self.faces[0] = self.faces[0].union(faces);
        }
        if t > self.t[1] {
            (self.t[1], self.faces[1]) = (t, faces);
        } else if t == self.t[1] {
            self.faces[1] = self.faces[1].union(faces);
        }
    }
}

/// The plain tier.
#[inline(always)]
pub(crate) fn clip<T: Real>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T> {
    let (zero, one) = (T::ZERO, T::ONE);
    let (p, d) = (segment.start, segment.end - segment.start);
    let is_inside = |point, except: Option<Face>| {
        f.faces()
            .iter()
            .all(|&face| Some(face) == except || f.planes[face as usize].value(point) >= zero)
    };
    let mut kept = Kept {
        t: [one, zero],
        faces: [FaceSet::EMPTY; 2],
        any: false,
    };
    let kept_ends = [is_inside(segment.start, None), is_inside(segment.end, None)];
    for (end, t) in [zero, one].into_iter().enumerate() {
        if kept_ends[end] {
            kept.keep(t, FaceSet::EMPTY);
        }
    }
    let mut coplanar = FaceSet::EMPTY;
    for &face in f.faces() {
        let plane = &f.planes[face as usize];
        let a = plane.value(p);
        let slope = plane.normal.dot(d);
        if slope == zero {
            if a == zero {
                coplanar.insert(face);
            }
            continue;
        }
        let t = -a / slope;
        if t >= zero && t <= one && is_inside(d.times_plus(t, p), Some(face)) {
            kept.keep(t, face.into());
        }
    }
    if !kept.any {
        return outside();
    }
    Found {
        t: kept.t,
        clipped: kept_ends.map(|kept| !kept),
        faces: kept.faces,
        coplanar,
    }
    .build(segment)
}

/// The control flow on exact predicates.
pub(super) fn span(p: &mut impl Predicates) -> Option<Span> {
    let mut span = Span::default();
    let mut inside = [true; 2];
    for &face in p.faces() {
        let role = p.role(face);
        match role {
            Role::Outside => return None,
            Role::Inside => continue,
            Role::Enter => inside[0] = false,
            Role::Leave => inside[1] = false,
        }
        if is_kept(p, face) {
            if role == Role::Enter {
                span.enter = Some(face);
            } else {
                span.leave = Some(face);
            }
        }
    }
    let found = |inside, face: Option<Face>| inside || face.is_some();
    (found(inside[0], span.enter) && found(inside[1], span.leave)).then_some(span)
}

/// Whether the crossing of one face is inside all others.
fn is_kept(p: &mut impl Predicates, face: Face) -> bool {
    p.faces().iter().all(|&other| {
        other == face
            || match p.role(other) {
                Role::Outside => false,
                Role::Enter => p.order(face, other) != Ordering::Less,
                Role::Leave => p.order(face, other) != Ordering::Greater,
                Role::Inside => true,
            }
    })
}
