//! A query's answers as bits.

use super::block_driver::{BlockAnswers, WORD};
use super::output::Sink;
use crate::cull::Containment;

/// The classes of many volumes as bits: 64 volumes a word, the first one lowest.
///
/// A volume that is neither outside nor inside is crossing.
///
/// ```
/// use frusta::cull::ContainmentMasks;
/// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let boxes = [Aabb::new([0.0_f32; 3], [0.5; 3]), Aabb::new([0.0; 3], [1.0, 1.0, 2.0])];
/// let mut masks = ContainmentMasks::default();
/// Culler::new(&frustum).over(&boxes).masks(&mut masks)?;
/// assert_eq!(masks.outside(), [0b01]);
/// assert_eq!(masks.get(1), Some(Containment::Crossing));
/// assert_eq!(masks.visible().collect::<Vec<_>>(), [1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ContainmentMasks {
    len: usize,
    outside: Vec<u64>,
    inside: Vec<u64>,
}

impl ContainmentMasks {
    /// Number of volumes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no volumes.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The bits of the volumes that are outside. Bits beyond the last volume are 0.
    #[must_use]
    pub fn outside(&self) -> &[u64] {
        &self.outside
    }

    /// The bits of the volumes that are inside. Bits beyond the last volume are 0.
    #[must_use]
    pub fn inside(&self) -> &[u64] {
        &self.inside
    }

    /// The class of one volume; `None` beyond the last.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Containment> {
        let bit = |words: &[u64]| words[index / WORD] >> (index % WORD) & 1 != 0;
        (index < self.len).then(|| {
            if bit(&self.outside) {
                Containment::Outside
            } else if bit(&self.inside) {
                Containment::Inside
            } else {
                Containment::Crossing
            }
        })
    }

    /// The indices of the volumes that are not outside, in ascending order.
    pub fn visible(&self) -> impl Iterator<Item = usize> + '_ {
        let words = self.outside.iter().enumerate();
        words.flat_map(move |(k, outside)| {
            let count = WORD.min(self.len - k * WORD);
            set_bits(visible(count, *outside)).map(move |bit| k * WORD + bit)
        })
    }

    /// Resizes the masks for the answers about `len` volumes, each to be written.
    pub(super) fn prepare(&mut self, len: usize) -> MaskBits<'_> {
        let words = len.div_ceil(WORD);
        self.len = len;
        self.outside.resize(words, 0);
        self.inside.resize(words, 0);
        MaskBits {
            outside: &mut self.outside,
            inside: &mut self.inside,
        }
    }

    /// Clears.
    pub(super) fn clear(&mut self) {
        self.len = 0;
        self.outside.clear();
        self.inside.clear();
    }
}

/// The bits of `count` volumes that are not outside.
#[inline(always)]
pub(super) fn visible(count: usize, outside: u64) -> u64 {
    !outside & (u64::MAX >> (WORD - count))
}

/// The positions of the bits that are set, in ascending order.
#[inline(always)]
fn set_bits(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros() as usize;
        word &= word.wrapping_sub(1);
        (bit < WORD).then_some(bit)
    })
}

/// Writes masks; holds the words that are still to be written.
pub(super) struct MaskBits<'a> {
    pub(super) outside: &'a mut [u64],
    pub(super) inside: &'a mut [u64],
}

impl Sink for MaskBits<'_> {
    fn needs_inside(&self) -> bool {
        true
    }

    fn take(&mut self, count: usize, answers: &BlockAnswers) {
        for bits in &answers[..count.div_ceil(WORD)] {
            for (words, bits) in [
                (&mut self.outside, bits.outside),
                (&mut self.inside, bits.inside),
            ] {
                if let Some(first) = words.split_off_first_mut() {
                    *first = bits;
                }
            }
        }
    }
}
