//! Exact vectors for constructing frusta and for volumes.
//!
//! A determinant, or a difference of far points, loses nothing; each computation ends with one
//! rounding. It runs once per frustum, or once per volume that floating point leaves undecided, so
//! allocation is acceptable here. Input must be finite; callers check that first.

use crate::exact::Number;
pub(crate) use crate::exact::dyadic::Dyadic;
use crate::math::Vec3;
use std::cmp::Ordering;

/// Three exact coordinates.
pub(crate) type Dyadic3 = [Dyadic; 3];

/// Roundings to the nearest `f64`, ties to even; infinite beyond the range,
/// never -0.
pub(crate) trait Rounded {
    /// The number, rounded.
    fn to_f64(&self) -> f64;
    /// `self * 2^shift`, rounded.
    fn scaled(&self, shift: i32) -> f64;
    /// `self / other`, rounded; infinite if `other` is zero.
    fn ratio(&self, other: &Self) -> f64;
    /// `self / other` rounded towards positive infinity, for `other > 0`.
    fn ratio_up(&self, other: &Self) -> f64;
    /// The order relative to zero.
    fn order(&self) -> Ordering;
}

impl Rounded for Dyadic {
    fn to_f64(&self) -> f64 {
        self.ratio(&1.0.into())
    }

    fn scaled(&self, shift: i32) -> f64 {
        self.shifted(shift).to_f64()
    }

    fn ratio(&self, other: &Self) -> f64 {
        match other.sign() {
            Ordering::Equal => f64::INFINITY,
            _ => self.round_quotient::<f64>(other) + 0.0,
        }
    }

    fn ratio_up(&self, other: &Self) -> f64 {
        let nearest = self.ratio(other);
        // The nearest number is the wanted one or the one below it; infinity is never below.
        let is_below = || (&(&Dyadic::from(nearest) * other) - self).sign() == Ordering::Less;
        if nearest.is_finite() && is_below() {
            nearest.next_up()
        } else {
            nearest
        }
    }

    fn order(&self) -> Ordering {
        self.sign()
    }
}

/// The exact coordinates of a point.
pub(crate) fn exact(v: Vec3<f64>) -> Dyadic3 {
    v.to_array().map(Dyadic::from)
}

/// `p - q`.
pub(crate) fn difference(p: Vec3<f64>, q: Vec3<f64>) -> Dyadic3 {
    let (p, q) = (exact(p), exact(q));
    std::array::from_fn(|i| &p[i] - &q[i])
}

/// The inner product.
pub(crate) fn dot(a: &Dyadic3, b: &Dyadic3) -> Dyadic {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

/// The cross product.
pub(crate) fn cross(a: &Dyadic3, b: &Dyadic3) -> Dyadic3 {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The vector times the power of two that brings its largest coordinate to
/// `1/2 <= |x| < 1`, its length, and the exponent of that power; `None` for the
/// zero vector. Each coordinate is rounded once; the length is within 1.5 u,
/// because its square, too, is rounded once.
pub(crate) fn normalised_by_power(v: &Dyadic3) -> Option<(Vec3<f64>, f64, i32)> {
    let shift = -v.iter().filter_map(Dyadic::top).max()?;
    let [x, y, z] = [0, 1, 2].map(|i| v[i].scaled(shift));
    let length = dot(v, v).scaled(2 * shift).sqrt();
    Some((Vec3::new(x, y, z), length, shift))
}

/// The unit vector in this direction, each coordinate within 4 ulp; `None` for
/// the zero vector. A vector along a coordinate axis gives exactly 1 or -1.
pub(crate) fn unit(v: &Dyadic3) -> Option<Vec3<f64>> {
    let (v, length, _) = normalised_by_power(v)?;
    Some(Vec3::new(v.x / length, v.y / length, v.z / length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every finite `f64`, subnormals and both ends of the range included.
    fn finite() -> impl Strategy<Value = f64> {
        any::<u64>().prop_filter_map("infinite or NaN", |bits| {
            Some(f64::from_bits(bits)).filter(|x| x.is_finite())
        })
    }

    proptest! {
        #[test]
        fn one_operation_rounds_as_the_machine_does(a in finite(), b in finite()) {
            let (x, y) = (Dyadic::from(a), Dyadic::from(b));
            prop_assert_eq!(x.to_f64(), a);
            prop_assert_eq!((&x + &y).to_f64(), a + b);
            prop_assert_eq!((&x - &y).to_f64(), a - b);
            prop_assert_eq!((&x * &y).to_f64(), a * b);
            if b != 0.0 {
                prop_assert_eq!(x.ratio(&y), a / b);
                let (x, y) = (x.clone().abs(), y.clone().abs());
                let up = x.ratio_up(&y);
                let is_below = |q: f64| (&(&Dyadic::from(q) * &y) - &x).sign() == Ordering::Less;
                prop_assert!(up.is_infinite() || !is_below(up), "{a} / {b} is above {up}");
                prop_assert!(up == 0.0 || is_below(up.next_down()), "{a} / {b} is not next to {up}");
            }
        }

        #[test]
        fn close_numbers_too(a in 1u64..1 << 53, b in 1u64..1 << 53, e in -1073i32..-1000) {
            // Products and quotients that land among the subnormals.
            let scale = libm::ldexp(1.0, e);
            let (a, b) = (a as f64, b as f64 * scale);
            let (x, y) = (Dyadic::from(a), Dyadic::from(b));
            prop_assert_eq!(y.ratio(&x), b / a);
            prop_assert_eq!((&x * &y).to_f64(), a * b);
        }
    }

    #[test]
    fn nothing_cancels() {
        let tiny = Dyadic::from(5e-324);
        let huge = Dyadic::from(f64::MAX);
        let sum = &huge + &tiny;
        assert_eq!((&sum - &huge).to_f64(), 5e-324);
        assert_eq!(tiny.order(), Ordering::Greater);
        assert_eq!((&tiny - &tiny).order(), Ordering::Equal);
    }

    #[test]
    fn upwards_at_the_ends_of_the_range() {
        let [zero, tiny, one, three] = [0.0, 5e-324, 1.0, 3.0].map(Dyadic::from);
        assert_eq!(zero.ratio_up(&three), 0.0);
        assert_eq!(tiny.ratio_up(&three), 5e-324);
        assert_eq!((&tiny * &tiny).ratio_up(&one), 5e-324);
        assert_eq!(Dyadic::from(1e-323).ratio_up(&three), 5e-324);
        assert_eq!(Dyadic::from(2e-323).ratio_up(&three), 1e-323);
        assert_eq!(one.ratio_up(&three), (1.0_f64 / 3.0).next_up());
        assert_eq!(three.ratio_up(&one), 3.0);
        let max = Dyadic::from(f64::MAX);
        assert_eq!(max.ratio_up(&one), f64::MAX);
        assert_eq!((&max + &tiny).ratio_up(&one), f64::INFINITY);
        assert_eq!((&max + &max).ratio_up(&one), f64::INFINITY);
    }

    #[test]
    fn zero_is_positive() {
        let (zero, tiny, minus) = (Dyadic::from(0.0), Dyadic::from(5e-324), Dyadic::from(-3.0));
        for x in [zero.ratio(&minus), tiny.ratio(&minus), minus.scaled(-2000)] {
            assert_eq!(x.to_bits(), 0);
        }
        assert_eq!(minus.ratio(&zero), f64::INFINITY);
    }

    #[test]
    fn a_unit_vector_needs_no_range() {
        let v = Vec3::new(3e300, 0.0, -4e300);
        assert_eq!(unit(&exact(v)), Some(Vec3::new(0.6, 0.0, -0.8)));
        let v = Vec3::new(0.0, 5e-324, 0.0);
        assert_eq!(unit(&exact(v)), Some(Vec3::new(0.0, 1.0, 0.0)));
        assert_eq!(unit(&exact(Vec3::new(0.0, 0.0, 0.0))), None);
    }
}
