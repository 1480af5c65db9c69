//! Segments, a register of them at a time: class and parameters of each.
//!
//! # Idea
//! ```text
//! for each block of 256 segments:
//!     triage      the values of all faces at both ends; what is outside of one, or
//!                 inside of all, is marked; the rest is packed side by side
//!     crossing    latest entry and earliest exit of what is packed, from the same values
//!                 in the segments' own type, if their order is certain
//!     parameters  in doubles, each lane by its own faces; of doubles face by face, in
//!                 double-double: the bits of a segment alone
//!     close       what is packed goes back between the marks
//!     unsure      what is not certain is clipped as a slice, in doubles
//! ```
//! The first two are in the segments' type, eight singles a register or sixteen, and decide nothing
//! that their error bound does not prove; the third is the rule of `clip/exact/points.rs`
//! for what they decided. So answers are those of [`Frustum::clip_segment`], bit for bit.
//! Nothing branches on a segment, as in `clip/slice/`.
//!
//! [`Frustum::clip_segment`]: crate::Frustum::clip_segment

mod crossings;
mod parameters;
mod planes;
mod queues;
mod run;
mod triage;
mod undecided;
mod widen;

#[cfg(test)]
use run::sixteen_singles;
pub(crate) use run::{Asked, Out, Unsure, doubles, singles};

use crate::clip::Class;
use crate::math::{Real, Segment, Vec3};
#[cfg(feature = "parallel")]
use std::ops::Range;

/// Segments in six arrays, or in one.
///
/// ```
/// use frusta::cull::{SegmentArrays, Segments};
/// use frusta::Segment;
/// let (zero, one) = ([0.0_f32; 3], [1.0; 3]);
/// let arrays = SegmentArrays { start: [&zero; 3], end: [&one, &one, &zero] };
/// let segments = Segments::from(arrays);
/// assert_eq!(segments.len(), 3);
/// assert_eq!(segments.get(2), Some(Segment::new([0.0; 3], [1.0, 1.0, 0.0])));
/// assert_eq!(segments.get(3), None);
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Segments<'a, T> {
    /// Structure of arrays: fastest.
    Arrays(SegmentArrays<'a, T>),
    /// Array of structures.
    Slice(&'a [Segment<T>]),
}

/// Segments as six arrays of one length; of longer ones only the beginning counts.
#[derive(Clone, Copy, Debug)]
pub struct SegmentArrays<'a, T> {
    /// x, y and z of each start.
    pub start: [&'a [T]; 3],
    /// x, y and z of each end.
    pub end: [&'a [T]; 3],
}

impl<'a, T> From<SegmentArrays<'a, T>> for Segments<'a, T> {
    fn from(arrays: SegmentArrays<'a, T>) -> Self {
        Segments::Arrays(arrays)
    }
}

impl<'a, T> From<&'a [Segment<T>]> for Segments<'a, T> {
    fn from(segments: &'a [Segment<T>]) -> Self {
        Segments::Slice(segments)
    }
}

impl<'a, T> From<&'a Vec<Segment<T>>> for Segments<'a, T> {
    fn from(segments: &'a Vec<Segment<T>>) -> Self {
        Segments::Slice(segments)
    }
}

impl<'a, T: Real> Segments<'a, T> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Segments::Arrays(SegmentArrays { start, end }) => {
                let all = start.iter().chain(end).map(|a| a.len());
                all.min().unwrap_or(0)
            }
            Segments::Slice(segments) => segments.len(),
        }
    }

    /// Some of them, of as many as there are.
    #[cfg(feature = "parallel")]
    pub(crate) fn part(&self, range: Range<usize>) -> Self {
        match *self {
            Segments::Arrays(SegmentArrays { start, end }) => Segments::Arrays(SegmentArrays {
                start: start.map(|array| &array[range.clone()]),
                end: end.map(|array| &array[range.clone()]),
            }),
            Segments::Slice(segments) => Segments::Slice(&segments[range]),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of them.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Segment<T>> {
        let of = |arrays: &[&[T]; 3]| {
            let [x, y, z] = arrays.map(|a| a.get(index).copied());
            Some(Vec3::new(x?, y?, z?))
        };
        match self {
            Segments::Arrays(SegmentArrays { start, end }) => Some(Segment {
                start: of(start)?,
                end: of(end)?,
            }),
            Segments::Slice(segments) => segments.get(index).copied(),
        }
    }

    /// Where the numbers lie side by side.
    fn arrays(&self) -> Option<[&'a [T]; 6]> {
        match *self {
            Segments::Arrays(SegmentArrays { start, end }) => {
                Some([start[0], start[1], start[2], end[0], end[1], end[2]])
            }
            Segments::Slice(_) => None,
        }
    }
}

/// Class and parameters of many segments: `t0` and `t1` are those of a part's entry and
/// exit, to the bit those of [`Frustum::clip_segment`](crate::Frustum::clip_segment). Of
/// a segment that is outside they are 1 and 0.
///
/// Memory that is used again; see [`Culler::clip_intervals`](crate::Culler::clip_intervals).
#[derive(Clone, Debug)]
pub struct SegmentIntervals<T> {
    classes: Vec<Class>,
    t0: Vec<T>,
    t1: Vec<T>,
    unsure: Unsure<T>,
}

impl<T> Default for SegmentIntervals<T> {
    fn default() -> Self {
        Self {
            classes: Vec::new(),
            t0: Vec::new(),
            t1: Vec::new(),
            unsure: Unsure::default(),
        }
    }
}

impl<T: PartialEq> PartialEq for SegmentIntervals<T> {
    fn eq(&self, other: &Self) -> bool {
        (&self.classes, &self.t0, &self.t1) == (&other.classes, &other.t0, &other.t1)
    }
}

impl<T: Real> SegmentIntervals<T> {
    /// How many segments it tells of.
    #[must_use]
    pub fn len(&self) -> usize {
        self.classes.len()
    }

    /// Whether it tells of none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.classes.is_empty()
    }

    /// How each segment lies.
    #[must_use]
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// Where each segment enters; 1 of what is outside.
    #[must_use]
    pub fn t0(&self) -> &[T] {
        &self.t0
    }

    /// Where each segment leaves; 0 of what is outside.
    #[must_use]
    pub fn t1(&self) -> &[T] {
        &self.t1
    }

    /// Class and parameters of one segment.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<(Class, T, T)> {
        let class = *self.classes.get(index)?;
        Some((class, *self.t0.get(index)?, *self.t1.get(index)?))
    }

    /// Class and parameters of each segment.
    pub fn iter(&self) -> impl Iterator<Item = (Class, T, T)> + '_ {
        let parameters = self.t0.iter().zip(&self.t1);
        let all = self.classes.iter().zip(parameters);
        all.map(|(class, (t0, t1))| (*class, *t0, *t1))
    }

    /// The numbers of the segments that are not outside, in order.
    pub fn visible(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.classes.iter().enumerate();
        all.filter_map(|(i, class)| (*class != Class::Outside).then_some(i))
    }

    /// How many of them were not certain in the batch's own type, and clipped in doubles.
    #[must_use]
    pub fn unsure(&self) -> usize {
        self.unsure.count
    }

    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        self.classes.clear();
        self.t0.clear();
        self.t1.clear();
        self.unsure.begin();
    }

    /// Room for answers about so many segments, each to be written.
    pub(crate) fn prepare(&mut self, len: usize) -> Out<'_, T> {
        self.classes.resize(len, Class::Outside);
        self.t0.resize(len, T::ZERO);
        self.t1.resize(len, T::ZERO);
        self.unsure.begin();
        Out {
            classes: &mut self.classes,
            t0: &mut self.t0,
            t1: &mut self.t1,
            unsure: &mut self.unsure,
        }
    }
}

#[cfg(test)]
mod tests;
