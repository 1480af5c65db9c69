//! Where segments cross a face: the rule of `clip/exact/points.rs`, in registers.
//!
//! The rule takes magnitudes A and B of the face's values in double-double. Of singles that
//! precision is hardly ever needed: with the values of doubles, off by E at most, t is off by
//! `E / (A + B)` and some roundings; where both ends of that interval are the same
//! single, so is what the rule gives, which lies in it (Ziv's test). Of doubles nothing could
//! be said so: their ends wait in a queue of their face.

use super::crossings::Crossings;
use super::open::Open;
use super::queues::Queue;
use crate::exact::float::Lanes;
use crate::frustum::Frustum;
use crate::math::Real;
use crate::volume::Rows;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x4, i32x8};
use std::ops::Range;

/// What t is off beside its values' errors, and the rule's own error of 2.5 u, with some room:
/// 16 u.
const ROUNDINGS: f64 = 1.7763568394002505e-15;

/// Half spaces in doubles, to look one up for each lane.
pub(super) struct Faces {
    /// Each face's normal and offset.
    numbers: [[f64; 8]; 4],
    factor: f64,
    constant: f64,
}

impl Faces {
    pub(super) fn new(rows: &Rows<f64>) -> Self {
        let mut numbers = [[0.0; 8]; 4];
        for i in 0..6 {
            let ([x, y, z], offset) = rows.face(i);
            for (all, number) in numbers.iter_mut().zip([x, y, z, offset]) {
                all[i] = number;
            }
        }
        Self {
            numbers,
            factor: rows.factor,
            constant: rows.constant,
        }
    }
}

/// A register of segments' coordinates, and how their ends that are cut are found.
pub(super) trait Cut<S: Simd>: SimdFloat<S, Element: Real> {
    /// What is put off until all of a block is known.
    type PutOff: Default;

    /// The parameters of entry and exit, where they are cut, of those in these places, and which
    /// of them are found. Or they are put off, as certain as they are.
    fn cut(
        faces: &Faces,
        put_off: &mut Self::PutOff,
        present: Range<usize>,
        ends: [[Self; 3]; 2],
        found: &Crossings<S, Self>,
    ) -> ([Self; 2], Self::Mask);

    /// Finds what was put off.
    fn finish(
        simd: S,
        frustum: &Frustum,
        put_off: &mut Self::PutOff,
        open: &mut Open<Self::Element>,
    );
}

impl<S: Simd> Cut<S> for f32x8<S> {
    type PutOff = ();

    #[inline(always)]
    fn cut(
        faces: &Faces,
        (): &mut (),
        _: Range<usize>,
        [p, q]: [[Self; 3]; 2],
        found: &Crossings<S, Self>,
    ) -> ([Self; 2], Self::Mask) {
        let p = [p[0].widen(), p[1].widen(), p[2].widen()];
        let q = [q[0].widen(), q[1].widen(), q[2].widen()];
        let halves = [
            Half::new(faces, [p[0].0, p[1].0, p[2].0], [q[0].0, q[1].0, q[2].0]),
            Half::new(faces, [p[0].1, p[1].1, p[2].1], [q[0].1, q[1].1, q[2].1]),
        ];
        let (entry, entry_found) = crossing(faces, &halves, found.faces[0]);
        let (exit, exit_found) = crossing(faces, &halves, found.faces[1]);
        let all_found = (entry_found | !found.cut[0]) & (exit_found | !found.cut[1]);
        ([entry, exit], all_found)
    }

    #[inline(always)]
    fn finish(_: S, _: &Frustum, (): &mut (), _: &mut Open<f32>) {}
}

/// Half of a register of segments, in doubles.
struct Half<S: Simd> {
    ends: [[f64x4<S>; 3]; 2],
    /// What a value is off at most.
    error: f64x4<S>,
}

impl<S: Simd> Half<S> {
    #[inline(always)]
    fn new(faces: &Faces, p: [f64x4<S>; 3], q: [f64x4<S>; 3]) -> Self {
        let size = (Lanes::abs(p[0]) + Lanes::abs(p[1]) + Lanes::abs(p[2]))
            + (Lanes::abs(q[0]) + Lanes::abs(q[1]) + Lanes::abs(q[2]));
        Self {
            ends: [p, q],
            error: size.mul_add(faces.factor, size.all(faces.constant)),
        }
    }

    /// A face's parameter is between these.
    #[inline(always)]
    fn interval(&self, faces: &Faces, face: [usize; 4]) -> [f64x4<S>; 2] {
        let simd = self.error.token();
        let [x, y, z, offset] = [0, 1, 2, 3].map(
            #[inline(always)]
            |k| {
                let all = &faces.numbers[k];
                f64x4::simd_from(
                    simd,
                    [all[face[0]], all[face[1]], all[face[2]], all[face[3]]],
                )
            },
        );
        let [p, q] = &self.ends;
        let a = p[0].mul_add(x, p[1].mul_add(y, p[2].mul_add(z, offset)));
        let b = q[0].mul_add(x, q[1].mul_add(y, q[2].mul_add(z, offset)));
        let scale = a.all(1.0) / (a - b);
        let t = a * scale;
        let error = Lanes::abs(scale).mul_add(self.error, a.all(ROUNDINGS));
        [t - error, t + error]
    }
}

/// The parameter of a face, by number, and whether it can be no other single.
#[inline(always)]
fn crossing<S: Simd>(
    faces: &Faces,
    halves: &[Half<S>; 2],
    face: f32x8<S>,
) -> (f32x8<S>, <f32x8<S> as SimdBase<S>>::Mask) {
    let number: [i32; 8] = face.to_int::<i32x8<S>>().into();
    let of = |j: usize| number[j] as usize & 7;
    let [low, high] = halves[0].interval(faces, [of(0), of(1), of(2), of(3)]);
    let [low_2, high_2] = halves[1].interval(faces, [of(4), of(5), of(6), of(7)]);
    let t = f64x4::narrow(low, low_2);
    (t, t.simd_eq(f64x4::narrow(high, high_2)))
}

/// Places, by face, where an entry's and an exit's parameter is missing.
pub(super) struct ByFace {
    entries: [Queue; 6],
    exits: [Queue; 6],
}

impl Default for ByFace {
    fn default() -> Self {
        Self {
            entries: [const { Queue::new() }; 6],
            exits: [const { Queue::new() }; 6],
        }
    }
}

impl<S: Simd> Cut<S> for f64x4<S> {
    type PutOff = ByFace;

    #[inline(always)]
    fn cut(
        _: &Faces,
        put_off: &mut ByFace,
        present: Range<usize>,
        [p, _]: [[Self; 3]; 2],
        found: &Crossings<S, Self>,
    ) -> ([Self; 2], Self::Mask) {
        let queues = [&mut put_off.entries, &mut put_off.exits];
        for ((queues, face), cut) in queues.into_iter().zip(found.faces).zip(found.cut) {
            let cut = (cut & found.certain).to_bitmask();
            let face: [f64; 4] = face.into();
            for ((j, face), place) in face.into_iter().enumerate().zip(present.clone()) {
                queues[face as usize % 6].push_if(place, cut >> j & 1 != 0);
            }
        }
        ([p[0].all(0.0), p[0].all(1.0)], found.certain)
    }

    #[inline(always)]
    fn finish(simd: S, frustum: &Frustum, put_off: &mut ByFace, open: &mut Open<f64>) {
        for face in 0..6 {
            let (entries, exits) = (&mut put_off.entries[face], &mut put_off.exits[face]);
            for (queue, to) in [(entries, &mut open.t0), (exits, &mut open.t1)] {
                for places in queue.fours() {
                    let found: [f64; 4] =
                        precisely(simd, frustum, &open.coordinates, face, places).into();
                    for (place, t) in places.into_iter().zip(found) {
                        to[place] = t;
                    }
                }
                queue.clear();
            }
        }
    }
}

/// Four coordinates.
#[inline(always)]
fn four<S: Simd>(simd: S, array: &[f64], [a, b, c, d]: [usize; 4]) -> f64x4<S> {
    [array[a], array[b], array[c], array[d]].simd_into(simd)
}

/// The rule.
#[inline(always)]
fn precisely<S: Simd, const M: usize>(
    simd: S,
    frustum: &Frustum,
    coordinates: &[[f64; M]; 6],
    face: usize,
    places: [usize; 4],
) -> f64x4<S> {
    let precise = &frustum.filter().precise;
    let a = precise.magnitude(
        face,
        #[inline(always)]
        |axis| four(simd, &coordinates[axis], places),
    );
    let b = precise.magnitude(
        face,
        #[inline(always)]
        |axis| four(simd, &coordinates[axis + 3], places),
    );
    // From the nearer end; if none is it is half-way from both.
    let tau = a.min(b) / (a + b);
    b.simd_lt(a).select(a.all(1.0) - tau, tau)
}
