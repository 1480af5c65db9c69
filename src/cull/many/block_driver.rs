//! Volumes by blocks, and what is done with their answers.
//!
//! ```text
//! for each block of 256 volumes, a bit each:
//!     certainly outside, certainly inside, unsettled
//!     what is unsettled is asked for one by one, exactly
//!     the words go to the caller's buffers: masks, classes or a list of numbers
//! ```

use crate::cull::{Containment, Culler, Volume, VolumeCounts, VolumeErrorAt};
use crate::frustum::eval::planes::FacePlanes;
use crate::math::Real;
use crate::simd::at_width;
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, f64x4};

/// Volumes whose bits make a word.
pub(super) const WORD: usize = u64::BITS as usize;

/// Volumes in a block: few enough that their numbers stay in the first cache from one
/// pass over them to the next, so many that loops are not unrolled altogether.
pub(super) const BLOCK: usize = 4 * WORD;

/// Eight volumes, K numbers each.
pub(super) type Eight<T, const K: usize> = [[T; 8]; K];

/// A block's numbers, in order of volumes but for eights: one stream through memory, and
/// whole registers.
pub(super) type Block<T, const K: usize> = [Eight<T, K>; BLOCK / 8];

/// Number k of a group of N volumes.
#[inline(always)]
pub(super) fn load<S, V, T, const N: usize, const K: usize>(
    simd: S,
    block: &Block<T, K>,
    k: usize,
    group: usize,
) -> V
where
    S: Simd,
    V: SimdFloat<S, Element = T>,
{
    // The remainder changes nothing, and spares a check for each.
    let numbers = &block[group * N / 8][k % K];
    V::from_slice(simd, &numbers[group * N % 8..][..N])
}

/// The bits of a block.
pub(super) type Words = [BlockBits; BLOCK / WORD];

/// Bits for 64 volumes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BlockBits {
    pub(super) outside: u64,
    pub(super) inside: u64,
    pub(super) unsettled: u64,
}

impl BlockBits {
    /// Sets the bits of N volumes, from that of number `at` on: who is certainly
    /// outside, who certainly inside, whose class is certain.
    #[inline(always)]
    pub(super) fn set<const N: usize>(&mut self, at: usize, masks: [u64; 3]) {
        let [outside, inside, settled] = masks;
        self.outside |= outside << at;
        self.inside |= inside << at;
        self.unsettled |= (!settled & (u64::MAX >> (WORD - N))) << at;
    }
}

/// Many volumes of one kind, K numbers each.
pub(super) trait Volumes<T: Real, const K: usize> {
    fn len(&self) -> usize;

    fn volume(&self, index: usize) -> Option<Volume>;

    /// The block from `start` on, if it is kept, and its largest magnitude; all of it are
    /// volumes.
    fn block(&self, start: usize) -> Option<(&Block<T, K>, T)>;

    /// Arrays that have the numbers, if there are any.
    fn arrays(&self) -> Option<[&[T]; K]>;

    /// The numbers of one.
    fn numbers(&self, index: usize) -> [T; K];

    /// What a register at a time settles; without INSIDE only what is outside is told. The
    /// largest magnitude is given if all are known to be volumes.
    fn words<S, V, const N: usize, const INSIDE: bool>(
        simd: S,
        rows: &FacePlanes<T>,
        block: &Block<T, K>,
        largest: Option<T>,
    ) -> Words
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>;
}

/// Where answers go.
pub(super) trait Sink {
    /// Whether it matters what is inside.
    const INSIDE: bool;

    /// The words of the next `count` volumes, all settled; no other bits are set.
    fn take(&mut self, count: usize, word: BlockBits);

    /// All have been told.
    #[inline(always)]
    fn finish(&mut self) {}
}

/// Asks a frustum about all volumes of a lot.
pub(super) struct BlockDriver<'a, T, L> {
    pub(super) culler: &'a Culler,
    pub(super) rows: &'a FacePlanes<T>,
    pub(super) lot: &'a L,
    pub(super) counts: &'a mut VolumeCounts,
}

impl<T: Real, L> BlockDriver<'_, T, L> {
    /// On an error the sink has what came before.
    #[inline(always)]
    pub(super) fn run<S, V, const N: usize, const K: usize, Out: Sink>(
        &mut self,
        simd: S,
        out: &mut Out,
    ) -> Result<(), VolumeErrorAt>
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
        L: Volumes<T, K>,
    {
        let mut gathered = [[[T::ZERO; 8]; K]; BLOCK / 8];
        for start in (0..self.lot.len()).step_by(BLOCK) {
            let count = BLOCK.min(self.lot.len() - start);
            let (block, largest) = match self.lot.block(start) {
                Some((block, largest)) => (block, Some(largest)),
                None => {
                    self.gather(start, count, &mut gathered);
                    (&gathered, None)
                }
            };
            let words = match Out::INSIDE {
                true => L::words::<S, V, N, true>(simd, self.rows, block, largest),
                false => L::words::<S, V, N, false>(simd, self.rows, block, largest),
            };
            for (k, mut word) in words.into_iter().enumerate() {
                let Some(count) = count.checked_sub(k * WORD).filter(|&count| count > 0) else {
                    break;
                };
                let count = count.min(WORD);
                let present = u64::MAX >> (WORD - count);
                word.unsettled &= present;
                if word.unsettled != 0 {
                    self.settle(start + k * WORD, &mut word)?;
                }
                word.outside &= present;
                word.inside &= present;
                out.take(count, word);
            }
        }
        out.finish();
        Ok(())
    }

    /// A block's numbers; beyond the last volume it repeats that.
    #[inline(always)]
    fn gather<const K: usize>(&self, start: usize, count: usize, to: &mut Block<T, K>)
    where
        L: Volumes<T, K>,
    {
        if let Some(arrays) = self.lot.arrays().and_then(|arrays| blocks(arrays, start)) {
            for (i, eight) in to.iter_mut().enumerate() {
                for (to, from) in eight.iter_mut().zip(arrays) {
                    to.copy_from_slice(&from[8 * i..8 * i + 8]);
                }
            }
            return;
        }
        for i in 0..BLOCK {
            let numbers = self.lot.numbers(start + i.min(count - 1));
            for (to, number) in to[i / 8].iter_mut().zip(numbers) {
                to[i % 8] = number;
            }
        }
    }

    /// One by one.
    #[inline(never)]
    fn settle<const K: usize>(
        &mut self,
        start: usize,
        word: &mut BlockBits,
    ) -> Result<(), VolumeErrorAt>
    where
        L: Volumes<T, K>,
    {
        while word.unsettled != 0 {
            let bit = word.unsettled & word.unsettled.wrapping_neg();
            word.unsettled ^= bit;
            self.counts.unsettled += 1;
            let index = start + bit.trailing_zeros() as usize;
            let Some(volume) = self.lot.volume(index) else {
                continue;
            };
            let class = self
                .culler
                .classify_counted(volume, self.counts)
                .map_err(|error| VolumeErrorAt { index, error })?;
            word.outside |= if class == Containment::Outside {
                bit
            } else {
                0
            };
            word.inside |= if class == Containment::Inside { bit } else { 0 };
        }
        Ok(())
    }
}

/// A block from `start` of each array, if there are so many.
#[inline(always)]
fn blocks<T, const K: usize>(arrays: [&[T]; K], start: usize) -> Option<[&[T; BLOCK]; K]> {
    let mut blocks = [arrays.first()?.get(start..)?.first_chunk()?; K];
    for (block, array) in blocks.iter_mut().zip(arrays) {
        *block = array.get(start..)?.first_chunk()?;
    }
    Some(blocks)
}

/// Asks about a lot at the machine's vector width.
macro_rules! drive {
    ($name:ident, $t:ident, $lanes:ident, $n:literal) => {
        pub(super) fn $name<const K: usize, L: Volumes<$t, K>, Out: Sink>(
            level: Level,
            mut drive: BlockDriver<'_, $t, L>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            at_width!(level, simd => run_at::<_, $t, $lanes<_>, $n, K, L, Out>(simd, &mut drive, out))
        }
    };
}

#[inline(always)]
fn run_at<S, T, V, const N: usize, const K: usize, L, Out>(
    simd: S,
    drive: &mut BlockDriver<'_, T, L>,
    out: &mut Out,
) -> Result<(), VolumeErrorAt>
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
    L: Volumes<T, K>,
    Out: Sink,
{
    drive.run::<S, V, N, K, Out>(simd, out)
}

drive!(singles, f32, f32x8, 8);
drive!(doubles, f64, f64x4, 4);
