//! Plain V/W, a register of segments at a time: the steps of `clip/vw.rs` in the
//! same order. Rare cases are clipped one by one: values of zero, and
//! coordinates so large that something may overflow.

use super::Block;
use super::queue::{BLOCK, Queues};
use crate::clip::rules::compare::MinMax;
use crate::clip::rules::triage::Extremes;
use crate::clip::whole::{class, inside, outside};
use crate::clip::{Part, PartEnd, SegmentClip, vw};
use crate::frustum::{FaceSet, Form, General, Layout, PlainFrustum, Symmetric, Term};
use crate::math::{NonFiniteAt, Real, Segment, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x4};
use std::marker::PhantomData;

/// Clips a block, eight segments at a time.
#[inline(always)]
pub(super) fn clip_f32<S: Simd>(
    simd: S,
    block: Block<'_, f32>,
    frustum: &PlainFrustum<f32>,
    queues: &mut Queues,
) -> Result<(), NonFiniteAt> {
    clip::<S, f32, f32x8<S>, 8>(simd, block, frustum, queues)
}

/// Clips a block, four segments at a time.
#[inline(always)]
pub(super) fn clip_f64<S: Simd>(
    simd: S,
    block: Block<'_, f64>,
    frustum: &PlainFrustum<f64>,
    queues: &mut Queues,
) -> Result<(), NonFiniteAt> {
    clip::<S, f64, f64x4<S>, 4>(simd, block, frustum, queues)
}

/// Clips a block, N segments at a time.
#[inline(always)]
fn clip<S, T, V, const N: usize>(
    simd: S,
    block: Block<'_, T>,
    frustum: &PlainFrustum<T>,
    queues: &mut Queues,
) -> Result<(), NonFiniteAt>
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]> + Term + MinMax,
{
    let mut run = Run {
        simd,
        block,
        frustum,
        queues,
        lanes: PhantomData::<V>,
    };
    match frustum.form {
        Form::Symmetric => run.clip::<Symmetric<true>, N>(),
        Form::General | Form::Orthographic => run.clip::<General<true>, N>(),
        Form::InfiniteSymmetric | Form::Infinite => run.clip::<General<false>, N>(),
    }
}

/// A block on its way.
struct Run<'a, S, T, V> {
    simd: S,
    block: Block<'a, T>,
    frustum: &'a PlainFrustum<T>,
    queues: &'a mut Queues,
    lanes: PhantomData<V>,
}

/// Points side by side.
#[inline(always)]
fn points<S, T, V, const N: usize>(simd: S, p: [Vec3<T>; N]) -> Vec3<V>
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]>,
{
    Vec3::new(
        V::load_array(simd, p.map(|p| p.x)),
        V::load_array(simd, p.map(|p| p.y)),
        V::load_array(simd, p.map(|p| p.z)),
    )
}

/// The sum of the coordinates' magnitudes.
#[inline(always)]
fn size<S: Simd, V: SimdFloat<S>>(p: Vec3<V>) -> V {
    p.x.abs() + p.y.abs() + p.z.abs()
}

/// The six values; the far one repeats the near one where there is no far face.
#[inline(always)]
fn values<S, T, V, L>(simd: S, f: &PlainFrustum<T>, p: Vec3<V>) -> [V; 6]
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T> + Term,
    L: Layout,
{
    let q = if f.identity {
        p
    } else {
        let c = Vec3::new(p.x - f.origin.x, p.y - f.origin.y, p.z - f.origin.z);
        let [x, y, z] = f.axes;
        Vec3::new(
            dot::<S, T, V>(x, c),
            dot::<S, T, V>(y, c),
            dot::<S, T, V>(z, c),
        )
    };
    let z = q.z * f.sign;
    let near = z - f.near;
    let far = if L::FAR {
        V::splat(simd, f.far) - z
    } else {
        near
    };
    let bounds = f.bounds.map(|v| V::splat(simd, v));
    let slopes = f.slopes.map(|v| V::splat(simd, v));
    let [left, right] = L::sides(&bounds, &slopes, 0, near, q.x);
    let [bottom, top] = L::sides(&bounds, &slopes, 2, near, q.y);
    [near, far, left, right, bottom, top]
}

#[inline(always)]
fn dot<S: Simd, T, V: SimdFloat<S, Element = T>>(a: Vec3<T>, c: Vec3<V>) -> V {
    c.x * a.x + c.y * a.y + c.z * a.z
}

impl<S, T, V> Run<'_, S, T, V>
where
    S: Simd,
    T: Real,
    V: Term + MinMax,
{
    #[inline(always)]
    fn clip<L: Layout, const N: usize>(&mut self) -> Result<(), NonFiniteAt>
    where
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        self.queues.clear();
        let (groups, rest) = self.block.segments.as_chunks::<N>();
        for (k, group) in groups.iter().enumerate() {
            self.triage::<L, N>(group.each_ref(), N * k, N);
        }
        if let Some(last) = rest.last() {
            let group = std::array::from_fn(|j| rest.get(j).unwrap_or(last));
            self.triage::<L, N>(group, N * groups.len(), rest.len());
        }
        self.cross::<L, N>();
        for &item in self.queues.inside.items() {
            let index = item as usize;
            self.block.clips[index] = inside(&self.block.segments[index]);
        }
        self.uncertain()
    }

    /// Only the first `count` segments of the group count.
    #[inline(always)]
    fn triage<L: Layout, const N: usize>(
        &mut self,
        group: [&Segment<T>; N],
        base: usize,
        count: usize,
    ) where
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let p: Vec3<V> = points(self.simd, group.map(|s| s.start));
        let q: Vec3<V> = points(self.simd, group.map(|s| s.end));
        let a = values::<S, T, V, L>(self.simd, self.frustum, p);
        let b = values::<S, T, V, L>(self.simd, self.frustum, q);
        let mut extremes = Extremes::new(a[0], b[0]);
        for (a, b) in a.into_iter().zip(b).skip(1) {
            extremes.add(a, b);
        }
        let covered = (size::<S, V>(p) + size::<S, V>(q)).simd_lt(self.frustum.limit);
        let outside = extremes.greatest.simd_lt(T::ZERO) & covered;
        let inside = extremes.least.simd_gt(T::ZERO) & covered;
        let certain = extremes.nearest.simd_gt(T::ZERO) & covered;
        let present = u64::MAX >> (64 - count);
        let crossing = (certain & !outside & !inside).to_bitmask() & present;
        let uncertain = !(certain | outside).to_bitmask() & present;
        let items = std::array::from_fn::<u32, N, _>(|j| (base + j) as u32);
        self.queues
            .inside
            .append(items, inside.to_bitmask() & present);
        self.queues.crossing.append(items, crossing);
        self.queues.uncertain.append(items, uncertain);
    }

    /// Clips the segments that have ends on both sides of some faces, and on no face.
    #[inline(always)]
    fn cross<L: Layout, const N: usize>(&mut self)
    where
        V: SimdFloat<S, Element = T, Array = [T; N]>,
    {
        let Block {
            segments, clips, ..
        } = &mut self.block;
        let mut discarded = outside();
        for (items, _) in self.queues.crossing.groups::<N>() {
            let group = items.map(|i| &segments[i as usize % BLOCK]);
            let p: Vec3<V> = points(self.simd, group.map(|s| s.start));
            let q: Vec3<V> = points(self.simd, group.map(|s| s.end));
            let found = crossings::<S, T, V, L, N>(self.simd, self.frustum, p, q);
            for (j, item) in items.into_iter().enumerate() {
                let clip = found.clip(j);
                // A pointer is chosen without a branch. The last group's
                // repeated items have the same clips.
                let place = if found.t[0][j] > found.t[1][j] {
                    &mut discarded
                } else {
                    &mut clips[item as usize]
                };
                *place = clip;
            }
        }
    }

    /// One by one.
    fn uncertain(&mut self) -> Result<(), NonFiniteAt> {
        let items = self
            .queues
            .uncertain
            .items()
            .iter()
            .map(|&item| item as usize);
        self.block.clip_singly(items, vw::clip_plain)
    }
}

/// Parameters, points and faces of entries and exits.
struct Crossings<T, const N: usize> {
    t: [[T; N]; 2],
    points: [[[T; N]; 3]; 2],
    clipped: [u64; 2],
    /// Sets of faces, as the values of their bits.
    faces: [[T; N]; 2],
}

#[inline(always)]
fn crossings<S, T, V, L, const N: usize>(
    simd: S,
    f: &PlainFrustum<T>,
    p: Vec3<V>,
    q: Vec3<V>,
) -> Crossings<T, N>
where
    S: Simd,
    T: Real,
    V: SimdFloat<S, Element = T, Array = [T; N]> + Term,
    L: Layout,
{
    let a = values::<S, T, V, L>(simd, f, p);
    let b = values::<S, T, V, L>(simd, f, q);
    let (zero, one) = (V::splat(simd, T::ZERO), V::splat(simd, T::ONE));
    let (before, beyond) = (-one, one + one);
    let (mut enter, mut leave) = ([before; 6], [beyond; 6]);
    let (mut t0, mut t1) = (zero, one);
    let (mut least_a, mut least_b) = (a[0], b[0]);
    for i in 0..6 {
        if i == 1 && !L::FAR {
            continue;
        }
        let t = a[i] / (a[i] - b[i]);
        // The parameters of a face that is not crossed change nothing.
        enter[i] = a[i].simd_gt(zero).select(before, t);
        leave[i] = b[i].simd_gt(zero).select(beyond, t);
        t0 = t0.max(enter[i]);
        t1 = t1.min(leave[i]);
        least_a = least_a.min(a[i]);
        least_b = least_b.min(b[i]);
    }
    let clipped = [least_a.simd_lt(zero), least_b.simd_lt(zero)];
    let (mut entered, mut left) = (zero, zero);
    let mut bit = one;
    for i in 0..6 {
        if L::FAR || i != 1 {
            entered += enter[i].simd_ge(t0).select(bit, zero);
            left += leave[i].simd_le(t1).select(bit, zero);
        }
        bit += bit;
    }
    let d = Vec3::new(q.x - p.x, q.y - p.y, q.z - p.z);
    let first = [
        clipped[0].select(d.x * t0 + p.x, p.x),
        clipped[0].select(d.y * t0 + p.y, p.y),
        clipped[0].select(d.z * t0 + p.z, p.z),
    ];
    let last = [
        clipped[1].select(d.x * t1 + p.x, q.x),
        clipped[1].select(d.y * t1 + p.y, q.y),
        clipped[1].select(d.z * t1 + p.z, q.z),
    ];
    Crossings {
        t: [t0.to_array(), t1.to_array()],
        points: [first.map(|v| v.to_array()), last.map(|v| v.to_array())],
        clipped: clipped.map(|m| m.to_bitmask()),
        faces: [entered.to_array(), left.to_array()],
    }
}

impl<T: Real, const N: usize> Crossings<T, N> {
    /// The clip of lane j, if its parameters are in order.
    #[inline(always)]
    fn clip(&self, j: usize) -> SegmentClip<T> {
        let touch = self.t[0][j] == self.t[1][j];
        let sets = [self.set(0, j), self.set(1, j)];
        let both = sets[0].union(sets[1]);
        let [entry, exit] = if touch { [both, both] } else { sets };
        SegmentClip {
            class: class(touch, false, true),
            part: Some(Part {
                entry: self.end(0, j, entry),
                exit: self.end(1, j, exit),
                coplanar: FaceSet::EMPTY,
            }),
        }
    }

    #[inline(always)]
    fn set(&self, end: usize, j: usize) -> FaceSet {
        // At most 63, exactly.
        FaceSet::from_bits(self.faces[end][j].to_f64() as u8)
    }

    #[inline(always)]
    fn end(&self, end: usize, j: usize, faces: FaceSet) -> PartEnd<T> {
        let clipped = self.clipped[end] >> j & 1 != 0;
        let [x, y, z] = &self.points[end];
        let point = Vec3::new(x[j], y[j], z[j]);
        PartEnd::fast(self.t[end][j], point, clipped, faces)
    }
}
