//! Axis-aligned boxes, a register of them at a time.
//!
//! # Idea
//! A face's function is greatest at the corner farthest along its normal, least at the
//! opposite one. Which number of a box is a corner's coordinate depends on the face
//! alone: for a face it is chosen once.
//! ```text
//! for each block of 256 boxes:
//!     whether they are boxes, and the largest number    of a BoxSet known before
//!     near and far, which have one normal; left         greatest values, least ones if
//!     right, bottom, top                                asked for; of all the least:
//!     outside if the least of the greatest is negative, inside if no least one is
//! ```
//! A pass has as many faces as registers hold numbers of. No branch depends on a box. What
//! the threshold does not settle is told by bits.
//!
//! # The error bound
//! In units of u, S >= |p_x| + |p_y| + |p_z| of a corner, |n_j| < 1: a number 1, the
//! product 1, sums 3: 5.01 S + 4.01 |d|. The threshold has 8 of S and of the largest
//! |d|. It is the same for a block: S is three times the largest magnitude in it. Sums
//! that are fused with their products are rounded less often; classes are the exact ones
//! with or without.
//!
//! If S is finite no sum overflows: |n_j| < 1, and |d| is far below the largest number.
//! A block with NaN or with `min > max` is settled one by one, which finds it; with an
//! infinity S is infinite.
//!
//! # Turned down
//! Middle and half extents in V/W's frame (nine products each, then one half-width for
//! two sides): more operations than corners have, and a turned box reaches farther in
//! the frame than it does, which would be more boxes to look at again.

use super::block_driver::{BLOCK, Block, BlockBits, Volumes, WORD, Words, load};
use super::box_set::{BoxBlocks, BoxSet};
use crate::cull::{Aabb, Volume};
use crate::frustum::eval::planes::{FacePlanes, Plane};
use crate::math::{Real, Vec3};
use crate::simd::plane_lanes::PlaneLanes;
use fearless_simd::prelude::*;
#[cfg(feature = "parallel")]
use std::ops::Range;

/// Boxes in six arrays, in one, or in a [`BoxSet`].
///
/// ```
/// use frusta::cull::{BoxArrays, Boxes};
/// use frusta::Aabb;
/// let (low, high) = ([0.0_f32, 1.0, 2.0], [1.0, 2.0, 3.0]);
/// let arrays = Boxes::from(BoxArrays { min: [&low, &low, &low], max: [&high, &high, &high] });
/// assert_eq!(arrays.len(), 3);
/// assert_eq!(arrays.get(1), Some(Aabb::new([1.0; 3], [2.0; 3])));
/// let boxes = [Aabb::new([0.0_f32; 3], [1.0; 3])];
/// assert_eq!(Boxes::from(&boxes[..]).len(), 1);
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Boxes<'a, T> {
    /// Structure of arrays: faster than structures.
    Arrays(BoxArrays<'a, T>),
    /// Array of structures.
    Slice(&'a [Aabb<T>]),
    /// Boxes that are kept: faster than arrays.
    Set(BoxBlocks<'a, T>),
}

/// Boxes as six arrays of one length; of longer ones only the beginning counts.
#[derive(Clone, Copy, Debug)]
pub struct BoxArrays<'a, T> {
    /// Least x, y and z of each.
    pub min: [&'a [T]; 3],
    /// Greatest x, y and z of each.
    pub max: [&'a [T]; 3],
}

impl<'a, T> From<BoxArrays<'a, T>> for Boxes<'a, T> {
    fn from(arrays: BoxArrays<'a, T>) -> Self {
        Boxes::Arrays(arrays)
    }
}

impl<'a, T> From<&'a [Aabb<T>]> for Boxes<'a, T> {
    fn from(boxes: &'a [Aabb<T>]) -> Self {
        Boxes::Slice(boxes)
    }
}

impl<'a, T> From<&'a Vec<Aabb<T>>> for Boxes<'a, T> {
    fn from(boxes: &'a Vec<Aabb<T>>) -> Self {
        Boxes::Slice(boxes)
    }
}

impl<'a, T> From<&'a BoxSet<T>> for Boxes<'a, T> {
    fn from(set: &'a BoxSet<T>) -> Self {
        Boxes::Set(set.into())
    }
}

impl<T: Real> Boxes<'_, T> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => {
                let all = min.iter().chain(max).map(|a| a.len());
                all.min().unwrap_or(0)
            }
            Boxes::Slice(boxes) => boxes.len(),
            Boxes::Set(set) => set.len(),
        }
    }

    /// Some of them, of as many as there are.
    #[cfg(feature = "parallel")]
    pub(super) fn part(&self, range: Range<usize>) -> Self {
        match *self {
            Boxes::Arrays(BoxArrays { min, max }) => Boxes::Arrays(BoxArrays {
                min: min.map(|array| &array[range.clone()]),
                max: max.map(|array| &array[range.clone()]),
            }),
            Boxes::Slice(boxes) => Boxes::Slice(&boxes[range]),
            Boxes::Set(set) => Boxes::Set(set.part(range)),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of them.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Aabb<T>> {
        let of = |arrays: &[&[T]; 3]| {
            let [x, y, z] = arrays.map(|a| a.get(index).copied());
            Some(Vec3::new(x?, y?, z?))
        };
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => Some(Aabb {
                min: of(min)?,
                max: of(max)?,
            }),
            Boxes::Slice(boxes) => boxes.get(index).copied(),
            Boxes::Set(set) => set.get(index),
        }
    }
}

impl<T: Real> Volumes<T, 6> for Boxes<'_, T> {
    fn len(&self) -> usize {
        self.len()
    }

    fn volume(&self, index: usize) -> Option<Volume> {
        self.get(index).map(Volume::from)
    }

    #[inline(always)]
    fn block(&self, start: usize) -> Option<(&Block<T, 6>, T)> {
        match self {
            Boxes::Set(set) => set.block(start),
            _ => None,
        }
    }

    #[inline(always)]
    fn arrays(&self) -> Option<[&[T]; 6]> {
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => {
                Some([min[0], min[1], min[2], max[0], max[1], max[2]])
            }
            _ => None,
        }
    }

    #[inline(always)]
    fn numbers(&self, index: usize) -> [T; 6] {
        let Aabb { min, max } = self.get(index).unwrap_or_default();
        [min.x, min.y, min.z, max.x, max.y, max.z]
    }

    #[inline(always)]
    fn words<S, V, const N: usize, const INSIDE: bool>(
        simd: S,
        rows: &FacePlanes<T>,
        block: &Block<T, 6>,
        largest: Option<T>,
    ) -> Words
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let (largest, is_valid) = match largest {
            Some(largest) => (largest, true),
            None => check::<S, V, T, N>(simd, block),
        };
        let threshold = rows.threshold(largest + largest + largest, is_valid);
        let mut greatest = [T::ZERO; BLOCK];
        let mut least = [T::ZERO; BLOCK];
        first::<S, V, T, N, INSIDE>(simd, rows, block, &mut greatest, &mut least);
        let [_, sides @ ..] = &rows.sides;
        let of = |which: usize| sides.each_ref().map(|row| row.corners[which]);
        let [outside, within] = rest::<S, V, T, N>(simd, sides, block, of(0), &greatest, threshold);
        let mut words = [BlockBits::default(); BLOCK / WORD];
        if !INSIDE {
            for (k, word) in words.iter_mut().enumerate() {
                let [outside, within] = [&outside, &within].map(|bytes| joined::<N>(bytes, k));
                word.set::<WORD>(0, [outside, 0, outside | within]);
            }
            return words;
        }
        let [crossed, inside] = rest::<S, V, T, N>(simd, sides, block, of(1), &least, threshold);
        for (k, word) in words.iter_mut().enumerate() {
            let all = [&outside, &within, &crossed, &inside];
            let [outside, within, crossed, inside] = all.map(|bytes| joined::<N>(bytes, k));
            let inside = within & inside;
            word.set::<WORD>(0, [outside, inside, outside | inside | within & crossed]);
        }
        words
    }
}

/// A word from the bits of its groups, a byte each.
#[inline(always)]
fn joined<const N: usize>(bytes: &[u8; BLOCK / 4], word: usize) -> u64 {
    let groups = &bytes[word * (WORD / N)..][..WORD / N];
    if let (8, Ok(eight)) = (N, groups.try_into()) {
        return u64::from_le_bytes(eight);
    }
    let mut bits = 0;
    for (i, group) in groups.iter().enumerate() {
        bits |= u64::from(*group) << (i * N);
    }
    bits
}

/// The largest magnitude in a block, and whether all are boxes.
#[inline(always)]
fn check<S, V, T, const N: usize>(simd: S, block: &Block<T, 6>) -> (T, bool)
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let zero = V::splat(simd, T::ZERO);
    let (mut most, mut least) = (zero, zero);
    let mut valid = zero.simd_eq(zero);
    for group in 0..BLOCK / N {
        let low = [
            load::<S, V, T, N, 6>(simd, block, 0, group),
            load::<S, V, T, N, 6>(simd, block, 1, group),
            load::<S, V, T, N, 6>(simd, block, 2, group),
        ];
        let high = [
            load::<S, V, T, N, 6>(simd, block, 3, group),
            load::<S, V, T, N, 6>(simd, block, 4, group),
            load::<S, V, T, N, 6>(simd, block, 5, group),
        ];
        valid &= low[0].simd_le(high[0]) & low[1].simd_le(high[1]) & low[2].simd_le(high[2]);
        least = least.min(low[0].min(low[1]).min(low[2]));
        most = most.max(high[0].max(high[1]).max(high[2]));
    }
    let most = most.max(-least).to_array();
    let largest = most
        .into_iter()
        .fold(T::ZERO, |a, b| if b > a { b } else { a });
    (largest, valid.to_bitmask() == u64::MAX >> (64 - N))
}

/// Which numbers of a box are a corner's coordinates.
type Corner = [usize; 3];

/// The corners of a group.
#[inline(always)]
fn corners<S, V, T, const N: usize>(
    simd: S,
    block: &Block<T, 6>,
    corner: Corner,
    group: usize,
) -> [V; 3]
where
    S: Simd,
    V: SimdFloat<S, Element = T>,
{
    [
        load::<S, V, T, N, 6>(simd, block, corner[0], group),
        load::<S, V, T, N, 6>(simd, block, corner[1], group),
        load::<S, V, T, N, 6>(simd, block, corner[2], group),
    ]
}

/// A face's values at the corners of a group.
#[inline(always)]
fn values<S, V, T, const N: usize>(
    simd: S,
    plane: &PlaneLanes<V>,
    block: &Block<T, 6>,
    corner: Corner,
    group: usize,
) -> V
where
    S: Simd,
    V: SimdFloat<S, Element = T>,
{
    plane.along::<S>(
        &corners::<S, V, T, N>(simd, block, corner, group),
        plane.offset,
    )
}

/// Of each box the least over near, far and left of their greatest, and of their least
/// values.
#[inline(always)]
fn first<S, V, T, const N: usize, const INSIDE: bool>(
    simd: S,
    rows: &FacePlanes<T>,
    block: &Block<T, 6>,
    to_greatest: &mut [T; BLOCK],
    to_least: &mut [T; BLOCK],
) where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let (near, left) = (
        PlaneLanes::<V>::new(simd, &rows.near),
        PlaneLanes::<V>::new(simd, &rows.sides[0]),
    );
    let (far, zero) = (V::splat(simd, rows.far), V::splat(simd, T::ZERO));
    let [farthest, opposite] = rows.near.corners;
    let [left_farthest, left_opposite] = rows.sides[0].corners;
    for group in 0..BLOCK / N {
        let to = group * N..group * N + N;
        let along = near.along::<S>(&corners::<S, V, T, N>(simd, block, farthest, group), zero);
        let against = near.along::<S>(&corners::<S, V, T, N>(simd, block, opposite, group), zero);
        let side = values::<S, V, T, N>(simd, &left, block, left_farthest, group);
        // The far face's value is the sum of both offsets less the near one's.
        let greatest = (along + near.offset).min(far - against);
        greatest.min(side).store_slice(&mut to_greatest[to.clone()]);
        if INSIDE {
            let side = values::<S, V, T, N>(simd, &left, block, left_opposite, group);
            let least = (against + near.offset).min(far - along);
            least.min(side).store_slice(&mut to_least[to]);
        }
    }
}

/// With the values at corners of three more faces: a byte a group, in which the least is
/// certainly negative, and certainly positive.
#[inline(always)]
fn rest<S, V, T, const N: usize>(
    simd: S,
    rows: &[Plane<T>; 3],
    block: &Block<T, 6>,
    at: [Corner; 3],
    so_far: &[T; BLOCK],
    threshold: T,
) -> [[u8; BLOCK / 4]; 2]
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let [a, b, c] = rows;
    let [a, b, c] = [
        PlaneLanes::<V>::new(simd, a),
        PlaneLanes::<V>::new(simd, b),
        PlaneLanes::<V>::new(simd, c),
    ];
    let threshold = V::splat(simd, threshold);
    let mut bytes = [[0; BLOCK / 4]; 2];
    let [negative, positive] = &mut bytes;
    for group in 0..BLOCK / N {
        let least = V::from_slice(simd, &so_far[group * N..][..N])
            .min(values::<S, V, T, N>(simd, &a, block, at[0], group))
            .min(values::<S, V, T, N>(simd, &b, block, at[1], group))
            .min(values::<S, V, T, N>(simd, &c, block, at[2], group));
        negative[group] = least.simd_lt(-threshold).to_bitmask() as u8;
        positive[group] = least.simd_gt(threshold).to_bitmask() as u8;
    }
    bytes
}
