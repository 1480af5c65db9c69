//! Batches by rayon's threads, in pieces.
//!
//! A piece is what one thread asks about as [`Culler`] does without threads, into its own
//! part of the caller's buffers: the same bits with any number of threads. Of errors the
//! first in the batch's order is told. Lists are made a piece each and then joined, which
//! allocates.

use super::masks::{Classes, MaskWords, Numbers};
use super::segments::{Out, Unsure};
use super::words::WORD;
use super::{Ask, Boxes, ContainmentMasks, RelativeBoxes, SegmentIntervals, Segments, Spheres};
use crate::math::{NonFiniteAt, Real};
use crate::volume::{Containment, Culler, VolumeCounts, VolumeErrorAt};
use fearless_simd::Level;
use rayon::prelude::*;
use std::ops::Range;

/// Volumes or segments in a piece: enough that handing it over costs nothing beside, few
/// enough that it stays in a core's own cache.
const PIECE: usize = 1 << 13;

fn range(piece: usize, len: usize) -> Range<usize> {
    let start = piece * PIECE;
    start..len.min(start + PIECE)
}

impl Culler {
    /// As [`Culler::mask_boxes`], by rayon's threads.
    ///
    /// # Errors
    /// As there.
    pub fn par_mask_boxes<'a, T: Real>(
        &self,
        boxes: impl Into<Boxes<'a, T>>,
        masks: &mut ContainmentMasks,
    ) -> Result<(), VolumeErrorAt> {
        self.par_masks(&boxes.into(), masks)
    }

    /// As [`Culler::classify_boxes`], by rayon's threads.
    ///
    /// # Errors
    /// As there.
    pub fn par_classify_boxes<'a, T: Real>(
        &self,
        boxes: impl Into<Boxes<'a, T>>,
        classes: &mut Vec<Containment>,
    ) -> Result<(), VolumeErrorAt> {
        self.par_classes(&boxes.into(), classes)
    }

    /// As [`Culler::visible_boxes`], by rayon's threads.
    ///
    /// ```
    /// use frusta::{Aabb, Culler, EndRect, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// let cube = |i: u16| Aabb::new([f32::from(i % 7), 0.0, 1.5], [f32::from(i % 7), 1.0, 2.0]);
    /// let boxes: Vec<_> = (0..50_000).map(cube).collect();
    /// let (mut by_threads, mut by_one) = (Vec::new(), Vec::new());
    /// culler.par_visible_boxes(&boxes, &mut by_threads)?;
    /// culler.visible_boxes(&boxes, &mut by_one)?;
    /// assert_eq!(by_threads, by_one);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As there.
    pub fn par_visible_boxes<'a, T: Real>(
        &self,
        boxes: impl Into<Boxes<'a, T>>,
        numbers: &mut Vec<u32>,
    ) -> Result<(), VolumeErrorAt> {
        self.par_numbers(&boxes.into(), numbers)
    }

    /// As [`Culler::mask_spheres`], by rayon's threads.
    ///
    /// # Errors
    /// As there.
    pub fn par_mask_spheres<'a, T: Real>(
        &self,
        spheres: impl Into<Spheres<'a, T>>,
        masks: &mut ContainmentMasks,
    ) -> Result<(), VolumeErrorAt> {
        self.par_masks(&spheres.into(), masks)
    }

    /// As [`Culler::classify_spheres`], by rayon's threads.
    ///
    /// # Errors
    /// As there.
    pub fn par_classify_spheres<'a, T: Real>(
        &self,
        spheres: impl Into<Spheres<'a, T>>,
        classes: &mut Vec<Containment>,
    ) -> Result<(), VolumeErrorAt> {
        self.par_classes(&spheres.into(), classes)
    }

    /// As [`Culler::visible_spheres`], by rayon's threads.
    ///
    /// # Errors
    /// As there.
    pub fn par_visible_spheres<'a, T: Real>(
        &self,
        spheres: impl Into<Spheres<'a, T>>,
        numbers: &mut Vec<u32>,
    ) -> Result<(), VolumeErrorAt> {
        self.par_numbers(&spheres.into(), numbers)
    }

    /// As [`Culler::visible_relative`], by rayon's threads.
    pub fn par_visible_relative(&self, boxes: &RelativeBoxes, numbers: &mut Vec<u32>) {
        // They were found to be boxes when they were converted.
        let done = self.par_numbers(&boxes.seen_by(self).lot(), numbers);
        debug_assert!(done.is_ok());
    }

    /// As [`Culler::clip_intervals`], by rayon's threads.
    ///
    /// # Errors
    /// As there.
    pub fn par_clip_intervals<'a, T: Real>(
        &self,
        segments: impl Into<Segments<'a, T>>,
        intervals: &mut SegmentIntervals<T>,
    ) -> Result<(), NonFiniteAt> {
        let segments = segments.into();
        let len = segments.len();
        let out = intervals.prepare(len);
        let pieces = out.classes.par_chunks_mut(PIECE);
        let pieces = pieces.zip(out.t0.par_chunks_mut(PIECE));
        let pieces = pieces.zip(out.t1.par_chunks_mut(PIECE));
        let ask = |(piece, ((classes, t0), t1))| {
            let mut unsure = Unsure::default();
            let out = Out {
                classes,
                t0,
                t1,
                unsure: &mut unsure,
            };
            let range = range(piece, len);
            let start = range.start;
            let done = self.intervals_into(Level::new(), &segments.part(range), out);
            done.map_err(|e: NonFiniteAt| NonFiniteAt {
                index: start + e.index,
                ..e
            })?;
            Ok(unsure.count)
        };
        let done: Vec<Result<usize, NonFiniteAt>> = pieces.enumerate().map(ask).collect();
        // The sum ends at the first error in order.
        let done: Result<usize, NonFiniteAt> = done.into_iter().sum();
        match done {
            Ok(unsure) => out.unsure.count = unsure,
            Err(_) => intervals.clear(),
        }
        done.map(|_| ())
    }

    fn par_masks(&self, lot: &impl Ask, masks: &mut ContainmentMasks) -> Result<(), VolumeErrorAt> {
        let words = masks.prepare(lot.count());
        let outside = words.outside.par_chunks_mut(PIECE / WORD);
        let pieces = outside.zip(words.inside.par_chunks_mut(PIECE / WORD));
        let ask = |(piece, (outside, inside))| {
            self.ask_piece(lot, piece, &mut MaskWords { outside, inside })
        };
        let done = first_error(pieces.enumerate().map(ask));
        if done.is_err() {
            masks.clear();
        }
        done
    }

    fn par_classes(
        &self,
        lot: &impl Ask,
        classes: &mut Vec<Containment>,
    ) -> Result<(), VolumeErrorAt> {
        classes.resize(lot.count(), Containment::Outside);
        let pieces = classes.par_chunks_mut(PIECE).enumerate();
        let ask = |(piece, classes)| self.ask_piece(lot, piece, &mut Classes(classes));
        let done = first_error(pieces.map(ask));
        if done.is_err() {
            classes.clear();
        }
        done
    }

    fn par_numbers(&self, lot: &impl Ask, numbers: &mut Vec<u32>) -> Result<(), VolumeErrorAt> {
        numbers.clear();
        let pieces = (0..lot.count().div_ceil(PIECE)).into_par_iter();
        let ask = |piece| {
            let mut list = Vec::new();
            let mut sink = Numbers::new(&mut list, (piece * PIECE) as u32);
            self.ask_piece(lot, piece, &mut sink).map(|()| list)
        };
        let lists: Vec<Result<Vec<u32>, VolumeErrorAt>> = pieces.map(ask).collect();
        let lists: Vec<Vec<u32>> = lists.into_iter().collect::<Result<_, _>>()?;
        numbers.reserve(lists.iter().map(Vec::len).sum());
        lists
            .iter()
            .for_each(|list| numbers.extend_from_slice(list));
        Ok(())
    }

    fn ask_piece(
        &self,
        lot: &impl Ask,
        piece: usize,
        out: &mut impl super::words::Sink,
    ) -> Result<(), VolumeErrorAt> {
        let range = range(piece, lot.count());
        let start = range.start;
        let done = lot.part(range).ask(self, out, &mut VolumeCounts::default());
        done.map_err(|e| VolumeErrorAt {
            index: start + e.index,
            ..e
        })
    }
}

/// The first in order, not in time.
fn first_error<E: Send>(done: impl IndexedParallelIterator<Item = Result<(), E>>) -> Result<(), E> {
    let done: Vec<Result<(), E>> = done.collect();
    done.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::{BoxArrays, SegmentArrays};
    use crate::volume::{Aabb, Sphere};
    use crate::{EndRect, Frustum, Pose, Segment, Shape, Vec3};

    /// Coordinates in and about a frustum from z = 1 to z = 3.
    fn points(count: usize) -> Vec<Vec3<f32>> {
        let mut state = 88_172_645_463_325_252_u64;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 40) as f32 / (1 << 22) as f32 - 2.0
        };
        (0..count)
            .map(|_| Vec3::new(next(), next(), next() + 2.0))
            .collect()
    }

    fn culler() -> Culler {
        let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
        let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
        let shape = Shape::Finite { near, far };
        Culler::new(&Frustum::new(Pose::IDENTITY, shape).unwrap())
    }

    const COUNT: usize = 3 * PIECE + 77;

    #[test]
    fn volumes_are_the_same_with_threads() {
        let culler = culler();
        let points = points(COUNT);
        let boxes: Vec<_> = points
            .iter()
            .map(|&p| Aabb::new(p, p + Vec3::new(0.3, 0.1, 0.2)))
            .collect();
        let spheres: Vec<_> = points.iter().map(|&p| Sphere::new(p, 0.2)).collect();
        macro_rules! same {
            ($one:ident $many:ident $lot:expr) => {
                let (mut one, mut many) = (Default::default(), Default::default());
                culler.$one($lot, &mut one).unwrap();
                culler.$many($lot, &mut many).unwrap();
                assert!(one == many, stringify!($many));
            };
        }
        same!(mask_boxes par_mask_boxes &boxes);
        same!(classify_boxes par_classify_boxes &boxes);
        same!(visible_boxes par_visible_boxes &boxes);
        same!(mask_spheres par_mask_spheres &spheres);
        same!(classify_spheres par_classify_spheres &spheres);
        same!(visible_spheres par_visible_spheres &spheres);
        let wide: Vec<_> = boxes
            .iter()
            .map(|b| Aabb::new(b.min.to_f64(), b.max.to_f64()))
            .collect();
        let relative = RelativeBoxes::new([0.1, 0.2, 0.3], &wide).unwrap();
        let (mut one, mut many) = (Vec::new(), Vec::new());
        culler.visible_relative(&relative, &mut one);
        culler.par_visible_relative(&relative, &mut many);
        assert!(one == many && one.len() > 1_000);
    }

    #[test]
    fn segments_are_the_same_with_threads() {
        let culler = culler();
        let points = points(COUNT + 1);
        let segments: Vec<_> = points
            .windows(2)
            .map(|p| Segment::new(p[0], p[1]))
            .collect();
        let (mut one, mut many) = (SegmentIntervals::default(), SegmentIntervals::default());
        culler.clip_intervals(&segments, &mut one).unwrap();
        culler.par_clip_intervals(&segments, &mut many).unwrap();
        assert!(one == many && one.visible().count() > 1_000);
        assert_eq!(one.unsure(), many.unsure());
        let column = |k: usize| -> Vec<f32> { points.iter().map(|p| p[k]).collect() };
        let [x, y, z] = [column(0), column(1), column(2)];
        let arrays = SegmentArrays {
            start: [&x, &y, &z],
            end: [&x[1..], &y[1..], &z[1..]],
        };
        culler.par_clip_intervals(arrays, &mut many).unwrap();
        assert!(one == many);
    }

    #[test]
    fn the_first_error_is_told_and_buffers_are_emptied() {
        let culler = culler();
        let mut points = points(COUNT);
        points[2 * PIECE + 5].y = f32::NAN;
        points[COUNT - 1].y = f32::NAN;
        let boxes: Vec<_> = points.iter().map(|&p| Aabb::new(p, p)).collect();
        let (mut masks, mut classes, mut list) = (ContainmentMasks::default(), vec![], vec![1]);
        let errors = [
            culler.par_mask_boxes(&boxes, &mut masks),
            culler.par_classify_boxes(&boxes, &mut classes),
            culler.par_visible_boxes(&boxes, &mut list),
        ];
        for error in errors {
            assert_eq!(error.unwrap_err().index, 2 * PIECE + 5);
        }
        assert!(masks.is_empty() && classes.is_empty() && list.is_empty());
        let segments: Vec<_> = points.iter().map(|&p| Segment::new(p, p)).collect();
        let mut intervals = SegmentIntervals::default();
        let error = culler
            .par_clip_intervals(&segments, &mut intervals)
            .unwrap_err();
        assert_eq!(error.index, 2 * PIECE + 5);
        assert!(intervals.is_empty());
        let nothing = BoxArrays {
            min: [&[]; 3],
            max: [&[]; 3],
        };
        assert_eq!(culler.par_visible_boxes::<f64>(nothing, &mut list), Ok(()));
    }
}
