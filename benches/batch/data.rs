//! Segments and boxes as structures of arrays.

use frusta::clip::SegmentArrays;
use frusta::cull::{BoxArrays, BoxSet};
use frusta::{Aabb, FarCorners, Frustum, Segment};
use rayon::prelude::*;
use std::ops::Range;

/// Segments by coordinates.
#[derive(Clone)]
pub(crate) struct SegmentColumns([Vec<f32>; 6]);

impl SegmentColumns {
    pub(crate) fn new(all: &[Segment<f32>]) -> Self {
        let column = |of: fn(&Segment<f32>) -> f32| all.iter().map(of).collect();
        Self([
            column(|s| s.start.x),
            column(|s| s.start.y),
            column(|s| s.start.z),
            column(|s| s.end.x),
            column(|s| s.end.y),
            column(|s| s.end.z),
        ])
    }

    pub(crate) fn range(&self, range: Range<usize>) -> SegmentArrays<'_, f32> {
        let [a, b, c, d, e, f] = self.0.each_ref().map(|array| &array[range.clone()]);
        SegmentArrays {
            start: [a, b, c],
            end: [d, e, f],
        }
    }

    pub(crate) fn copy_from(&mut self, other: &Self) {
        for (to, from) in self.0.iter_mut().zip(&other.0) {
            to.copy_from_slice(from);
        }
    }

    /// The same on all threads, each of which copies a part.
    pub(crate) fn par_copy_from(&mut self, other: &Self) {
        for (to, from) in self.0.iter_mut().zip(&other.0) {
            let part = to.len().div_ceil(rayon::current_num_threads());
            let parts = to.par_chunks_mut(part).zip(from.par_chunks(part));
            parts.for_each(|(to, from)| to.copy_from_slice(from));
        }
    }
}

/// Boxes by coordinates.
pub(crate) struct BoxColumns([Vec<f32>; 6]);

impl BoxColumns {
    /// Boxes without a pattern, up to `size` times the frustum's extent, in twice its extent.
    pub(crate) fn about(frustum: &Frustum, size: f64, count: usize) -> Self {
        let corners = frustum.corners();
        let FarCorners::Points(far) = corners.far else {
            unreachable!("the mixes' frustum is finite")
        };
        let all = corners.near.into_iter().chain(far);
        let whole = Aabb::around(all).expect("eight points");
        let mut state = 88_172_645_463_325_252_u64;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut columns: [Vec<f32>; 6] = Default::default();
        for _ in 0..count {
            for k in 0..3 {
                let extent = whole.max[k] - whole.min[k];
                let low = whole.min[k] + extent * (2.0 * next() - 0.5);
                columns[k].push(low as f32);
                columns[k + 3].push((low + size * extent * next()) as f32);
            }
        }
        Self(columns)
    }

    pub(crate) fn get(&self, i: usize) -> Aabb<f32> {
        let at = |k: usize| self.0[k][i];
        Aabb::new([at(0), at(1), at(2)], [at(3), at(4), at(5)])
    }

    pub(crate) fn len(&self) -> usize {
        self.0[0].len()
    }

    /// The ranges of pieces of this length.
    pub(crate) fn pieces(&self, piece: usize) -> impl Iterator<Item = Range<usize>> + use<> {
        let len = self.len();
        (0..len)
            .step_by(piece)
            .map(move |start| start..len.min(start + piece))
    }

    pub(crate) fn range(&self, range: Range<usize>) -> BoxArrays<'_, f32> {
        let [a, b, c, d, e, f] = self.0.each_ref().map(|array| &array[range.clone()]);
        BoxArrays {
            min: [a, b, c],
            max: [d, e, f],
        }
    }

    pub(crate) fn set(&self, range: Range<usize>) -> BoxSet<f32> {
        BoxSet::new(range.map(|i| self.get(i))).expect("boxes")
    }

    /// Reads every byte once.
    pub(crate) fn sum(&self) -> u32 {
        let sum = |array: &Vec<f32>| array.iter().fold(0_u32, |sum, v| sum ^ v.to_bits());
        self.0.iter().map(sum).fold(0, |sum, part| sum ^ part)
    }
}
