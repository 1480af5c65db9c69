//! `frusta samples`: the singular samples to look at, and to test other
//! programs with.

mod case;
mod choice;
mod export;
mod labels;
mod list;
mod map;
mod pictures;
mod sheet;
mod show;

use crate::failure::Failure;
use clap::{Args, Subcommand};
use std::process::ExitCode;

/// The 78 singular samples: a list, one in detail, a picture of all, files for other programs
///
/// A sample is a segment through a frustum's vertex, edge or face: 8 vertices, 12 edges and 6 faces,
/// each touched in one point, crossed into the interior, or containing the segment (a vertex: its
/// end). All numbers are short dyadic fractions, so each sample is exactly singular, and its answer
/// follows from how it was made: nothing is computed by clipping.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub(crate) struct SamplesArgs {
    #[command(subcommand)]
    command: SamplesCommand,
}

#[derive(Subcommand, Debug)]
enum SamplesCommand {
    List(list::ListArgs),
    Show(show::ShowArgs),
    Sheet(sheet::SheetArgs),
    Export(export::ExportArgs),
    Map(map::MapArgs),
}

/// Runs the command.
pub(crate) fn run(args: &SamplesArgs) -> Result<ExitCode, Failure> {
    let done = |()| ExitCode::SUCCESS;
    match &args.command {
        SamplesCommand::List(args) => list::run(args).map(done),
        SamplesCommand::Show(args) => show::run(args),
        SamplesCommand::Sheet(args) => sheet::run(args).map(done),
        SamplesCommand::Export(args) => export::run(args).map(done),
        SamplesCommand::Map(args) => map::run(args).map(done),
    }
}

const EXAMPLES: &str = "\
Examples
  frusta samples list
      names, classes and face sets of all 78
  frusta samples show edge-near-top/crossing
      one sample: its numbers, its exact answer and why, and what this program answers
  frusta samples show face-far/touching -o sample.png --theme dark
      the same as a picture
  frusta samples sheet -o samples.png
      all of them on one sheet
  frusta samples export samples
      inputs and exact answers as files, to test any other program
  frusta samples map edge -o map.png
      the answers of plain and exact arithmetic for inputs that differ by ulps

Exit codes:
  0  done
  1  show: the library's answer is not the exact one
  2  wrong usage, an unknown sample, or a file that cannot be written";
