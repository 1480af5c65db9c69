//! What triage leaves open of a block, side by side.

use super::queues::{BLOCK, Queue, ROOM};
use super::triage::Triage;
use crate::math::{Real, Segment, Vec3};
use fearless_simd::prelude::*;

/// What of a block triage leaves open.
pub(super) struct Undecided<T> {
    /// How many.
    pub(super) len: usize,
    /// Their coordinates: starts, then ends.
    pub(super) coordinates: [[T; ROOM]; 6],
    /// What is found of each: 1 and 0 of what is outside.
    pub(super) t0: [T; ROOM],
    pub(super) t1: [T; ROOM],
    /// Places of what is not certain.
    pub(super) unsure: Queue,
    /// Which segments they are, once they are listed.
    numbers: Queue,
}

impl<T: Real> Undecided<T> {
    pub(super) fn new() -> Self {
        Self {
            len: 0,
            coordinates: [[T::ZERO; ROOM]; 6],
            t0: [T::ZERO; ROOM],
            t1: [T::ZERO; ROOM],
            unsure: Queue::new(),
            numbers: Queue::new(),
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 0;
        self.unsure.clear();
    }

    /// Appends those of a register whose bit is set.
    #[inline(always)]
    pub(super) fn pack<S: Simd, V, const N: usize>(&mut self, ends: [[V; 3]; 2], open: V::Mask)
    where
        V: SimdFloat<S, Element = T>,
    {
        let to = self.len.min(BLOCK);
        let to = to..to + N;
        let [a, b, c, d, e, f] = &mut self.coordinates;
        let [p, q] = ends;
        p[0].compress(open).store_slice(&mut a[to.clone()]);
        p[1].compress(open).store_slice(&mut b[to.clone()]);
        p[2].compress(open).store_slice(&mut c[to.clone()]);
        q[0].compress(open).store_slice(&mut d[to.clone()]);
        q[1].compress(open).store_slice(&mut e[to.clone()]);
        q[2].compress(open).store_slice(&mut f[to]);
        self.len += open.to_bitmask().count_ones() as usize;
    }

    /// Lists which segments they are.
    #[inline(always)]
    pub(super) fn list<S, V, const N: usize>(&mut self, simd: S, marks: &Triage<T>)
    where
        S: Simd,
        V: SimdFloat<S, Element = T>,
    {
        self.numbers.clear();
        for at in (0..BLOCK).step_by(N) {
            let open = marks.open::<S, V, N>(simd, at);
            self.numbers.append::<N>(at, open.to_bitmask());
        }
        self.len = self.numbers.len();
    }

    /// Puts the coordinates of what is listed side by side.
    #[inline(always)]
    pub(super) fn gather(&mut self, block: [&[T; BLOCK]; 6]) {
        let [a, b, c, d, e, f] = &mut self.coordinates;
        for (place, &item) in self.numbers.items().iter().enumerate() {
            let i = usize::from(item) % BLOCK;
            a[place] = block[0][i];
            b[place] = block[1][i];
            c[place] = block[2][i];
            d[place] = block[3][i];
            e[place] = block[4][i];
            f[place] = block[5][i];
        }
    }

    /// Writes what was found of what is listed to its places.
    #[inline(always)]
    pub(super) fn scatter(&self, t0: &mut [T; BLOCK], t1: &mut [T; BLOCK]) {
        for (place, &item) in self.numbers.items().iter().enumerate() {
            let i = usize::from(item) % BLOCK;
            t0[i] = self.t0[place];
            t1[i] = self.t1[place];
        }
    }

    /// The segments that are not certain, of what is listed, with their numbers.
    pub(super) fn unsure(&self) -> impl Iterator<Item = (usize, Segment<T>)> + '_ {
        self.unsure.items().iter().map(|&place| {
            let place = usize::from(place) % BLOCK;
            let at = |k: usize| self.coordinates[k][place];
            let segment = Segment {
                start: Vec3::new(at(0), at(1), at(2)),
                end: Vec3::new(at(3), at(4), at(5)),
            };
            (self.numbers.at(place), segment)
        })
    }
}
