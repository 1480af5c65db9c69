//! The ends of four segments with certain crossings, by the rule of
//! `clip/rules/site.rs`: each end in a register. `clip/exact/pair.rs` has both ends in one.

use super::lanes::{Quad, ends};
use super::queue::Crossed;
use crate::clip::rules::site::{NearerEnd, Site, Step, end_is_smaller};
use crate::clip::{Class, Part, PartEnd, SegmentClip};
use crate::exact::float::Width;
use crate::frustum::FaceSet;
use crate::frustum::eval::filter::Filter;
use crate::math::{Real, Segment, Vec3};
use fearless_simd::f64x4;
use fearless_simd::prelude::*;

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
        let [p, q] = ends.map(|end| quad.points(end));
        let entry = crossed.map(|c| c.face(false));
        let exit = crossed.map(|c| c.face(true));
        let entries = site(quad, filter, crossed, entry, &ends, false);
        let exits = site(quad, filter, crossed, exit, &ends, true);
        Parts {
            entries: Ends::new(quad, filter, entry, &entries, p, q),
            exits: Ends::new(quad, filter, exit, &exits, p, q),
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
    /// At these sites, with the indices of the faces crossed there.
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        quad: Quad<S>,
        filter: &Filter,
        faces: [usize; 4],
        site: &Site<f64x4<S>>,
        p: Vec3<f64x4<S>>,
        q: Vec3<f64x4<S>>,
    ) -> Self {
        let mut z = site.step.coordinate(p.z, q.z);
        if let Some((exact_z, at)) = filter.precise.exact_z(faces) {
            z = quad.mask(exact_z).select(quad.lanes(at), z);
        }
        let places = site.places(p, q, z);
        Ends {
            t: places.t.into(),
            x: places.x.into(),
            y: places.y.into(),
            z: places.z.into(),
        }
    }

    /// The end of part j.
    #[inline(always)]
    pub(super) fn end<T: Real>(&self, j: usize, clipped: bool, faces: FaceSet) -> PartEnd<T> {
        let point = Vec3::new(
            T::from_f64(self.x[j]),
            T::from_f64(self.y[j]),
            T::from_f64(self.z[j]),
        );
        PartEnd::fast(T::from_f64(self.t[j]), point, clipped, faces)
    }
}

/// Where one end of four parts is.
#[inline(always)]
fn site<S: Simd>(
    quad: Quad<S>,
    filter: &Filter,
    crossed: [Crossed; 4],
    faces: [usize; 4],
    [starts, finishes]: &[[Vec3<f64>; 4]; 2],
    exit: bool,
) -> Site<f64x4<S>> {
    let a = filter.precise.magnitudes(quad, faces, *starts);
    let b = filter.precise.magnitudes(quad, faces, *finishes);
    let nearer = NearerEnd::new(a, b);
    let from_end = if nearer.has_ties() {
        nearer.with_ties(quad.mask(smaller(starts, finishes)))
    } else {
        nearer.without_ties()
    };
    Site {
        step: Step::new(a, b, from_end),
        crossing: quad.mask(crossed.map(|c| c.clipped(exit))),
        end: quad.mask([exit; 4]),
    }
}

/// Where the end is lexicographically smaller than the start.
#[cold]
fn smaller(starts: &[Vec3<f64>; 4], finishes: &[Vec3<f64>; 4]) -> [bool; 4] {
    [0, 1, 2, 3].map(|j: usize| end_is_smaller(starts[j], finishes[j]))
}
