//! Where a query's volumes come from, and the kernel for each scalar type.

use super::block_driver::{self, BlockDriver};
use super::boxes::{BoxArrays, Boxes};
use super::relative::{self, RelativeBoxes};
use super::spheres::{SphereArrays, Spheres};
use super::{BoxSet, output::Sink};
use crate::cull::{Aabb, Culler, Sphere, VolumeCounts, VolumeErrorAt};
use crate::math::{PerReal, Real};
use fearless_simd::Level;
use std::marker::PhantomData;
#[cfg(feature = "parallel")]
use std::ops::Range;

pub(super) use sealed::{Query, Source};

/// Volumes that a query of [`Culler::over`] can read. Sealed.
///
/// | source | `f32` and `f64` | speed |
/// |---|---|---|
/// | `&`[`BoxSet`] | both | fastest: checked and laid out once, for boxes that are kept |
/// | `&`[`RelativeBoxes`] | `f64`, read as `f32` | as a `BoxSet<f32>`, and some microseconds a query; for coordinates that need `f64` |
/// | [`BoxArrays`] | both | a quarter more than a set |
/// | [`SphereArrays`] | both | fastest of spheres |
/// | slices, `Vec`s and arrays of [`Aabb`] or [`Sphere`] | both | slowest: components are gathered |
///
/// In `f32` twice as many volumes share a register as in `f64`.
pub trait VolumeSource: Source {}

mod sealed {
    use super::*;

    /// A source, bound to a frustum by [`Source::query`].
    pub trait Source {
        type Query: Query;

        fn query(self, culler: &Culler) -> Self::Query;
    }

    /// Volumes that are ready to be classified.
    pub trait Query: Sync {
        /// Number of volumes.
        fn count(&self) -> usize;

        /// A range of the volumes, which starts at a multiple of a block.
        #[cfg(feature = "parallel")]
        fn part(&self, range: Range<usize>) -> Self;

        /// Classifies all volumes, in order. On an error `out` has what came before.
        fn run<Out: Sink>(
            &self,
            culler: &Culler,
            out: &mut Out,
            counts: &mut VolumeCounts,
        ) -> Result<(), VolumeErrorAt>;
    }
}

macro_rules! source {
    ($source:ty => $query:ident $(, $n:ident)?) => {
        impl<'a, T: Real $(, const $n: usize)?> Source for $source {
            type Query = $query<'a, T>;

            #[inline(always)]
            fn query(self, _: &Culler) -> $query<'a, T> {
                $query::from(self)
            }
        }

        impl<'a, T: Real $(, const $n: usize)?> VolumeSource for $source {}
    };
}

source!(BoxArrays<'a, T> => Boxes);
source!(&'a [Aabb<T>] => Boxes);
source!(&'a [Aabb<T>; N] => Boxes, N);
source!(&'a Vec<Aabb<T>> => Boxes);
source!(&'a BoxSet<T> => Boxes);
source!(SphereArrays<'a, T> => Spheres);
source!(&'a [Sphere<T>] => Spheres);
source!(&'a [Sphere<T>; N] => Spheres, N);
source!(&'a Vec<Sphere<T>> => Spheres);

impl<'a> Source for &'a RelativeBoxes {
    type Query = relative::RelativeQuery<'a>;

    fn query(self, culler: &Culler) -> Self::Query {
        self.seen_by(culler)
    }
}

impl VolumeSource for &RelativeBoxes {}

/// A query over one kind of volume: a function for each scalar type, picked at run time, so that
/// code that is generic over the type names no vector type.
macro_rules! query {
    ($volumes:ident, $kernel:ident, $kernels:ident, $run_f32:ident, $run_f64:ident) => {
        impl<T: Real> Query for $volumes<'_, T> {
            fn count(&self) -> usize {
                self.len()
            }

            #[cfg(feature = "parallel")]
            fn part(&self, range: Range<usize>) -> Self {
                self.part(range)
            }

            fn run<Out: Sink>(
                &self,
                culler: &Culler,
                out: &mut Out,
                counts: &mut VolumeCounts,
            ) -> Result<(), VolumeErrorAt> {
                let kernels = $kernels(PhantomData::<Out>);
                let (kernel, planes) = (T::pick(&kernels), T::pick(culler.face_planes()));
                let driver = BlockDriver {
                    culler,
                    planes,
                    volumes: self,
                    counts,
                };
                kernel(Level::new(), driver, out)
            }
        }

        type $kernel<T, Out> =
            fn(Level, BlockDriver<'_, T, $volumes<'_, T>>, &mut Out) -> Result<(), VolumeErrorAt>;

        struct $kernels<Out>(PhantomData<Out>);

        impl<Out: Sink> PerReal for $kernels<Out> {
            type Of<T: Real> = $kernel<T, Out>;

            fn single(&self) -> &$kernel<f32, Out> {
                &($run_f32 as _)
            }

            fn double(&self) -> &$kernel<f64, Out> {
                &($run_f64 as _)
            }
        }

        fn $run_f32<Out: Sink>(
            level: Level,
            driver: BlockDriver<'_, f32, $volumes<'_, f32>>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            block_driver::run_f32(level, driver, out)
        }

        fn $run_f64<Out: Sink>(
            level: Level,
            driver: BlockDriver<'_, f64, $volumes<'_, f64>>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            block_driver::run_f64(level, driver, out)
        }
    };
}

query!(Boxes, BoxKernel, BoxKernels, boxes_f32, boxes_f64);
query!(
    Spheres,
    SphereKernel,
    SphereKernels,
    spheres_f32,
    spheres_f64
);

impl Query for relative::RelativeQuery<'_> {
    fn count(&self) -> usize {
        block_driver::Volumes::len(self)
    }

    #[cfg(feature = "parallel")]
    fn part(&self, range: Range<usize>) -> Self {
        self.part(range)
    }

    fn run<Out: Sink>(
        &self,
        culler: &Culler,
        out: &mut Out,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        let driver = BlockDriver {
            culler,
            planes: &self.planes,
            volumes: self,
            counts,
        };
        out.run_relative(driver)
    }
}
