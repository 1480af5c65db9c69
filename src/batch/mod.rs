//! Many volumes at once: boxes and spheres in vector registers.
//!
//! Answers are those of [`Culler::classify`], for every input. They go to the caller's
//! buffers, which are used again: nothing is allocated once they are large enough, but
//! where big integers are needed.
//!
//! ```text
//! rows     a frustum's half spaces in the scalar type of a batch
//! boxes    axis-aligned boxes
//! words    64 volumes at a time; what is not certain one by one
//! masks    bits, classes, lists of numbers
//! ```

mod boxes;
mod masks;
mod rows;
mod words;

pub use boxes::{BoxArrays, Boxes};
pub use masks::ContainmentMasks;
pub(crate) use rows::Rows;

use crate::math::{PerReal, Real};
use crate::volume::{Containment, Culler, VolumeCounts, VolumeErrorAt};
use fearless_simd::Level;
use masks::Numbers;
use std::marker::PhantomData;
use words::{Drive, Sink};

/// Rows of both scalar types.
#[derive(Clone, Debug)]
pub(crate) struct RowsPair {
    single: Rows<f32>,
    double: Rows<f64>,
}

impl RowsPair {
    pub(crate) fn new(faces: &[crate::volume::HalfSpace]) -> Self {
        Self {
            single: Rows::new(faces),
            double: Rows::new(faces),
        }
    }
}

impl PerReal for RowsPair {
    type Of<T: Real> = Rows<T>;

    fn single(&self) -> &Rows<f32> {
        &self.single
    }

    fn double(&self) -> &Rows<f64> {
        &self.double
    }
}

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

    fn drive_boxes<T: Real, Out: Sink>(
        &self,
        boxes: Boxes<'_, T>,
        out: &mut Out,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        let kernels = BoxKernels(PhantomData::<Out>);
        let Some((kernel, rows)) = T::pick(&kernels).zip(T::pick(self.rows())) else {
            return Ok(());
        };
        let drive = Drive {
            culler: self,
            rows,
            lot: &boxes,
            counts,
        };
        kernel(Level::new(), drive, out)
    }
}

/// Asks about boxes of one scalar type.
type BoxKernel<T, Out> =
    fn(Level, Drive<'_, T, Boxes<'_, T>>, &mut Out) -> Result<(), VolumeErrorAt>;

/// Of both scalar types.
struct BoxKernels<Out>(PhantomData<Out>);

impl<Out: Sink> PerReal for BoxKernels<Out> {
    type Of<T: Real> = BoxKernel<T, Out>;

    fn single(&self) -> &BoxKernel<f32, Out> {
        &(box_singles as _)
    }

    fn double(&self) -> &BoxKernel<f64, Out> {
        &(box_doubles as _)
    }
}

fn box_singles<Out: Sink>(
    level: Level,
    drive: Drive<'_, f32, Boxes<'_, f32>>,
    out: &mut Out,
) -> Result<(), VolumeErrorAt> {
    words::singles(level, drive, out)
}

fn box_doubles<Out: Sink>(
    level: Level,
    drive: Drive<'_, f64, Boxes<'_, f64>>,
    out: &mut Out,
) -> Result<(), VolumeErrorAt> {
    words::doubles(level, drive, out)
}
