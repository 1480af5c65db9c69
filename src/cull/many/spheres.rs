//! SphereSeparation, a register of them at a time.
//!
//! # Idea
//! A face's function over a ball is its value at the middle, more or less the radius times
//! the normal's length. Near and far have one normal. As with [`super::boxes`], the least
//! over the faces decide, and no branch depends on a ball.
//!
//! # The error bound
//! In units of u, S >= |c_x| + |c_y| + |c_z|, |n_j| < 1 and so |n| < 1.74:
//! ```text
//! middle     a number 1, the product 1, sums 3, the offset's own rounding    5.01 S, 4.01 |d|
//! reach      the length 2, the product 1                                     5.22 r
//! extreme    the sum 1                                                       S + |d| + 1.74 r
//! ```
//! Below the threshold, 8 of S + r and of the largest |d|. S + r is three times the largest
//! magnitude of a coordinate in the block and the largest radius.
//!
//! A block with NaN or a negative radius is settled one by one, which finds it; with an
//! infinity S + r is infinite.

use super::block_driver::{BLOCK, Block, BlockBits, Volumes, WORD, Words, load};
use crate::cull::{Sphere, Volume};
use crate::frustum::eval::planes::{FacePlanes, Plane};
use crate::math::{Real, Vec3};
use fearless_simd::prelude::*;
#[cfg(feature = "parallel")]
use std::ops::Range;

/// SphereSeparation in four arrays, or in one.
#[derive(Clone, Copy, Debug)]
pub enum Spheres<'a, T> {
    /// Structure of arrays: fastest.
    Arrays(SphereArrays<'a, T>),
    /// Array of structures.
    Slice(&'a [Sphere<T>]),
}

/// SphereSeparation as four arrays of one length; of longer ones only the beginning counts.
#[derive(Clone, Copy, Debug)]
pub struct SphereArrays<'a, T> {
    /// x, y and z of each middle.
    pub center: [&'a [T]; 3],
    /// The radius of each.
    pub radius: &'a [T],
}

impl<'a, T> From<SphereArrays<'a, T>> for Spheres<'a, T> {
    fn from(arrays: SphereArrays<'a, T>) -> Self {
        Spheres::Arrays(arrays)
    }
}

impl<'a, T> From<&'a [Sphere<T>]> for Spheres<'a, T> {
    fn from(spheres: &'a [Sphere<T>]) -> Self {
        Spheres::Slice(spheres)
    }
}

impl<'a, T> From<&'a Vec<Sphere<T>>> for Spheres<'a, T> {
    fn from(spheres: &'a Vec<Sphere<T>>) -> Self {
        Spheres::Slice(spheres)
    }
}

impl<T: Real> Spheres<'_, T> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => {
                let all = center.iter().map(|a| a.len());
                all.fold(radius.len(), usize::min)
            }
            Spheres::Slice(spheres) => spheres.len(),
        }
    }

    /// Some of them, of as many as there are.
    #[cfg(feature = "parallel")]
    pub(super) fn part(&self, range: Range<usize>) -> Self {
        match *self {
            Spheres::Arrays(SphereArrays { center, radius }) => Spheres::Arrays(SphereArrays {
                center: center.map(|array| &array[range.clone()]),
                radius: &radius[range],
            }),
            Spheres::Slice(spheres) => Spheres::Slice(&spheres[range]),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of them.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Sphere<T>> {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => {
                let [x, y, z] = center.map(|a| a.get(index).copied());
                Some(Sphere {
                    center: Vec3::new(x?, y?, z?),
                    radius: *radius.get(index)?,
                })
            }
            Spheres::Slice(spheres) => spheres.get(index).copied(),
        }
    }
}

impl<T: Real> Volumes<T, 4> for Spheres<'_, T> {
    fn len(&self) -> usize {
        self.len()
    }

    fn volume(&self, index: usize) -> Option<Volume> {
        self.get(index).map(Volume::from)
    }

    fn block(&self, _: usize) -> Option<(&Block<T, 4>, T)> {
        None
    }

    #[inline(always)]
    fn arrays(&self) -> Option<[&[T]; 4]> {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => {
                Some([center[0], center[1], center[2], radius])
            }
            Spheres::Slice(_) => None,
        }
    }

    #[inline(always)]
    fn numbers(&self, index: usize) -> [T; 4] {
        let Sphere { center, radius } = self.get(index).unwrap_or_default();
        [center.x, center.y, center.z, radius]
    }

    #[inline(always)]
    fn words<S, V, const N: usize, const INSIDE: bool>(
        simd: S,
        rows: &FacePlanes<T>,
        block: &Block<T, 4>,
        _: Option<T>,
    ) -> Words
    where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let threshold = threshold::<S, V, T, N>(simd, rows, block);
        let mut words = [BlockBits::default(); BLOCK / WORD];
        for (k, word) in words.iter_mut().enumerate() {
            for group in 0..WORD / N {
                let ball = ball::<S, V, T, N>(simd, block, k * (WORD / N) + group);
                let masks = extremes::<S, V, T, INSIDE>(simd, rows, ball, threshold);
                word.set::<N>(group * N, masks);
            }
        }
        words
    }
}

/// The numbers of a group.
#[inline(always)]
fn ball<S, V, T, const N: usize>(simd: S, block: &Block<T, 4>, group: usize) -> [V; 4]
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

/// The block's threshold: infinite if one of it is no ball.
#[inline(always)]
fn threshold<S, V, T, const N: usize>(simd: S, rows: &FacePlanes<T>, block: &Block<T, 4>) -> T
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    let zero = V::splat(simd, T::ZERO);
    let (mut most, mut radius) = (zero, zero);
    let mut valid = zero.simd_eq(zero);
    for group in 0..BLOCK / N {
        let [x, y, z, r] = ball::<S, V, T, N>(simd, block, group);
        most = most.max(x.abs().max(y.abs()).max(z.abs()));
        radius = radius.max(r);
        // A maximum may forget what it was when it meets NaN.
        valid &= r.simd_ge(zero) & x.simd_eq(x) & y.simd_eq(y) & z.simd_eq(z);
    }
    let size = most + most + most + radius;
    let largest = size.to_array().into_iter();
    let size = largest.fold(T::ZERO, |a, b| if b > a { b } else { a });
    let is_valid = valid.to_bitmask() == u64::MAX >> (64 - N);
    rows.threshold(size, is_valid)
}

/// The value at the middle, and the reach.
#[inline(always)]
fn middle_and_reach<S, V, T>(simd: S, row: &Plane<T>, ball: &[V; 4]) -> [V; 2]
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T>,
{
    let all = |v: T| V::splat(simd, v);
    let [x, y, z] = row.normal;
    let sum = ball[2].mul_add(all(z), all(row.offset));
    let sum = ball[1].mul_add(all(y), sum);
    [ball[0].mul_add(all(x), sum), ball[3] * row.length]
}

/// Bits of the balls that are certainly outside, certainly inside, and of a certain class.
#[inline(always)]
fn extremes<S, V, T, const INSIDE: bool>(
    simd: S,
    rows: &FacePlanes<T>,
    ball: [V; 4],
    threshold: T,
) -> [u64; 3]
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T>,
{
    let from_zero = Plane {
        offset: T::ZERO,
        ..rows.near
    };
    let [along, reach] = middle_and_reach(simd, &from_zero, &ball);
    let nearest = (along + rows.near.offset).min(V::splat(simd, rows.far) - along);
    let (mut greatest, mut least) = (nearest + reach, nearest - reach);
    for row in &rows.sides {
        let [middle, reach] = middle_and_reach(simd, row, &ball);
        greatest = greatest.min(middle + reach);
        if INSIDE {
            least = least.min(middle - reach);
        }
    }
    let outside = greatest.simd_lt(-threshold);
    let within = greatest.simd_gt(threshold);
    if INSIDE {
        let inside = within & least.simd_gt(threshold);
        let settled = outside | inside | within & least.simd_lt(-threshold);
        [
            outside.to_bitmask(),
            inside.to_bitmask(),
            settled.to_bitmask(),
        ]
    } else {
        [outside.to_bitmask(), 0, (outside | within).to_bitmask()]
    }
}
