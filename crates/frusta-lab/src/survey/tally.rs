//! The counts of one row, and how the counts of threads are merged.
//!
//! Nothing here depends on the order of the cases: sums, first cases by number,
//! largest errors of which equals go to the first case, and a quantile that is
//! taken of the largest errors alone, which are kept.

use super::row::{SurveyError, SurveyWorst};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// One end of this many may be further off than [`SurveyError::p999`].
const QUANTILE: u64 = 1000;

/// The counts of a row.
#[derive(Clone, Debug)]
pub(super) struct Tally {
    pub(super) cases: u64,
    pub(super) refused: Counted,
    pub(super) wrong_class: Counted,
    pub(super) wrong_faces: Counted,
    pub(super) outside: u64,
    pub(super) asymmetric: u64,
    pub(super) non_idempotent: u64,
    pub(super) filter_failures: u64,
    pub(super) exact_stage: u64,
    pub(super) ulp: Errors,
    pub(super) u_scale: Errors,
}

impl Tally {
    /// No cases yet, with room for the quantile of this many.
    pub(super) fn new(cases: u64) -> Self {
        Self {
            cases: 0,
            refused: Counted::default(),
            wrong_class: Counted::default(),
            wrong_faces: Counted::default(),
            outside: 0,
            asymmetric: 0,
            non_idempotent: 0,
            filter_failures: 0,
            exact_stage: 0,
            ulp: Errors::new(cases),
            u_scale: Errors::new(cases),
        }
    }

    /// Adds what another thread has counted.
    pub(super) fn merge(&mut self, other: Self) {
        self.cases += other.cases;
        self.refused.merge(other.refused);
        self.wrong_class.merge(other.wrong_class);
        self.wrong_faces.merge(other.wrong_faces);
        self.outside += other.outside;
        self.asymmetric += other.asymmetric;
        self.non_idempotent += other.non_idempotent;
        self.filter_failures += other.filter_failures;
        self.exact_stage += other.exact_stage;
        self.ulp.merge(other.ulp);
        self.u_scale.merge(other.u_scale);
    }

    /// The worst case in a way, and its value.
    pub(super) fn worst(&self, way: SurveyWorst) -> Option<(u64, f64)> {
        match way {
            SurveyWorst::Refused => self.refused.worst(),
            SurveyWorst::Class => self.wrong_class.worst(),
            SurveyWorst::Faces => self.wrong_faces.worst(),
            SurveyWorst::ErrorUlp => self.ulp.worst,
            SurveyWorst::ErrorScale => self.u_scale.worst,
        }
    }
}

/// How many cases, and the first.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counted {
    pub(super) count: u64,
    first: Option<u64>,
}

impl Counted {
    pub(super) fn add(&mut self, case: u64) {
        self.merge(Self {
            count: 1,
            first: Some(case),
        });
    }

    fn merge(&mut self, other: Self) {
        self.count += other.count;
        self.first = match (self.first, other.first) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
    }

    fn worst(&self) -> Option<(u64, f64)> {
        Some((self.first?, self.count as f64))
    }
}

/// Errors of ends: not negative, finite.
#[derive(Clone, Debug)]
pub(super) struct Errors {
    ends: u64,
    /// How many are kept: as many as the quantile can need, for two ends a case.
    room: usize,
    /// The largest, the least of them first; as bits, whose order is the same.
    largest: BinaryHeap<Reverse<u64>>,
    /// The case of the largest, and how large.
    worst: Option<(u64, f64)>,
}

impl Errors {
    fn new(cases: u64) -> Self {
        Self {
            ends: 0,
            room: 1 + (2 * cases / QUANTILE) as usize,
            largest: BinaryHeap::new(),
            worst: None,
        }
    }

    pub(super) fn add(&mut self, case: u64, error: f64) {
        self.ends += 1;
        self.keep(error.to_bits());
        if error > 0.0 {
            self.beat((case, error));
        }
    }

    fn keep(&mut self, bits: u64) {
        if self.largest.len() < self.room {
            self.largest.push(Reverse(bits));
        } else if let Some(mut least) = self.largest.peek_mut()
            && least.0 < bits
        {
            *least = Reverse(bits);
        }
    }

    fn beat(&mut self, new: (u64, f64)) {
        let better = |old: (u64, f64)| new.1 > old.1 || (new.1 == old.1 && new.0 < old.0);
        if self.worst.is_none_or(better) {
            self.worst = Some(new);
        }
    }

    fn merge(&mut self, other: Self) {
        self.ends += other.ends;
        other
            .largest
            .into_iter()
            .for_each(|Reverse(b)| self.keep(b));
        if let Some(worst) = other.worst {
            self.beat(worst);
        }
    }

    pub(super) fn summary(&self) -> SurveyError {
        let sorted = self.largest.clone().into_sorted_vec();
        // Sorted by the reversed order: the largest comes first.
        let at = |i: u64| {
            let found = sorted.get(i as usize);
            found.map_or(0.0, |Reverse(bits)| f64::from_bits(*bits))
        };
        SurveyError {
            max: at(0),
            p999: at(self.ends / QUANTILE),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::samples::Random;

    #[test]
    fn the_quantile_is_that_of_all_errors() {
        let mut random = Random::new(&[1]);
        for ends in [0, 1, 7, 999, 1000, 1001, 3000, 4000] {
            let errors: Vec<f64> = (0..ends).map(|_| random.between(0.0, 9.0)).collect();
            // In two halves, as by two threads.
            let [mut whole, mut half] = [Errors::new(2000), Errors::new(2000)];
            for (case, &error) in errors.iter().enumerate() {
                let part = if case % 3 == 0 { &mut half } else { &mut whole };
                part.add(case as u64, error);
            }
            whole.merge(half);
            let mut sorted = errors.clone();
            sorted.sort_by(f64::total_cmp);
            let rank = (0.999 * ends as f64).ceil() as usize;
            let expected = rank.checked_sub(1).map_or(0.0, |i| sorted[i]);
            let summary = whole.summary();
            assert_eq!(summary.p999, expected, "{ends}");
            assert_eq!(summary.max, sorted.last().copied().unwrap_or(0.0));
            let worst = whole.worst.map_or(0.0, |(case, error)| {
                assert_eq!(errors[case as usize], error);
                error
            });
            assert_eq!(worst, summary.max);
        }
    }

    #[test]
    fn equals_go_to_the_first_case() {
        let mut errors = Errors::new(10);
        for (case, error) in [(7, 2.0), (3, 2.0), (5, 2.0), (1, 0.0)] {
            errors.add(case, error);
        }
        assert_eq!(errors.worst, Some((3, 2.0)));
        let mut counted = Counted::default();
        [8, 4, 6].into_iter().for_each(|case| counted.add(case));
        assert_eq!(counted.worst(), Some((4, 3.0)));
    }
}
