//! Where the segments of a batch are stored.

use crate::math::{Real, Segment, Vec3};
#[cfg(feature = "parallel")]
use std::ops::Range;

/// Segments as six arrays of coordinates, or as a slice.
///
/// ```
/// use frusta::clip::{SegmentArrays, Segments};
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

/// Segments as six arrays of one length. If their lengths differ, the shortest counts.
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
    /// Number of segments.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Segments::Arrays(SegmentArrays { start, end }) => {
                let lengths = start.iter().chain(end).map(|array| array.len());
                lengths.min().unwrap_or(0)
            }
            Segments::Slice(segments) => segments.len(),
        }
    }

    /// The segments in a range of indices, all of which must exist.
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

    /// Whether there are no segments.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The segment with an index.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Segment<T>> {
        let point = |arrays: &[&[T]; 3]| {
            let [x, y, z] = arrays.map(|a| a.get(index).copied());
            Some(Vec3::new(x?, y?, z?))
        };
        match self {
            Segments::Arrays(SegmentArrays { start, end }) => Some(Segment {
                start: point(start)?,
                end: point(end)?,
            }),
            Segments::Slice(segments) => segments.get(index).copied(),
        }
    }

    /// The six arrays, starts first, if there are arrays.
    pub(super) fn arrays(&self) -> Option<[&'a [T]; 6]> {
        match *self {
            Segments::Arrays(SegmentArrays { start, end }) => {
                Some([start[0], start[1], start[2], end[0], end[1], end[2]])
            }
            Segments::Slice(_) => None,
        }
    }
}
