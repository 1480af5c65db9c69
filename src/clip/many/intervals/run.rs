//! Blocks of segments on their way: see [`super`].

use super::super::queue::{BLOCK, QUEUE_CAPACITY};
use super::crossings::Crossings;
use super::frustum_lanes::FrustumLanes;
use super::parameters::Cut;
use super::triage::{Answers, Triage, ends};
use super::undecided::Undecided;
use super::{Out, Prepared, Segments};
use crate::clip::Class;
use crate::frustum::Frustum;
use crate::math::{NonFiniteAt, Real, Segment};
use crate::simd::at_width;
#[cfg(any(test, target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::f32x16;
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, f64x4};

/// Clips all segments at a vector width.
#[inline(always)]
fn run<S, T, V, const N: usize>(
    simd: S,
    prepared: Prepared<'_, T>,
    segments: &Segments<'_, T>,
    mut out: Out<'_, T>,
) -> Result<(), NonFiniteAt>
where
    S: Simd,
    T: Real,
    V: Cut<S> + SimdFloat<S, Element = T, Array = [T; N]>,
{
    let frustum = prepared.frustum;
    let lanes = FrustumLanes::<S, V>::new(simd, prepared.planes, frustum.filter());
    let faces = V::faces(simd, prepared.planes_f64);
    let mut deferred = V::Deferred::default();
    let (mut undecided, mut triage) = (Undecided::new(), Triage::new());
    let mut gathered = [[T::ZERO; BLOCK]; 6];
    let arrays = segments.arrays();
    for start in (0..out.classes.len()).step_by(BLOCK) {
        let count = BLOCK.min(out.classes.len() - start);
        let block = match arrays.and_then(|arrays| blocks(arrays, start)) {
            Some(block) => block,
            None => {
                gather(segments, start, count, &mut gathered);
                gathered.each_ref()
            }
        };
        undecided.clear();
        triage.decide::<S, V, N>(simd, &lanes, block, &mut undecided);
        let dropped = triage.keep_below(count);
        if packs(simd) {
            undecided.len -= dropped;
        } else {
            undecided.list::<S, V, N>(simd, &triage);
            undecided.gather(block);
        }
        cross::<S, T, V, N>(simd, &lanes, &faces, frustum, &mut deferred, &mut undecided);
        out.write::<S, V, N>(simd, start, &triage, &undecided);
        if undecided.uncertain.len() > 0 {
            undecided.list::<S, V, N>(simd, &triage);
            for (index, segment) in undecided.uncertain() {
                out.uncertain.push(start + index, segment);
            }
        }
        out.clip_uncertain(simd.level(), frustum, BLOCK)?;
    }
    out.clip_uncertain(simd.level(), frustum, 1)
}

impl<T: Real> Out<'_, T> {
    /// Writes the answers of a block.
    #[inline(always)]
    fn write<S, V, const N: usize>(
        &mut self,
        simd: S,
        start: usize,
        triage: &Triage<T>,
        undecided: &Undecided<T>,
    ) where
        S: Simd,
        V: SimdFloat<S, Element = T>,
    {
        let classes = &mut self.classes[start..];
        let (t0, t1) = (&mut self.t0[start..], &mut self.t1[start..]);
        let whole = classes.first_chunk_mut().zip(t0.first_chunk_mut());
        if let Some(((classes, t0), t1)) = whole.zip(t1.first_chunk_mut()) {
            let answers = Answers { classes, t0, t1 };
            triage.merge::<S, V, N>(simd, undecided, answers);
            return;
        }
        // The last block is not whole.
        let mut last = ([Class::Outside; BLOCK], [T::ZERO; BLOCK], [T::ZERO; BLOCK]);
        let answers = Answers {
            classes: &mut last.0,
            t0: &mut last.1,
            t1: &mut last.2,
        };
        triage.merge::<S, V, N>(simd, undecided, answers);
        classes.copy_from_slice(&last.0[..classes.len()]);
        t0.copy_from_slice(&last.1[..t0.len()]);
        t1.copy_from_slice(&last.2[..t1.len()]);
    }
}

/// Whether the machine packs registers fast.
#[inline(always)]
pub(super) fn packs<S: Simd>(simd: S) -> bool {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    return simd.level().as_avx2().is_some();
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    {
        let _ = simd;
        false
    }
}

/// A block of each array from `start` on, if the arrays have so many.
#[inline(always)]
fn blocks<T>(arrays: [&[T]; 6], start: usize) -> Option<[&[T; BLOCK]; 6]> {
    let block = |k: usize| arrays[k].get(start..)?.first_chunk();
    Some([
        block(0)?,
        block(1)?,
        block(2)?,
        block(3)?,
        block(4)?,
        block(5)?,
    ])
}

/// A block's coordinates side by side; beyond the last segment it repeats that.
#[inline(always)]
fn gather<T: Real>(
    segments: &Segments<'_, T>,
    start: usize,
    count: usize,
    to: &mut [[T; BLOCK]; 6],
) {
    let [a, b, c, d, e, f] = to;
    let mut put = |i: usize, Segment { start, end }: Segment<T>| {
        (a[i], b[i], c[i]) = (start.x, start.y, start.z);
        (d[i], e[i], f[i]) = (end.x, end.y, end.z);
    };
    if let Segments::Slice(segments) = segments
        && let Some(block) = segments[start..].first_chunk::<BLOCK>()
    {
        for (i, &segment) in block.iter().enumerate() {
            put(i, segment);
        }
        return;
    }
    for i in 0..BLOCK {
        let segment = segments.get(start + i.min(count - 1));
        put(i, segment.unwrap_or_default());
    }
}

/// Latest entries and earliest exits of the undecided segments.
#[inline(always)]
fn cross<S, T, V, const N: usize>(
    simd: S,
    lanes: &FrustumLanes<S, V>,
    faces: &V::Faces,
    frustum: &Frustum,
    deferred: &mut V::Deferred,
    undecided: &mut Undecided<T>,
) where
    S: Simd,
    T: Real,
    V: Cut<S> + SimdFloat<S, Element = T, Array = [T; N]>,
{
    let count = undecided.len.min(BLOCK);
    for at in (0..count).step_by(N) {
        let ends = ends::<S, V, N, QUEUE_CAPACITY>(simd, undecided.coordinates.each_ref(), at);
        let crossings = Crossings::new(lanes, &ends);
        let ([entry, exit], certain) = V::cut(faces, deferred, at..count, ends, &crossings);
        let entry = crossings.cut[0].select(entry, lanes.zero);
        let exit = crossings.cut[1].select(exit, lanes.one);
        let t0 = crossings.outside.select(lanes.one, entry);
        let t1 = crossings.outside.select(lanes.zero, exit);
        t0.store_slice(&mut undecided.t0[at..at + N]);
        t1.store_slice(&mut undecided.t1[at..at + N]);
        let present = u64::MAX >> (64 - N.min(count - at));
        let certain = (crossings.outside | crossings.certain & certain).to_bitmask();
        undecided.uncertain.append_bits::<N>(at, present & !certain);
    }
    V::finish(simd, frustum, deferred, undecided);
}

/// At the machine's vector width, eight or sixteen segments at a time.
pub(super) fn clip_f32(
    level: Level,
    prepared: Prepared<'_, f32>,
    segments: &Segments<'_, f32>,
    out: Out<'_, f32>,
) -> Result<(), NonFiniteAt> {
    at_width!(
        level,
        simd => run::<_, f32, f32x8<_>, 8>(simd, prepared, segments, out),
        wide => run::<_, f32, f32x16<_>, 16>(wide, prepared, segments, out)
    )
}

/// Sixteen segments at a time at any width: so that every machine tests what few have.
#[cfg(test)]
pub(super) fn clip_f32_by_sixteen(
    level: Level,
    prepared: Prepared<'_, f32>,
    segments: &Segments<'_, f32>,
    out: Out<'_, f32>,
) -> Result<(), NonFiniteAt> {
    at_width!(level, simd => run::<_, f32, f32x16<_>, 16>(simd, prepared, segments, out))
}

/// At the machine's vector width, four segments at a time.
pub(super) fn clip_f64(
    level: Level,
    prepared: Prepared<'_, f64>,
    segments: &Segments<'_, f64>,
    out: Out<'_, f64>,
) -> Result<(), NonFiniteAt> {
    at_width!(level, simd => run::<_, f64, f64x4<_>, 4>(simd, prepared, segments, out))
}
