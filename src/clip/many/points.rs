//! The ends of four segments with certain crossings, by the rule of
//! `clip/exact/points.rs`; compare `clip/exact/pair.rs`.

use super::lanes::{Quad, ends};
use super::queue::Crossed;
use crate::clip::rules::site::{Places, Site, Step, end_is_smaller, is_from_end};
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
        let places = |exit| {
            let site = site(quad, filter, crossed, &ends, exit);
            let faces = crossed.map(|c| c.face(exit));
            Ends::new(site.places(p, q, |z| depths(quad, filter, faces, z)))
        };
        Parts {
            entries: places(false),
            exits: places(true),
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
    #[inline(always)]
    pub(super) fn new<S: Simd>(places: Places<f64x4<S>>) -> Self {
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
    [starts, finishes]: &[[Vec3<f64>; 4]; 2],
    exit: bool,
) -> Site<f64x4<S>> {
    let faces = crossed.map(|c| c.face(exit));
    let a = filter.precise.magnitudes(quad, faces, *starts);
    let b = filter.precise.magnitudes(quad, faces, *finishes);
    let from_end = is_from_end::<false, _>(a, b, || quad.mask(smaller(starts, finishes)));
    Site {
        step: Step::new(a, b, from_end),
        crossing: quad.mask(crossed.map(|c| c.clipped(exit))),
        end: quad.mask([exit; 4]),
    }
}

/// `z`, or the exact depth of the near or far face that was hit.
#[inline(always)]
pub(super) fn depths<S: Simd>(
    quad: Quad<S>,
    filter: &Filter,
    faces: [usize; 4],
    z: f64x4<S>,
) -> f64x4<S> {
    match filter.precise.levels(faces) {
        Some((level, at)) => quad.mask(level).select(quad.lanes(at), z),
        None => z,
    }
}

/// Where the end is lexicographically smaller than the start.
#[cold]
fn smaller(starts: &[Vec3<f64>; 4], finishes: &[Vec3<f64>; 4]) -> [bool; 4] {
    [0, 1, 2, 3].map(|j: usize| end_is_smaller(starts[j], finishes[j]))
}
