//! Volumes by blocks, and the exact answers to what a kernel leaves open.
//!
//! ```text
//! for each block of 256 volumes, by the kernel, a bit each:
//!     certainly outside, certainly inside, undecided
//! undecided volumes are classified one by one, exactly
//! the bits go to a sink: masks, classes or a list of indices
//! ```

#[cfg(not(simd))]
use super::one::Classify;
use super::output::Sink;
use crate::cull::{Containment, Culler, Volume, VolumeCounts, VolumeErrorAt};
use crate::frustum::eval::planes::FacePlanes;
use crate::math::Real;
use crate::simd::Level;
#[cfg(simd)]
use fearless_simd::prelude::*;
use std::ops::Range;

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
#[cfg(simd)]
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
    #[cfg(simd)]
    fn arrays(&self) -> Option<[&[T]; K]>;

    /// The components of one volume.
    fn components(&self, index: usize) -> [T; K];

    /// Whether a volume with these components is finite, and valid.
    #[cfg(simd)]
    fn is_usual(components: [T; K]) -> bool;

    /// Classifies a block at a vector width. The largest magnitude is given if all volumes are
    /// known to be valid; without `inside` only *outside* is decided.
    #[cfg(simd)]
    fn classify_block(
        level: Level,
        planes: &FacePlanes<T>,
        block: &Block<T, K>,
        largest: Option<T>,
        inside: bool,
    ) -> BlockAnswers;

    /// The function that classifies one volume.
    #[cfg(not(simd))]
    fn classify_one() -> Classify<T, K>;
}

/// A kernel, compiled for each scalar type once, here, and not in every crate that asks.
#[cfg(simd)]
pub(super) type Kernel<T, const K: usize> =
    fn(Level, &FacePlanes<T>, &Block<T, K>, Option<T>, bool) -> BlockAnswers;

/// What is asked about volumes, whichever they are.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    pub(super) culler: &'a Culler,
    /// Whether an invalid volume is crossing, and no error.
    pub(super) keeps_invalid: bool,
    /// Whether classes are those of [`Culler::classify_exact`].
    pub(super) is_exact: bool,
}

impl Request<'_> {
    /// The class of the volume at an index.
    #[inline]
    pub(super) fn classify(
        &self,
        index: usize,
        volume: Volume,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeErrorAt> {
        let class = if self.is_exact {
            self.culler.classify_exact_counted(volume, counts)
        } else {
            self.culler.classify_counted(volume, counts)
        };
        match class {
            Ok(class) => Ok(class),
            Err(_) if self.keeps_invalid => {
                counts.invalid += 1;
                Ok(Containment::Crossing)
            }
            Err(error) => Err(VolumeErrorAt { index, error }),
        }
    }
}

/// What classifies volumes, block by block.
pub(super) struct BlockDriver<'a, T, V> {
    pub(super) request: Request<'a>,
    pub(super) planes: &'a FacePlanes<T>,
    pub(super) volumes: &'a V,
    pub(super) level: Level,
}

impl<T: Real, Vols> BlockDriver<'_, T, Vols> {
    /// Classifies a range of the volumes, which starts at a multiple of a block. On an error the
    /// sink has the answers before it.
    pub(super) fn run<const K: usize>(
        &self,
        range: Range<usize>,
        out: &mut dyn Sink,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt>
    where
        Vols: Volumes<T, K>,
    {
        // What is inside needs no exact test.
        let inside = out.needs_inside() || self.request.is_exact;
        let mut gathered = [[[T::ZERO; 8]; K]; BLOCK / 8];
        for start in range.clone().step_by(BLOCK) {
            let count = BLOCK.min(range.end - start);
            let mut answers = self.classify(start, count, inside, &mut gathered);
            for (k, bits) in answers.iter_mut().enumerate() {
                let count = count.saturating_sub(k * WORD).min(WORD);
                let present = u64::MAX.checked_shr((WORD - count) as u32).unwrap_or(0);
                bits.undecided &= present;
                if self.request.is_exact {
                    let crossing = present & !(bits.outside | bits.inside | bits.undecided);
                    self.test_exactly(start + k * WORD, crossing, bits, counts);
                }
                if bits.undecided != 0 {
                    self.decide(start + k * WORD, bits, counts)?;
                }
                bits.outside &= present;
                bits.inside &= present;
            }
            out.take(count, &answers);
        }
        out.finish();
        Ok(())
    }

    #[cfg(simd)]
    fn classify<const K: usize>(
        &self,
        start: usize,
        count: usize,
        inside: bool,
        gathered: &mut Block<T, K>,
    ) -> BlockAnswers
    where
        Vols: Volumes<T, K>,
    {
        let (block, largest) = match self.volumes.block(start) {
            Some((block, largest)) => (block, Some(largest)),
            None => {
                self.gather(start, count, gathered);
                (&*gathered, None)
            }
        };
        let answers = Vols::classify_block(self.level, self.planes, block, largest, inside);
        if answers.iter().all(|bits| bits.undecided == u64::MAX) {
            return self.classify_the_usual(*block, inside, answers);
        }
        answers
    }

    /// Classifies a block of which nothing was decided once more, without the volumes that are the reason: those that are
    /// invalid, empty or not finite. They stay undecided.
    #[cfg(simd)]
    #[cold]
    #[inline(never)]
    fn classify_the_usual<const K: usize>(
        &self,
        mut block: Block<T, K>,
        inside: bool,
        undecided: BlockAnswers,
    ) -> BlockAnswers
    where
        Vols: Volumes<T, K>,
    {
        let mut unusual = [0; BLOCK / WORD];
        for (i, eight) in block.iter_mut().enumerate() {
            for j in 0..8 {
                if !Vols::is_usual(eight.map(|components| components[j])) {
                    eight
                        .iter_mut()
                        .for_each(|components| components[j] = T::ZERO);
                    unusual[i / (WORD / 8)] |= 1_u64 << (i % (WORD / 8) * 8 + j);
                }
            }
        }
        if unusual == [0; BLOCK / WORD] {
            return undecided;
        }
        let mut answers = Vols::classify_block(self.level, self.planes, &block, None, inside);
        for (bits, unusual) in answers.iter_mut().zip(unusual) {
            bits.outside &= !unusual;
            bits.inside &= !unusual;
            bits.undecided |= unusual;
        }
        answers
    }

    #[cfg(not(simd))]
    fn classify<const K: usize>(
        &self,
        start: usize,
        count: usize,
        inside: bool,
        _: &mut Block<T, K>,
    ) -> BlockAnswers
    where
        Vols: Volumes<T, K>,
    {
        let mut answers = [BlockBits::default(); BLOCK / WORD];
        let stored = self.volumes.block(start);
        let stored = stored.filter(|(_, largest)| largest.is_finite());
        let size = stored.map(|(_, largest)| largest + largest + largest);
        let threshold = size.map(|size| self.planes.threshold(size, true));
        let classify = Vols::classify_one();
        let mut i = 0;
        while i < count {
            let volume = self.volumes.components(start + i);
            let [outside, is_inside, decided] = classify(self.planes, &volume, threshold, inside);
            let bits = &mut answers[i / WORD];
            bits.outside |= outside << (i % WORD);
            bits.inside |= is_inside << (i % WORD);
            bits.undecided |= (1 - decided) << (i % WORD);
            i += 1;
        }
        answers
    }

    /// Copies a block's components; beyond the last volume that one is repeated.
    #[cfg(simd)]
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

    /// Tests volumes that no face plane rejects, and that are not inside, one by one.
    #[inline(never)]
    fn test_exactly<const K: usize>(
        &self,
        start: usize,
        mut crossing: u64,
        bits: &mut BlockBits,
        counts: &mut VolumeCounts,
    ) where
        Vols: Volumes<T, K>,
    {
        while crossing != 0 {
            let bit = crossing & crossing.wrapping_neg();
            crossing ^= bit;
            let volume = self.volumes.volume(start + bit.trailing_zeros() as usize);
            let culler = self.request.culler;
            if volume.is_some_and(|v| culler.is_separate_volume(&v, counts)) {
                bits.outside |= bit;
            }
        }
    }

    /// Classifies undecided volumes one by one.
    #[inline(never)]
    fn decide<const K: usize>(
        &self,
        start: usize,
        bits: &mut BlockBits,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt>
    where
        Vols: Volumes<T, K>,
    {
        while bits.undecided != 0 {
            let bit = bits.undecided & bits.undecided.wrapping_neg();
            bits.undecided ^= bit;
            counts.undecided += 1;
            let index = start + bit.trailing_zeros() as usize;
            let Some(volume) = self.volumes.volume(index) else {
                continue;
            };
            let class = self.request.classify(index, volume, counts)?;
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
#[cfg(simd)]
fn blocks<T, const K: usize>(arrays: [&[T]; K], start: usize) -> Option<[&[T; BLOCK]; K]> {
    let mut blocks = [arrays.first()?.get(start..)?.first_chunk()?; K];
    for (block, array) in blocks.iter_mut().zip(arrays) {
        *block = array.get(start..)?.first_chunk()?;
    }
    Some(blocks)
}
