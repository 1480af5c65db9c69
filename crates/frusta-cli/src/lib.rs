//! The command `frusta` as a library: [`main`] runs it, and [`io`] reads files.
//!
//! ```text
//! clip/ samples/ replay/ report/ verify shell/     a subcommand each
//! io/         readers and writers of files
//! draw/       pictures
//! view        frusta from flags, or around a part of a scene
//! failure     errors, each in one line; terminal: the standard streams
//! ```

mod clip;
mod draw;
mod failure;
pub mod io;
mod replay;
mod report;
mod samples;
mod shell;
mod terminal;
mod verify;
mod view;

pub use failure::Failure;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Clipping and culling against view frusta, exactly.
#[derive(Parser)]
#[command(name = "frusta", version, max_term_width = 100, after_help = format!("{EXIT_CODES}\n\n{START}"))]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Clip(Box<clip::ClipArgs>),
    Report(report::ReportArgs),
    Replay(replay::ReplayArgs),
    Samples(samples::SamplesArgs),
    Verify(verify::VerifyArgs),
    Completions(shell::CompletionsArgs),
    Man(shell::ManArgs),
}

/// Part of most help texts.
pub(crate) const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  report, replay, verify, samples show: an exact answer is wrong
  2  wrong usage, or a file that cannot be read, is malformed or cannot be written; one line on
     the error stream names the file, the place in it and the reason, and no output file is left
  130  interrupted; no unfinished output file is left";

/// What to try first.
const START: &str = "Start with: frusta clip FILE, frusta samples list, frusta clip --help";

/// The exit code of a failure; `clap` uses the same for wrong usage.
const FAILED: u8 = 2;

/// The exit code of `report`, `replay`, `verify` and `samples show` if an exact answer is wrong.
const WRONG: u8 = 1;

/// Number of threads that the machine runs at once.
pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Runs the command line and returns its exit code.
#[must_use]
pub fn main() -> ExitCode {
    io::atomic_file::watch_for_interruption();
    let result = match Cli::parse().command {
        Command::Clip(args) => clip::run(&args).map(|()| ExitCode::SUCCESS),
        Command::Report(args) => report::run(&args),
        Command::Replay(args) => replay::run(&args),
        Command::Samples(args) => samples::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Completions(args) => shell::completions(&args).map(|()| ExitCode::SUCCESS),
        Command::Man(args) => shell::man(&args).map(|()| ExitCode::SUCCESS),
    };
    match result {
        Ok(code) => code,
        Err(failure) => {
            terminal::print_error(&format!("frusta: {failure}\n"));
            ExitCode::from(FAILED)
        }
    }
}
