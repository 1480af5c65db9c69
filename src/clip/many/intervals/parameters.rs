//! The parameters at which segments cross a face: the rule of `clip/rules/site.rs`, in registers.
//!
//! The rule takes magnitudes A and B of the face's values in double-double. For `f32` that
//! precision is hardly ever needed: with values in `f64`, off by E at most, t is off by
//! `E / (A + B)` and some roundings; where both ends of that interval round to the same
//! `f32`, so does the result of the rule, which lies in it (Ziv's test). For `f64` there is no such
//! test: their ends wait in a queue of their face.

use super::super::queue::Queue;
use super::crossings::Crossings;
use super::undecided::Undecided;
use super::widen::Widen;
use crate::clip::rules::compare::MinMax;
use crate::clip::rules::site::Step;
use crate::exact::float::Lanes;
use crate::frustum::Frustum;
use crate::frustum::eval::planes::FacePlanes;
use crate::math::Real;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f32x16, f64x4};
use std::ops::Range;

/// Upper bound of a parameter's error in `f64` besides its values' errors, and of the rule's own
/// error of 2.5 u.
const INTERVAL_ROUNDING: f64 = 16.0 * f64::UNIT_ROUNDOFF;

/// A register of segments' coordinates, and how the parameters of their cut ends are found.
pub(super) trait Cut<S: Simd>: SimdFloat<S, Element: Real> + MinMax {
    /// The frustum's faces.
    type Faces;

    /// The ends that are deferred until all of a block's crossings are known.
    type Deferred: Default;

    /// From the faces' half spaces.
    fn faces(simd: S, planes: &FacePlanes<f64>) -> Self::Faces;

    /// The parameters of the entries and exits that are cut, for the segments in these places, and
    /// which of them are certain. Or they are deferred, and the certainty is that of the crossings.
    fn cut(
        faces: &Self::Faces,
        deferred: &mut Self::Deferred,
        present: Range<usize>,
        ends: [[Self; 3]; 2],
        crossings: &Crossings<S, Self>,
    ) -> ([Self; 2], Self::Mask);

    /// Finds the deferred parameters.
    fn finish(
        simd: S,
        frustum: &Frustum,
        deferred: &mut Self::Deferred,
        undecided: &mut Undecided<Self::Element>,
    );
}

/// Registers of `f32` defer nothing.
macro_rules! cut_f32 {
    ($register:ident) => {
        impl<S: Simd> Cut<S> for $register<S> {
            type Faces = Faces<S, Self>;
            type Deferred = ();

            #[inline(always)]
            fn faces(simd: S, planes: &FacePlanes<f64>) -> Faces<S, Self> {
                Faces::new(simd, planes)
            }

            #[inline(always)]
            fn cut(
                faces: &Faces<S, Self>,
                (): &mut (),
                _: Range<usize>,
                ends: [[Self; 3]; 2],
                crossings: &Crossings<S, Self>,
            ) -> ([Self; 2], Self::Mask) {
                faces.cut(ends, crossings)
            }

            #[inline(always)]
            fn finish(_: S, _: &Frustum, (): &mut (), _: &mut Undecided<f32>) {}
        }
    };
}

cut_f32!(f32x8);
cut_f32!(f32x16);

/// Half spaces in `f64`, to look one up for each lane.
pub(super) struct Faces<S: Simd, V: Widen<S>> {
    /// The coordinates of each face's normal, and its offset.
    tables: [V::Table; 4],
    factor: V::Wide,
    constant: V::Wide,
    rounding: V::Wide,
    one: V::Wide,
}

/// Half of a register's segments, in `f64`.
struct Half<D> {
    ends: [[D; 3]; 2],
    /// Upper bound of a value's error.
    error: D,
}

impl<S: Simd, V: Widen<S>> Faces<S, V> {
    fn new(simd: S, planes: &FacePlanes<f64>) -> Self {
        let mut columns = [[0.0; 8]; 4];
        for face in 0..6 {
            let ([x, y, z], offset) = planes.face(face);
            for (column, value) in columns.iter_mut().zip([x, y, z, offset]) {
                column[face] = value;
            }
        }
        let splat = |v: f64| V::Wide::splat(simd, v);
        Self {
            tables: columns.map(|column| V::table(simd, column)),
            // A size in `f32` may be 5 u less than it is.
            factor: splat(planes.factor * 1.000_001),
            constant: splat(planes.constant),
            rounding: splat(INTERVAL_ROUNDING),
            one: splat(1.0),
        }
    }

    #[inline(always)]
    fn cut(&self, [p, q]: [[V; 3]; 2], crossings: &Crossings<S, V>) -> ([V; 2], V::Mask) {
        let p = [p[0].to_wide(), p[1].to_wide(), p[2].to_wide()];
        let q = [q[0].to_wide(), q[1].to_wide(), q[2].to_wide()];
        let size = crossings.size.to_wide();
        let halves = [self.half(0, p, q, size), self.half(1, p, q, size)];
        let (entry, entry_certain) = self.crossing(&halves, crossings.faces[0]);
        let (exit, exit_certain) = self.crossing(&halves, crossings.faces[1]);
        let [enters, leaves] = crossings.cut;
        let certain = (entry_certain | !enters) & (exit_certain | !leaves);
        ([entry, exit], certain)
    }

    #[inline(always)]
    fn half(
        &self,
        k: usize,
        p: [[V::Wide; 2]; 3],
        q: [[V::Wide; 2]; 3],
        size: [V::Wide; 2],
    ) -> Half<V::Wide> {
        Half {
            ends: [[p[0][k], p[1][k], p[2][k]], [q[0][k], q[1][k], q[2][k]]],
            error: size[k].mul_add(self.factor, self.constant),
        }
    }

    /// The parameters of each lane's face, and whether they can be no other `f32`.
    #[inline(always)]
    fn crossing(&self, halves: &[Half<V::Wide>; 2], face: V::Bits) -> (V, V::Mask) {
        let faces = V::look_up(&self.tables, face);
        let [low, high] = self.interval(&halves[0], faces[0]);
        let [low_2, high_2] = self.interval(&halves[1], faces[1]);
        let t = V::from_wide([low, low_2]);
        (t, t.simd_eq(V::from_wide([high, high_2])))
    }

    /// Lower and upper bounds of a face's parameters.
    #[inline(always)]
    fn interval(&self, half: &Half<V::Wide>, [x, y, z, offset]: [V::Wide; 4]) -> [V::Wide; 2] {
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
    entries: [Queue<u16>; 6],
    exits: [Queue<u16>; 6],
}

impl Default for ByFace {
    fn default() -> Self {
        Self {
            entries: [const { Queue::<u16>::new() }; 6],
            exits: [const { Queue::<u16>::new() }; 6],
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
        deferred: &mut ByFace,
        present: Range<usize>,
        [p, _]: [[Self; 3]; 2],
        crossings: &Crossings<S, Self>,
    ) -> ([Self; 2], Self::Mask) {
        let queues = [&mut deferred.entries, &mut deferred.exits];
        let ends = queues.into_iter().zip(crossings.faces).zip(crossings.cut);
        for ((queues, face), cut) in ends {
            let cut = (cut & crossings.certain).to_bitmask();
            let face: [u64; 4] = face.into();
            for ((j, face), place) in face.into_iter().enumerate().zip(present.clone()) {
                queues[face as usize % 6].push_if(place as u16, cut >> j & 1 != 0);
            }
        }
        ([p[0].splat(0.0), p[0].splat(1.0)], crossings.certain)
    }

    #[inline(always)]
    fn finish(simd: S, frustum: &Frustum, deferred: &mut ByFace, undecided: &mut Undecided<f64>) {
        for face in 0..6 {
            let (entries, exits) = (&mut deferred.entries[face], &mut deferred.exits[face]);
            for (queue, to) in [(entries, &mut undecided.t0), (exits, &mut undecided.t1)] {
                // The last group's repeated items have the same parameters.
                for (items, _) in queue.groups::<4>() {
                    let places = items.map(usize::from);
                    let found: [f64; 4] =
                        parameters(simd, frustum, &undecided.coordinates, face, places).into();
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

/// The parameters at which four segments cross a face.
#[inline(always)]
fn parameters<S: Simd, const M: usize>(
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
    // Whichever end a tie is reached from, its parameter is 1/2.
    Step::new(a, b, b.simd_lt(a)).parameter()
}
