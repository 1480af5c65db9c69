//! Double-double values with a bound on their error: what can be proved without big integers.
//!
//! A ball is a middle of 106 bits and a radius; the exact number is in it. Each operation bounds its
//! own rounding by the relative errors of [`double_double`](super::double_double), and adds what the
//! operands' radii make of it. At the end either the ball proves the sign, or the nearest `f64`, of the number in it,
//! or it proves nothing and somebody computes with integers. So results are the exact ones, always.
//!
//! # The bounds
//! With u = 2^-53: a sum adds what its roundings lose, which is known; a product 8 u^2 of the result, a quotient 16 u^2,
//! where 7 and 15 (and u^3) are needed; a product of two single values is exact. Underflow adds at most
//! [`UNDERFLOW`] to a product: partial products lose some 2^-1074 each. A radius is a sum of positive
//! terms of a few roundings, and [`ROUNDED_UP`] covers those. Overflow makes the radius infinite or NaN,
//! and comparisons are written so that these fail.
//!
//! Zero times anything is zero, without an error: matrices of axis-aligned cameras are full of zeros.

use super::double_double::Dd;
use super::float::{exp2, exponent_above, fast_two_sum, two_sum};
use std::cmp::Ordering;

/// u^2.
const U2: f64 = exp2(-106);
/// Bounds what a product or a quotient loses where its parts are subnormal.
const UNDERFLOW: f64 = exp2(-1050);
/// Covers the rounding of a radius: at most 6 roundings of 2^-53.
const ROUNDED_UP: f64 = 1.0 + exp2(-50);
/// Beyond this range, and below its reciprocal, nothing is proved: a result's rounding, or
/// that of its parts, could be a subnormal number's.
const RANGE: f64 = exp2(900);

/// A number known to within `radius` of `middle`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    middle: Dd,
    radius: f64,
}

impl From<f64> for Ball {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self {
            middle: Dd::new(value, 0.0),
            radius: 0.0,
        }
    }
}

impl Ball {
    /// `a - b`, exactly.
    #[inline(always)]
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        Self {
            middle: Dd::difference(a, b),
            radius: 0.0,
        }
    }

    /// Whether the number is certainly zero.
    pub(crate) fn is_zero(&self) -> bool {
        self.middle.hi == 0.0 && self.radius == 0.0
    }

    /// Whether both are known by the same numbers, of opposite signs.
    pub(crate) fn is_opposite(&self, other: Self) -> bool {
        self.middle == other.middle.neg() && self.radius == other.radius
    }

    #[inline(always)]
    fn magnitude(&self) -> f64 {
        self.middle.hi.abs()
    }

    /// The order relative to zero, if it is certain.
    pub(crate) fn sign(&self) -> Option<Ordering> {
        if self.is_zero() {
            return Some(Ordering::Equal);
        }
        // The middle is `hi` up to u.
        (self.magnitude() > 2.0 * self.radius).then(|| self.middle.hi.total_cmp(&0.0))
    }

    /// The nearest `f64`, ties to even, never -0; if it is certain.
    pub(crate) fn rounded(&self) -> Option<f64> {
        let Dd { hi, lo } = self.middle;
        if self.is_zero() {
            return Some(0.0);
        }
        // Rounding is monotonic: what lies between two numbers that round to `hi` does so, too. Sums are
        // taken outwards.
        let (low, high) = ((lo - self.radius).next_down(), (lo + self.radius).next_up());
        let is_certain = hi + low == hi && hi + high == hi || self.radius == 0.0;
        let in_range = hi.abs() < RANGE && hi.abs() > 1.0 / RANGE;
        (is_certain && in_range).then_some(hi)
    }

    /// The least `e` with `|x| < 2^e`, for a number that is not zero; if it is certain.
    pub(crate) fn top(&self) -> Option<i32> {
        let hi = self.rounded()?;
        if hi == 0.0 {
            return None;
        }
        // `hi` is normal, in [`RANGE`].
        let exponent = exponent_above(hi);
        if hi.to_bits() << 12 != 0 {
            return Some(exponent);
        }
        // A power of two: the number may be below it.
        let lo = if hi < 0.0 {
            -self.middle.lo
        } else {
            self.middle.lo
        };
        match self.radius == 0.0 && lo == 0.0 || lo > self.radius {
            true => Some(exponent),
            false => (lo < -self.radius).then_some(exponent - 1),
        }
    }

    /// More than the magnitude.
    pub(crate) fn bound(&self) -> f64 {
        (self.magnitude() + self.radius) * ROUNDED_UP
    }

    /// `self / other`; nothing is known of it if `other` may be zero.
    pub(crate) fn over(self, other: Self) -> Self {
        if self.is_zero() && other.sign().is_some_and(Ordering::is_ne) {
            return self;
        }
        let middle = self.middle.div(other.middle);
        let (q, d) = (middle.hi.abs(), other.magnitude());
        // The divisor is at least d / 2.
        let given = (self.radius + q * other.radius + UNDERFLOW) / (0.5 * d);
        // Written so that NaN fails.
        let radius = if d > 4.0 * other.radius {
            (given + 16.0 * U2 * q) * ROUNDED_UP + UNDERFLOW
        } else {
            f64::INFINITY
        };
        Self { middle, radius }
    }
}

impl std::ops::Neg for Ball {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            middle: self.middle.neg(),
            ..self
        }
    }
}

impl std::ops::Add for Ball {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // As `Dd::add`, and what its two roundings lose: nothing, for short numbers.
        let (s, e) = two_sum(self.middle.hi, other.middle.hi);
        let (t, f) = two_sum(self.middle.lo, other.middle.lo);
        let (e, lost) = two_sum(e, t);
        let (s, e) = fast_two_sum(s, e);
        let (e, lost_later) = two_sum(e, f);
        let (hi, lo) = fast_two_sum(s, e);
        let own = lost.abs() + lost_later.abs();
        Self {
            middle: Dd { hi, lo },
            radius: (self.radius + other.radius + own) * ROUNDED_UP,
        }
    }
}

impl std::ops::Sub for Ball {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for Ball {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::from(0.0);
        }
        let middle = self.middle.mul(other.middle);
        let (a, b) = (self.magnitude(), other.magnitude());
        let product = middle.hi.abs();
        let is_exact = self.middle.lo == 0.0 && other.middle.lo == 0.0;
        let own = if is_exact { 0.0 } else { 8.0 * U2 * product };
        // Far from underflow the parts of a product are exact; products with radii may be far below it.
        let is_safe = product > 1.0 / RANGE && self.radius + other.radius == 0.0;
        let underflow = if is_safe { 0.0 } else { UNDERFLOW };
        // A middle is up to u larger than its upper part.
        let given = (a * other.radius + b * self.radius) + self.radius * other.radius;
        Self {
            middle,
            radius: (given + own) * ROUNDED_UP + underflow,
        }
    }
}

/// The inner product.
#[inline(always)]
pub(crate) fn dot(a: &[Ball; 3], b: &[Ball; 3]) -> Ball {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
#[inline(always)]
pub(crate) fn cross(a: &[Ball; 3], b: &[Ball; 3]) -> [Ball; 3] {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Number;
    use crate::exact::dyadic::Dyadic;
    use proptest::prelude::*;

    /// A computation, with balls and with integers side by side.
    #[derive(Clone, Debug)]
    struct Both {
        ball: Ball,
        exact: Dyadic,
    }

    fn single(v: f64) -> Both {
        Both {
            ball: v.into(),
            exact: v.into(),
        }
    }

    impl Both {
        fn operate(&self, other: &Self, operation: u8) -> Self {
            let (a, b) = (&self.exact, &other.exact);
            match operation {
                0 => Both {
                    ball: self.ball + other.ball,
                    exact: a + b,
                },
                1 => Both {
                    ball: self.ball - other.ball,
                    exact: a - b,
                },
                _ => Both {
                    ball: self.ball * other.ball,
                    exact: a * b,
                },
            }
        }

        /// The exact number is in the ball; what the ball proves is true.
        fn check(&self) {
            let Ball { middle, radius } = self.ball;
            if ![middle.hi, middle.lo, radius].iter().all(|v| v.is_finite()) {
                assert!(self.ball.rounded().is_none() && self.ball.sign().is_none());
                return;
            }
            let middle = &Dyadic::from(middle.hi) + &Dyadic::from(middle.lo);
            let error = (&middle - &self.exact).abs();
            let rest = &error - &Dyadic::from(radius);
            assert!(rest.sign().is_le(), "{self:?}");
            if let Some(sign) = self.ball.sign() {
                assert_eq!(sign, self.exact.sign(), "{self:?}");
            }
            if let Some(value) = self.ball.rounded() {
                let exact = self.exact.round_quotient::<f64>(&1.0.into());
                assert_eq!(value.to_bits(), (exact + 0.0).to_bits(), "{self:?}");
            }
            if let Some(top) = self.ball.top() {
                assert_eq!(Some(top), self.exact.top(), "{self:?}");
            }
        }

        fn check_quotient(&self, other: &Self) {
            if other.exact.sign().is_eq() {
                assert!(self.ball.over(other.ball).rounded().is_none());
                return;
            }
            if let Some(value) = self.ball.over(other.ball).rounded() {
                let exact = self.exact.round_quotient::<f64>(&other.exact);
                assert_eq!(value, exact, "{self:?} {other:?}");
            }
        }
    }

    /// Short numbers, whose sums cancel; others; ends of the range.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            4 => (-9_i32..10).prop_map(f64::from),
            2 => (-9_i32..10, -60_i32..60).prop_map(|(a, e)| f64::from(a) * exp2(e)),
            4 => -10.0_f64..10.0,
            2 => (-1.0_f32..1.0).prop_map(f64::from),
            1 => (-1.0_f64..1.0, -1070_i32..1020).prop_map(|(a, e)| a * exp2(e)),
            1 => prop_oneof![Just(f64::MAX), Just(5e-324), Just(-0.0), Just(1e-160), Just(1e154)],
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(if cfg!(miri) { 4 } else { 20_000 }))]
        #[test]
        fn balls_hold_what_they_should(values in prop::collection::vec(number(), 8),
                                       steps in prop::collection::vec((0_u8..3, 0_usize..8, 0_usize..8), 9)) {
            let mut all: Vec<Both> = values.into_iter().map(single).collect();
            for (k, (operation, i, j)) in steps.into_iter().enumerate() {
                let next = all[i].operate(&all[j], operation);
                next.check();
                next.check_quotient(&all[j]);
                all[j].check_quotient(&next);
                all[k % 8] = next;
            }
        }
    }

    #[test]
    fn everyday_numbers_are_proved() {
        let third = Ball::from(1.0).over(3.0.into());
        assert_eq!(third.rounded(), Some(1.0 / 3.0));
        let one = third * Ball::from(3.0);
        // Neither 1 nor a rounding error away from it is excluded.
        assert_eq!(
            (one.rounded(), one.sign()),
            (Some(1.0), Some(Ordering::Greater))
        );
        let nothing = one - Ball::from(1.0);
        assert_eq!((nothing.rounded(), nothing.sign()), (None, None));
        let zero = Ball::from(0.0) * third;
        assert_eq!(
            (zero.rounded(), zero.sign()),
            (Some(0.0), Some(Ordering::Equal))
        );
        assert_eq!(Ball::from(1.0).over(0.0.into()).rounded(), None);
        assert_eq!(Ball::from(f64::MAX).rounded(), None);
        assert_eq!(
            (Ball::from(4.0).top(), Ball::from(-3.0).top()),
            (Some(3), Some(2))
        );
        let below = Ball::from(4.0) - Ball::from(exp2(-60));
        assert_eq!((below.rounded(), below.top()), (Some(4.0), Some(2)));
        assert!(third.bound() > 1.0 / 3.0);
    }

    /// A tie is not the nearest number's until it is known to be one.
    #[test]
    fn ties() {
        let tie = Ball::from(1.0) + Ball::from(exp2(-53));
        // It is known to be one: to even.
        assert_eq!(tie.rounded(), Some(1.0));
        let third = Ball::from(1.0).over(3.0.into());
        let near = third * Ball::from(3.0) + Ball::from(exp2(-53));
        assert_eq!(near.rounded(), None);
        let more = tie + Ball::from(exp2(-100));
        assert_eq!(more.rounded(), Some(1.0 + exp2(-52)));
        let less = tie - Ball::from(exp2(-100));
        assert_eq!(less.rounded(), Some(1.0));
    }
}
