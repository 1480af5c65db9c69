//! What triage leaves open of a block, side by side.

use super::queues::{BLOCK, Queue, ROOM};
use crate::clip::Class;
use crate::math::{Real, Segment, Vec3};
use fearless_simd::prelude::*;

/// What of a block triage leaves open.
pub(super) struct Open<T> {
    /// Which segments.
    pub(super) numbers: Queue,
    /// Their coordinates: starts, then ends.
    pub(super) coordinates: [[T; ROOM]; 6],
    /// What is found of each.
    pub(super) classes: [Class; ROOM],
    pub(super) t0: [T; ROOM],
    pub(super) t1: [T; ROOM],
    /// Places of what is not certain.
    pub(super) unsure: Queue,
}

impl<T: Real> Open<T> {
    pub(super) fn new() -> Self {
        Self {
            numbers: Queue::new(),
            coordinates: [[T::ZERO; ROOM]; 6],
            classes: [Class::Outside; ROOM],
            t0: [T::ZERO; ROOM],
            t1: [T::ZERO; ROOM],
            unsure: Queue::new(),
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.numbers.clear();
        self.unsure.clear();
    }

    /// Appends those of a register whose bit is set.
    #[inline(always)]
    pub(super) fn pack<S: Simd, V, const N: usize>(&mut self, ends: [[V; 3]; 2], open: V::Mask)
    where
        V: SimdFloat<S, Element = T>,
    {
        let to = self.numbers.len();
        let to = to..to + N;
        let [a, b, c, d, e, f] = &mut self.coordinates;
        let [p, q] = ends;
        p[0].compress(open).store_slice(&mut a[to.clone()]);
        p[1].compress(open).store_slice(&mut b[to.clone()]);
        p[2].compress(open).store_slice(&mut c[to.clone()]);
        q[0].compress(open).store_slice(&mut d[to.clone()]);
        q[1].compress(open).store_slice(&mut e[to.clone()]);
        q[2].compress(open).store_slice(&mut f[to]);
    }

    /// Puts the coordinates side by side, where registers cannot be packed.
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

    /// One of the segments.
    pub(super) fn segment(&self, place: usize) -> Segment<T> {
        let at = |k: usize| self.coordinates[k][place];
        Segment {
            start: Vec3::new(at(0), at(1), at(2)),
            end: Vec3::new(at(3), at(4), at(5)),
        }
    }
}
