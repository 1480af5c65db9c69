//! Exact V/W, four segments at a time: triage and certificates as in
//! `clip/exact/vw.rs`, where their proofs are.

use super::Chunk;
use super::lanes::{Quad, ends};
use super::lattice;
use super::points::Parts;
use super::queue::{Crossed, Queues};
use crate::clip::exact::{self, vw::ROUNDING};
use crate::clip::plain::outside;
use crate::clip::{Accuracy, StageCounts};
use crate::frustum::Layout;
use crate::frustum::eval::filter::Filter;
use crate::math::{NonFiniteAt, Real, Segment, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{f64x4, mask64x4, u64x4};

/// A chunk on its way.
pub(super) struct Run<'a, S, T> {
    pub(super) quad: Quad<S>,
    pub(super) chunk: Chunk<'a, T>,
    pub(super) accuracy: Accuracy,
    pub(super) queues: &'a mut Queues,
    pub(super) counts: &'a mut StageCounts,
}

/// The six boundary values at both ends of four segments, sizes and thresholds.
pub(super) struct Values<S: Simd> {
    pub(super) a: [f64x4<S>; 6],
    pub(super) b: [f64x4<S>; 6],
    sizes: [f64x4<S>; 2],
    depth: f64x4<S>,
    side: f64x4<S>,
    covered: mask64x4<S>,
}

impl<S: Simd> Values<S> {
    #[inline(always)]
    fn new<L: Layout>(filter: &Filter, p: Vec3<f64x4<S>>, q: Vec3<f64x4<S>>) -> Self {
        let (a, p_size) = filter.values_at::<L, _>(p);
        let (b, q_size) = filter.values_at::<L, _>(q);
        let size = p_size + q_size;
        let (depth, side) = filter.crossing_thresholds(size);
        Values {
            a,
            b,
            sizes: [p_size, q_size],
            depth,
            side,
            covered: size.simd_lt(filter.limit()),
        }
    }

    /// Which segments' signs prove that they are outside, inside, crossing.
    #[inline(always)]
    fn triage(&self) -> [mask64x4<S>; 3] {
        let mut greatest = Least::new(self.a[0].max(self.b[0]), self.a[2].max(self.b[2]));
        let mut least = Least::new(self.a[0].min(self.b[0]), self.a[2].min(self.b[2]));
        let mut nearest = Least::new(
            self.a[0].abs().min(self.b[0].abs()),
            self.a[2].abs().min(self.b[2].abs()),
        );
        for i in [1, 3, 4, 5] {
            let (a, b) = (self.a[i], self.b[i]);
            greatest.add(i, a.max(b));
            least.add(i, a.min(b));
            nearest.add(i, a.abs().min(b.abs()));
        }
        let outside = greatest.depth.simd_lt(-self.depth) | greatest.side.simd_lt(-self.side);
        let inside = least.beyond(self.depth, self.side);
        let crossing = nearest.beyond(self.depth, self.side);
        let outside = self.covered & outside;
        let inside = self.covered & inside & !outside;
        [
            outside,
            inside,
            self.covered & crossing & !outside & !inside,
        ]
    }

    /// Latest entry and earliest exit, as `certify` in `clip/exact/vw.rs`.
    #[inline(always)]
    fn certify<L: Layout>(&self, quad: Quad<S>) -> Certificate<S> {
        let splat = |v: f64| quad.splat(v);
        let mut enter = Two::new(splat(-4.0));
        let mut leave = Two::new(splat(-4.0));
        let mut scales = [splat(0.0); 2];
        for i in 0..6 {
            if i == 1 && !L::FAR {
                continue;
            }
            let (a, b) = (self.a[i], self.b[i]);
            let scale = splat(1.0) / (a - b);
            let t = a * scale;
            let (entering, leaving) = (a.simd_lt(0.0), b.simd_lt(0.0));
            enter.add(numbered(entering.select(t, splat(-1.0)), i as u64));
            leave.add(numbered(leaving.select(-t, splat(-2.0)), i as u64));
            let scale = (entering ^ leaving).select(scale.abs(), splat(0.0));
            let of = usize::from(i > 1);
            scales[of] = scales[of].max(scale);
        }
        // What two parameters can be off, together.
        let error = (self.depth * scales[0]).max(self.side * scales[1]);
        let error = (error + ROUNDING) * 2.0;
        let overlap = enter.first + leave.first;
        let uncrossed = [enter.first.simd_lt(-0.5), leave.first.simd_lt(-1.5)];
        Certificate {
            outside: overlap.simd_gt(error),
            certain: (enter.single(error) | uncrossed[0])
                & (leave.single(error) | uncrossed[1])
                & overlap.simd_lt(-error),
            clipped: uncrossed.map(|none| (!none).to_bitmask()),
            faces: (enter.first.to_bits() & 7) | ((leave.first.to_bits() & 7) << 3),
        }
    }
}

/// The least of near and far, and of the sides.
struct Least<S: Simd> {
    depth: f64x4<S>,
    side: f64x4<S>,
}

impl<S: Simd> Least<S> {
    #[inline(always)]
    fn new(depth: f64x4<S>, side: f64x4<S>) -> Self {
        Self { depth, side }
    }

    #[inline(always)]
    fn add(&mut self, face: usize, v: f64x4<S>) {
        if face < 2 {
            self.depth = self.depth.min(v);
        } else {
            self.side = self.side.min(v);
        }
    }

    #[inline(always)]
    fn beyond(&self, depth: f64x4<S>, side: f64x4<S>) -> mask64x4<S> {
        self.depth.simd_gt(depth) & self.side.simd_gt(side)
    }
}

/// What rounded parameters prove: see `Certificate` in `clip/exact/vw.rs`.
struct Certificate<S: Simd> {
    outside: mask64x4<S>,
    certain: mask64x4<S>,
    /// Whether there is an entry, and an exit, in bits by lane.
    clipped: [u64; 2],
    /// For [`Crossed`].
    faces: u64x4<S>,
}

/// Whether all coordinates are on the lattice: see `Filter::on_lattice`.
#[inline(always)]
fn on_grid<S: Simd>(round: f64, v: Vec3<f64x4<S>>) -> mask64x4<S> {
    let x = ((v.x + round) - round).simd_eq(v.x);
    let y = ((v.y + round) - round).simd_eq(v.y);
    let z = ((v.z + round) - round).simd_eq(v.z);
    x & y & z
}

/// A parameter with the face's number in its last three bits.
#[inline(always)]
fn numbered<S: Simd>(t: f64x4<S>, face: u64) -> f64x4<S> {
    f64x4::from_bits((t.to_bits() & !7) | face)
}

/// The greatest two so far.
#[derive(Clone, Copy)]
struct Two<S: Simd> {
    first: f64x4<S>,
    second: f64x4<S>,
}

impl<S: Simd> Two<S> {
    #[inline(always)]
    fn new(least: f64x4<S>) -> Self {
        Two {
            first: least,
            second: least,
        }
    }

    #[inline(always)]
    fn add(&mut self, v: f64x4<S>) {
        self.second = self.second.max(self.first.min(v));
        self.first = self.first.max(v);
    }

    /// Where the greatest is that by more than an error.
    #[inline(always)]
    fn single(&self, error: f64x4<S>) -> mask64x4<S> {
        (self.second + error).simd_lt(self.first)
    }
}

impl<S: Simd, T: Real> Run<'_, S, T> {
    /// Clips the chunk.
    #[inline(always)]
    pub(super) fn clip<L: Layout>(&mut self) -> Result<(), NonFiniteAt> {
        self.queues.clear();
        self.triage::<L>();
        if self.accuracy == Accuracy::Fast {
            self.lattice::<L>();
            self.certify::<L>();
            self.construct();
        }
        for &item in self.queues.inside.items() {
            let index = item as usize;
            self.chunk.clips[index] = exact::inside(&self.chunk.segments[index]);
        }
        self.unsure()
    }

    /// All segments, four at a time; the last group is filled up with its last one.
    #[inline(always)]
    fn triage<L: Layout>(&mut self) {
        let (groups, rest) = self.chunk.segments.as_chunks::<4>();
        for (k, group) in groups.iter().enumerate() {
            self.triage_four::<L>(group.each_ref(), 4 * k, 0xf);
        }
        if let Some(last) = rest.len().checked_sub(1) {
            let group = [0, 1, 2, 3].map(|j: usize| &rest[j.min(last)]);
            self.triage_four::<L>(group, 4 * groups.len(), 0xf >> (3 - last));
        }
    }

    /// `present` has the bits of the segments that are there.
    #[inline(always)]
    fn triage_four<L: Layout>(&mut self, group: [&Segment<T>; 4], base: usize, present: u64) {
        let filter = self.chunk.frustum.filter();
        let [p, q] = ends(group);
        let (p, q) = (self.quad.points(p), self.quad.points(q));
        let values = Values::new::<L>(filter, p, q);
        let [beyond, inside, crossing] = values.triage();
        let settled = (beyond | inside).to_bitmask();
        let inside = inside.to_bitmask() & present;
        let mut crossing = crossing.to_bitmask() & present;
        let mut lattice = 0;
        if self.accuracy != Accuracy::Fast {
            // Points are constructed elsewhere.
            crossing = 0;
        } else if let Some((round, limit)) = filter.lattice() {
            let small = values.sizes[0].simd_lt(limit) & values.sizes[1].simd_lt(limit);
            let on = small & on_grid(round, p) & on_grid(round, q);
            lattice = on.to_bitmask() & present;
            // Those that are settled are counted here, the rest when they are.
            self.counts.lattice += u64::from((lattice & settled).count_ones());
            lattice &= !settled;
            crossing &= !lattice;
        }
        let unsure = present & !(settled | crossing | lattice);
        let items = [0, 1, 2, 3].map(|j| (base + j) as u32);
        self.queues.inside.append(items, inside);
        self.queues.crossing.append(items, crossing);
        self.queues.lattice.append(items, lattice);
        self.queues.unsure.append(items, unsure);
    }

    /// What plain arithmetic clips without an error.
    #[inline(always)]
    fn lattice<L: Layout>(&mut self) {
        let Queues {
            lattice, unsure, ..
        } = &mut *self.queues;
        let Chunk {
            frustum,
            segments,
            clips,
        } = &mut self.chunk;
        let filter = frustum.filter();
        let mut nowhere = outside();
        for (items, count) in lattice.groups::<4>() {
            let [p, q] = ends(items.map(|i| &segments[i as usize]));
            let (p, q) = (self.quad.points(p), self.quad.points(q));
            let values = Values::new::<L>(filter, p, q);
            let found = lattice::Clips::new(self.quad, filter, &values, p, q);
            let present = 0xf >> (4 - count);
            // What has no length is clipped, and counted, alone.
            unsure.append(items, found.still & present);
            self.counts.lattice += u64::from((present & !found.still).count_ones());
            for (j, item) in items.into_iter().enumerate() {
                // A pointer is chosen without a branch.
                let place = if (found.outside | found.still) >> j & 1 != 0 {
                    &mut nowhere
                } else {
                    &mut clips[item as usize]
                };
                *place = found.clip(j);
            }
        }
    }

    /// What certainly has ends on both sides of some faces.
    #[inline(always)]
    fn certify<L: Layout>(&mut self) {
        let Queues {
            crossing,
            crossed,
            unsure,
            ..
        } = &mut *self.queues;
        let filter = self.chunk.frustum.filter();
        for (items, count) in crossing.groups::<4>() {
            let group = items.map(|i| &self.chunk.segments[i as usize]);
            let [p, q] = ends(group);
            let (p, q) = (self.quad.points(p), self.quad.points(q));
            let found = Values::new::<L>(filter, p, q).certify::<L>(self.quad);
            let present = 0xf >> (4 - count);
            let certain = found.certain.to_bitmask() & present;
            let open = !(found.certain | found.outside).to_bitmask() & present;
            let faces: [u64; 4] = found.faces.into();
            let [entered, left] = found.clipped;
            let packed = [0, 1, 2, 3].map(|j| {
                let clipped = [entered >> j & 1, left >> j & 1];
                Crossed::new(items[j], faces[j], clipped).0
            });
            crossed.append(packed, certain);
            unsure.append(items, open);
        }
    }

    #[inline(always)]
    fn construct(&mut self) {
        let filter = self.chunk.frustum.filter();
        for (items, _) in self.queues.crossed.groups::<4>() {
            let items = items.map(Crossed);
            let group = items.map(|c| &self.chunk.segments[c.item()]);
            let parts = Parts::new(self.quad, filter, items, group);
            // The last group's repeated items have the same clips.
            for (j, item) in items.into_iter().enumerate() {
                self.chunk.clips[item.item()] = parts.clip(item, j);
            }
        }
    }

    /// One by one. The first that is queued of those that are not finite is the
    /// first of all: certificates never see them.
    fn unsure(&mut self) -> Result<(), NonFiniteAt> {
        let items = self.queues.unsure.items().iter().map(|&item| item as usize);
        self.chunk.clip_singly(items, |frustum, segment| {
            exact::vw::clip(frustum, segment, self.accuracy, self.counts)
        })
    }
}
