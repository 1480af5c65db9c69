//! The latest entry and the earliest exit of a register of segments, and whether they are certain.

use super::planes::{Planes, Values};
use crate::math::Real;
use fearless_simd::prelude::*;

/// A mask for `V`'s lanes.
type Mask<S, V> = <V as SimdBase<S>>::Mask;

/// Where each of a register of segments is cut.
pub(super) struct Crossings<S: Simd, V: SimdFloat<S>> {
    /// The face, by number, at which a segment enters last, and the one at which it leaves first;
    /// of one that does not, some face.
    pub(super) faces: [V; 2],
    /// Whether it does.
    pub(super) cut: [Mask<S, V>; 2],
    /// The entry certainly comes after the exit.
    pub(super) outside: Mask<S, V>,
    /// The entry certainly comes before the exit, and each certainly is at that face alone.
    pub(super) certain: Mask<S, V>,
}

/// The greatest of some numbers, and what comes after it.
struct Greatest<V> {
    first: V,
    second: V,
    /// Where the first was found.
    face: V,
}

impl<V: Copy> Greatest<V> {
    #[inline(always)]
    fn than(none: V, face: V) -> Self {
        Self {
            first: none,
            second: none,
            face,
        }
    }

    #[inline(always)]
    fn add<S: Simd>(&mut self, value: V, face: V)
    where
        V: SimdFloat<S>,
    {
        let later = value.simd_gt(self.first);
        self.second = self.second.max(self.first.min(value));
        self.first = self.first.max(value);
        self.face = later.select(face, self.face);
    }
}

impl<S: Simd, V: SimdFloat<S, Element: Real>> Crossings<S, V> {
    #[inline(always)]
    pub(super) fn new(planes: &Planes<V>, values: &Values<V>) -> Self {
        let (zero, one) = (planes.zero, planes.one);
        // Parameters of entries, and of exits, negative; where there is none:
        let none = [-one, -(one + one)];
        let mut entry = Greatest::than(none[0], planes.numbers[0]);
        let mut exit = Greatest::than(none[1], planes.numbers[0]);
        let mut scales = zero;
        let mut nearest = values.start[0].abs().min(values.end[0].abs());
        for i in 0..6 {
            let (a, b) = (values.start[i], values.end[i]);
            if i > 0 {
                nearest = nearest.min(a.abs().min(b.abs()));
            }
            let scale = one / (a - b);
            let t = a * scale;
            let (entering, leaving) = (a.simd_lt(zero), b.simd_lt(zero));
            entry.add::<S>(entering.select(t, none[0]), planes.numbers[i]);
            exit.add::<S>(leaving.select(-t, none[1]), planes.numbers[i]);
            scales = scales.max((entering ^ leaving).select(scale.abs(), zero));
        }
        // What two parameters can be off, together.
        let error = planes.error::<S, V::Element>(values, scales);
        let error = error + error;
        let overlap = entry.first + exit.first;
        let signs = nearest.simd_gt(values.threshold) & planes.covers::<S, V::Element>(values);
        let half = <V::Element as Real>::from_f64(-0.5);
        let enters = entry.first.simd_gt(half);
        let leaves = exit.first.simd_gt(half - <V::Element as Real>::ONE);
        let apart = |of: &Greatest<V>| of.second.simd_lt(of.first - error);
        Crossings {
            faces: [entry.face, exit.face],
            cut: [enters, leaves],
            outside: signs & overlap.simd_gt(error),
            certain: signs
                & overlap.simd_lt(-error)
                & (apart(&entry) | !enters)
                & (apart(&exit) | !leaves),
        }
    }
}
