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
//! reciprocal and the product add less than 4 u, the face's number in the last
//! three bits at most 7 units of 2 u. The code takes a whole threshold for e,
//! which is 13 times what the values can be off, and 2^-48 = 32 u. Near and far
//! values of the identity pose have a relative error of u instead, which moves
//! t by u / 2 at most. `proofs/crossing.gappa` has these bounds.

use super::decide::{At, Decision};
use super::pair::{self, Ends};
use super::staged::Staged;
use super::{lattice, points};
use crate::clip::plain::outside;
use crate::clip::predicates::{Predicates, Role, Span};
use crate::clip::{Accuracy, Class, SegmentClip, StageCounts};
use crate::exact::float::Pair;
use crate::frustum::eval::filter::{Filter, Values};
use crate::frustum::{Face, FaceSet, Form, Frustum, General, Layout, Orthographic, Symmetric};
use crate::math::{End, NonFinite, Real, Segment};
use wide::f64x2;

/// 2^-48: rounding, and the face's number in the last three bits.
pub(crate) const ROUNDING: f64 = 3.552713678800501e-15;

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
    let [p, q] = filter.values_in::<L>(&wide);
    if filter.may_be_lattice(wide.start)
        && accuracy == Accuracy::Fast
        && let Some(result) = lattice::clip(filter, segment, &p, &q)
    {
        counts.lattice += 1;
        return Ok(result);
    }
    match triage(filter, &p, &q) {
        Triage::Outside => Ok(outside()),
        Triage::Inside => Ok(pair::inside(segment)),
        Triage::Crossing => cross(frustum, segment, accuracy, counts, &p, &q),
        Triage::Unsure => super::clip(frustum, segment, accuracy, counts, |s| span(s)),
    }
}

/// Clips what certainly has ends on both sides of some faces. Out of line, so
/// that the early outs carry nothing of it.
#[inline(never)]
fn cross<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    p: &Values,
    q: &Values,
) -> Result<SegmentClip<T>, NonFinite> {
    let filter = frustum.filter();
    let thresholds = filter.crossing_thresholds(p.size + q.size);
    match certify(&p.pairs, &q.pairs, thresholds) {
        Certificate::Outside => return Ok(outside()),
        Certificate::Cross(crossing) if accuracy == Accuracy::Fast => {
            return Ok(fast(filter, &segment.to_f64(), &crossing));
        }
        Certificate::Cross(crossing) => {
            let mut staged = Staged::with(frustum, segment.to_f64(), [*p, *q], false);
            let decision = crossing.decision();
            let result = points::build(&mut staged, segment, &decision, accuracy);
            staged.add_to(counts);
            return Ok(result);
        }
        Certificate::None => {}
    }
    super::clip(frustum, segment, accuracy, counts, |s| span(s))
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
    let (depth, side) = filter.crossing_thresholds(size);
    let (depth, side) = (f64x2::splat(depth), f64x2::splat(side));
    let (a, b) = (&p.pairs, &q.pairs);
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
        let clipped = pair::flags(self.clipped);
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

/// Constructs both ends of a certain crossing.
#[inline(always)]
fn fast<T: Real>(filter: &Filter, wide: &Segment<f64>, crossing: &Crossing) -> SegmentClip<T> {
    let Crossing { faces, clipped } = *crossing;
    let a = filter.precise.magnitudes(Pair, faces, [wide.start; 2]);
    let b = filter.precise.magnitudes(Pair, faces, [wide.end; 2]);
    let ends = Ends {
        crossing: clipped,
        end: f64x2::new([0.0, f64::from_bits(u64::MAX)]),
    };
    let points = pair::construct::<false>(filter, wide, faces, [a, b], &ends);
    let clipped = pair::flags(clipped);
    let set = |i: usize| FaceSet::from_bits(u8::from(clipped[i]) << faces[i]);
    pair::assemble(
        Class::Cross,
        &points,
        clipped,
        [set(0), set(1)],
        FaceSet::EMPTY,
    )
}

/// The control flow on exact predicates: the parameter interval in TV (near,
/// far, left, right), then, if there is one, what TW takes off it (bottom, top;
/// near and far are shared).
pub(crate) fn span(p: &mut impl Predicates) -> Option<Span> {
    let in_tw = |face: &&Face| matches!(face, Face::Bottom | Face::Top);
    let faces = p.faces();
    let mut span = Span::default();
    for &face in faces.iter().filter(|face| !in_tw(face)) {
        narrow(&mut span, p, face)?;
    }
    span = span.unless_empty(p)?;
    for &face in faces.iter().filter(in_tw) {
        narrow(&mut span, p, face)?;
    }
    span.unless_empty(p)
}

/// What one face takes off a span; `None` if all of it.
fn narrow(span: &mut Span, p: &mut impl Predicates, face: Face) -> Option<()> {
    match p.role(face) {
        Role::Outside => return None,
        Role::Enter => span.enter(p, face),
        Role::Leave => span.leave(p, face),
        Role::Inside => {}
    }
    Some(())
}
