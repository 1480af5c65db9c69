//! Standard input and output, and what stays a stream.

use super::{Folder, WIDE, clip, fixture, started, statistics, text};
use std::io::{Read, Write};
use std::process::{Command, Stdio};

/// Runs `frusta clip` with something on its standard input; exit code, output,
/// messages.
fn piped(args: &[&str], input: &[u8]) -> (Option<i32>, String, String) {
    let mut child = started(args);
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_vec();
    // A command that refuses its input may close it early.
    let feeder = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    feeder.join().unwrap();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

#[test]
fn rows_through_a_pipe() {
    let folder = Folder::new();
    let rows: String = (0..30_000)
        .map(|i| format!("{i},0,0,{i},1,{}\n", i % 7))
        .collect();
    let file = folder.write("a.csv", &rows);
    let expected = folder.rows(&[&[file.as_str()], &WIDE[..]].concat());
    let args = [&["-", "--from", "csv", "-o", "-", "--to", "csv"], &WIDE[..]].concat();
    let (code, out, messages) = piped(&args, rows.as_bytes());
    assert_eq!(code, Some(0), "{messages}");
    assert!(out.lines().skip(1).eq(expected.iter().map(String::as_str)));
    // The statistics go where they are not in the way.
    assert!(messages.contains("segments      30,000"), "{messages}");
}

#[test]
fn whole_files_through_a_pipe() {
    for name in ["6814_ice_tunnelator.glb", "shapes.obj"] {
        let bytes = std::fs::read(fixture(name)).unwrap();
        let format = if name.ends_with("glb") { "gltf" } else { "obj" };
        let args = [&["-", "--from", format, "--json"], &WIDE[..]].concat();
        let (code, out, messages) = piped(&args, &bytes);
        assert_eq!(code, Some(0), "{messages}");
        let found: serde_json::Value = serde_json::from_str(&out).unwrap();
        let name = fixture(name);
        let expected = statistics(&[&[name.as_str()], &WIDE[..]].concat());
        assert_eq!(found["classes"], expected["classes"]);
    }
}

#[test]
fn a_pipe_needs_a_format_and_a_view() {
    for (args, part) in [
        (vec!["-"], "standard input: give its format with --from"),
        (
            vec!["-", "--from", "csv"],
            "give the view with --eye and --target",
        ),
        (
            [&["-", "--from", "csv", "-o", "-"], &WIDE[..]].concat(),
            "standard output: give its format with --to",
        ),
        (
            [&["-", "--from", "csv", "--to", "csv"], &WIDE[..]].concat(),
            "--to is for an output",
        ),
        (
            [&["-", "--from", "csv"], &WIDE[..]].concat(),
            "standard input: line 2: x1: \"x\" is not a number",
        ),
        (
            [&["-", "--from", "obj", "--edges", "lines"], &WIDE[..]].concat(),
            "standard input: the file has no lines",
        ),
    ] {
        let (code, out, messages) = piped(&args, b"1,2,3,4,5,6\n1,2,3,x,5,6\n");
        assert_eq!((code, out.as_str()), (Some(2), ""), "{args:?}");
        assert_eq!(messages.lines().count(), 1, "{messages}");
        assert!(messages.contains(part), "{part:?} in {messages:?}");
    }
}

#[test]
fn lines_of_an_obj_are_the_same_streamed_and_whole() {
    let folder = Folder::new();
    // Elements name vertices before and after them.
    let mut obj = String::from("l 1 20000\n");
    for i in 1..=20_000 {
        obj += &format!("v {i} {} 0\nl -1 {}\n", i % 9, 20_001 - i);
    }
    let file = folder.write("a.obj", &obj);
    let streamed = folder.rows(&[&[file.as_str(), "--edges", "lines"], &WIDE[..]].concat());
    assert_eq!(streamed.len(), 20_001);
    let whole = folder.rows(&[&[file.as_str()], &WIDE[..]].concat());
    assert_eq!(streamed, whole);
    let args = [&["-", "--from", "obj", "--edges", "lines"], &WIDE[..]].concat();
    let (code, _, messages) = piped(&args, obj.as_bytes());
    assert_eq!(code, Some(2));
    assert!(
        messages.contains("line 1: vertex 20000 of 0 so far"),
        "{messages}"
    );
}

#[test]
fn a_reader_that_has_seen_enough_ends_the_run() {
    let args = ["-", "--from", "csv", "-o", "-", "--to", "csv"];
    let mut child = started(&[&args, &WIDE[..]].concat());
    let mut stdin = child.stdin.take().unwrap();
    let feeder = std::thread::spawn(move || {
        // Endless, until the command goes away.
        while stdin.write_all(b"1,2,3,4,5,6\n").is_ok() {}
    });
    let mut some = [0; 100];
    child.stdout.take().unwrap().read_exact(&mut some).unwrap();
    let output = child.wait_with_output().unwrap();
    feeder.join().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stderr), "");
}

/// A run that is interrupted while it writes leaves nothing and says so.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_no_file() {
    for signal in ["INT", "TERM", "HUP"] {
        let folder = Folder::new();
        let out = folder.write("out.csv", "older\n");
        let mut child = Command::new(env!("CARGO_BIN_EXE_frusta"))
            .args(["clip", "-", "--from", "csv", "-o", &out])
            .args(WIDE)
            .stdin(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut stdin = child.stdin.take().unwrap();
        stdin.write_all(&b"1,2,3,4,5,6\n".repeat(100_000)).unwrap();
        assert_eq!(folder.files().len(), 2, "it is being written beside");
        let kill = Command::new("kill")
            .args(["-s", signal, &child.id().to_string()])
            .status();
        assert!(kill.unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "SIG{signal}");
        let message = text(&output.stderr);
        assert_eq!(message, "frusta: interrupted; no unfinished file is left\n");
        assert_eq!(folder.files(), ["out.csv"]);
        assert_eq!(folder.read("out.csv"), "older\n");
    }
}

/// A disk that is full, as a limit on the size of files has it.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_no_file() {
    let folder = Folder::new();
    let rows = folder.write("a.csv", "1,2,3,4,5,6\n".repeat(200_000));
    for name in ["out.csv", "out.obj", "out.glb"] {
        let out = folder.name(name);
        let run = Command::new("sh")
            .args(["-c", "trap '' XFSZ; ulimit -f 64; exec \"$0\" \"$@\""])
            .args([env!("CARGO_BIN_EXE_frusta"), "clip", &rows, "-o", &out])
            .args(WIDE)
            .output()
            .unwrap();
        let message = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{name}: {message}");
        assert_eq!(message.lines().count(), 1);
        assert!(message.contains("File too large"), "{message}");
        assert_eq!(folder.files(), ["a.csv"]);
    }
    for (device, code) in [("/dev/full", 2), ("/dev/null", 0)] {
        let args = [rows.as_str(), "-o", device, "--to", "csv"];
        assert_eq!(clip(args).status.code(), Some(code), "{device}");
    }
}

/// Where a link leads to is written, and the link stays.
#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let folder = Folder::new();
    let rows = folder.write("a.csv", "0,0,0,1,1,1\n");
    folder.write("real.csv", "older\n");
    std::os::unix::fs::symlink("real.csv", folder.path("link.csv")).unwrap();
    let link = folder.name("link.csv");
    let run = clip([&[rows.as_str(), "-o", &link], &WIDE[..]].concat());
    assert!(run.status.success(), "{}", text(&run.stderr));
    assert!(folder.path("link.csv").is_symlink());
    assert!(folder.read("real.csv").starts_with("index,"));
    assert_eq!(folder.files(), ["a.csv", "link.csv", "real.csv"]);
}
