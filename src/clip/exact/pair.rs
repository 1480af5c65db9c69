//! Entry and exit side by side in the two lanes of a register.
//!
//! The same points, bit for bit, as one at a time in [`super::points`], whose
//! rule and error bound this follows. Where an end was not clipped its lane
//! computes something meaningless, and a select puts the segment's own end
//! there: which ends are clipped cannot be predicted. The parameters are in
//! order: certificates and the lattice prove gaps of more than rounding closes.

use crate::clip::{Class, Part, PartEnd, SegmentClip};
use crate::frustum::FaceSet;
use crate::frustum::eval::filter::Filter;
use crate::math::{Real, Segment, Vec3};
use wide::f64x2;

/// Parameters and coordinates of entry and exit.
pub(super) struct Pair {
    pub(super) t: f64x2,
    pub(super) x: f64x2,
    pub(super) y: f64x2,
    pub(super) z: f64x2,
}

/// What is at the two ends of the part, in lanes with all bits set or none.
pub(super) struct Ends {
    /// A crossing, not an end of the segment.
    pub(super) crossing: f64x2,
    /// Where it is not: the segment's end, not its start.
    pub(super) end: f64x2,
}

/// Both ends, from the numbers of the faces crossed there and the magnitudes
/// of their boundary values at start and end of the segment. `TIES`: equal
/// magnitudes are common.
#[inline(always)]
pub(super) fn construct<const TIES: bool>(
    filter: &Filter,
    segment: &Segment<f64>,
    faces: [usize; 2],
    [a, b]: [f64x2; 2],
    ends: &Ends,
) -> Pair {
    let Segment { start, end } = *segment;
    let all = f64x2::splat;
    let mut from_end = b.simd_lt(a);
    let ties = a.simd_eq(b);
    if TIES {
        from_end = ties.bitselect(lesser(segment), from_end);
    } else if ties.any() {
        from_end = ties.bitselect(cold_lesser(segment), from_end);
    }
    let tau = a.fast_min(b) / (a + b);
    let t = from_end.bitselect(all(1.0) - tau, tau);
    let signed = from_end.bitselect(-tau, tau);
    // Adding zero: the sign of a zero must not depend on the order of the ends.
    let crossed =
        |p: f64, q: f64| from_end.bitselect(all(q), all(p)) + signed * all(q - p) + all(0.0);
    let select = |v: f64x2, p: f64, q: f64| {
        let own = ends.end.bitselect(all(q), all(p));
        ends.crossing.bitselect(v, own)
    };
    let z = filter.precise.z_or_exact(faces, crossed(start.z, end.z));
    Pair {
        t: select(t, 0.0, 1.0),
        x: select(crossed(start.x, end.x), start.x, end.x),
        y: select(crossed(start.y, end.y), start.y, end.y),
        z: select(z, start.z, end.z),
    }
}

/// All bits set if the end is lexicographically smaller than the start. No
/// branches: where ties are common, they are not of one kind.
#[inline(always)]
fn lesser(segment: &Segment<f64>) -> f64x2 {
    let Segment { start: p, end: q } = segment;
    let end = (p.x > q.x) | ((p.x == q.x) & ((p.y > q.y) | ((p.y == q.y) & (p.z > q.z))));
    f64x2::splat(f64::from_bits(u64::from(end).wrapping_neg()))
}

#[cold]
fn cold_lesser(segment: &Segment<f64>) -> f64x2 {
    lesser(segment)
}

/// A mask as flags.
#[inline(always)]
pub(super) fn flags(mask: f64x2) -> [bool; 2] {
    let bits = mask.to_bitmask();
    [bits & 1 != 0, bits & 2 != 0]
}

/// The result with these ends, rounded to the segment's type.
#[inline(always)]
pub(super) fn assemble<T: Real>(
    class: Class,
    points: &Pair,
    clipped: [bool; 2],
    faces: [FaceSet; 2],
    coplanar: FaceSet,
) -> SegmentClip<T> {
    let lanes = |v: f64x2| {
        let [a, b] = v.to_array();
        [T::from_f64(a), T::from_f64(b)]
    };
    let (t, x, y, z) = (
        lanes(points.t),
        lanes(points.x),
        lanes(points.y),
        lanes(points.z),
    );
    let end = |i: usize| PartEnd {
        t: t[i],
        point: Vec3::new(x[i], y[i], z[i]),
        clipped: clipped[i],
        faces: faces[i],
        inward: !clipped[i],
    };
    SegmentClip {
        class,
        part: Some(Part {
            entry: end(0),
            exit: end(1),
            coplanar,
        }),
    }
}

/// All of the segment, touching no face.
#[inline(always)]
pub(crate) fn inside<T: Real>(segment: &Segment<T>) -> SegmentClip<T> {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The same order as the one of arrays, which `points` goes by.
    #[test]
    fn the_lesser_end_is_the_lexicographically_smaller() {
        let point = |i: i32| Vec3::from([i % 3, i / 3 % 3, i / 9].map(f64::from));
        for (i, j) in (0..27).flat_map(|i| (0..27).map(move |j| (i, j))) {
            let segment = Segment::new(point(i), point(j));
            let end = segment.start.to_array() > segment.end.to_array();
            let expected = if end { 0b11 } else { 0 };
            assert_eq!(lesser(&segment).to_bitmask(), expected, "{segment:?}");
        }
    }
}
