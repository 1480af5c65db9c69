//! Triage of a block, and its answers when all segments are decided.
//!
//! Triage gives each segment a pair of parameters: 1 and 0 if it is outside, 0 and 1 if it is
//! inside, 0 and 0 if it is undecided.

use super::super::queue::BLOCK;
use super::frustum_lanes::FrustumLanes;
use super::run::packs;
use super::undecided::Undecided;
use crate::clip::Class;
use crate::clip::rules::compare::MinMax;
use crate::clip::rules::triage::Extremes;
use crate::math::Real;
use fearless_simd::prelude::*;

/// The pairs of a block.
pub(super) struct Triage<T> {
    t0: [T; BLOCK],
    t1: [T; BLOCK],
}

/// The answers of a block.
pub(super) struct Answers<'a, T> {
    pub(super) classes: &'a mut [Class; BLOCK],
    pub(super) t0: &'a mut [T; BLOCK],
    pub(super) t1: &'a mut [T; BLOCK],
}

/// The ends of a register of segments, from `at` on.
#[inline(always)]
pub(super) fn ends<S, V, const N: usize, const M: usize>(
    simd: S,
    block: [&[V::Element; M]; 6],
    at: usize,
) -> [[V; 3]; 2]
where
    S: Simd,
    V: SimdFloat<S>,
{
    [
        [
            V::from_slice(simd, &block[0][at..at + N]),
            V::from_slice(simd, &block[1][at..at + N]),
            V::from_slice(simd, &block[2][at..at + N]),
        ],
        [
            V::from_slice(simd, &block[3][at..at + N]),
            V::from_slice(simd, &block[4][at..at + N]),
            V::from_slice(simd, &block[5][at..at + N]),
        ],
    ]
}

impl<T: Real> Triage<T> {
    pub(super) fn new() -> Self {
        Self {
            t0: [T::ZERO; BLOCK],
            t1: [T::ZERO; BLOCK],
        }
    }

    /// Decides which segments are outside of a face, or inside of all, by their values' signs, and
    /// packs the others, if registers can be packed.
    #[inline(always)]
    pub(super) fn decide<S, V, const N: usize>(
        &mut self,
        simd: S,
        frustum: &FrustumLanes<S, V>,
        block: [&[T; BLOCK]; 6],
        undecided: &mut Undecided<T>,
    ) where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]> + MinMax,
    {
        for at in (0..BLOCK).step_by(N) {
            let ends = ends::<S, V, N, BLOCK>(simd, block, at);
            let [p, q] = &ends;
            let size = frustum.size(&ends);
            let [start, end] = [frustum.near_far(p), frustum.near_far(q)];
            let mut extremes = Extremes::new(start[0], end[0]);
            extremes.add(start[1], end[1]);
            for side in 0..4 {
                extremes.add(frustum.side(side, p), frustum.side(side, q));
            }
            let covered = frustum.covers(&size);
            let outside = covered & extremes.greatest.simd_lt(-size.threshold);
            let inside = covered & extremes.least.simd_gt(size.threshold);
            let to = at..at + N;
            let (zero, one) = (frustum.zero, frustum.one);
            outside
                .select(one, zero)
                .store_slice(&mut self.t0[to.clone()]);
            inside.select(one, zero).store_slice(&mut self.t1[to]);
            if packs(simd) {
                undecided.pack::<S, V, N>(ends, !(outside | inside));
            }
        }
    }

    /// Makes the segments from `end` on outside if they are undecided, and returns how many were.
    pub(super) fn keep_below(&mut self, end: usize) -> usize {
        let mut dropped = 0;
        for (t0, t1) in self.t0[end..].iter_mut().zip(&self.t1[end..]) {
            if *t0 == *t1 {
                *t0 = T::ONE;
                dropped += 1;
            }
        }
        dropped
    }

    /// Which segments of a register are undecided.
    #[inline(always)]
    pub(super) fn undecided<S, V, const N: usize>(&self, simd: S, at: usize) -> V::Mask
    where
        S: Simd,
        V: SimdFloat<S, Element = T>,
    {
        let t0 = V::from_slice(simd, &self.t0[at..at + N]);
        t0.simd_eq(V::from_slice(simd, &self.t1[at..at + N]))
    }

    /// Merges the parameters found for the undecided segments with the others, and classifies all.
    #[inline(always)]
    pub(super) fn merge<S, V, const N: usize>(
        &self,
        simd: S,
        undecided: &Undecided<T>,
        to: Answers<'_, T>,
    ) where
        S: Simd,
        V: SimdFloat<S, Element = T>,
    {
        if packs(simd) {
            let mut place = 0;
            for at in (0..BLOCK).step_by(N) {
                let lanes = self.undecided::<S, V, N>(simd, at);
                let t0 = V::from_slice(simd, &self.t0[at..at + N]);
                let t1 = V::from_slice(simd, &self.t1[at..at + N]);
                let from = place..place + N;
                let to_t0 = &mut to.t0[at..at + N];
                let found = V::from_slice(simd, &undecided.t0[from.clone()]);
                V::expand_merge(found, lanes, t0).store_slice(to_t0);
                let to_t1 = &mut to.t1[at..at + N];
                let found = V::from_slice(simd, &undecided.t1[from]);
                V::expand_merge(found, lanes, t1).store_slice(to_t1);
                place = (place + lanes.to_bitmask().count_ones() as usize).min(BLOCK);
            }
        } else {
            *to.t0 = self.t0;
            *to.t1 = self.t1;
            undecided.scatter(to.t0, to.t1);
        }
        for i in 0..BLOCK {
            to.classes[i] = if to.t0[i] > to.t1[i] {
                Class::Outside
            } else if self.t1[i] > self.t0[i] {
                Class::Inside
            } else {
                Class::Cross
            };
        }
    }
}
