//! Blocks of segments on their way: see [`super`].

use super::Segments;
use super::crossings::Crossings;
use super::parameters::Cut;
use super::planes::Planes;
use super::queues::{BLOCK, ROOM};
use super::triage::{Found, Triage, ends};
use super::undecided::Undecided;
use crate::clip::{Accuracy, Class, SegmentClip, StageCounts, many};
use crate::frustum::Frustum;
use crate::frustum::eval::planes::FacePlanes;
use crate::math::{NonFiniteAt, Real, Segment};
use crate::simd::at_width;
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, f32x16, f64x4};

/// Where answers go, a place for each segment.
pub(crate) struct Out<'a, T> {
    pub(crate) classes: &'a mut [Class],
    pub(crate) t0: &'a mut [T],
    pub(crate) t1: &'a mut [T],
    /// Memory to work in.
    pub(crate) unsure: &'a mut Unsure<T>,
}

/// What is not certain: clipped as a slice, many at a time.
#[derive(Clone, Debug)]
pub(crate) struct Unsure<T> {
    /// How many there were.
    pub(crate) count: usize,
    /// Those that wait.
    segments: Vec<Segment<T>>,
    numbers: Vec<usize>,
    clips: Vec<SegmentClip<T>>,
}

impl<T> Unsure<T> {
    /// Nothing waits.
    pub(super) fn begin(&mut self) {
        self.count = 0;
        self.segments.clear();
        self.numbers.clear();
    }
}

impl<T> Default for Unsure<T> {
    fn default() -> Self {
        Self {
            count: 0,
            segments: Vec::new(),
            numbers: Vec::new(),
            clips: Vec::new(),
        }
    }
}

/// A frustum that is asked.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a, T> {
    pub(crate) frustum: &'a Frustum,
    pub(crate) rows: &'a FacePlanes<T>,
    pub(crate) doubles: &'a FacePlanes<f64>,
}

/// Asks about all segments at a vector width.
#[inline(always)]
fn run<S, T, V, const N: usize>(
    simd: S,
    asked: Asked<'_, T>,
    segments: &Segments<'_, T>,
    mut out: Out<'_, T>,
) -> Result<(), NonFiniteAt>
where
    S: Simd,
    T: Real,
    V: Cut<S> + SimdFloat<S, Element = T, Array = [T; N]>,
{
    let planes = Planes::<S, V>::new(simd, asked.rows, asked.frustum.filter());
    let faces = V::faces(simd, asked.doubles);
    let (mut put_off, mut open, mut marks) =
        (V::Deferred::default(), Undecided::new(), Triage::new());
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
        open.clear();
        marks.triage::<S, V, N>(simd, &planes, block, &mut open);
        let dropped = marks.keep_below(count);
        if packs(simd) {
            open.len -= dropped;
        } else {
            open.list::<S, V, N>(simd, &marks);
            open.gather(block);
        }
        cross::<S, T, V, N>(
            simd,
            &planes,
            &faces,
            asked.frustum,
            &mut put_off,
            &mut open,
        );
        out.close::<S, V, N>(simd, start, &marks, &open);
        if open.unsure.len() > 0 {
            open.list::<S, V, N>(simd, &marks);
            for (number, segment) in open.unsure() {
                out.unsure.segments.push(segment);
                out.unsure.numbers.push(start + number);
            }
        }
        if out.unsure.numbers.len() >= BLOCK {
            out.clip_unsure(simd.level(), asked.frustum)?;
        }
    }
    out.clip_unsure(simd.level(), asked.frustum)
}

impl<T: Real> Out<'_, T> {
    /// Writes down what was found of a block.
    #[inline(always)]
    fn close<S, V, const N: usize>(
        &mut self,
        simd: S,
        start: usize,
        marks: &Triage<T>,
        open: &Undecided<T>,
    ) where
        S: Simd,
        V: SimdFloat<S, Element = T>,
    {
        let classes = &mut self.classes[start..];
        let (t0, t1) = (&mut self.t0[start..], &mut self.t1[start..]);
        let whole = classes.first_chunk_mut().zip(t0.first_chunk_mut());
        if let Some(((classes, t0), t1)) = whole.zip(t1.first_chunk_mut()) {
            marks.close::<S, V, N>(simd, open, Found { classes, t0, t1 });
            return;
        }
        let mut all = ([Class::Outside; BLOCK], [T::ZERO; BLOCK], [T::ZERO; BLOCK]);
        let (all_classes, all_t0, all_t1) = (&mut all.0, &mut all.1, &mut all.2);
        let found = Found {
            classes: all_classes,
            t0: all_t0,
            t1: all_t1,
        };
        marks.close::<S, V, N>(simd, open, found);
        classes.copy_from_slice(&all.0[..classes.len()]);
        t0.copy_from_slice(&all.1[..t0.len()]);
        t1.copy_from_slice(&all.2[..t1.len()]);
    }

    /// What waits, as a slice. Segments that are not finite wait in the batch's order.
    fn clip_unsure(&mut self, level: Level, frustum: &Frustum) -> Result<(), NonFiniteAt> {
        let Unsure {
            count,
            segments,
            numbers,
            clips,
        } = &mut *self.unsure;
        let counts = &mut StageCounts::default();
        many::clip_exact(level, frustum, segments, Accuracy::Fast, clips, counts).map_err(
            |error| NonFiniteAt {
                index: numbers[error.index],
                ..error
            },
        )?;
        for (&i, clip) in numbers.iter().zip(clips.iter()) {
            self.classes[i] = clip.class;
            let part = clip.part.as_ref();
            (self.t0[i], self.t1[i]) =
                part.map_or((T::ONE, T::ZERO), |part| (part.entry.t, part.exit.t));
        }
        *count += numbers.len();
        segments.clear();
        numbers.clear();
        Ok(())
    }
}

/// Whether registers can be packed fast.
#[inline(always)]
pub(super) fn packs<S: Simd>(simd: S) -> bool {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    return simd.level().as_avx2().is_some();
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    return false;
}

/// A block from `start` of each array, if there are so many.
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

/// A block's numbers side by side; beyond the last segment it repeats that.
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
    if let Segments::Slice(all) = segments
        && let Some(block) = all[start..].first_chunk::<BLOCK>()
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

/// Latest entries and earliest exits of what is open.
#[inline(always)]
fn cross<S, T, V, const N: usize>(
    simd: S,
    planes: &Planes<S, V>,
    faces: &V::Faces,
    frustum: &Frustum,
    put_off: &mut V::Deferred,
    open: &mut Undecided<T>,
) where
    S: Simd,
    T: Real,
    V: Cut<S> + SimdFloat<S, Element = T, Array = [T; N]>,
{
    let count = open.len.min(BLOCK);
    for at in (0..count).step_by(N) {
        let ends = ends::<S, V, N, ROOM>(simd, open.coordinates.each_ref(), at);
        let found = Crossings::new(planes, &ends);
        let ([entry, exit], sure) = V::cut(faces, put_off, at..count, ends, &found);
        let entry = found.cut[0].select(entry, planes.zero);
        let exit = found.cut[1].select(exit, planes.one);
        let t0 = found.outside.select(planes.one, entry);
        let t1 = found.outside.select(planes.zero, exit);
        t0.store_slice(&mut open.t0[at..at + N]);
        t1.store_slice(&mut open.t1[at..at + N]);
        let present = u64::MAX >> (64 - N.min(count - at));
        let sure = (found.outside | found.certain & sure).to_bitmask();
        open.unsure.append::<N>(at, present & !sure);
    }
    V::finish(simd, frustum, put_off, open);
}

/// At the machine's vector width, eight or sixteen singles at a time.
pub(crate) fn singles(
    level: Level,
    asked: Asked<'_, f32>,
    segments: &Segments<'_, f32>,
    out: Out<'_, f32>,
) -> Result<(), NonFiniteAt> {
    at_width!(
        level,
        simd => run::<_, f32, f32x8<_>, 8>(simd, asked, segments, out),
        wide => run::<_, f32, f32x16<_>, 16>(wide, asked, segments, out)
    )
}

/// Sixteen singles at a time at any width: so that every machine tests what few have.
#[cfg(test)]
pub(crate) fn sixteen_singles(
    level: Level,
    asked: Asked<'_, f32>,
    segments: &Segments<'_, f32>,
    out: Out<'_, f32>,
) -> Result<(), NonFiniteAt> {
    at_width!(level, simd => run::<_, f32, f32x16<_>, 16>(simd, asked, segments, out))
}

/// At the machine's vector width, four doubles at a time.
pub(crate) fn doubles(
    level: Level,
    asked: Asked<'_, f64>,
    segments: &Segments<'_, f64>,
    out: Out<'_, f64>,
) -> Result<(), NonFiniteAt> {
    at_width!(level, simd => run::<_, f64, f64x4<_>, 4>(simd, asked, segments, out))
}
