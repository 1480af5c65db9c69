//! Where a query's answers go: the three buffers of a caller, and the sinks that fill them.

use super::ContainmentMasks;
use super::block_driver::{BLOCK, BlockBits, BlockDriver, WORD};
use super::masks::visible;
use super::relative::RelativeQuery;
use super::source::Query;
use crate::cull::{Containment, Culler, VolumeCounts, VolumeErrorAt};
use crate::simd::compaction::PLACES;

/// Takes the bits of a query's volumes, in order.
pub trait Sink {
    /// Whether the sink needs to know which volumes are inside.
    const INSIDE: bool;

    /// Takes the bits of the next `count` volumes, all decided; no other bits are set.
    fn take(&mut self, count: usize, bits: BlockBits);

    /// Writes what is still held back after the last volume.
    #[inline(always)]
    fn finish(&mut self) {}

    /// Runs a query over relative boxes. A sink is no generic type, so that this is compiled in
    /// the library and not in every crate that asks.
    fn run_relative(
        &mut self,
        driver: BlockDriver<'_, f32, RelativeQuery<'_>>,
    ) -> Result<(), VolumeErrorAt>;
}

/// The body of [`Sink::run_relative`], which each sink has for itself.
macro_rules! run_relative {
    () => {
        fn run_relative(
            &mut self,
            driver: crate::cull::many::block_driver::BlockDriver<
                '_,
                f32,
                crate::cull::many::relative::RelativeQuery<'_>,
            >,
        ) -> Result<(), crate::cull::VolumeErrorAt> {
            crate::cull::many::block_driver::run_f32(fearless_simd::Level::new(), driver, self)
        }
    };
}
pub(super) use run_relative;

/// A caller's buffer.
pub(super) trait Output {
    /// Removes all answers.
    fn clear(&mut self);

    /// Replaces the content by a query's answers. On an error the content is unspecified.
    fn write(
        &mut self,
        culler: &Culler,
        query: &impl Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt>;

    /// The same on rayon's threads; returns the counts of all.
    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        culler: &Culler,
        query: &impl Query,
    ) -> Result<VolumeCounts, VolumeErrorAt>;
}

impl Output for ContainmentMasks {
    fn clear(&mut self) {
        self.clear();
    }

    fn write(
        &mut self,
        culler: &Culler,
        query: &impl Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        query.run(culler, &mut self.prepare(query.count()), counts)
    }

    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        culler: &Culler,
        query: &impl Query,
    ) -> Result<VolumeCounts, VolumeErrorAt> {
        super::parallel::masks(culler, query, self)
    }
}

impl Output for Vec<Containment> {
    fn clear(&mut self) {
        self.clear();
    }

    fn write(
        &mut self,
        culler: &Culler,
        query: &impl Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        self.resize(query.count(), Containment::Outside);
        query.run(culler, &mut Classes(self), counts)
    }

    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        culler: &Culler,
        query: &impl Query,
    ) -> Result<VolumeCounts, VolumeErrorAt> {
        super::parallel::classes(culler, query, self)
    }
}

impl Output for Vec<u32> {
    fn clear(&mut self) {
        self.clear();
    }

    fn write(
        &mut self,
        culler: &Culler,
        query: &impl Query,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        self.clear();
        query.run(culler, &mut Indices::new(self, 0), counts)
    }

    #[cfg(feature = "parallel")]
    fn write_parallel(
        &mut self,
        culler: &Culler,
        query: &impl Query,
    ) -> Result<VolumeCounts, VolumeErrorAt> {
        super::parallel::indices(culler, query, self)
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
    const INSIDE: bool = true;

    run_relative!();

    #[inline(always)]
    fn take(&mut self, count: usize, bits: BlockBits) {
        let mut classes = [[Containment::Crossing; 4]; WORD / 4];
        for (i, four) in classes.iter_mut().enumerate() {
            let nibble = |bits: u64| (bits >> (4 * i) & 15) as usize;
            *four = CLASSES[nibble(bits.outside) | nibble(bits.inside) << 4];
        }
        if let Some(slots) = self.0.split_off_mut(..count) {
            slots.copy_from_slice(&classes.as_flattened()[..count]);
        }
    }
}

/// Writes the indices of the volumes that are not outside.
pub(super) struct Indices<'a> {
    list: &'a mut Vec<u32>,
    /// The index of the next volume.
    next: u32,
    /// Indices on their way to the list.
    waiting: [u32; BLOCK + 8],
    len: usize,
}

impl<'a> Indices<'a> {
    /// Appends to a list; `first` is the index of the first volume.
    pub(super) fn new(list: &'a mut Vec<u32>, first: u32) -> Self {
        Self {
            list,
            next: first,
            waiting: [0; BLOCK + 8],
            len: 0,
        }
    }
}

impl Sink for Indices<'_> {
    const INSIDE: bool = false;

    run_relative!();

    /// A byte of bits at a time, without branches: which volumes are visible cannot be
    /// predicted.
    #[inline(always)]
    fn take(&mut self, count: usize, bits: BlockBits) {
        let visible = visible(count, bits.outside);
        if visible != 0 {
            if self.len > BLOCK - WORD {
                self.finish();
            }
            for (k, byte) in visible.to_le_bytes().into_iter().enumerate() {
                let next = self.next.wrapping_add(8 * k as u32);
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
        self.next = self.next.wrapping_add(count as u32);
    }

    #[inline(always)]
    fn finish(&mut self) {
        self.list
            .extend_from_slice(&self.waiting[..self.len.min(BLOCK)]);
        self.len = 0;
    }
}
