//! Where a query's answers go: the three buffers of a caller, and the sinks that fill them.

use super::ContainmentMasks;
use super::block_driver::{BLOCK, BlockAnswers, Request, WORD};
use super::masks::visible;
use super::source::Query;
use crate::cull::{Containment, VolumeCounts, VolumeErrorAt};
use crate::simd::compaction::PLACES;
use crate::simd::{Level, at_width};
#[cfg(all(simd, any(target_arch = "x86", target_arch = "x86_64")))]
use fearless_simd::Simd;

/// Takes the bits of a query's volumes, in order.
pub trait Sink {
    /// Whether the sink needs to know which volumes are inside.
    fn needs_inside(&self) -> bool;

    /// Takes the bits of the next `count` volumes, a block's or fewer, all decided; no other bits
    /// are set.
    fn take(&mut self, count: usize, answers: &BlockAnswers);

    /// Writes what is still held back after the last volume.
    fn finish(&mut self) {}
}

/// A caller's buffer.
pub(super) trait Output {
    /// Removes all answers.
    fn clear(&mut self);

    /// Replaces the content by a query's answers. On an error the content is unspecified.
    fn write(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt>;

    /// The same on rayon's threads; returns the counts of all.
    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
    ) -> Result<VolumeCounts, VolumeErrorAt>;
}

impl Output for ContainmentMasks {
    fn clear(&mut self) {
        self.clear();
    }

    fn write(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        let mut bits = self.prepare(query.count());
        query.run(0..query.count(), request, &mut bits, counts)
    }

    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
    ) -> Result<VolumeCounts, VolumeErrorAt> {
        super::parallel::masks(request, query, self)
    }
}

impl Output for Vec<Containment> {
    fn clear(&mut self) {
        self.clear();
    }

    fn write(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        self.resize(query.count(), Containment::Outside);
        query.run(0..query.count(), request, &mut Classes(self), counts)
    }

    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
    ) -> Result<VolumeCounts, VolumeErrorAt> {
        super::parallel::classes(request, query, self)
    }
}

impl Output for Vec<u32> {
    fn clear(&mut self) {
        self.clear();
    }

    fn write(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        self.clear();
        query.run(
            0..query.count(),
            request,
            &mut Indices::new(self, 0),
            counts,
        )
    }

    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        request: Request<'_>,
        query: &dyn Query,
    ) -> Result<VolumeCounts, VolumeErrorAt> {
        super::parallel::indices(request, query, self)
    }
}

/// The classes for four bits of outside and four of inside.
const CLASSES: [[Containment; 4]; 256] = {
    let mut all = [[Containment::Crossing; 4]; 256];
    let mut i = 0;
    while i < 1024 {
        let (bits, lane) = (i / 4, i % 4);
        if bits >> lane & 1 != 0 {
            all[bits][lane] = Containment::Outside;
        } else if bits >> (4 + lane) & 1 != 0 {
            all[bits][lane] = Containment::Inside;
        }
        i += 1;
    }
    all
};

/// Writes classes; holds the slots that are still to be written.
pub(super) struct Classes<'a>(pub(super) &'a mut [Containment]);

impl Sink for Classes<'_> {
    fn needs_inside(&self) -> bool {
        true
    }

    fn take(&mut self, count: usize, answers: &BlockAnswers) {
        let slots = self.0.split_off_mut(..count).unwrap_or_default();
        for (slots, bits) in slots.chunks_mut(WORD).zip(answers) {
            let mut classes = [[Containment::Crossing; 4]; WORD / 4];
            for (i, four) in classes.iter_mut().enumerate() {
                let nibble = |bits: u64| (bits >> (4 * i) & 15) as usize;
                *four = CLASSES[nibble(bits.outside) | nibble(bits.inside) << 4];
            }
            slots.copy_from_slice(&classes.as_flattened()[..slots.len()]);
        }
    }
}

/// Writes the indices of the volumes that are not outside.
pub(super) struct Indices<'a> {
    list: &'a mut Vec<u32>,
    /// The index of the next volume.
    next: u32,
    /// Indices on their way to the list.
    waiting: [u32; 2 * BLOCK + 8],
    len: usize,
    level: Level,
}

impl<'a> Indices<'a> {
    /// Appends to a list; `first` is the index of the first volume.
    pub(super) fn new(list: &'a mut Vec<u32>, first: u32) -> Self {
        Self {
            list,
            next: first,
            waiting: [0; 2 * BLOCK + 8],
            len: 0,
            level: Level::new(),
        }
    }

    #[inline(always)]
    fn append(&mut self, count: usize, answers: &BlockAnswers) {
        for (k, bits) in answers.iter().enumerate() {
            let count = count.saturating_sub(k * WORD).min(WORD);
            if count == 0 {
                break;
            }
            let visible = visible(count, bits.outside);
            if visible == 0 {
                continue;
            }
            self.append_word(self.next.wrapping_add((k * WORD) as u32), visible);
        }
        self.next = self.next.wrapping_add(count as u32);
    }

    /// A byte of bits at a time, without branches: which volumes are visible cannot be
    /// predicted.
    #[cfg(simd)]
    #[inline(always)]
    fn append_word(&mut self, first: u32, visible: u64) {
        for (k, byte) in visible.to_le_bytes().into_iter().enumerate() {
            let next = first.wrapping_add(8 * k as u32);
            let places = &PLACES[usize::from(byte)];
            let rest = self.waiting.get_mut(self.len..);
            if let Some(slots) = rest.and_then(|rest| rest.first_chunk_mut::<8>()) {
                for (slot, place) in slots.iter_mut().zip(places) {
                    *slot = next.wrapping_add(u32::from(*place));
                }
            }
            self.len += byte.count_ones() as usize;
        }
    }

    #[cfg(not(simd))]
    fn append_word(&mut self, first: u32, mut visible: u64) {
        while visible != 0 {
            self.waiting[self.len] = first.wrapping_add(visible.trailing_zeros());
            self.len += 1;
            visible &= visible - 1;
        }
    }
}

impl Sink for Indices<'_> {
    fn needs_inside(&self) -> bool {
        false
    }

    fn take(&mut self, count: usize, answers: &BlockAnswers) {
        if self.len > BLOCK {
            self.finish();
        }
        at_width!(self.level, _simd => self.append(count, answers));
    }

    fn finish(&mut self) {
        let waiting = &self.waiting[..self.len.min(2 * BLOCK)];
        self.list.extend_from_slice(waiting);
        self.len = 0;
    }
}
