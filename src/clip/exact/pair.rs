//! Entry and exit side by side in the two lanes of a register.
//!
//! The same points, bit for bit, as one at a time in [`super::points`], whose
//! error bound this follows. The parameters are in
//! order: certificates and the lattice prove that the gap is larger than rounding errors.

use crate::clip::rules::site::{NearerEnd, Places, Site, Step, end_is_smaller};
use crate::clip::{Class, Part, PartEnd, SegmentClip};
use crate::frustum::FaceSet;
use crate::frustum::eval::filter::Filter;
use crate::math::{Real, Segment, Vec3};
use wide::f64x2;

/// The kinds of the part's two ends, in lanes with all bits set or none.
pub(super) struct Ends {
    /// A crossing, not an end of the segment.
    pub(super) crossing: f64x2,
    /// Where it is not: the segment's end, not its start.
    pub(super) end: f64x2,
}

/// Both ends, from the indices of the faces crossed there and the magnitudes
/// of their boundary values at start and end of the segment. `TIES`: equal
/// magnitudes are common.
#[inline(always)]
pub(super) fn construct<const TIES: bool>(
    filter: &Filter,
    segment: &Segment<f64>,
    faces: [usize; 2],
    [a, b]: [f64x2; 2],
    ends: Ends,
) -> Places<f64x2> {
    let nearer = NearerEnd::new(a, b);
    let from_end = if TIES {
        nearer.with_ties(smaller(segment))
    } else if nearer.has_ties() {
        nearer.with_ties(cold_smaller(segment))
    } else {
        nearer.without_ties()
    };
    let site = Site {
        step: Step::new(a, b, from_end),
        crossing: ends.crossing,
        end: ends.end,
    };
    let [p, q] = [segment.start, segment.end]
        .map(|p| Vec3::new(f64x2::splat(p.x), f64x2::splat(p.y), f64x2::splat(p.z)));
    let z = site.step.coordinate(p.z, q.z);
    site.places(p, q, filter.precise.z_or_exact(faces, z))
}

/// All bits set if the end is lexicographically smaller than the start.
#[inline(always)]
fn smaller(segment: &Segment<f64>) -> f64x2 {
    let end = end_is_smaller(segment.start, segment.end);
    f64x2::splat(f64::from_bits(u64::from(end).wrapping_neg()))
}

#[cold]
fn cold_smaller(segment: &Segment<f64>) -> f64x2 {
    smaller(segment)
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
    places: &Places<f64x2>,
    clipped: [bool; 2],
    faces: [FaceSet; 2],
    coplanar: FaceSet,
) -> SegmentClip<T> {
    let lanes = |v: f64x2| {
        let [a, b] = v.to_array();
        [T::from_f64(a), T::from_f64(b)]
    };
    let (t, x, y, z) = (
        lanes(places.t),
        lanes(places.x),
        lanes(places.y),
        lanes(places.z),
    );
    let end = |i: usize| {
        let point = Vec3::new(x[i], y[i], z[i]);
        PartEnd::fast(t[i], point, clipped[i], faces[i])
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

#[cfg(test)]
mod tests {
    use super::*;

    /// In the order of arrays.
    #[test]
    fn the_smaller_end_is_lexicographically_smaller() {
        let point = |i: i32| Vec3::from([i % 3, i / 3 % 3, i / 9].map(f64::from));
        for (i, j) in (0..27).flat_map(|i| (0..27).map(move |j| (i, j))) {
            let segment = Segment::new(point(i), point(j));
            let end = segment.start.to_array() > segment.end.to_array();
            let expected = if end { 0b11 } else { 0 };
            assert_eq!(smaller(&segment).to_bitmask(), expected, "{segment:?}");
        }
    }
}
