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
//! threshold for e, which is 13 times what the values can be off, and 2^-48.

use super::decide::{At, Decision};
use super::points;
use super::staged::Staged;
use crate::clip::predicates::{Predicates, Span};
use crate::clip::{Accuracy, Class, Part, PartEnd, SegmentClip, StageCounts, plain, vw};
use crate::frustum::filter::{FLOOR, Filter, Values};
use crate::frustum::{Face, FaceSet, Form, Frustum, General, Layout, Orthographic, Symmetric};
use crate::math::{End, NonFinite, Real, Segment, Vec3};
use std::cmp::Ordering;
use wide::f64x2;

/// 2^-48: rounding, and the face's number in the last three bits.
const ROUNDING: f64 = 3.552713678800501e-15;

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
        Triage::Crossing => cross(frustum, segment, accuracy, counts, &p, &q),
        Triage::Unsure => unsure(frustum, segment, accuracy, counts, &p, &q),
    }
}

/// Something is near a face, or far away, or not finite.
#[cold]
#[inline(never)]
fn unsure<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    p: &Values,
    q: &Values,
) -> Result<SegmentClip<T>, NonFinite> {
    let filter = frustum.filter();
    let wide = segment.to_f64();
    let lattice = filter.is_lattice(wide.start, p.size) && filter.is_lattice(wide.end, q.size);
    if lattice && accuracy == Accuracy::Fast {
        return Ok(on_lattice(frustum, segment, &wide, [p, q]));
    }
    super::clip(frustum, segment, accuracy, counts, |s| span(s))
}

/// Where floating point makes no error. Values have at most 25 bits, so two
/// crossing parameters that differ do so by more than 2^-52, and rounded
/// quotients are in the order of the exact ones, equal where they are: the
/// plain algorithm decides exactly.
fn on_lattice<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    wide: &Segment<f64>,
    values: [&Values; 2],
) -> SegmentClip<T> {
    let decided = plain::in_frame::<vw::Plain, f64>(frustum.plain(), wide);
    let Some(part) = decided.part else {
        return SegmentClip::OUTSIDE;
    };
    let finish = |end: &PartEnd<f64>| {
        let crossed = end.faces.difference(part.coplanar);
        let (t, point) = match (end.t, crossed.first()) {
            (1.0, _) => (T::ONE, segment.end),
            (t, Some(face)) if t > 0.0 => {
                let [a, b] = values.map(|v| v.g[face as usize].abs());
                let step = points::Step::new(a, b, wide);
                points::place(frustum.filter(), wide, step, end.faces)
            }
            _ => (T::ZERO, segment.start),
        };
        PartEnd {
            t,
            point,
            clipped: end.clipped,
            faces: end.faces,
            inward: !end.clipped,
        }
    };
    let entry = finish(&part.entry);
    let mut exit = finish(&part.exit);
    if exit.t < entry.t {
        exit.t = entry.t;
    }
    SegmentClip {
        class: decided.class,
        part: Some(Part {
            entry,
            exit,
            coplanar: part.coplanar,
        }),
    }
}

/// Clips what certainly has ends on both sides of some faces.
#[inline(always)]
fn cross<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    p: &Values,
    q: &Values,
) -> Result<SegmentClip<T>, NonFinite> {
    let filter = frustum.filter();
    let thresholds = thresholds(filter, p.size + q.size);
    match certify(&pairs(&p.g), &pairs(&q.g), thresholds) {
        Certificate::Outside => return Ok(SegmentClip::OUTSIDE),
        Certificate::Cross(crossing) if accuracy == Accuracy::Fast => {
            if let Some(result) = fast(filter, segment, &crossing) {
                return Ok(result);
            }
        }
        Certificate::Cross(crossing) => {
            let mut staged = Staged::with(frustum, segment.to_f64(), [*p, *q], false);
            let decision = crossing.decision();
            return Ok(points::build(&mut staged, segment, &decision, accuracy));
        }
        Certificate::None => {}
    }
    super::clip(frustum, segment, accuracy, counts, |s| span(s))
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

/// (near, far), (left, right), (bottom, top).
#[inline(always)]
fn pairs(g: &[f64; 6]) -> [f64x2; 3] {
    let pair = |i: usize| f64x2::new([g[i], g[i + 1]]);
    [pair(0), pair(2), pair(4)]
}

#[inline(always)]
fn triage(filter: &Filter, p: &Values, q: &Values) -> Triage {
    let size = p.size + q.size;
    if !filter.covers(size) {
        return Triage::Unsure;
    }
    let (depth, side) = thresholds(filter, size);
    let (depth, side) = (f64x2::splat(depth), f64x2::splat(side));
    let (a, b) = (pairs(&p.g), pairs(&q.g));
    let greater = |i: usize| a[i].fast_max(b[i]);
    let sides = greater(1).fast_min(greater(2));
    if (greater(0).simd_lt(-depth) | sides.simd_lt(-side)).any() {
        return Triage::Outside;
    }
    let beyond = |v: [f64x2; 3]| (v[0].simd_gt(depth) & v[1].fast_min(v[2]).simd_gt(side)).all();
    let lesser = |i: usize| a[i].fast_min(b[i]);
    if beyond([lesser(0), lesser(1), lesser(2)]) {
        return Triage::Inside;
    }
    let nearer = |i: usize| a[i].abs().fast_min(b[i].abs());
    if beyond([nearer(0), nearer(1), nearer(2)]) {
        Triage::Crossing
    } else {
        Triage::Unsure
    }
}

/// What rounded parameters prove.
enum Certificate {
    Outside,
    /// Crosses one face at each end that is clipped.
    Cross(Crossing),
    /// Nothing.
    None,
}

/// The face crossed at entry and exit, by number, and whether it is: else the
/// number stands for nothing.
struct Crossing {
    faces: [usize; 2],
    /// All bits set or none.
    clipped: f64x2,
}

impl Crossing {
    /// The decision: nothing is on a face, and there are no ties.
    fn decision(&self) -> Decision {
        let clipped = self.clipped();
        let end = |i: usize, own| {
            let face = Face::ALL[self.faces[i]];
            if clipped[i] {
                (At::Crossing(face), FaceSet::from(face))
            } else {
                (At::End(own), FaceSet::EMPTY)
            }
        };
        let (entry, exit) = (end(0, End::Start), end(1, End::End));
        Decision {
            class: Class::Cross,
            at: [entry.0, exit.0],
            clipped,
            faces: [entry.1, exit.1],
            coplanar: FaceSet::EMPTY,
        }
    }

    #[inline(always)]
    fn clipped(&self) -> [bool; 2] {
        let bits = self.clipped.to_bitmask();
        [bits & 1 != 0, bits & 2 != 0]
    }
}

/// The greatest two of six numbers in pairs `v`, and of six in `w`: greatest
/// of both, then second of both.
#[inline(always)]
fn greatest_two(v: [f64x2; 3], w: [f64x2; 3]) -> (f64x2, f64x2) {
    let lanes = |v: [f64x2; 3]| {
        let (high, low) = (v[0].fast_max(v[1]), v[0].fast_min(v[1]));
        (high.fast_max(v[2]), low.fast_max(high.fast_min(v[2])))
    };
    let ((v, v_second), (w, w_second)) = (lanes(v), lanes(w));
    let [a, b] = f64x2::transpose([v, w]);
    let [c, d] = f64x2::transpose([v_second, w_second]);
    (a.fast_max(b), a.fast_min(b).fast_max(c.fast_max(d)))
}

/// For values of certain sign, some of them negative. Selects, not branches:
/// which faces are crossed cannot be predicted. The number of the face rides
/// in the parameter's last three bits.
#[inline(always)]
fn certify(a: &[f64x2; 3], b: &[f64x2; 3], (depth, side): (f64, f64)) -> Certificate {
    let all = f64x2::splat;
    let keep = all(f64::from_bits(!7));
    // The later of entries, and the later of exits, where later is less: faces
    // that are not crossed stand where they change nothing.
    let (mut enter, mut leave, mut scales) = ([all(0.0); 3], [all(0.0); 3], [all(0.0); 3]);
    for i in 0..3 {
        let number = [
            f64::from_bits(2 * i as u64),
            f64::from_bits(2 * i as u64 + 1),
        ];
        let scale = all(1.0) / (a[i] - b[i]);
        let t = a[i] * scale;
        let (entering, leaving) = (a[i].simd_lt(all(0.0)), b[i].simd_lt(all(0.0)));
        enter[i] = (entering.bitselect(t, all(-1.0)) & keep) | f64x2::new(number);
        leave[i] = (leaving.bitselect(-t, all(-2.0)) & keep) | f64x2::new(number);
        scales[i] = (entering ^ leaving) & scale.abs();
    }
    // What two parameters can be off, together.
    let error = (all(depth) * scales[0]).fast_max(all(side) * scales[1].fast_max(scales[2]));
    let [e, f] = error.to_array();
    let error = 2.0 * (if e > f { e } else { f } + ROUNDING);
    let (first, second) = greatest_two(enter, leave);
    let [last_enter, minus_first_leave] = first.to_array();
    let overlap = last_enter + minus_first_leave;
    if overlap > error {
        return Certificate::Outside;
    }
    let uncrossed = first.simd_lt(f64x2::new([-0.5, -1.5]));
    let single = (second + all(error)).simd_lt(first) | uncrossed;
    if single.all() & (overlap < -error) {
        Certificate::Cross(Crossing {
            faces: [number(last_enter), number(minus_first_leave)],
            clipped: !uncrossed,
        })
    } else {
        Certificate::None
    }
}

/// The face's number in a parameter's last bits.
#[inline(always)]
fn number(t: f64) -> usize {
    (t.to_bits() & 7) as usize
}

/// Constructs both ends of a certain crossing side by side, by the rule of
/// [`super::points`]; `None` for its tie of equal boundary values.
#[inline(always)]
fn fast<T: Real>(
    filter: &Filter,
    segment: &Segment<T>,
    crossing: &Crossing,
) -> Option<SegmentClip<T>> {
    let Segment { start, end } = segment.to_f64();
    let all = f64x2::splat;
    let a = filter.precise.magnitudes(crossing.faces, start);
    let b = filter.precise.magnitudes(crossing.faces, end);
    if a.simd_eq(b).any() {
        return None;
    }
    let from_end = b.simd_lt(a);
    let tau = a.fast_min(b) / (a + b);
    let t = from_end.bitselect(all(1.0) - tau, tau);
    let signed = from_end.bitselect(-tau, tau);
    // Adding zero: the sign of a zero must not depend on the order of the ends.
    let crossed =
        |p: f64, q: f64| from_end.bitselect(all(q), all(p)) + signed * all(q - p) + all(0.0);
    let clipped = crossing.clipped;
    let select = |v: f64x2, p: f64, q: f64| {
        let ends = clipped.bitselect(v, f64x2::new([p, q]));
        let [a, b] = ends.to_array();
        [T::from_f64(a), T::from_f64(b)]
    };
    let x = select(crossed(start.x, end.x), start.x, end.x);
    let y = select(crossed(start.y, end.y), start.y, end.y);
    let z = crossed(start.z, end.z);
    let z = select(
        filter.precise.exact_depth(crossing.faces, z),
        start.z,
        end.z,
    );
    let t = select(t, 0.0, 1.0);
    let clipped = crossing.clipped();
    let finish = |i: usize| PartEnd {
        t: t[i],
        point: Vec3::new(x[i], y[i], z[i]),
        clipped: clipped[i],
        faces: FaceSet::from_bits(u8::from(clipped[i]) << crossing.faces[i]),
        inward: !clipped[i],
    };
    let entry = finish(0);
    let mut exit = finish(1);
    if exit.t < entry.t {
        exit.t = entry.t;
    }
    Some(SegmentClip {
        class: Class::Cross,
        part: Some(Part {
            entry,
            exit,
            coplanar: FaceSet::EMPTY,
        }),
    })
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
