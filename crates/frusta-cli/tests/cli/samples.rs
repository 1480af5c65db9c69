//! `frusta samples`: what is listed, shown, drawn and exported.

use crate::{Folder, clip, frusta, text};
use serde_json::Value;

fn samples(args: &[&str]) -> std::process::Output {
    frusta(["samples"].iter().chain(args))
}

fn succeed(args: &[&str]) -> String {
    let output = samples(args);
    assert!(
        output.status.success(),
        "{args:?}: {}",
        text(&output.stderr)
    );
    text(&output.stdout)
}

/// One line on the error stream, and exit code 2.
fn fail(args: &[&str]) -> String {
    let output = samples(args);
    let why = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{args:?}: {why}");
    assert_eq!(why.lines().count(), 1, "{why}");
    why
}

fn names(args: &[&str]) -> Vec<String> {
    let rows: Value = serde_json::from_str(&succeed(args)).unwrap();
    let name = |row: &Value| row["name"].as_str().unwrap().to_owned();
    rows.as_array().unwrap().iter().map(name).collect()
}

#[test]
fn the_list_has_78_rows_and_a_heading() {
    let table = succeed(&["list"]);
    assert_eq!(table.lines().count(), 79);
    assert!(table.starts_with("name "));
    let named = |name: &str| {
        table
            .lines()
            .any(|row| row.split_whitespace().next() == Some(name))
    };
    let names = names(&["list", "--json"]);
    assert_eq!(names.len(), 78);
    assert!(names.iter().all(|name| named(name)));
    assert_eq!(succeed(&["list", "--near-misses"]).lines().count(), 105);
    assert_eq!(succeed(&["list", "--solid", "pyramid"]).lines().count(), 55);
    assert_eq!(
        succeed(&["list", "--solid", "infinite"]).lines().count(),
        52
    );
}

#[test]
fn a_row_of_the_list() {
    let table = succeed(&["list"]);
    let row = table
        .lines()
        .find(|row| row.starts_with("edge-near-top/crossing"));
    let fields: Vec<&str> = row.unwrap().split_whitespace().collect();
    assert_eq!(
        fields,
        [
            "edge-near-top/crossing",
            "one",
            "up-down",
            "cross",
            "0.5",
            "1",
            "near+top",
            "-",
            "-"
        ]
    );
}

#[test]
fn each_sample_shows_that_the_answer_is_right() {
    for name in names(&["list", "--json", "--near-misses"]) {
        let shown = succeed(&["show", &name]);
        assert!(shown.starts_with(&name), "{shown}");
        assert!(shown.contains("answers the same, in every bit"), "{shown}");
        assert!(shown.contains("reason") && shown.contains("0x"), "{shown}");
    }
    let shown = succeed(&[
        "show",
        "face-left/crossing",
        "--solid",
        "infinite",
        "--json",
    ]);
    let shown: Value = serde_json::from_str(&shown).unwrap();
    assert_eq!(shown["agrees"], true);
    assert_eq!(shown["found"]["class"], shown["class"]);
    assert_eq!(shown["segment_hex"][0].as_array().unwrap().len(), 3);
}

#[test]
fn an_unknown_name_is_answered_with_near_ones() {
    let why = fail(&["show", "edge-neer-top/crossing"]);
    assert!(why.contains("edge-near-top/crossing"), "{why}");
    let why = fail(&["show", "face-far/touching", "--solid", "infinite"]);
    assert!(why.contains("solid infinite"), "{why}");
    fail(&["show", &"x\n".repeat(10_000)]);
}

#[test]
fn pictures_are_whole_or_not_there() {
    let folder = Folder::new();
    let name = "vertex-far-left-top/crossing";
    for (file, begins) in [("a.svg", &b"<svg"[..]), ("a.png", b"\x89PNG")] {
        succeed(&["show", name, "-o", &folder.name(file), "--theme", "dark"]);
        let content = std::fs::read(folder.path(file)).unwrap();
        assert!(content.starts_with(begins), "{file}");
    }
    let drawn = folder.read("a.svg");
    assert!(drawn.contains(name) && drawn.ends_with("</svg>\n"));
    fail(&["show", name, "-o", &folder.name("a.jpg")]);
    fail(&["sheet", "-o", &folder.name("a")]);
    fail(&["sheet", "-o", &folder.name("none/a.svg")]);
    fail(&["show", "no-such", "-o", &folder.name("b.svg")]);
    assert_eq!(folder.files(), ["a.png", "a.svg"]);
    // What was there stays if its successor fails.
    std::fs::create_dir(folder.path("c.svg")).unwrap();
    fail(&["sheet", "-o", &folder.name("c.svg")]);
    assert_eq!(folder.files(), ["a.png", "a.svg", "c.svg"]);
}

#[test]
fn the_sheet_has_all_names() {
    let folder = Folder::new();
    for (solid, count) in [("symmetric", 104), ("spire", 72), ("infinite-off-axis", 68)] {
        let file = folder.name("sheet.svg");
        succeed(&["sheet", "--near-misses", "--solid", solid, "-o", &file]);
        let sheet = folder.read("sheet.svg");
        assert!(
            !sheet.contains("NaN") && !sheet.contains("inf\""),
            "{solid}"
        );
        let names = names(&["list", "--json", "--near-misses", "--solid", solid]);
        assert_eq!(names.len(), count);
        for name in names {
            assert!(
                sheet.contains(&format!(">{name}</text>")),
                "{solid}: {name}"
            );
        }
    }
}

#[test]
fn what_is_exported_is_what_clip_answers() {
    let folder = Folder::new();
    let said = succeed(&["export", &folder.name("all"), "--near-misses"]);
    assert!(
        said.starts_with("2088 samples of 24 frusta in 73 files"),
        "{said}"
    );
    let all: Value = serde_json::from_str(&folder.read("all/samples.json")).unwrap();
    assert_eq!(all.as_array().unwrap().len(), 2088);
    let (mut frusta, mut rows) = (0, 0);
    for entry in std::fs::read_dir(folder.path("all")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        let Some(name) = file.strip_suffix(".frustum.json") else {
            continue;
        };
        frusta += 1;
        let expected = folder.read(&format!("all/{name}.expected.csv"));
        rows += expected.lines().count() - 1;
        let segments = folder.name(&format!("all/{name}.segments.csv"));
        let frustum = folder.name(&format!("all/{file}"));
        let out = folder.name("out.csv");
        for accuracy in ["fast", "nearest", "inward"] {
            let options = ["--frustum", &frustum, "-o", &out, "--accuracy", accuracy];
            let run = clip([segments.as_str()].iter().chain(&options));
            assert!(run.status.success(), "{name}: {}", text(&run.stderr));
            assert_eq!(folder.read("out.csv"), expected, "{name} {accuracy}");
        }
    }
    assert_eq!((frusta, rows), (24, 2088));
}

#[test]
fn an_export_is_alone_in_its_folder() {
    let folder = Folder::new();
    let target = folder.name("made/deeper");
    let some = [
        "export",
        &target,
        "--solid",
        "pyramid",
        "--placement",
        "scaled",
    ];
    let said = succeed(&some);
    assert!(
        said.starts_with("54 samples of 1 frusta in 4 files"),
        "{said}"
    );
    let once = folder.read("made/deeper/samples.json");
    // The same again is replaced; another choice would leave files of this one.
    succeed(&some);
    assert_eq!(folder.read("made/deeper/samples.json"), once);
    let why = fail(&["export", &target, "--solid", "spire"]);
    assert!(why.contains("pyramid-scaled"), "{why}");
    folder.write("file", "");
    fail(&["export", &folder.name("file")]);
    fail(&["export", &folder.name("file/below")]);
}
