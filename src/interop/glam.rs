//! `glam`: `Vec3`, `Vec3A`, `DVec3` as points, `Mat4`, `DMat4` as
//! view-projection matrices (columns, acting on column vectors).
//!
//! One feature a version, as one program may have several: cargo does not choose one that suits
//! all, even where a range of versions would allow it.

use crate::frustum::{MatrixLayout, ViewProjection};
use crate::math::Vec3;

macro_rules! vectors {
    ($($theirs:ty, $scalar:ident;)*) => {$(
        impl From<$theirs> for Vec3<$scalar> {
            #[inline(always)]
            fn from(v: $theirs) -> Self {
                v.to_array().into()
            }
        }

        impl From<Vec3<$scalar>> for $theirs {
            #[inline(always)]
            fn from(v: Vec3<$scalar>) -> Self {
                Self::from_array(v.to_array())
            }
        }
    )*};
}

macro_rules! matrices {
    ($($theirs:ty, $scalar:ident;)*) => {$(
        impl From<$theirs> for ViewProjection<$scalar> {
            fn from(m: $theirs) -> Self {
                Self::new(m.to_cols_array_2d(), MatrixLayout::ColumnMajorColumnVectors)
            }
        }

        impl From<ViewProjection<$scalar>> for $theirs {
            fn from(m: ViewProjection<$scalar>) -> Self {
                Self::from_cols_array_2d(&m.to_array(MatrixLayout::ColumnMajorColumnVectors))
            }
        }
    )*};
}

macro_rules! conversions {
    ($($feature:literal $glam:ident;)*) => {$(
        #[cfg(feature = $feature)]
        mod $glam {
            use super::*;

            vectors! {
                ::$glam::Vec3, f32;
                ::$glam::Vec3A, f32;
                ::$glam::DVec3, f64;
            }

            matrices! {
                ::$glam::Mat4, f32;
                ::$glam::DMat4, f64;
            }
        }
    )*};
}

conversions! {
    "glam" glam;
    "glam027" glam027;
    "glam030" glam030;
    "glam033" glam033;
}
