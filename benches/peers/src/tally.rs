//! Wrong answers, counted.
//!
//! The right answer is exactly that of the closed set, touching included. An answer is wrong if it
//! is a hit where there is nothing (*phantom*), nothing where there is a hit (*missed*), refused or
//! not finite, or has an end in a wrong place (*misplaced*): returned unchanged although it is
//! outside, or farther off than any rounding explains. An end that is *outside* by rounding, as
//! most clipped ends of all libraries are, is counted separately and is not wrong.

use crate::boxes::{GridBox, Truth};
use crate::peer::{Case, Contestant};
use crate::quads::{FoundQuad, Quad};
use crate::scene::Block;
use crate::segments::{Found, FoundEnd};
use frusta::oracle::{Gauge, Oracle, OraclePart};
use frusta::{Frustum, Real, Segment, Vec3};
use rayon::prelude::*;

/// How far off an end must be to be in a wrong place rather than rounded, in the segment's largest
/// coordinate. Any peer's rounding errors on these inputs are below half of it; errors of
/// decision are of the size of the set.
pub const FAR_OFF: f64 = 1.0 / 1024.0;

/// Counts over cases.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// The number of cases.
    pub cases: u64,
    /// Hits where there is nothing.
    pub phantom: u64,
    /// Misses where there is a hit.
    pub missed: u64,
    /// Hits, rightly, with an end that is not in the set.
    pub outside: u64,
    /// Hits, rightly, with an end returned unchanged although it is outside, or off by more than
    /// [`FAR_OFF`].
    pub misplaced: u64,
    /// Errors and numbers that are not finite.
    pub refused: u64,
    /// The largest error of an end, in unit roundoffs of the segment's largest coordinate, where
    /// the answer is not wrong; 0 where no error is defined.
    pub max_error: f64,
}

impl Tally {
    /// Wrong answers of any kind.
    pub fn wrong(&self) -> u64 {
        self.phantom + self.missed + self.misplaced + self.refused
    }

    fn add(&mut self, other: &Self) {
        self.cases += other.cases;
        self.phantom += other.phantom;
        self.missed += other.missed;
        self.outside += other.outside;
        self.misplaced += other.misplaced;
        self.refused += other.refused;
        self.max_error = self.max_error.max(other.max_error);
    }

    /// One case whose answer is only whether it is a hit.
    fn of_seen(seen: Option<bool>, truth: bool) -> Self {
        Self {
            cases: 1,
            phantom: u64::from(seen == Some(true) && !truth),
            missed: u64::from(seen == Some(false) && truth),
            refused: u64::from(seen.is_none()),
            ..Self::default()
        }
    }
}

/// Decides cases of one kind exactly.
pub trait Judge<C: Case>: Sync {
    /// The truth about one case.
    type Truth;

    /// The truth, exactly.
    fn truth(&self, case: &C) -> Self::Truth;

    /// The tally of one answer.
    fn judge(&self, case: &C, truth: &mut Self::Truth, answer: &C::Answer) -> Tally;
}

/// Asks everybody about all cases, on all cores; a tally for each in the order of `enter`.
pub fn count<'a, C: Case, J: Judge<C>>(
    judge: &J,
    cases: &[C],
    enter: impl Fn() -> Vec<Box<dyn Contestant<C> + 'a>> + Sync,
    done: impl Fn(usize) + Sync,
) -> Vec<Tally> {
    let none = || vec![Tally::default(); enter().len()];
    let some = |cases: &[C]| {
        let mut tallies = none();
        let mut contestants = enter();
        let answers: Vec<_> = contestants.iter_mut().map(|c| c.ask_all(cases)).collect();
        for (i, case) in cases.iter().enumerate() {
            let mut truth = judge.truth(case);
            for (answers, tally) in answers.iter().zip(&mut tallies) {
                tally.add(&judge.judge(case, &mut truth, &answers[i]));
            }
        }
        done(cases.len());
        tallies
    };
    cases
        .par_chunks(2048)
        .map(some)
        .reduce(none, |mut all, some| {
            for (tally, more) in all.iter_mut().zip(&some) {
                tally.add(more);
            }
            all
        })
}

/// Judges segments by frusta's oracle.
pub struct SegmentJudge(Oracle);

/// The truth about a segment. Many answers are the same to the bit: what an end of one is worth
/// is found out once.
pub struct SegmentTruth<T> {
    part: Option<OraclePart>,
    known: Vec<(Vec3<T>, EndWorth)>,
    gauges: [Option<Gauge>; 2],
}

/// What an end that was computed is worth.
#[derive(Clone, Copy)]
struct EndWorth {
    inside: bool,
    /// In unit roundoffs of the segment's largest coordinate.
    error: f64,
}

impl SegmentJudge {
    /// For one frustum.
    pub fn new(frustum: &Frustum) -> Self {
        Self(Oracle::new(frustum))
    }

    /// Of the start or the end of a hit.
    fn worth<T: Real>(
        &self,
        segment: &Segment<T>,
        truth: &mut SegmentTruth<T>,
        which: usize,
        end: &FoundEnd<T>,
    ) -> EndWorth {
        let exact = truth.part.as_ref().map(|p| [&p.entry, &p.exit][which]);
        let Some(exact) = exact else {
            return EndWorth::OWN;
        };
        if end.kept {
            let inside = !exact.clipped;
            return EndWorth {
                inside,
                ..EndWorth::OWN
            };
        }
        let found = truth.known.iter().find(|(point, _)| *point == end.point);
        let mut worth = match found {
            Some((_, worth)) => *worth,
            None => {
                let gauge = truth.gauges[which].get_or_insert_with(|| Gauge::new::<T>(exact));
                let worth = EndWorth {
                    inside: self.0.contains(end.point),
                    error: in_roundoffs(segment, gauge.deviation(end.point)),
                };
                truth.known.push((end.point, worth));
                worth
            }
        };
        worth.inside = end.inside.unwrap_or(worth.inside);
        worth
    }
}

impl EndWorth {
    /// The segment's own end, inside.
    const OWN: Self = Self {
        inside: true,
        error: 0.0,
    };
}

impl<T: Real> Judge<Segment<T>> for SegmentJudge {
    type Truth = SegmentTruth<T>;

    fn truth(&self, segment: &Segment<T>) -> SegmentTruth<T> {
        SegmentTruth {
            part: self.0.clip(segment).ok().and_then(|clip| clip.part),
            known: Vec::new(),
            gauges: [None; 2],
        }
    }

    fn judge(&self, segment: &Segment<T>, truth: &mut SegmentTruth<T>, answer: &Found<T>) -> Tally {
        let (Found::Part(ends), true) = (answer, truth.part.is_some()) else {
            let seen = match answer {
                Found::Nothing => Some(false),
                Found::Part(_) => Some(true),
                Found::Refused => None,
            };
            return Tally::of_seen(seen, truth.part.is_some());
        };
        let worth = [0, 1].map(|which| self.worth(segment, truth, which, &ends[which]));
        let is_kept = |which: usize| ends[which].kept && !worth[which].inside;
        let max_error = worth[0].error.max(worth[1].error);
        let is_far_off = max_error * T::UNIT_ROUNDOFF > FAR_OFF;
        let misplaced = is_kept(0) || is_kept(1) || is_far_off;
        Tally {
            cases: 1,
            misplaced: u64::from(misplaced),
            outside: u64::from(!worth[0].inside || !worth[1].inside),
            max_error: if misplaced { 0.0 } else { max_error },
            ..Tally::default()
        }
    }
}

/// A distance in unit roundoffs of the segment's largest coordinate.
fn in_roundoffs<T: Real>(segment: &Segment<T>, distance: f64) -> f64 {
    let ends = [segment.start, segment.end].map(|p| p.to_f64().to_array());
    let scale = ends
        .as_flattened()
        .iter()
        .fold(0.0, |s: f64, c| s.max(c.abs()));
    if distance == 0.0 {
        return 0.0;
    }
    distance / (T::UNIT_ROUNDOFF * scale)
}

impl Judge<GridBox> for Truth {
    type Truth = Option<bool>;

    fn truth(&self, case: &GridBox) -> Option<bool> {
        self.meets(case)
    }

    fn judge(&self, _: &GridBox, truth: &mut Option<bool>, answer: &Option<bool>) -> Tally {
        match truth {
            Some(meets) => Tally::of_seen(*answer, *meets),
            None => Tally::default(),
        }
    }
}

impl Judge<Quad> for Block {
    type Truth = Option<Quad>;

    fn truth(&self, quad: &Quad) -> Option<Quad> {
        quad.within(self)
    }

    fn judge(&self, _: &Quad, truth: &mut Option<Quad>, answer: &FoundQuad) -> Tally {
        let FoundQuad::Bounds(found) = answer else {
            let seen = (*answer != FoundQuad::Refused).then_some(false);
            return Tally::of_seen(seen, truth.is_some());
        };
        let mut tally = Tally::of_seen(Some(true), truth.is_some());
        let beyond = |k: usize| found.min[k] < self.min[k] || found.max[k] > self.max[k];
        tally.outside = u64::from(truth.is_some() && (0..3).any(beyond));
        tally
    }
}
