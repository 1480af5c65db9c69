//! A face's half space `n . p + d >= 0`, known exactly, and the sign of its value at a point in
//! stages: each stage hands on the signs that it cannot decide.
//!
//! # Exact
//! The four coefficients are sums of products of a frustum's `f64` values, formed in integers,
//! times a power of two that brings the largest of `|n_j|` into `1/2 <= |n_j| < 1`. So a sign,
//! and the direction of `n`, is known without error, for any frustum.
//!
//! They are formed when a sign is first asked for that the rounded ones leave open. Those are formed from
//! values of 106 bits with an error bound ([`Ball`]), which nearly always proves them; else from integers.
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
use crate::exact::ball::Ball;
use crate::exact::double_double::Dd;
use crate::exact::dyadic::Dyadic;
use crate::exact::expansion::{Expansion, in_safe_range};
use crate::exact::float::{Lanes, exp2};
use crate::frustum::eval::boundary::boundary_in;
use crate::frustum::eval::face_coefficients;
use crate::frustum::{Face, Frustum, Shape};
use crate::math::{Pose, Real, Vec3};
use std::cmp::Ordering;
use std::ops::Deref;
use std::sync::OnceLock;

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
    /// Whether the normal points towards larger coordinates.
    up: [bool; 3],
    /// Normal and offset, rounded.
    high: [f64; 4],
    length: f64,
    /// The part of the threshold that does not depend on the point; infinite where no rounded
    /// value is certain.
    constant: f64,
    /// What the exact coefficients are made of, when they are first needed.
    source: Option<Source>,
    /// Boxed: half spaces are moved more often than these are needed.
    exact: OnceLock<Box<Exact>>,
}

/// A face of a frustum.
#[derive(Clone, Copy, Debug)]
struct Source {
    pose: Pose,
    shape: Shape,
    face: Face,
}

/// The exact coefficients.
#[derive(Clone, Debug)]
struct Exact {
    coefficients: [Dyadic; 4],
    /// The errors of rounding them, rounded.
    low: [f64; 4],
    /// Whether rounded coefficients and errors are exact, and fit expansions.
    expands: bool,
}

/// The half spaces of a frustum's faces, in the order of [`Frustum::faces`].
#[derive(Clone, Debug)]
pub(crate) struct HalfSpaces {
    /// Without a far face the last one stands twice.
    all: [HalfSpace; 6],
    count: usize,
}

impl Deref for HalfSpaces {
    type Target = [HalfSpace];
    #[inline(always)]
    fn deref(&self) -> &[HalfSpace] {
        &self.all[..self.count]
    }
}

impl HalfSpaces {
    pub(crate) fn new(frustum: &Frustum) -> Self {
        let faces = frustum.faces();
        let coefficients = face_coefficients::all(frustum.pose(), frustum.shape());
        let of = |i: usize| {
            let (pose, shape) = (*frustum.pose(), *frustum.shape());
            let face = faces[i.min(faces.len() - 1)];
            let source = Source { pose, shape, face };
            HalfSpace::of_face(&coefficients[face as usize], source)
        };
        Self {
            // Written out: `from_fn` moves each several times.
            all: [of(0), of(1), of(2), of(3), of(4), of(5)],
            count: faces.len(),
        }
    }
}

impl Source {
    /// The coefficients from values of the boundary function, which is linear.
    fn coefficients(&self) -> [Dyadic; 4] {
        let Self { pose, shape, face } = self;
        let at = |p: [f64; 3]| {
            let Ok(value) = boundary_in::<Dyadic>(pose, shape, *face, Vec3::from(p));
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
        [x, y, z, origin]
    }
}

/// Scales exact coefficients so that the largest component of the normal is between 1/2 and 1.
/// `None` for the zero vector.
fn scaled(coefficients: [Dyadic; 4]) -> Option<[Dyadic; 4]> {
    let top = coefficients[..3].iter().filter_map(Dyadic::top).max()?;
    Some(coefficients.map(|n| n.shifted(-top)))
}

fn nearest(n: &Dyadic) -> f64 {
    n.round_quotient::<f64>(&Dyadic::from(1.0))
}

fn constant_of(offset: f64) -> f64 {
    if offset.abs() < OFFSET_LIMIT {
        VALUE_RELATIVE_ERROR * offset.abs() + HALF_SPACE_UNDERFLOW_ERROR
    } else {
        f64::INFINITY
    }
}

impl Exact {
    /// Of coefficients that are scaled, and rounded to `high`.
    fn new(coefficients: [Dyadic; 4], high: &[f64; 4]) -> Self {
        let rests: [Dyadic; 4] = std::array::from_fn(|i| match high[i].is_finite() {
            true => &coefficients[i] - &Dyadic::from(high[i]),
            false => Dyadic::from(0.0),
        });
        let low = rests.each_ref().map(nearest);
        let whole = |i: usize| (&rests[i] - &Dyadic::from(low[i])).sign().is_eq();
        let fits = high.iter().chain(&low).all(|&v| in_safe_range(v));
        Self {
            expands: fits && (0..4).all(whole),
            coefficients,
            low,
        }
    }
}

/// A half space's rounded numbers.
struct Numbers {
    up: [bool; 3],
    high: [f64; 4],
    length: f64,
}

impl Numbers {
    /// The numbers that exact coefficients would give, if those to 106 bits prove them.
    fn proved(coefficients: &[Ball; 4]) -> Option<Self> {
        let mut top = i32::MIN;
        let mut high = [0.0; 4];
        let mut up = [false; 3];
        for (i, (high, n)) in high.iter_mut().zip(coefficients).enumerate() {
            *high = n.rounded()?;
            if i < 3 && *high != 0.0 {
                top = top.max(n.top()?);
                up[i] = n.sign()? == Ordering::Greater;
            }
        }
        // The scaled numbers are far from the ends of the range: what is rounded before and after scaling is
        // the same.
        let scale = (top.unsigned_abs() < 400).then(|| exp2(-top))?;
        let [x, y, z, _] = coefficients;
        let square = (*x * *x + *y * *y + *z * *z).rounded()?;
        let high = high.map(|n| n * scale);
        let is_moderate = |n: f64| n == 0.0 || (n.abs() > exp2(-400) && n.abs() < exp2(400));
        high.into_iter().all(is_moderate).then(|| Self {
            up,
            high,
            length: (square * scale * scale).sqrt(),
        })
    }
}

impl HalfSpace {
    /// From a normal and an offset; `None` for the zero vector.
    pub(crate) fn new(coefficients: [Dyadic; 4]) -> Option<Self> {
        let exact = scaled(coefficients)?;
        let high = exact.each_ref().map(nearest);
        let square = (0..3).fold(Dyadic::from(0.0), |sum, j| &sum + &(&exact[j] * &exact[j]));
        Some(Self {
            up: [0, 1, 2].map(|j| exact[j].sign() == Ordering::Greater),
            high,
            length: nearest(&square).sqrt(),
            constant: constant_of(high[3]),
            source: None,
            exact: Box::new(Exact::new(exact, &high)).into(),
        })
    }

    /// A face's, from its exact coefficients.
    #[cold]
    fn by_integers(source: Source) -> Self {
        // The axes of a frustum are independent: no normal is zero.
        let everything = || [0.0, 0.0, 1.0, f64::INFINITY];
        Self::new(source.coefficients()).unwrap_or_else(|| Self {
            up: [false, false, true],
            high: everything(),
            length: 1.0,
            constant: f64::INFINITY,
            source: Some(source),
            exact: OnceLock::new(),
        })
    }

    /// A face's; its exact coefficients are formed when they are needed, if those to 106 bits prove the others.
    #[inline(always)]
    fn of_face(coefficients: &[Ball; 4], source: Source) -> Self {
        match Numbers::proved(coefficients) {
            Some(Numbers { up, high, length }) => Self {
                up,
                high,
                length,
                constant: constant_of(high[3]),
                source: Some(source),
                exact: OnceLock::new(),
            },
            None => Self::by_integers(source),
        }
    }

    fn exact(&self) -> &Exact {
        self.exact.get_or_init(|| {
            let coefficients = self.source.map(|source| source.coefficients());
            let exact = coefficients.and_then(scaled);
            // A half space without a source has had its coefficients from the start.
            let zero = || std::array::from_fn(|_| Dyadic::from(0.0));
            Box::new(Exact::new(exact.unwrap_or_else(zero), &self.high))
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
        self.exact().coefficients[axis].sign()
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
        if self.exact().expands
            && p.to_array().into_iter().all(in_safe_range)
            && let Ok(value) = self.expansion(p)
        {
            return (value.sign(), Stage::Expansion);
        }
        (self.integer(p).sign(), Stage::Integer)
    }

    /// The upper part of the value to 106 bits.
    fn precise(&self, p: Vec3<f64>) -> f64 {
        let exact = self.exact();
        let coefficient = |i: usize| Dd::new(self.high[i], exact.low[i]);
        let [x, y, z] = [0, 1, 2].map(|j| coefficient(j).mul_f64(p[j]));
        x.add(y).add(z).add(coefficient(3)).hi
    }

    fn expansion(&self, p: Vec3<f64>) -> Result<Expansion, <Expansion as Number>::Overflow> {
        let coefficient = |i: usize| {
            Expansion::from_f64(self.exact().low[i]).add(&Expansion::from_f64(self.high[i]))
        };
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
        &self.along(p) + &self.exact().coefficients[3]
    }

    /// The value, exactly, then rounded; infinite beyond the range.
    pub(crate) fn value_rounded(&self, p: Vec3<f64>) -> f64 {
        self.integer(p).round_quotient::<f64>(&Dyadic::from(1.0))
    }

    /// The inner product with the normal, exactly.
    pub(crate) fn along(&self, v: Vec3<f64>) -> Dyadic {
        let exact = &self.exact().coefficients;
        (0..3).fold(Dyadic::from(0.0), |sum, j| {
            &sum + &(&exact[j] * &Dyadic::from(v[j]))
        })
    }

    /// Whether both are the same set of points, exactly.
    pub(crate) fn is_the_same(&self, other: &Self) -> bool {
        let (a, b) = (&self.exact().coefficients, &other.exact().coefficients);
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
        let (a, b) = (&self.exact().coefficients, &other.exact().coefficients);
        (0..3).fold(Dyadic::from(0.0), |sum, j| &sum + &(&a[j] * &b[j]))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frustum::{Camera, ClipSpace, Projection, ViewProjection};
    use crate::samples::{Family, Random};

    /// Whether each face's numbers are proved; asserts that they are then those of the integers.
    fn proved(frustum: &Frustum) -> bool {
        let coefficients = face_coefficients::all(frustum.pose(), frustum.shape());
        let mut all = true;
        for (&face, used) in frustum.faces().iter().zip(HalfSpaces::new(frustum).iter()) {
            let (pose, shape) = (*frustum.pose(), *frustum.shape());
            let source = Source { pose, shape, face };
            let slow = HalfSpace::by_integers(source);
            let numbers = |h: &HalfSpace| {
                let [a, b, c, d] = h.high.map(f64::to_bits);
                (h.up, a, b, c, d, h.length.to_bits(), h.constant.to_bits())
            };
            assert_eq!(numbers(used), numbers(&slow), "{face} of {frustum:?}");
            let (used, slow) = (used.exact(), slow.exact());
            assert_eq!((used.low, used.expands), (slow.low, slow.expands));
            all &= Numbers::proved(&coefficients[face as usize]).is_some();
        }
        all
    }

    #[test]
    fn of_cameras_and_their_matrices() {
        let mut random = Random::new(&[14, 5]);
        let mut count = 0;
        for i in 0..3_000 {
            let mut point =
                |reach: f64| Vec3::from([(); 3].map(|()| random.between(-reach, reach)));
            let (eye, ahead) = (point([10.0, 1e4, 1e7][i % 3]), point(1.0));
            let projection = match i % 2 {
                0 => Projection::Perspective {
                    fovy: 1.0,
                    aspect: 1.5,
                },
                _ => Projection::Orthographic {
                    height: 20.0,
                    aspect: 1.5,
                },
            };
            let far = if i % 4 == 0 { f64::INFINITY } else { 1e3 };
            let up = Vec3::new(0.0, 1.0, 0.0);
            let camera = Camera::new(eye, eye + ahead, up, projection, 0.1, far);
            let frustum = camera.frustum().unwrap();
            count += usize::from(proved(&frustum));
            if let Ok(matrix) = frustum.view_projection(ClipSpace::ZERO_TO_ONE) {
                let matrix: ViewProjection<f32> = matrix.to_f32();
                if let Ok(found) = matrix.frustum(ClipSpace::ZERO_TO_ONE) {
                    proved(&found.frustum);
                }
            }
        }
        assert!(count > 2_990, "{count}");
    }

    #[test]
    fn of_hard_frusta() {
        let (mut some, mut others) = (0, 0);
        for &family in Family::ALL {
            for block in 0..40 {
                match proved(family.scene(14, block).frustum()) {
                    true => some += 1,
                    false => others += 1,
                }
            }
        }
        println!("{some} proved, {others} by integers");
        assert!(some > 500 && others > 50, "{some} {others}");
    }
}
