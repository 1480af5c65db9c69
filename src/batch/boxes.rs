//! Axis-aligned boxes, a register of them at a time.
//!
//! # Idea
//! A face's function is greatest at the corner farthest along its normal, least at the
//! opposite one. Which number of a box is a corner's coordinate depends on the face
//! alone: for a face it is chosen once which of the six arrays to read.
//! ```text
//! for each block of 512 boxes:
//!     near and far, which have one normal    its products with both corners
//!     left and right; bottom and top         greatest values, least ones if asked for
//!     of all faces the least: outside if the least of the greatest is negative, inside
//!     if no least one is
//! ```
//! No branch depends on a box. What the threshold does not settle is told by bits.
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

use super::words::{BLOCK, Lot, WORD, Word, Words};
use crate::math::{Real, Vec3};
use crate::volume::{Aabb, Row, Rows, Volume};
use fearless_simd::prelude::*;

/// Boxes in six arrays, or in one.
///
/// ```
/// use frusta::batch::{BoxArrays, Boxes};
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
    /// Structure of arrays: fastest.
    Arrays(BoxArrays<'a, T>),
    /// Array of structures.
    Slice(&'a [Aabb<T>]),
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
        }
    }
}

impl<T: Real> Lot<T, 6> for Boxes<'_, T> {
    fn len(&self) -> usize {
        self.len()
    }

    fn volume(&self, index: usize) -> Option<Volume> {
        self.get(index).map(Volume::from)
    }

    #[inline(always)]
    fn arrays(&self) -> Option<[&[T]; 6]> {
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => {
                Some([min[0], min[1], min[2], max[0], max[1], max[2]])
            }
            Boxes::Slice(_) => None,
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
        rows: &Rows<T>,
        block: [&[T; BLOCK]; 6],
    ) -> Words
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let mut values = Extremes::<T, INSIDE>::new();
        let threshold = values.ends::<S, V, N>(simd, rows, &block);
        values.sides::<S, V, N>(simd, &rows.sides[..2], &block);
        values.sides::<S, V, N>(simd, &rows.sides[2..], &block);
        values.words::<S, V, N>(simd, threshold)
    }
}

/// Of each box in a block the least over the faces of their greatest, and of their least
/// values.
struct Extremes<T, const INSIDE: bool> {
    greatest: [T; BLOCK],
    least: [T; BLOCK],
}

/// Which arrays have the corner farthest along a normal, and which the opposite one.
#[inline(always)]
fn corners<'a, T>(row: &Row<T>, block: &[&'a [T; BLOCK]; 6]) -> [[&'a [T; BLOCK]; 3]; 2] {
    let pick = |up: bool, axis: usize| block[axis + if up { 3 } else { 0 }];
    let [a, b, c] = row.up;
    [
        [pick(a, 0), pick(b, 1), pick(c, 2)],
        [pick(!a, 0), pick(!b, 1), pick(!c, 2)],
    ]
}

/// `n . p + d` for the points of a group.
#[inline(always)]
fn value<S, V, T, const N: usize>(
    n: &[V; 3],
    d: V,
    simd: S,
    p: &[&[T; BLOCK]; 3],
    group: usize,
) -> V
where
    S: Simd,
    V: SimdFloat<S, Element = T>,
{
    let at = |axis: usize| V::from_slice(simd, &p[axis][group * N..][..N]);
    at(0).mul_add(n[0], at(1).mul_add(n[1], at(2).mul_add(n[2], d)))
}

impl<T: Real, const INSIDE: bool> Extremes<T, INSIDE> {
    #[inline(always)]
    fn new() -> Self {
        Self {
            greatest: [T::ZERO; BLOCK],
            least: [T::ZERO; BLOCK],
        }
    }

    /// Near and far, and the block's threshold: infinite if one of it is no box.
    #[inline(always)]
    fn ends<S, V, const N: usize>(&mut self, simd: S, rows: &Rows<T>, block: &[&[T; BLOCK]; 6]) -> T
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let all = |v: T| V::splat(simd, v);
        let row = &rows.near;
        let n = [all(row.normal[0]), all(row.normal[1]), all(row.normal[2])];
        let [farthest, opposite] = corners(row, block);
        // The far face's value is the sum of both offsets less the near one's.
        let (near, far, zero) = (all(row.offset), all(rows.far), all(T::ZERO));
        let (mut most, mut least) = (zero, zero);
        let mut valid = zero.simd_eq(zero);
        for group in 0..BLOCK / N {
            let at = |k: usize| V::from_slice(simd, &block[k][group * N..][..N]);
            let low = [at(0), at(1), at(2)];
            let high = [at(3), at(4), at(5)];
            valid &= low[0].simd_le(high[0]) & low[1].simd_le(high[1]) & low[2].simd_le(high[2]);
            least = least.min(low[0].min(low[1]).min(low[2]));
            most = most.max(high[0].max(high[1]).max(high[2]));
            let along = value::<S, V, T, N>(&n, zero, simd, &farthest, group);
            let against = value::<S, V, T, N>(&n, zero, simd, &opposite, group);
            let at = group * N..group * N + N;
            let greatest = (along + near).min(far - against);
            greatest.store_slice(&mut self.greatest[at.clone()]);
            if INSIDE {
                (against + near)
                    .min(far - along)
                    .store_slice(&mut self.least[at]);
            }
        }
        let most = most.max(-least).to_array();
        let largest = most
            .into_iter()
            .fold(T::ZERO, |a, b| if b > a { b } else { a });
        let size = largest + largest + largest;
        let is_valid = valid.to_bitmask() == u64::MAX >> (64 - N);
        rows.threshold(size, is_valid)
    }

    /// Two more faces.
    #[inline(always)]
    fn sides<S, V, const N: usize>(&mut self, simd: S, rows: &[Row<T>], block: &[&[T; BLOCK]; 6])
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let [first, second] = rows else { return };
        let all = |v: T| V::splat(simd, v);
        let splat = |n: &[T; 3]| [all(n[0]), all(n[1]), all(n[2])];
        let (a, a_offset) = (splat(&first.normal), all(first.offset));
        let (b, b_offset) = (splat(&second.normal), all(second.offset));
        let [a_farthest, a_opposite] = corners(first, block);
        let [b_farthest, b_opposite] = corners(second, block);
        for group in 0..BLOCK / N {
            let at = group * N..group * N + N;
            let a_value = value::<S, V, T, N>(&a, a_offset, simd, &a_farthest, group);
            let b_value = value::<S, V, T, N>(&b, b_offset, simd, &b_farthest, group);
            let so_far = V::from_slice(simd, &self.greatest[at.clone()]);
            let greatest = so_far.min(a_value.min(b_value));
            greatest.store_slice(&mut self.greatest[at.clone()]);
            if INSIDE {
                let a_value = value::<S, V, T, N>(&a, a_offset, simd, &a_opposite, group);
                let b_value = value::<S, V, T, N>(&b, b_offset, simd, &b_opposite, group);
                let so_far = V::from_slice(simd, &self.least[at.clone()]);
                so_far
                    .min(a_value.min(b_value))
                    .store_slice(&mut self.least[at]);
            }
        }
    }

    /// What that proves.
    #[inline(always)]
    fn words<S, V, const N: usize>(&self, simd: S, threshold: T) -> Words
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let mut words = [Word::default(); BLOCK / WORD];
        for (k, word) in words.iter_mut().enumerate() {
            for group in 0..WORD / N {
                let at = k * WORD + group * N;
                let greatest = V::from_slice(simd, &self.greatest[at..at + N]);
                let outside = greatest.simd_lt(-threshold);
                let within = greatest.simd_gt(threshold);
                let bits = if INSIDE {
                    let least = V::from_slice(simd, &self.least[at..at + N]);
                    let inside = within & least.simd_gt(threshold);
                    let settled = outside | inside | within & least.simd_lt(-threshold);
                    [
                        outside.to_bitmask(),
                        inside.to_bitmask(),
                        settled.to_bitmask(),
                    ]
                } else {
                    [outside.to_bitmask(), 0, (outside | within).to_bitmask()]
                };
                word.set::<N>(group * N, bits);
            }
        }
        words
    }
}
