//! The ends of four segments with certain crossings, by the rule of
//! `clip/exact/points.rs`; compare `clip/exact/pair.rs`.

use super::lanes::{Quad, ends};
use super::queue::Crossed;
use crate::clip::{Class, Part, PartEnd, SegmentClip};
use crate::exact::float::Width;
use crate::frustum::FaceSet;
use crate::frustum::eval::filter::Filter;
use crate::math::{Real, Segment, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{f64x4, mask64x4};

/// Parameters and points of one end of four parts.
pub(super) struct Ends {
    t: [f64; 4],
    x: [f64; 4],
    y: [f64; 4],
    z: [f64; 4],
}

/// Entries and exits of four segments.
pub(super) struct Parts {
    entries: Ends,
    exits: Ends,
}

impl Parts {
    #[inline(always)]
    pub(super) fn new<S: Simd, T: Real>(
        quad: Quad<S>,
        filter: &Filter,
        crossed: [Crossed; 4],
        segments: [&Segment<T>; 4],
    ) -> Self {
        let ends = ends(segments);
        let entries = Site::new(quad, filter, crossed, &ends, false);
        let exits = Site::new(quad, filter, crossed, &ends, true);
        let [p, q] = ends.map(|end| quad.points(end));
        Parts {
            entries: entries.points(quad, filter, p, q),
            exits: exits.points(quad, filter, p, q),
        }
    }

    /// The clip of segment j.
    #[inline(always)]
    pub(super) fn clip<T: Real>(&self, crossed: Crossed, j: usize) -> SegmentClip<T> {
        let [entry, exit] = [false, true].map(|exit| {
            let clipped = crossed.clipped(exit);
            let faces = FaceSet::from_bits(u8::from(clipped) << crossed.face(exit));
            (clipped, faces)
        });
        SegmentClip {
            class: Class::Cross,
            part: Some(Part {
                entry: self.entries.end(j, entry.0, entry.1),
                exit: self.exits.end(j, exit.0, exit.1),
                coplanar: FaceSet::EMPTY,
            }),
        }
    }
}

impl Ends {
    /// The end of part j.
    #[inline(always)]
    pub(super) fn end<T: Real>(&self, j: usize, clipped: bool, faces: FaceSet) -> PartEnd<T> {
        PartEnd {
            t: T::from_f64(self.t[j]),
            point: Vec3::new(
                T::from_f64(self.x[j]),
                T::from_f64(self.y[j]),
                T::from_f64(self.z[j]),
            ),
            clipped,
            faces,
            inward: !clipped,
        }
    }
}

/// Where one end of four parts is.
pub(super) struct Site<S: Simd> {
    /// The faces crossed there, by number, and the magnitudes of their values at the
    /// segments' starts and ends.
    pub(super) faces: [usize; 4],
    pub(super) a: f64x4<S>,
    pub(super) b: f64x4<S>,
    /// Where a crossing is reached from the segment's end.
    pub(super) from_end: mask64x4<S>,
    /// Where there is a crossing; elsewhere it is an end of the segment,
    pub(super) crossing: mask64x4<S>,
    /// which is its end, not its start, here.
    pub(super) end: mask64x4<S>,
}

impl<S: Simd> Site<S> {
    #[inline(always)]
    fn new(
        quad: Quad<S>,
        filter: &Filter,
        crossed: [Crossed; 4],
        [starts, finishes]: &[[Vec3<f64>; 4]; 2],
        exit: bool,
    ) -> Self {
        let faces = crossed.map(|c| c.face(exit));
        let a = filter.precise.magnitudes(quad, faces, *starts);
        let b = filter.precise.magnitudes(quad, faces, *finishes);
        let mut from_end = b.simd_lt(a);
        let ties = a.simd_eq(b);
        if ties.any_true() {
            from_end |= ties & quad.mask(lesser(starts, finishes));
        }
        Site {
            faces,
            a,
            b,
            from_end,
            crossing: quad.mask(crossed.map(|c| c.clipped(exit))),
            end: quad.mask([exit; 4]),
        }
    }

    /// Parameters and points.
    #[inline(always)]
    pub(super) fn points(
        &self,
        quad: Quad<S>,
        filter: &Filter,
        p: Vec3<f64x4<S>>,
        q: Vec3<f64x4<S>>,
    ) -> Ends {
        let (zero, one) = (quad.splat(0.0), quad.splat(1.0));
        let tau = self.a.min(self.b) / (self.a + self.b);
        let t = self.from_end.select(one - tau, tau);
        let signed = self.from_end.select(-tau, tau);
        let mut z = self.crossed(signed, p.z, q.z);
        if let Some((level, at)) = filter.precise.exact_z(self.faces) {
            z = quad.mask(level).select(quad.lanes(at), z);
        }
        Ends {
            t: self.select(t, zero, one),
            x: self.select(self.crossed(signed, p.x, q.x), p.x, q.x),
            y: self.select(self.crossed(signed, p.y, q.y), p.y, q.y),
            z: self.select(z, p.z, q.z),
        }
    }

    /// Adding zero: the sign of a zero must not depend on the order of the ends.
    #[inline(always)]
    fn crossed(&self, signed: f64x4<S>, p: f64x4<S>, q: f64x4<S>) -> f64x4<S> {
        self.from_end.select(q, p) + signed * (q - p) + 0.0
    }

    /// A crossing's number, else that of the segment's own end.
    #[inline(always)]
    fn select(&self, v: f64x4<S>, p: f64x4<S>, q: f64x4<S>) -> [f64; 4] {
        let own = self.end.select(q, p);
        self.crossing.select(v, own).into()
    }
}

/// Where the end is lexicographically smaller than the start.
#[cold]
fn lesser(starts: &[Vec3<f64>; 4], finishes: &[Vec3<f64>; 4]) -> [bool; 4] {
    [0, 1, 2, 3].map(|j: usize| starts[j].to_array() > finishes[j].to_array())
}
