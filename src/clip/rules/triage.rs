//! Triage: what the signs of a segment's boundary values prove.
//!
//! With a threshold T that the error of a value stays below:
//! ```text
//! outside    some face has both values below -T: the least of the faces' greater values is
//! inside     all values are above T: the least of all is
//! crossing   all magnitudes are above T, and neither of the two: all signs are certain
//! ```
//! Near and far may have a threshold of their own, so their extremes are kept apart.

use super::compare::{Compare, MinMax};

/// Extremes over some faces of their values a and b at a segment's start and end.
#[derive(Clone, Copy)]
pub(crate) struct Extremes<V> {
    /// The least of the faces' greater values.
    pub(crate) greatest: V,
    /// The least value.
    pub(crate) least: V,
    /// The least magnitude.
    pub(crate) nearest: V,
}

impl<V: MinMax> Extremes<V> {
    /// The extremes of one face.
    #[inline(always)]
    pub(crate) fn new(a: V, b: V) -> Self {
        Self {
            greatest: a.greater(b),
            least: a.lesser(b),
            nearest: a.magnitude().lesser(b.magnitude()),
        }
    }

    /// Adds a face.
    #[inline(always)]
    pub(crate) fn add(&mut self, a: V, b: V) {
        let other = Self::new(a, b);
        self.greatest = self.greatest.lesser(other.greatest);
        self.least = self.least.lesser(other.least);
        self.nearest = self.nearest.lesser(other.nearest);
    }
}

/// The extremes of near and far, and of the sides.
#[derive(Clone, Copy)]
pub(crate) struct Signs<F> {
    pub(crate) depth: Extremes<F>,
    pub(crate) side: Extremes<F>,
}

impl<F: Compare> Signs<F> {
    /// Whether some face, of those in a lane, proves that the segment is outside.
    #[inline(always)]
    pub(crate) fn outside(&self, (depth, side): (F, F)) -> F::Mask {
        self.depth.greatest.is_less(-depth) | self.side.greatest.is_less(-side)
    }

    /// Whether the segment is inside of all faces in a lane.
    #[inline(always)]
    pub(crate) fn inside(&self, (depth, side): (F, F)) -> F::Mask {
        depth.is_less(self.depth.least) & side.is_less(self.side.least)
    }

    /// Whether the signs of all values in a lane are certain.
    #[inline(always)]
    pub(crate) fn certain(&self, (depth, side): (F, F)) -> F::Mask {
        depth.is_less(self.depth.nearest) & side.is_less(self.side.nearest)
    }
}
