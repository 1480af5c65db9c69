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

use super::block_driver::{BLOCK, Block, BlockAnswers, BlockBits, Volumes, WORD, load};
use crate::cull::{Sphere, Volume};
use crate::frustum::eval::planes::{FacePlane, FacePlanes};
use crate::math::{Real, Vec3};
use fearless_simd::prelude::*;
#[cfg(feature = "parallel")]
use std::ops::Range;

/// Spheres as four arrays (structure of arrays), a source of a query.
///
/// The shortest array determines the number of spheres; the rest of longer ones is ignored.
///
/// ```
/// use frusta::cull::SphereArrays;
/// use frusta::{Culler, EndRect, Frustum, Pose, Shape};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let (zero, z, radius) = ([0.0; 2], [2.0, 5.0], [0.5, 1.0]);
/// let spheres = SphereArrays { center: [&zero, &zero, &z], radius: &radius };
/// let mut visible = Vec::new();
/// Culler::new(&frustum).over(spheres).visible(&mut visible)?;
/// assert_eq!(visible, [0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SphereArrays<'a, T> {
    /// The x, y and z of each center.
    pub center: [&'a [T]; 3],
    /// The radius of each sphere.
    pub radius: &'a [T],
}

/// Spheres in one of two layouts.
#[derive(Clone, Copy, Debug)]
pub enum Spheres<'a, T> {
    Arrays(SphereArrays<'a, T>),
    Slice(&'a [Sphere<T>]),
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

impl<'a, T, const N: usize> From<&'a [Sphere<T>; N]> for Spheres<'a, T> {
    fn from(spheres: &'a [Sphere<T>; N]) -> Self {
        Spheres::Slice(spheres)
    }
}

impl<T: Real> Spheres<'_, T> {
    pub(super) fn len(&self) -> usize {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => {
                let all = center.iter().map(|a| a.len());
                all.fold(radius.len(), usize::min)
            }
            Spheres::Slice(spheres) => spheres.len(),
        }
    }

    /// A range of the spheres.
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

    pub(super) fn get(&self, index: usize) -> Option<Sphere<T>> {
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
    fn components(&self, index: usize) -> [T; 4] {
        let Sphere { center, radius } = self.get(index).unwrap_or_default();
        [center.x, center.y, center.z, radius]
    }

    #[inline(always)]
    fn classify_block<S, V, const N: usize, const INSIDE: bool>(
        simd: S,
        planes: &FacePlanes<T>,
        block: &Block<T, 4>,
        _: Option<T>,
    ) -> BlockAnswers
    where
        S: Simd,
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
