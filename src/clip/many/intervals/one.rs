//! Intervals without vector registers: segments one by one.

use super::{Out, Prepared, Segments};
use crate::math::{NonFiniteAt, Real};
use crate::simd::Level;

fn clip<T: Real>(
    prepared: Prepared<'_, T>,
    segments: &Segments<'_, T>,
    out: Out<'_, T>,
) -> Result<(), NonFiniteAt> {
    for index in 0..out.classes.len() {
        let segment = segments.get(index).unwrap_or_default();
        let clip = prepared.frustum.clip_segment(&segment);
        let clip = clip.map_err(|found| NonFiniteAt { index, found })?;
        out.classes[index] = clip.class;
        let part = clip.part.as_ref();
        (out.t0[index], out.t1[index]) =
            part.map_or((T::ONE, T::ZERO), |part| (part.entry.t, part.exit.t));
    }
    Ok(())
}

pub(super) fn clip_f32(
    _: Level,
    prepared: Prepared<'_, f32>,
    segments: &Segments<'_, f32>,
    out: Out<'_, f32>,
) -> Result<(), NonFiniteAt> {
    clip(prepared, segments, out)
}

pub(super) fn clip_f64(
    _: Level,
    prepared: Prepared<'_, f64>,
    segments: &Segments<'_, f64>,
    out: Out<'_, f64>,
) -> Result<(), NonFiniteAt> {
    clip(prepared, segments, out)
}
