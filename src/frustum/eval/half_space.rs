//! A face's half space `n . p + d >= 0`, known exactly, and the sign of its value at a point in
//! stages: each stage hands on the signs that it cannot decide.
//!
//! # Exact
//! The four coefficients are sums of products of a frustum's `f64` values, formed in integers,
//! times a power of two that brings the largest of `|n_j|` into `1/2 <= |n_j| < 1`. So a sign,
//! and the direction of `n`, is known without error, for any frustum.
//!
//! # Rounded
//! With u = 2^-53, S >= |p_x| + |p_y| + |p_z| and the four coefficients rounded: a coefficient
//! has a relative error of u, a product adds u, each of two sums after it adds u. `|n_j| < 1`, so
//! ```text
//! |g~ - g| <= 4.01 u S + 3.01 u |d|
//! ```
//! and the threshold is `T = 8 u S + 8 u |d| + HALF_SPACE_UNDERFLOW_ERROR`, which leaves room for its own
//! rounding.
//!
//! # To 106 bits
//! With a coefficient as a sum of two `f64` values within u^2, a product adds 3 u^2, three
//! double-double sums add 3 u^2 each (`exact/double_double.rs`): 13.1 u^2 S + 4.1 u^2 |d|. The
//! threshold is 2^-51 of the rounded one: 32 u^2 S + 32 u^2 |d| + 2^-51 HALF_SPACE_UNDERFLOW_ERROR.
//!
//! A comparison is written with `>`, so that NaN and infinity fail it.

use crate::exact::Number;
use crate::exact::double_double::Dd;
use crate::exact::dyadic::Dyadic;
use crate::exact::expansion::{Expansion, in_safe_range};
use crate::exact::float::{Lanes, exp2};
use crate::frustum::eval::boundary::boundary;
use crate::frustum::{Face, Frustum};
use crate::math::{Real, Vec3};
use std::cmp::Ordering;

/// Bounds a rounded value's error relative to S and |d|: 8 u, where 4.01 u and 3.01 u are needed.
const VALUE_RELATIVE_ERROR: f64 = 8.0 * f64::UNIT_ROUNDOFF;
/// The threshold of values of 106 bits relative to that of rounded ones: 32 u^2 / 8 u = 4 u.
const DOUBLE_DOUBLE_TO_ROUNDED: f64 = 4.0 * f64::UNIT_ROUNDOFF;
/// Bounds what underflow does to a value: far above 2^-1074, far below every size.
const HALF_SPACE_UNDERFLOW_ERROR: f64 = exp2(-900);
/// Bounds the offset: below it no intermediate value overflows while S is below it, too.
pub(crate) const OFFSET_LIMIT: f64 = exp2(900);

/// The stage that decided a sign that the rounded value left open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    DoubleDouble,
    Expansion,
    Integer,
}

/// The points with `normal . p + offset >= 0`.
#[derive(Clone, Debug)]
pub(crate) struct HalfSpace {
    exact: [Dyadic; 4],
    /// Whether the normal points towards larger coordinates.
    up: [bool; 3],
    /// Normal and offset, rounded.
    high: [f64; 4],
    /// The errors of that rounding, rounded.
    low: [f64; 4],
    /// Whether `high + low` is exact, and fits expansions.
    expands: bool,
    length: f64,
    /// The part of the threshold that does not depend on the point; infinite where no rounded
    /// value is certain.
    constant: f64,
}

impl HalfSpace {
    /// The half spaces of a frustum's faces, in the order of [`Frustum::faces`].
    pub(crate) fn of_faces(frustum: &Frustum) -> Box<[HalfSpace]> {
        let faces = frustum.faces().iter();
        // The axes of a frustum are independent: no normal is zero.
        faces
            .filter_map(|&face| Self::of_face(frustum, face))
            .collect()
    }

    /// A face's half space from values of its boundary function, which is linear.
    fn of_face(frustum: &Frustum, face: Face) -> Option<Self> {
        let at = |p: [f64; 3]| {
            let Ok(value) = boundary::<Dyadic>(frustum, face, Vec3::from(p));
            value
        };
        let origin = at([0.0; 3]);
        let along = |p| &at(p) - &origin;
        let normal = [
            along([1.0, 0.0, 0.0]),
            along([0.0, 1.0, 0.0]),
            along([0.0, 0.0, 1.0]),
        ];
        let [x, y, z] = normal;
        Self::new([x, y, z, origin])
    }

    /// From a normal and an offset; `None` for the zero vector.
    pub(crate) fn new(coefficients: [Dyadic; 4]) -> Option<Self> {
        let top = coefficients[..3].iter().filter_map(Dyadic::top).max()?;
        let exact = coefficients.map(|n| n.shifted(-top));
        let one = Dyadic::from(1.0);
        let rounded = |n: &Dyadic| n.round_quotient::<f64>(&one);
        let high = exact.each_ref().map(rounded);
        let rests: [Dyadic; 4] = std::array::from_fn(|i| match high[i].is_finite() {
            true => &exact[i] - &Dyadic::from(high[i]),
            false => Dyadic::from(0.0),
        });
        let low = rests.each_ref().map(rounded);
        let whole = |i: usize| (&rests[i] - &Dyadic::from(low[i])).sign().is_eq();
        let fits = high.iter().chain(&low).all(|&v| in_safe_range(v));
        let square = (0..3).fold(Dyadic::from(0.0), |sum, j| &sum + &(&exact[j] * &exact[j]));
        let certain = high[3].abs() < OFFSET_LIMIT;
        Some(Self {
            expands: fits && (0..4).all(whole),
            length: rounded(&square).sqrt(),
            constant: if certain {
                VALUE_RELATIVE_ERROR * high[3].abs() + HALF_SPACE_UNDERFLOW_ERROR
            } else {
                f64::INFINITY
            },
            up: [0, 1, 2].map(|j| exact[j].sign() == Ordering::Greater),
            exact,
            high,
            low,
        })
    }

    /// Normal and offset, rounded.
    #[inline(always)]
    pub(crate) fn rounded(&self) -> [f64; 4] {
        self.high
    }

    /// The length of the normal, with a relative error of at most 2 u.
    #[inline(always)]
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// Whether the normal points towards larger coordinates, exactly.
    #[inline(always)]
    pub(crate) fn points_up(&self, axis: usize) -> bool {
        self.up[axis]
    }

    /// The sign of a component of the normal, exactly.
    pub(crate) fn direction(&self, axis: usize) -> Ordering {
        self.exact[axis].sign()
    }

    /// The part of [`HalfSpace::threshold`] that does not depend on the point.
    pub(crate) fn constant(&self) -> f64 {
        self.constant
    }

    /// The error bound of a rounded value at a point of this [`size`].
    #[inline(always)]
    pub(crate) fn threshold(&self, size: f64) -> f64 {
        threshold(size, self.constant)
    }

    /// The sign of the value at a point where the rounded value leaves it open, and the stage
    /// that decided it.
    #[cold]
    pub(crate) fn sign_beyond_filter(&self, p: Vec3<f64>) -> (Ordering, Stage) {
        let value = self.precise(p);
        if value.abs() > DOUBLE_DOUBLE_TO_ROUNDED * self.threshold(size(p)) {
            return (value.total_cmp(&0.0), Stage::DoubleDouble);
        }
        if self.expands
            && p.to_array().into_iter().all(in_safe_range)
            && let Ok(value) = self.expansion(p)
        {
            return (value.sign(), Stage::Expansion);
        }
        (self.integer(p).sign(), Stage::Integer)
    }

    /// The upper part of the value to 106 bits.
    fn precise(&self, p: Vec3<f64>) -> f64 {
        let coefficient = |i: usize| Dd::new(self.high[i], self.low[i]);
        let [x, y, z] = [0, 1, 2].map(|j| coefficient(j).mul_f64(p[j]));
        x.add(y).add(z).add(coefficient(3)).hi
    }

    fn expansion(&self, p: Vec3<f64>) -> Result<Expansion, <Expansion as Number>::Overflow> {
        let coefficient =
            |i: usize| Expansion::from_f64(self.low[i]).add(&Expansion::from_f64(self.high[i]));
        let mut sum = coefficient(3)?;
        for j in 0..3 {
            if p[j] != 0.0 {
                sum = sum.add(&coefficient(j)?.mul(&Expansion::from_f64(p[j]))?)?;
            }
        }
        Ok(sum)
    }

    /// The value, exactly.
    pub(crate) fn integer(&self, p: Vec3<f64>) -> Dyadic {
        &self.along(p) + &self.exact[3]
    }

    /// The value, exactly, then rounded; infinite beyond the range.
    pub(crate) fn value_rounded(&self, p: Vec3<f64>) -> f64 {
        self.integer(p).round_quotient::<f64>(&Dyadic::from(1.0))
    }

    /// The inner product with the normal, exactly.
    pub(crate) fn along(&self, v: Vec3<f64>) -> Dyadic {
        (0..3).fold(Dyadic::from(0.0), |sum, j| {
            &sum + &(&self.exact[j] * &Dyadic::from(v[j]))
        })
    }

    /// Whether both are the same set of points, exactly.
    pub(crate) fn is_the_same(&self, other: &Self) -> bool {
        let (a, b) = (&self.exact, &other.exact);
        let k = (0..3).find(|&k| a[k].sign().is_ne()).unwrap_or(0);
        a[k].sign() == b[k].sign()
            && (0..4).all(|i| (&(&a[i] * &b[k]) - &(&b[i] * &a[k])).sign().is_eq())
    }

    /// The square of the normal's length, exactly.
    pub(crate) fn square(&self) -> Dyadic {
        self.product(self)
    }

    /// The inner product of two normals, exactly.
    pub(crate) fn product(&self, other: &Self) -> Dyadic {
        (0..3).fold(Dyadic::from(0.0), |sum, j| {
            &sum + &(&self.exact[j] * &other.exact[j])
        })
    }
}

/// `n . p + d` of one half space or of one a lane, in the order of operations that the error bound
/// holds for.
#[inline(always)]
pub(crate) fn value<F: Lanes>([a, b, c, d]: [F; 4], p: Vec3<f64>) -> F {
    (a * a.splat(p.x) + b * a.splat(p.y)) + (c * a.splat(p.z) + d)
}

/// The error bound of a rounded value at a point of this [`size`].
#[inline(always)]
pub(crate) fn threshold(size: f64, constant: f64) -> f64 {
    VALUE_RELATIVE_ERROR * size + constant
}

/// The sum of the coordinates' magnitudes.
#[inline(always)]
pub(crate) fn size(p: Vec3<f64>) -> f64 {
    p.x.abs() + p.y.abs() + p.z.abs()
}
