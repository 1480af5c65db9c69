//! V/W over slices: segments side by side in the lanes of vector registers.
//!
//! # Idea
//! ```text
//! for each block of 256 segments:
//!     all are outside, until something else is known
//!     triage     four at a time: the boundary values at both ends, and what their
//!                signs prove; the indices of the others go to queues: inside,
//!                lattice, crossing, uncertain
//!     lattice    four at a time, those so coarse that nothing is rounded
//!     crossing   four at a time from the queue: crossing parameters of all faces,
//!                their latest entry and earliest exit; certain ones go to a
//!                queue with their two faces, the others to the uncertain ones
//!     points     four at a time from the queue
//!     inside     one by one: copies
//!     uncertain  one by one, by the exact predicates of a single segment
//! ```
//! Queues are filled without branches, as it cannot be
//! predicted which segments of a mixed scene are outside, inside or cut. Mispredicted branches
//! cost a textbook clipper most of its time.
//!
//! V/W's symmetry gives the lanes their short values: left and right share a
//! half-width, bottom and top another, near and far serve both trapezoids.
//!
//! # The same bits
//! Each lane applies the rules of `clip/rules/`, as [`VwProjection`](crate::clip::VwProjection) does
//! with one segment, in the same order of operations, or leaves the segment to it. The values of
//! an uncertain segment are not passed along: few are, and a queue of values would cost all. The
//! vector width is chosen once for a slice, at run time. The only fused operation is the rest of a
//! product, which is exact either way.
//!
//! Without code for vector registers (see `build.rs`) segments are clipped one by one.
//!
//! Closures that use registers are marked `#[inline(always)]`, or avoided: others are compiled
//! without the vector width's instructions.
//!
//! # Source
//! Four side values as one vector: V/W's own symmetry (see `clip/vw.rs`). Queues
//! instead of branches: as the selection vectors of vectorised databases (Boncz,
//! Zukowski, Nes, "MonetDB/X100", 2005).

#[cfg(simd)]
mod certified;
pub(crate) mod intervals;
#[cfg(simd)]
mod kernels;
#[cfg(simd)]
mod lanes;
#[cfg(simd)]
mod lattice;
#[cfg(not(simd))]
mod one;
#[cfg(simd)]
mod plain;
#[cfg(simd)]
mod points;
#[cfg(simd)]
mod queue;
pub(crate) mod segments;

use super::result::{Accuracy, SegmentClip, StageCounts};
use crate::frustum::{Frustum, PlainFrustum};
use crate::math::{NonFinite, NonFiniteAt, PerReal, Real, Segment};
use crate::simd::Level;
use kernels::{BLOCK, Queues};
#[cfg(not(simd))]
use one as kernels;
use segments::Segments;

/// Segments of a block, and the places of their clips: as many, all outside.
struct Block<'a, T> {
    frustum: &'a Frustum,
    segments: &'a [Segment<T>],
    clips: &'a mut [SegmentClip<T>],
}

impl<T: Real> Block<'_, T> {
    /// Clips some of the segments one by one, up to the first that is not finite.
    fn clip_singly(
        &mut self,
        items: impl IntoIterator<Item = usize>,
        mut clip: impl FnMut(&Frustum, &Segment<T>) -> Result<SegmentClip<T>, NonFinite>,
    ) -> Result<(), NonFiniteAt> {
        for index in items {
            self.clips[index] = clip(self.frustum, &self.segments[index])
                .map_err(|found| NonFiniteAt { index, found })?;
        }
        Ok(())
    }
}

/// Clips by exact V/W. On an error `clips` is empty.
pub(crate) fn clip_exact<T: Real>(
    level: Level,
    frustum: &Frustum,
    segments: Segments<'_, T>,
    accuracy: Accuracy,
    clips: &mut Vec<SegmentClip<T>>,
    counts: &mut StageCounts,
) -> Result<(), NonFiniteAt> {
    let mut queues = Queues::new();
    let kernels = T::pick(&Both);
    in_blocks(frustum, segments, clips, |block| {
        (kernels.exact)(level, block, accuracy, &mut queues, counts)
    })
}

/// Clips by plain V/W. On an error `clips` is empty.
pub(crate) fn clip_plain<T: Real>(
    level: Level,
    frustum: &Frustum,
    segments: &[Segment<T>],
    clips: &mut Vec<SegmentClip<T>>,
) -> Result<(), NonFiniteAt> {
    let mut queues = Queues::new();
    let (kernels, plain) = (T::pick(&Both), frustum.plain());
    in_blocks(frustum, segments.into(), clips, |block| {
        (kernels.plain)(level, block, plain, &mut queues)
    })
}

/// The kernels that clip a block of one scalar type. Functions that are not generic are
/// compiled once, here, and not in every crate that clips.
struct Kernels<T: Real> {
    exact: ExactKernel<T>,
    plain: PlainKernel<T>,
}

type ExactKernel<T> =
    fn(Level, Block<'_, T>, Accuracy, &mut Queues, &mut StageCounts) -> Result<(), NonFiniteAt>;

type PlainKernel<T> =
    fn(Level, Block<'_, T>, &PlainFrustum<T>, &mut Queues) -> Result<(), NonFiniteAt>;

/// The kernels of both scalar types.
struct Both;

impl PerReal for Both {
    type Of<T: Real> = Kernels<T>;

    fn single(&self) -> &Kernels<f32> {
        &Kernels {
            exact: kernels::exact_f32,
            plain: kernels::plain_f32,
        }
    }

    fn double(&self) -> &Kernels<f64> {
        &Kernels {
            exact: kernels::exact_f64,
            plain: kernels::plain_f64,
        }
    }
}

fn in_blocks<T: Real>(
    frustum: &Frustum,
    segments: Segments<'_, T>,
    clips: &mut Vec<SegmentClip<T>>,
    mut clip: impl FnMut(Block<'_, T>) -> Result<(), NonFiniteAt>,
) -> Result<(), NonFiniteAt> {
    clips.clear();
    clips.reserve(segments.len());
    let mut clip_next = |segments: &[Segment<T>]| {
        let done = clips.len();
        clips.extend(segments.iter().map(|_| super::whole::outside()));
        let block = Block {
            frustum,
            segments,
            clips: &mut clips[done..],
        };
        clip(block).map_err(|mut error| {
            error.index += done;
            clips.clear();
            error
        })
    };
    if let Segments::Slice(segments) = segments {
        return segments.chunks(BLOCK).try_for_each(clip_next);
    }
    let mut gathered = [Segment::default(); BLOCK];
    for start in (0..segments.len()).step_by(BLOCK) {
        let count = BLOCK.min(segments.len() - start);
        for (i, to) in gathered[..count].iter_mut().enumerate() {
            *to = segments.get(start + i).unwrap_or_default();
        }
        clip_next(&gathered[..count])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
