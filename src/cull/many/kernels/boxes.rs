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

use crate::cull::many::block_driver::{BLOCK, Block, BlockAnswers, BlockBits, Kernel, WORD, load};
use crate::frustum::eval::plane_lanes::PlaneLanes;
use crate::frustum::eval::planes::{FacePlane, FacePlanes};
use crate::math::{PerReal, Real};
use crate::simd::at_width;
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, f64x4};

/// The kernels of both scalar types.
pub(in crate::cull::many) struct Boxes;

impl PerReal for Boxes {
    type Of<T: Real> = Kernel<T, 6>;

    fn single(&self) -> &Kernel<f32, 6> {
        &(classify_f32 as _)
    }

    fn double(&self) -> &Kernel<f64, 6> {
        &(classify_f64 as _)
    }
}

pub(in crate::cull::many) fn classify_f32(
    level: Level,
    planes: &FacePlanes<f32>,
    block: &Block<f32, 6>,
    largest: Option<f32>,
    inside: bool,
) -> BlockAnswers {
    at_width!(level, simd => match inside {
        true => classify::<_, f32x8<_>, f32, 8, true>(simd, planes, block, largest),
        false => classify::<_, f32x8<_>, f32, 8, false>(simd, planes, block, largest),
    })
}

fn classify_f64(
    level: Level,
    planes: &FacePlanes<f64>,
    block: &Block<f64, 6>,
    largest: Option<f64>,
    inside: bool,
) -> BlockAnswers {
    at_width!(level, simd => match inside {
        true => classify::<_, f64x4<_>, f64, 4, true>(simd, planes, block, largest),
        false => classify::<_, f64x4<_>, f64, 4, false>(simd, planes, block, largest),
    })
}

/// Classifies a block, a register at a time; without INSIDE only *outside* is decided. The
/// largest magnitude is given if all volumes are known to be valid.
#[inline(always)]
fn classify<S, V, T, const N: usize, const INSIDE: bool>(
    simd: S,
    planes: &FacePlanes<T>,
    block: &Block<T, 6>,
    largest: Option<T>,
) -> BlockAnswers
where
    S: Simd,
    T: Real,
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
