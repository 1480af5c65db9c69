//! What answers about volumes needed.

use crate::frustum::eval::half_space::Stage;
use std::iter::Sum;
use std::ops::{Add, AddAssign};

/// How often each stage of the exact decisions about volumes was needed.
///
/// Sums over volumes add up: with `+`, `+=` and [`Iterator::sum`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct VolumeCounts {
    /// Volumes of a batch that were asked for one by one: the batch's own arithmetic left
    /// them open.
    pub unsettled: u64,
    /// Signs that the floating-point filter left open, whichever later stage settled
    /// them.
    pub filter_failures: u64,
    /// Signs taken from double-double values.
    pub double_doubles: u64,
    /// Signs taken from floating-point expansions.
    pub expansions: u64,
    /// Signs taken from big integers.
    pub integers: u64,
    /// Volumes that no face's plane has outside, of which the exact test was asked.
    pub asked: u64,
    /// Those of them that it found to be outside.
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
        self.unsettled += other.unsettled;
        self.filter_failures += other.filter_failures;
        self.double_doubles += other.double_doubles;
        self.expansions += other.expansions;
        self.integers += other.integers;
        self.asked += other.asked;
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
