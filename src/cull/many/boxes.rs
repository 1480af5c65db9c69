//! The kernel for axis-aligned boxes, a register of them at a time.
//!
//! # Idea
//! A face's function is greatest at the corner farthest along its normal, and least at the
//! opposite corner. Which components of a box are that corner's coordinates depends on the
//! face alone, so they are chosen once for each face.
//! ```text
//! for each block of 256 boxes:
//!     check that min <= max, find the largest magnitude     (known before for a BoxSet)
//!     pass 1: near and far, which share a normal; left      least over the faces of the
//!     pass 2: right, bottom, top                            greatest and of the least values
//!     outside if the least greatest value is negative, inside if the least least one is not
//! ```
//! A pass has as many faces as fit in registers. No branch depends on a box. What the
//! threshold leaves open is marked as undecided.
//!
//! # Error bound
//! In units of u, with S >= |p_x| + |p_y| + |p_z| of a corner and |n_j| < 1: a component of
//! the normal is off by 1, the product by 1, three sums by 3: 5.01 S + 4.01 |d|. The
//! threshold is 8 S + 8 |d|, with the largest |d|. It is the same for a whole block: S is
//! three times the largest magnitude in it. Sums that are fused with their products are
//! rounded less often; the classes are exact with or without.
//!
//! If S is finite no sum overflows: |n_j| < 1, and |d| is far below the largest finite value.
//! A block with NaN or with `min > max` is classified one by one, which finds the error; with
//! an infinity S is infinite.
//!
//! # Rejected alternative
//! Middle and half extents in V/W's frame (nine products each, then one half-width for two
//! sides): it takes more operations than corners, and the box around a box turned into the
//! frame is larger, so more boxes are undecided.

use super::block_driver::{BLOCK, Block, BlockAnswers, BlockBits, Volumes, WORD, load};
use super::box_set::{BoxSet, Stored};
use crate::cull::{Aabb, Volume};
use crate::frustum::eval::plane_lanes::PlaneLanes;
use crate::frustum::eval::planes::{FacePlane, FacePlanes};
use crate::math::{Real, Vec3};
use fearless_simd::prelude::*;
#[cfg(feature = "parallel")]
use std::ops::Range;

/// Boxes as six arrays (structure of arrays), a source of a query.
///
/// The shortest array determines the number of boxes; the rest of longer ones is ignored.
///
/// ```
/// use frusta::cull::BoxArrays;
/// use frusta::{Culler, EndRect, Frustum, Pose, Shape};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let (low, high) = ([0.0_f32, 1.0, 8.0], [1.0, 2.0, 9.0]);
/// let boxes = BoxArrays { min: [&low; 3], max: [&high; 3] };
/// let mut visible = Vec::new();
/// Culler::new(&frustum).over(boxes).visible(&mut visible)?;
/// assert_eq!(visible, [0, 1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BoxArrays<'a, T> {
    /// The least x, y and z of each box.
    pub min: [&'a [T]; 3],
    /// The greatest x, y and z of each box.
    pub max: [&'a [T]; 3],
}

/// Boxes in one of three layouts.
#[derive(Clone, Copy, Debug)]
pub enum Boxes<'a, T> {
    Arrays(BoxArrays<'a, T>),
    Slice(&'a [Aabb<T>]),
    Set(Stored<'a, T>),
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

impl<'a, T, const N: usize> From<&'a [Aabb<T>; N]> for Boxes<'a, T> {
    fn from(boxes: &'a [Aabb<T>; N]) -> Self {
        Boxes::Slice(boxes)
    }
}

impl<'a, T> From<&'a BoxSet<T>> for Boxes<'a, T> {
    fn from(set: &'a BoxSet<T>) -> Self {
        Boxes::Set(set.into())
    }
}

impl<T: Real> Boxes<'_, T> {
    pub(super) fn len(&self) -> usize {
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => {
                let all = min.iter().chain(max).map(|a| a.len());
                all.min().unwrap_or(0)
            }
            Boxes::Slice(boxes) => boxes.len(),
            Boxes::Set(set) => set.len(),
        }
    }

    /// A range of the boxes.
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

    pub(super) fn get(&self, index: usize) -> Option<Aabb<T>> {
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
    fn components(&self, index: usize) -> [T; 6] {
        let Aabb { min, max } = self.get(index).unwrap_or_default();
        [min.x, min.y, min.z, max.x, max.y, max.z]
    }

    #[inline(always)]
    fn classify_block<S, V, const N: usize, const INSIDE: bool>(
        simd: S,
        planes: &FacePlanes<T>,
        block: &Block<T, 6>,
        largest: Option<T>,
    ) -> BlockAnswers
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let (largest, is_valid) = match largest {
            Some(largest) => (largest, true),
            None => check::<S, V, T, N>(simd, block),
        };
        let threshold = planes.threshold(largest + largest + largest, is_valid);
        let mut greatest = [T::ZERO; BLOCK];
        let mut least = [T::ZERO; BLOCK];
        first_faces::<S, V, T, N, INSIDE>(simd, planes, block, &mut greatest, &mut least);
        let [_, sides @ ..] = &planes.sides;
        let corners = |which: usize| sides.each_ref().map(|plane| plane.corners[which]);
        let [outside, within] =
            last_faces::<S, V, T, N>(simd, sides, block, corners(0), &greatest, threshold);
        let mut answers = [BlockBits::default(); BLOCK / WORD];
        if !INSIDE {
            for (k, bits) in answers.iter_mut().enumerate() {
                let [outside, within] = [&outside, &within].map(|bytes| joined::<N>(bytes, k));
                bits.set::<WORD>(0, [outside, 0, outside | within]);
            }
            return answers;
        }
        let [crossed, inside] =
            last_faces::<S, V, T, N>(simd, sides, block, corners(1), &least, threshold);
        for (k, bits) in answers.iter_mut().enumerate() {
            let all = [&outside, &within, &crossed, &inside];
            let [outside, within, crossed, inside] = all.map(|bytes| joined::<N>(bytes, k));
            let inside = within & inside;
            bits.set::<WORD>(0, [outside, inside, outside | inside | within & crossed]);
        }
        answers
    }
}

/// Joins the bits of a word's groups, a byte each.
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

/// The largest magnitude in a block, and whether all boxes have `min <= max`.
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

/// Which components of a box are a corner's coordinates.
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

/// Writes, for each box, the least over near, far and left of their greatest values, and of
/// their least ones.
#[inline(always)]
fn first_faces<S, V, T, const N: usize, const INSIDE: bool>(
    simd: S,
    planes: &FacePlanes<T>,
    block: &Block<T, 6>,
    to_greatest: &mut [T; BLOCK],
    to_least: &mut [T; BLOCK],
) where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let (near, left) = (
        PlaneLanes::<V>::new(simd, &planes.near),
        PlaneLanes::<V>::new(simd, &planes.sides[0]),
    );
    let (far, zero) = (V::splat(simd, planes.far), V::splat(simd, T::ZERO));
    let [farthest, opposite] = planes.near.corners;
    let [left_farthest, left_opposite] = planes.sides[0].corners;
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

/// Adds the values at corners of three more faces, and returns a byte a group: where the least
/// value is certainly negative, and where it is certainly positive.
#[inline(always)]
fn last_faces<S, V, T, const N: usize>(
    simd: S,
    planes: &[FacePlane<T>; 3],
    block: &Block<T, 6>,
    corners: [Corner; 3],
    so_far: &[T; BLOCK],
    threshold: T,
) -> [[u8; BLOCK / 4]; 2]
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let [a, b, c] = planes;
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
            .min(values::<S, V, T, N>(simd, &a, block, corners[0], group))
            .min(values::<S, V, T, N>(simd, &b, block, corners[1], group))
            .min(values::<S, V, T, N>(simd, &c, block, corners[2], group));
        negative[group] = least.simd_lt(-threshold).to_bitmask() as u8;
        positive[group] = least.simd_gt(threshold).to_bitmask() as u8;
    }
    bytes
}
