//! The ends of four segments with certain crossings, by the rule of
//! `clip/exact/points.rs`; compare `clip/exact/pair.rs`.

use super::lanes::{ends, lanes, points};
use super::queue::Crossed;
use crate::clip::{Class, Part, PartEnd, SegmentClip};
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

/// Clips four segments.
#[inline(always)]
pub(super) fn construct<S: Simd, T: Real>(
    simd: S,
    filter: &Filter,
    crossed: [Crossed; 4],
    segments: [&Segment<T>; 4],
) -> [SegmentClip<T>; 4] {
    let ends = ends(segments);
    let part = |exit: bool| {
        let faces = crossed.map(|c| c.face(exit));
        let clipped = crossed.map(|c| -i64::from(c.clipped(exit)));
        end(simd, filter, faces, clipped.simd_into(simd), &ends, exit)
    };
    let (entry, exit) = (part(false), part(true));
    std::array::from_fn(|j| SegmentClip {
        class: Class::Cross,
        part: Some(Part {
            entry: assemble(&entry, crossed[j], j, false),
            exit: assemble(&exit, crossed[j], j, true),
            coplanar: FaceSet::EMPTY,
        }),
    })
}

#[inline(always)]
fn assemble<T: Real>(ends: &Ends, crossed: Crossed, j: usize, exit: bool) -> PartEnd<T> {
    let clipped = crossed.clipped(exit);
    PartEnd {
        t: T::from_f64(ends.t[j]),
        point: Vec3::new(
            T::from_f64(ends.x[j]),
            T::from_f64(ends.y[j]),
            T::from_f64(ends.z[j]),
        ),
        clipped,
        faces: FaceSet::from_bits(u8::from(clipped) << crossed.face(exit)),
        inward: !clipped,
    }
}

/// Entries, or exits: crossings with faces where `clipped`, else the segments' own
/// ends.
#[inline(always)]
fn end<S: Simd>(
    simd: S,
    filter: &Filter,
    faces: [usize; 4],
    clipped: mask64x4<S>,
    [starts, finishes]: &[[Vec3<f64>; 4]; 2],
    exit: bool,
) -> Ends {
    let all = |v: f64| -> f64x4<S> { v.simd_into(simd) };
    let a = filter.precise.magnitudes(lanes(simd), faces, *starts);
    let b = filter.precise.magnitudes(lanes(simd), faces, *finishes);
    let (p, q) = (points(simd, *starts), points(simd, *finishes));
    let mut from_end = b.simd_lt(a);
    let ties = a.simd_eq(b);
    if ties.any_true() {
        from_end |= ties & lesser(simd, starts, finishes);
    }
    let tau = a.min(b) / (a + b);
    let t = from_end.select(all(1.0) - tau, tau);
    let signed = from_end.select(-tau, tau);
    // Adding zero: the sign of a zero must not depend on the order of the ends.
    let crossed = |p: f64x4<S>, q: f64x4<S>| from_end.select(q, p) + signed * (q - p) + 0.0;
    let own = |p, q| if exit { q } else { p };
    let select = |v: f64x4<S>, p, q| -> [f64; 4] { clipped.select(v, own(p, q)).into() };
    let mut z = crossed(p.z, q.z);
    if let Some((level, at)) = filter.precise.levels(faces) {
        let level: mask64x4<S> = level.map(|l| -i64::from(l)).simd_into(simd);
        z = level.select(at.simd_into(simd), z);
    }
    Ends {
        t: select(t, all(0.0), all(1.0)),
        x: select(crossed(p.x, q.x), p.x, q.x),
        y: select(crossed(p.y, q.y), p.y, q.y),
        z: select(z, p.z, q.z),
    }
}

/// Where the end is lexicographically smaller than the start.
#[cold]
fn lesser<S: Simd>(simd: S, starts: &[Vec3<f64>; 4], finishes: &[Vec3<f64>; 4]) -> mask64x4<S> {
    let lesser = |j: usize| -i64::from(starts[j].to_array() > finishes[j].to_array());
    [0, 1, 2, 3].map(lesser).simd_into(simd)
}
