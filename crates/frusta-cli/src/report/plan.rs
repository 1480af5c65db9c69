//! How much is measured, and measuring it.

use super::progress::{Kind, Progress};
use super::{Measured, ReportArgs};
use frusta::samples::Family;
use frusta_lab::{
    SurveyOptions, VolumePlan, Work, everyday, everyday_rounds, paper_rounds, paper_table, survey,
    volumes,
};

/// Cases of a family for each of its hard volumes.
const CASES_A_VOLUME: u64 = 16;

/// Everyday boxes, of each size and view, for each case of a family.
const BOXES_A_CASE: u64 = 8;

/// What is measured; every count has its value.
pub(crate) struct Plan {
    pub(crate) survey: SurveyOptions,
    volumes: VolumePlan,
    repeats: u32,
    /// Everyday segments of each mix.
    segments: u32,
}

impl Plan {
    /// The counts that are given, and the defaults of the short or the full run for the others.
    pub(crate) fn new(args: &ReportArgs) -> Self {
        let [cases, rounds, repeats, segments] = if args.full {
            [60_000, 61, 100_000, 131_072]
        } else {
            [256, 5, 1_000, 65_536]
        };
        let survey = SurveyOptions {
            families: if args.families.is_empty() {
                Family::ALL.to_vec()
            } else {
                distinct(&args.families)
            },
            cases: args.cases.unwrap_or(u64::from(cases)),
            seed: args.seed,
            rounds: args.rounds.unwrap_or(rounds),
            threads: args.threads.map_or_else(crate::cores, usize::from),
            ..SurveyOptions::default()
        };
        let segments = args.everyday.unwrap_or(segments);
        Self {
            volumes: VolumePlan {
                families: survey.families.clone(),
                cases: survey.cases.div_ceil(CASES_A_VOLUME),
                seed: survey.seed,
                threads: survey.threads,
                boxes: BOXES_A_CASE * survey.cases,
                timed: segments as usize,
                rounds: survey.rounds,
            },
            survey,
            repeats: args.repeat.unwrap_or(repeats),
            segments,
        }
    }

    /// The command line for the same counts.
    pub(crate) fn command(&self) -> String {
        let SurveyOptions {
            families,
            cases,
            seed,
            rounds,
            ..
        } = &self.survey;
        let Self {
            repeats, segments, ..
        } = self;
        let mut command = format!(
            "frusta report --cases {cases} --seed {seed} --rounds {rounds} --repeat {repeats} \
             --everyday {segments}"
        );
        if families.len() < Family::ALL.len() {
            let names: Vec<&str> = families.iter().map(|f| f.name()).collect();
            command += &format!(" --families {}", names.join(","));
        }
        command
    }

    /// Measures everything, with a progress bar.
    pub(crate) fn measure(&self) -> Measured {
        let SurveyOptions { rounds, .. } = self.survey;
        let progress = Progress::new(Work::ALL.map(|work| self.kind(work)));
        let on_work = |work: Work, units| progress.add(work as usize, units);
        let measured = Measured {
            survey: survey(&self.survey, &on_work),
            everyday: everyday(self.segments as usize, rounds, || {
                on_work(Work::EverydayRounds, 1);
            }),
            volumes: volumes(&self.volumes, &on_work),
            paper: paper_table(self.repeats, || on_work(Work::PaperRounds, 1)),
        };
        progress.finish();
        measured
    }

    /// How much there is of a kind of work, and the usual times, measured on one machine.
    fn kind(&self, work: Work) -> Kind {
        let (cases, volumes) = (self.survey.work(), self.volumes.work());
        let both = cases.iter().chain(&volumes);
        let units = match work {
            Work::EverydayRounds => everyday_rounds(self.survey.rounds),
            Work::PaperRounds => paper_rounds(self.repeats),
            _ => both.filter(|(own, _)| *own == work).map(|(_, n)| n).sum(),
        };
        let threads = self.survey.threads.max(1) as f64;
        let usual = match work {
            Work::Cases => 1e-3 / threads,
            Work::CaseRounds => 20e-3,
            Work::EverydayRounds => 300e-9 * f64::from(self.segments),
            Work::Volumes => 250e-6 / threads,
            Work::Boxes => 1e-6,
            Work::VolumeRounds => 100e-9 * f64::from(self.segments),
            Work::PaperRounds => 60e-3,
        };
        Kind { units, usual }
    }
}

/// In the order of tables, each once.
fn distinct(families: &[Family]) -> Vec<Family> {
    let all = Family::ALL.iter().copied();
    all.filter(|family| families.contains(family)).collect()
}
