//! Where a segment crosses a face: the tie rule, and the parameter and the point.
//!
//! With A and B the magnitudes of the face's values at start and end, the crossing is at
//! t = A / (A + B). It is reached from the nearer end, a fraction tau <= 1/2 of the way; from the
//! lexicographically smaller end if both are equally near. So swapping the ends gives the same
//! bits. The error bound is in `clip/exact/points.rs`.

use super::compare::Compare;
use crate::math::Vec3;

/// Whether the end q of a segment is lexicographically smaller than its start p.
///
/// No branches: where ties are common, they are not of one kind.
#[inline(always)]
pub(crate) fn end_is_smaller<F: Compare>(p: Vec3<F>, q: Vec3<F>) -> F::Mask {
    let by_y_and_z = q.y.is_less(p.y) | (p.y.is_equal(q.y) & q.z.is_less(p.z));
    q.x.is_less(p.x) | (p.x.is_equal(q.x) & by_y_and_z)
}

/// The nearer end of a segment, seen from a crossing.
#[derive(Clone, Copy)]
pub(crate) struct NearerEnd<F: Compare> {
    /// Whether it is the segment's end.
    is_end: F::Mask,
    /// Whether both ends are equally near.
    ties: F::Mask,
}

impl<F: Compare> NearerEnd<F> {
    /// From the magnitudes of the values at start and end.
    #[inline(always)]
    pub(crate) fn new(a: F, b: F) -> Self {
        Self {
            is_end: b.is_less(a),
            ties: a.is_equal(b),
        }
    }

    /// Whether there are ties.
    #[inline(always)]
    pub(crate) fn has_ties(&self) -> bool {
        F::any(self.ties)
    }

    /// Whether it is the segment's end, with no ties.
    #[inline(always)]
    pub(crate) fn without_ties(&self) -> F::Mask {
        self.is_end
    }

    /// Whether it is the segment's end, with ties decided by [`end_is_smaller`].
    #[inline(always)]
    pub(crate) fn with_ties(&self, end_is_smaller: F::Mask) -> F::Mask {
        self.is_end | (self.ties & end_is_smaller)
    }
}

/// The step from the nearer end to a crossing.
#[derive(Clone, Copy)]
pub(crate) struct Step<F: Compare> {
    /// Whether the nearer end is the segment's end.
    pub(crate) from_end: F::Mask,
    /// The fraction of the segment, at most 1/2.
    pub(crate) tau: F,
}

impl<F: Compare> Step<F> {
    /// From the magnitudes of the values at start and end.
    #[inline(always)]
    pub(crate) fn new(a: F, b: F, from_end: F::Mask) -> Self {
        Self {
            from_end,
            tau: a.lesser(b) / (a + b),
        }
    }

    /// The segment's parameter.
    #[inline(always)]
    pub(crate) fn parameter(&self) -> F {
        let tau = self.tau;
        F::select(self.from_end, tau.splat(1.0) - tau, tau)
    }

    /// The step in the segment's direction: negative from its end.
    #[inline(always)]
    pub(crate) fn signed(&self) -> F {
        F::select(self.from_end, -self.tau, self.tau)
    }

    /// A coordinate, from those of start and end.
    #[inline(always)]
    pub(crate) fn coordinate(&self, p: F, q: F) -> F {
        // Adding zero: the sign of a zero must not depend on the order of the ends.
        F::select(self.from_end, q, p) + self.signed() * (q - p) + p.splat(0.0)
    }
}

/// One end of a part: a crossing, or an end of the segment.
///
/// Which of them cannot be predicted: where an end was not clipped, the step's lane holds
/// something meaningless, and a selection puts the segment's own end there.
pub(crate) struct Site<F: Compare> {
    pub(crate) step: Step<F>,
    /// Whether it is a crossing.
    pub(crate) crossing: F::Mask,
    /// If it is not: whether it is the segment's end.
    pub(crate) end: F::Mask,
}

/// Parameters and points.
pub(crate) struct Places<F> {
    pub(crate) t: F,
    pub(crate) x: F,
    pub(crate) y: F,
    pub(crate) z: F,
}

impl<F: Compare> Site<F> {
    /// Parameters and points, from the segment's ends. `z` is that of the crossing: by the step, or
    /// the exact one of near and far.
    #[inline(always)]
    pub(crate) fn places(&self, p: Vec3<F>, q: Vec3<F>, z: F) -> Places<F> {
        let (zero, one) = (p.x.splat(0.0), p.x.splat(1.0));
        let step = &self.step;
        Places {
            t: self.select(step.parameter(), zero, one),
            x: self.select(step.coordinate(p.x, q.x), p.x, q.x),
            y: self.select(step.coordinate(p.y, q.y), p.y, q.y),
            z: self.select(z, p.z, q.z),
        }
    }

    #[inline(always)]
    fn select(&self, crossing: F, p: F, q: F) -> F {
        F::select(self.crossing, crossing, F::select(self.end, q, p))
    }
}
