//! `frusta report`: error against run time, of every algorithm in every arithmetic on families of
//! hard cases; run times on everyday segments; and the table of the paper that describes the
//! method.
//!
//! ```text
//! plan      how much is measured, and measuring it
//! progress  the bar, and the time that is left
//! answer    the three sentences that sum it up
//! text      the standard output; all tables
//! data      report.json and its keys
//! files     the folder: report.json, CSV files, tables, witnesses, pages
//! machine   what it was measured on
//! omitted   what was not measured
//! page/     report.html and the panels
//! ```

mod answer;
mod data;
mod files;
mod machine;
mod omitted;
mod page;
mod plan;
mod progress;
mod text;

pub(crate) use progress::{Kind, Progress};

use crate::failure::{Failure, shorten};
use crate::terminal::print;
use clap::Args;
use data::Report;
use files::Folder;
use frusta::samples::Family;
use frusta_lab::{Everyday, PaperTable, Survey, VolumeSurvey};
use machine::Machine;
use omitted::{Omission, omissions};
use plan::Plan;
use serde_json::Value;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Measure error against run time, for every algorithm and arithmetic
///
/// Families of singular, stiff and extreme cases go through every algorithm in plain and exact
/// arithmetic, in f64 and f32; each answer is compared with rational arithmetic. Then all of them
/// are timed, in turns; some also on everyday segments, one segment a call and over slices. The
/// run times on the 78 singular samples stand beside those of the paper that describes projection
/// reduction (V/W).
///
/// The answer in three sentences and the paper's table are printed; a page with charts, all tables
/// and the data are written to a folder. The short run takes less than a minute on two cores.
#[derive(Args, Debug)]
#[command(after_long_help = NOTES)]
pub(crate) struct ReportArgs {
    /// More cases and rounds: minutes to hours instead of seconds
    #[arg(long)]
    full: bool,
    /// The folder for report.html, report.json, tables, CSV files, worst inputs and panels
    /// [default: frusta-report; with --json: none]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write no folder
    #[arg(long, conflicts_with = "out")]
    no_out: bool,
    /// Print all tables
    #[arg(long, short)]
    verbose: bool,
    /// Print report.json instead of the text
    #[arg(long, conflicts_with = "verbose")]
    json: bool,
    /// Only these families, separated by commas; frusta verify --list has their names
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    families: Vec<Family>,
    /// Cases of each family in each scalar type [default: 256, full: 60000]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u64).range(1..=MOST_CASES))]
    cases: Option<u64>,
    /// The seed of all cases
    #[arg(long, default_value = "1")]
    seed: u64,
    /// Rounds in which each clipper is timed once a family and mix [default: 5, full: 61]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    rounds: Option<u32>,
    /// How often each of the 78 samples is clipped for the paper's table
    /// [default: 1000, full: 100000]
    #[arg(long, value_name = "COUNT")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    repeat: Option<u32>,
    /// Everyday segments of each mix; if they are few, branch predictors learn the order
    /// [default: 65536, full: 131072]
    #[arg(long, value_name = "COUNT")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    everyday: Option<u32>,
    /// Threads that find the errors [default: one a core]; the findings do not depend on it
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// Results of the benchmark of other libraries, to be shown on the page: docs/report.md
    #[arg(long, value_name = "FILE")]
    peers: Option<PathBuf>,
}

impl ReportArgs {
    /// The folder that is written, if any.
    fn folder(&self) -> Option<&Path> {
        let default = (!self.json && !self.no_out).then_some(Path::new(FOLDER));
        self.out.as_deref().or(default)
    }
}

/// The folder that is written by default.
const FOLDER: &str = "frusta-report";

/// Enough for any patience, and no count leaves its type.
const MOST_CASES: u64 = 1 << 32;

/// The longest file of peers that is read, in bytes.
const LONGEST: u64 = 1 << 26;

/// The schema of the file that the benchmark of other libraries writes.
const PEERS: &str = "frusta-peers/1";

/// What was measured.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// Error against time.
    pub(crate) survey: Survey,
    /// Times on everyday segments.
    pub(crate) everyday: Everyday,
    /// Boxes, spheres and batches.
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

/// Everything that a report consists of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Page<'a> {
    /// What was measured.
    pub(crate) measured: &'a Measured,
    /// What it was measured on.
    pub(crate) machine: &'a Machine,
    /// Other libraries' results.
    pub(crate) peers: Option<&'a Value>,
    /// The command line for the same counts.
    pub(crate) command: &'a str,
    /// How long it took to measure.
    pub(crate) seconds: f64,
    /// What was not measured.
    pub(crate) omitted: &'a [Omission],
}

/// Runs the command.
pub(crate) fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    // Files that cannot be read or written are reported before minutes have passed.
    let peers = args.peers.as_deref().map(read_peers).transpose()?;
    let plan = Plan::new(args);
    let out = args.folder();
    let begin = |folder| Folder::begin(folder, &plan.survey.families);
    let folder = out.map(begin).transpose()?;
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
        let tables = match args.verbose {
            true => format!("\n{}", text::tables(&measured)),
            false => String::new(),
        };
        text::short(&page) + &tables + &text::closing(&page, out)
    })?;
    Ok(if measured.exact_is_right() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(crate::WRONG)
    })
}

fn read_peers(file: &Path) -> Result<Value, Failure> {
    let mut text = Vec::new();
    let read = File::open(file).and_then(|f| f.take(LONGEST + 1).read_to_end(&mut text));
    read.map_err(|e| Failure::in_file(file, e))?;
    if text.len() as u64 > LONGEST {
        let why = format!("it is longer than {LONGEST} bytes, so it cannot be results of peers");
        return Err(Failure::in_file(file, why));
    }
    let peers: Value = serde_json::from_slice(&text)
        .map_err(|e| Failure::in_file(file, format_args!("not JSON: {}", shorten(e))))?;
    // A file without a table must not pass for one that is shown.
    let schema = peers.get("schema").and_then(Value::as_str);
    if schema != Some(PEERS) || !page::shows(&peers) {
        let why = format!("no results of peers: it must be of schema {PEERS} and have rows");
        return Err(Failure::in_file(file, why));
    }
    Ok(peers)
}

const NOTES: &str = "\
Algorithms: vw (V/W), liang-barsky-tuned, liang-barsky-textbook, cyrus-beck, cohen-sutherland,
  six-planes
Tiers: plain-f32, plain-f64, exact-fast, exact-nearest, exact-inward, and these three with -f32
Ratios: 1.23±4% is a median over the rounds, whose farther quartile is 4 % off. Ratios that are more
  than 25 % off are noisy: they are marked ~ and are not used in the answer

Examples
  frusta report
      in less than a minute: the answer, and the page frusta-report/report.html
  frusta report --full --out report
  frusta report --families shear,thin --cases 100000 --json

Exit codes:
  0  every answer of the exact arithmetic is right
  1  one is wrong
  2  wrong usage, or an output could not be written";
