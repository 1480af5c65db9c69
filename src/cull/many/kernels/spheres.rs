//! The kernel for spheres, a register of them at a time.
//!
//! # Idea
//! The extremes of a face's function over a sphere are its value at the center plus and minus
//! the radius times the normal's length. Near and far share a normal. As for
//! [boxes](super::boxes), the least extremes over the faces decide, and no branch depends on a
//! sphere.
//!
//! # Error bound
//! In units of u, with S >= |c_x| + |c_y| + |c_z| and |n_j| < 1, so |n| < 1.74:
//! ```text
//! center     component 1, product 1, sums 3; the offset's rounding    5.01 S + 4.01 |d|
//! reach      length 2, product 1                                      5.22 r
//! extreme    sum 1                                                    S + |d| + 1.74 r
//! ```
//! In all 6.01 S + 5.01 |d| + 6.96 r. The threshold is 8 (S + r) + 8 |d|, with the largest |d|;
//! S + r is three times the largest magnitude of a coordinate in the block plus the largest
//! radius.
//!
//! A block with NaN or a negative radius is classified one by one, which finds the error; with
//! an infinity S + r is infinite.

use crate::cull::many::block_driver::{BLOCK, Block, BlockAnswers, BlockBits, Kernel, WORD, load};
use crate::frustum::eval::planes::{FacePlane, FacePlanes};
use crate::math::{PerReal, Real};
use crate::simd::at_width;
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, f64x4};

/// The kernels of both scalar types.
pub(in crate::cull::many) struct Spheres;

impl PerReal for Spheres {
    type Of<T: Real> = Kernel<T, 4>;

    fn single(&self) -> &Kernel<f32, 4> {
        &(classify_f32 as _)
    }

    fn double(&self) -> &Kernel<f64, 4> {
        &(classify_f64 as _)
    }
}

fn classify_f32(
    level: Level,
    planes: &FacePlanes<f32>,
    block: &Block<f32, 4>,
    _: Option<f32>,
    inside: bool,
) -> BlockAnswers {
    at_width!(level, simd => match inside {
        true => classify::<_, f32x8<_>, f32, 8, true>(simd, planes, block),
        false => classify::<_, f32x8<_>, f32, 8, false>(simd, planes, block),
    })
}

fn classify_f64(
    level: Level,
    planes: &FacePlanes<f64>,
    block: &Block<f64, 4>,
    _: Option<f64>,
    inside: bool,
) -> BlockAnswers {
    at_width!(level, simd => match inside {
        true => classify::<_, f64x4<_>, f64, 4, true>(simd, planes, block),
        false => classify::<_, f64x4<_>, f64, 4, false>(simd, planes, block),
    })
}

/// Classifies a block, a register at a time; without INSIDE only *outside* is decided.
#[inline(always)]
fn classify<S, V, T, const N: usize, const INSIDE: bool>(
    simd: S,
    planes: &FacePlanes<T>,
    block: &Block<T, 4>,
) -> BlockAnswers
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let threshold = threshold::<S, V, T, N>(simd, planes, block);
    let mut answers = [BlockBits::default(); BLOCK / WORD];
    for (k, bits) in answers.iter_mut().enumerate() {
        for group in 0..WORD / N {
            let sphere = sphere::<S, V, T, N>(simd, block, k * (WORD / N) + group);
            let masks = extremes::<S, V, T, INSIDE>(simd, planes, sphere, threshold);
            bits.set::<N>(group * N, masks);
        }
    }
    answers
}

/// The components of a group.
#[inline(always)]
fn sphere<S, V, T, const N: usize>(simd: S, block: &Block<T, 4>, group: usize) -> [V; 4]
where
    S: Simd,
    V: SimdFloat<S, Element = T>,
{
    [
        load::<S, V, T, N, 4>(simd, block, 0, group),
        load::<S, V, T, N, 4>(simd, block, 1, group),
        load::<S, V, T, N, 4>(simd, block, 2, group),
        load::<S, V, T, N, 4>(simd, block, 3, group),
    ]
}

/// The block's threshold: infinite if a sphere of the block is invalid.
#[inline(always)]
fn threshold<S, V, T, const N: usize>(simd: S, planes: &FacePlanes<T>, block: &Block<T, 4>) -> T
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let zero = V::splat(simd, T::ZERO);
    let (mut most, mut radius) = (zero, zero);
    let mut valid = zero.simd_eq(zero);
    for group in 0..BLOCK / N {
        let [x, y, z, r] = sphere::<S, V, T, N>(simd, block, group);
        most = most.max(x.abs().max(y.abs()).max(z.abs()));
        radius = radius.max(r);
        // A maximum may lose its value when it meets NaN.
        valid &= r.simd_ge(zero) & x.simd_eq(x) & y.simd_eq(y) & z.simd_eq(z);
    }
    let size = most + most + most + radius;
    let largest = size.to_array().into_iter();
    let size = largest.fold(T::ZERO, |a, b| if b > a { b } else { a });
    let is_valid = valid.to_bitmask() == u64::MAX >> (64 - N);
    planes.threshold(size, is_valid)
}

/// The value at the center, and the reach.
#[inline(always)]
fn center_and_reach<S, V, T>(simd: S, plane: &FacePlane<T>, sphere: &[V; 4]) -> [V; 2]
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T>,
{
    let splat = |v: T| V::splat(simd, v);
    let [x, y, z] = plane.normal;
    let sum = sphere[2].mul_add(splat(z), splat(plane.offset));
    let sum = sphere[1].mul_add(splat(y), sum);
    [sphere[0].mul_add(splat(x), sum), sphere[3] * plane.length]
}

/// The bits of the spheres that are certainly outside, certainly inside, and of a certain class.
#[inline(always)]
fn extremes<S, V, T, const INSIDE: bool>(
    simd: S,
    planes: &FacePlanes<T>,
    sphere: [V; 4],
    threshold: T,
) -> [u64; 3]
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T>,
{
    let from_zero = FacePlane {
        offset: T::ZERO,
        ..planes.near
    };
    let [along, reach] = center_and_reach(simd, &from_zero, &sphere);
    let nearest = (along + planes.near.offset).min(V::splat(simd, planes.far) - along);
    let (mut greatest, mut least) = (nearest + reach, nearest - reach);
    for plane in &planes.sides {
        let [center, reach] = center_and_reach(simd, plane, &sphere);
        greatest = greatest.min(center + reach);
        if INSIDE {
            least = least.min(center - reach);
        }
    }
    let outside = greatest.simd_lt(-threshold);
    let within = greatest.simd_gt(threshold);
    if INSIDE {
        let inside = within & least.simd_gt(threshold);
        let decided = outside | inside | within & least.simd_lt(-threshold);
        [
            outside.to_bitmask(),
            inside.to_bitmask(),
            decided.to_bitmask(),
        ]
    } else {
        [outside.to_bitmask(), 0, (outside | within).to_bitmask()]
    }
}
