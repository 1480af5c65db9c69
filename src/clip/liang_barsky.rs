//! Liang-Barsky: the parameter interval, shrunk side by side.
//!
//! # Source
//! Y.-D. Liang, B. Barsky, "A new concept and method for line clipping", ACM
//! Transactions on Graphics 3 (1984); here in the computing frame, against the
//! frustum's own boundary functions.
//!
//! # Idea
//! A boundary function is a at the start and b at the end. A point is inside where
//! `p t <= q` with `p = a - b`, `q = a`.
//! ```text
//! for each side:
//!     p = 0: outside if q < 0, no bound otherwise
//!     r = q / p
//!     p < 0: entering; outside if r > t1; t0 = max(t0, r)
//!     p > 0: leaving;  outside if r < t0; t1 = min(t1, r)
//! ```
//! That is [`LiangBarskyVariant::Textbook`]: a division for each side that is
//! not parallel. [`LiangBarskyVariant::Tuned`] looks at the signs of a and b
//! first: both negative is outside, both positive is no bound, and only the
//! remaining sides need a division.
//!
//! # Complexity
//! Constant: six divisions at most. Sides are taken one after another, so an
//! early rejection saves the rest.
//!
//! # Degenerate input
//! Parallel segments are decided by the sign of q. Zero length is parallel to
//! everything. In plain arithmetic a quotient just above 1 may round to 1, and
//! the textbook variant then counts the side as touched.

use super::plain::{self, Found, InFrame};
use super::predicates::{Predicates, Role, Span};
use super::result::{Accuracy, Arithmetic, SegmentClip, StageCounts};
use super::whole::outside;
use super::{SegmentClipper, exact};
use crate::frustum::{Face, Frustum, Layout, PlainFrustum};
use crate::math::{NonFinite, Real, Segment};
use std::cmp::Ordering;
use std::marker::PhantomData;

/// When a side's crossing parameter is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum LiangBarskyVariant {
    /// One division for each side that the segment is not parallel to.
    Textbook,
    /// One division for each side that the segment crosses, by the signs of the values.
    #[default]
    Tuned,
}

/// Clips by shrinking the parameter interval side by side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LiangBarsky {
    /// The arithmetic of its decisions.
    pub arithmetic: Arithmetic,
    /// When a side's crossing parameter is computed.
    pub variant: LiangBarskyVariant,
}

impl LiangBarsky {
    /// Decisions in floating point of the segment's own type.
    #[must_use]
    pub const fn plain(variant: LiangBarskyVariant) -> Self {
        Self {
            arithmetic: Arithmetic::Plain,
            variant,
        }
    }

    /// Exact decisions.
    #[must_use]
    pub const fn exact(variant: LiangBarskyVariant, accuracy: Accuracy) -> Self {
        Self {
            arithmetic: Arithmetic::Exact(accuracy),
            variant,
        }
    }
}

impl<T: Real> SegmentClipper<T> for LiangBarsky {
    fn name(&self) -> &'static str {
        match self.variant {
            LiangBarskyVariant::Textbook => "liang-barsky-textbook",
            LiangBarskyVariant::Tuned => "liang-barsky-tuned",
        }
    }

    #[inline]
    fn clip_segment_counted(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        match (self.arithmetic, self.variant) {
            (Arithmetic::Plain, LiangBarskyVariant::Textbook) => {
                plain::run(frustum, segment, plain::in_frame::<Plain<Textbook>, T>)
            }
            (Arithmetic::Plain, LiangBarskyVariant::Tuned) => {
                plain::run(frustum, segment, plain::in_frame::<Plain<Tuned>, T>)
            }
            (Arithmetic::Exact(accuracy), variant) => {
                exact::clip(frustum, segment, accuracy, counts, |p| match variant {
                    LiangBarskyVariant::Textbook => span_textbook(p),
                    LiangBarskyVariant::Tuned => span_tuned(p),
                })
            }
        }
    }
}

/// How a side shrinks the interval, by its values at both ends.
pub(crate) trait Side {
    /// False if the segment is outside.
    fn side<T: Real>(found: &mut Found<T>, face: Face, a: T, b: T) -> bool;
}

/// [`LiangBarskyVariant::Textbook`].
pub(crate) struct Textbook;
/// [`LiangBarskyVariant::Tuned`].
pub(crate) struct Tuned;

impl Side for Textbook {
    #[inline(always)]
    fn side<T: Real>(found: &mut Found<T>, face: Face, a: T, b: T) -> bool {
        let (p, q) = (a - b, a);
        if p == T::ZERO {
            if q == T::ZERO {
                found.coplanar.insert(face);
            }
            return q >= T::ZERO;
        }
        let r = q / p;
        if p < T::ZERO {
            if r > found.t[1] {
                return false;
            }
            found.enter(face, r);
        } else {
            if r < found.t[0] {
                return false;
            }
            found.leave(face, r);
        }
        true
    }
}

impl Side for Tuned {
    #[inline(always)]
    fn side<T: Real>(found: &mut Found<T>, face: Face, a: T, b: T) -> bool {
        found.face_by_signs(face, a, b)
    }
}

/// The plain tier.
pub(crate) struct Plain<S>(PhantomData<S>);

impl<S: Side> InFrame for Plain<S> {
    #[inline(always)]
    fn clip<T: Real, L: Layout>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T> {
        let mut found = Found::WHOLE;
        let p = f.to_frame(segment.start);
        let q = f.to_frame(segment.end);
        let ([wp, fp], [wq, fq]) = (f.depths::<L>(p.z), f.depths::<L>(q.z));
        if !S::side(&mut found, Face::Near, wp, wq) {
            return outside();
        }
        if L::FAR && !S::side(&mut found, Face::Far, fp, fq) {
            return outside();
        }
        for (i, low, high, cp, cq) in [
            (0, Face::Left, Face::Right, p.x, q.x),
            (2, Face::Bottom, Face::Top, p.y, q.y),
        ] {
            let [lp, hp] = f.sides::<L>(i, wp, cp);
            let [lq, hq] = f.sides::<L>(i, wq, cq);
            if !S::side(&mut found, low, lp, lq) || !S::side(&mut found, high, hp, hq) {
                return outside();
            }
        }
        if found.t[0] > found.t[1] {
            return outside();
        }
        found.build(segment)
    }
}

/// The textbook's control flow on exact predicates: each side is compared with
/// the interval so far.
pub(super) fn span_textbook(p: &mut impl Predicates) -> Option<Span> {
    let mut span = Span::default();
    for &face in p.faces() {
        match p.role(face) {
            Role::Outside => return None,
            Role::Enter => {
                let beyond = |f| p.order(face, f) == Ordering::Greater;
                if span.leave.is_some_and(beyond) {
                    return None;
                }
                span.enter(p, face);
            }
            Role::Leave => {
                let beyond = |f| p.order(face, f) == Ordering::Less;
                if span.enter.is_some_and(beyond) {
                    return None;
                }
                span.leave(p, face);
            }
            Role::Inside => {}
        }
    }
    Some(span)
}

/// The tuned control flow: all signs before any order.
pub(super) fn span_tuned(p: &mut impl Predicates) -> Option<Span> {
    let faces = p.faces();
    let mut roles = [Role::Inside; 6];
    for (role, &face) in roles.iter_mut().zip(faces) {
        *role = p.role(face);
        if *role == Role::Outside {
            return None;
        }
    }
    let mut span = Span::default();
    for (role, &face) in roles.into_iter().zip(faces) {
        match role {
            Role::Enter => span.enter(p, face),
            Role::Leave => span.leave(p, face),
            Role::Outside | Role::Inside => {}
        }
    }
    span.unless_empty(p)
}
