//! Error against run time: every algorithm in every arithmetic tier on every
//! family, compared with the oracle.
//!
//! For each case and each clipper: its answer is compared with rational arithmetic,
//! with the answer for the swapped ends, and with what clipping it again gives.
//! Blocks of cases that share a frustum are dealt to the threads; counts, errors and
//! witnesses do not depend on the number of threads. Then, with the threads at rest,
//! the clippers of a family take turns at being timed.
//!
//! ```text
//! clipper  one of them alone
//! entrant  the clippers, all called the same way
//! judge    a case: the truth, and the errors of the answers
//! tally    a row's counts
//! timing   a family's times
//! row      the findings
//! table    the same as text
//! ```

mod clipper;
mod entrant;
mod judge;
mod row;
mod table;
mod tally;
mod timing;

pub use clipper::SurveyClipper;
pub use row::{
    Survey, SurveyAlgorithm, SurveyError, SurveyRow, SurveyTier, SurveyWitness, SurveyWorst,
    UnknownName,
};
pub use table::SurveyTable;

use super::CaseLine;
use super::turns::{Timing, Turns};
use super::work::{OnWork, Work};
use entrant::{Entrant, Scalar};
use frusta::frustum::Frustum;
use frusta::oracle::Oracle;
use frusta::samples::{BLOCK, Family, Scene};
use judge::Case;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use tally::Tally;

/// What to survey, and how much of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyOptions {
    /// The families, in order.
    pub families: Vec<Family>,
    /// How many cases of each, in each scalar type.
    pub cases: u64,
    /// The seed of all cases.
    pub seed: u64,
    /// In how many rounds times are taken; without rounds, all times are 0.
    pub rounds: u32,
    /// How many cases of a family are clipped in a round by each clipper.
    pub timed: u32,
    /// How many threads find the errors; 0 counts as 1. One thread takes the times.
    pub threads: usize,
}

impl Default for SurveyOptions {
    /// 1,000 cases of every family, 5 rounds of 512, one thread.
    fn default() -> Self {
        Self {
            families: Family::ALL.to_vec(),
            cases: 1_000,
            seed: 1,
            rounds: 5,
            timed: 512,
            threads: 1,
        }
    }
}

impl SurveyOptions {
    /// How much work a survey is. A case counts once in each scalar type.
    pub fn work(&self) -> [(Work, u64); 2] {
        let types = |family: &Family| 1 + u64::from(family.has_f32());
        let cases = self.families.iter().map(types).sum::<u64>() * self.cases;
        let rounds = self.families.len() * Turns::rounds(self.rounds as usize);
        [(Work::Cases, cases), (Work::CaseRounds, rounds as u64)]
    }
}

/// Surveys the families; `on_work` is called with all of [`SurveyOptions::work`], part by part.
///
/// ```
/// use frusta_lab::{SurveyAlgorithm, SurveyOptions, SurveyTier, survey};
/// use frusta::samples::Family;
/// let families = vec![Family::HalfLattice];
/// let options = SurveyOptions { families, cases: 128, rounds: 1, ..SurveyOptions::default() };
/// let survey = survey(&options, &|_, _| {});
/// assert!(survey.exact_is_right());
/// let row = survey
///     .row(SurveyAlgorithm::SixPlanes, SurveyTier::PlainF64, Family::HalfLattice)
///     .unwrap();
/// assert!(row.wrong_class > 0);
/// ```
pub fn survey(options: &SurveyOptions, on_work: OnWork<'_>) -> Survey {
    survey_of(&Entrant::all(), options, on_work)
}

fn survey_of(entrants: &[Entrant], options: &SurveyOptions, on_work: OnWork<'_>) -> Survey {
    let mut survey = Survey {
        seed: options.seed,
        cases: options.cases,
        rounds: options.rounds,
        rows: Vec::new(),
        witnesses: Vec::new(),
    };
    for &family in &options.families {
        let here = |e: &&Entrant| family.has_f32() || !e.tier.is_single();
        let entrants: Vec<&Entrant> = entrants.iter().filter(here).collect();
        let tallies = Answers {
            entrants: &entrants,
            family,
            options,
            on_work,
        }
        .count();
        let on_round = || on_work(Work::CaseRounds, 1);
        let times = timing::measure(&entrants, family, options, on_round);
        for ((entrant, tally), time) in entrants.iter().zip(tallies).zip(times) {
            let witnesses = witnesses(entrant, family, options.seed, &tally);
            survey.witnesses.extend(witnesses);
            survey.rows.push(row(entrant, family, &tally, time));
        }
    }
    survey
}

/// A family's cases through its clippers.
struct Answers<'a> {
    entrants: &'a [&'a Entrant],
    family: Family,
    options: &'a SurveyOptions,
    on_work: OnWork<'a>,
}

impl Answers<'_> {
    fn count(&self) -> Vec<Tally> {
        let cases = self.options.cases;
        let new = || vec![Tally::new(cases); self.entrants.len()];
        let next = AtomicU64::new(0);
        let total = Mutex::new(new());
        let work = || {
            let mut tallies = new();
            loop {
                let block = next.fetch_add(1, Ordering::Relaxed);
                if block >= cases.div_ceil(BLOCK) {
                    break;
                }
                self.block(block, &mut tallies);
            }
            // A thread that panicked added nothing, so the total is whole.
            let mut total = total.lock().unwrap_or_else(|e| e.into_inner());
            let both = total.iter_mut().zip(tallies);
            both.for_each(|(total, tally)| total.merge(tally));
        };
        std::thread::scope(|scope| {
            for _ in 1..self.options.threads.max(1) {
                scope.spawn(work);
            }
            work();
        });
        total.into_inner().unwrap_or_else(|e| e.into_inner())
    }

    fn block(&self, block: u64, tallies: &mut [Tally]) {
        let scene = self.family.scene(self.options.seed, block);
        let frustum = scene.frustum();
        let oracle = Oracle::new(scene.frustum());
        let cases = block * BLOCK..((block + 1) * BLOCK).min(self.options.cases);
        for number in cases.clone() {
            self.case::<f64>(number, &scene, frustum, &oracle, tallies);
            if self.family.has_f32() {
                self.case::<f32>(number, &scene, frustum, &oracle, tallies);
            }
        }
        let types = 1 + u64::from(self.family.has_f32());
        (self.on_work)(Work::Cases, types * (cases.end - cases.start));
    }

    fn case<T: Scalar>(
        &self,
        number: u64,
        scene: &Scene,
        frustum: &Frustum,
        oracle: &Oracle,
        tallies: &mut [Tally],
    ) {
        let segment = self.family.segment::<T>(scene, self.options.seed, number);
        // A family's cases are finite, so there always is a truth.
        let Ok(mut case) = Case::new(number, segment, frustum, oracle) else {
            return;
        };
        for (entrant, tally) in self.entrants.iter().zip(tallies) {
            if let Some(clipper) = T::of(&entrant.clipper) {
                case.judge(clipper, entrant.tier, tally);
            }
        }
    }
}

fn row(entrant: &Entrant, family: Family, tally: &Tally, time: Timing) -> SurveyRow {
    SurveyRow {
        algorithm: entrant.algorithm,
        tier: entrant.tier,
        family,
        cases: tally.cases,
        wrong_class: tally.wrong_class.count,
        wrong_faces: tally.wrong_faces.count,
        refused: tally.refused.count,
        ns_median: time.nanoseconds,
        time_ratio: time.ratio,
        error_ulp: tally.ulp.summary(),
        error_u_scale: tally.u_scale.summary(),
        outside: tally.outside,
        asymmetric: tally.asymmetric,
        non_idempotent: tally.non_idempotent,
        filter_failures: tally.filter_failures,
        exact_stage: tally.exact_stage,
    }
}

fn witnesses<'a>(
    entrant: &'a Entrant,
    family: Family,
    seed: u64,
    tally: &'a Tally,
) -> impl Iterator<Item = SurveyWitness> + 'a {
    SurveyWorst::ALL.into_iter().filter_map(move |worst| {
        let (case, value) = tally.worst(worst)?;
        let scene = family.scene(seed, case / BLOCK);
        let line = if entrant.tier.is_single() {
            let segment = family.segment::<f32>(&scene, seed, case);
            CaseLine::new(scene.frustum(), &segment)
        } else {
            let segment = family.segment::<f64>(&scene, seed, case);
            CaseLine::new(scene.frustum(), &segment)
        };
        Some(SurveyWitness {
            algorithm: entrant.algorithm,
            tier: entrant.tier,
            family,
            worst,
            value,
            case,
            line: line.to_string(),
        })
    })
}

#[cfg(test)]
mod tests;
