//! V/W where floating point makes no error: the coordinates and the frustum's constants are on a
//! coarse grid.
//!
//! Values have at most 25 bits ([`Filter`] ensures it), so they and their
//! differences are exact. Two crossing parameters that differ do so by more
//! than 2^-52, and each quotient is rounded by at most 2^-54: rounded
//! parameters are in the order of the exact ones, and equal where they are. So
//! the plain algorithm decides exactly, touches included, at its own speed.
//! Grid-aligned models in grid-aligned boxes are all of this kind.

use super::pair::{self, Ends};
use crate::clip::SegmentClip;
use crate::clip::rules::compare::Compare;
use crate::clip::whole::{class, outside, point};
use crate::frustum::FaceSet;
use crate::frustum::eval::filter::{Filter, Values};
use crate::math::{Real, Segment};
use wide::f64x2;

/// A face's crossing.
pub(crate) struct LatticeCrossing<F: Compare> {
    /// The parameter if the face is entered, else -1.
    pub(crate) enter: F,
    /// The parameter if the face is left, else 2.
    pub(crate) leave: F,
    /// Whether the values at start and end are equal.
    pub(crate) is_level: F::Mask,
}

impl<F: Compare> LatticeCrossing<F> {
    /// From the values at start and end. The parameters of a face that is not crossed change
    /// nothing; so do those of equal values, whose quotient is NaN or infinite.
    #[inline(always)]
    pub(crate) fn new(a: F, b: F) -> Self {
        let zero = a.splat(0.0);
        let t = a / (a - b);
        let is_level = a.is_equal(b);
        Self {
            enter: F::select(zero.is_less(a) | is_level, a.splat(-1.0), t),
            leave: F::select(zero.is_less(b) | is_level, a.splat(2.0), t),
            is_level,
        }
    }
}

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
    let splat = f64x2::splat;
    let zero = splat(0.0);
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
    let crossings = [0, 1, 2].map(|i| LatticeCrossing::new(a[i], b[i]));
    let enter = crossings.each_ref().map(|c| c.enter);
    let leave = crossings.each_ref().map(|c| c.leave);
    let [c, d, e] = crossings.map(|c| c.is_level);
    let is_still = (c & d & e).all();
    // The unclipped interval, 0 to 1, stands beside both.
    let last = enter[0]
        .fast_max(enter[1])
        .fast_max(enter[2])
        .fast_max(zero);
    let first = leave[0]
        .fast_min(leave[1])
        .fast_min(leave[2])
        .fast_min(splat(1.0));
    let ([e, f], [l, m]) = (last.to_array(), first.to_array());
    let t0 = if e > f { e } else { f };
    let t1 = if l < m { l } else { m };
    if t0 > t1 {
        return Some(outside());
    }
    let at = [t0, t1];
    let on = |i: usize| a[i].simd_eq(zero) & b[i].simd_eq(zero);
    let entered = |i: usize| enter[i].simd_ge(splat(t0));
    let left = |i: usize| leave[i].simd_le(splat(t1));
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
    Some(if is_still {
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

/// Parameters of entry and exit, the faces crossed there, and whether the segment goes on.
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
    let class = class(touch, !coplanar.is_empty(), clipped[0] | clipped[1]);
    // The index of the first face crossed at each end; any index where there is none.
    let index = |i: usize| (faces[i].bits().trailing_zeros() as usize).min(5);
    let crossed = [index(0), index(1)];
    let [e, l] = crossed;
    let a = f64x2::new([p.of(e), p.of(l)]).abs();
    let b = f64x2::new([q.of(e), q.of(l)]).abs();
    // The segment's own ends are not constructed; a touch there is
    // twice the same end.
    let at = f64x2::new(at);
    let end = at.simd_eq(f64x2::splat(1.0));
    let ends = Ends {
        crossing: at.simd_gt(f64x2::splat(0.0)) & !end,
        end,
    };
    let places = pair::construct::<true>(filter, &segment.to_f64(), crossed, [a, b], ends);
    let sets = [faces[0].union(coplanar), faces[1].union(coplanar)];
    pair::assemble(class, &places, clipped, sets, coplanar)
}
