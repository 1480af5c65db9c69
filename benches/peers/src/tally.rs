//! Wrong answers, counted.
//!
//! Right is what the closed set says exactly, touching included. An answer is wrong if it sees
//! something where there is nothing (*phantom*), nothing where there is something (*missed*), is
//! refused or not finite, or gives an end back as it was although it is outside (*kept*). An
//! end that is *outside* by rounding, as most clipped ends of everybody are, is counted beside
//! and is not wrong.

use crate::boxes::{GridBox, Truth};
use crate::peer::{Case, Contestant};
use crate::quads::{FoundQuad, Quad};
use crate::scene::Block;
use crate::segments::{Found, FoundEnd};
use frusta::oracle::{Gauge, Oracle, OracleClip, OracleEnd};
use frusta::{Frustum, Real, Segment, Vec3};
use rayon::prelude::*;

/// Counts over cases.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many were asked.
    pub cases: u64,
    /// Something is seen where there is nothing.
    pub phantom: u64,
    /// Nothing is seen where there is something.
    pub missed: u64,
    /// Hits, rightly, with an end that is not in the set.
    pub outside: u64,
    /// Hits, rightly, with an end given back as it was although it is outside.
    pub kept: u64,
    /// Errors and numbers that are not finite.
    pub refused: u64,
    /// The largest error of an end, in unit roundoffs of the segment's largest coordinate, where
    /// the answer is not wrong; 0 where no error is defined.
    pub max_error: f64,
}

impl Tally {
    /// Wrong answers of any kind.
    pub fn wrong(&self) -> u64 {
        self.phantom + self.missed + self.kept + self.refused
    }

    fn add(&mut self, other: &Self) {
        self.cases += other.cases;
        self.phantom += other.phantom;
        self.missed += other.missed;
        self.outside += other.outside;
        self.kept += other.kept;
        self.refused += other.refused;
        self.max_error = self.max_error.max(other.max_error);
    }

    /// One case of which only `seen` is to be compared with the truth.
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

/// Knows the truth about cases of one kind.
pub trait Judge<C: Case>: Sync {
    /// The truth about one case.
    type Truth;

    /// Finds it out, exactly.
    fn truth(&self, case: &C) -> Self::Truth;

    /// The tally of one answer.
    fn judge(&self, case: &C, truth: &Self::Truth, answer: &C::Answer) -> Tally;
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
        for case in cases {
            let truth = judge.truth(case);
            for (contestant, tally) in contestants.iter_mut().zip(&mut tallies) {
                tally.add(&judge.judge(case, &truth, &contestant.ask(case)));
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

impl SegmentJudge {
    /// For one frustum.
    pub fn new(frustum: &Frustum) -> Self {
        Self(Oracle::new(frustum))
    }

    fn is_inside<T: Real>(&self, end: &FoundEnd<T>, exact: &OracleEnd) -> bool {
        match end.inside {
            _ if end.kept => !exact.clipped,
            Some(inside) => inside,
            None => self.0.contains(end.point),
        }
    }
}

/// The truth about a segment; nothing about one that is not finite.
pub struct SegmentTruth(Option<OracleClip>);

impl<T: Real> Judge<Segment<T>> for SegmentJudge {
    type Truth = SegmentTruth;

    fn truth(&self, segment: &Segment<T>) -> SegmentTruth {
        SegmentTruth(self.0.clip(segment).ok())
    }

    fn judge(&self, segment: &Segment<T>, truth: &SegmentTruth, answer: &Found<T>) -> Tally {
        let exact = truth.0.as_ref().and_then(|clip| clip.part.as_ref());
        let (Found::Part(ends), Some(exact)) = (answer, exact) else {
            let seen = match answer {
                Found::Nothing => Some(false),
                Found::Part(_) => Some(true),
                Found::Refused => None,
            };
            return Tally::of_seen(seen, exact.is_some());
        };
        let pairs = [(&ends[0], &exact.entry), (&ends[1], &exact.exit)];
        let kept = pairs.iter().any(|(end, exact)| end.kept && exact.clipped);
        let outside = pairs.iter().any(|(end, exact)| !self.is_inside(end, exact));
        let errors = pairs.map(|(end, exact)| error(segment, end, exact));
        Tally {
            cases: 1,
            kept: u64::from(kept),
            outside: u64::from(outside),
            max_error: if kept { 0.0 } else { errors[0].max(errors[1]) },
            ..Tally::default()
        }
    }
}

/// How far off an end is, in unit roundoffs of the segment's largest coordinate.
fn error<T: Real>(segment: &Segment<T>, end: &FoundEnd<T>, exact: &OracleEnd) -> f64 {
    if end.kept {
        return 0.0;
    }
    let size = |p: Vec3<T>| p.to_f64().to_array().map(f64::abs).into_iter();
    let scale = size(segment.start)
        .chain(size(segment.end))
        .fold(0.0, f64::max);
    let deviation = Gauge::new::<T>(exact).deviation(end.point);
    if deviation == 0.0 {
        return 0.0;
    }
    deviation / (T::UNIT_ROUNDOFF * scale)
}

impl Judge<GridBox> for Truth {
    type Truth = Option<bool>;

    fn truth(&self, case: &GridBox) -> Option<bool> {
        self.meets(case)
    }

    fn judge(&self, _: &GridBox, truth: &Option<bool>, answer: &Option<bool>) -> Tally {
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

    fn judge(&self, _: &Quad, truth: &Option<Quad>, answer: &FoundQuad) -> Tally {
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
