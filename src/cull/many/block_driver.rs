//! Volumes by blocks, and the exact answers to what a kernel leaves open.
//!
//! ```text
//! for each block of 256 volumes, by the kernel, a bit each:
//!     certainly outside, certainly inside, undecided
//! undecided volumes are classified one by one, exactly
//! the bits go to a sink: masks, classes or a list of indices
//! ```

use super::output::Sink;
use crate::cull::{Containment, Culler, Volume, VolumeCounts, VolumeErrorAt};
use crate::frustum::eval::planes::FacePlanes;
use crate::math::Real;
use crate::simd::at_width;
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, f64x4};

/// Volumes whose bits make a machine word.
pub(super) const WORD: usize = u64::BITS as usize;

/// Volumes in a block: few enough that they stay in the first-level cache from one pass over
/// them to the next, so many that loops are not unrolled completely.
pub(super) const BLOCK: usize = 4 * WORD;

/// Eight volumes of K components each.
pub(super) type Eight<T, const K: usize> = [[T; 8]; K];

/// A block's components, eight volumes at a time: one stream through memory, in whole
/// registers.
pub(super) type Block<T, const K: usize> = [Eight<T, K>; BLOCK / 8];

/// Component k of a group of N volumes.
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
    // `% K` changes nothing, and spares a bounds check.
    let components = &block[group * N / 8][k % K];
    V::from_slice(simd, &components[group * N % 8..][..N])
}

/// The answers about a block.
pub(super) type BlockAnswers = [BlockBits; BLOCK / WORD];

/// Bits for 64 volumes.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlockBits {
    pub(super) outside: u64,
    pub(super) inside: u64,
    pub(super) undecided: u64,
}

impl BlockBits {
    /// Sets the bits of N volumes from index `at` on: certainly outside, certainly inside,
    /// class certain.
    #[inline(always)]
    pub(super) fn set<const N: usize>(&mut self, at: usize, masks: [u64; 3]) {
        let [outside, inside, decided] = masks;
        self.outside |= outside << at;
        self.inside |= inside << at;
        self.undecided |= (!decided & (u64::MAX >> (WORD - N))) << at;
    }
}

/// Many volumes of one kind, of K components each, and their kernel.
pub(super) trait Volumes<T: Real, const K: usize> {
    fn len(&self) -> usize;

    fn volume(&self, index: usize) -> Option<Volume>;

    /// The block from `start` on, if it is stored, and its largest magnitude; all of its
    /// volumes are valid.
    fn block(&self, start: usize) -> Option<(&Block<T, K>, T)>;

    /// The components as arrays, if they are stored so.
    fn arrays(&self) -> Option<[&[T]; K]>;

    /// The components of one volume.
    fn components(&self, index: usize) -> [T; K];

    /// Classifies a block, a register at a time; without INSIDE only *outside* is decided. The
    /// largest magnitude is given if all volumes are known to be valid.
    fn classify_block<S, V, const N: usize, const INSIDE: bool>(
        simd: S,
        planes: &FacePlanes<T>,
        block: &Block<T, K>,
        largest: Option<T>,
    ) -> BlockAnswers
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>;
}

/// Classifies all volumes, block by block.
pub struct BlockDriver<'a, T, V> {
    pub(super) culler: &'a Culler,
    pub(super) planes: &'a FacePlanes<T>,
    pub(super) volumes: &'a V,
    pub(super) counts: &'a mut VolumeCounts,
}

impl<T: Real, Vols> BlockDriver<'_, T, Vols> {
    /// On an error the sink has the answers before it.
    #[inline(always)]
    pub(super) fn run<S, V, const N: usize, const K: usize, Out: Sink>(
        &mut self,
        simd: S,
        out: &mut Out,
    ) -> Result<(), VolumeErrorAt>
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
        Vols: Volumes<T, K>,
    {
        let mut gathered = [[[T::ZERO; 8]; K]; BLOCK / 8];
        for start in (0..self.volumes.len()).step_by(BLOCK) {
            let count = BLOCK.min(self.volumes.len() - start);
            let (block, largest) = match self.volumes.block(start) {
                Some((block, largest)) => (block, Some(largest)),
                None => {
                    self.gather(start, count, &mut gathered);
                    (&gathered, None)
                }
            };
            let answers = match Out::INSIDE {
                true => Vols::classify_block::<S, V, N, true>(simd, self.planes, block, largest),
                false => Vols::classify_block::<S, V, N, false>(simd, self.planes, block, largest),
            };
            for (k, mut bits) in answers.into_iter().enumerate() {
                let Some(count) = count.checked_sub(k * WORD).filter(|&count| count > 0) else {
                    break;
                };
                let count = count.min(WORD);
                let present = u64::MAX >> (WORD - count);
                bits.undecided &= present;
                if bits.undecided != 0 {
                    self.decide(start + k * WORD, &mut bits)?;
                }
                bits.outside &= present;
                bits.inside &= present;
                out.take(count, bits);
            }
        }
        out.finish();
        Ok(())
    }

    /// Copies a block's components; beyond the last volume that one is repeated.
    #[inline(always)]
    fn gather<const K: usize>(&self, start: usize, count: usize, to: &mut Block<T, K>)
    where
        Vols: Volumes<T, K>,
    {
        if let Some(arrays) = self
            .volumes
            .arrays()
            .and_then(|arrays| blocks(arrays, start))
        {
            for (i, eight) in to.iter_mut().enumerate() {
                for (to, from) in eight.iter_mut().zip(arrays) {
                    to.copy_from_slice(&from[8 * i..8 * i + 8]);
                }
            }
            return;
        }
        for i in 0..BLOCK {
            let components = self.volumes.components(start + i.min(count - 1));
            for (to, component) in to[i / 8].iter_mut().zip(components) {
                to[i % 8] = component;
            }
        }
    }

    /// Classifies undecided volumes one by one.
    #[inline(never)]
    fn decide<const K: usize>(
        &mut self,
        start: usize,
        bits: &mut BlockBits,
    ) -> Result<(), VolumeErrorAt>
    where
        Vols: Volumes<T, K>,
    {
        while bits.undecided != 0 {
            let bit = bits.undecided & bits.undecided.wrapping_neg();
            bits.undecided ^= bit;
            self.counts.undecided += 1;
            let index = start + bit.trailing_zeros() as usize;
            let Some(volume) = self.volumes.volume(index) else {
                continue;
            };
            let class = self
                .culler
                .classify_counted(volume, self.counts)
                .map_err(|error| VolumeErrorAt { index, error })?;
            bits.outside |= if class == Containment::Outside {
                bit
            } else {
                0
            };
            bits.inside |= if class == Containment::Inside { bit } else { 0 };
        }
        Ok(())
    }
}

/// The block from `start` on of each array, if all of them reach so far.
#[inline(always)]
fn blocks<T, const K: usize>(arrays: [&[T]; K], start: usize) -> Option<[&[T; BLOCK]; K]> {
    let mut blocks = [arrays.first()?.get(start..)?.first_chunk()?; K];
    for (block, array) in blocks.iter_mut().zip(arrays) {
        *block = array.get(start..)?.first_chunk()?;
    }
    Some(blocks)
}

/// Classifies all volumes at the machine's vector width.
macro_rules! run {
    ($name:ident, $t:ident, $lanes:ident, $n:literal) => {
        pub(super) fn $name<const K: usize, Vols: Volumes<$t, K>, Out: Sink>(
            level: Level,
            mut driver: BlockDriver<'_, $t, Vols>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            at_width!(level, simd => {
                run_at::<_, $t, $lanes<_>, $n, K, Vols, Out>(simd, &mut driver, out)
            })
        }
    };
}

#[inline(always)]
fn run_at<S, T, V, const N: usize, const K: usize, Vols, Out>(
    simd: S,
    driver: &mut BlockDriver<'_, T, Vols>,
    out: &mut Out,
) -> Result<(), VolumeErrorAt>
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
    Vols: Volumes<T, K>,
    Out: Sink,
{
    driver.run::<S, V, N, K, Out>(simd, out)
}

run!(run_f32, f32, f32x8, 8);
run!(run_f64, f64, f64x4, 4);
