//! `nalgebra`: `Point3`, `Vector3` as points, `Matrix4` as a view-projection
//! matrix (acting on column vectors).

use crate::frustum::{MatrixLayout, ViewProjection};
use crate::math::{Real, Vec3};
use nalgebra::{Matrix4, Point3, Vector3};

impl<T: Real> From<Point3<T>> for Vec3<T> {
    #[inline(always)]
    fn from(p: Point3<T>) -> Self {
        Vec3::new(p.x, p.y, p.z)
    }
}

impl<T: Real> From<Vec3<T>> for Point3<T> {
    #[inline(always)]
    fn from(p: Vec3<T>) -> Self {
        Point3::new(p.x, p.y, p.z)
    }
}

impl<T: Real> From<Vector3<T>> for Vec3<T> {
    #[inline(always)]
    fn from(v: Vector3<T>) -> Self {
        Vec3::new(v.x, v.y, v.z)
    }
}

impl<T: Real> From<Vec3<T>> for Vector3<T> {
    #[inline(always)]
    fn from(v: Vec3<T>) -> Self {
        Vector3::new(v.x, v.y, v.z)
    }
}

impl<T: Real> From<Matrix4<T>> for ViewProjection<T> {
    fn from(m: Matrix4<T>) -> Self {
        Self::new(m.data.0, MatrixLayout::ColumnMajorColumnVectors)
    }
}

impl<T: Real> From<ViewProjection<T>> for Matrix4<T> {
    fn from(m: ViewProjection<T>) -> Self {
        Matrix4::from(m.to_array(MatrixLayout::ColumnMajorColumnVectors))
    }
}
