//! Exact V/W: the plain algorithm with certificates.
//!
//! ```text
//! values of TV and TW at both ends, as in the plain tier, and one threshold
//! triage       outside, inside, or all signs certain (`clip/rules/triage.rs`)
//! certificate  for what crosses faces, by rounded parameters (`clip/rules/certificate.rs`)
//! exact        the rest
//! ```
//!
//! The rest goes through the same predicates as every other algorithm, and the points are
//! constructed by the same rule, so that the result does not depend on which way was taken. The
//! values are passed along.
//!
//! A register holds two faces here, so that extremes are combined across its two lanes at the end;
//! four segments a register (`clip/many/certified.rs`) need no such step.

use super::decide::{At, Decision};
use super::pair;
use super::staged::Staged;
use super::{lattice, points};
use crate::clip::predicates::{Predicates, Role, Span};
use crate::clip::rules::certificate::{
    ENTRIES_ABOVE, EXITS_ABOVE, FaceCrossing, Latest, error_of_two, error_of_values,
};
use crate::clip::rules::triage::{Extremes, Signs};
use crate::clip::whole::{inside, outside};
use crate::clip::{Accuracy, Class, SegmentClip, StageCounts};
use crate::exact::float::Pair;
use crate::frustum::eval::filter::{Filter, Values};
use crate::frustum::{Face, FaceSet, Form, Frustum, General, Layout, Orthographic, Symmetric};
use crate::math::{End, NonFinite, Real, Segment};
use wide::f64x2;

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
    let values = filter.values_in::<L>(&wide);
    let [p, q] = &values;
    if filter.may_be_lattice(wide.start)
        && accuracy == Accuracy::Fast
        && let Some(result) = lattice::clip(filter, segment, p, q)
    {
        counts.lattice += 1;
        return Ok(result);
    }
    match triage(filter, p, q) {
        Verdict::Outside => Ok(outside()),
        Verdict::Inside => Ok(inside(segment)),
        Verdict::Crossing => cross(frustum, segment, accuracy, counts, &values),
        Verdict::Uncertain => exactly(frustum, segment, accuracy, counts, &values),
    }
}

/// Clips by exact predicates, from the values that proved too little. Out of line, so that the
/// early outs carry nothing of it.
#[inline(never)]
fn exactly<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    values: &[Values; 2],
) -> Result<SegmentClip<T>, NonFinite> {
    segment.check_finite()?;
    let wide = segment.to_f64();
    let [p, q] = values;
    // With `Fast` it would have been clipped on the lattice.
    let lattice = accuracy != Accuracy::Fast && frustum.filter().on_lattice(&wide, p, q);
    let staged = Staged::with(frustum, wide, *values, lattice);
    Ok(super::clip_staged(staged, segment, accuracy, counts, |s| {
        span(s)
    }))
}

/// Clips what certainly has ends on both sides of some faces. Out of line, so
/// that the early outs carry nothing of it.
#[inline(never)]
fn cross<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    values: &[Values; 2],
) -> Result<SegmentClip<T>, NonFinite> {
    let filter = frustum.filter();
    let [p, q] = values;
    let thresholds = filter.crossing_thresholds(p.size + q.size);
    match certify(&p.pairs, &q.pairs, thresholds) {
        Certificate::Outside => return Ok(outside()),
        Certificate::Cross(crossing) if accuracy == Accuracy::Fast => {
            return Ok(fast(filter, &segment.to_f64(), &crossing));
        }
        Certificate::Cross(crossing) => {
            let mut staged = Staged::with(frustum, segment.to_f64(), *values, false);
            let decision = crossing.decision();
            let result = points::build(&mut staged, segment, &decision, accuracy);
            staged.add_to(counts);
            return Ok(result);
        }
        Certificate::Uncertain => {}
    }
    exactly(frustum, segment, accuracy, counts, values)
}

/// What the rounded values' signs prove.
enum Verdict {
    Outside,
    Inside,
    /// All signs are certain; some face is crossed.
    Crossing,
    Uncertain,
}

#[inline(always)]
fn triage(filter: &Filter, p: &Values, q: &Values) -> Verdict {
    let size = p.size + q.size;
    if !filter.covers(size) {
        return Verdict::Uncertain;
    }
    let (depth, side) = filter.crossing_thresholds(size);
    let thresholds = (f64x2::splat(depth), f64x2::splat(side));
    let (a, b) = (&p.pairs, &q.pairs);
    let mut signs = Signs {
        depth: Extremes::new(a[0], b[0]),
        side: Extremes::new(a[1], b[1]),
    };
    signs.side.add(a[2], b[2]);
    if signs.outside(thresholds).any() {
        Verdict::Outside
    } else if signs.inside(thresholds).all() {
        Verdict::Inside
    } else if signs.certain(thresholds).all() {
        Verdict::Crossing
    } else {
        Verdict::Uncertain
    }
}

/// What rounded parameters prove.
enum Certificate {
    Outside,
    /// Crosses one face at each end that is clipped.
    Cross(Crossing),
    /// Nothing.
    Uncertain,
}

/// The indices of the faces crossed at entry and exit, and whether there is a crossing: without
/// one the index stands for nothing.
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

/// The greatest two of all lanes of `v`, in the first lanes, and of `w`, in the second ones.
#[inline(always)]
fn greatest_two(v: [f64x2; 3], w: [f64x2; 3]) -> Latest<f64x2> {
    let lanes = |[a, b, c]: [f64x2; 3]| {
        let mut latest = Latest::new(a, b);
        latest.add(c);
        latest
    };
    let (v, w) = (lanes(v), lanes(w));
    let [a, b] = f64x2::transpose([v.first, w.first]);
    let [c, d] = f64x2::transpose([v.second, w.second]);
    Latest {
        first: a.fast_max(b),
        second: a.fast_min(b).fast_max(c.fast_max(d)),
    }
}

/// For values of certain sign, some of them negative.
#[inline(always)]
fn certify(a: &[f64x2; 3], b: &[f64x2; 3], (depth, side): (f64, f64)) -> Certificate {
    let tag = |face: u64| f64x2::new([f64::from_bits(face), f64::from_bits(face + 1)]);
    let crossing = |i: usize| FaceCrossing::new(a[i], b[i], tag(2 * i as u64));
    let [c, d, e] = [crossing(0), crossing(1), crossing(2)];
    let thresholds = (f64x2::splat(depth), f64x2::splat(side));
    let error = error_of_values(thresholds, [c.scale, d.scale.fast_max(e.scale)]);
    let [v, w] = error.to_array();
    let error = error_of_two(if v > w { v } else { w });
    let latest = greatest_two([c.enter, d.enter, e.enter], [c.leave, d.leave, e.leave]);
    let [last_enter, minus_first_leave] = latest.first.to_array();
    let overlap = last_enter + minus_first_leave;
    if overlap > error {
        return Certificate::Outside;
    }
    let above = f64x2::new([ENTRIES_ABOVE, EXITS_ABOVE]);
    let (uncrossed, certain) = latest.alone(f64x2::splat(error), above);
    if certain.all() & (overlap < -error) {
        Certificate::Cross(Crossing {
            faces: [face_index(last_enter), face_index(minus_first_leave)],
            clipped: !uncrossed,
        })
    } else {
        Certificate::Uncertain
    }
}

/// The tag of a parameter.
#[inline(always)]
fn face_index(t: f64) -> usize {
    (t.to_bits() & 7) as usize
}

/// Constructs both ends of a certain crossing.
#[inline(always)]
fn fast<T: Real>(filter: &Filter, wide: &Segment<f64>, crossing: &Crossing) -> SegmentClip<T> {
    let Crossing { faces, clipped } = *crossing;
    let a = filter.precise.magnitudes(Pair, faces, [wide.start; 2]);
    let b = filter.precise.magnitudes(Pair, faces, [wide.end; 2]);
    let ends = pair::Ends {
        crossing: clipped,
        end: f64x2::new([0.0, f64::from_bits(u64::MAX)]),
    };
    let places = pair::construct::<false>(filter, wide, faces, [a, b], ends);
    let clipped = pair::flags(clipped);
    let set = |i: usize| FaceSet::from_bits(u8::from(clipped[i]) << faces[i]);
    pair::assemble(
        Class::Cross,
        &places,
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
