//! `mint`: `Point3`, `Vector3` as points, `ColumnMatrix4` and `RowMatrix4` as
//! view-projection matrices (acting on column vectors, whichever way they are
//! stored).

use crate::frustum::{MatrixLayout, ViewProjection};
use crate::math::{Real, Vec3};
use mint::{ColumnMatrix4, IntoMint, Point3, RowMatrix4, Vector3};

impl<T> From<Point3<T>> for Vec3<T> {
    #[inline(always)]
    fn from(p: Point3<T>) -> Self {
        Vec3::new(p.x, p.y, p.z)
    }
}

impl<T> From<Vec3<T>> for Point3<T> {
    #[inline(always)]
    fn from(p: Vec3<T>) -> Self {
        Point3::from([p.x, p.y, p.z])
    }
}

impl<T> From<Vector3<T>> for Vec3<T> {
    #[inline(always)]
    fn from(v: Vector3<T>) -> Self {
        Vec3::new(v.x, v.y, v.z)
    }
}

impl<T> From<Vec3<T>> for Vector3<T> {
    #[inline(always)]
    fn from(v: Vec3<T>) -> Self {
        Vector3::from([v.x, v.y, v.z])
    }
}

impl<T> IntoMint for Vec3<T> {
    type MintType = Vector3<T>;
}

impl<T: Real> From<ColumnMatrix4<T>> for ViewProjection<T> {
    fn from(m: ColumnMatrix4<T>) -> Self {
        Self::new(m.into(), MatrixLayout::ColumnMajorColumnVectors)
    }
}

impl<T: Real> From<ViewProjection<T>> for ColumnMatrix4<T> {
    fn from(m: ViewProjection<T>) -> Self {
        m.to_array(MatrixLayout::ColumnMajorColumnVectors).into()
    }
}

impl<T: Real> From<RowMatrix4<T>> for ViewProjection<T> {
    fn from(m: RowMatrix4<T>) -> Self {
        Self::new(m.into(), MatrixLayout::RowMajorColumnVectors)
    }
}

impl<T: Real> From<ViewProjection<T>> for RowMatrix4<T> {
    fn from(m: ViewProjection<T>) -> Self {
        m.to_array(MatrixLayout::RowMajorColumnVectors).into()
    }
}
