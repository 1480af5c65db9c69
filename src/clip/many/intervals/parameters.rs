//! Where segments cross a face: the rule of `clip/exact/points.rs`, in registers.
//!
//! The rule takes magnitudes A and B of the face's values in double-double. Of singles that
//! precision is hardly ever needed: with the values of doubles, off by E at most, t is off by
//! `E / (A + B)` and some roundings; where both ends of that interval are the same
//! single, so is what the rule gives, which lies in it (Ziv's test). Of doubles nothing could
//! be said so: their ends wait in a queue of their face.

use super::crossings::Crossings;
use super::queues::Queue;
use super::undecided::Undecided;
use super::widen::Widen;
use crate::exact::float::Lanes;
use crate::frustum::Frustum;
use crate::frustum::eval::planes::FacePlanes;
use crate::math::Real;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f32x16, f64x4};
use std::ops::Range;

/// What t is off beside its values' errors, and the rule's own error of 2.5 u, with some room:
/// 16 u.
const ROUNDINGS: f64 = 1.7763568394002505e-15;

/// A register of segments' coordinates, and how their ends that are cut are found.
pub(super) trait Cut<S: Simd>: SimdFloat<S, Element: Real> {
    /// The frustum's faces as they are asked.
    type Faces;

    /// What is put off until all of a block is known.
    type Deferred: Default;

    /// From its faces' half spaces.
    fn faces(simd: S, rows: &FacePlanes<f64>) -> Self::Faces;

    /// The parameters of entry and exit, where they are cut, of those in these places, and which
    /// of them are found. Or they are put off, as certain as they are.
    fn cut(
        faces: &Self::Faces,
        put_off: &mut Self::Deferred,
        present: Range<usize>,
        ends: [[Self; 3]; 2],
        found: &Crossings<S, Self>,
    ) -> ([Self; 2], Self::Mask);

    /// Finds what was put off.
    fn finish(
        simd: S,
        frustum: &Frustum,
        put_off: &mut Self::Deferred,
        open: &mut Undecided<Self::Element>,
    );
}

/// Singles find their parameters where they stand.
macro_rules! cut_singles {
    ($singles:ident) => {
        impl<S: Simd> Cut<S> for $singles<S> {
            type Faces = Faces<S, Self>;
            type Deferred = ();

            #[inline(always)]
            fn faces(simd: S, rows: &FacePlanes<f64>) -> Faces<S, Self> {
                Faces::new(simd, rows)
            }

            #[inline(always)]
            fn cut(
                faces: &Faces<S, Self>,
                (): &mut (),
                _: Range<usize>,
                ends: [[Self; 3]; 2],
                found: &Crossings<S, Self>,
            ) -> ([Self; 2], Self::Mask) {
                faces.cut(ends, found)
            }

            #[inline(always)]
            fn finish(_: S, _: &Frustum, (): &mut (), _: &mut Undecided<f32>) {}
        }
    };
}

cut_singles!(f32x8);
cut_singles!(f32x16);

/// Half spaces in doubles, to look one up for each lane.
pub(super) struct Faces<S: Simd, V: Widen<S>> {
    /// Each face's normal and offset.
    numbers: [V::Table; 4],
    factor: V::Half,
    constant: V::Half,
    rounding: V::Half,
    one: V::Half,
}

/// Half of a register of segments, in doubles.
struct Half<D> {
    ends: [[D; 3]; 2],
    /// What a value is off at most.
    error: D,
}

impl<S: Simd, V: Widen<S>> Faces<S, V> {
    fn new(simd: S, rows: &FacePlanes<f64>) -> Self {
        let mut numbers = [[0.0; 8]; 4];
        for i in 0..6 {
            let ([x, y, z], offset) = rows.face(i);
            for (all, number) in numbers.iter_mut().zip([x, y, z, offset]) {
                all[i] = number;
            }
        }
        let splat = |v: f64| V::Half::splat(simd, v);
        Self {
            numbers: numbers.map(|numbers| V::table(simd, numbers)),
            // A size in singles may be 5 u less than it is.
            factor: splat(rows.factor * 1.000_001),
            constant: splat(rows.constant),
            rounding: splat(ROUNDINGS),
            one: splat(1.0),
        }
    }

    #[inline(always)]
    fn cut(&self, [p, q]: [[V; 3]; 2], found: &Crossings<S, V>) -> ([V; 2], V::Mask) {
        let p = [p[0].halves(), p[1].halves(), p[2].halves()];
        let q = [q[0].halves(), q[1].halves(), q[2].halves()];
        let size = found.size.halves();
        let halves = [self.half(0, p, q, size), self.half(1, p, q, size)];
        let (entry, entry_found) = self.crossing(&halves, found.faces[0]);
        let (exit, exit_found) = self.crossing(&halves, found.faces[1]);
        let all_found = (entry_found | !found.cut[0]) & (exit_found | !found.cut[1]);
        ([entry, exit], all_found)
    }

    #[inline(always)]
    fn half(
        &self,
        k: usize,
        p: [[V::Half; 2]; 3],
        q: [[V::Half; 2]; 3],
        size: [V::Half; 2],
    ) -> Half<V::Half> {
        Half {
            ends: [[p[0][k], p[1][k], p[2][k]], [q[0][k], q[1][k], q[2][k]]],
            error: size[k].mul_add(self.factor, self.constant),
        }
    }

    /// The parameter of a face, by number, and whether it can be no other single.
    #[inline(always)]
    fn crossing(&self, halves: &[Half<V::Half>; 2], face: V::Bits) -> (V, V::Mask) {
        let faces = V::look_up(&self.numbers, face);
        let [low, high] = self.interval(&halves[0], faces[0]);
        let [low_2, high_2] = self.interval(&halves[1], faces[1]);
        let t = V::whole([low, low_2]);
        (t, t.simd_eq(V::whole([high, high_2])))
    }

    /// A face's parameter is between these.
    #[inline(always)]
    fn interval(&self, half: &Half<V::Half>, [x, y, z, offset]: [V::Half; 4]) -> [V::Half; 2] {
        let [p, q] = &half.ends;
        let a = p[0].mul_add(x, p[1].mul_add(y, p[2].mul_add(z, offset)));
        let b = q[0].mul_add(x, q[1].mul_add(y, q[2].mul_add(z, offset)));
        let scale = self.one / (a - b);
        let t = a * scale;
        let error = scale.abs().mul_add(half.error, self.rounding);
        [t - error, t + error]
    }
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
    type Faces = ();
    type Deferred = ByFace;

    fn faces(_: S, _: &FacePlanes<f64>) {}

    #[inline(always)]
    fn cut(
        (): &(),
        put_off: &mut ByFace,
        present: Range<usize>,
        [p, _]: [[Self; 3]; 2],
        found: &Crossings<S, Self>,
    ) -> ([Self; 2], Self::Mask) {
        let queues = [&mut put_off.entries, &mut put_off.exits];
        for ((queues, face), cut) in queues.into_iter().zip(found.faces).zip(found.cut) {
            let cut = (cut & found.certain).to_bitmask();
            let face: [u64; 4] = face.into();
            for ((j, face), place) in face.into_iter().enumerate().zip(present.clone()) {
                queues[face as usize % 6].push_if(place, cut >> j & 1 != 0);
            }
        }
        ([p[0].splat(0.0), p[0].splat(1.0)], found.certain)
    }

    #[inline(always)]
    fn finish(simd: S, frustum: &Frustum, put_off: &mut ByFace, open: &mut Undecided<f64>) {
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
    b.simd_lt(a).select(a.splat(1.0) - tau, tau)
}
