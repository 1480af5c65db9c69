//! `glam`: `Vec3`, `Vec3A`, `DVec3` as points, `Mat4`, `DMat4` as
//! view-projection matrices (columns, acting on column vectors).

use crate::frustum::{MatrixLayout, ViewProjection};
use crate::math::Vec3;
use glam::{DMat4, DVec3, Mat4, Vec3 as GlamVec3, Vec3A};

macro_rules! vectors {
    ($($theirs:ident, $scalar:ident;)*) => {$(
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

vectors! {
    GlamVec3, f32;
    Vec3A, f32;
    DVec3, f64;
}

macro_rules! matrices {
    ($($theirs:ident, $scalar:ident;)*) => {$(
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

matrices! {
    Mat4, f32;
    DMat4, f64;
}
