//! Four segments side by side.

use crate::clip::rules::compare::{Compare, MinMax};
use crate::exact::float::{Lanes, Width, split};
use crate::frustum::Term;
use crate::math::{Real, Segment, Vec3};
#[cfg(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64"))]
use fearless_simd::Level;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f32x16, f64x4, mask64x4};

/// Makes registers of four `f64`, at a vector width.
#[derive(Clone, Copy)]
pub(super) struct Quad<S>(pub(super) S);

impl<S: Simd> Width<4> for Quad<S> {
    type Lanes = f64x4<S>;

    #[inline(always)]
    fn lanes(self, values: [f64; 4]) -> f64x4<S> {
        values.simd_into(self.0)
    }
}

impl<S: Simd> Quad<S> {
    /// The same value in each lane.
    #[inline(always)]
    pub(super) fn splat(self, value: f64) -> f64x4<S> {
        value.simd_into(self.0)
    }

    /// Four points.
    #[inline(always)]
    pub(super) fn points(self, p: [Vec3<f64>; 4]) -> Vec3<f64x4<S>> {
        Vec3::new(
            self.lanes(p.map(|p| p.x)),
            self.lanes(p.map(|p| p.y)),
            self.lanes(p.map(|p| p.z)),
        )
    }

    /// A mask.
    #[inline(always)]
    pub(super) fn mask(self, lanes: [bool; 4]) -> mask64x4<S> {
        lanes.map(|lane| -i64::from(lane)).simd_into(self.0)
    }
}

/// Both ends of four segments, in `f64`.
#[inline(always)]
pub(super) fn ends<T: Real>(segments: [&Segment<T>; 4]) -> [[Vec3<f64>; 4]; 2] {
    [
        segments.map(|s| s.start.to_f64()),
        segments.map(|s| s.end.to_f64()),
    ]
}

/// Whether a product and a sum can be fused into one instruction.
#[inline(always)]
fn fuses<S: Simd>(simd: S) -> bool {
    match simd.level() {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Avx2(_) | Level::Avx512(_) => true,
        #[cfg(target_arch = "aarch64")]
        Level::Neon(_) => true,
        _ => false,
    }
}

impl<S: Simd> Term for f64x4<S> {}
impl<S: Simd> Term for f32x8<S> {}

impl<S: Simd> Lanes for f64x4<S> {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value.simd_into(self.token())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        SimdBase::abs(self)
    }

    /// One fused operation, where there is one: the rest of a product is an `f64`, so
    /// both ways give the same bits, except where it underflows. There a value
    /// that matters is above 2^-500, and the difference, below 2^-1070, is lost
    /// in the sum.
    #[inline(always)]
    fn product_rest(self, (ah, al): (Self, Self), b: Self, p: Self) -> Self {
        if fuses(self.token()) {
            return self.mul_sub_precise(b, p);
        }
        let (bh, bl) = split(b);
        al * bl - (((p - ah * bh) - al * bh) - ah * bl)
    }
}

/// For every register that segments are clipped in.
macro_rules! min_max {
    ($($register:ident)*) => {$(
        impl<S: Simd> MinMax for $register<S> {
            #[inline(always)]
            fn lesser(self, other: Self) -> Self {
                SimdBase::min(self, other)
            }

            #[inline(always)]
            fn greater(self, other: Self) -> Self {
                SimdBase::max(self, other)
            }

            #[inline(always)]
            fn magnitude(self) -> Self {
                SimdBase::abs(self)
            }
        }
    )*};
}

min_max!(f32x8 f32x16 f64x4);

impl<S: Simd> Compare for f64x4<S> {
    type Mask = mask64x4<S>;

    #[inline(always)]
    fn is_less(self, other: Self) -> mask64x4<S> {
        self.simd_lt(other)
    }

    #[inline(always)]
    fn is_equal(self, other: Self) -> mask64x4<S> {
        self.simd_eq(other)
    }

    #[inline(always)]
    fn any(mask: mask64x4<S>) -> bool {
        mask.any_true()
    }

    #[inline(always)]
    fn select(mask: mask64x4<S>, set: Self, clear: Self) -> Self {
        mask.select(set, clear)
    }

    #[inline(always)]
    fn tagged(self, tag: Self) -> Self {
        f64x4::from_bits((self.to_bits() & !7) | tag.to_bits())
    }
}
