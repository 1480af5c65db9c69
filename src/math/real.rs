//! The two scalar types of points.

use std::fmt::{self, Debug, Display};
use std::ops::{Add, Div, Mul, Neg, Sub};

mod sealed {
    use super::Real;

    /// A pair of values, one for each scalar type; generic code selects its own with
    /// `T::pick`.
    pub trait PerReal {
        /// The type of the value for `T`.
        type Of<T: Real>;
        /// The value for `f32`.
        fn single(&self) -> &Self::Of<f32>;
        /// The value for `f64`.
        fn double(&self) -> &Self::Of<f64>;
    }

    pub trait Sealed: Sized {
        /// The value of the pair for this scalar type.
        fn pick<P: PerReal>(both: &P) -> &P::Of<Self>
        where
            Self: Real;
    }
    impl Sealed for f32 {
        #[inline(always)]
        fn pick<P: PerReal>(both: &P) -> &P::Of<f32> {
            both.single()
        }
    }
    impl Sealed for f64 {
        #[inline(always)]
        fn pick<P: PerReal>(both: &P) -> &P::Of<f64> {
            both.double()
        }
    }
}

pub(crate) use sealed::PerReal;

/// The scalar type of a point: `f32` or `f64`. The trait is sealed.
pub trait Real:
    sealed::Sealed
    + Copy
    + PartialEq
    + PartialOrd
    + Default
    + Debug
    + Display
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// Half the distance from 1 to the next larger value: the largest relative
    /// error of one rounding (2^-24 or 2^-53).
    const UNIT_ROUNDOFF: f64;
    /// The smallest positive value, as `f64`.
    const MIN_SUBNORMAL: f64;
    /// Bits of the significand, the hidden one included (24 or 53).
    const DIGITS: u32;
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Positive infinity.
    const INFINITY: Self;
    /// Negative infinity.
    const NEG_INFINITY: Self;

    /// The same value in `f64`; always exact.
    fn to_f64(self) -> f64;
    /// The nearest value, ties to even; infinite beyond the range.
    fn from_f64(value: f64) -> Self;
    /// Whether the value is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// The magnitude.
    fn abs(self) -> Self;
    /// The least value greater than this one.
    fn next_up(self) -> Self;
    /// The greatest value less than this one.
    fn next_down(self) -> Self;
}

macro_rules! real {
    ($t:ident, $u:expr, $sub:expr) => {
        impl Real for $t {
            const UNIT_ROUNDOFF: f64 = $u;
            const MIN_SUBNORMAL: f64 = $sub;
            const DIGITS: u32 = $t::MANTISSA_DIGITS;
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const INFINITY: Self = $t::INFINITY;
            const NEG_INFINITY: Self = $t::NEG_INFINITY;

            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $t
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                self.is_finite()
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline]
            fn next_up(self) -> Self {
                self.next_up()
            }
            #[inline]
            fn next_down(self) -> Self {
                self.next_down()
            }
        }
    };
}

real!(f32, f32::EPSILON as f64 / 2.0, f32::from_bits(1) as f64);
real!(f64, f64::EPSILON / 2.0, f64::from_bits(1));

/// Displays a scalar in a message: the shortest text that reads back, with an exponent if
/// it would be long otherwise. (`Display` of 1e300 has 301 digits.)
pub(crate) struct Short<T>(pub(crate) T);

impl<T: Real> fmt::Display for Short<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:?}", self.0);
        f.write_str(text.strip_suffix(".0").unwrap_or(&text))
    }
}
