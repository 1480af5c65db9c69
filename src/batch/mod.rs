//! Many volumes at once: boxes and spheres in vector registers.
//!
//! Answers are those of [`Culler::classify`], for every input, which they are certain of
//! in the batch's own type or get from it. They go to the caller's
//! buffers, which are used again: nothing is allocated once they are large enough, but
//! where big integers are needed.
//!
//! ```text
//! relative boxes in f64, asked about in f32 relative to a place near them
//! boxes    axis-aligned boxes
//! spheres  balls
//! words    512 volumes at a time; what is not certain one by one
//! masks    bits, classes, lists of numbers
//! ```

mod boxes;
mod masks;
mod relative;
mod spheres;
mod words;

pub use boxes::{BoxArrays, Boxes};
pub use masks::ContainmentMasks;
pub use relative::{RelativeBoxes, RelativeError};
pub use spheres::{SphereArrays, Spheres};

use crate::math::{PerReal, Real};
use crate::volume::{Containment, Culler, Rows, VolumeCounts, VolumeErrorAt};
use fearless_simd::Level;
use masks::Numbers;
use std::marker::PhantomData;
use words::{Drive, Sink};

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
        self.drive_boxes(boxes.into(), masks, &mut VolumeCounts::default())
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
        self.drive_boxes(boxes.into(), classes, &mut VolumeCounts::default())
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
        self.drive_boxes(boxes.into(), classes, counts)
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
        let list = &mut Numbers {
            list: numbers,
            next: 0,
        };
        self.drive_boxes(boxes.into(), list, &mut VolumeCounts::default())
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
        self.drive_spheres(spheres.into(), masks, &mut VolumeCounts::default())
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
        self.drive_spheres(spheres.into(), classes, &mut VolumeCounts::default())
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
        let list = &mut Numbers {
            list: numbers,
            next: 0,
        };
        self.drive_spheres(spheres.into(), list, &mut VolumeCounts::default())
    }
}

impl Culler {
    /// The numbers of the boxes that are not outside, in order: exactly those of the boxes in
    /// `f64`, in the time of `f32`.
    pub fn visible_relative(&self, boxes: &RelativeBoxes, numbers: &mut Vec<u32>) {
        let list = &mut Numbers {
            list: numbers,
            next: 0,
        };
        self.drive_relative(boxes, list, &mut VolumeCounts::default());
    }

    /// A class for each box: exactly those of [`Culler::classify`] of the boxes in `f64`, and
    /// adds what it needed to counts.
    pub fn classify_relative_counted(
        &self,
        boxes: &RelativeBoxes,
        classes: &mut Vec<Containment>,
        counts: &mut VolumeCounts,
    ) {
        self.drive_relative(boxes, classes, counts);
    }

    fn drive_relative(
        &self,
        boxes: &RelativeBoxes,
        out: &mut impl Sink,
        counts: &mut VolumeCounts,
    ) {
        let drive = Drive {
            culler: self,
            rows: &Rows::relative_to(self.half_spaces(), boxes.anchor()),
            lot: boxes,
            counts,
        };
        // They were found to be boxes when they were converted.
        let done = words::singles(Level::new(), drive, out);
        debug_assert!(done.is_ok());
    }
}

/// Asks about volumes of one kind: a method, and a kernel for each scalar type, which is
/// compiled here and not in every crate that asks.
macro_rules! drives {
    ($drive:ident, $lot:ident, $kernel:ident, $kernels:ident, $singles:ident, $doubles:ident) => {
        impl Culler {
            fn $drive<T: Real, Out: Sink>(
                &self,
                lot: $lot<'_, T>,
                out: &mut Out,
                counts: &mut VolumeCounts,
            ) -> Result<(), VolumeErrorAt> {
                let kernels = $kernels(PhantomData::<Out>);
                let Some((kernel, rows)) = T::pick(&kernels).zip(T::pick(self.rows())) else {
                    return Ok(());
                };
                let drive = Drive {
                    culler: self,
                    rows,
                    lot: &lot,
                    counts,
                };
                kernel(Level::new(), drive, out)
            }
        }

        type $kernel<T, Out> =
            fn(Level, Drive<'_, T, $lot<'_, T>>, &mut Out) -> Result<(), VolumeErrorAt>;

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
            drive: Drive<'_, f32, $lot<'_, f32>>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            words::singles(level, drive, out)
        }

        fn $doubles<Out: Sink>(
            level: Level,
            drive: Drive<'_, f64, $lot<'_, f64>>,
            out: &mut Out,
        ) -> Result<(), VolumeErrorAt> {
            words::doubles(level, drive, out)
        }
    };
}

drives!(
    drive_boxes,
    Boxes,
    BoxKernel,
    BoxKernels,
    box_singles,
    box_doubles
);
drives!(
    drive_spheres,
    Spheres,
    SphereKernel,
    SphereKernels,
    sphere_singles,
    sphere_doubles
);

#[cfg(test)]
mod tests;
