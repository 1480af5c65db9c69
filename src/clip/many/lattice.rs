//! Four segments on the lattice, where floating point makes no error: the steps of
//! `clip/exact/lattice.rs`, where the reasons are. The clips of segments of zero length mean
//! nothing.

use super::certified::Values;
use super::lanes::Quad;
use super::points::Ends;
use crate::clip::exact::lattice::LatticeCrossing;
use crate::clip::rules::site::{NearerEnd, Site, Step, end_is_smaller};
use crate::clip::whole::class;
use crate::clip::{Part, SegmentClip};
use crate::frustum::FaceSet;
use crate::frustum::eval::filter::Filter;
use crate::math::{Real, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{f64x4, mask64x4, u64x4};

/// Four clips.
pub(super) struct Clips {
    entries: Ends,
    exits: Ends,
    /// Sets of faces at entry and exit, and of coplanar ones.
    sets: [[u64; 4]; 3],
    /// Bits by segment.
    clipped: [u64; 2],
    touch: u64,
    /// Segments that are outside.
    pub(super) outside: u64,
    /// Segments of zero length.
    pub(super) still: u64,
}

/// Where four segments cross the faces.
struct Crossings<S: Simd> {
    enter: [f64x4<S>; 6],
    leave: [f64x4<S>; 6],
    /// The parts' parameters.
    t: [f64x4<S>; 2],
    still: mask64x4<S>,
}

impl<S: Simd> Crossings<S> {
    #[inline(always)]
    fn new(quad: Quad<S>, values: &Values<S>) -> Self {
        let (zero, one) = (quad.splat(0.0), quad.splat(1.0));
        let mut found = Crossings {
            enter: [zero; 6],
            leave: [one; 6],
            t: [zero, one],
            still: zero.simd_eq(zero),
        };
        for i in 0..6 {
            let face = LatticeCrossing::new(values.a[i], values.b[i]);
            found.still &= face.is_level;
            found.enter[i] = face.enter;
            found.leave[i] = face.leave;
            found.t[0] = found.t[0].max(face.enter);
            found.t[1] = found.t[1].min(face.leave);
        }
        found
    }
}

/// Sets of faces as bits, and the magnitudes of the values of each set's first face.
struct First<S: Simd> {
    set: u64x4<S>,
    a: f64x4<S>,
    b: f64x4<S>,
}

impl<S: Simd> First<S> {
    #[inline(always)]
    fn new(quad: Quad<S>) -> Self {
        let zero = quad.splat(0.0);
        First {
            set: zero.to_bits(),
            a: zero,
            b: zero,
        }
    }

    /// Faces are added from the last to the first.
    #[inline(always)]
    fn add(&mut self, i: usize, on: mask64x4<S>, values: &Values<S>) {
        self.set = on.select(self.set | 1 << i, self.set);
        self.a = on.select(values.a[i].abs(), self.a);
        self.b = on.select(values.b[i].abs(), self.b);
    }

    /// The parts' ends at t, with the faces crossed there.
    #[inline(always)]
    fn site(&self, t: f64x4<S>, end_is_smaller: mask64x4<S>) -> ([usize; 4], Site<f64x4<S>>) {
        let sets: [u64; 4] = self.set.into();
        let from_end = NearerEnd::new(self.a, self.b).with_ties(end_is_smaller);
        // A touch at an end of the segment is twice that end.
        let end = t.simd_eq(1.0);
        let site = Site {
            step: Step::new(self.a, self.b, from_end),
            crossing: t.simd_gt(0.0) & !end,
            end,
        };
        // Any index where there is none.
        (sets.map(|set| (set.trailing_zeros() as usize).min(5)), site)
    }
}

impl Clips {
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        quad: Quad<S>,
        filter: &Filter,
        values: &Values<S>,
        p: Vec3<f64x4<S>>,
        q: Vec3<f64x4<S>>,
    ) -> Self {
        let found = Crossings::new(quad, values);
        let [t0, t1] = found.t;
        let touch = t0.simd_eq(t1);
        let (mut entry, mut exit) = (First::new(quad), First::new(quad));
        let mut coplanar = First::new(quad);
        let (mut least_a, mut least_b) = (values.a[0], values.b[0]);
        let mut greatest = least_a.max(least_b);
        for i in (0..6).rev() {
            let (a, b) = (values.a[i], values.b[i]);
            let entered = found.enter[i].simd_ge(t0);
            let left = found.leave[i].simd_le(t1);
            entry.add(i, entered | (touch & left), values);
            exit.add(i, left | (touch & entered), values);
            coplanar.add(i, a.simd_eq(0.0) & b.simd_eq(0.0), values);
            least_a = least_a.min(a);
            least_b = least_b.min(b);
            greatest = greatest.min(a.max(b));
        }
        let smaller = end_is_smaller(p, q);
        let (entry_faces, entries) = entry.site(t0, smaller);
        let (exit_faces, exits) = exit.site(t1, smaller);
        Clips {
            entries: Ends::new(quad, filter, entry_faces, &entries, p, q),
            exits: Ends::new(quad, filter, exit_faces, &exits, p, q),
            sets: [entry.set.into(), exit.set.into(), coplanar.set.into()],
            clipped: [
                least_a.simd_lt(0.0).to_bitmask(),
                least_b.simd_lt(0.0).to_bitmask(),
            ],
            touch: touch.to_bitmask(),
            outside: (greatest.simd_lt(0.0) | t0.simd_gt(t1)).to_bitmask(),
            still: found.still.to_bitmask(),
        }
    }

    /// Clip j, of a segment that has a length and is not outside.
    #[inline(always)]
    pub(super) fn clip<T: Real>(&self, j: usize) -> SegmentClip<T> {
        let bit = |bits: u64| bits >> j & 1 != 0;
        let [entry, exit, coplanar] = self.sets.map(|set| FaceSet::from_bits(set[j] as u8));
        let clipped = self.clipped.map(bit);
        let class = class(
            bit(self.touch),
            !coplanar.is_empty(),
            clipped[0] | clipped[1],
        );
        SegmentClip {
            class,
            part: Some(Part {
                entry: self.entries.end(j, clipped[0], entry.union(coplanar)),
                exit: self.exits.end(j, clipped[1], exit.union(coplanar)),
                coplanar,
            }),
        }
    }
}
