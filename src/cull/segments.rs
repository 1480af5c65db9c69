//! Intervals of many segments: class and parameters of each, by [`Culler`]'s face planes.

#[cfg(feature = "parallel")]
use super::many::parallel::{PIECE, by_all, piece_range};
use crate::clip::many::intervals::{self, SegmentIntervals};
#[cfg(feature = "parallel")]
use crate::clip::many::intervals::{Out, Uncertain};
use crate::clip::many::segments::Segments;
use crate::cull::Culler;
use crate::frustum::Frustum;
use crate::math::{NonFiniteAt, Real};
use crate::simd::Level;

impl Culler {
    /// Finds the class of each of many segments, and the parameters between which it is in
    /// the frustum: to the bit those of [`Frustum::clip_segment`](crate::Frustum::clip_segment).
    ///
    /// In `f32` eight or sixteen segments share a register. It is faster than
    /// [`Frustum::clip_segments`](crate::Frustum::clip_segments), which finds points and faces,
    /// too; `benches/README.md` has figures.
    ///
    /// ```
    /// use frusta::clip::{SegmentArrays, SegmentIntervals};
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
    /// The first segment with a coordinate that is infinite or NaN; `intervals` is then
    /// empty.
    pub fn clip_intervals<'a, T: Real>(
        &self,
        segments: impl Into<Segments<'a, T>>,
        intervals: &mut SegmentIntervals<T>,
    ) -> Result<(), NonFiniteAt> {
        let (frustum, planes) = (self.frustum(), self.face_planes());
        intervals::clip(Level::new(), frustum, planes, &segments.into(), intervals)
    }
}

impl Frustum {
    /// As [`Culler::clip_intervals`], for one call with a frustum: makes a [`Culler`] first.
    ///
    /// ```
    /// use frusta::clip::SegmentIntervals;
    /// use frusta::{Class, EndRect, Frustum, Pose, Segment, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let segments = [Segment::new([0.0_f32, 0.0, 2.0], [4.0, 0.0, 2.0])];
    /// let mut intervals = SegmentIntervals::default();
    /// frustum.clip_intervals(&segments, &mut intervals)?;
    /// assert_eq!(intervals.get(0), Some((Class::Cross, 0.0, 0.5)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Culler::clip_intervals`].
    pub fn clip_intervals<'a, T: Real>(
        &self,
        segments: impl Into<Segments<'a, T>>,
        intervals: &mut SegmentIntervals<T>,
    ) -> Result<(), NonFiniteAt> {
        Culler::new(self).clip_intervals(segments, intervals)
    }
}

#[cfg(feature = "parallel")]
impl Culler {
    /// As [`Culler::clip_intervals`], on rayon's threads.
    ///
    /// # Errors
    /// Those of [`Culler::clip_intervals`].
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
            let range = piece_range(piece, len);
            let start = range.start;
            let (frustum, planes) = (self.frustum(), self.face_planes());
            let done =
                intervals::clip_into(Level::new(), frustum, planes, &segments.part(range), out);
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
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use super::*;
    use crate::clip::SegmentArrays;
    use crate::cull::many::tests::{culler_to_3, points};
    use crate::math::Segment;

    const COUNT: usize = 3 * PIECE + 77;

    #[test]
    fn intervals_do_not_depend_on_threads() {
        let culler = culler_to_3();
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
    fn the_first_error_is_returned_and_the_buffer_is_emptied() {
        let culler = culler_to_3();
        let mut points = points(COUNT);
        points[2 * PIECE + 5].y = f32::NAN;
        points[COUNT - 1].y = f32::NAN;
        let segments: Vec<_> = points.iter().map(|&p| Segment::new(p, p)).collect();
        let mut intervals = SegmentIntervals::default();
        let error = culler
            .par_clip_intervals(&segments, &mut intervals)
            .unwrap_err();
        assert_eq!(error.index, 2 * PIECE + 5);
        assert!(intervals.is_empty());
    }
}
