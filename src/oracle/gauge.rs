//! Deviations of rounded points from an exact one, as fractions of an ulp.
//!
//! The exact coordinate is represented by the sum of two `f64`, `high` the nearest one
//! and `low` the nearest to the rest, with a relative error below 2^-105. For a
//! point near it `point - high` is exact, so the deviation has a relative error
//! of a few roundoffs, and an absolute one below 2^-50 ulp. All steps except the last are
//! rational arithmetic.

use super::OracleEnd;
use super::dyadic::Dyadic;
use super::round::{round_nearest, ulp_at};
use crate::math::{Real, Vec3};
use num_rational::BigRational;
use num_traits::Zero;

/// An exact point, which measures the deviations of rounded ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gauge {
    high: [f64; 3],
    low: [f64; 3],
    /// The ulp of the scalar type at each coordinate; 0 for a zero coordinate, which has
    /// no ulp of its own.
    ulp: [f64; 3],
}

impl Gauge {
    /// Creates a gauge for points of `T`.
    pub fn new<T: Real>(end: &OracleEnd) -> Self {
        let exact = &end.point;
        let high = exact.each_ref().map(round_nearest::<f64>);
        let low = [0, 1, 2].map(|k| left_over(&exact[k], high[k]));
        let unit = |x: &BigRational| if x.is_zero() { 0.0 } else { ulp_at::<T>(x) };
        let ulp = exact.each_ref().map(unit);
        Self { high, low, ulp }
    }

    /// The largest difference in a coordinate, rounded: its relative error is a few
    /// roundoffs, in either direction.
    pub fn deviation<T: Real>(&self, point: Vec3<T>) -> f64 {
        self.differences(point).into_iter().fold(0.0, f64::max)
    }

    /// The largest difference in a coordinate, each in units in the last place of `T` at
    /// the exact coordinate; at the rounded one if the exact one is zero. It is rounded as
    /// [`Gauge::deviation`] is.
    pub fn deviation_in_ulps<T: Real>(&self, point: Vec3<T>) -> f64 {
        let differences = self.differences(point);
        let ulps = [0, 1, 2].map(|k| {
            let own = |c: T| c.abs().next_up().to_f64() - c.abs().to_f64();
            let ulp = if self.ulp[k] > 0.0 {
                self.ulp[k]
            } else {
                own(point.to_array()[k])
            };
            differences[k] / ulp
        });
        ulps.into_iter().fold(0.0, f64::max)
    }

    fn differences<T: Real>(&self, point: Vec3<T>) -> [f64; 3] {
        let point = point.to_f64().to_array();
        [0, 1, 2].map(|k| ((point[k] - self.high[k]) - self.low[k]).abs())
    }
}

/// The `f64` nearest to `exact - high`.
fn left_over(exact: &BigRational, high: f64) -> f64 {
    let Some(high) = Dyadic::from_f64(high) else {
        return 0.0;
    };
    let rest = &Dyadic::new(exact.numer().clone(), 0) - &(&high * exact.denom());
    round_nearest(&rest.over(exact.denom()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frustum::FaceSet;

    fn gauge<T: Real>(numerators: [i64; 3], denominator: i64) -> Gauge {
        let exact = |n: i64| BigRational::new(n.into(), denominator.into());
        Gauge::new::<T>(&OracleEnd {
            t: exact(0),
            point: numerators.map(exact),
            clipped: true,
            faces: FaceSet::EMPTY,
        })
    }

    #[test]
    fn thirds_are_a_third_of_an_ulp_off() {
        // 1/3 in binary is 0.0101...: rounding cuts off a third of the last place.
        let third = gauge::<f64>([1, 0, 0], 3);
        let near = Vec3::new(1.0 / 3.0, 0.0, 0.0);
        let ulps = third.deviation_in_ulps(near);
        assert!((ulps - 1.0 / 3.0).abs() < 1e-12, "{ulps}");
        assert_eq!(third.deviation(near), 2.0_f64.powi(-54) / 3.0);
        let next = Vec3::new((1.0_f64 / 3.0).next_up(), 0.0, 0.0);
        assert!((third.deviation_in_ulps(next) - 2.0 / 3.0).abs() < 1e-12);
        let single = gauge::<f32>([1, 0, 0], 3);
        let near = Vec3::new(1.0_f32 / 3.0, 0.0, 0.0);
        let ulps = single.deviation_in_ulps(near);
        assert!((ulps - 1.0 / 3.0).abs() < 1e-6, "{ulps}");
    }

    #[test]
    fn the_worst_coordinate_counts_and_zero_has_its_neighbours_ulp() {
        let exact = gauge::<f64>([0, 4, 1], 1);
        assert_eq!(exact.deviation(Vec3::new(0.0, 4.0, 1.0)), 0.0);
        assert_eq!(exact.deviation_in_ulps(Vec3::new(-0.0, 4.0, 1.0)), 0.0);
        let off = Vec3::new(0.25, 4.0, 1.0 + f64::EPSILON);
        assert_eq!(exact.deviation(off), 0.25);
        assert_eq!(exact.deviation_in_ulps(off), 2.0_f64.powi(52));
        let off = Vec3::new(0.0, 4.0, 1.0 + 3.0 * f64::EPSILON);
        assert_eq!(exact.deviation_in_ulps(off), 3.0);
    }
}
