//! Batches by rayon's threads, in pieces.
//!
//! A piece is what one thread asks about as [`Culler`] does without threads, into its own
//! part of the caller's buffers: the same bits with any number of threads. Of errors the
//! first in the batch's order is told. Lists are made a piece each and then joined, which
//! allocates.
//!
//! The caller's thread begins at once, the others take pieces as soon as they wake: that takes as
//! long as some ten thousand answers, and a batch is often not much more.

use super::block_driver::WORD;
use super::masks::{Classes, MaskWords, Numbers};
use super::{Boxes, ContainmentMasks, Query, RelativeBoxes, SegmentIntervals, Segments, Spheres};
use crate::clip::many::intervals::{self as engine, Out, Uncertain};
use crate::cull::{Containment, Culler, VolumeCounts, VolumeErrorAt};
use crate::math::{NonFiniteAt, Real};
use fearless_simd::Level;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

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
        let pieces = out.classes.chunks_mut(PIECE);
        let pieces = pieces.zip(out.t0.chunks_mut(PIECE));
        let pieces = pieces.zip(out.t1.chunks_mut(PIECE));
        let done = by_all(pieces, |piece, ((classes, t0), t1)| {
            let mut uncertain = Uncertain::default();
            let out = Out {
                classes,
                t0,
                t1,
                uncertain: &mut uncertain,
            };
            let range = range(piece, len);
            let start = range.start;
            let (frustum, planes) = (self.frustum(), self.rows());
            let part = segments.part(range);
            let done = engine::clip_into(Level::new(), frustum, planes, &part, out);
            done.map_err(|e: NonFiniteAt| NonFiniteAt {
                index: start + e.index,
                ..e
            })?;
            Ok(uncertain.count)
        });
        match done {
            Ok(uncertain) => {
                out.uncertain.count = uncertain.into_iter().sum();
                Ok(())
            }
            Err(error) => {
                intervals.clear();
                Err(error)
            }
        }
    }

    fn par_masks(
        &self,
        lot: &impl Query,
        masks: &mut ContainmentMasks,
    ) -> Result<(), VolumeErrorAt> {
        let words = masks.prepare(lot.count());
        let outside = words.outside.chunks_mut(PIECE / WORD);
        let pieces = outside.zip(words.inside.chunks_mut(PIECE / WORD));
        let done = by_all(pieces, |piece, (outside, inside)| {
            self.ask_piece(lot, piece, &mut MaskWords { outside, inside })
        });
        if done.is_err() {
            masks.clear();
        }
        done.map(|_| ())
    }

    fn par_classes(
        &self,
        lot: &impl Query,
        classes: &mut Vec<Containment>,
    ) -> Result<(), VolumeErrorAt> {
        classes.resize(lot.count(), Containment::Outside);
        let done = by_all(classes.chunks_mut(PIECE), |piece, classes| {
            self.ask_piece(lot, piece, &mut Classes(classes))
        });
        if done.is_err() {
            classes.clear();
        }
        done.map(|_| ())
    }

    fn par_numbers(&self, lot: &impl Query, numbers: &mut Vec<u32>) -> Result<(), VolumeErrorAt> {
        numbers.clear();
        let lists = by_all(0..lot.count().div_ceil(PIECE), |_, piece| {
            let mut list = Vec::new();
            let mut sink = Numbers::new(&mut list, (piece * PIECE) as u32);
            self.ask_piece(lot, piece, &mut sink).map(|()| list)
        })?;
        numbers.reserve(lists.iter().map(Vec::len).sum());
        lists
            .iter()
            .for_each(|list| numbers.extend_from_slice(list));
        Ok(())
    }

    fn ask_piece(
        &self,
        lot: &impl Query,
        piece: usize,
        out: &mut impl super::block_driver::Sink,
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

/// What is done with each piece, in their order, by this thread and rayon's; or the first error
/// in that order.
fn by_all<Piece: Send, Done: Send, E: Send>(
    pieces: impl ExactSizeIterator<Item = Piece> + Send,
    work: impl Fn(usize, Piece) -> Result<Done, E> + Sync,
) -> Result<Vec<Done>, E> {
    let helpers = rayon::current_num_threads().min(pieces.len());
    let left = Mutex::new(Some(pieces.enumerate()));
    let all = Mutex::new(Vec::new());
    // Pieces are taken in order: none before one that failed is left.
    let take = || locked(&left).as_mut()?.next();
    let work_off = || {
        while let Some((i, piece)) = take() {
            let done = work(i, piece);
            if done.is_err() {
                *locked(&left) = None;
            }
            locked(&all).push((i, done));
        }
    };
    rayon::in_place_scope(|scope| {
        for _ in 1..helpers {
            scope.spawn(|_| work_off());
        }
        work_off();
    });
    let mut all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    all.sort_unstable_by_key(|&(i, _)| i);
    all.into_iter().map(|(_, done)| done).collect()
}

/// A panic elsewhere is told there.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::SegmentArrays;
    use crate::cull::BoxArrays;
    use crate::cull::{Aabb, Sphere};
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
        assert_eq!(one.uncertain(), many.uncertain());
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
    fn any_number_of_threads_takes_each_piece_once() {
        for threads in [1, 2, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            for pieces in [0, 1, 5, 400] {
                let work = |i, piece| match i {
                    300 | 350 => Err(i),
                    _ => Ok((i, piece)),
                };
                let done = pool.install(|| by_all(1000..1000 + pieces, work));
                let expected = match pieces {
                    400 => Err(300),
                    _ => Ok((0..pieces).map(|i| (i, 1000 + i)).collect()),
                };
                assert_eq!(done, expected);
            }
        }
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
