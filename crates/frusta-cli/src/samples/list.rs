//! `frusta samples list`: a table of the samples.

use super::case::{Case, sets};
use super::choice::Choice;
use super::labels;
use crate::failure::Failure;
use crate::io::number::short;
use crate::terminal::print;
use clap::Args;
use frusta::FaceSet;
use frusta::samples::Placement;
use serde_json::Value;

/// A table of the samples: names, labels and exact answers
#[derive(Args, Debug)]
#[command(after_long_help = LEGEND)]
pub(super) struct ListArgs {
    #[command(flatten)]
    choice: Choice,
    /// All there is about each, as a JSON array on the standard output
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub(super) fn run(args: &ListArgs) -> Result<(), Failure> {
    let (solid, placement) = (&args.choice.solid, Placement::IDENTITY);
    let cases = args.choice.samples().into_iter();
    let cases: Vec<Case> = cases
        .map(|sample| Case::new(sample, &placement))
        .collect::<Result<_, _>>()?;
    if args.json {
        let frustum = placement.place(solid).map_err(Failure::new)?;
        let row = |case: &Case| case.to_json(solid, "identity", &frustum);
        let rows: Vec<Value> = cases.iter().map(row).collect();
        return print(&format!("{:#}\n", Value::from(rows)));
    }
    print(&table(&cases))
}

const COLUMNS: [&str; 9] = [
    "name",
    "points",
    "direction",
    "class",
    "t0",
    "t1",
    "enter",
    "leave",
    "coplanar",
];

/// Columns as wide as their contents.
fn table(cases: &[Case]) -> String {
    let heading = COLUMNS.map(str::to_owned);
    let rows: Vec<_> = [heading].into_iter().chain(cases.iter().map(row)).collect();
    let width = |k: usize| rows.iter().map(|row| row[k].len()).max().unwrap_or(0);
    let widths: [usize; 9] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let padded = row.iter().zip(widths).map(|(c, w)| format!("{c:<w$}"));
        let line = padded.collect::<Vec<_>>().join("  ");
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

fn row(case: &Case) -> [String; 9] {
    let part = case.expected.part.as_ref();
    let parameter = |t: Option<f64>| t.map_or_else(|| "-".to_owned(), short);
    let set = |set: FaceSet| {
        if set.is_empty() {
            "-".to_owned()
        } else {
            set.to_string()
        }
    };
    let [enter, leave, coplanar] = sets(part).map(set);
    [
        case.sample.name(),
        labels::intersections(&case.sample).to_owned(),
        labels::direction(&case.sample).to_owned(),
        case.expected.class.to_string(),
        parameter(part.map(|p| p.entry.t)),
        parameter(part.map(|p| p.exit.t)),
        enter,
        leave,
        coplanar,
    ]
}

const LEGEND: &str = "\
Columns
  name       the feature and how the segment lies to it: touching (one common point), crossing
             (through it into the interior), contained (in it; a vertex: from it inwards), apart (a
             near miss)
  points direction  the labels of the paper that the 78 groups are from: the number of points in
             which the segment meets the surface; left-right if it is no steeper than 1 in the plane of the
             frame's x and z, else up-down. The third label, the position, is in the name.
  class      outside, touch, boundary, inside or cross
  t0 t1      the parameters of the part in the frustum, exactly
  enter leave coplanar  the faces whose planes contain the entry point, the exit point, the whole
             segment

A solid with two proper ends has 26 features and 78 samples; a pyramid 18 and 54, an infinite
frustum 17 and 51.

Examples
  frusta samples list --near-misses
  frusta samples list --solid pyramid --json

Exit codes:
  0  done
  2  wrong usage, or the output could not be written";
