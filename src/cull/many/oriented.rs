//! Oriented boxes in slices: classified one by one.

use super::block_driver::{BLOCK, BlockBits, Request, WORD};
use super::output::Sink;
use super::source::Query;
use crate::cull::{Containment, Obb, Volume, VolumeCounts, VolumeErrorAt};
use crate::math::Real;
use std::ops::Range;

/// Oriented boxes in a slice.
#[derive(Clone, Copy, Debug)]
pub struct OrientedBoxes<'a, T>(&'a [Obb<T>]);

impl<'a, T> From<&'a [Obb<T>]> for OrientedBoxes<'a, T> {
    fn from(boxes: &'a [Obb<T>]) -> Self {
        Self(boxes)
    }
}

impl<'a, T> From<&'a Vec<Obb<T>>> for OrientedBoxes<'a, T> {
    fn from(boxes: &'a Vec<Obb<T>>) -> Self {
        Self(boxes)
    }
}

impl<'a, T, const N: usize> From<&'a [Obb<T>; N]> for OrientedBoxes<'a, T> {
    fn from(boxes: &'a [Obb<T>; N]) -> Self {
        Self(boxes)
    }
}

impl<T: Real> Query for OrientedBoxes<'_, T> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn run(
        &self,
        range: Range<usize>,
        request: Request<'_>,
        out: &mut dyn Sink,
        counts: &mut VolumeCounts,
    ) -> Result<(), VolumeErrorAt> {
        for start in range.clone().step_by(BLOCK) {
            let block = &self.0[start..range.end.min(start + BLOCK)];
            let mut answers = [BlockBits::default(); BLOCK / WORD];
            for (i, volume) in block.iter().enumerate() {
                let class = request.classify(start + i, Volume::from(*volume), counts)?;
                let bits = &mut answers[i / WORD];
                bits.outside |= u64::from(class == Containment::Outside) << (i % WORD);
                bits.inside |= u64::from(class == Containment::Inside) << (i % WORD);
            }
            out.take(block.len(), &answers);
        }
        out.finish();
        Ok(())
    }
}
