//! The command `frusta`: one file a subcommand.

mod clip;
mod engine;
mod failure;
mod frustum_file;
mod input;
mod number;
mod output;
mod pipeline;
mod stats;
mod view;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Clipping and culling against view frusta, exactly.
#[derive(Parser)]
#[command(version, max_term_width = 100, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Clip(clip::ClipArgs),
}

/// Part of every help text.
pub(crate) const EXIT_CODES: &str = "\
Exit codes:
  0  done
  2  wrong usage, or a file that cannot be read, makes no sense or cannot be written; one line on
     the error stream names the file, the place in it and the reason, and no output file is left";

/// The exit code of a failure; `clap` uses the same for wrong usage.
const FAILED: u8 = 2;

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Clip(args) => clip::run(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("frusta: {failure}");
            ExitCode::from(FAILED)
        }
    }
}
