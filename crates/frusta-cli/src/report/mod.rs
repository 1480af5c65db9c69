//! `frusta report`: error against run time, of every algorithm in every arithmetic
//! on families of hard cases; run times on everyday segments; and the table of the
//! paper that the method is from.
//!
//! ```text
//! data     what was measured, as it stands in report.json; its keys
//! files    the folder: report.json, CSV files, witnesses, pages
//! machine  what it was measured on
//! omitted  what it lacks
//! page/    report.html and the panels
//! ```

mod data;
mod files;
mod machine;
mod omitted;
mod page;

use crate::failure::{Failure, shorten};
use crate::terminal::{print, progress_bar};
use clap::Args;
use data::Report;
use files::Folder;
use frusta::samples::Family;
use frusta_lab::{
    Everyday, PaperTable, Survey, SurveyOptions, SurveyTable, VolumePlan, VolumeSurvey, everyday,
    everyday_rounds, paper_rounds, paper_table, survey, volumes,
};
use machine::Machine;
use omitted::{Omission, omissions};
use serde_json::Value;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Measure error against run time, for every algorithm and arithmetic
///
/// Families of singular, stiff and extreme cases go through every algorithm in plain, fused and
/// exact arithmetic, in f64 and f32; each answer is held against rational arithmetic. Then all are
/// timed, in turns; some also on everyday segments, one a call and over slices. The run times on
/// the 78 singular samples stand beside those of the paper that projection reduction is from.
#[derive(Args, Debug)]
#[command(after_long_help = NOTES)]
pub(crate) struct ReportArgs {
    /// Fewer cases and rounds: seconds instead of minutes
    #[arg(long)]
    quick: bool,
    /// Write report.json, CSV files, witnesses, panels and report.html to this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Only these families, with commas between; frusta verify --list has their names
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    families: Vec<Family>,
    /// Cases of each family in each scalar type [default: 60000, quick: 256]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u64).range(1..=MOST_CASES))]
    cases: Option<u64>,
    /// Which cases
    #[arg(long, default_value = "1")]
    seed: u64,
    /// Rounds in which each clipper is timed once a family and mix [default: 61, quick: 3]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    rounds: Option<u32>,
    /// How often each of the 78 samples is clipped for the paper's table
    /// [default: 100000, quick: 1000]
    #[arg(long, value_name = "COUNT")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    repeat: Option<u32>,
    /// Everyday segments of each mix; of few, branch predictors learn the order
    /// [default: 131072, quick: 65536]
    #[arg(long, value_name = "COUNT")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    everyday: Option<u32>,
    /// Threads that find the errors [default: one a core]; what they find does not depend on it
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// What the benchmark of other libraries found, to be shown beside: docs/report.md
    #[arg(long, value_name = "FILE")]
    peers: Option<PathBuf>,
    /// report.json on the standard output instead of tables
    #[arg(long)]
    json: bool,
}

/// Enough for any patience, and no count leaves its type.
const MOST_CASES: u64 = 1 << 32;

/// The longest file of peers that is read, in bytes.
const LONGEST: u64 = 1 << 26;

/// What the benchmark of other libraries writes.
const PEERS: &str = "frusta-peers/1";

/// How many steps of the survey's a round of the paper's table weighs in the progress
/// bar.
const PAPER_ROUND: u64 = 150;

/// How many hard volumes weigh as much as one step of the survey's.
const VOLUMES_A_STEP: u64 = 4;

/// How many everyday segments weigh as much as one step of the survey's.
const EVERYDAY_STEP: u64 = 256;

/// Cases of a family for each of its hard volumes, and what of them is tried at most.
const CASES_A_VOLUME: u64 = 16;

/// What is measured, without what is left to default.
struct Plan {
    survey: SurveyOptions,
    volumes: VolumePlan,
    repeats: u32,
    /// Everyday segments of each mix.
    segments: u32,
}

/// What was measured.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// Error against time.
    pub(crate) survey: Survey,
    /// Times on everyday segments.
    pub(crate) everyday: Everyday,
    /// Boxes, balls and batches.
    pub(crate) volumes: VolumeSurvey,
    /// The paper's table.
    pub(crate) paper: PaperTable,
}

impl Measured {
    /// Whether every answer of the exact arithmetic is right.
    fn exact_is_right(&self) -> bool {
        self.survey.exact_is_right()
            && self.everyday.exact_is_right()
            && self.volumes.is_right()
            && self.paper.exact_is_right()
    }
}

impl Plan {
    fn new(args: &ReportArgs) -> Self {
        let [cases, rounds, repeats, segments] = if args.quick {
            [256, 3, 1_000, 65_536]
        } else {
            [60_000, 61, 100_000, 131_072]
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
        Self {
            volumes: VolumePlan {
                families: survey.families.clone(),
                cases: survey.cases.div_ceil(CASES_A_VOLUME),
                seed: survey.seed,
                threads: survey.threads,
                boxes: 8 * survey.cases,
                timed: args.everyday.unwrap_or(segments) as usize,
                rounds: survey.rounds,
            },
            survey,
            repeats: args.repeat.unwrap_or(repeats),
            segments: args.everyday.unwrap_or(segments),
        }
    }

    /// What to type for the same counts again.
    fn command(&self) -> String {
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

    fn measure(&self) -> Measured {
        let SurveyOptions { rounds, .. } = self.survey;
        let everyday_round = u64::from(self.segments).div_ceil(EVERYDAY_STEP);
        let bar = progress_bar(
            self.survey.steps()
                + everyday_round * everyday_rounds(rounds)
                + self.volumes.steps() / VOLUMES_A_STEP
                + PAPER_ROUND * paper_rounds(self.repeats),
        );
        let measured = Measured {
            survey: survey(&self.survey, &|steps| bar.inc(steps)),
            everyday: everyday(self.segments as usize, rounds, || bar.inc(everyday_round)),
            volumes: volumes(&self.volumes, &|steps| bar.inc(steps / VOLUMES_A_STEP)),
            paper: paper_table(self.repeats, || bar.inc(PAPER_ROUND)),
        };
        bar.finish_and_clear();
        measured
    }
}

/// In the order of tables, each once.
fn distinct(families: &[Family]) -> Vec<Family> {
    let all = Family::ALL.iter().copied();
    all.filter(|family| families.contains(family)).collect()
}

/// Everything that a report says.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Page<'a> {
    /// What was measured.
    pub(crate) measured: &'a Measured,
    /// What it was measured on.
    pub(crate) machine: &'a Machine,
    /// Other libraries' results.
    pub(crate) peers: Option<&'a Value>,
    /// What to type for the same counts again.
    pub(crate) command: &'a str,
    /// How long it took to measure.
    pub(crate) seconds: f64,
    /// What is not there.
    pub(crate) omitted: &'a [Omission],
}

/// Runs the command.
pub(crate) fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    // What can fail does so before minutes have passed.
    let peers = args.peers.as_deref().map(read_peers).transpose()?;
    let plan = Plan::new(args);
    let begin = |folder| Folder::begin(folder, &plan.survey.families);
    let folder = args.out.as_deref().map(begin).transpose()?;
    let start = Instant::now();
    let measured = plan.measure();
    let page = Page {
        measured: &measured,
        machine: &Machine::this(),
        peers: peers.as_ref(),
        command: &plan.command(),
        seconds: start.elapsed().as_secs_f64(),
        omitted: &omissions(&measured.survey, peers.is_some()),
    };
    let report = Report::new(&page);
    if let Some(folder) = folder {
        folder.finish(&page, &report)?;
    }
    print(&if args.json {
        report.to_json()
    } else {
        tables(&page, args.out.as_deref())
    })?;
    Ok(if measured.exact_is_right() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(crate::WRONG)
    })
}

fn tables(page: &Page<'_>, out: Option<&Path>) -> String {
    let Machine {
        cpu,
        cores,
        os,
        arch,
        rustc,
        simd,
        ..
    } = page.machine;
    let Measured {
        survey,
        everyday,
        volumes,
        paper,
    } = page.measured;
    let mut text = format!("{}\n{everyday}\n{volumes}\n{paper}", SurveyTable(survey));
    text += &format!("\n{cpu}, {cores} cores, {os} {arch}, {simd}; Rust {rustc}");
    text += &format!("\n{:.0} s; to repeat:\n{}\n", page.seconds, page.command);
    if let Some(out) = out {
        text += &format!("written to {}\n", out.display());
    }
    text
}

fn read_peers(file: &Path) -> Result<Value, Failure> {
    let mut text = Vec::new();
    let read = File::open(file).and_then(|f| f.take(LONGEST + 1).read_to_end(&mut text));
    read.map_err(|e| Failure::in_file(file, e))?;
    if text.len() as u64 > LONGEST {
        let why = format!("it is longer than {LONGEST} bytes; are these results of peers?");
        return Err(Failure::in_file(file, why));
    }
    let peers: Value = serde_json::from_slice(&text)
        .map_err(|e| Failure::in_file(file, format_args!("not JSON: {}", shorten(e))))?;
    // What has no table must not pass for one that was shown.
    let schema = peers.get("schema").and_then(Value::as_str);
    if schema != Some(PEERS) || !page::shows(&peers) {
        let why = format!("no results of peers: it must be of schema {PEERS} and have rows");
        return Err(Failure::in_file(file, why));
    }
    Ok(peers)
}

const NOTES: &str = "\
Algorithms: vw, liang-barsky-tuned, liang-barsky-textbook, cyrus-beck, cohen-sutherland, six-planes
Tiers: plain-f32, plain-f64, exact-fast, exact-nearest,
  exact-inward, and these three with -f32

Examples
  frusta report --quick --out report
      all of it in seconds, to look at: report/report.html
  frusta report --families shear,thin --cases 100000 --json

Exit codes:
  0  every answer of the exact arithmetic is right
  1  one is wrong
  2  wrong usage, or an output could not be written";
