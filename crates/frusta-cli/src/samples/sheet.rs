//! `frusta samples sheet`: all samples on one sheet.

use super::case::Case;
use super::choice::Choice;
use super::pictures;
use crate::draw::{Theme, save};
use crate::failure::Failure;
use crate::terminal::print;
use clap::Args;
use frusta::samples::Placement;
use std::path::PathBuf;

/// A picture of all samples: each feature touched, crossed and containing the segment
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct SheetArgs {
    /// The picture: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    choice: Choice,
    /// The picture's colours
    #[arg(long, default_value = "light")]
    theme: Theme,
}

/// Runs the command.
pub(super) fn run(args: &SheetArgs) -> Result<(), Failure> {
    let (solid, placement) = (&args.choice.solid, Placement::IDENTITY);
    let cases = args.choice.samples().into_iter();
    let cases: Vec<Case> = cases
        .map(|sample| Case::new(sample, &placement))
        .collect::<Result<_, _>>()?;
    let sheet = pictures::sheet(solid, &cases, args.theme.palette());
    save(&args.output, &sheet)?;
    print(&format!(
        "{} samples in {}\n",
        cases.len(),
        args.output.display()
    ))
}

const EXAMPLES: &str = "\
A cell is a sample: the frustum from outside, with the feature highlighted, and the segment; beside
it the trapezoids TV (x over z) and TW (y over z) with the segment's projections. All cells have one
scale, except near misses; a segment that leaves its picture goes on. A row has two features.

Examples
  frusta samples sheet -o samples.png
  frusta samples sheet -o pyramid.svg --solid pyramid --near-misses --theme dark

Exit codes:
  0  done
  2  wrong usage, or the picture could not be written";
