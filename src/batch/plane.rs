//! A half space `n . p + d`, everywhere in a register the same.

use crate::math::Real;
use crate::volume::Row;
use fearless_simd::prelude::*;

/// A face's numbers in each lane.
#[derive(Clone, Copy)]
pub(super) struct Plane<V> {
    normal: [V; 3],
    pub(super) offset: V,
}

impl<V: Copy> Plane<V> {
    #[inline(always)]
    pub(super) fn new<S: Simd, T: Real>(simd: S, row: &Row<T>) -> Self
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
    pub(super) fn along<S: Simd>(&self, p: &[V; 3], offset: V) -> V
    where
        V: SimdFloat<S>,
    {
        let [x, y, z] = self.normal;
        p[0].mul_add(x, p[1].mul_add(y, p[2].mul_add(z, offset)))
    }
}
