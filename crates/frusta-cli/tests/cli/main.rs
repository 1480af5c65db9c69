//! The command `frusta`, run as a program.

mod bad_input;
mod bad_table;
mod cases;
mod formats;
mod geo;
mod hostile;
mod maps;
mod meshes;
mod output;
mod pictures;
mod replay;
mod report;
mod samples;
mod shell;
mod statistics;
mod streams;
mod view;

use frusta::{Real, Segment};
use serde_json::Value;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// Flags of a frustum that takes in everything in a small scene.
const WIDE: [&str; 10] = [
    "--eye", "0,0,50", "--target", "0,0,0", "--ortho", "90", "--near", "0", "--far", "100",
];

/// A file of `tests/fixtures`.
fn fixture(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/fixtures")
        .join(name);
    path.to_str().unwrap().to_owned()
}

/// Runs the program.
fn frusta<S: AsRef<OsStr>>(args: impl IntoIterator<Item = S>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frusta"));
    command.args(args).output().unwrap()
}

/// Runs `frusta clip`.
fn clip<S: AsRef<OsStr>>(args: impl IntoIterator<Item = S>) -> Output {
    let args = args.into_iter().map(|arg| arg.as_ref().to_owned());
    frusta([OsString::from("clip")].into_iter().chain(args))
}

/// Runs `frusta clip --json` and gives the statistics.
fn statistics(args: &[&str]) -> Value {
    let output = clip(args.iter().copied().chain(["--json"]));
    assert!(
        output.status.success(),
        "{args:?}: {}",
        text(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Starts `frusta clip`, all its streams held.
fn started(args: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_frusta"))
        .arg("clip")
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Segments about a frustum of size 1 to 3, many of them clipped.
fn random_segments<T: Real>(count: usize) -> Vec<Segment<T>> {
    let mut state = 7_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        T::from_f64((state >> 11) as f64 / (1_u64 << 53) as f64 * 8.0 - 4.0)
    };
    let mut point = || [next(), next(), next()];
    (0..count).map(|_| Segment::new(point(), point())).collect()
}

/// A folder for one test.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn name(&self, name: &str) -> String {
        self.path(name).to_str().unwrap().to_owned()
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        std::fs::write(self.path(name), content).unwrap();
        self.name(name)
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    /// Names of all files in it.
    fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> = entries
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// Clips a file to CSV and gives the rows after the header.
    fn rows(&self, args: &[&str]) -> Vec<String> {
        let out = self.name("rows.csv");
        let run = clip(args.iter().copied().chain(["-o", &out]));
        assert!(run.status.success(), "{args:?}: {}", text(&run.stderr));
        let content = self.read("rows.csv");
        let mut lines = content.lines().map(str::to_owned);
        assert_eq!(
            lines.next().unwrap(),
            "index,class,t0,t1,x0,y0,z0,x1,y1,z1,enter,leave,coplanar"
        );
        lines.collect()
    }
}
