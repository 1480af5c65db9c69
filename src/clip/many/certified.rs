//! Exact V/W, four segments at a time: the rules of `clip/rules/`, with a face a register.

use super::Block;
use super::lanes::{Quad, ends};
use super::lattice;
use super::points::Parts;
use super::queue::{Crossed, Queues};
use crate::clip::exact;
use crate::clip::rules::certificate::{
    ENTRIES_ABOVE, EXITS_ABOVE, FaceCrossing, Latest, error_of_two, error_of_values,
};
use crate::clip::rules::triage::{Extremes, Signs};
use crate::clip::whole::{inside, outside};
use crate::clip::{Accuracy, StageCounts};
use crate::frustum::Layout;
use crate::frustum::eval::filter::Filter;
use crate::math::{NonFiniteAt, Real, Segment, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{f64x4, mask64x4, u64x4};

/// A block on its way.
pub(super) struct Run<'a, S, T> {
    pub(super) quad: Quad<S>,
    pub(super) block: Block<'a, T>,
    pub(super) accuracy: Accuracy,
    pub(super) queues: &'a mut Queues,
    pub(super) counts: &'a mut StageCounts,
}

/// The six boundary values at both ends of four segments, their sizes and thresholds.
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

    /// The segments whose signs prove that they are outside, inside, crossing.
    #[inline(always)]
    fn triage(&self) -> [mask64x4<S>; 3] {
        let (a, b) = (&self.a, &self.b);
        let mut signs = Signs {
            depth: Extremes::new(a[0], b[0]),
            side: Extremes::new(a[2], b[2]),
        };
        signs.depth.add(a[1], b[1]);
        for i in 3..6 {
            signs.side.add(a[i], b[i]);
        }
        let thresholds = (self.depth, self.side);
        let outside = self.covered & signs.outside(thresholds);
        let inside = self.covered & signs.inside(thresholds) & !outside;
        let crossing = self.covered & signs.certain(thresholds) & !outside & !inside;
        [outside, inside, crossing]
    }

    #[inline(always)]
    fn crossing(&self, quad: Quad<S>, face: usize) -> FaceCrossing<f64x4<S>> {
        let tag = quad.splat(f64::from_bits(face as u64));
        FaceCrossing::new(self.a[face], self.b[face], tag)
    }

    /// Latest entry and earliest exit, and what they prove.
    #[inline(always)]
    fn certify<L: Layout>(&self, quad: Quad<S>) -> Certificate<S> {
        let (near, left) = (self.crossing(quad, 0), self.crossing(quad, 2));
        let mut enter = Latest::new(near.enter, left.enter);
        let mut leave = Latest::new(near.leave, left.leave);
        let mut scales = [near.scale, left.scale];
        for face in [1, 3, 4, 5] {
            if face == 1 && !L::FAR {
                continue;
            }
            let other = self.crossing(quad, face);
            enter.add(other.enter);
            leave.add(other.leave);
            let scale = &mut scales[usize::from(face > 1)];
            *scale = scale.max(other.scale);
        }
        let error = error_of_two(error_of_values((self.depth, self.side), scales));
        let overlap = enter.first + leave.first;
        let (no_entry, entry_certain) = enter.alone(error, quad.splat(ENTRIES_ABOVE));
        let (no_exit, exit_certain) = leave.alone(error, quad.splat(EXITS_ABOVE));
        Certificate {
            outside: overlap.simd_gt(error),
            certain: entry_certain & exit_certain & overlap.simd_lt(-error),
            clipped: [no_entry, no_exit].map(|none| (!none).to_bitmask()),
            faces: (enter.first.to_bits() & 7) | ((leave.first.to_bits() & 7) << 3),
        }
    }
}

/// What rounded parameters prove.
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

impl<S: Simd, T: Real> Run<'_, S, T> {
    /// Clips the block.
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
            self.block.clips[index] = inside(&self.block.segments[index]);
        }
        self.uncertain()
    }

    /// All segments, four at a time; the last group is filled up with its last segment.
    #[inline(always)]
    fn triage<L: Layout>(&mut self) {
        let (groups, rest) = self.block.segments.as_chunks::<4>();
        for (k, group) in groups.iter().enumerate() {
            self.triage_four::<L>(group.each_ref(), 4 * k, 0xf);
        }
        if let Some(last) = rest.len().checked_sub(1) {
            let group = [0, 1, 2, 3].map(|j: usize| &rest[j.min(last)]);
            self.triage_four::<L>(group, 4 * groups.len(), 0xf >> (3 - last));
        }
    }

    /// `present` has the bits of the segments that count.
    #[inline(always)]
    fn triage_four<L: Layout>(&mut self, group: [&Segment<T>; 4], base: usize, present: u64) {
        let filter = self.block.frustum.filter();
        let [p, q] = ends(group);
        let (p, q) = (self.quad.points(p), self.quad.points(q));
        let values = Values::new::<L>(filter, p, q);
        let [beyond, inside, crossing] = values.triage();
        let settled = (beyond | inside).to_bitmask();
        let inside = inside.to_bitmask() & present;
        let mut crossing = crossing.to_bitmask() & present;
        let mut lattice = 0;
        if self.accuracy != Accuracy::Fast {
            // They are clipped one by one, with their points.
            crossing = 0;
        } else if let Some((round, limit)) = filter.lattice() {
            let small = values.sizes[0].simd_lt(limit) & values.sizes[1].simd_lt(limit);
            let on = small & on_grid(round, p) & on_grid(round, q);
            lattice = on.to_bitmask() & present;
            // Settled ones are counted here, the others when they are settled.
            self.counts.lattice += u64::from((lattice & settled).count_ones());
            lattice &= !settled;
            crossing &= !lattice;
        }
        let uncertain = present & !(settled | crossing | lattice);
        let items = [0, 1, 2, 3].map(|j| (base + j) as u32);
        self.queues.inside.append(items, inside);
        self.queues.crossing.append(items, crossing);
        self.queues.lattice.append(items, lattice);
        self.queues.uncertain.append(items, uncertain);
    }

    /// Clips the segments for which plain arithmetic makes no error.
    #[inline(always)]
    fn lattice<L: Layout>(&mut self) {
        let Queues {
            lattice, uncertain, ..
        } = &mut *self.queues;
        let Block {
            frustum,
            segments,
            clips,
        } = &mut self.block;
        let filter = frustum.filter();
        let mut discarded = outside();
        for (items, count) in lattice.groups::<4>() {
            let [p, q] = ends(items.map(|i| &segments[i as usize]));
            let (p, q) = (self.quad.points(p), self.quad.points(q));
            let values = Values::new::<L>(filter, p, q);
            let found = lattice::Clips::new(self.quad, filter, &values, p, q);
            let present = 0xf >> (4 - count);
            // A segment of zero length is clipped, and counted, alone.
            uncertain.append(items, found.still & present);
            self.counts.lattice += u64::from((present & !found.still).count_ones());
            for (j, item) in items.into_iter().enumerate() {
                // A pointer is chosen without a branch.
                let place = if (found.outside | found.still) >> j & 1 != 0 {
                    &mut discarded
                } else {
                    &mut clips[item as usize]
                };
                *place = found.clip(j);
            }
        }
    }

    /// Certifies the segments that certainly have ends on both sides of some faces.
    #[inline(always)]
    fn certify<L: Layout>(&mut self) {
        let Queues {
            crossing,
            crossed,
            uncertain,
            ..
        } = &mut *self.queues;
        let filter = self.block.frustum.filter();
        for (items, count) in crossing.groups::<4>() {
            let group = items.map(|i| &self.block.segments[i as usize]);
            let [p, q] = ends(group);
            let (p, q) = (self.quad.points(p), self.quad.points(q));
            let found = Values::new::<L>(filter, p, q).certify::<L>(self.quad);
            let present = 0xf >> (4 - count);
            let certain = found.certain.to_bitmask() & present;
            let undecided = !(found.certain | found.outside).to_bitmask() & present;
            let faces: [u64; 4] = found.faces.into();
            let [entered, left] = found.clipped;
            let packed = [0, 1, 2, 3].map(|j| {
                let clipped = [entered >> j & 1, left >> j & 1];
                Crossed::new(items[j], faces[j], clipped).0
            });
            crossed.append(packed, certain);
            uncertain.append(items, undecided);
        }
    }

    /// Constructs the points of certain crossings.
    #[inline(always)]
    fn construct(&mut self) {
        let filter = self.block.frustum.filter();
        for (items, _) in self.queues.crossed.groups::<4>() {
            let items = items.map(Crossed);
            let group = items.map(|c| &self.block.segments[c.item()]);
            let parts = Parts::new(self.quad, filter, items, group);
            // The last group's repeated items have the same clips.
            for (j, item) in items.into_iter().enumerate() {
                self.block.clips[item.item()] = parts.clip(item, j);
            }
        }
    }

    /// One by one. The first that is queued of those that are not finite is the
    /// first of all: certificates never see them.
    fn uncertain(&mut self) -> Result<(), NonFiniteAt> {
        let items = self.queues.uncertain.items().iter();
        let items = items.map(|&item| item as usize);
        // With `Fast`, triage and certificate have failed already: exact predicates are next.
        let is_tried = self.accuracy == Accuracy::Fast;
        self.block
            .clip_singly(items, |frustum, segment| match is_tried {
                true => exact::clip(frustum, segment, self.accuracy, self.counts, |s| {
                    exact::vw::span(s)
                }),
                false => exact::vw::clip(frustum, segment, self.accuracy, self.counts),
            })
    }
}
