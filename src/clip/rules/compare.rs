//! Comparison and selection, lane by lane: what the rules need besides [`Lanes`].

use crate::exact::float::Lanes;
use std::ops::{BitAnd, BitOr, BitXor, Div, Neg};
use wide::f64x2;

/// Minimum, maximum and magnitude, lane by lane.
pub(crate) trait MinMax: Copy {
    /// The lesser of two numbers; one of them, or NaN, if one is NaN.
    fn lesser(self, other: Self) -> Self;

    /// The greater of two numbers; one of them, or NaN, if one is NaN.
    fn greater(self, other: Self) -> Self;

    /// The absolute value.
    fn magnitude(self) -> Self;
}

/// Masks: comparisons, and selection by them.
pub(crate) trait Compare: Lanes + MinMax + Div<Output = Self> + Neg<Output = Self> {
    /// A truth value in each lane.
    type Mask: Copy
        + BitAnd<Output = Self::Mask>
        + BitOr<Output = Self::Mask>
        + BitXor<Output = Self::Mask>;

    /// Whether `self < other`; false for NaN.
    fn is_less(self, other: Self) -> Self::Mask;

    /// Whether `self == other`; false for NaN.
    fn is_equal(self, other: Self) -> Self::Mask;

    /// Whether the mask is set in some lane.
    fn any(mask: Self::Mask) -> bool;

    /// `set` where the mask is set, else `clear`.
    fn select(mask: Self::Mask, set: Self, clear: Self) -> Self;

    /// The number with its last three bits replaced by those of `tag`, whose other bits are zero.
    fn tagged(self, tag: Self) -> Self;
}

/// The bits of a number that [`Compare::tagged`] keeps.
const UNTAGGED: u64 = !7;

impl MinMax for f64 {
    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
}

impl Compare for f64 {
    type Mask = bool;

    #[inline(always)]
    fn is_less(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn is_equal(self, other: Self) -> bool {
        self == other
    }

    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }

    #[inline(always)]
    fn select(mask: bool, set: Self, clear: Self) -> Self {
        if mask { set } else { clear }
    }

    #[inline(always)]
    fn tagged(self, tag: Self) -> Self {
        f64::from_bits(self.to_bits() & UNTAGGED | tag.to_bits())
    }
}

impl MinMax for f64x2 {
    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        self.fast_min(other)
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        self.fast_max(other)
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
}

impl Compare for f64x2 {
    /// All bits of a lane set, or none.
    type Mask = f64x2;

    #[inline(always)]
    fn is_less(self, other: Self) -> f64x2 {
        self.simd_lt(other)
    }

    #[inline(always)]
    fn is_equal(self, other: Self) -> f64x2 {
        self.simd_eq(other)
    }

    #[inline(always)]
    fn any(mask: f64x2) -> bool {
        mask.any()
    }

    #[inline(always)]
    fn select(mask: f64x2, set: Self, clear: Self) -> Self {
        mask.bitselect(set, clear)
    }

    #[inline(always)]
    fn tagged(self, tag: Self) -> Self {
        self & f64x2::splat(f64::from_bits(UNTAGGED)) | tag
    }
}
