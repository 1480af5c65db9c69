//! `frusta report` and `frusta verify`.

use super::{Folder, text};
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

/// The flags of a report of a moment: of families with and without f32.
const SMALL: [&str; 10] = [
    "--cases",
    "40",
    "--rounds",
    "1",
    "--repeat",
    "1",
    "--everyday",
    "1500",
    "--families",
    "thin,subnormal",
];

/// A small report with these flags and without a folder; it must exit with 0.
fn report(args: &[&str]) -> Output {
    run_report(&[&["--no-out"], args].concat())
}

/// A small report with these flags; it must exit with 0.
fn run_report(args: &[&str]) -> Output {
    let run = frusta(&[&["report"], args, &SMALL].concat());
    assert_eq!(
        run.status.code(),
        Some(0),
        "{args:?}: {}",
        text(&run.stderr)
    );
    assert!(run.stderr.is_empty(), "no progress bar without a terminal");
    run
}

fn keys(object: &Value) -> Vec<&str> {
    object
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

const DOCUMENTATION: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/report.md");

/// The keys that docs/report.md promises, in the order of `serde_json`'s maps.
#[test]
fn the_keys_of_report_json_stay() {
    let json: Value = serde_json::from_slice(&report(&["--json"]).stdout).unwrap();
    let documented = std::fs::read_to_string(DOCUMENTATION).unwrap();
    let promised = |names: &str, object: &Value| {
        let mut names: Vec<&str> = names.split_whitespace().collect();
        for name in &names {
            assert!(documented.contains(&format!("`{name}`")), "{name}");
        }
        names.sort_unstable();
        assert_eq!(keys(object), names);
    };
    promised(
        "schema frusta command machine seconds seed cases rounds answer rows witnesses everyday volumes \
         false_accepts volume_times paper peers omitted",
        &json,
    );
    promised("cpu cores os arch rustc simd", &json["machine"]);
    promised(
        "algorithm tier family cases wrong_class wrong_faces refused ns_median time_ratio \
         time_ratio_lower time_ratio_upper max_error_ulp p999_error_ulp max_error_u_scale p999_error_u_scale outside asymmetric \
         non_idempotent filter_failures exact_stage",
        &json["rows"][0],
    );
    promised(
        "algorithm tier family worst value case line",
        &json["witnesses"][0],
    );
    promised(
        "mix place algorithm tier slices segments rounds ns_median time_ratio \
         time_ratio_lower time_ratio_upper wrong",
        &json["everyday"][0],
    );
    promised(
        "kind cases wrong_class wrongly_outside wrong_in_batch wrong_exact false_accepts",
        &json["volumes"][0],
    );
    promised(
        "half_extent field_of_view boxes accepted falsely share",
        &json["false_accepts"][0],
    );
    promised(
        "job function scalar timed rounds ns_median time_ratio time_ratio_lower time_ratio_upper",
        &json["volume_times"][0],
    );
    promised("what why", &json["omitted"][0]);
    assert_eq!(json["schema"], "frusta-report/1");
    let command = "frusta report --cases 40 --seed 1 --rounds 1 --repeat 1 --everyday 1500 \
                   --families subnormal,thin";
    assert_eq!(json["command"], command);
    // Six algorithms in eight tiers, in four of a family without f32.
    assert_eq!(json["rows"].as_array().unwrap().len(), 6 * (8 + 4));
    assert_eq!(json["rows"][0]["tier"], "plain-f64");
    assert_eq!(json["answer"].as_array().unwrap().len(), 3);
}

#[test]
fn a_report_has_no_number_that_is_not_finite() {
    let json: Value = serde_json::from_slice(&report(&["--json"]).stdout).unwrap();
    assert_eq!(json["peers"], Value::Null);
    for row in json["rows"].as_array().unwrap() {
        for (key, value) in row.as_object().unwrap() {
            assert!(value.is_number() || value.is_string(), "{key} in {row}");
        }
        assert!(row["ns_median"].as_f64() > Some(0.0), "{row}");
    }
    for witness in json["witnesses"].as_array().unwrap() {
        assert!(witness["value"].as_f64() > Some(0.0), "{witness}");
    }
}

#[test]
fn seven_clippers_clip_everyday_segments_in_eight_places_rightly() {
    let json: Value = serde_json::from_slice(&report(&["--json"]).stdout).unwrap();
    let rows = json["everyday"].as_array().unwrap();
    assert_eq!(rows.len(), 7 * 8);
    for row in rows {
        let mut values = row.as_object().unwrap().values();
        assert!(!values.any(|v| v.is_object() || v.is_array()), "{row}");
        assert_eq!((&row["segments"], &row["wrong"]), (&1500.into(), &0.into()));
        assert!(row["ns_median"].as_f64() > Some(0.0), "{row}");
        let reference = row["algorithm"] == "liang-barsky-textbook";
        assert!(!reference || row["time_ratio"] == 1.0, "{row}");
    }
    let count = |key: &str, value: Value| rows.iter().filter(|r| r[key] == value).count();
    assert_eq!(count("slices", true.into()), 3 * 8);
    assert_eq!(count("tier", "exact".into()), 2 * 8);
    assert_eq!(count("place", "world".into()), 7 * 4);
    assert_eq!(count("mix", "mixed".into()), 7 * 2);
}

#[test]
fn the_papers_table_has_a_row_for_every_algorithm() {
    let json: Value = serde_json::from_slice(&report(&["--json"]).stdout).unwrap();
    let rows = json["paper"].as_array().unwrap();
    let (clippers, failures): (Vec<_>, Vec<_>) = rows.iter().partition(|r| r["row"] == "clipper");
    assert_eq!(clippers.len(), 24);
    for row in rows {
        let mut values = row.as_object().unwrap().values();
        assert!(!values.any(|v| v.is_object() || v.is_array()), "{row}");
    }
    for row in &clippers {
        assert_eq!(row["repeats"], 1);
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
fn the_verbose_report_has_all_tables() {
    let tables = text(&report(&["--verbose"]).stdout);
    for part in [
        "families: 2; cases of each in each scalar type: 40",
        "\nexact-nearest-f32: 40 cases\nvw ",
        "\nsubnormal ",
        "\nEveryday segments: 1500 of each mix, f64, 1 rounds",
        "\nworld  long-crossing ",
        "\nThe 78 singular samples in the standard frame",
        "\nf32, exact\nliang-barsky-textbook     -  ",
        " s; the same again:\nfrusta report --cases 40 ",
    ] {
        assert!(tables.contains(part), "{part:?} not in\n{tables}");
    }
    let wide = tables.lines().find(|line| line.chars().count() > 100);
    assert_eq!(wide, None);
}

#[test]
fn the_default_text_is_the_answer_the_papers_table_and_where_the_page_is() {
    let folder = Folder::new();
    let mut command = Command::new(env!("CARGO_BIN_EXE_frusta"));
    command.arg("report").args(SMALL);
    let run = command.current_dir(folder.path("")).output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let printed = text(&run.stdout);
    let places = [
        "Exact clipping gave 0 wrong answers of ",
        "On everyday segments ",
        "n the hard families",
        "The paper's table, made again: its 78 singular samples",
        "\nplain six-planes ",
        "frusta-report/report.html\n",
    ];
    let places = places.map(|part| printed.find(part).expect(part));
    assert!(places.is_sorted(), "{printed}");
    let widest = printed.lines().map(|line| line.chars().count()).max();
    assert!(
        widest <= Some(100) && printed.lines().count() <= 60,
        "{printed}"
    );
    assert!(!printed.contains("e308"));
    let page = folder.read("frusta-report/report.html");
    assert!(page.starts_with("<!DOCTYPE html>"));
    // JSON goes to the standard output alone, unless a folder is asked for.
    let none = Folder::new();
    let mut command = Command::new(env!("CARGO_BIN_EXE_frusta"));
    command.args(["report", "--json"]).args(SMALL);
    let run = command.current_dir(none.path("")).output().unwrap();
    assert!(run.status.success() && none.files().is_empty());
}

/// The keys of times.
const TIMES: [&str; 4] = [
    "ns_median",
    "time_ratio",
    "time_ratio_lower",
    "time_ratio_upper",
];

/// All counts, errors and witnesses: everything except times.
fn timeless(mut json: Value) -> Value {
    for key in ["seconds", "paper"] {
        json[key] = Value::Null;
    }
    for sentence in 1..3 {
        json["answer"][sentence] = Value::Null;
    }
    for list in ["rows", "everyday", "volume_times"] {
        for row in json[list].as_array_mut().unwrap() {
            for key in TIMES {
                row[key] = Value::Null;
            }
        }
    }
    json
}

#[test]
fn threads_do_not_change_the_findings() {
    let with = |threads| {
        let run = report(&["--json", "--threads", threads]);
        timeless(serde_json::from_slice(&run.stdout).unwrap())
    };
    assert_eq!(with("1"), with("3"));
}

const PEERS: &str = r#"{"schema": "frusta-peers/1", "rows": [{"library": "other"}]}"#;

#[test]
fn a_folder_has_it_all() {
    let folder = Folder::new();
    let peers = folder.write("peers.json", PEERS);
    let out = folder.name("new/folder");
    let run = run_report(&["--out", &out, "--peers", &peers]);
    let printed = text(&run.stdout);
    for file in ["report.html", "tables.txt", "report.json", "witnesses.txt"] {
        assert!(printed.contains(&format!("{out}/{file}\n")), "{printed}");
        assert!(!folder.read(&format!("new/folder/{file}")).is_empty());
    }
    let json: Value = serde_json::from_str(&folder.read("new/folder/report.json")).unwrap();
    assert_eq!(json["peers"]["rows"][0]["library"], "other");
    let no_peers = |o: &Value| o["what"] == "other libraries";
    assert!(!json["omitted"].as_array().unwrap().iter().any(no_peers));
    for (file, list) in [("rows.csv", "rows"), ("witnesses.csv", "witnesses")] {
        let content = folder.read(&format!("new/folder/{file}"));
        let mut lines = content.lines();
        let mut heading: Vec<&str> = lines.next().unwrap().split(',').collect();
        heading.sort_unstable();
        assert_eq!(heading, keys(&json[list][0]));
        assert_eq!(lines.count(), json[list].as_array().unwrap().len());
    }
    // Each witness is there once, as a line that can be replayed.
    let lines = folder.read("new/folder/witnesses.txt");
    let mut inputs: Vec<&str> = lines.lines().filter(|l| l.starts_with('f')).collect();
    let of_json = json["witnesses"].as_array().unwrap().iter();
    let mut wanted: Vec<&str> = of_json.map(|w| w["line"].as_str().unwrap()).collect();
    inputs.sort_unstable();
    wanted.sort_unstable();
    wanted.dedup();
    assert_eq!(inputs, wanted);
    assert!(
        lines
            .lines()
            .all(|l| l.is_empty() || l.starts_with(['#', 'f']))
    );
}

#[test]
fn unreadable_and_unwritable_files_fail_at_once_and_leave_nothing() {
    let folder = Folder::new();
    folder.write("file", "");
    let torn = folder.write("torn.json", "{\"rows\": [");
    let other = folder.write("other.json", r#"{"rows": [{"library": "other"}]}"#);
    let empty = folder.write(
        "empty.json",
        r#"{"schema": "frusta-peers/1", "rows": [{}]}"#,
    );
    std::fs::create_dir_all(folder.path("taken/witnesses.csv")).unwrap();
    std::fs::create_dir_all(folder.path("page/report.html")).unwrap();
    std::fs::create_dir_all(folder.path("panel/panels/thin.svg")).unwrap();
    for (args, said) in [
        (
            ["--out", &folder.name("file")],
            "file: cannot be made a folder: it is a file",
        ),
        (
            ["--out", &folder.name("taken")],
            "witnesses.csv: cannot be written: it is a folder",
        ),
        (["--peers", &folder.name("none")], "none: No such file"),
        (
            ["--out", &folder.name("page")],
            "report.html: cannot be written: it is a folder",
        ),
        (
            ["--out", &folder.name("panel")],
            "thin.svg: cannot be written: it is a folder",
        ),
        (["--peers", &other], "other.json: no results of peers"),
        (["--peers", &empty], "empty.json: no results of peers"),
        (["--peers", &torn], "torn.json: not JSON: EOF"),
    ] {
        let run = frusta(&[&["report"][..], &args].concat());
        assert_eq!(run.status.code(), Some(2), "{args:?}");
        let error = text(&run.stderr);
        assert!(
            error.contains(said) && error.lines().count() == 1,
            "{error}"
        );
        assert!(run.stdout.is_empty());
    }
    let given = "empty.json file other.json page panel taken torn.json";
    assert_eq!(folder.files().join(" "), given);
    for (taken, count) in [("taken", 1), ("page", 1), ("panel", 1), ("panel/panels", 1)] {
        let left = std::fs::read_dir(folder.path(taken)).unwrap();
        assert_eq!(left.count(), count, "{taken}");
    }
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
    let with_f32 = list.lines().filter(|l| l.contains(" f64 f32 ")).count();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 1 + families.len() + with_f32 + 1);
    for family in families {
        assert!(lines.iter().any(|l| l.starts_with(&format!("{family} "))));
    }
    let total = 200 * (lines.len() - 2);
    let last = lines.last().unwrap();
    assert!(last.starts_with("all") && last.contains(&format!(" {total} ")));
}

/// By default the command verifies ten million cases, at least 100,000 a family.
#[test]
fn the_default_is_as_many_cases_as_promised() {
    let help = text(&frusta(&["verify", "--help"]).stdout);
    let default = help.split("[default: ").nth(1).unwrap();
    let cases: usize = default.split(']').next().unwrap().parse().unwrap();
    let list = text(&frusta(&["verify", "--list"]).stdout);
    let with_f32 = list.lines().filter(|l| l.contains(" f64 f32 ")).count();
    let total = cases * (list.lines().count() + with_f32);
    assert!(cases >= 100_000 && total > 10_000_000, "{cases} {total}");
}

#[test]
fn threads_do_not_change_the_verification() {
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
fn volumes_are_verified_as_json_too() {
    let with = |threads| {
        let mut args = vec![
            "verify",
            "--volumes",
            "--cases",
            "200",
            "--family",
            "rotated",
        ];
        args.extend(["--json", "--threads", threads]);
        rows(&args)
    };
    let one = with("1");
    assert_eq!(one, with("2"));
    let kinds: Vec<_> = one.iter().map(|row| row["kind"].as_str()).collect();
    let names = ["box", "box-f32", "obb", "sphere", "sphere-f32"];
    assert_eq!(kinds, names.map(Some));
    for row in &one {
        let count = |key: &str| row[key].as_u64().unwrap();
        assert_eq!(count("outside") + count("crossing") + count("inside"), 200);
        for key in [
            "wrong_class",
            "wrongly_outside",
            "wrong_in_batch",
            "wrong_exact",
        ] {
            assert_eq!(count(key), 0, "{row}");
        }
        assert!(count("false_accepts") > 0, "{row}");
    }
}

#[test]
fn wrong_usage_is_rejected() {
    for (args, reason) in [
        (["verify", "--family", "nowhere"], "no family \"nowhere\""),
        (["verify", "--cases", "0"], "0 is not in 1.."),
        (["report", "--repeat", "0"], "0 is not in 1.."),
        (["report", "--cases", "0"], "0 is not in 1.."),
        (["report", "--rounds", "0"], "0 is not in 1.."),
        (["report", "--everyday", "0"], "0 is not in 1.."),
        (
            ["report", "--families", "thin,nowhere"],
            "no family \"nowhere\"",
        ),
        (["verify", "--seed", "x"], "invalid digit"),
        (["report", "--no-out", "--out=x"], "cannot be used with"),
    ] {
        let run = frusta(&args);
        assert_eq!(run.status.code(), Some(2), "{args:?}");
        let said = text(&run.stderr);
        assert!(said.contains(reason), "{args:?}: {said}");
    }
}
