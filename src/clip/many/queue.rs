//! Indices of segments in a block, queued without branches.

use crate::simd::compaction::PLACES;

/// Segments in a block, which are clipped together: their answers stay in the first cache.
pub(super) const BLOCK: usize = 256;

/// Capacity of a queue: more than a block fills, as items that are offered and not taken are
/// written to the next free place all the same. A power of two, by which a place is brought into
/// an array's range in one operation.
pub(super) const QUEUE_CAPACITY: usize = 2 * BLOCK;

/// At most as many items as a block has segments.
pub(super) struct Queue<I> {
    items: [I; QUEUE_CAPACITY],
    len: usize,
}

/// Empty queues are constants, so that many are made with one `memset`.
macro_rules! empty {
    ($($item:ident)*) => {$(
        impl Queue<$item> {
            pub(super) const fn new() -> Self {
                Self {
                    items: [0; QUEUE_CAPACITY],
                    len: 0,
                }
            }
        }
    )*};
}

empty!(u16 u32);

impl<I: Copy> Queue<I> {
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.len.min(BLOCK)
    }

    #[inline(always)]
    pub(super) fn items(&self) -> &[I] {
        &self.items[..self.len()]
    }

    /// Appends an item if the condition holds.
    #[inline(always)]
    pub(super) fn push_if(&mut self, item: I, condition: bool) {
        self.items[self.len % QUEUE_CAPACITY] = item;
        self.len += usize::from(condition);
    }

    /// Appends those items whose bit is set.
    #[inline(always)]
    pub(super) fn append<const N: usize>(&mut self, items: [I; N], bits: u64) {
        for (j, item) in items.into_iter().enumerate() {
            self.push_if(item, bits >> j & 1 != 0);
        }
    }

    /// The items in groups, the last one filled up with its last item, and how many
    /// of each group count.
    #[inline(always)]
    pub(super) fn groups<const N: usize>(&self) -> impl Iterator<Item = ([I; N], usize)> + '_ {
        self.items().chunks(N).map(
            #[inline(always)]
            |group| match group.try_into() {
                Ok(whole) => (whole, N),
                Err(_) => {
                    let last = group[group.len() - 1];
                    let filled = std::array::from_fn(|j| *group.get(j).unwrap_or(&last));
                    (filled, group.len())
                }
            },
        )
    }
}

impl Queue<u16> {
    /// Appends `base` plus the index of each bit that is set, of N: a byte at a time, which costs
    /// less than [`Queue::append`] for registers of eight lanes or more.
    #[inline(always)]
    pub(super) fn append_bits<const N: usize>(&mut self, base: usize, bits: u64) {
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

    /// The item at a place, as an index into a block.
    #[inline(always)]
    pub(super) fn at(&self, place: usize) -> usize {
        usize::from(self.items[place % QUEUE_CAPACITY]) % BLOCK
    }
}

/// A slice's segments of a block by what they wait for.
pub(super) struct Queues {
    /// To be copied.
    pub(super) inside: Queue<u32>,
    /// With certain signs, to be cut.
    pub(super) crossing: Queue<u32>,
    /// With certain crossings: [`Crossed`].
    pub(super) crossed: Queue<u32>,
    /// On the lattice, not settled by certain signs.
    pub(super) lattice: Queue<u32>,
    /// To be clipped alone.
    pub(super) uncertain: Queue<u32>,
}

impl Queues {
    pub(super) const fn new() -> Self {
        Self {
            inside: Queue::<u32>::new(),
            crossing: Queue::<u32>::new(),
            crossed: Queue::<u32>::new(),
            lattice: Queue::<u32>::new(),
            uncertain: Queue::<u32>::new(),
        }
    }

    pub(super) fn clear(&mut self) {
        for queue in [
            &mut self.inside,
            &mut self.crossing,
            &mut self.crossed,
            &mut self.lattice,
            &mut self.uncertain,
        ] {
            queue.clear();
        }
    }
}

/// A segment's index in a block, the indices of the faces at its entry and exit, and whether they
/// are crossed, packed.
#[derive(Clone, Copy)]
pub(super) struct Crossed(pub(super) u32);

impl Crossed {
    /// `faces` has the entry's face in its bits 0 to 2, the exit's in 3 to 5;
    /// `clipped` is 0 or 1.
    #[inline(always)]
    pub(super) fn new(item: u32, faces: u64, clipped: [u64; 2]) -> Self {
        let flags = (clipped[0] | clipped[1] << 1) as u32;
        Self(item | (faces as u32 & 0x3f) << 16 | flags << 24)
    }

    #[inline(always)]
    pub(super) fn item(self) -> usize {
        (self.0 & 0xffff) as usize
    }

    #[inline(always)]
    pub(super) fn face(self, exit: bool) -> usize {
        (self.0 >> (16 + 3 * u32::from(exit)) & 7) as usize
    }

    #[inline(always)]
    pub(super) fn clipped(self, exit: bool) -> bool {
        self.0 >> (24 + u32::from(exit)) & 1 != 0
    }
}
