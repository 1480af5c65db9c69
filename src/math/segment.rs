//! Closed straight segments.

use super::{Axis, Real, Vec3};
use std::fmt;

/// One of a segment's two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// Parameter 0.
    Start,
    /// Parameter 1.
    End,
}

/// The closed segment of the points `start + t (end - start)`, `0 <= t <= 1`.
///
/// Both ends may be the same point.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: Real + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct Segment<T> {
    /// The point at parameter 0.
    pub start: Vec3<T>,
    /// The point at parameter 1.
    pub end: Vec3<T>,
}

/// A coordinate of a segment or of a point is infinite or not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonFinite {
    /// The segment's end with the coordinate; `None` for a point.
    pub end: Option<End>,
    /// The axis of the coordinate.
    pub axis: Axis,
    /// The value of the coordinate.
    pub value: f64,
}

impl fmt::Display for NonFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = match self.end {
            Some(End::Start) => "the segment's start",
            Some(End::End) => "the segment's end",
            None => "the point",
        };
        write!(
            f,
            "{place} has {} = {}; coordinates must be finite",
            self.axis, self.value
        )
    }
}

impl std::error::Error for NonFinite {}

/// A coordinate in a slice of segments or points is infinite or not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonFiniteAt {
    /// The index of the segment or point in the slice.
    pub index: usize,
    /// The coordinate and its value.
    pub found: NonFinite,
}

impl fmt::Display for NonFiniteAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = if self.found.end.is_some() {
            "segment"
        } else {
            "point"
        };
        write!(f, "{what} {}: {}", self.index, self.found)
    }
}

impl std::error::Error for NonFiniteAt {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.found)
    }
}

impl NonFinite {
    /// Fails with a point's first coordinate that is infinite or NaN.
    pub(crate) fn check<T: Real>(end: Option<End>, point: Vec3<T>) -> Result<(), Self> {
        for axis in Axis::ALL {
            let value = point[axis as usize].to_f64();
            if !value.is_finite() {
                return Err(Self { end, axis, value });
            }
        }
        Ok(())
    }
}

impl<T: Real> Segment<T> {
    /// Creates a segment from two points.
    #[must_use]
    #[inline(always)]
    pub fn new(start: impl Into<Vec3<T>>, end: impl Into<Vec3<T>>) -> Self {
        Self {
            start: start.into(),
            end: end.into(),
        }
    }

    /// The segment with its ends swapped.
    #[must_use]
    #[inline]
    pub fn reversed(self) -> Self {
        Self {
            start: self.end,
            end: self.start,
        }
    }

    /// The same segment in `f64`; always exact.
    #[must_use]
    #[inline(always)]
    pub fn to_f64(self) -> Segment<f64> {
        Segment {
            start: self.start.to_f64(),
            end: self.end.to_f64(),
        }
    }

    /// Checks that all six coordinates are finite.
    ///
    /// # Errors
    /// The first coordinate that is infinite or NaN.
    pub fn check_finite(&self) -> Result<(), NonFinite> {
        for (end, point) in [(End::Start, self.start), (End::End, self.end)] {
            NonFinite::check(Some(end), point)?;
        }
        Ok(())
    }
}

impl<T: Real, P: Into<Vec3<T>>> From<(P, P)> for Segment<T> {
    #[inline(always)]
    fn from((start, end): (P, P)) -> Self {
        Self::new(start, end)
    }
}

impl<T: Real, P: Into<Vec3<T>>> From<[P; 2]> for Segment<T> {
    #[inline(always)]
    fn from([start, end]: [P; 2]) -> Self {
        Self::new(start, end)
    }
}
