//! Where a query's volumes come from.

use super::block_driver::{BlockDriver, Request, Volumes};
use super::boxes::{BoxArrays, Boxes};
use super::oriented::OrientedBoxes;
use super::relative::{RelativeBoxes, RelativeQuery};
use super::spheres::{SphereArrays, Spheres};
use super::{BoxSet, output::Sink};
use crate::cull::{Aabb, Culler, Obb, Sphere, VolumeCounts, VolumeErrorAt};
use crate::math::{PerReal, Real};
use crate::simd::Level;
use std::ops::Range;

pub(super) use sealed::{Query, Source};

/// Volumes that a query of [`Culler::over`] can read. Sealed.
///
/// | source | `f32` and `f64` | speed |
/// |---|---|---|
/// | `&`[`BoxSet`] | both | fastest: checked and laid out once, for boxes that are kept |
/// | `&`[`RelativeBoxes`] | `f64`, read as `f32` | as a `BoxSet<f32>`, and some microseconds a query; for coordinates that need `f64` |
/// | [`BoxArrays`], or a reference to it | both | a quarter more than a set |
/// | [`SphereArrays`], or a reference | both | fastest of spheres |
/// | slices, `Vec`s and arrays of [`Aabb`] or [`Sphere`] | both | components are gathered |
/// | slices, `Vec`s and arrays of [`Obb`] | both | slowest: one by one |
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

        /// Classifies a range of the volumes, in order; the range starts at a multiple of a
        /// block. On an error `out` has what came before.
        fn run(
            &self,
            range: Range<usize>,
            request: Request<'_>,
            out: &mut dyn Sink,
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
source!(&BoxArrays<'a, T> => Boxes);
source!(&'a [Aabb<T>] => Boxes);
source!(&'a [Aabb<T>; N] => Boxes, N);
source!(&'a Vec<Aabb<T>> => Boxes);
source!(&'a BoxSet<T> => Boxes);
source!(&'a [Obb<T>] => OrientedBoxes);
source!(&'a [Obb<T>; N] => OrientedBoxes, N);
source!(&'a Vec<Obb<T>> => OrientedBoxes);
source!(SphereArrays<'a, T> => Spheres);
source!(&SphereArrays<'a, T> => Spheres);
source!(&'a [Sphere<T>] => Spheres);
source!(&'a [Sphere<T>; N] => Spheres, N);
source!(&'a Vec<Sphere<T>> => Spheres);

impl<'a> Source for &'a RelativeBoxes {
    type Query = RelativeQuery<'a>;

    fn query(self, culler: &Culler) -> Self::Query {
        self.seen_by(culler)
    }
}

impl VolumeSource for &RelativeBoxes {}

/// The body of [`Query::run`] for volumes of a scalar type.
macro_rules! run {
    ($volumes:ty, $planes:ident) => {{
        fn run(
            volumes: &$volumes,
            range: Range<usize>,
            request: Request<'_>,
            out: &mut dyn Sink,
            counts: &mut VolumeCounts,
        ) -> Result<(), VolumeErrorAt> {
            let driver = BlockDriver {
                request,
                planes: request.culler.face_planes().$planes(),
                volumes,
                level: Level::new(),
            };
            driver.run(range, out, counts)
        }
        &(run as _)
    }};
}

/// A query over one kind of volume: a function that is not generic for each scalar type, compiled
/// once, here, and not in every crate that asks.
macro_rules! query {
    ($volumes:ident, $runs:ident) => {
        impl<T: Real> Query for $volumes<'_, T> {
            fn count(&self) -> usize {
                self.len()
            }

            fn run(
                &self,
                range: Range<usize>,
                request: Request<'_>,
                out: &mut dyn Sink,
                counts: &mut VolumeCounts,
            ) -> Result<(), VolumeErrorAt> {
                T::pick(&$runs)(self, range, request, out, counts)
            }
        }

        struct $runs;

        impl PerReal for $runs {
            type Of<T: Real> = fn(
                &$volumes<'_, T>,
                Range<usize>,
                Request<'_>,
                &mut dyn Sink,
                &mut VolumeCounts,
            ) -> Result<(), VolumeErrorAt>;

            fn single(&self) -> &Self::Of<f32> {
                run!($volumes<'_, f32>, single)
            }

            fn double(&self) -> &Self::Of<f64> {
                run!($volumes<'_, f64>, double)
            }
        }
    };
}

query!(Boxes, RunBoxes);
query!(Spheres, RunSpheres);

impl Query for RelativeQuery<'_> {
    fn count(&self) -> usize {
        self.len()
    }

    fn run(
        &self,
        range: Range<usize>,
        request: Request<'_>,
        out: &mut dyn Sink,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        let driver = BlockDriver {
            request,
            planes: &self.planes,
            volumes: self,
            level: Level::new(),
        };
        driver.run(range, out, counts)
    }
}
