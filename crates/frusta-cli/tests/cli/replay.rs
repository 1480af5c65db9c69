//! `frusta replay`: lines, files, reports, pictures, and what is refused.

use crate::{Folder, frusta, text};
use ::frusta::samples::Family;
use ::frusta_lab::{CaseLine, SurveyAlgorithm, SurveyTier};
use serde_json::{Value, json};
use std::process::Output;

const TOUCH: &str = "f64 near 1 -1 1 -1 1 far 3 -3 3 -3 3 segment 3 1 2 1 3 2";

fn replay(args: &[&str]) -> Output {
    frusta(["replay"].iter().chain(args))
}

fn succeed(args: &[&str]) -> String {
    let output = replay(args);
    let why = text(&output.stderr);
    assert!(output.status.success(), "{args:?}: {why}");
    text(&output.stdout)
}

/// One line on the error stream, exit code 2, nothing printed.
fn fail(args: &[&str], parts: &[&str]) {
    let output = replay(args);
    let why = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{args:?}: {why}");
    assert_eq!(why.lines().count(), 1, "{why}");
    assert!(output.stdout.is_empty());
    for part in parts {
        assert!(why.contains(part), "{part:?} in {why:?}");
    }
}

/// Cases of all families, the second of which is plainly wrong in `f64`.
fn cases() -> Vec<String> {
    let extreme = "f64 near 1 -1 1 -1 1 slopes -1 1 -1 1 PlusZ segment 3e300 1 2e300 1 3 2";
    let mut lines = vec![TOUCH.to_owned(), extreme.to_owned()];
    for family in Family::ALL {
        let (frustum, segment) = family.case(9, 3);
        lines.push(CaseLine::new(&frustum, &segment).to_string());
        if let Some((frustum, segment)) = family.case_f32(9, 67) {
            lines.push(CaseLine::new(&frustum, &segment).to_string());
        }
    }
    lines
}

#[test]
fn a_line_is_shown_in_full() {
    let shown = succeed(&[TOUCH]);
    for part in [
        "truth         touch",
        "t = 0.5, on right+top, clipped",
        "plain-f32",
        "exact-inward-f32",
        "all six",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    assert!(
        shown.lines().all(|line| line.chars().count() <= 100),
        "{shown}"
    );
    let wrong = succeed(&[&cases()[1]]);
    assert!(
        wrong.contains("CLASS") && wrong.contains("t = 1 - "),
        "{wrong}"
    );
    assert!(
        wrong.contains("by integers") && wrong.contains("Not in f32"),
        "{wrong}"
    );
}

#[test]
fn every_family_is_replayed_and_its_exact_answers_are_right() {
    let folder = Folder::new();
    let file = folder.write(
        "cases.txt",
        format!("# all\n\n{}\n", cases().join("  # one\n")),
    );
    let summary = succeed(&[&file]);
    assert_eq!(summary.lines().count(), cases().len());
    for line in summary.lines() {
        assert!(line.contains("exact 0 of") && line.len() <= 100, "{line}");
    }
    let all: Value = serde_json::from_str(&succeed(&[&file, "--json"])).unwrap();
    let all = all.as_array().unwrap();
    assert_eq!(all.len(), cases().len());
    for (case, line) in all.iter().zip(cases()) {
        let typed: CaseLine = line.parse().unwrap();
        assert_eq!(case["line"], typed.to_string());
        let answers = case["answers"].as_array().unwrap();
        let tiers = SurveyTier::ALL.into_iter();
        let without_f32 = tiers.filter(|tier| !tier.is_single()).count();
        let counts = [without_f32, SurveyTier::ALL.len()].map(|c| c * SurveyAlgorithm::ALL.len());
        assert!(counts.contains(&answers.len()), "{}", answers.len());
        for answer in answers {
            let exact = answer["tier"].as_str().unwrap().starts_with("exact");
            assert!(!exact || answer["right_class"] == true, "{line}: {answer}");
            assert_eq!(answer["violations"], json!([]), "{line}: {answer}");
        }
    }
    let third = succeed(&[&file, "--only", "3", "--json"]);
    assert_eq!(serde_json::from_str::<Value>(&third).unwrap()[0]["case"], 3);
}

#[test]
fn every_case_can_be_drawn() {
    let folder = Folder::new();
    let file = folder.write("cases.txt", cases().join("\n"));
    let out = folder.name("drawn");
    succeed(&[&file, "--out", &out, "--theme", "dark"]);
    for number in 1..=cases().len() {
        let svg = folder.read(&format!("drawn/{number}.svg"));
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
        assert!(!svg.contains("NaN") && !svg.contains("inf "), "{number}");
        for tag in svg.split('<').filter(|tag| !tag.starts_with("text")) {
            assert!(
                !tag.contains("inf\"") && !tag.contains("inf,"),
                "{number}: {tag}"
            );
        }
    }
    for name in ["one.png", "one.svg"] {
        succeed(&[&file, "--only", "2", "-o", &folder.name(name)]);
    }
    assert!(
        std::fs::read(folder.path("one.png"))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
    fail(&[&file, "--out", &out], &["not empty"]);
    fail(&[&file, "-o", &folder.name("two.svg")], &["--only"]);
    fail(&[TOUCH, "-o", &folder.name("two.gif")], &["two.gif"]);
    assert_eq!(folder.files(), ["cases.txt", "drawn", "one.png", "one.svg"]);
}

#[test]
fn a_report_has_witnesses() {
    let folder = Folder::new();
    let witness = json!({"line": TOUCH, "algorithm": "vw", "tier": "plain-f64", "family": "bumps",
                         "worst": "class", "value": 3.0, "case": 7});
    let bad = json!({"line": "f64 far"});
    let report = json!({"rows": [1, {"x": 2}], "witnesses": [witness, witness]});
    let file = folder.write("report.json", report.to_string());
    let summary = succeed(&[&file]);
    assert_eq!(summary.lines().count(), 2);
    assert!(summary.contains("bumps vw plain-f64 class"), "{summary}");
    let report = json!({"witnesses": [witness, bad]});
    let file = folder.write("bad.json", report.to_string());
    fail(&[&file], &["bad.json", "witness 2", "column 5"]);
    let file = folder.write("none.json", "{\"rows\": []}");
    fail(&[&file], &["none.json", "witnesses"]);
    let file = folder.write("cut.json", "{\"witnesses\": [");
    fail(&[&file], &["cut.json", "line 1"]);
}

#[test]
fn bad_lines_are_one_error_with_their_place() {
    let folder = Folder::new();
    fail(&["f64 near 1 2"], &["the line: column 13", "near.right"]);
    fail(&["f64 near 1 x"], &["column 12", "near.left", "\"x\""]);
    fail(&["none.txt"], &["none.txt"]);
    fail(&[""], &["not a file", "f64 or f32"]);
    fail(&[&TOUCH[4..]], &["not a file", "f64 or f32"]);
    fail(&[&folder.name("")], &["directory"]);
    let out = folder.name("out");
    for (content, part) in [
        (format!("{TOUCH}\n# fine\n{TOUCH} 7\n"), "line 3: column 58"),
        ("\n".to_owned(), "no line"),
        (
            "f64 near 1 -1 1 -1 1 far 1 -1 1 -1 1 segment 0 0 0 1 1 1".to_owned(),
            "line 1: column 5",
        ),
        ("\0\0\0".to_owned(), "line 1"),
        (TOUCH.replace("3 2", "inf 2"), "not finite"),
        (TOUCH.replace("f64", "f16"), "f64 or f32"),
        ("x".repeat(3 << 20), "line 1"),
    ] {
        let file = folder.write("bad.txt", content);
        fail(&[&file, "--out", &out], &[part]);
        fail(&[&file, "-o", &folder.name("a.svg")], &[part]);
    }
    let file = folder.write("bad.txt", b"f64 \xff\n");
    fail(&[&file], &["line 1", "UTF-8"]);
    let file = folder.write("good.txt", TOUCH);
    fail(&[&file, "--only", "2"], &["--only 2", "1 cases"]);
    assert_eq!(folder.files(), ["bad.txt", "good.txt"]);
}
