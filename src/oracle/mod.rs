//! An independent reference implementation: clipping and classification by rational arithmetic,
//! slow and obvious.
//!
//! Every finite `f64` is an integer times a power of two, and so, exactly, is the value of every
//! boundary function of a frustum at every representable point. Along a segment
//! `p + t (q - p)` a boundary function `f` is linear: it is zero at
//! `t = f(p) / (f(p) - f(q))`. Clipping is then
//!
//! ```text
//! low = 0, high = 1
//! for each face:
//!     f(p) < 0 and f(q) < 0    the segment is outside
//!     f(p) < 0 <= f(q)         low = max(low, t)
//!     f(p) >= 0 > f(q)         high = min(high, t)
//! the segment is outside if low > high
//! a face belongs to an end's set if its function is zero there
//! ```
//!
//! with fractions compared by cross multiplication. No floating-point operation is
//! used, and nothing is shared with the fast code that is compared with this. Any
//! finite input is valid: subnormals, `1e300`, both at once. A segment of zero length
//! is its point; `0 / 0` does not arise, because a face with `f(p) = f(q)` never bounds
//! the interval.
//!
//! [`Oracle::check`] compares a clipper's answer with the exact one and names each
//! guarantee that it violates; [`check_swapped`] and [`check_idempotent`] compare a clipper
//! with itself.
//!
//! [`Oracle::classify`] and [`Oracle::intersects`] give the exact position of bounding volumes
//! relative to a frustum, by integer arithmetic likewise.

mod check;
mod dyadic;
mod frame;
mod gauge;
mod half_space;
mod inward;
mod near;
mod nearest;
mod reference;
mod round;
mod separation;
mod vector;
mod violation;
mod volume;

pub use check::{check, check_idempotent, check_swapped, is_mirrored};
pub use gauge::Gauge;
pub use reference::OracleClipper;
pub use round::round_nearest;
pub use violation::{Violation, ViolationKind};

use crate::clip::Class;
use crate::frustum::{FaceSet, Frustum, Shape};
use crate::math::{NonFinite, Pose, Real, Segment, Vec3};
use dyadic::Dyadic;
use half_space::{HalfSpace, half_spaces};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::sync::OnceLock;
use vector::exact_point;

/// A frustum prepared for exact queries.
#[derive(Debug)]
pub struct Oracle {
    half_spaces: Vec<HalfSpace>,
    /// The ends' `z` if frame coordinates are world coordinates.
    world_ends: Option<[Option<f64>; 2]>,
    pose: Pose,
    shape: Shape,
    /// Prepared for the first volume.
    separation: OnceLock<separation::Separation>,
    nearest: OnceLock<nearest::Nearest>,
}

/// The exact result of clipping a segment.
#[derive(Clone, Debug, PartialEq)]
pub struct OracleClip {
    /// The position of the segment relative to the frustum.
    pub class: Class,
    /// The part in the frustum; `None` exactly if the class is `Outside`.
    pub part: Option<OraclePart>,
}

/// The exact part of a segment in a frustum.
#[derive(Clone, Debug, PartialEq)]
pub struct OraclePart {
    /// The end at which the segment enters.
    pub entry: OracleEnd,
    /// The end at which it leaves.
    pub exit: OracleEnd,
    /// The faces whose planes contain the whole segment.
    pub coplanar: FaceSet,
}

/// One exact end of that part. The fractions are not in lowest terms.
#[derive(Clone, Debug, PartialEq)]
pub struct OracleEnd {
    /// The parameter on the segment.
    pub t: BigRational,
    /// The point.
    pub point: [BigRational; 3],
    /// Whether the segment continues beyond this end.
    pub clipped: bool,
    /// The faces whose planes contain the point.
    pub faces: FaceSet,
}

/// Clips a segment exactly.
///
/// ```
/// use frusta::{Class, EndRect, Face, Frustum, Pose, Segment, Shape};
/// let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let segment = Segment::new([0.0, 0.0, 0.0], [0.0, 0.0, 3.0]);
/// let clip = frusta::oracle::clip(&frustum, &segment)?;
/// let part = clip.part.unwrap();
/// assert_eq!(clip.class, Class::Cross);
/// assert_eq!(part.entry.t.to_string(), "1/3");
/// assert_eq!(part.exit.faces, Face::Far.into());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A coordinate of the segment is infinite or NaN.
pub fn clip(frustum: &Frustum, segment: &Segment<f64>) -> Result<OracleClip, NonFinite> {
    Oracle::new(frustum).clip(segment)
}

/// Whether a point is in the closed frustum, exactly; false for a point that is not
/// finite.
pub fn contains(frustum: &Frustum, point: Vec3<f64>) -> bool {
    Oracle::new(frustum).contains(point)
}

impl Oracle {
    /// Prepares the exact half-spaces of a frustum.
    pub fn new(frustum: &Frustum) -> Self {
        let world_ends = frustum.pose().is_identity().then(|| match frustum.shape() {
            Shape::Finite { near, far } => [Some(near.z), Some(far.z)],
            Shape::Infinite { near, .. } => [Some(near.z), None],
        });
        Self {
            half_spaces: half_spaces(frustum),
            world_ends,
            pose: *frustum.pose(),
            shape: *frustum.shape(),
            separation: OnceLock::new(),
            nearest: OnceLock::new(),
        }
    }

    /// Whether a point is in the closed frustum, exactly; false for a point that is not
    /// finite.
    pub fn contains<T: Real>(&self, point: Vec3<T>) -> bool {
        let exact = exact_point(point.to_f64());
        point.is_finite()
            && self
                .half_spaces
                .iter()
                .all(|h| !h.value_at(&exact).is_negative())
    }

    /// Clips a segment exactly.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    pub fn clip<T: Real>(&self, segment: &Segment<T>) -> Result<OracleClip, NonFinite> {
        segment.check_finite()?;
        let p = exact_point(segment.start.to_f64());
        let q = exact_point(segment.end.to_f64());
        // The boundary functions at both ends.
        let values: Vec<[Dyadic; 2]> = self
            .half_spaces
            .iter()
            .map(|h| [h.value_at(&p), h.value_at(&q)])
            .collect();
        let Some([low, high]) = interval(&values) else {
            return Ok(OracleClip {
                class: Class::Outside,
                part: None,
            });
        };
        let end_at = |t: &Fraction, clipped: bool| OracleEnd {
            t: t.to_rational(),
            point: [0, 1, 2].map(|k| t.between(&p[k], &q[k]).over(&t.denominator)),
            clipped,
            faces: self.faces_where(&values, |[fp, fq]| t.between(fp, fq).is_zero()),
        };
        let zero_length = p == q;
        let coplanar = if zero_length {
            FaceSet::EMPTY
        } else {
            self.faces_where(&values, |[fp, fq]| fp.is_zero() && fq.is_zero())
        };
        let part = OraclePart {
            entry: end_at(&low, !low.is_zero()),
            exit: end_at(&high, !high.is_one()),
            coplanar,
        };
        let class = class(&part, zero_length, low.equals(&high));
        Ok(OracleClip {
            class,
            part: Some(part),
        })
    }

    fn faces_where(
        &self,
        values: &[[Dyadic; 2]],
        condition: impl Fn(&[Dyadic; 2]) -> bool,
    ) -> FaceSet {
        self.half_spaces
            .iter()
            .zip(values)
            .filter(|(_, v)| condition(v))
            .map(|(h, _)| h.face)
            .collect()
    }
}

fn class(part: &OraclePart, zero_length: bool, one_point: bool) -> Class {
    let on_surface = !part.entry.faces.is_empty();
    match (zero_length, one_point) {
        (true, _) if on_surface => Class::Touch,
        (true, _) => Class::Inside,
        (false, true) => Class::Touch,
        (false, false) if !part.coplanar.is_empty() => Class::Boundary,
        (false, false) if !part.entry.clipped && !part.exit.clipped => Class::Inside,
        (false, false) => Class::Cross,
    }
}

/// The parameters at which no boundary function is negative.
fn interval(values: &[[Dyadic; 2]]) -> Option<[Fraction; 2]> {
    let (mut low, mut high) = (Fraction::zero(), Fraction::one());
    for [fp, fq] in values {
        match (fp.is_negative(), fq.is_negative()) {
            (true, true) => return None,
            (true, false) => {
                let t = Fraction::root(fp, fq);
                if low.is_less_than(&t) {
                    low = t;
                }
            }
            (false, true) => {
                let t = Fraction::root(fp, fq);
                if t.is_less_than(&high) {
                    high = t;
                }
            }
            (false, false) => {}
        }
    }
    (!high.is_less_than(&low)).then_some([low, high])
}

/// A fraction with a positive denominator, not in lowest terms.
struct Fraction {
    numerator: BigInt,
    denominator: BigInt,
}

impl Fraction {
    fn zero() -> Self {
        Self {
            numerator: BigInt::zero(),
            denominator: BigInt::one(),
        }
    }

    fn one() -> Self {
        Self {
            numerator: BigInt::one(),
            denominator: BigInt::one(),
        }
    }

    /// The zero of the line from `fp` at 0 to `fq` at 1; `fp != fq`.
    fn root(fp: &Dyadic, fq: &Dyadic) -> Self {
        let (fp, fq, _) = fp.aligned(fq);
        let difference = &fp - fq;
        if difference.is_negative() {
            Self {
                numerator: -fp,
                denominator: -difference,
            }
        } else {
            Self {
                numerator: fp,
                denominator: difference,
            }
        }
    }

    /// `denominator` times the value at this parameter of the line from `a` at
    /// 0 to `b` at 1.
    fn between(&self, a: &Dyadic, b: &Dyadic) -> Dyadic {
        &(a * &(&self.denominator - &self.numerator)) + &(b * &self.numerator)
    }

    fn is_less_than(&self, other: &Self) -> bool {
        &self.numerator * &other.denominator < &other.numerator * &self.denominator
    }

    fn equals(&self, other: &Self) -> bool {
        &self.numerator * &other.denominator == &other.numerator * &self.denominator
    }

    fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }

    fn is_one(&self) -> bool {
        self.numerator == self.denominator
    }

    fn to_rational(&self) -> BigRational {
        BigRational::new_raw(self.numerator.clone(), self.denominator.clone())
    }
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod volume_tests;
