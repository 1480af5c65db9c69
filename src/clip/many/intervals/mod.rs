//! Segments, a register of them at a time: class and parameters of each.
//!
//! # Idea
//! ```text
//! for each block of 256 segments:
//!     triage       the values of all faces at both ends; a segment that is outside of one face,
//!                  or inside of all, is settled; the others are packed side by side
//!     crossing     their latest entry and earliest exit, from the same values in the segments'
//!                  own type, if their order is certain
//!     parameters   f32 in f64, each lane by its own faces; f64 face by face, in double-double:
//!                  the bits of a segment alone
//!     merge        what was packed goes back between the settled
//!     uncertain    the rest is clipped as a slice, in f64
//! ```
//! The first two are in the segments' type, eight `f32` a register or sixteen, or four `f64`, and
//! decide nothing that their error bound does not prove; the third is the rule of
//! `clip/rules/site.rs` for what they decided. So answers are those of [`Frustum::clip_segment`],
//! bit for bit. Nothing branches on a segment, as in `clip/many/`.
//!
//! The values are those of the half spaces, in world coordinates: fewer operations than the
//! filter's, which a slice takes, with a bound of their own. So nothing that was computed here is
//! of use to the slice that clips the uncertain segments.
//!
//! [`Frustum::clip_segment`]: crate::Frustum::clip_segment

#[cfg(simd)]
mod crossings;
#[cfg(simd)]
mod frustum_lanes;
#[cfg(not(simd))]
mod one;
mod output;
#[cfg(simd)]
mod parameters;
#[cfg(simd)]
mod run;
#[cfg(simd)]
mod triage;
#[cfg(simd)]
mod undecided;
#[cfg(simd)]
mod widen;

pub(crate) use output::Out;
pub use output::SegmentIntervals;
#[cfg(feature = "parallel")]
pub(crate) use output::Uncertain;

use super::segments::Segments;
use crate::frustum::Frustum;
use crate::frustum::eval::planes::{FacePlanes, FacePlanesPair};
use crate::math::{NonFiniteAt, PerReal, Real};
use crate::simd::Level;
#[cfg(not(simd))]
use one as run;

/// Clips all segments. On an error `intervals` is empty.
pub(crate) fn clip<T: Real>(
    level: Level,
    frustum: &Frustum,
    planes: &FacePlanesPair,
    segments: &Segments<'_, T>,
    intervals: &mut SegmentIntervals<T>,
) -> Result<(), NonFiniteAt> {
    let out = intervals.prepare(segments.len());
    let done = clip_into(level, frustum, planes, segments, out);
    if done.is_err() {
        intervals.clear();
    }
    done
}

/// Clips as many segments as `out` has places for.
pub(crate) fn clip_into<T: Real>(
    level: Level,
    frustum: &Frustum,
    planes: &FacePlanesPair,
    segments: &Segments<'_, T>,
    out: Out<'_, T>,
) -> Result<(), NonFiniteAt> {
    let prepared = Prepared {
        frustum,
        planes: T::pick(planes),
        planes_f64: planes.double(),
    };
    T::pick(&Kernels)(level, prepared, segments, out)
}

/// A frustum, and its half spaces in the segments' type and in `f64`.
#[derive(Clone, Copy)]
struct Prepared<'a, T> {
    frustum: &'a Frustum,
    planes: &'a FacePlanes<T>,
    planes_f64: &'a FacePlanes<f64>,
}

type Kernel<T> =
    fn(Level, Prepared<'_, T>, &Segments<'_, T>, Out<'_, T>) -> Result<(), NonFiniteAt>;

/// The kernels of both scalar types: compiled once, here, and not in every crate that clips.
struct Kernels;

impl PerReal for Kernels {
    type Of<T: Real> = Kernel<T>;

    fn single(&self) -> &Kernel<f32> {
        &(run::clip_f32 as _)
    }

    fn double(&self) -> &Kernel<f64> {
        &(run::clip_f64 as _)
    }
}

#[cfg(test)]
mod tests;
