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

/// Whether a crossing is reached from the segment's end, not from its start; from the magnitudes of
/// the values at both. `end_is_smaller` is asked for ties only.
#[inline(always)]
pub(crate) fn is_from_end<const TIES: bool, F: Compare>(
    a: F,
    b: F,
    end_is_smaller: impl FnOnce() -> F::Mask,
) -> F::Mask {
    let nearer = b.is_less(a);
    let ties = a.is_equal(b);
    // `TIES`: they are common, so there is no branch for them.
    if TIES || F::any(ties) {
        nearer | (ties & end_is_smaller())
    } else {
        nearer
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
    /// Parameters and points, from the segment's ends. `depth` gives the `z` of a crossing from
    /// the computed one: that of near or far where that is exact.
    #[inline(always)]
    pub(crate) fn places(&self, p: Vec3<F>, q: Vec3<F>, depth: impl FnOnce(F) -> F) -> Places<F> {
        let (zero, one) = (p.x.splat(0.0), p.x.splat(1.0));
        let step = &self.step;
        Places {
            t: self.select(step.parameter(), zero, one),
            x: self.select(step.coordinate(p.x, q.x), p.x, q.x),
            y: self.select(step.coordinate(p.y, q.y), p.y, q.y),
            z: self.select(depth(step.coordinate(p.z, q.z)), p.z, q.z),
        }
    }

    #[inline(always)]
    fn select(&self, crossing: F, p: F, q: F) -> F {
        F::select(self.crossing, crossing, F::select(self.end, q, p))
    }
}
