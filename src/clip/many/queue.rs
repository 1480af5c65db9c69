//! Numbers of segments, queued without branches.

/// How many segments are clipped together: their clips stay in the first cache.
pub(super) const CHUNK: usize = 256;

/// Room beyond what a chunk can fill: items that are offered and not taken are
/// written to the next free place all the same.
const ROOM: usize = 2 * CHUNK;

/// Numbers of segments in a chunk, each with some bits beside it.
pub(super) struct Queue {
    items: [u32; ROOM],
    len: usize,
}

impl Queue {
    const fn new() -> Self {
        Self {
            items: [0; ROOM],
            len: 0,
        }
    }

    /// Appends those items whose bit is set.
    #[inline(always)]
    pub(super) fn append<const N: usize>(&mut self, items: [u32; N], bits: u64) {
        for (j, item) in items.into_iter().enumerate() {
            self.items[self.len % ROOM] = item;
            self.len += (bits >> j & 1) as usize;
        }
    }

    #[inline(always)]
    pub(super) fn items(&self) -> &[u32] {
        &self.items[..self.len.min(CHUNK)]
    }

    /// The items in groups, the last one filled up with its last item, and how many
    /// of each group count.
    #[inline(always)]
    pub(super) fn groups<const N: usize>(&self) -> impl Iterator<Item = ([u32; N], usize)> + '_ {
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

/// What a chunk's segments wait for.
pub(super) struct Queues {
    /// To be copied.
    pub(super) inside: Queue,
    /// Of certain signs, to be cut.
    pub(super) crossing: Queue,
    /// With certain crossings: the number, then [`Crossed`].
    pub(super) crossed: Queue,
    /// On the lattice, not settled by certain signs.
    pub(super) lattice: Queue,
    /// To be clipped alone.
    pub(super) uncertain: Queue,
}

impl Queues {
    pub(super) const fn new() -> Self {
        Self {
            inside: Queue::new(),
            crossing: Queue::new(),
            crossed: Queue::new(),
            lattice: Queue::new(),
            uncertain: Queue::new(),
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
            queue.len = 0;
        }
    }
}

/// A segment's number in a chunk and the faces at its entry and exit, packed:
/// which ones by number, and whether they are crossed.
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
