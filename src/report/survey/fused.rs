//! Plain arithmetic in `f64` that rounds a product and the sum it goes into once.
//!
//! It is a scalar type of its own, so that every plain algorithm runs on it as it
//! stands: a product that is added is `Sealed::times_plus` there, which is two
//! roundings for `f32` and `f64` and one here. Coefficients of the frustum are the
//! same as without it.
//!
//! An instruction set without one for it makes a call of each. So the clipper below
//! is compiled for what the machine has, and
//! [`fuses_in_one_instruction`] says whether that is enough.

use super::row::SurveyAlgorithm;
use crate::clip::liang_barsky::{Plain, Textbook, Tuned};
use crate::clip::plain::{PlainClip, in_frame, run_prepared};
use crate::clip::{Part, PartEnd, SegmentClip};
use crate::clip::{cohen_sutherland, cyrus_beck, six_planes, vw};
use crate::frustum::{Frustum, PlainFrustum};
use crate::math::{NonFinite, PerReal, Real, Sealed, Segment, Vec3};
use fearless_simd::{Level, Simd, dispatch};
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A double whose products are added without being rounded first.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(super) struct Fused(f64);

impl Sealed for Fused {
    fn pick<P: PerReal>(_: &P) -> Option<&P::Of<Self>> {
        None
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        Fused(self.0.mul_add(factor.0, term.0))
    }
}

impl Real for Fused {
    const UNIT_ROUNDOFF: f64 = f64::UNIT_ROUNDOFF;
    const MIN_SUBNORMAL: f64 = f64::MIN_SUBNORMAL;
    const DIGITS: u32 = f64::DIGITS;
    const ZERO: Self = Fused(0.0);
    const ONE: Self = Fused(1.0);

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0
    }
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Fused(value)
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Fused(self.0.abs())
    }
    #[inline]
    fn next_up(self) -> Self {
        Fused(self.0.next_up())
    }
    #[inline]
    fn next_down(self) -> Self {
        Fused(self.0.next_down())
    }
}

impl fmt::Display for Fused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl $trait for Fused {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Fused(self.0 $operator other.0)
            }
        }
    )*};
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Fused {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Fused(-self.0)
    }
}

/// Whether this machine has an instruction for it; else each one is a call.
pub fn fuses_in_one_instruction() -> bool {
    let level = Level::new();
    #[cfg(target_arch = "x86_64")]
    let has = level.as_avx2().is_some();
    #[cfg(not(target_arch = "x86_64"))]
    let has = cfg!(target_arch = "aarch64") && !level.is_fallback();
    has
}

/// A plain algorithm on fused arithmetic, compiled for the machine's level.
#[derive(Clone, Copy, Debug)]
pub(super) struct FusedClipper {
    algorithm: SurveyAlgorithm,
    level: Level,
}

impl FusedClipper {
    pub(super) fn new(algorithm: SurveyAlgorithm) -> Self {
        Self {
            algorithm,
            level: Level::new(),
        }
    }

    /// Clips; `plain` holds the frustum's coefficients.
    pub(super) fn clip(
        self,
        frustum: &Frustum,
        plain: &PlainFrustum<Fused>,
        segment: &Segment<f64>,
    ) -> Result<SegmentClip<f64>, NonFinite> {
        macro_rules! with {
            ($clip:expr) => {
                dispatch!(self.level, simd => simd.vectorize(
                    #[inline(always)]
                    || clip_as(frustum, plain, segment, $clip)
                ))
            };
        }
        match self.algorithm {
            SurveyAlgorithm::Vw => with!(in_frame::<vw::Plain, Fused>),
            SurveyAlgorithm::LiangBarskyTuned => with!(in_frame::<Plain<Tuned>, Fused>),
            SurveyAlgorithm::LiangBarskyTextbook => with!(in_frame::<Plain<Textbook>, Fused>),
            SurveyAlgorithm::CyrusBeck => with!(cyrus_beck::clip),
            SurveyAlgorithm::CohenSutherland => {
                with!(in_frame::<cohen_sutherland::Plain, Fused>)
            }
            SurveyAlgorithm::SixPlanes => with!(six_planes::clip),
        }
    }
}

#[inline(always)]
fn clip_as(
    frustum: &Frustum,
    plain: &PlainFrustum<Fused>,
    segment: &Segment<f64>,
    clip: PlainClip<Fused>,
) -> Result<SegmentClip<f64>, NonFinite> {
    let fused = |v: Vec3<f64>| Vec3::new(Fused(v.x), Fused(v.y), Fused(v.z));
    let segment = Segment::new(fused(segment.start), fused(segment.end));
    let answer = run_prepared(frustum, plain, &segment, clip)?;
    let end = |end: PartEnd<Fused>| PartEnd {
        t: end.t.0,
        point: end.point.to_f64(),
        clipped: end.clipped,
        faces: end.faces,
        inward: end.inward,
    };
    Ok(SegmentClip {
        class: answer.class,
        part: answer.part.map(|part| Part {
            entry: end(part.entry),
            exit: end(part.exit),
            coplanar: part.coplanar,
        }),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::{
        CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper,
    };
    use crate::clip::{SixPlanes, VwProjection};
    use crate::samples::Family;

    #[test]
    fn a_product_and_its_sum_are_rounded_once() {
        // (1 + e)^2 = 1 + 2 e + e^2, of which one rounding loses e^2.
        let x = 1.0 + f64::EPSILON;
        let minus = -(1.0 + 2.0 * f64::EPSILON);
        assert_eq!(x.times_plus(x, minus), 0.0);
        let once = Fused(x).times_plus(Fused(x), Fused(minus));
        assert_eq!(once, Fused(f64::EPSILON * f64::EPSILON));
    }

    /// Through the trait, which knows nothing of the machine's level.
    fn by_trait(algorithm: SurveyAlgorithm) -> Box<dyn SegmentClipper<Fused>> {
        match algorithm {
            SurveyAlgorithm::Vw => Box::new(VwProjection::plain()),
            SurveyAlgorithm::LiangBarskyTuned => {
                Box::new(LiangBarsky::plain(LiangBarskyVariant::Tuned))
            }
            SurveyAlgorithm::LiangBarskyTextbook => {
                Box::new(LiangBarsky::plain(LiangBarskyVariant::Textbook))
            }
            SurveyAlgorithm::CyrusBeck => Box::new(CyrusBeck::plain()),
            SurveyAlgorithm::CohenSutherland => Box::new(CohenSutherland::plain()),
            SurveyAlgorithm::SixPlanes => Box::new(SixPlanes::plain()),
        }
    }

    #[test]
    fn the_machines_instructions_give_the_calls_bits_and_other_bits_than_two_roundings() {
        let fused = |v: Vec3<f64>| Vec3::new(Fused(v.x), Fused(v.y), Fused(v.z));
        for algorithm in SurveyAlgorithm::ALL {
            let clipper = FusedClipper::new(algorithm);
            let (called, twice) = (by_trait(algorithm), LiangBarsky::plain(Default::default()));
            assert_eq!(called.name(), algorithm.name());
            let mut others = 0;
            for family in [Family::FreePose, Family::Huge, Family::Subnormal] {
                for index in 0..200 {
                    let (frustum, segment) = family.case(3, index);
                    let answer = clipper.clip(&frustum, &frustum.plain_scaled(1.0), &segment);
                    let answer = answer.unwrap();
                    let wide = Segment::new(fused(segment.start), fused(segment.end));
                    let other = called.clip_segment(&frustum, &wide).unwrap();
                    assert_eq!(answer.class, other.class, "{algorithm} {family} {index}");
                    let points = other.points().map(|ends| ends.map(Vec3::to_f64));
                    assert_eq!(answer.points(), points, "{algorithm} {family} {index}");
                    let plain = twice.clip_segment(&frustum, &segment).unwrap();
                    others += u32::from(plain.points() != answer.points());
                }
            }
            assert!(others > 20, "{algorithm}: {others}");
        }
    }
}
