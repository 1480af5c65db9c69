//! The predicates in stages: each leaves to the next one what it cannot decide.
//!
//! 1. *Lattice*: on coarse coordinates floating point makes no error at all,
//!    so that touches are decided as fast as other cases. Typical of CAD data.
//! 2. *Filter*: floating point with an error bound ([`Filter`]).
//! 3. *Double-double*: the filter again with 2^-53 of its error.
//! 4. *Expansions*, in the range of exponents where they are exact, while
//!    they stay short: for exact zeros off the lattice.
//! 5. *Integers*, for all other cases. The only stage that allocates.

use crate::clip::StageCounts;
use crate::clip::predicates::Predicates;
use crate::exact::Number;
use crate::exact::dyadic::Dyadic;
use crate::exact::expansion::{Expansion, in_safe_range};
use crate::frustum::eval::boundary::boundary;
use crate::frustum::eval::filter::{DOUBLE_DOUBLE_ERROR_PER_THRESHOLD, Filter, Values};
use crate::frustum::{Face, Frustum};
use crate::math::{End, Segment, Vec3};
use std::cmp::Ordering;

/// A segment, a frustum, and the signs that are known.
pub(crate) struct Staged<'a> {
    pub(crate) frustum: &'a Frustum,
    pub(crate) segment: Segment<f64>,
    /// At start and end.
    pub(crate) values: [Values; 2],
    /// Whether plain arithmetic is exact here.
    pub(crate) lattice: bool,
    /// The known signs at start and end.
    known: [Known; 2],
    counts: StageCounts,
    /// Whether the filter has failed for this segment.
    failed: bool,
}

/// Signs at an end, in bits by face.
#[derive(Clone, Copy, Default)]
struct Known {
    /// Whether the sign is known.
    any: u8,
    outside: u8,
    on: u8,
}

/// Upper bound of the underflow in the sum of products that bounds a double-double cross product.
const UNDERFLOW: f64 = 1e-300;

impl<'a> Staged<'a> {
    pub(crate) fn new(frustum: &'a Frustum, segment: Segment<f64>) -> Self {
        let filter = frustum.filter();
        let values = filter.values_of(&segment);
        let lattice = filter.on_lattice(&segment, &values[0], &values[1]);
        Staged::with(frustum, segment, values, lattice)
    }

    #[inline(always)]
    pub(crate) fn with(
        frustum: &'a Frustum,
        segment: Segment<f64>,
        values: [Values; 2],
        lattice: bool,
    ) -> Self {
        Staged {
            frustum,
            segment,
            values,
            lattice,
            known: [Known::default(); 2],
            counts: StageCounts::default(),
            failed: false,
        }
    }

    /// Adds what this segment needed to a caller's counts.
    pub(crate) fn add_to(&self, counts: &mut StageCounts) {
        counts.lattice += u64::from(self.lattice);
        counts.filter_failures += u64::from(self.failed);
        counts.double_doubles += self.counts.double_doubles;
        counts.expansions += self.counts.expansions;
        counts.integers += self.counts.integers;
    }

    pub(crate) fn filter(&self) -> &'a Filter {
        self.frustum.filter()
    }

    pub(crate) fn point(&self, end: End) -> Vec3<f64> {
        match end {
            End::Start => self.segment.start,
            End::End => self.segment.end,
        }
    }

    /// Whether a face's rounded values at both ends exceed their thresholds.
    #[inline(always)]
    pub(crate) fn certain(&self, face: Face) -> bool {
        let filter = self.filter();
        self.values.iter().all(|v| {
            filter.covers(v.size) && v.of(face as usize).abs() > filter.threshold(face, v.size)
        })
    }

    /// The sign of a face's boundary function at any point.
    pub(crate) fn sign_at(&mut self, face: Face, p: Vec3<f64>, values: &Values) -> Ordering {
        match self.filter().sign(face, values) {
            Some(sign) => sign,
            None => self.sign_beyond_filter(face, p, values),
        }
    }

    fn sign_beyond_filter(&mut self, face: Face, p: Vec3<f64>, values: &Values) -> Ordering {
        let filter = self.filter();
        if let Some(sign) = filter.precise_sign(face, p, values) {
            self.counts.double_doubles += 1;
            return sign;
        }
        if filter.expansions
            && fits(p)
            && let Ok(value) = boundary::<Expansion>(self.frustum, face, p)
        {
            self.counts.expansions += 1;
            return value.sign();
        }
        self.counts.integers += 1;
        self.integer(face, p).sign()
    }

    /// Both boundary values of a face as expansions, if they do not overflow.
    pub(crate) fn expansions(&mut self, face: Face) -> Option<[Expansion; 2]> {
        let Segment { start, end } = self.segment;
        if !(self.filter().expansions && fits(start) && fits(end)) {
            return None;
        }
        let values = [
            boundary(self.frustum, face, start).ok()?,
            boundary(self.frustum, face, end).ok()?,
        ];
        self.counts.expansions += 1;
        Some(values)
    }

    /// Both boundary values of a face as integers.
    pub(crate) fn integers(&mut self, face: Face) -> [Dyadic; 2] {
        self.counts.integers += 1;
        let Segment { start, end } = self.segment;
        [self.integer(face, start), self.integer(face, end)]
    }

    fn integer(&self, face: Face, p: Vec3<f64>) -> Dyadic {
        let Ok(value) = boundary(self.frustum, face, p);
        value
    }

    /// `f_a(q) f_b(p) - f_a(p) f_b(q)` from rounded values, if certain.
    fn filtered_cross(&self, a: Face, b: Face) -> Option<Ordering> {
        let filter = self.filter();
        let [p, q] = &self.values;
        let (pa, qa) = (p.of(a as usize), q.of(a as usize));
        let (pb, qb) = (p.of(b as usize), q.of(b as usize));
        let cross = qa * pb - pa * qb;
        if self.lattice {
            return cross.partial_cmp(&0.0);
        }
        if !(filter.covers(p.size) && filter.covers(q.size)) {
            return None;
        }
        // Each value is within an eighth of its threshold, and T >= 128 u g
        // covers the products' own rounding; the sum below is four times both.
        // It does not underflow: T >= UNDERFLOW_ERROR = 2^-500.
        let t = |face, v: &Values| filter.threshold(face, v.size);
        let (tpa, tqa) = (t(a, p), t(a, q));
        let (tpb, tqb) = (t(b, p), t(b, q));
        let bound = tqa * pb.abs() + tpb * qa.abs() + tpa * qb.abs() + tqb * pa.abs();
        let bound = bound + (tqa * tpb + tpa * tqb);
        if cross.abs() > bound {
            cross.partial_cmp(&0.0)
        } else {
            None
        }
    }

    /// The same in double-double. The values are within 2^-54 thresholds, and
    /// the products' own rounding, 2^-100 of each, is below that too.
    fn precise_cross(&self, a: Face, b: Face) -> Option<Ordering> {
        let filter = self.filter();
        let [sp, sq] = self.values.each_ref().map(|v| v.size);
        if !(filter.covers(sp) && filter.covers(sq)) {
            return None;
        }
        let at = |face: Face, p| filter.precise.value(face as usize, p);
        let Segment { start, end } = self.segment;
        let (pa, qa) = (at(a, start), at(a, end));
        let (pb, qb) = (at(b, start), at(b, end));
        let cross = qa.mul(pb).add(pa.mul(qb).neg());
        let t = |face, size| DOUBLE_DOUBLE_ERROR_PER_THRESHOLD * filter.threshold(face, size);
        let bound = t(a, sq) * pb.hi.abs() + t(b, sp) * qa.hi.abs();
        let bound = bound + t(a, sp) * qb.hi.abs() + t(b, sq) * pa.hi.abs();
        let bound = bound + (t(a, sp) * t(b, sq) + t(a, sq) * t(b, sp)) + UNDERFLOW;
        if cross.hi.abs() > bound {
            cross.hi.partial_cmp(&0.0)
        } else {
            None
        }
    }

    fn exact_cross(&mut self, a: Face, b: Face) -> Ordering {
        self.failed = true;
        if let Some(cross) = self.precise_cross(a, b) {
            self.counts.double_doubles += 1;
            return cross;
        }
        if let Some([pa, qa]) = self.expansions(a)
            && let Some([pb, qb]) = self.expansions(b)
            && let Ok(cross) = cross(&pa, &qa, &pb, &qb)
        {
            return cross.sign();
        }
        let [pa, qa] = self.integers(a);
        let [pb, qb] = self.integers(b);
        let Ok(cross) = cross(&pa, &qa, &pb, &qb);
        cross.sign()
    }

    /// Finds a sign.
    fn learn(&mut self, face: Face, end: End) {
        let values = self.values[end as usize];
        let sign = if self.lattice {
            let g = values.of(face as usize);
            g.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
        } else if let Some(sign) = self.filter().sign(face, &values) {
            sign
        } else {
            self.failed = true;
            self.sign_beyond_filter(face, self.point(end), &values)
        };
        let known = &mut self.known[end as usize];
        let bit = 1 << face as u8;
        known.any |= bit;
        match sign {
            Ordering::Less => known.outside |= bit,
            Ordering::Equal => known.on |= bit,
            Ordering::Greater => {}
        }
    }

    /// Whether a face's value falls from start to end.
    fn leaves(&mut self, face: Face) -> bool {
        self.side(face, End::End) == Ordering::Less
    }
}

/// `qa pb - pa qb`.
fn cross<N: Number>(pa: &N, qa: &N, pb: &N, qb: &N) -> Result<N, N::Overflow> {
    qa.mul(pb)?.sub(pa.mul(qb)?)
}

fn fits(p: Vec3<f64>) -> bool {
    p.to_array().into_iter().all(in_safe_range)
}

impl Predicates for Staged<'_> {
    fn faces(&self) -> &'static [Face] {
        self.frustum.faces()
    }

    #[inline(always)]
    fn side(&mut self, face: Face, end: End) -> Ordering {
        let bit = 1 << face as u8;
        if self.known[end as usize].any & bit == 0 {
            self.learn(face, end);
        }
        let known = self.known[end as usize];
        if known.outside & bit != 0 {
            Ordering::Less
        } else if known.on & bit != 0 {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }

    /// With values p, q of the two faces at start and end,
    /// `t_a - t_b = (qa pb - pa qb) / ((pa - qa) (pb - qb))`, and `pa - qa` is
    /// positive exactly for a face that the segment leaves.
    #[inline(always)]
    fn order(&mut self, a: Face, b: Face) -> Ordering {
        if a == b {
            return Ordering::Equal;
        }
        let cross = match self.filtered_cross(a, b) {
            Some(cross) => cross,
            None => self.exact_cross(a, b),
        };
        if self.leaves(a) == self.leaves(b) {
            cross
        } else {
            cross.reverse()
        }
    }
}
