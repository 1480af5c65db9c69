//! A half space `n . p + d >= 0`, the same one in each lane of a register.

use crate::frustum::eval::planes::FacePlane;
use crate::math::Real;
use fearless_simd::prelude::*;

/// Normal and offset in each lane.
#[derive(Clone, Copy)]
pub(crate) struct PlaneLanes<V> {
    normal: [V; 3],
    pub(crate) offset: V,
}

impl<V: Copy> PlaneLanes<V> {
    #[inline(always)]
    pub(crate) fn new<S: Simd, T: Real>(simd: S, plane: &FacePlane<T>) -> Self
    where
        V: SimdFloat<S, Element = T>,
    {
        let [x, y, z] = plane.normal;
        Self {
            normal: [V::splat(simd, x), V::splat(simd, y), V::splat(simd, z)],
            offset: V::splat(simd, plane.offset),
        }
    }

    /// `n . p + offset`, with another offset than the half space's.
    #[inline(always)]
    pub(crate) fn along<S: Simd>(&self, p: &[V; 3], offset: V) -> V
    where
        V: SimdFloat<S>,
    {
        let [x, y, z] = self.normal;
        p[0].mul_add(x, p[1].mul_add(y, p[2].mul_add(z, offset)))
    }
}
