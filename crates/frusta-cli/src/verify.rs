//! `frusta verify`: the families of hard cases through the exact clipper, each answer compared with
//! rational arithmetic.

use crate::failure::Failure;
use crate::report::{Kind, Progress};
use crate::terminal::print;
use clap::Args;
use frusta::oracle::ViolationKind;
use frusta::samples::Family;
use frusta_lab::{
    ExactClipper, FamilyRow, Options, VerifyTable, VolumeKind, VolumeRow, VolumeTally,
    verify_volumes, verify_watched,
};
use serde_json::{Value, json};
use std::process::ExitCode;

/// Check the exact clipper against rational arithmetic on families of hard cases
///
/// Each case is clipped with all three accuracies, also with its ends swapped, and inward parts are
/// clipped again. Class, face sets, ends and points must agree with rational arithmetic.
#[derive(Args, Debug)]
#[command(after_long_help = LEGEND)]
pub(crate) struct VerifyArgs {
    /// Cases of each family in f64, and as many in f32 where the family has it
    #[arg(long, value_name = "COUNT", default_value = "150000")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=MOST_CASES))]
    cases: u64,
    /// The seed of all cases
    #[arg(long, default_value = "1")]
    seed: u64,
    /// Only this family; may be given several times [default: all]
    #[arg(long, value_name = "NAME")]
    family: Vec<Family>,
    /// Threads [default: one a core]; the findings do not depend on it
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// Print flat rows as JSON
    #[arg(long)]
    json: bool,
    /// Verify boxes, oriented boxes and spheres instead of segments: COUNT of each kind in each family
    #[arg(long)]
    volumes: bool,
    /// List the families
    #[arg(long)]
    list: bool,
}

/// No sum over the families exceeds 64 bits.
const MOST_CASES: u64 = 1 << 48;

/// Runs the command.
pub(crate) fn run(args: &VerifyArgs) -> Result<ExitCode, Failure> {
    if args.list {
        return list().map(|()| ExitCode::SUCCESS);
    }
    let options = Options {
        families: if args.family.is_empty() {
            Family::ALL.to_vec()
        } else {
            args.family.clone()
        },
        cases: args.cases,
        seed: args.seed,
        threads: args.threads.map_or_else(crate::cores, usize::from),
        with_f32: true,
    };
    if args.volumes {
        return volumes(&options, args.json);
    }
    let progress = progress(options.total());
    let mut written = Ok(());
    let mut show = |text: String| {
        if !args.json && written.is_ok() {
            written = progress.suspend(|| print(&text));
        }
    };
    show(format!("{}\n", VerifyTable::heading()));
    let on_cases = |cases| progress.add(0, cases);
    let rows = verify_watched(&ExactClipper, &options, &on_cases, |row| {
        show(format!("{row}\n"))
    });
    show(VerifyTable(&rows).summary());
    written?;
    progress.finish();
    if args.json {
        let rows: Vec<Value> = rows.iter().map(|r| to_json(r, args.seed)).collect();
        print(&format!("{:#}\n", Value::from(rows)))?;
    }
    Ok(if rows.iter().all(FamilyRow::is_clean) {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(crate::WRONG)
    })
}

/// Progress through this many cases, which take about the same time each.
fn progress(cases: u64) -> Progress {
    Progress::new([Kind {
        units: cases,
        usual: 1.0,
    }])
}

/// Bounding volumes, one by one and in batches.
fn volumes(options: &Options, is_json: bool) -> Result<ExitCode, Failure> {
    let kinds = |&family: &Family| VolumeKind::of_family(family).count() as u64;
    let rows: u64 = options.families.iter().map(kinds).sum();
    let progress = progress(rows * options.cases);
    let show = |text: String| match is_json {
        true => Ok(()),
        false => progress.suspend(|| print(&text)),
    };
    show(format!("{}\n", VolumeRow::heading()))?;
    let mut sums = VolumeKind::ALL.map(|kind| (kind, VolumeTally::default()));
    let mut all = Vec::new();
    for &family in &options.families {
        let done = |cases| progress.add(0, cases);
        let rows = verify_volumes(family, options.cases, options.seed, options.threads, &done);
        for row in &rows {
            show(format!("{row}\n"))?;
            sums[row.kind as usize].1 += row.tally;
            all.push(volumes_to_json(row, options.seed));
        }
    }
    for (kind, tally) in &sums {
        show(format!("{:<18} {:<10} {tally}\n", "all", kind.name()))?;
    }
    progress.finish();
    if is_json {
        print(&format!("{:#}\n", Value::from(all)))?;
    }
    Ok(if sums.iter().all(|(_, tally)| tally.is_clean()) {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(crate::WRONG)
    })
}

fn list() -> Result<(), Failure> {
    let mut text = String::new();
    for family in Family::ALL {
        let types = if family.has_f32() { "f64 f32" } else { "f64" };
        text += &format!("{family:<18} {types:<7}  {}\n", family.describe());
    }
    print(&text)
}

/// A flat row.
fn to_json(row: &FamilyRow, seed: u64) -> Value {
    let mut object = json!({
        "family": row.family.name(),
        "scalar": row.scalar,
        "seed": seed,
        "cases": row.cases,
        "near": row.near,
        "filter_failures": row.filter_failures,
        "expansions": row.expansions,
        "integers": row.integers,
        "inward_ends": row.inward_ends,
        "not_inward_ends": row.not_inward,
        "room_ends": row.room_ends,
        "room_max_ulp": row.room_max,
        "room_mean_ulp": row.room_mean(),
        "witness_index": row.witness.as_ref().map(|w| w.index),
        "witness": row.witness.as_ref().map(ToString::to_string),
    });
    for kind in ViolationKind::ALL {
        object[format!("wrong_{}", kind.name().replace('-', "_"))] = json!(row.count(kind));
    }
    object
}

/// A flat row of volumes.
fn volumes_to_json(row: &VolumeRow, seed: u64) -> Value {
    let (tally, counts) = (&row.tally, &row.tally.counts);
    let [outside, crossing, inside] = tally.classes;
    json!({
        "family": row.family.name(),
        "kind": row.kind.name(),
        "seed": seed,
        "cases": tally.cases,
        "outside": outside,
        "crossing": crossing,
        "inside": inside,
        "wrong_class": tally.wrong,
        "wrongly_outside": tally.wrongly_outside,
        "wrong_in_batch": tally.wrong_in_batch,
        "wrong_exact": tally.wrong_exact,
        "false_accepts": counts.false_accepts,
        "filter_failures": counts.filter_failures,
        "expansions": counts.expansions,
        "integers": counts.integers,
    })
}

const LEGEND: &str = "\
Columns
  class sets   cases with a wrong class; with a wrong entry, exit or coplanar set
  ends         an end that was not clipped was changed, or a depth of a near or far hit
  points       a point or parameter beyond its accuracy's bound
  inward       an inward point is outside, or an inward point exists and was not found
  G5 G6        another answer for swapped ends; another part when an inward part is clipped again
  near%        cases with an end within 4 ulp of a face, or a line so close to an edge or vertex
  filt.%       cases that the floating-point filter did not settle
  exp.% int.%  cases that needed expansions; that needed big integers
  none%        inward ends without a representable point inside
  G7max mean   by how many ulps inward ends could still move outwards
The sum is followed by the first wrong case of each family, in hexadecimal.

With --volumes
  wrong        wrong classes; outside: those among them that are wrongly outside
  batch exact  wrong classes in a batch; wrong answers of the exact test
  out% in%     volumes that a face's plane rejects; that are inside
  false%       volumes that no face's plane rejects, but that are outside of the frustum
  filt.%       signs that the filter did not settle; exp.%, int.%: that expansions, integers settled

Examples
  frusta verify
      10.8 million cases, at least 150,000 a family
  frusta verify --family mixed-scale --seed 7 --json
  frusta verify --volumes --cases 150000

Exit codes:
  0  nothing is wrong
  1  something is wrong
  2  wrong usage, or the output could not be written";
