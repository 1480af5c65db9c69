//! `frusta-peers [--quick] [--seed N] [--cases N] [--out FILE]`: all libraries do the same jobs; prints a
//! table, and writes a file for `frusta report --peers FILE`.

use clap::Parser;
use frusta_peers::contest::{self, Effort};
use frusta_peers::file::{Report, Row};
use frusta_peers::{facts, table};
use indicatif::{ProgressBar, ProgressStyle};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Other libraries' clipping and culling beside frusta's, on the same input.
#[derive(Parser)]
#[command(version)]
struct Args {
    /// Few cases and rounds: a trial run.
    #[arg(long)]
    quick: bool,
    /// The seed of random input.
    #[arg(long, default_value_t = Effort::FULL.seed)]
    seed: u64,
    /// Cases that are timed. Branch predictors learn some of fewer than 262,144 by heart; small
    /// caches do not hold as many.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4_000_000))]
    cases: Option<u32>,
    /// The file to write.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// One job only, such as cull-box; all of its inputs.
    #[arg(long, value_name = "NAME")]
    job: Option<String>,
    /// Runs one hostile input; for this program's own use.
    #[arg(long, hide = true)]
    fact: Option<usize>,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        // A closed pipe is no failure.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("frusta-peers: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> io::Result<()> {
    let mut out = io::stdout();
    if let Some(number) = args.fact {
        let answer = facts::answer(number);
        let answer = answer.ok_or_else(|| io::Error::other("no such input"))?;
        return writeln!(out, "{answer}");
    }
    let usual = if args.quick {
        Effort::QUICK
    } else {
        Effort::FULL
    };
    let effort = Effort {
        seed: args.seed,
        timed: args.cases.map_or(usual.timed, |cases| cases as usize),
        ..usual
    };
    let failed = |path: &Path, e| io::Error::other(format!("{}: {e}", path.display()));
    if let Some(path) = &args.out {
        // A file that cannot be written fails now, not after minutes.
        let opened = File::options().append(true).create(true).open(path);
        opened.map_err(|e| failed(path, e))?;
    }
    writeln!(out, "{}", table::heading())?;
    let rows = contests(&effort, args.job.as_deref(), &mut out)?;
    let facts = facts::ask(&std::env::current_exe()?);
    let report = Report::new(&effort, rows, facts);
    conclude(&report, &mut out)?;
    if let Some(path) = &args.out {
        let text = serde_json::to_string_pretty(&report)?;
        std::fs::write(path, text + "\n").map_err(|e| failed(path, e))?;
    }
    match report.rows.iter().map(Row::broken_promises).sum() {
        0_u64 => Ok(()),
        n => Err(io::Error::other(format!("{n} wrong answers of frusta"))),
    }
}

/// Runs all contests, or those of one job, and prints their rows as they come.
fn contests(effort: &Effort, job: Option<&str>, out: &mut impl Write) -> io::Result<Vec<Row>> {
    let mut all = contest::all();
    if let Some(job) = job {
        let jobs: Vec<_> = all.iter().map(|c| c.job()).collect();
        if !jobs.contains(&job) {
            let known = jobs.join(", ");
            return Err(io::Error::other(format!("no job {job}; one of {known}")));
        }
        all.retain(|contest| contest.job() == job);
    }
    let steps = all.iter().map(|c| c.steps(effort)).sum();
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3} % {eta:>4} left {msg}");
    let bar = ProgressBar::new(steps).with_style(style.map_err(io::Error::other)?);
    let mut rows = Vec::new();
    for contest in &all {
        bar.set_message(format!("{}: {}", contest.job(), contest.input()));
        let outcomes = contest.run(effort, &|n| bar.inc(n));
        let mut own: Vec<Row> = outcomes.iter().map(|o| Row::new(&**contest, o)).collect();
        if contest.is_without_ours() {
            own.push(Row::not_built(&**contest));
        }
        bar.suspend(|| {
            writeln!(out, "{}", table::title(&own[0]))?;
            own.iter()
                .try_for_each(|row| writeln!(out, "{}", table::line(row)))
        })?;
        rows.extend(own);
    }
    bar.finish_and_clear();
    Ok(rows)
}

fn conclude(report: &Report, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "\ninputs that end badly")?;
    for fact in &report.facts {
        writeln!(out, "{}", table::fact(fact))?;
    }
    let title = "times as multiples of ours (segments: exact-class V/W's), over the mixes";
    writeln!(out, "\n{title:<86} {:>5} {:>5}", "mean", "least")?;
    for headline in &report.headlines {
        writeln!(out, "{}", table::headline(headline))?;
    }
    writeln!(out, "\n{}", report.bias)
}
