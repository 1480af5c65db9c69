//! Where cases come from: a line on the command line, a file or a pipe of lines, the
//! witnesses of a `report.json`.

use crate::failure::{Failure, quote, shorten};
use crate::io::{Lines, MARK};
use frusta_lab::{CaseLine, CaseLineError};
use serde::Deserialize;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

/// Number of cases that a run accepts.
const MOST: usize = 100_000;

/// A case with its number and title.
pub(super) struct Numbered {
    /// Its number among all cases, from 1.
    pub(super) number: usize,
    /// Its title in the file, or empty.
    pub(super) title: String,
    pub(super) case: CaseLine,
}

/// Reads all cases.
pub(super) fn read(inputs: &[String]) -> Result<Vec<Numbered>, Failure> {
    let mut cases = Cases(Vec::new());
    for input in inputs {
        if is_line(input) {
            let argument = Path::new("the line");
            let line = input.parse().map_err(|e: CaseLineError| {
                Failure::at(argument, format_args!("column {}", e.column()), e.reason())
            })?;
            cases.add(argument, line, String::new())?;
        } else if input == "-" {
            cases.add_all(Path::new("standard input"), io::stdin().lock())?;
        } else {
            let path = Path::new(input);
            let file = File::open(path).map_err(|e| unopened(input, &e))?;
            cases.add_all(path, BufReader::new(file))?;
        }
    }
    if cases.0.is_empty() {
        return Err(Failure::new("the input has no line"));
    }
    Ok(cases.0)
}

/// Whether an argument is a line and no file's name: it has its first two words.
fn is_line(argument: &str) -> bool {
    let mut words = argument.split_whitespace();
    matches!(words.next(), Some("f32" | "f64")) && words.next().is_some()
}

/// Why an argument is not a file; it may be meant as a line.
fn unopened(argument: &str, why: &io::Error) -> Failure {
    if argument.trim().contains(char::is_whitespace) || argument.is_empty() {
        let why = "is not a file, and a line begins with f64 or f32";
        Failure::new(format_args!("{} {why}", quote(argument)))
    } else {
        Failure::in_file(Path::new(&shorten(argument)), why)
    }
}

struct Cases(Vec<Numbered>);

impl Cases {
    fn add(&mut self, file: &Path, case: CaseLine, title: String) -> Result<(), Failure> {
        let number = self.0.len() + 1;
        if number > MOST {
            let why = format_args!("there are more than {MOST} lines");
            return Err(Failure::in_file(file, why));
        }
        self.0.push(Numbered {
            number,
            title,
            case,
        });
        Ok(())
    }

    /// Lines, or the witnesses of a report, whichever it is.
    fn add_all(&mut self, file: &Path, mut reader: impl BufRead) -> Result<(), Failure> {
        let head = reader.fill_buf().map_err(|e| Failure::in_file(file, e))?;
        let mark = if head.starts_with(MARK) {
            MARK.len()
        } else {
            0
        };
        let is_json = head[mark..].trim_ascii_start().starts_with(b"{");
        reader.consume(mark);
        if is_json {
            self.add_witnesses(file, reader)
        } else {
            self.add_lines(file, reader)
        }
    }

    fn add_lines(&mut self, file: &Path, reader: impl BufRead) -> Result<(), Failure> {
        let mut lines = Lines::new(reader);
        loop {
            let at = |number: u64, why: &dyn std::fmt::Display| {
                Failure::at(file, format_args!("line {number}"), why)
            };
            let next = lines.next().map_err(|(number, why)| at(number, &why))?;
            let Some((number, line)) = next else {
                return Ok(());
            };
            let line = std::str::from_utf8(line).map_err(|_| at(number, &"it is not UTF-8"))?;
            let line = line.split('#').next().unwrap_or("");
            if line.trim().is_empty() {
                continue;
            }
            let case = line.parse().map_err(|e: CaseLineError| at(number, &e))?;
            self.add(file, case, String::new())?;
        }
    }

    fn add_witnesses(&mut self, file: &Path, reader: impl BufRead) -> Result<(), Failure> {
        let report: Report =
            serde_json::from_reader(reader).map_err(|e| Failure::in_file(file, e))?;
        for (i, witness) in report.witnesses.into_iter().enumerate() {
            let case = witness.line.parse().map_err(|e: CaseLineError| {
                Failure::at(file, format_args!("witness {}", i + 1), e)
            })?;
            self.add(file, case, witness.title())?;
        }
        Ok(())
    }
}

/// The part of a `report.json` that is read here.
#[derive(Deserialize)]
struct Report {
    witnesses: Vec<Witness>,
}

#[derive(Deserialize)]
struct Witness {
    line: String,
    #[serde(default)]
    algorithm: String,
    #[serde(default)]
    tier: String,
    #[serde(default)]
    family: String,
    #[serde(default)]
    worst: String,
}

impl Witness {
    fn title(&self) -> String {
        let words = [&self.family, &self.algorithm, &self.tier, &self.worst];
        let words: Vec<&str> = words.iter().map(|w| w.as_str()).collect();
        words.join(" ").trim().to_owned()
    }
}
