//! Exact V/W: the plain algorithm with certificates.
//!
//! ```text
//! values of TV and TW at both ends, as in the plain tier, and one threshold
//! outside   a face with both values below -threshold
//! inside    every value above threshold
//! hand on   a value within the threshold of zero
//! else      for each crossed face the parameter t and a bound d of its error;
//!           outside if some entry - d > some exit + d; hand on what overlaps
//! ```
//!
//! What is handed on goes through the same predicates as every other
//! algorithm, and the points are constructed by the same rule, so that the
//! result does not depend on which way was taken.
//!
//! # The parameters' error
//! With both values of a face within e of the exact ones, p and q of opposite
//! signs, `p~/(p~ - q~)` differs from `p/(p - q)` by at most e / |p~ - q~|
//! (put the difference over one denominator). Rounding of the difference, its
//! reciprocal and the product add less than 4 u. The code takes a whole
//! threshold for e, which is 13 times what the values can be off, and 2^-50.

use super::decide::{At, Decision};
use super::points;
use super::staged::Staged;
use crate::clip::predicates::{Predicates, Span};
use crate::clip::{Accuracy, Class, Part, PartEnd, SegmentClip, StageCounts};
use crate::frustum::filter::{FLOOR, Filter, Values};
use crate::frustum::{Face, FaceSet, Form, Frustum, General, Layout, Orthographic, Symmetric};
use crate::math::{End, NonFinite, Real, Segment};
use std::cmp::Ordering;

/// 2^-50.
const ROUNDING: f64 = 8.881784197001252e-16;

/// Clips with exact class and sets.
#[inline]
pub(crate) fn clip<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
) -> Result<SegmentClip<T>, NonFinite> {
    match frustum.filter().form {
        Form::Symmetric => clip_in::<T, Symmetric<true>>(frustum, segment, accuracy, counts),
        Form::General => clip_in::<T, General<true>>(frustum, segment, accuracy, counts),
        Form::Orthographic => clip_in::<T, Orthographic>(frustum, segment, accuracy, counts),
        Form::InfiniteSymmetric => {
            clip_in::<T, Symmetric<false>>(frustum, segment, accuracy, counts)
        }
        Form::Infinite => clip_in::<T, General<false>>(frustum, segment, accuracy, counts),
    }
}

#[inline(always)]
fn clip_in<T: Real, L: Layout>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
) -> Result<SegmentClip<T>, NonFinite> {
    let filter = frustum.filter();
    let wide = segment.to_f64();
    let p = filter.values_in::<L>(wide.start);
    let q = filter.values_in::<L>(wide.end);
    match certify(filter, &p, &q) {
        Certificate::Outside => Ok(SegmentClip::OUTSIDE),
        Certificate::Inside => Ok(inside(segment)),
        Certificate::Cross(span) => {
            let mut staged = Staged::with(frustum, wide, [p, q], false);
            let decision = crossing(span);
            Ok(points::build(&mut staged, segment, &decision, accuracy))
        }
        Certificate::None => super::clip(frustum, segment, accuracy, counts, |s| span(s)),
    }
}

/// What rounded values prove.
enum Certificate {
    Outside,
    Inside,
    Cross(Span),
    /// Nothing.
    None,
}

#[inline(always)]
fn certify(filter: &Filter, p: &Values, q: &Values) -> Certificate {
    let size = p.size + q.size;
    if !filter.covers(size) {
        return Certificate::None;
    }
    // Thresholds grow with the size, so these serve both ends.
    let side = filter.side_threshold(size);
    // With the identity pose near and far values are differences of two
    // doubles: relative error u, and all that counts is that their reciprocals
    // are finite.
    let depth = if filter.identity {
        FLOOR
    } else {
        filter.depth_threshold(size)
    };
    let (a, b) = (&p.g, &q.g);
    let greater = |i: usize| a[i].max(b[i]);
    if greater(0).min(greater(1)) < -depth
        || greater(2).min(greater(3)) < -side
        || greater(4).min(greater(5)) < -side
    {
        return Certificate::Outside;
    }
    let least = |g: &[f64; 6]| (g[0].min(g[1]), g[2].min(g[3]).min(g[4].min(g[5])));
    let ((da, sa), (db, sb)) = (least(a), least(b));
    if da.min(db) > depth && sa.min(sb) > side {
        return Certificate::Inside;
    }
    let nearest = |i: usize| a[i].abs().min(b[i].abs());
    let sure = nearest(0).min(nearest(1)) > depth
        && nearest(2).min(nearest(3)).min(nearest(4).min(nearest(5))) > side;
    if sure {
        certify_crossing(a, b, depth, side)
    } else {
        Certificate::None
    }
}

/// For values of certain sign, some of them negative.
#[inline(always)]
fn certify_crossing(a: &[f64; 6], b: &[f64; 6], depth: f64, side: f64) -> Certificate {
    let error = [depth, depth, side, side, side, side];
    // Bounds of the parameters of entering and leaving faces; faces that are
    // not crossed stand where they change nothing.
    let mut enter = [[-1.0; 6]; 2];
    let mut leave = [[2.0; 6]; 2];
    for i in 0..6 {
        let scale = 1.0 / (a[i] - b[i]);
        let t = a[i] * scale;
        let d = error[i] * scale.abs() + ROUNDING;
        if a[i] < 0.0 {
            enter[0][i] = t - d;
            enter[1][i] = t + d;
        }
        if b[i] < 0.0 {
            leave[0][i] = t - d;
            leave[1][i] = t + d;
        }
    }
    let greatest = |v: &[f64; 6]| v[0].max(v[1]).max(v[2].max(v[3])).max(v[4].max(v[5]));
    let least = |v: &[f64; 6]| v[0].min(v[1]).min(v[2].min(v[3])).min(v[4].min(v[5]));
    let last_enter = greatest(&enter[0]);
    let first_leave = least(&leave[1]);
    if last_enter > first_leave {
        return Certificate::Outside;
    }
    let (mut entered, mut left) = (0_u8, 0_u8);
    for i in 0..6 {
        entered |= u8::from((enter[1][i] >= last_enter) & (a[i] < 0.0)) << i;
        left |= u8::from((leave[0][i] <= first_leave) & (b[i] < 0.0)) << i;
    }
    let apart = greatest(&enter[1]) < least(&leave[0]);
    let (entered, left) = (FaceSet::from_bits(entered), FaceSet::from_bits(left));
    if apart && entered.len() <= 1 && left.len() <= 1 {
        Certificate::Cross(Span {
            enter: entered.first(),
            leave: left.first(),
        })
    } else {
        Certificate::None
    }
}

/// The decision for certain crossings: nothing on a face, no ties.
#[inline(always)]
fn crossing(span: Span) -> Decision {
    let at = |face: Option<Face>, end| face.map_or(At::End(end), At::Crossing);
    let faces = |face: Option<Face>| face.map_or(FaceSet::EMPTY, FaceSet::from);
    Decision {
        class: Class::Cross,
        at: [at(span.enter, End::Start), at(span.leave, End::End)],
        clipped: [span.enter.is_some(), span.leave.is_some()],
        faces: [faces(span.enter), faces(span.leave)],
        coplanar: FaceSet::EMPTY,
    }
}

#[inline(always)]
fn inside<T: Real>(segment: &Segment<T>) -> SegmentClip<T> {
    let end = |t, point| PartEnd {
        t,
        point,
        clipped: false,
        faces: FaceSet::EMPTY,
        inward: true,
    };
    SegmentClip {
        class: Class::Inside,
        part: Some(Part {
            entry: end(T::ZERO, segment.start),
            exit: end(T::ONE, segment.end),
            coplanar: FaceSet::EMPTY,
        }),
    }
}

/// The control flow on exact predicates: the parameter interval in TV (near,
/// far, left, right), then what TW (bottom, top; near and far are shared) takes
/// off it.
pub(crate) fn span(p: &mut impl Predicates) -> Option<Span> {
    let mut span = Span::default();
    for &face in p.faces() {
        let start = p.side(face, End::Start);
        let end = p.side(face, End::End);
        match (start, end) {
            (Ordering::Less, Ordering::Less) => return None,
            (Ordering::Less, _) => {
                if span
                    .enter
                    .is_none_or(|f| p.order(face, f) == Ordering::Greater)
                {
                    span.enter = Some(face);
                }
            }
            (_, Ordering::Less) => {
                if span
                    .leave
                    .is_none_or(|f| p.order(face, f) == Ordering::Less)
                {
                    span.leave = Some(face);
                }
            }
            _ => {}
        }
    }
    match (span.enter, span.leave) {
        (Some(a), Some(b)) if p.order(a, b) == Ordering::Greater => None,
        _ => Some(span),
    }
}
