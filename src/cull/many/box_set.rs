//! Boxes that are kept from frame to frame.
//!
//! Boxes are checked, and their largest magnitude is found, once, when they are put in; and
//! they are stored in blocks as the kernels read them. A list of indices takes a fifth less
//! time than from arrays.

use super::block_driver::{BLOCK, Block};
use crate::cull::{Aabb, VolumeError, VolumeErrorAt};
use crate::math::Real;

/// Axis-aligned boxes that are kept from frame to frame: checked once, and the fastest source
/// of a query.
///
/// In memory they are a multiple of 256 boxes, of six scalars each.
///
/// ```
/// use frusta::cull::BoxSet;
/// use frusta::{Aabb, Culler, EndRect, Frustum, Pose, Shape};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let row = (0..9_u8).map(|i| f32::from(i));
/// let mut set = BoxSet::new(row.map(|x| Aabb::new([x, 0.0, 2.0], [x + 0.5, 1.0, 2.5])))?;
/// let mut visible = Vec::new();
/// let culler = Culler::new(&frustum);
/// culler.over(&set).visible(&mut visible)?;
/// assert_eq!(visible, [0, 1, 2]);
/// // One box moves.
/// set.set(8, Aabb::new([0.0, 0.0, 1.0], [0.5, 0.5, 1.5]))?;
/// culler.over(&set).visible(&mut visible)?;
/// assert_eq!(visible, [0, 1, 2, 8]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct BoxSet<T> {
    len: usize,
    /// Least x, y and z of each box, then the greatest. The last block is padded with points
    /// at the origin.
    blocks: Vec<Block<T, 6>>,
    /// The largest magnitude in each block.
    largest: Vec<T>,
}

impl<T> Default for BoxSet<T> {
    fn default() -> Self {
        Self {
            len: 0,
            blocks: Vec::new(),
            largest: Vec::new(),
        }
    }
}

impl<T: Real> BoxSet<T> {
    /// Makes a set of some boxes.
    ///
    /// # Errors
    /// The first box that fails [`Aabb::check`].
    pub fn new(boxes: impl IntoIterator<Item = Aabb<T>>) -> Result<Self, VolumeErrorAt> {
        let mut set = Self::default();
        set.extend(boxes)?;
        Ok(set)
    }

    /// Number of boxes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no boxes.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The box at an index; `None` beyond the last.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Aabb<T>> {
        Stored::from(self).get(index)
    }

    /// Appends a box.
    ///
    /// # Errors
    /// Those of [`Aabb::check`]; nothing is then appended.
    pub fn push(&mut self, volume: Aabb<T>) -> Result<(), VolumeError> {
        volume.check()?;
        self.append(volume);
        Ok(())
    }

    /// Appends a box that is valid, except that coordinates may be infinite: then the kernel
    /// decides nothing in its block.
    pub(super) fn append(&mut self, volume: Aabb<T>) {
        if self.len.is_multiple_of(BLOCK) {
            self.blocks.push([[[T::ZERO; 8]; 6]; BLOCK / 8]);
            self.largest.push(T::ZERO);
        }
        self.len += 1;
        self.put(self.len - 1, volume);
    }

    /// Replaces the box at an index.
    ///
    /// # Errors
    /// Those of [`Aabb::check`]; nothing is then changed.
    ///
    /// # Panics
    /// If the index is not below the length.
    pub fn set(&mut self, index: usize, volume: Aabb<T>) -> Result<(), VolumeError> {
        let len = self.len;
        assert!(index < len, "the index is {index} but the length is {len}");
        volume.check()?;
        self.put(index, volume);
        Ok(())
    }

    /// Appends boxes.
    ///
    /// # Errors
    /// The first box that fails [`Aabb::check`], with its index among these; none is then
    /// appended.
    pub fn extend(
        &mut self,
        boxes: impl IntoIterator<Item = Aabb<T>>,
    ) -> Result<(), VolumeErrorAt> {
        let before = self.len;
        for (index, volume) in boxes.into_iter().enumerate() {
            if let Err(error) = self.push(volume) {
                self.truncate(before);
                return Err(VolumeErrorAt { index, error });
            }
        }
        Ok(())
    }

    /// Removes the box at an index and returns it; the last box takes its place.
    ///
    /// ```
    /// use frusta::Aabb;
    /// use frusta::cull::BoxSet;
    /// let mut set = BoxSet::new((0..3_u8).map(|x| Aabb::new([f32::from(x); 3], [9.0; 3])))?;
    /// assert_eq!(set.swap_remove(0).min.x, 0.0);
    /// assert!(set.iter().map(|b| b.min.x).eq([2.0, 1.0]));
    /// # Ok::<(), frusta::cull::VolumeErrorAt>(())
    /// ```
    ///
    /// # Panics
    /// If the index is not below the length.
    pub fn swap_remove(&mut self, index: usize) -> Aabb<T> {
        let len = self.len;
        assert!(index < len, "the index is {index} but the length is {len}");
        let stored = Stored::from(&*self);
        let (removed, last) = (stored.get(index), stored.get(len - 1));
        self.put(index, last.unwrap_or_default());
        self.truncate(len - 1);
        removed.unwrap_or_default()
    }

    /// Removes all boxes from an index on.
    fn truncate(&mut self, len: usize) {
        let blocks = len.div_ceil(BLOCK);
        for index in len..self.len.min(blocks * BLOCK) {
            self.put(index, Aabb::default());
        }
        self.blocks.truncate(blocks);
        self.largest.truncate(blocks);
        self.len = len;
    }

    /// The boxes in order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Aabb<T>> + ExactSizeIterator + '_ {
        let stored = Stored::from(self);
        (0..self.len).map(move |index| {
            let [x0, y0, z0, x1, y1, z1] = stored.components(index);
            Aabb::new([x0, y0, z0], [x1, y1, z1])
        })
    }

    /// Removes all boxes and keeps the memory.
    pub fn clear(&mut self) {
        self.len = 0;
        self.blocks.clear();
        self.largest.clear();
    }

    fn put(&mut self, index: usize, Aabb { min, max }: Aabb<T>) {
        let (block, place) = (index / BLOCK, index % BLOCK);
        let components = [min.x, min.y, min.z, max.x, max.y, max.z];
        let largest = &mut self.largest[block];
        let mut was_largest = false;
        for (eight, component) in self.blocks[block][place / 8].iter_mut().zip(components) {
            was_largest |= eight[place % 8].abs() >= *largest;
            eight[place % 8] = component;
        }
        let greater = |a: T, b: &T| if b.abs() > a { b.abs() } else { a };
        *largest = if was_largest {
            let all = self.blocks[block].as_flattened().as_flattened();
            all.iter().fold(T::ZERO, greater)
        } else {
            components.iter().fold(*largest, greater)
        };
    }
}

/// The boxes of a [`BoxSet`], or a range of them.
#[derive(Clone, Copy, Debug)]
pub struct Stored<'a, T> {
    len: usize,
    blocks: &'a [Block<T, 6>],
    largest: &'a [T],
}

impl<'a, T> From<&'a BoxSet<T>> for Stored<'a, T> {
    fn from(set: &'a BoxSet<T>) -> Self {
        Self {
            len: set.len,
            blocks: &set.blocks,
            largest: &set.largest,
        }
    }
}

impl<'a, T: Real> Stored<'a, T> {
    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn get(&self, index: usize) -> Option<Aabb<T>> {
        (index < self.len).then(|| {
            let [x0, y0, z0, x1, y1, z1] = self.components(index);
            Aabb::new([x0, y0, z0], [x1, y1, z1])
        })
    }

    /// The components of a box.
    pub(super) fn components(&self, index: usize) -> [T; 6] {
        let eight = &self.blocks[index / BLOCK][index % BLOCK / 8];
        let i = index % 8;
        [
            eight[0][i],
            eight[1][i],
            eight[2][i],
            eight[3][i],
            eight[4][i],
            eight[5][i],
        ]
    }

    /// The block whose first box is at `start`, and the largest magnitude in it.
    #[inline(always)]
    pub(super) fn block(&self, start: usize) -> Option<(&'a Block<T, 6>, T)> {
        let k = start / BLOCK;
        Some((self.blocks.get(k)?, *self.largest.get(k)?))
    }
}
