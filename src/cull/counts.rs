//! How often answers about volumes needed each stage.

use crate::frustum::eval::half_space::Stage;
use std::iter::Sum;
use std::ops::{Add, AddAssign};

/// How often each stage of the exact decisions about volumes was needed.
///
/// Counts of several volumes add up, with `+`, `+=` and [`Iterator::sum`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct VolumeCounts {
    /// Volumes of a query over many that its kernel left open, and that were classified one by
    /// one.
    pub undecided: u64,
    /// Volumes that [`VolumeQuery::keep_invalid`] took as crossing.
    ///
    /// [`VolumeQuery::keep_invalid`]: crate::cull::VolumeQuery::keep_invalid
    pub invalid: u64,
    /// Signs that the floating-point filter left open, whichever later stage decided
    /// them.
    pub filter_failures: u64,
    /// Signs taken from double-double values.
    pub double_doubles: u64,
    /// Signs taken from floating-point expansions.
    pub expansions: u64,
    /// Signs taken from big integers.
    pub integers: u64,
    /// Volumes that are crossing plane by plane and that [`Culler::classify_exact`] had to look at
    /// further.
    ///
    /// [`Culler::classify_exact`]: crate::Culler::classify_exact
    pub exact_tests: u64,
    /// Those of them that the exact test found to be outside.
    pub false_accepts: u64,
}

impl VolumeCounts {
    /// Counts a sign that the filter left open.
    pub(super) fn add_stage(&mut self, stage: Stage) {
        match stage {
            Stage::DoubleDouble => self.double_doubles += 1,
            Stage::Expansion => self.expansions += 1,
            Stage::Integer => self.integers += 1,
        }
    }
}

impl AddAssign for VolumeCounts {
    fn add_assign(&mut self, other: Self) {
        self.undecided += other.undecided;
        self.invalid += other.invalid;
        self.filter_failures += other.filter_failures;
        self.double_doubles += other.double_doubles;
        self.expansions += other.expansions;
        self.integers += other.integers;
        self.exact_tests += other.exact_tests;
        self.false_accepts += other.false_accepts;
    }
}

impl Add for VolumeCounts {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl Sum for VolumeCounts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), Add::add)
    }
}
