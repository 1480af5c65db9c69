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
use crate::math::{End, NonFinite, Real, Segment, Vec3};
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
    match triage(filter, &p, &q) {
        Triage::Outside => Ok(SegmentClip::OUTSIDE),
        Triage::Inside => Ok(inside(segment)),
        Triage::Crossing => Ok(match cross(frustum, segment, accuracy, [p, q]) {
            Some(result) => result,
            None => return super::clip(frustum, segment, accuracy, counts, |s| span(s)),
        }),
        Triage::Unsure => super::clip(frustum, segment, accuracy, counts, |s| span(s)),
    }
}

/// Clips what certainly has ends on both sides of some faces; `None` if their
/// order is not certain.
#[inline(never)]
fn cross<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    values: [Values; 2],
) -> Option<SegmentClip<T>> {
    let filter = frustum.filter();
    let (depth, side) = thresholds(filter, values[0].size + values[1].size);
    match certify(&values[0].g, &values[1].g, depth, side) {
        Certificate::Outside => Some(SegmentClip::OUTSIDE),
        Certificate::Cross(faces) if accuracy == Accuracy::Fast => {
            Some(fast(filter, segment, &segment.to_f64(), &values, faces))
        }
        Certificate::Cross(faces) => {
            let mut staged = Staged::with(frustum, segment.to_f64(), values, false);
            Some(points::build(
                &mut staged,
                segment,
                &crossing(faces),
                accuracy,
            ))
        }
        Certificate::None => None,
    }
}

/// The thresholds of depth and sides for both ends, from the sum of their
/// sizes: thresholds grow with it.
#[inline(always)]
fn thresholds(filter: &Filter, size: f64) -> (f64, f64) {
    // With the identity pose near and far values are differences of two
    // doubles: relative error u, and all that counts is that their reciprocals
    // are finite.
    let depth = if filter.identity {
        FLOOR
    } else {
        filter.depth_threshold(size)
    };
    (depth, filter.side_threshold(size))
}

/// What the rounded values' signs prove.
enum Triage {
    Outside,
    Inside,
    /// All signs are certain; some face is crossed.
    Crossing,
    Unsure,
}

#[inline(always)]
fn triage(filter: &Filter, p: &Values, q: &Values) -> Triage {
    let size = p.size + q.size;
    if !filter.covers(size) {
        return Triage::Unsure;
    }
    let (depth, side) = thresholds(filter, size);
    let (a, b) = (&p.g, &q.g);
    let greater = |i: usize| max(a[i], b[i]);
    let sides = min(min(greater(2), greater(3)), min(greater(4), greater(5)));
    if (min(greater(0), greater(1)) < -depth) | (sides < -side) {
        return Triage::Outside;
    }
    let lesser = |i: usize| min(a[i], b[i]);
    let least_depth = min(lesser(0), lesser(1));
    let least_side = min(min(lesser(2), lesser(3)), min(lesser(4), lesser(5)));
    if (least_depth > depth) & (least_side > side) {
        return Triage::Inside;
    }
    let nearest = |i: usize| min(a[i].abs(), b[i].abs());
    let least_depth = min(nearest(0), nearest(1));
    let least_side = min(min(nearest(2), nearest(3)), min(nearest(4), nearest(5)));
    if (least_depth > depth) & (least_side > side) {
        Triage::Crossing
    } else {
        Triage::Unsure
    }
}

/// What rounded parameters prove.
enum Certificate {
    Outside,
    /// Crosses one face at each end that is clipped.
    Cross([FaceSet; 2]),
    /// Nothing.
    None,
}

/// For values of certain sign, some of them negative. Selects, not branches:
/// which faces are crossed cannot be predicted.
#[inline(always)]
fn certify(a: &[f64; 6], b: &[f64; 6], depth: f64, side: f64) -> Certificate {
    // Parameters of entering and leaving faces; faces that are not crossed
    // stand where they change nothing.
    let (mut enter, mut leave, mut scales) = ([0.0; 6], [0.0; 6], [0.0; 6]);
    for i in 0..6 {
        let scale = 1.0 / (a[i] - b[i]);
        let t = a[i] * scale;
        enter[i] = where_negative(a[i], t, -1.0);
        leave[i] = where_negative(b[i], t, 2.0);
        scales[i] = where_negative(a[i] * b[i], scale.abs(), 0.0);
    }
    let depth_scale = max(scales[0], scales[1]);
    let side_scale = max(max(scales[2], scales[3]), max(scales[4], scales[5]));
    // What two parameters can be off, together.
    let error = 2.0 * (max(depth * depth_scale, side * side_scale) + ROUNDING);
    let last_enter = greatest(&enter);
    let first_leave = least(&leave);
    if last_enter > first_leave + error {
        return Certificate::Outside;
    }
    let (mut entered, mut left) = (0_u8, 0_u8);
    for i in 0..6 {
        entered |= u8::from(enter[i] >= last_enter - error) << i;
        left |= u8::from(leave[i] <= first_leave + error) << i;
    }
    // With none crossed, all stand at -1 or 2.
    let entered = if last_enter < -0.5 { 0 } else { entered };
    let left = if first_leave > 1.5 { 0 } else { left };
    let apart = last_enter + error < first_leave;
    let single = |set: u8| set & set.wrapping_sub(1) == 0;
    if apart & single(entered) & single(left) {
        Certificate::Cross([FaceSet::from_bits(entered), FaceSet::from_bits(left)])
    } else {
        Certificate::None
    }
}

/// `then` where the sign bit of `v` is set, else `other`; no branch.
#[inline(always)]
fn where_negative(v: f64, then: f64, other: f64) -> f64 {
    let mask = (v.to_bits().cast_signed() >> 63).cast_unsigned();
    f64::from_bits((then.to_bits() & mask) | (other.to_bits() & !mask))
}

#[inline(always)]
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn greatest(v: &[f64; 6]) -> f64 {
    max(max(max(v[0], v[1]), max(v[2], v[3])), max(v[4], v[5]))
}

#[inline(always)]
fn least(v: &[f64; 6]) -> f64 {
    min(min(min(v[0], v[1]), min(v[2], v[3])), min(v[4], v[5]))
}

/// The faces of a certain crossing, one at each clipped end: nothing is on a
/// face, and there are no ties.
#[inline(always)]
fn fast<T: Real>(
    filter: &Filter,
    segment: &Segment<T>,
    wide: &Segment<f64>,
    values: &[Values; 2],
    [entered, left]: [FaceSet; 2],
) -> SegmentClip<T> {
    let entry = fast_end(filter, (T::ZERO, segment.start), wide, values, entered);
    let mut exit = fast_end(filter, (T::ONE, segment.end), wide, values, left);
    if exit.t < entry.t {
        exit.t = entry.t;
    }
    SegmentClip {
        class: Class::Cross,
        part: Some(Part {
            entry,
            exit,
            coplanar: FaceSet::EMPTY,
        }),
    }
}

#[inline(always)]
fn fast_end<T: Real>(
    filter: &Filter,
    own: (T, Vec3<T>),
    wide: &Segment<f64>,
    values: &[Values; 2],
    faces: FaceSet,
) -> PartEnd<T> {
    let clipped = !faces.is_empty();
    let (t, point) = if clipped {
        let face = faces.bits().trailing_zeros() as usize;
        let step = points::certain_step::<T>(filter, wide, values, face);
        points::place(filter, wide, step, faces)
    } else {
        own
    };
    PartEnd {
        t,
        point,
        clipped,
        faces,
        inward: !clipped,
    }
}

/// The decision for certain crossings: nothing on a face, no ties.
fn crossing(faces: [FaceSet; 2]) -> Decision {
    let at = |face: Option<Face>, end| face.map_or(At::End(end), At::Crossing);
    Decision {
        class: Class::Cross,
        at: [
            at(faces[0].first(), End::Start),
            at(faces[1].first(), End::End),
        ],
        clipped: faces.map(|set| !set.is_empty()),
        faces,
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
