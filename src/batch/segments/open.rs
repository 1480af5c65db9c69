//! What triage leaves open of a block, side by side.

use super::queues::{BLOCK, Queue, ROOM};
use crate::math::{Real, Segment, Vec3};
use fearless_simd::f64x4;
use fearless_simd::prelude::*;

/// What of a block triage leaves open.
pub(super) struct Open<T> {
    /// Which segments.
    pub(super) numbers: Queue,
    /// Their coordinates: starts, then ends.
    pub(super) coordinates: [[T; ROOM]; 6],
    /// Places in these, by face, where an entry's and an exit's parameter is missing.
    pub(super) entries: [Queue; 6],
    pub(super) exits: [Queue; 6],
    /// Places of what is outside all the same, and of what is not certain.
    pub(super) outside: Queue,
    pub(super) unsure: Queue,
}

impl<T: Real> Open<T> {
    pub(super) fn new() -> Self {
        Self {
            numbers: Queue::new(),
            coordinates: [[T::ZERO; ROOM]; 6],
            entries: [const { Queue::new() }; 6],
            exits: [const { Queue::new() }; 6],
            outside: Queue::new(),
            unsure: Queue::new(),
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.numbers.clear();
        self.entries.iter_mut().for_each(Queue::clear);
        self.exits.iter_mut().for_each(Queue::clear);
        self.outside.clear();
        self.unsure.clear();
    }

    /// Puts the coordinates side by side; beyond the last they repeat it, up to a whole
    /// register.
    #[inline(always)]
    pub(super) fn gather(&mut self, block: [&[T; BLOCK]; 6]) {
        let [a, b, c, d, e, f] = &mut self.coordinates;
        let items = self.numbers.items();
        for (place, &item) in items.iter().enumerate() {
            let i = usize::from(item) % BLOCK;
            a[place] = block[0][i];
            b[place] = block[1][i];
            c[place] = block[2][i];
            d[place] = block[3][i];
            e[place] = block[4][i];
            f[place] = block[5][i];
        }
        let len = items.len();
        if let Some(last) = len.checked_sub(1) {
            for array in &mut self.coordinates {
                let number = array[last];
                array[len..len + 7].fill(number);
            }
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

    /// Four coordinates in doubles.
    #[inline(always)]
    pub(super) fn doubles<S: Simd>(&self, simd: S, axis: usize, places: [usize; 4]) -> f64x4<S> {
        let array = &self.coordinates[axis];
        let [a, b, c, d] = places;
        [
            array[a % ROOM].to_f64(),
            array[b % ROOM].to_f64(),
            array[c % ROOM].to_f64(),
            array[d % ROOM].to_f64(),
        ]
        .simd_into(simd)
    }
}
