//! Blocks of segments on their way: see [`super`].

use super::Segments;
use super::crossings::Crossings;
use super::open::Open;
use super::parameters::{Cut, Faces};
use super::planes::{Planes, Values};
use super::queues::{BLOCK, ROOM};
use crate::clip::{Accuracy, Class, SegmentClip, StageCounts, slice};
use crate::frustum::Frustum;
use crate::math::{NonFiniteAt, Real, Segment};
use crate::simd::at_width;
use crate::volume::Rows;
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, f64x4};

/// Where answers go, a place for each segment.
pub(in crate::batch) struct Out<'a, T> {
    pub(in crate::batch) classes: &'a mut [Class],
    pub(in crate::batch) t0: &'a mut [T],
    pub(in crate::batch) t1: &'a mut [T],
    /// Memory to work in.
    pub(in crate::batch) unsure: &'a mut Unsure<T>,
}

/// What is not certain: clipped as a slice, many at a time.
#[derive(Clone, Debug)]
pub(in crate::batch) struct Unsure<T> {
    /// How many there were.
    pub(in crate::batch) count: usize,
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
pub(in crate::batch) struct Asked<'a, T> {
    pub(in crate::batch) frustum: &'a Frustum,
    pub(in crate::batch) rows: &'a Rows<T>,
    pub(in crate::batch) doubles: &'a Rows<f64>,
}

/// Answers about a block.
struct Answers<T> {
    classes: [Class; BLOCK],
    t0: [T; BLOCK],
    t1: [T; BLOCK],
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
    let planes = Planes::<V>::new(simd, asked.rows, asked.frustum.filter());
    let faces = Faces::new(asked.doubles);
    let (mut put_off, mut open) = (V::PutOff::default(), Open::new());
    let mut answers = Answers {
        classes: [Class::Outside; BLOCK],
        t0: [T::ZERO; BLOCK],
        t1: [T::ZERO; BLOCK],
    };
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
        answers.triage::<S, V, N>(simd, &planes, block, &mut open);
        open.numbers.keep_below(count);
        if !packs(simd) {
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
        answers.close(&open);
        for &place in open.unsure.items() {
            let place = usize::from(place);
            out.unsure.segments.push(open.segment(place));
            out.unsure.numbers.push(start + open.numbers.at(place));
        }
        let to = start..start + count;
        out.classes[to.clone()].copy_from_slice(&answers.classes[..count]);
        out.t0[to.clone()].copy_from_slice(&answers.t0[..count]);
        out.t1[to].copy_from_slice(&answers.t1[..count]);
        if out.unsure.numbers.len() >= BLOCK {
            out.clip_unsure(simd.level(), asked.frustum)?;
        }
    }
    out.clip_unsure(simd.level(), asked.frustum)
}

impl<T: Real> Out<'_, T> {
    /// What waits, as a slice. Segments that are not finite wait in the batch's order.
    fn clip_unsure(&mut self, level: Level, frustum: &Frustum) -> Result<(), NonFiniteAt> {
        let Unsure {
            count,
            segments,
            numbers,
            clips,
        } = &mut *self.unsure;
        let counts = &mut StageCounts::default();
        slice::clip_exact(level, frustum, segments, Accuracy::Fast, clips, counts).map_err(
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
fn packs<S: Simd>(simd: S) -> bool {
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
fn gather<T: Real>(
    segments: &Segments<'_, T>,
    start: usize,
    count: usize,
    to: &mut [[T; BLOCK]; 6],
) {
    for i in 0..BLOCK {
        let numbers = segments.numbers(start + i.min(count - 1));
        for (array, number) in to.iter_mut().zip(numbers) {
            array[i] = number;
        }
    }
}

/// The classes for four bits each of outside and inside.
const CLASSES: [[Class; 4]; 256] = {
    let mut all = [[Class::Cross; 4]; 256];
    let mut i = 0;
    while i < 1024 {
        let (bits, lane) = (i / 4, i % 4);
        if bits >> lane & 1 != 0 {
            all[bits][lane] = Class::Outside;
        } else if bits >> (4 + lane) & 1 != 0 {
            all[bits][lane] = Class::Inside;
        }
        i += 1;
    }
    all
};

/// The points of a register of segments, from `at` on.
#[inline(always)]
fn ends<S, T, V, const N: usize, const M: usize>(
    simd: S,
    block: [&[T; M]; 6],
    at: usize,
) -> [[V; 3]; 2]
where
    S: Simd,
    V: SimdFloat<S, Element = T>,
{
    [
        [
            V::from_slice(simd, &block[0][at..at + N]),
            V::from_slice(simd, &block[1][at..at + N]),
            V::from_slice(simd, &block[2][at..at + N]),
        ],
        [
            V::from_slice(simd, &block[3][at..at + N]),
            V::from_slice(simd, &block[4][at..at + N]),
            V::from_slice(simd, &block[5][at..at + N]),
        ],
    ]
}

impl<T: Real> Answers<T> {
    /// What is outside of a face, or inside of all, by their values' signs; the numbers of
    /// the rest.
    #[inline(always)]
    fn triage<S, V, const N: usize>(
        &mut self,
        simd: S,
        planes: &Planes<V>,
        block: [&[T; BLOCK]; 6],
        open: &mut Open<T>,
    ) where
        S: Simd,
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        for at in (0..BLOCK).step_by(N) {
            let [p, q] = ends::<S, T, V, N, BLOCK>(simd, block, at);
            let values = planes.values::<S, T>(p, q);
            let Values { start, end, .. } = &values;
            let mut greatest = start[0].max(end[0]);
            let mut least = start[0].min(end[0]);
            for i in 1..6 {
                greatest = greatest.min(start[i].max(end[i]));
                least = least.min(start[i].min(end[i]));
            }
            let covered = planes.covers::<S, T>(&values);
            let outside = covered & greatest.simd_lt(-values.threshold);
            let inside = covered & least.simd_gt(values.threshold);
            outside
                .select(planes.one, planes.zero)
                .store_slice(&mut self.t0[at..at + N]);
            outside
                .select(planes.zero, planes.one)
                .store_slice(&mut self.t1[at..at + N]);
            let left = !(outside | inside);
            if packs(simd) {
                open.pack::<S, V, N>([p, q], left);
            }
            open.numbers.append(at, left.to_bitmask());
            let (outside, inside) = (outside.to_bitmask(), inside.to_bitmask());
            for k in (0..N).step_by(4) {
                let bits = outside >> k & 15 | (inside >> k & 15) << 4;
                self.classes[at + k..at + k + 4].copy_from_slice(&CLASSES[bits as usize & 255]);
            }
        }
    }

    /// Writes down what was found of what was open.
    #[inline(always)]
    fn close(&mut self, open: &Open<T>) {
        for (place, &number) in open.numbers.items().iter().enumerate() {
            let i = usize::from(number) % BLOCK;
            self.classes[i] = open.classes[place];
            self.t0[i] = open.t0[place];
            self.t1[i] = open.t1[place];
        }
    }
}

/// Latest entries and earliest exits of what is open.
#[inline(always)]
fn cross<S, T, V, const N: usize>(
    simd: S,
    planes: &Planes<V>,
    faces: &Faces,
    frustum: &Frustum,
    put_off: &mut V::PutOff,
    open: &mut Open<T>,
) where
    S: Simd,
    T: Real,
    V: Cut<S> + SimdFloat<S, Element = T, Array = [T; N]>,
{
    let count = open.numbers.len();
    for at in (0..count).step_by(N) {
        let ends = ends::<S, T, V, N, ROOM>(simd, open.coordinates.each_ref(), at);
        let values = planes.values::<S, T>(ends[0], ends[1]);
        let found = Crossings::new(planes, &values);
        let ([entry, exit], sure) = V::cut(faces, put_off, at..count, ends, &found);
        let entry = found.cut[0].select(entry, planes.zero);
        let exit = found.cut[1].select(exit, planes.one);
        let t0 = found.outside.select(planes.one, entry);
        let t1 = found.outside.select(planes.zero, exit);
        t0.store_slice(&mut open.t0[at..at + N]);
        t1.store_slice(&mut open.t1[at..at + N]);
        let outside = found.outside.to_bitmask();
        for k in (0..N).step_by(4) {
            let bits = outside >> k & 15;
            open.classes[at + k..at + k + 4].copy_from_slice(&CLASSES[bits as usize]);
        }
        let present = u64::MAX >> (64 - N.min(count - at));
        let sure = outside | (found.certain & sure).to_bitmask();
        open.unsure.append(at, present & !sure);
    }
    V::finish(simd, frustum, put_off, open);
}

/// At the machine's vector width, eight singles at a time.
pub(in crate::batch) fn singles(
    level: Level,
    asked: Asked<'_, f32>,
    segments: &Segments<'_, f32>,
    out: Out<'_, f32>,
) -> Result<(), NonFiniteAt> {
    at_width!(level, simd => run::<_, f32, f32x8<_>, 8>(simd, asked, segments, out))
}

/// At the machine's vector width, four doubles at a time.
pub(in crate::batch) fn doubles(
    level: Level,
    asked: Asked<'_, f64>,
    segments: &Segments<'_, f64>,
    out: Out<'_, f64>,
) -> Result<(), NonFiniteAt> {
    at_width!(level, simd => run::<_, f64, f64x4<_>, 4>(simd, asked, segments, out))
}
