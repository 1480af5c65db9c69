//! A half space `n . p + d`, everywhere in a register the same.

use crate::frustum::eval::planes::Plane;
use crate::math::Real;
use fearless_simd::prelude::*;

/// A face's numbers in each lane.
#[derive(Clone, Copy)]
pub(crate) struct PlaneLanes<V> {
    normal: [V; 3],
    pub(crate) offset: V,
}

impl<V: Copy> PlaneLanes<V> {
    #[inline(always)]
    pub(crate) fn new<S: Simd, T: Real>(simd: S, row: &Plane<T>) -> Self
    where
        V: SimdFloat<S, Element = T>,
    {
        let [x, y, z] = row.normal;
        Self {
            normal: [V::splat(simd, x), V::splat(simd, y), V::splat(simd, z)],
            offset: V::splat(simd, row.offset),
        }
    }

    /// `n . p`, and a number in the offset's place.
    #[inline(always)]
    pub(crate) fn along<S: Simd>(&self, p: &[V; 3], offset: V) -> V
    where
        V: SimdFloat<S>,
    {
        let [x, y, z] = self.normal;
        p[0].mul_add(x, p[1].mul_add(y, p[2].mul_add(z, offset)))
    }
}
