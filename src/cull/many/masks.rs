//! What a batch says: bits, classes, or the numbers of what may be seen.

use super::block_driver::{BLOCK, BlockBits, Sink, WORD};
use crate::cull::Containment;
use crate::simd::compaction::PLACES;

/// A bit for each volume of a batch: 64 a word, the first one lowest.
///
/// ```
/// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape, batch::ContainmentMasks};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let boxes = [Aabb::new([0.0_f32; 3], [0.5; 3]), Aabb::new([0.0; 3], [1.0, 1.0, 2.0])];
/// let mut masks = ContainmentMasks::default();
/// Culler::new(&frustum).mask_boxes(&boxes[..], &mut masks)?;
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
    /// How many volumes it tells of.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether it tells of none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Set where a volume is outside. Bits beyond the last volume are not set.
    #[must_use]
    pub fn outside(&self) -> &[u64] {
        &self.outside
    }

    /// Set where a volume is inside. Bits beyond the last volume are not set.
    #[must_use]
    pub fn inside(&self) -> &[u64] {
        &self.inside
    }

    /// Of one volume.
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

    /// The numbers of the volumes that are not outside, in order.
    pub fn visible(&self) -> impl Iterator<Item = usize> + '_ {
        let words = self.outside.iter().enumerate();
        words.flat_map(move |(k, outside)| {
            let count = WORD.min(self.len - k * WORD);
            bits(visible(count, *outside)).map(move |bit| k * WORD + bit)
        })
    }
}

/// The bits of `count` volumes that are not outside.
#[inline(always)]
fn visible(count: usize, outside: u64) -> u64 {
    !outside & (u64::MAX >> (WORD - count))
}

/// The numbers of a word's bits.
#[inline(always)]
fn bits(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros() as usize;
        word &= word.wrapping_sub(1);
        (bit < WORD).then_some(bit)
    })
}

impl ContainmentMasks {
    /// Room for answers about so many volumes, each to be written.
    pub(super) fn prepare(&mut self, len: usize) -> MaskWords<'_> {
        let words = len.div_ceil(WORD);
        self.len = len;
        self.outside.resize(words, 0);
        self.inside.resize(words, 0);
        MaskWords {
            outside: &mut self.outside,
            inside: &mut self.inside,
        }
    }

    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.len = 0;
        self.outside.clear();
        self.inside.clear();
    }
}

/// Words that are still to be written.
pub(super) struct MaskWords<'a> {
    pub(super) outside: &'a mut [u64],
    pub(super) inside: &'a mut [u64],
}

impl Sink for MaskWords<'_> {
    const INSIDE: bool = true;

    #[inline(always)]
    fn take(&mut self, _count: usize, word: BlockBits) {
        for (words, bits) in [
            (&mut self.outside, word.outside),
            (&mut self.inside, word.inside),
        ] {
            if let Some(first) = words.split_off_first_mut() {
                *first = bits;
            }
        }
    }
}

/// The classes for four bits each of outside and inside.
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

/// Classes that are still to be written.
pub(super) struct Classes<'a>(pub(super) &'a mut [Containment]);

impl Sink for Classes<'_> {
    const INSIDE: bool = true;

    #[inline(always)]
    fn take(&mut self, count: usize, word: BlockBits) {
        let mut classes = [[Containment::Crossing; 4]; WORD / 4];
        for (i, four) in classes.iter_mut().enumerate() {
            let nibble = |word: u64| (word >> (4 * i) & 15) as usize;
            *four = CLASSES[nibble(word.outside) | nibble(word.inside) << 4];
        }
        if let Some(slots) = self.0.split_off_mut(..count) {
            slots.copy_from_slice(&classes.as_flattened()[..count]);
        }
    }
}

/// The numbers of what is not outside.
pub(super) struct Numbers<'a> {
    list: &'a mut Vec<u32>,
    /// The number of the next volume.
    next: u32,
    /// Numbers on their way to the list.
    waiting: [u32; BLOCK + 8],
    len: usize,
}

impl<'a> Numbers<'a> {
    /// To the end of a list; the first volume has this number.
    pub(super) fn new(list: &'a mut Vec<u32>, first: u32) -> Self {
        Self {
            list,
            next: first,
            waiting: [0; BLOCK + 8],
            len: 0,
        }
    }
}

impl Sink for Numbers<'_> {
    const INSIDE: bool = false;

    /// A byte of bits at a time, without branches: what may be seen cannot be predicted.
    #[inline(always)]
    fn take(&mut self, count: usize, word: BlockBits) {
        let visible = visible(count, word.outside);
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
