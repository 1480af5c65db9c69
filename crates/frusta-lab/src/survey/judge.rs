//! A case's answers, compared with the truth.
//!
//! Many clippers give the same answer to a case, all exact ones do. So the rational arithmetic for
//! an end is done once for each point, which is recognised by its bits: no agreement is assumed.

use super::entrant::{AnyAlgorithm, Scalar};
use super::row::SurveyTier;
use super::tally::Tally;
use frusta::clip::{Part, PartEnd, SegmentClip, StageCounts};
use frusta::frustum::Frustum;
use frusta::math::{NonFinite, Real, Segment, Vec3};
use frusta::oracle::{Gauge, Oracle, OracleClip, OracleEnd, is_mirrored};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// One case and the truth about it.
pub(super) struct Case<'a, T> {
    number: u64,
    segment: Segment<T>,
    frustum: &'a Frustum,
    truth: OracleClip,
    points: Points<'a>,
}

/// Points that were returned for the ends of a case, and their errors.
struct Points<'a> {
    oracle: &'a Oracle,
    /// The segment's largest coordinate.
    scale: f64,
    gauges: [Option<Gauge>; 2],
    known: Vec<Known>,
}

/// The error of a point returned for an end.
#[derive(Clone, Copy)]
struct Known {
    end: usize,
    bits: [u64; 3],
    error: EndError,
}

#[derive(Clone, Copy)]
struct EndError {
    ulp: f64,
    u_scale: f64,
    outside: bool,
}

/// A clipper's answers to a case.
struct Attempt<T> {
    answer: SegmentClip<T>,
    counts: StageCounts,
    /// Whether the answer for the swapped ends is the mirrored one.
    mirrored: bool,
    /// Whether the answer clips to itself.
    stays: bool,
}

impl<'a, T: Scalar> Case<'a, T> {
    /// The truth about a segment.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    pub(super) fn new(
        number: u64,
        segment: Segment<T>,
        frustum: &'a Frustum,
        oracle: &'a Oracle,
    ) -> Result<Self, NonFinite> {
        let ends = [segment.start, segment.end].map(|end| end.to_f64().to_array());
        let scale = ends.as_flattened().iter().fold(0.0, |m, c| c.abs().max(m));
        Ok(Self {
            number,
            segment,
            frustum,
            truth: oracle.clip(&segment)?,
            points: Points {
                oracle,
                scale,
                gauges: [None; 2],
                known: Vec::new(),
            },
        })
    }

    /// Adds a clipper's answer to its row.
    pub(super) fn judge(&mut self, clipper: &AnyAlgorithm<T>, tier: SurveyTier, row: &mut Tally) {
        row.cases += 1;
        let attempt = AssertUnwindSafe(|| self.attempt(clipper, tier));
        let Ok(Some(attempt)) = catch_unwind(attempt) else {
            row.refused.add(self.number);
            return;
        };
        let counts = &attempt.counts;
        row.filter_failures += u64::from(counts.filter_failures > 0);
        row.exact_stage += u64::from(counts.expansions + counts.integers > 0);
        row.asymmetric += u64::from(!attempt.mirrored);
        row.non_idempotent += u64::from(!attempt.stays);
        self.answer(&attempt.answer, tier, row);
    }

    /// `None` for a refusal, and for numbers that are not finite.
    fn attempt(&self, clipper: &AnyAlgorithm<T>, tier: SurveyTier) -> Option<Attempt<T>> {
        let clip = |segment: &Segment<T>, counts: &mut StageCounts| {
            let answer = clipper
                .clip_segment_counted(self.frustum, segment, counts)
                .ok()?;
            is_finite(&answer).then_some(answer)
        };
        let mut counts = StageCounts::default();
        let answer = clip(&self.segment, &mut counts)?;
        let mut ignored = StageCounts::default();
        let swapped = clip(&self.segment.reversed(), &mut ignored)?;
        let stays = match answer.points() {
            Some([first, last]) if promises_to_stay(&answer, tier) => {
                let again = clip(&Segment::new(first, last), &mut ignored)?;
                let same = |[a, b]: [Vec3<T>; 2]| bits(a) == bits(first) && bits(b) == bits(last);
                again.points().is_some_and(same)
            }
            _ => true,
        };
        Some(Attempt {
            answer,
            counts,
            mirrored: is_mirrored(&answer, &swapped),
            stays,
        })
    }

    fn answer(&mut self, answer: &SegmentClip<T>, tier: SurveyTier, row: &mut Tally) {
        let truth = self.truth.part.as_ref();
        if answer.class != self.truth.class || answer.part.is_some() != truth.is_some() {
            row.wrong_class.add(self.number);
            return;
        }
        let (Some(part), Some(exact)) = (&answer.part, truth) else {
            return;
        };
        let ends = [(&part.entry, &exact.entry), (&part.exit, &exact.exit)];
        let right = |(is, exact): (&PartEnd<T>, &OracleEnd)| {
            is.faces == exact.faces && is.clipped == exact.clipped
        };
        if part.coplanar != exact.coplanar || !ends.into_iter().all(right) {
            row.wrong_faces.add(self.number);
        }
        let mut outside = false;
        for (end, (is, exact)) in ends.into_iter().enumerate() {
            if !(is.clipped || exact.clipped) {
                continue;
            }
            let error = self.points.error(end, exact, is.point);
            row.ulp.add(self.number, error.ulp);
            row.u_scale.add(self.number, error.u_scale);
            let promised = !tier.is_inward() || is.inward;
            outside |= error.outside && is.clipped && promised;
        }
        row.outside += u64::from(outside);
    }
}

impl Points<'_> {
    /// The distance of a point from the exact end, by rational arithmetic if the point is new.
    fn error<T: Real>(&mut self, end: usize, exact: &OracleEnd, point: Vec3<T>) -> EndError {
        let bits = bits(point);
        let found = self.known.iter().find(|k| k.end == end && k.bits == bits);
        if let Some(known) = found {
            return known.error;
        }
        let error = self.measure(end, exact, point);
        self.known.push(Known { end, bits, error });
        error
    }

    fn measure<T: Real>(&mut self, end: usize, exact: &OracleEnd, point: Vec3<T>) -> EndError {
        let gauge = self.gauges[end].get_or_insert_with(|| Gauge::new::<T>(exact));
        // The allowance of G3 for underflow is not part of an error in u times scale.
        let beyond = (gauge.deviation(point) - T::MIN_SUBNORMAL).max(0.0);
        let finite = |error: f64| error.min(f64::MAX);
        EndError {
            ulp: finite(gauge.deviation_in_ulps(point)),
            u_scale: if beyond > 0.0 {
                finite(finite(beyond) / self.scale / T::UNIT_ROUNDOFF)
            } else {
                0.0
            },
            outside: !self.oracle.contains(point),
        }
    }
}

/// Whether clipping an answer again must change nothing: true except for inward answers with an end
/// that is flagged as not inward.
fn promises_to_stay<T>(answer: &SegmentClip<T>, tier: SurveyTier) -> bool {
    let inward = |part: &Part<T>| part.entry.inward && part.exit.inward;
    !tier.is_inward() || answer.part.as_ref().is_some_and(inward)
}

fn is_finite<T: Real>(answer: &SegmentClip<T>) -> bool {
    let end = |end: &PartEnd<T>| end.t.is_finite() && end.point.is_finite();
    answer
        .part
        .as_ref()
        .is_none_or(|p| end(&p.entry) && end(&p.exit))
}

fn bits<T: Real>(point: Vec3<T>) -> [u64; 3] {
    point.to_f64().to_array().map(f64::to_bits)
}
