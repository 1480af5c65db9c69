//! Many at once: boxes, spheres and segments in vector registers.
//!
//! Answers are those of [`Culler::classify`] and of
//! [`Frustum::clip_segment`](crate::Frustum::clip_segment), for every input, which they are certain of
//! in the batch's own type or get from it. They go to the caller's
//! buffers, which are used again: nothing is allocated once they are large enough, but
//! where big integers are needed and, by threads (feature `parallel`), a little for each piece.
//!
//! ```text
//! relative boxes in f64, asked about in f32 relative to a place near them
//! boxes    axis-aligned boxes
//! box_set  boxes that are kept: found to be boxes once, asked about fastest
//! spheres  balls
//! segments class and parameters
//! words    256 volumes at a time; what is not certain one by one
//! plane    a half space in registers, of boxes and segments
//! masks    bits, classes, lists of numbers
//! places   where a byte's bits are
//! parallel (feature) all by threads
//! ```

mod block_driver;
mod box_set;
mod boxes;
mod masks;
#[cfg(feature = "parallel")]
mod parallel;
mod relative;
mod spheres;

pub use box_set::{BoxBlocks, BoxSet};
pub use boxes::{BoxArrays, Boxes};
pub use masks::ContainmentMasks;
pub use relative::{RelativeBoxes, RelativeError};
pub use spheres::{SphereArrays, Spheres};

use crate::clip::many::intervals::{self, SegmentIntervals, Segments};
use crate::cull::{Containment, Culler, VolumeCounts, VolumeErrorAt};
use crate::math::{NonFiniteAt, PerReal, Real};
use block_driver::{BlockDriver, Sink};
use fearless_simd::Level;
use masks::{Classes, Numbers};
use std::marker::PhantomData;
#[cfg(feature = "parallel")]
use std::ops::Range;

impl Culler {
    /// How each of many boxes lies to the frustum, as bits: see [`Culler::classify`].
    ///
    /// # Errors
    /// The first box that is none, as [`crate::Aabb::check`]; `masks` is empty then.
    pub fn mask_boxes<'a, T: Real>(
        &self,
        boxes: impl Into<Boxes<'a, T>>,
        masks: &mut ContainmentMasks,
    ) -> Result<(), VolumeErrorAt> {
        self.masks(&boxes.into(), masks)
    }

    /// The same as a class for each box.
    ///
    /// # Errors
    /// The first box that is none, as [`crate::Aabb::check`]; `classes` is empty then.
    pub fn classify_boxes<'a, T: Real>(
        &self,
        boxes: impl Into<Boxes<'a, T>>,
        classes: &mut Vec<Containment>,
    ) -> Result<(), VolumeErrorAt> {
        self.classes(&boxes.into(), classes, &mut VolumeCounts::default())
    }

    /// As [`Culler::classify_boxes`], and adds what it needed to counts.
    ///
    /// # Errors
    /// The first box that is none, as [`crate::Aabb::check`]; `classes` is empty then.
    pub fn classify_boxes_counted<'a, T: Real>(
        &self,
        boxes: impl Into<Boxes<'a, T>>,
        classes: &mut Vec<Containment>,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        self.classes(&boxes.into(), classes, counts)
    }

    /// The numbers of the boxes that are not outside, in order: a draw list. A third
    /// less work than classes.
    ///
    /// Of more than 2^32 boxes numbers start again at 0.
    ///
    /// # Errors
    /// The first box that is none, as [`crate::Aabb::check`]; `numbers` is empty then.
    pub fn visible_boxes<'a, T: Real>(
        &self,
        boxes: impl Into<Boxes<'a, T>>,
        numbers: &mut Vec<u32>,
    ) -> Result<(), VolumeErrorAt> {
        self.numbers(&boxes.into(), numbers)
    }

    /// How each of many balls lies to the frustum, as bits: see [`Culler::classify`].
    ///
    /// # Errors
    /// The first ball that is none, as [`crate::Sphere::check`]; `masks` is empty then.
    pub fn mask_spheres<'a, T: Real>(
        &self,
        spheres: impl Into<Spheres<'a, T>>,
        masks: &mut ContainmentMasks,
    ) -> Result<(), VolumeErrorAt> {
        self.masks(&spheres.into(), masks)
    }

    /// The same as a class for each ball.
    ///
    /// # Errors
    /// The first ball that is none, as [`crate::Sphere::check`]; `classes` is empty then.
    pub fn classify_spheres<'a, T: Real>(
        &self,
        spheres: impl Into<Spheres<'a, T>>,
        classes: &mut Vec<Containment>,
    ) -> Result<(), VolumeErrorAt> {
        self.classes(&spheres.into(), classes, &mut VolumeCounts::default())
    }

    /// The numbers of the balls that are not outside, in order.
    ///
    /// Of more than 2^32 balls numbers start again at 0.
    ///
    /// # Errors
    /// The first ball that is none, as [`crate::Sphere::check`]; `numbers` is empty then.
    pub fn visible_spheres<'a, T: Real>(
        &self,
        spheres: impl Into<Spheres<'a, T>>,
        numbers: &mut Vec<u32>,
    ) -> Result<(), VolumeErrorAt> {
        self.numbers(&spheres.into(), numbers)
    }
}

impl Culler {
    /// The numbers of the boxes that are not outside, in order: exactly those of the boxes in
    /// `f64`, in the time of `f32`.
    pub fn visible_relative(&self, boxes: &RelativeBoxes, numbers: &mut Vec<u32>) {
        // They were found to be boxes when they were converted.
        let done = self.numbers(&boxes.seen_by(self).lot(), numbers);
        debug_assert!(done.is_ok());
    }

    /// A class for each box: exactly those of [`Culler::classify`] of the boxes in `f64`, and
    /// adds what it needed to counts.
    pub fn classify_relative_counted(
        &self,
        boxes: &RelativeBoxes,
        classes: &mut Vec<Containment>,
        counts: &mut VolumeCounts,
    ) {
        let done = self.classes(&boxes.seen_by(self).lot(), classes, counts);
        debug_assert!(done.is_ok());
    }

    fn masks(&self, lot: &impl Query, masks: &mut ContainmentMasks) -> Result<(), VolumeErrorAt> {
        let words = &mut masks.prepare(lot.count());
        let done = lot.ask(self, words, &mut VolumeCounts::default());
        if done.is_err() {
            masks.clear();
        }
        done
    }

    fn classes(
        &self,
        lot: &impl Query,
        classes: &mut Vec<Containment>,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        classes.resize(lot.count(), Containment::Outside);
        let done = lot.ask(self, &mut Classes(classes), counts);
        if done.is_err() {
            classes.clear();
        }
        done
    }

    fn numbers(&self, lot: &impl Query, numbers: &mut Vec<u32>) -> Result<(), VolumeErrorAt> {
        numbers.clear();
        let mut list = Numbers::new(numbers, 0);
        let done = lot.ask(self, &mut list, &mut VolumeCounts::default());
        if done.is_err() {
            numbers.clear();
        }
        done
    }
}

/// Volumes of one kind, with what asks about them.
trait Query: Sized + Sync {
    /// How many there are.
    fn count(&self) -> usize;

    /// Some of them.
    #[cfg(feature = "parallel")]
    fn part(&self, range: Range<usize>) -> Self;

    /// Asks about all.
    fn ask<Out: Sink>(
        &self,
        culler: &Culler,
        out: &mut Out,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt>;
}

impl Culler {
    /// How each of many segments lies to the frustum, and the parameters between which it is
    /// in it: to the bit those of [`Frustum::clip_segment`](crate::Frustum::clip_segment).
    ///
    /// Singles are eight or sixteen a register, and take a third or less of the time of
    /// [`Frustum::clip_segments`](crate::Frustum::clip_segments), which gives points and
    /// faces, too.
    ///
    /// ```
    /// use frusta::cull::{SegmentArrays, SegmentIntervals};
    /// use frusta::{Class, Culler, EndRect, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let (zero, depth) = ([0.0_f32; 3], [2.0, 2.0, 4.0]);
    /// let x = [1.0, 4.0, 5.0];
    /// let segments = SegmentArrays { start: [&zero, &zero, &depth], end: [&x, &zero, &depth] };
    /// let mut intervals = SegmentIntervals::default();
    /// Culler::new(&frustum).clip_intervals(segments, &mut intervals)?;
    /// assert_eq!(intervals.classes(), [Class::Inside, Class::Cross, Class::Outside]);
    /// assert_eq!(intervals.get(1), Some((Class::Cross, 0.0, 0.5)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The first segment with a coordinate that is infinite or NaN; `intervals` is empty
    /// then.
    pub fn clip_intervals<'a, T: Real>(
        &self,
        segments: impl Into<Segments<'a, T>>,
        intervals: &mut SegmentIntervals<T>,
    ) -> Result<(), NonFiniteAt> {
        let (frustum, planes) = (self.frustum(), self.rows());
        intervals::clip(Level::new(), frustum, planes, &segments.into(), intervals)
    }
}

/// Asks about volumes of one kind: a kernel for each scalar type, which is compiled here
/// and not in every crate that asks.
macro_rules! asks {
    ($lot:ident, $kernel:ident, $kernels:ident, $singles:ident, $doubles:ident) => {
        impl<T: Real> Query for $lot<'_, T> {
            fn count(&self) -> usize {
                self.len()
            }

            #[cfg(feature = "parallel")]
            fn part(&self, range: Range<usize>) -> Self {
                self.part(range)
            }

            fn ask<Out: Sink>(
                &self,
                culler: &Culler,
                out: &mut Out,
                counts: &mut VolumeCounts,
            ) -> Result<(), VolumeErrorAt> {
                let kernels = $kernels(PhantomData::<Out>);
                let (kernel, rows) = (T::pick(&kernels), T::pick(culler.rows()));
                let drive = BlockDriver {
                    culler,
                    rows,
                    lot: self,
                    counts,
                };
                kernel(Level::new(), drive, out)
            }
        }

        type $kernel<T, Out> =
            fn(Level, BlockDriver<'_, T, $lot<'_, T>>, &mut Out) -> Result<(), VolumeErrorAt>;

        struct $kernels<Out>(PhantomData<Out>);

        impl<Out: Sink> PerReal for $kernels<Out> {
            type Of<T: Real> = $kernel<T, Out>;

            fn single(&self) -> &$kernel<f32, Out> {
                &($singles as _)
            }

            fn double(&self) -> &$kernel<f64, Out> {
                &($doubles as _)
            }
        }

        fn $singles<Out: Sink>(
            level: Level,
            drive: BlockDriver<'_, f32, $lot<'_, f32>>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            block_driver::singles(level, drive, out)
        }

        fn $doubles<Out: Sink>(
            level: Level,
            drive: BlockDriver<'_, f64, $lot<'_, f64>>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            block_driver::doubles(level, drive, out)
        }
    };
}

asks!(Boxes, BoxKernel, BoxKernels, box_singles, box_doubles);
asks!(
    Spheres,
    SphereKernel,
    SphereKernels,
    sphere_singles,
    sphere_doubles
);

impl Query for relative::Volumes<'_> {
    fn count(&self) -> usize {
        block_driver::Volumes::len(self)
    }

    #[cfg(feature = "parallel")]
    fn part(&self, range: Range<usize>) -> Self {
        self.part(range)
    }

    fn ask<Out: Sink>(
        &self,
        culler: &Culler,
        out: &mut Out,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        let drive = BlockDriver {
            culler,
            rows: self.rows,
            lot: self,
            counts,
        };
        block_driver::singles(Level::new(), drive, out)
    }
}

#[cfg(test)]
mod tests;
