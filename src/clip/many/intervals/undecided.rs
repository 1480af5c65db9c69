//! The segments of a block that triage leaves undecided, side by side.

use super::super::queue::{BLOCK, QUEUE_CAPACITY, Queue};
use super::triage::Triage;
use crate::math::{Real, Segment, Vec3};
use fearless_simd::prelude::*;

/// The undecided segments of a block.
pub(super) struct Undecided<T> {
    /// How many there are.
    pub(super) len: usize,
    /// Their coordinates: starts, then ends.
    pub(super) coordinates: [[T; QUEUE_CAPACITY]; 6],
    /// The parameters found for each: 1 and 0 if it is outside.
    pub(super) t0: [T; QUEUE_CAPACITY],
    pub(super) t1: [T; QUEUE_CAPACITY],
    /// Places of those that are not certain.
    pub(super) uncertain: Queue<u16>,
    /// Their indices in the block, once they are listed.
    indices: Queue<u16>,
}

impl<T: Real> Undecided<T> {
    pub(super) fn new() -> Self {
        Self {
            len: 0,
            coordinates: [[T::ZERO; QUEUE_CAPACITY]; 6],
            t0: [T::ZERO; QUEUE_CAPACITY],
            t1: [T::ZERO; QUEUE_CAPACITY],
            uncertain: Queue::<u16>::new(),
            indices: Queue::<u16>::new(),
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 0;
        self.uncertain.clear();
    }

    /// Appends those of a register whose lane is set.
    #[inline(always)]
    pub(super) fn pack<S: Simd, V, const N: usize>(&mut self, ends: [[V; 3]; 2], lanes: V::Mask)
    where
        V: SimdFloat<S, Element = T>,
    {
        let to = self.len.min(BLOCK);
        let to = to..to + N;
        let [a, b, c, d, e, f] = &mut self.coordinates;
        let [p, q] = ends;
        p[0].compress(lanes).store_slice(&mut a[to.clone()]);
        p[1].compress(lanes).store_slice(&mut b[to.clone()]);
        p[2].compress(lanes).store_slice(&mut c[to.clone()]);
        q[0].compress(lanes).store_slice(&mut d[to.clone()]);
        q[1].compress(lanes).store_slice(&mut e[to.clone()]);
        q[2].compress(lanes).store_slice(&mut f[to]);
        self.len += lanes.to_bitmask().count_ones() as usize;
    }

    /// Lists their indices.
    #[inline(always)]
    pub(super) fn list<S, V, const N: usize>(&mut self, simd: S, triage: &Triage<T>)
    where
        S: Simd,
        V: SimdFloat<S, Element = T>,
    {
        self.indices.clear();
        for at in (0..BLOCK).step_by(N) {
            let lanes = triage.undecided::<S, V, N>(simd, at);
            self.indices.append_bits::<N>(at, lanes.to_bitmask());
        }
        self.len = self.indices.len();
    }

    /// Puts the coordinates of those listed side by side.
    #[inline(always)]
    pub(super) fn gather(&mut self, block: [&[T; BLOCK]; 6]) {
        let [a, b, c, d, e, f] = &mut self.coordinates;
        for (place, &item) in self.indices.items().iter().enumerate() {
            let i = usize::from(item) % BLOCK;
            a[place] = block[0][i];
            b[place] = block[1][i];
            c[place] = block[2][i];
            d[place] = block[3][i];
            e[place] = block[4][i];
            f[place] = block[5][i];
        }
    }

    /// Writes the parameters of those listed to their indices.
    #[inline(always)]
    pub(super) fn scatter(&self, t0: &mut [T; BLOCK], t1: &mut [T; BLOCK]) {
        for (place, &item) in self.indices.items().iter().enumerate() {
            let i = usize::from(item) % BLOCK;
            t0[i] = self.t0[place];
            t1[i] = self.t1[place];
        }
    }

    /// The segments that are not certain, of those listed, with their indices in the block.
    pub(super) fn uncertain(&self) -> impl Iterator<Item = (usize, Segment<T>)> + '_ {
        self.uncertain.items().iter().map(|&place| {
            let place = usize::from(place) % BLOCK;
            let at = |k: usize| self.coordinates[k][place];
            let segment = Segment {
                start: Vec3::new(at(0), at(1), at(2)),
                end: Vec3::new(at(3), at(4), at(5)),
            };
            (self.indices.at(place), segment)
        })
    }
}
