//! The ends of four segments with certain crossings, by the rule of
//! `clip/exact/points.rs`; compare `clip/exact/pair.rs`.

use super::lanes::{Quad, ends};
use super::queue::Crossed;
use crate::clip::{Class, Part, PartEnd, SegmentClip};
use crate::exact::float::Width;
use crate::frustum::FaceSet;
use crate::frustum::filter::Filter;
use crate::math::{Real, Segment, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{f64x4, mask64x4};

/// Parameters and points of one end of four parts.
struct Ends {
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
        Parts {
            entries: part_ends::<S, false>(quad, filter, crossed, &ends),
            exits: part_ends::<S, true>(quad, filter, crossed, &ends),
        }
    }

    /// The clip of segment j.
    #[inline(always)]
    pub(super) fn clip<T: Real>(&self, crossed: Crossed, j: usize) -> SegmentClip<T> {
        SegmentClip {
            class: Class::Cross,
            part: Some(Part {
                entry: assemble::<T, false>(&self.entries, crossed, j),
                exit: assemble::<T, true>(&self.exits, crossed, j),
                coplanar: FaceSet::EMPTY,
            }),
        }
    }
}

#[inline(always)]
fn assemble<T: Real, const EXIT: bool>(ends: &Ends, crossed: Crossed, j: usize) -> PartEnd<T> {
    let clipped = crossed.clipped(EXIT);
    PartEnd {
        t: T::from_f64(ends.t[j]),
        point: Vec3::new(
            T::from_f64(ends.x[j]),
            T::from_f64(ends.y[j]),
            T::from_f64(ends.z[j]),
        ),
        clipped,
        faces: FaceSet::from_bits(u8::from(clipped) << crossed.face(EXIT)),
        inward: !clipped,
    }
}

/// How the points of four crossings are made.
struct Step<S: Simd> {
    /// Where a crossing is nearer to the end than to the start.
    from_end: mask64x4<S>,
    /// The way from there, against the segment's direction from the end.
    signed: f64x4<S>,
    clipped: mask64x4<S>,
}

impl<S: Simd> Step<S> {
    /// Adding zero: the sign of a zero must not depend on the order of the ends.
    #[inline(always)]
    fn crossed(&self, p: f64x4<S>, q: f64x4<S>) -> f64x4<S> {
        self.from_end.select(q, p) + self.signed * (q - p) + 0.0
    }

    /// A crossing's coordinate, else that of the segment's own end.
    #[inline(always)]
    fn select<const EXIT: bool>(&self, v: f64x4<S>, p: f64x4<S>, q: f64x4<S>) -> [f64; 4] {
        self.clipped.select(v, if EXIT { q } else { p }).into()
    }
}

/// Entries, or exits.
#[inline(always)]
fn part_ends<S: Simd, const EXIT: bool>(
    quad: Quad<S>,
    filter: &Filter,
    crossed: [Crossed; 4],
    [starts, finishes]: &[[Vec3<f64>; 4]; 2],
) -> Ends {
    let faces = crossed.map(|c| c.face(EXIT));
    let clipped = quad.mask(crossed.map(|c| c.clipped(EXIT)));
    let a = filter.precise.magnitudes(quad, faces, *starts);
    let b = filter.precise.magnitudes(quad, faces, *finishes);
    let (p, q) = (quad.points(*starts), quad.points(*finishes));
    let mut from_end = b.simd_lt(a);
    let ties = a.simd_eq(b);
    if ties.any_true() {
        from_end |= ties & quad.mask(lesser(starts, finishes));
    }
    let (zero, one) = (quad.all(0.0), quad.all(1.0));
    let tau = a.min(b) / (a + b);
    let t = from_end.select(one - tau, tau);
    let step = Step {
        from_end,
        signed: from_end.select(-tau, tau),
        clipped,
    };
    let mut z = step.crossed(p.z, q.z);
    if let Some((level, at)) = filter.precise.levels(faces) {
        z = quad.mask(level).select(quad.lanes(at), z);
    }
    Ends {
        t: step.select::<EXIT>(t, zero, one),
        x: step.select::<EXIT>(step.crossed(p.x, q.x), p.x, q.x),
        y: step.select::<EXIT>(step.crossed(p.y, q.y), p.y, q.y),
        z: step.select::<EXIT>(z, p.z, q.z),
    }
}

/// Where the end is lexicographically smaller than the start.
#[cold]
fn lesser(starts: &[Vec3<f64>; 4], finishes: &[Vec3<f64>; 4]) -> [bool; 4] {
    [0, 1, 2, 3].map(|j: usize| starts[j].to_array() > finishes[j].to_array())
}
