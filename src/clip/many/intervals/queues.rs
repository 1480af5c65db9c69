//! Numbers of segments in a block, queued a register's bits at a time.

use crate::simd::compaction::PLACES;

/// Segments in a block: what is written about them stays in the first cache.
pub(super) const BLOCK: usize = 256;

/// Room beyond a block for places that are written and do not count; a power of two, by
/// which a place is brought into an array's range in one operation.
pub(super) const ROOM: usize = 2 * BLOCK;

/// Numbers below [`BLOCK`], at most as many.
pub(super) struct Queue {
    items: [u16; ROOM],
    len: usize,
}

impl Queue {
    pub(super) const fn new() -> Self {
        Self {
            items: [0; ROOM],
            len: 0,
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// Appends `base` plus the place of each bit that is set, of N.
    #[inline(always)]
    pub(super) fn append<const N: usize>(&mut self, base: usize, bits: u64) {
        for k in (0..N).step_by(8) {
            let byte = bits >> k & 0xff;
            let places = &PLACES[byte as usize];
            let rest = self.items.get_mut(self.len..);
            if let Some(slots) = rest.and_then(|rest| rest.first_chunk_mut::<8>()) {
                for (slot, place) in slots.iter_mut().zip(places) {
                    *slot = (base + k) as u16 + u16::from(*place);
                }
            }
            self.len += byte.count_ones() as usize;
        }
    }

    /// Appends one, or does not.
    #[inline(always)]
    pub(super) fn push_if(&mut self, item: usize, condition: bool) {
        self.items[self.len % ROOM] = item as u16;
        self.len += usize::from(condition);
    }

    #[inline(always)]
    pub(super) fn items(&self) -> &[u16] {
        &self.items[..self.len.min(BLOCK)]
    }

    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.len.min(BLOCK)
    }

    /// One of them.
    #[inline(always)]
    pub(super) fn at(&self, place: usize) -> usize {
        usize::from(self.items[place % ROOM]) % BLOCK
    }

    /// In groups of four; the last one repeats its last.
    #[inline(always)]
    pub(super) fn fours(&self) -> impl Iterator<Item = [usize; 4]> + '_ {
        let last = self.len().saturating_sub(1);
        (0..self.len()).step_by(4).map(
            #[inline(always)]
            move |start| {
                let at = |j: usize| usize::from(self.items[(start + j).min(last) % ROOM]);
                [at(0), at(1), at(2), at(3)]
            },
        )
    }
}
