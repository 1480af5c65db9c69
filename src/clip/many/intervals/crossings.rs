//! The latest entry and the earliest exit of a register of segments, and whether they are certain.
//!
//! # Which side a parameter is on
//! A face whose value falls from start to end is left at `t = a / (a - b)`, one whose value
//! rises is entered there, if it is crossed at all: t is less than 0 if the segment starts beyond an
//! entry, more than 1 if it ends before an exit. So the signs of differences distinguish entries
//! from exits, and a face that is not crossed needs no mask: it is never the latest entry nor the
//! earliest exit of those that are. That holds for rounded parameters: a value beyond its threshold
//! is more than 8 u of its face's difference, and a side's or near's parameter is off by less than
//! 4 u of itself; the tag takes the place of its last three bits, which are zeros in 0, 1 and 2.
//!
//! # One difference for near and far
//! Their values rise and fall together: one of them is entered, the other left. The difference of
//! near's values stands for both, so that far's parameter is off by 7.2 u S + 4.2 u |d| over it
//! (`proofs/half_space.gappa`), of the 8 of each that a threshold has (`frustum_lanes.rs`). So it is on the
//! right side, too: where far is crossed both its values are beyond their threshold. And
//! the difference is off by less than a quarter of that, so that it is not less than the
//! larger of far's values, to which the smaller one adds.

use super::frustum_lanes::FrustumLanes;
use crate::clip::rules::certificate::{Earliest, Latest};
use crate::clip::rules::compare::MinMax;
use crate::math::Real;
use fearless_simd::prelude::*;

/// A mask for `V`'s lanes.
type Mask<S, V> = <V as SimdBase<S>>::Mask;

/// The crossings of a register of segments.
pub(super) struct Crossings<S: Simd, V: SimdFloat<S>> {
    /// The index of the face at which a segment enters last, and of the one at which it leaves
    /// first; any index if it does not.
    pub(super) faces: [V::Bits; 2],
    /// Whether it enters, and whether it leaves.
    pub(super) cut: [Mask<S, V>; 2],
    /// Whether the entry certainly comes after the exit.
    pub(super) outside: Mask<S, V>,
    /// Whether the entry certainly comes before the exit, and each certainly is at that face alone.
    pub(super) certain: Mask<S, V>,
    /// The size of its coordinates, as [`Size::sum`].
    pub(super) size: V,
}

/// The smallest magnitudes that matter.
struct Smallest<V> {
    /// The smallest of all values.
    value: V,
    /// The smallest of the faces' larger values: no crossing's difference is smaller.
    difference: V,
}

impl<V: Copy> Smallest<V> {
    #[inline(always)]
    fn of<S: Simd>(a: V, b: V) -> Self
    where
        V: SimdFloat<S>,
    {
        let (a, b) = (a.abs(), b.abs());
        Self {
            value: a.min(b),
            difference: a.max(b),
        }
    }

    #[inline(always)]
    fn add<S: Simd>(&mut self, a: V, b: V)
    where
        V: SimdFloat<S>,
    {
        let other = Self::of::<S>(a, b);
        self.value = self.value.min(other.value);
        self.difference = self.difference.min(other.difference);
    }
}

impl<S: Simd, V: SimdFloat<S, Element: Real> + MinMax> Crossings<S, V> {
    #[inline(always)]
    pub(super) fn new(frustum: &FrustumLanes<S, V>, ends: &[[V; 3]; 2]) -> Self {
        let (zero, one) = (frustum.zero, frustum.one);
        let [p, q] = ends;
        let [start, end] = [frustum.near_far(p), frustum.near_far(q)];
        let difference = start[0] - end[0];
        let scale = one / difference;
        // What comes before all, and after all. An infinity is brought down to them: tagged, it
        // would be NaN.
        let (before, after) = (-one, one + one);
        let far = (start[1] * -scale).min(after).max(before);
        let (near, far) = (frustum.tagged(start[0] * scale, 0), frustum.tagged(far, 1));
        let rises = difference.simd_lt(zero);
        let mut entry = Latest {
            first: rises.select(near, far),
            second: before,
        };
        let mut exit = Earliest {
            first: rises.select(far, near),
            second: after,
        };
        let mut smallest = Smallest::of::<S>(start[0], end[0]);
        smallest.add::<S>(start[1], end[1]);
        for side in 0..4 {
            let (a, b) = (frustum.side(side, p), frustum.side(side, q));
            let difference = a - b;
            let t = frustum.tagged((a * (one / difference)).min(after), 2 + side);
            let rises = difference.simd_lt(zero);
            entry.add(rises.select(t, before));
            exit.add(rises.select(after, t));
            smallest.add::<S>(a, b);
        }
        let size = frustum.size(ends);
        // Two parameters together may be off by twice as much.
        let error = frustum.error(&size, one / smallest.difference);
        let error = error + error;
        let overlap = entry.first - exit.first;
        let signs = smallest.value.simd_gt(size.threshold) & frustum.covers(&size);
        let enters = entry.first.simd_gt(zero);
        let leaves = exit.first.simd_lt(one);
        let entry_alone = entry.second.simd_lt(entry.first - error);
        let exit_alone = exit.second.simd_gt(exit.first + error);
        Crossings {
            faces: [frustum.face(entry.first), frustum.face(exit.first)],
            cut: [enters, leaves],
            outside: signs & overlap.simd_gt(error),
            certain: signs
                & overlap.simd_lt(-error)
                & (entry_alone | !enters)
                & (exit_alone | !leaves),
            size: size.sum,
        }
    }
}
