//! Cohen-Sutherland: out-codes in the computing frame.
//!
//! # Source
//! D. Cohen, I. Sutherland (1967), as in W. Newman, R. Sproull, "Principles of
//! Interactive Computer Graphics"; in three dimensions and for a frustum.
//!
//! # Idea
//! ```text
//! a code for each end: a bit for each face that the end is strictly outside of
//! codes share a bit: outside.  both empty: inside
//! while a code is not empty:
//!     take an end with a bit, and the first face in its code
//!     move the end to where the segment crosses that face; code it anew
//!     it shares a bit with the other end's first code: outside
//! ```
//!
//! # Deviations
//! 1. A moved end is always computed from the original ends, so that errors do
//!    not add up, and it is compared with the other end's *first* code: being
//!    beyond a face through which the other end leaves empties the segment.
//! 2. The code of a moved end has only faces of its first code that it has not
//!    been moved to. So there are at most six rounds, whatever rounding does;
//!    the textbook's loop can hang.
//!
//! # Complexity
//! Constant: at most six rounds with a division and six values each. Cheap if
//! most segments are wholly outside or inside, expensive if most are clipped.
//!
//! # Degenerate input
//! Zero values set no bit: touching is a hit. Both ends of a segment of zero
//! length have the same code, so it is rejected or accepted at once.

use super::plain::{self, Found, InFrame};
use super::predicates::{Predicates, Role, Span};
use super::result::{Accuracy, Arithmetic, SegmentClip, StageCounts};
use super::whole::{inside, outside};
use super::{SegmentClipper, exact};
use crate::frustum::{Face, FaceSet, Frustum, Layout, PlainFrustum};
use crate::math::{NonFinite, Real, Segment, Vec3};
use std::cmp::Ordering;

/// Clips by out-codes in the computing frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CohenSutherland {
    /// The arithmetic of its decisions.
    pub arithmetic: Arithmetic,
}

impl CohenSutherland {
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

impl<T: Real> SegmentClipper<T> for CohenSutherland {
    fn name(&self) -> &'static str {
        "cohen-sutherland"
    }

    #[inline]
    fn clip_segment_counted(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        match self.arithmetic {
            Arithmetic::Plain => plain::run(frustum, segment, plain::in_frame::<Plain, T>),
            Arithmetic::Exact(accuracy) => {
                exact::clip(frustum, segment, accuracy, counts, |p| span(p))
            }
        }
    }
}

/// The plain tier.
pub(crate) struct Plain;

#[inline(always)]
fn values<T: Real, L: Layout>(f: &PlainFrustum<T>, p: Vec3<T>) -> [T; 6] {
    let [near, far] = f.depths::<L>(p.z);
    let [left, right] = f.sides::<L>(0, near, p.x);
    let [bottom, top] = f.sides::<L>(2, near, p.y);
    [near, far, left, right, bottom, top]
}

/// The faces whose value passes the test, as bits.
#[inline(always)]
fn code<T: Real>(values: &[T; 6], test: impl Fn(T) -> bool) -> u8 {
    let mut code = 0;
    for (i, &value) in values.iter().enumerate() {
        code |= u8::from(test(value)) << i;
    }
    code
}

impl InFrame for Plain {
    #[inline(always)]
    fn clip<T: Real, L: Layout>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T> {
        let zero = T::ZERO;
        let (out, on) = (|v| v < zero, |v| v == zero);
        let p = f.to_frame(segment.start);
        let q = f.to_frame(segment.end);
        let a = values::<T, L>(f, p);
        let b = values::<T, L>(f, q);
        let first = [code(&a, out), code(&b, out)];
        if first[0] & first[1] != 0 {
            return outside();
        }
        let mut touched = [code(&a, on), code(&b, on)];
        if first[0] | first[1] | touched[0] | touched[1] == 0 {
            return inside(segment);
        }
        let coplanar = touched[0] & touched[1];
        let d = q - p;
        let mut t = [zero, T::ONE];
        for end in [0, 1] {
            let (mut code_now, mut left) = (first[end], first[end]);
            while code_now != 0 {
                let i = code_now.trailing_zeros() as usize;
                left &= !(1 << i);
                let crossing = a[i] / (a[i] - b[i]);
                t[end] = if end == 0 {
                    plain::max(crossing, t[0])
                } else {
                    plain::min(crossing, t[1])
                };
                let v = values::<T, L>(f, d.times_plus(t[end], p));
                let anew = code(&v, out);
                if anew & first[1 - end] != 0 {
                    return outside();
                }
                code_now = anew & left;
                touched[end] = code(&v, on) | 1 << i;
            }
        }
        if t[0] > t[1] {
            return outside();
        }
        Found {
            t,
            clipped: first.map(|code| code != 0),
            faces: touched.map(FaceSet::from_bits),
            coplanar: FaceSet::from_bits(coplanar),
        }
        .build(segment)
    }
}

/// The control flow on exact predicates. The code of a moved end holds the
/// faces through which it has yet to enter; beyond a face through which the
/// other end leaves nothing is left.
pub(super) fn span(p: &mut impl Predicates) -> Option<Span> {
    let mut codes = [FaceSet::EMPTY; 2];
    for &face in p.faces() {
        match p.role(face) {
            Role::Outside => return None,
            Role::Enter => codes[0].insert(face),
            Role::Leave => codes[1].insert(face),
            Role::Inside => {}
        }
    }
    let enter = move_end(p, codes[0], Ordering::Less, codes[1])?;
    let leave = move_end(p, codes[1], Ordering::Greater, codes[0])?;
    Some(Span { enter, leave })
}

/// Moves an end from face to face until its code is empty; `None` if it moves
/// beyond a face in the other end's code. `outside` is the order of a point that is outside one of
/// the end's own faces to that face's crossing.
fn move_end(
    p: &mut impl Predicates,
    own: FaceSet,
    outside: Ordering,
    other: FaceSet,
) -> Option<Option<Face>> {
    let mut at = None;
    let mut code = own;
    while let Some(face) = code.first() {
        at = Some(face);
        if other.iter().any(|f| p.order(face, f) == outside.reverse()) {
            return None;
        }
        code = own
            .iter()
            .filter(|&f| f != face && p.order(face, f) == outside)
            .collect();
    }
    Some(at)
}
