//! Entry and exit side by side in the two lanes of a register.
//!
//! The same points, bit for bit, as one at a time in [`super::points`], whose
//! rule and error bound this follows. Where an end was not clipped its lane
//! computes something meaningless, and a select puts the segment's own end
//! there: which ends are clipped cannot be predicted. The parameters are in
//! order: certificates and the lattice prove gaps of more than rounding closes.

use crate::clip::{Class, Part, PartEnd, SegmentClip};
use crate::frustum::FaceSet;
use crate::frustum::filter::Filter;
use crate::math::{Real, Segment, Vec3};
use wide::f64x2;

/// Parameters and coordinates of entry and exit.
pub(super) struct Pair {
    pub(super) t: f64x2,
    pub(super) x: f64x2,
    pub(super) y: f64x2,
    pub(super) z: f64x2,
}

impl Pair {
    /// One lane in both.
    #[inline(always)]
    pub(super) fn of_lane(&self, lane: usize) -> Self {
        let both = |v: f64x2| f64x2::splat(v.to_array()[lane]);
        Pair {
            t: both(self.t),
            x: both(self.x),
            y: both(self.y),
            z: both(self.z),
        }
    }
}

/// Both ends, from the numbers of the faces crossed there and the magnitudes
/// of their boundary values at start and end of the segment. `clipped` has all
/// bits set in the lane of an end that is not the segment's own.
#[inline(always)]
pub(super) fn construct(
    filter: &Filter,
    segment: &Segment<f64>,
    faces: [usize; 2],
    [a, b]: [f64x2; 2],
    clipped: f64x2,
) -> Pair {
    let Segment { start, end } = *segment;
    let all = f64x2::splat;
    let mut from_end = b.simd_lt(a);
    let ties = a.simd_eq(b);
    if ties.any() {
        from_end = ties.bitselect(lesser(segment), from_end);
    }
    let tau = a.fast_min(b) / (a + b);
    let t = from_end.bitselect(all(1.0) - tau, tau);
    let signed = from_end.bitselect(-tau, tau);
    // Adding zero: the sign of a zero must not depend on the order of the ends.
    let crossed =
        |p: f64, q: f64| from_end.bitselect(all(q), all(p)) + signed * all(q - p) + all(0.0);
    let select = |v: f64x2, p: f64, q: f64| clipped.bitselect(v, f64x2::new([p, q]));
    let z = filter.precise.exact_depth(faces, crossed(start.z, end.z));
    Pair {
        t: select(t, 0.0, 1.0),
        x: select(crossed(start.x, end.x), start.x, end.x),
        y: select(crossed(start.y, end.y), start.y, end.y),
        z: select(z, start.z, end.z),
    }
}

/// All bits set if the end is lexicographically smaller than the start.
#[cold]
fn lesser(segment: &Segment<f64>) -> f64x2 {
    let end = segment.start.to_array() > segment.end.to_array();
    f64x2::splat(f64::from_bits(if end { u64::MAX } else { 0 }))
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
pub(super) fn inside<T: Real>(segment: &Segment<T>) -> SegmentClip<T> {
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
