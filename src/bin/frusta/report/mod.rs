//! `frusta report`: every algorithm on the singular samples, time beside error.

mod machine;
mod omitted;

use crate::failure::Failure;
use crate::terminal::{print, progress_bar};
use clap::Args;
use frusta::math::hex::Hex;
use frusta::report::{PaperFailure, PaperRow, PaperTable, paper_rounds, paper_table};
use serde_json::{Value, json};
use std::process::ExitCode;

/// Time every algorithm on the 78 singular samples, and check its answers
///
/// Each is measured in plain and in exact arithmetic, in f64 and f32, and compared with rational
/// arithmetic. The run times stand beside those of the paper that projection reduction is from.
#[derive(Args, Debug)]
#[command(after_long_help = EXIT_CODES)]
pub(crate) struct ReportArgs {
    /// How often each sample is clipped for each time
    #[arg(long, value_name = "COUNT", default_value = "100000")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    repeat: u32,
    /// Flat rows as JSON on the standard output: one an algorithm, one a failing sample
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub(crate) fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    let bar = progress_bar(paper_rounds(args.repeat));
    let table = paper_table(args.repeat, || bar.inc(1));
    bar.finish_and_clear();
    print(&if args.json {
        format!("{:#}\n", to_json(&table))
    } else {
        table.to_string()
    })?;
    Ok(if table.exact_is_right() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(crate::WRONG)
    })
}

fn to_json(table: &PaperTable) -> Value {
    let clippers = table.rows.iter().map(|row| clipper(table, row));
    let failures = table.rows.iter().flat_map(|row| {
        let failure = |found| failure(row, found);
        row.failures.iter().map(failure)
    });
    clippers.chain(failures).collect()
}

/// A row with nothing nested in it.
fn clipper(table: &PaperTable, row: &PaperRow) -> Value {
    let mut object = json!({
        "row": "clipper",
        "algorithm": row.algorithm,
        "tier": row.tier.name(),
        "scalar": row.scalar,
        "repeats": table.repeats,
        "rounds": table.rounds,
        "paper_ratio": row.paper,
        "ratio_in_order": row.in_order.ratio,
        "ratio_shuffled": row.shuffled.ratio,
        "ns_in_order": row.in_order.nanoseconds,
        "ns_shuffled": row.shuffled.nanoseconds,
        "steady": row.steady,
    });
    let places = ["standard", "stretched", "turned", "rotated"];
    for (place, score) in places.into_iter().zip(row.scores()) {
        for (name, value) in [
            ("samples", json!(score.samples)),
            ("right_classes", json!(score.right_classes)),
            ("right_sets", json!(score.right_sets)),
            ("max_error_roundoffs", json!(score.max_error)),
            ("max_error_ulp", json!(score.max_error_ulps)),
        ] {
            object[format!("{place}_{name}")] = value;
        }
    }
    object
}

fn failure(row: &PaperRow, failure: &PaperFailure) -> Value {
    json!({
        "row": "failure",
        "algorithm": row.algorithm,
        "tier": row.tier.name(),
        "scalar": row.scalar,
        "sample": failure.sample,
        "count": failure.count,
        "segment": Hex(failure.segment).to_string(),
        "said": failure.said.to_string(),
        "true": failure.truth.to_string(),
    })
}

const EXIT_CODES: &str = "\
Exit codes:
  0  every answer of the exact arithmetic is right
  1  one is wrong
  2  wrong usage, or the output could not be written";
