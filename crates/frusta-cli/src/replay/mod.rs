//! `frusta replay`: one case through every algorithm in every tier, beside the truth.
//!
//! ```text
//! lines      where cases come from
//! answers    all answers, each compared with the truth
//! decimal    exact numbers in decimal
//! text       the output for people; json: for programs
//! picture/   pictures
//! ```

mod answers;
mod decimal;
mod json;
mod lines;
mod picture;
mod text;

use crate::draw::Theme;
use crate::failure::Failure;
use crate::terminal::print;
use answers::Replay;
use clap::Args;
use lines::Numbered;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Run witnesses through every algorithm in every tier, beside the exact answer
///
/// A witness is a frustum and a segment in a line of text, as `frusta report` and `frusta verify`
/// print them. One is shown in full; of many, each has a line.
#[derive(Args, Debug)]
#[command(after_long_help = LEGEND)]
pub(crate) struct ReplayArgs {
    /// A line in quotes, a file of lines, the witnesses of a report.json, or - for the standard input
    #[arg(required = true, value_name = "LINE|FILE|-")]
    input: Vec<String>,
    /// Only the case of this number, of many
    #[arg(long, value_name = "NUMBER")]
    only: Option<usize>,
    /// Draw the case: .svg or .png
    #[arg(short, long, value_name = "FILE", conflicts_with = "out")]
    output: Option<PathBuf>,
    /// Draw every case into a new or empty folder, as 1.svg, 2.svg, ...
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// The pictures' colours
    #[arg(long, default_value = "light")]
    theme: Theme,
    /// All there is as JSON on the standard output: a list of cases
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub(crate) fn run(args: &ReplayArgs) -> Result<ExitCode, Failure> {
    let mut cases = lines::read(&args.input)?;
    if let Some(only) = args.only {
        let count = cases.len();
        cases.retain(|case| case.number == only);
        if cases.is_empty() {
            let why = format_args!("--only {only}: there are {count} cases, numbered from 1");
            return Err(Failure::new(why));
        }
    }
    let alone = cases.len() == 1;
    if let (Some(file), false) = (&args.output, alone) {
        let why = "a picture is of one case; choose it with --only, or draw all with --out FOLDER";
        return Err(Failure::in_file(file, why));
    }
    if let Some(folder) = &args.out {
        make(folder)?;
    }
    let (mut wrong, mut begun) = (false, false);
    for Numbered {
        number,
        title,
        case,
    } in cases
    {
        let replay = Replay::new(case).map_err(Failure::new)?;
        wrong |= replay.exact_is_wrong();
        let numbered = args.out.as_ref().map(|f| f.join(format!("{number}.svg")));
        if let Some(file) = args.output.as_ref().or(numbered.as_ref()) {
            let svg = picture::picture(&replay, &title, args.theme.palette(), true);
            crate::draw::save(file, &svg)?;
        }
        if args.json {
            // A case at a time: many are more than a memory holds.
            let before = if begun { ",\n" } else { "[\n" };
            print(&format!(
                "{before}{:#}",
                json::case(number, &title, &replay)
            ))?;
            begun = true;
        } else if alone {
            print(&text::text(&replay))?;
        } else {
            print(&text::summary(number, &title, &replay))?;
        }
    }
    if args.json {
        print("\n]\n")?;
    }
    Ok(if wrong {
        ExitCode::from(crate::WRONG)
    } else {
        ExitCode::SUCCESS
    })
}

/// Makes the folder, or sees that nothing is in it.
fn make(folder: &Path) -> Result<(), Failure> {
    let fail = |e: std::io::Error| Failure::in_file(folder, e);
    std::fs::create_dir_all(folder).map_err(fail)?;
    match std::fs::read_dir(folder).map_err(fail)?.next() {
        Some(_) => Err(Failure::in_file(folder, "the folder is not empty")),
        None => Ok(()),
    }
}

/// The picture of a case by its line, such as a report has it; without that line.
pub(crate) fn drawn(line: &str, title: &str, theme: Theme) -> Result<String, Failure> {
    let replay = Replay::new(
        line.parse()
            .map_err(|e: frusta_lab::CaseLineError| Failure::new(e))?,
    )
    .map_err(Failure::new)?;
    Ok(picture::picture(&replay, title, theme.palette(), false))
}

const LEGEND: &str = "\
Lines
  f64 near Z L R B T far Z L R B T segment X Y Z X Y Z
  f64 near Z L R B T slopes L R B T PlusZ segment X Y Z X Y Z
  f64 near ... far ... origin X Y Z axes X Y Z X Y Z X Y Z segment ...
  The first word is the segment's type, f64 or f32; Z L R B T are the depth, left, right, bottom and
  top of an end; PlusZ or MinusZ is where a frustum without a far end goes. Numbers are hexadecimal
  (0x1.8p-3), which hide no bit, or decimal. In a file, # begins a comment.

Examples
  frusta replay \"f64 near 1 -1 1 -1 1 far 3 -3 3 -3 3 segment 3 1 2 1 3 2\"
  frusta replay report/report.json --only 3 -o third.svg

Exit codes:
  0  every answer of the exact arithmetic is right
  1  one is wrong
  2  wrong usage, a malformed line, or a file that cannot be read or written";
