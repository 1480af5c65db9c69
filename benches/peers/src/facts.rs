//! Single inputs that end badly, each in a process of its own, since some never end.

mod inputs;

pub use inputs::{INPUTS, Input};

use crate::versions::version;
use serde::Serialize;
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// One input and how it ends.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fact {
    /// The crate.
    pub library: &'static str,
    /// Its version, from `Cargo.lock`.
    pub version: &'static str,
    /// The function that was called.
    pub what: &'static str,
    /// The input.
    pub input: &'static str,
    /// The result.
    pub result: String,
    /// frusta's answer to the same input; empty where there is no such function.
    pub ours: String,
}

/// How long to wait for an answer.
pub const PATIENCE: Duration = Duration::from_secs(2);

/// Runs all inputs. `program` is this program, which prints [`answer`]'s text for `--fact INDEX`.
pub fn ask(program: &std::path::Path) -> Vec<Fact> {
    let indexed = INPUTS.iter().enumerate();
    indexed
        .map(|(index, input)| Fact {
            library: input.library,
            version: version(input.library).unwrap_or_default(),
            what: input.what,
            input: input.input,
            result: in_a_child(program, index),
            ours: (input.ours)(),
        })
        .collect()
}

/// The text for one input, or `None` if the index is out of range.
pub fn answer(index: usize) -> Option<String> {
    INPUTS.get(index).map(|input| (input.theirs)())
}

fn in_a_child(program: &std::path::Path, index: usize) -> String {
    let child = Command::new(program)
        .args(["--fact", &index.to_string()])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    match child {
        Ok(child) => wait(child),
        Err(error) => format!("not asked: {error}"),
    }
}

/// What a child says, or that it said nothing in time.
fn wait(mut child: Child) -> String {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        match child.try_wait() {
            Ok(Some(status)) if status.success() => {
                let mut text = String::new();
                if let Some(mut out) = child.stdout.take()
                    && let Err(error) = out.read_to_string(&mut text)
                {
                    return format!("not heard: {error}");
                }
                return text.trim_end().to_owned();
            }
            Ok(Some(status)) => return format!("ended by {status}"),
            Ok(None) => std::thread::sleep(Duration::from_millis(5)),
            Err(error) => return format!("not waited for: {error}"),
        }
    }
    // It has an answer or is gone already: either way there is nothing left to do.
    let _ = child.kill();
    let _ = child.wait();
    format!("no answer within {} s", PATIENCE.as_secs())
}
