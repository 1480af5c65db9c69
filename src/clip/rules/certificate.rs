//! The certificate: what rounded crossing parameters prove, for values of certain signs.
//!
//! ```text
//! for each face: t = a / (a - b), an entry if a < 0, an exit if b < 0
//! latest entry and earliest exit, each with the next one after it
//! outside   the entry comes after the exit by more than both can be off
//! certain   it comes before it by more, and each is at its face alone, by more
//! ```
//! Selections, not branches: which faces are crossed cannot be predicted. The index of the face
//! is the parameter's tag: its last three bits.
//!
//! # The error of a parameter
//! With both values of a face within e of the exact ones, p and q of opposite signs,
//! `p~/(p~ - q~)` differs from `p/(p - q)` by at most e / |p~ - q~| (put the difference over one
//! denominator). Rounding of the difference, its reciprocal and the product add less than 4 u, the
//! tag at most 7 units of 2 u: 18 u, which [`ROUNDINGS`] covers. The code takes a whole threshold
//! for e, which is 13 times the error of a value. Near and far values of the identity pose have
//! a relative error of u instead, which moves t by u / 2 at most. `proofs/crossing.gappa` has
//! these bounds.

use super::compare::{Compare, MinMax};
use crate::exact::float::Lanes;
use crate::math::Real;

/// Upper bound, in units of u, of a parameter's error besides its values' errors: 4 + 14.
pub(crate) const ROUNDINGS: f64 = 32.0;

/// What stands for the entry of a face that is not entered: before all entries.
const NOT_ENTERED: f64 = -1.0;

/// What stands for the exit, with its sign reversed, of a face that is not left: after all exits.
const NOT_LEFT: f64 = -2.0;

/// Below this a latest entry stands for no entry: half-way from [`NOT_ENTERED`] to 0.
pub(crate) const ENTRIES_ABOVE: f64 = -0.5;

/// Below this an earliest exit, with its sign reversed, stands for no exit: half-way from
/// [`NOT_LEFT`] to -1.
pub(crate) const EXITS_ABOVE: f64 = -1.5;

/// A face's crossing.
pub(crate) struct FaceCrossing<F> {
    /// The parameter if the face is entered.
    pub(crate) enter: F,
    /// The parameter with its sign reversed, so that the earliest is the greatest, if it is left.
    pub(crate) leave: F,
    /// `1 / |a - b|` if the face is crossed, else 0.
    pub(crate) scale: F,
}

impl<F: Compare> FaceCrossing<F> {
    /// From the values at start and end; the bits of `tag` are the face's index.
    #[inline(always)]
    pub(crate) fn new(a: F, b: F, tag: F) -> Self {
        let zero = a.splat(0.0);
        let scale = a.splat(1.0) / (a - b);
        let t = a * scale;
        let (entering, leaving) = (a.is_less(zero), b.is_less(zero));
        Self {
            enter: F::select(entering, t, a.splat(NOT_ENTERED)).tagged(tag),
            leave: F::select(leaving, -t, a.splat(NOT_LEFT)).tagged(tag),
            scale: F::select(entering ^ leaving, Lanes::abs(scale), zero),
        }
    }
}

/// Upper bound of a parameter's error from its values' errors: thresholds of depth and sides, and
/// the greatest `1 / |a - b|` of each.
#[inline(always)]
pub(crate) fn error_of_values<F: Compare>((depth, side): (F, F), scales: [F; 2]) -> F {
    (depth * scales[0]).greater(side * scales[1])
}

/// Upper bound of the error of two parameters' difference, from [`error_of_values`].
#[inline(always)]
pub(crate) fn error_of_two<F: Lanes>(error: F) -> F {
    let roundings = error.splat(ROUNDINGS * f64::UNIT_ROUNDOFF);
    (error + roundings) * error.splat(2.0)
}

/// The greatest two of some parameters.
#[derive(Clone, Copy)]
pub(crate) struct Latest<V> {
    pub(crate) first: V,
    pub(crate) second: V,
}

impl<V: MinMax> Latest<V> {
    #[inline(always)]
    pub(crate) fn new(a: V, b: V) -> Self {
        Self {
            first: a.greater(b),
            second: a.lesser(b),
        }
    }

    #[inline(always)]
    pub(crate) fn add(&mut self, t: V) {
        self.second = self.second.greater(self.first.lesser(t));
        self.first = self.first.greater(t);
    }
}

impl<F: Compare> Latest<F> {
    /// Whether no face is crossed, and whether that is so or the latest crossing is certain, by
    /// more than `error`. `above` is [`ENTRIES_ABOVE`] or [`EXITS_ABOVE`].
    #[inline(always)]
    pub(crate) fn alone(&self, error: F, above: F) -> (F::Mask, F::Mask) {
        let uncrossed = self.first.is_less(above);
        let alone = (self.second + error).is_less(self.first);
        (uncrossed, alone | uncrossed)
    }
}

/// The least two of some parameters.
#[derive(Clone, Copy)]
pub(crate) struct Earliest<V> {
    pub(crate) first: V,
    pub(crate) second: V,
}

impl<V: MinMax> Earliest<V> {
    #[inline(always)]
    pub(crate) fn add(&mut self, t: V) {
        self.second = self.second.lesser(self.first.greater(t));
        self.first = self.first.lesser(t);
    }
}
