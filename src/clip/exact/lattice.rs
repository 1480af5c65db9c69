//! V/W where floating point makes no error: coordinates on a coarse grid, and
//! a frustum whose numbers are.
//!
//! Values have at most 25 bits ([`Filter`] sees to that), so they and their
//! differences are exact. Two crossing parameters that differ do so by more
//! than 2^-52, and each quotient is rounded by at most 2^-54: rounded
//! parameters are in the order of the exact ones, and equal where they are. So
//! the plain algorithm decides exactly, also what touches, at its own speed.
//! Grid-aligned models against grid-aligned boxes are all of this kind.

use super::pair::{self, Ends};
use crate::clip::plain::outside;
use crate::clip::{Class, SegmentClip};
use crate::frustum::FaceSet;
use crate::frustum::eval::filter::{Filter, Values};
use crate::math::{Real, Segment};
use wide::f64x2;

/// Clips a segment, if it is on the lattice.
#[inline(never)]
pub(super) fn clip<T: Real>(
    filter: &Filter,
    segment: &Segment<T>,
    p: &Values,
    q: &Values,
) -> Option<SegmentClip<T>> {
    if !filter.on_lattice(&segment.to_f64(), p, q) {
        return None;
    }
    let all = f64x2::splat;
    let zero = all(0.0);
    let (a, b) = (&p.pairs, &q.pairs);
    let greater = |i: usize| a[i].fast_max(b[i]);
    if greater(0)
        .fast_min(greater(1))
        .fast_min(greater(2))
        .simd_lt(zero)
        .any()
    {
        return Some(outside());
    }
    let (mut enter, mut leave) = ([zero; 3], [zero; 3]);
    let mut still = zero.simd_eq(zero);
    for i in 0..3 {
        let t = a[i] / (a[i] - b[i]);
        // Faces that are not crossed stand where they change nothing; so do
        // those with two equal values, whose t is no number.
        let level = a[i].simd_eq(b[i]);
        still &= level;
        enter[i] = (a[i].simd_gt(zero) | level).bitselect(all(-1.0), t);
        leave[i] = (b[i].simd_gt(zero) | level).bitselect(all(2.0), t);
    }
    // The unclipped interval, 0 to 1, stands beside both.
    let last = enter[0]
        .fast_max(enter[1])
        .fast_max(enter[2])
        .fast_max(zero);
    let first = leave[0]
        .fast_min(leave[1])
        .fast_min(leave[2])
        .fast_min(all(1.0));
    let ([e, f], [l, m]) = (last.to_array(), first.to_array());
    let t0 = if e > f { e } else { f };
    let t1 = if l < m { l } else { m };
    if t0 > t1 {
        return Some(outside());
    }
    let at = [t0, t1];
    let on = |i: usize| a[i].simd_eq(zero) & b[i].simd_eq(zero);
    let entered = |i: usize| enter[i].simd_ge(all(t0));
    let left = |i: usize| leave[i].simd_le(all(t1));
    let (outside_a, outside_b) = (|i: usize| a[i].simd_lt(zero), |i: usize| b[i].simd_lt(zero));
    let any = |m: [f64x2; 3]| (m[0] | m[1] | m[2]).any();
    let clipped = [
        any([outside_a(0), outside_a(1), outside_a(2)]),
        any([outside_b(0), outside_b(1), outside_b(2)]),
    ];
    let faces = [
        set([entered(0), entered(1), entered(2)]),
        set([left(0), left(1), left(2)]),
    ];
    let coplanar = set([on(0), on(1), on(2)]);
    let found = Found {
        at,
        faces,
        coplanar,
        clipped,
    };
    // Equal values are those of equal points: they are exact.
    Some(if still.all() {
        point(segment, coplanar)
    } else {
        finish(filter, segment, [p, q], &found)
    })
}

/// The faces whose lanes are set.
#[inline(always)]
fn set(lanes: [f64x2; 3]) -> FaceSet {
    let bits = lanes[0].to_bitmask() | lanes[1].to_bitmask() << 2 | lanes[2].to_bitmask() << 4;
    FaceSet::from_bits((bits & 0x3f) as u8)
}

/// Parameters, the faces crossed there, and whether the segment goes on.
struct Found {
    at: [f64; 2],
    faces: [FaceSet; 2],
    coplanar: FaceSet,
    clipped: [bool; 2],
}

#[inline(always)]
fn finish<T: Real>(
    filter: &Filter,
    segment: &Segment<T>,
    [p, q]: [&Values; 2],
    found: &Found,
) -> SegmentClip<T> {
    let Found {
        at,
        faces,
        coplanar,
        clipped,
    } = *found;
    let touch = at[0] == at[1];
    let both = faces[0].union(faces[1]);
    let faces = if touch { [both, both] } else { faces };
    // A table, not branches: here all classes are common.
    let class = {
        use Class::{Boundary, Cross, Inside, Touch};
        let rows = [
            [Inside, Cross],
            [Boundary, Boundary],
            [Touch, Touch],
            [Touch, Touch],
        ];
        let row = usize::from(touch) << 1 | usize::from(!coplanar.is_empty());
        rows[row][usize::from(clipped[0] | clipped[1])]
    };
    // The first face crossed at each end; any number where there is none.
    let number = |i: usize| (faces[i].bits().trailing_zeros() as usize).min(5);
    let crossed = [number(0), number(1)];
    let [e, l] = crossed;
    let a = f64x2::new([p.of(e), p.of(l)]).abs();
    let b = f64x2::new([q.of(e), q.of(l)]).abs();
    // At the segment's own ends there is nothing to construct; a touch there is
    // twice the same end.
    let at = f64x2::new(at);
    let end = at.simd_eq(f64x2::splat(1.0));
    let ends = Ends {
        crossing: at.simd_gt(f64x2::splat(0.0)) & !end,
        end,
    };
    let points = pair::construct::<true>(filter, &segment.to_f64(), crossed, [a, b], &ends);
    let sets = [faces[0].union(coplanar), faces[1].union(coplanar)];
    pair::assemble(class, &points, clipped, sets, coplanar)
}

/// A segment of zero length in the frustum, on these faces.
#[cold]
fn point<T: Real>(segment: &Segment<T>, on: FaceSet) -> SegmentClip<T> {
    let mut result = pair::inside(segment);
    if !on.is_empty() {
        result.class = Class::Touch;
    }
    if let Some(part) = &mut result.part {
        part.entry.faces = on;
        part.exit.faces = on;
    }
    result
}
