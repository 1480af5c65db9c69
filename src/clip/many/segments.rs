//! Where many segments are stored: slices, arrays of coordinates, points with pairs of indices.

use crate::math::{Real, Segment, Vec3};
use std::fmt;
#[cfg(feature = "parallel")]
use std::ops::Range;

/// Many segments: a slice, six arrays of coordinates, or the edges of a model with shared points.
///
/// All that clips many takes any of them: [`Frustum::clip_segments`](crate::Frustum::clip_segments) reads slices fastest,
/// [`Culler::clip_intervals`](crate::Culler::clip_intervals) arrays.
///
/// ```
/// use frusta::clip::{IndexedEdges, SegmentArrays, Segments};
/// use frusta::Segment;
/// let (zero, one) = ([0.0_f32; 3], [1.0; 3]);
/// let arrays = SegmentArrays { start: [&zero; 3], end: [&one, &one, &zero] };
/// let segments = Segments::from(arrays);
/// assert_eq!(segments.len(), 3);
/// assert_eq!(segments.get(2), Some(Segment::new([0.0; 3], [1.0, 1.0, 0.0])));
/// assert_eq!(segments.get(3), None);
///
/// let points = [[0.0; 3], [1.0, 1.0, 0.0], [5.0; 3]].map(Into::into);
/// let edges = IndexedEdges::new(&points, &[[0, 1], [1, 2]])?;
/// assert_eq!(Segments::from(edges).get(0), segments.get(2));
/// # Ok::<(), frusta::clip::IndexError>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Segments<'a, T> {
    /// Structure of arrays.
    Arrays(SegmentArrays<'a, T>),
    /// Array of structures.
    Slice(&'a [Segment<T>]),
    /// Shared points, and two indices a segment.
    Indexed(IndexedEdges<'a, T>),
}

/// Segments as six arrays of one length. If their lengths differ, the shortest counts.
#[derive(Clone, Copy, Debug)]
pub struct SegmentArrays<'a, T> {
    /// x, y and z of each start.
    pub start: [&'a [T]; 3],
    /// x, y and z of each end.
    pub end: [&'a [T]; 3],
}

/// The edges of a model: shared points, and for each edge the indices of its two ends.
///
/// ```
/// use frusta::clip::IndexedEdges;
/// use frusta::{Accuracy, Class, EndRect, Frustum, Pose, Shape};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let points = [[0.0_f32, 0.0, 2.0], [1.0, 0.0, 2.0], [4.0, 0.0, 2.0]].map(Into::into);
/// let edges = IndexedEdges::new(&points, &[[0, 1], [1, 2]])?;
/// let mut clips = Vec::new();
/// frustum.clip_segments(edges, Accuracy::Inward, &mut clips)?;
/// assert_eq!([clips[0].class, clips[1].class], [Class::Inside, Class::Cross]);
///
/// let error = IndexedEdges::new(&points, &[[0, 1], [1, 3]]).unwrap_err();
/// assert_eq!(error.to_string(), "edge 1 has an end at point 3, and there are 3 points");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct IndexedEdges<'a, T> {
    points: &'a [Vec3<T>],
    /// Both indices are below the number of points.
    edges: &'a [[u32; 2]],
}

/// An edge has an end at a point that does not exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndexError {
    /// The index of the first such edge.
    pub edge: usize,
    /// The index that its end has.
    pub point: u32,
    /// Number of points.
    pub points: usize,
}

impl fmt::Display for IndexError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            edge,
            point,
            points,
        } = self;
        write!(
            f,
            "edge {edge} has an end at point {point}, and there are {points} points"
        )
    }
}

impl std::error::Error for IndexError {}

impl<'a, T: Real> IndexedEdges<'a, T> {
    /// Creates the edges, whose indices are checked once, here.
    ///
    /// # Errors
    /// The first edge with an index that no point has.
    pub fn new(points: &'a [Vec3<T>], edges: &'a [[u32; 2]]) -> Result<Self, IndexError> {
        let is_missing = |&point: &u32| point as usize >= points.len();
        for (edge, ends) in edges.iter().enumerate() {
            if let Some(&point) = ends.iter().find(|point| is_missing(point)) {
                let points = points.len();
                return Err(IndexError {
                    edge,
                    point,
                    points,
                });
            }
        }
        Ok(Self { points, edges })
    }

    /// The edge with an index, as a segment.
    #[must_use]
    #[inline]
    pub fn get(&self, index: usize) -> Option<Segment<T>> {
        let [start, end] = *self.edges.get(index)?;
        Some(Segment {
            start: *self.points.get(start as usize)?,
            end: *self.points.get(end as usize)?,
        })
    }

    /// Number of edges.
    #[must_use]
    pub fn len(&self) -> usize {
        self.edges.len()
    }

    /// Whether there are no edges.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }
}

impl<'a, T> From<IndexedEdges<'a, T>> for Segments<'a, T> {
    fn from(edges: IndexedEdges<'a, T>) -> Self {
        Segments::Indexed(edges)
    }
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

impl<'a, T, const N: usize> From<&'a [Segment<T>; N]> for Segments<'a, T> {
    fn from(segments: &'a [Segment<T>; N]) -> Self {
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
            Segments::Indexed(edges) => edges.len(),
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
            Segments::Indexed(IndexedEdges { points, edges }) => Segments::Indexed(IndexedEdges {
                points,
                edges: &edges[range],
            }),
        }
    }

    /// Whether there are no segments.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The segment with an index.
    #[must_use]
    #[inline]
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
            Segments::Indexed(edges) => edges.get(index),
        }
    }

    /// The six arrays, starts first, if there are arrays.
    pub(super) fn arrays(&self) -> Option<[&'a [T]; 6]> {
        match *self {
            Segments::Arrays(SegmentArrays { start, end }) => {
                Some([start[0], start[1], start[2], end[0], end[1], end[2]])
            }
            Segments::Slice(_) | Segments::Indexed(_) => None,
        }
    }
}
