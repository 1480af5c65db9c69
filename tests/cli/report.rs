//! `frusta report` and `frusta verify`.

use super::text;
use serde_json::Value;
use std::process::{Command, Output};

fn frusta(args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frusta"));
    command.args(args).output().unwrap()
}

/// Rows of a successful run, none of them nested.
fn rows(args: &[&str]) -> Vec<Value> {
    let run = frusta(args);
    assert!(run.status.success(), "{args:?}: {}", text(&run.stderr));
    let rows: Vec<Value> = serde_json::from_slice(&run.stdout).unwrap();
    for row in &rows {
        let mut values = row.as_object().unwrap().values();
        assert!(!values.any(|v| v.is_object() || v.is_array()), "{row}");
    }
    rows
}

#[test]
fn the_report_has_a_row_for_every_algorithm() {
    let rows = rows(&["report", "--repeat", "3", "--json"]);
    let (clippers, failures): (Vec<_>, Vec<_>) = rows.iter().partition(|r| r["row"] == "clipper");
    assert_eq!(clippers.len(), 24);
    for row in &clippers {
        assert_eq!(row["repeats"], 3);
        assert_eq!(row["standard_samples"], 78);
        if row["tier"] == "exact" {
            for place in ["standard", "stretched", "turned", "rotated"] {
                for what in ["right_classes", "right_sets"] {
                    let all = &row[format!("{place}_samples")];
                    assert_eq!(&row[format!("{place}_{what}")], all, "{row}");
                }
            }
        }
    }
    let six = |r: &&&Value| r["algorithm"] == "six-planes" && r["tier"] == "plain";
    assert!(failures.iter().filter(six).count() > 10);
    assert!(failures.iter().all(|r| r["tier"] == "plain"));
}

#[test]
fn the_report_is_a_table_otherwise() {
    let run = frusta(&["report", "--repeat", "1"]);
    assert_eq!(run.status.code(), Some(0));
    assert!(run.stderr.is_empty(), "no progress bar without a terminal");
    let table = text(&run.stdout);
    assert!(table.starts_with("The 78 singular samples in the standard frame"));
    assert!(table.contains("\nf32, exact\nliang-barsky-textbook     -  "));
}

#[test]
fn every_family_is_verified_a_line_each() {
    let run = frusta(&["verify", "--cases", "200", "--seed", "9"]);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stdout));
    assert!(run.stderr.is_empty(), "no progress bar without a terminal");
    let table = text(&run.stdout);
    let list = text(&frusta(&["verify", "--list"]).stdout);
    let families: Vec<&str> = list.lines().map(|l| l.split(' ').next().unwrap()).collect();
    assert!(families.len() >= 40);
    let singles = list.lines().filter(|l| l.contains(" f64 f32 ")).count();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 1 + families.len() + singles + 1);
    for family in families {
        assert!(lines.iter().any(|l| l.starts_with(&format!("{family} "))));
    }
    let total = 200 * (lines.len() - 2);
    let last = lines.last().unwrap();
    assert!(last.starts_with("all") && last.contains(&format!(" {total} ")));
}

/// What the command verifies by default: ten million cases, 100,000 a family.
#[test]
fn the_default_is_as_many_cases_as_promised() {
    let help = text(&frusta(&["verify", "--help"]).stdout);
    let default = help.split("[default: ").nth(1).unwrap();
    let cases: usize = default.split(']').next().unwrap().parse().unwrap();
    let list = text(&frusta(&["verify", "--list"]).stdout);
    let singles = list.lines().filter(|l| l.contains(" f64 f32 ")).count();
    let total = cases * (list.lines().count() + singles);
    assert!(cases >= 100_000 && total > 10_000_000, "{cases} {total}");
}

#[test]
fn threads_do_not_change_what_is_verified() {
    let with = |threads| {
        let mut args = vec!["verify", "--cases", "300", "--family", "bumps"];
        args.extend(["--family", "thin", "--json", "--threads", threads]);
        rows(&args)
    };
    let (one, three) = (with("1"), with("3"));
    assert_eq!(one.len(), 4);
    for (a, b) in one.iter().zip(&three) {
        for key in [
            "family",
            "scalar",
            "cases",
            "near",
            "filter_failures",
            "inward_ends",
        ] {
            assert_eq!(a[key], b[key], "{key}");
        }
        assert_eq!(a["cases"], 300);
        assert_eq!(a["wrong_class"], 0);
        assert_eq!(a["witness"], Value::Null);
    }
    for row in &one {
        assert!(row["near"].as_u64().unwrap() >= 150, "{row}");
    }
    assert_eq!(one[2]["family"], "thin");
    assert!(one[2]["filter_failures"].as_u64().unwrap() > 0);
}

#[test]
fn wrong_usage_is_told() {
    for (args, reason) in [
        (["verify", "--family", "nowhere"], "no family \"nowhere\""),
        (["verify", "--cases", "0"], "0 is not in 1.."),
        (["report", "--repeat", "0"], "0 is not in 1.."),
        (["verify", "--seed", "x"], "invalid digit"),
    ] {
        let run = frusta(&args);
        assert_eq!(run.status.code(), Some(2), "{args:?}");
        let said = text(&run.stderr);
        assert!(said.contains(reason), "{args:?}: {said}");
    }
}
