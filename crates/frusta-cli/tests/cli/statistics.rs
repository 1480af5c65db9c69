//! What is said about a run.

use super::{Folder, clip, fixture, statistics, text};
use serde_json::{Value, json};

/// Names on the command line, and as they are reported.
const ALGORITHMS: [(&str, &str); 6] = [
    ("vw", "vw"),
    ("liang-barsky", "liang-barsky-tuned"),
    ("liang-barsky-textbook", "liang-barsky-textbook"),
    ("six-planes", "six-planes"),
    ("cyrus-beck", "cyrus-beck"),
    ("cohen-sutherland", "cohen-sutherland"),
];

#[test]
fn statistics_have_these_keys_and_add_up() {
    let found = statistics(&[&fixture("six.csv"), "--frustum", &fixture("pair.json")]);
    let keys: Vec<&str> = found
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    assert_eq!(
        keys,
        [
            "accuracy",
            "algorithm",
            "arithmetic",
            "classes",
            "clipped_ends",
            "edges",
            "file",
            "filter_failure_share",
            "format",
            "frustum",
            "not_inward",
            "output",
            "peak_memory_bytes",
            "precision",
            "segments",
            "stages",
            "threads",
            "time",
            "view",
        ]
    );
    assert_eq!(found["segments"], 6);
    assert_eq!(
        found["classes"],
        serde_json::json!({"outside": 1, "touch": 1, "boundary": 1, "inside": 1, "cross": 2})
    );
    assert_eq!(found["clipped_ends"], 6);
    assert_eq!(found["algorithm"], "vw");
    assert_eq!(found["arithmetic"], "exact");
    for key in ["read_s", "clip_s", "write_s", "total_s"] {
        assert!(found["time"][key].as_f64().unwrap() >= 0.0, "{key}");
    }
    assert_eq!(found["filter_failure_share"], 0.0);
}

#[test]
fn what_the_filter_does_not_settle_is_counted() {
    let folder = Folder::new();
    let side = r#""left": -1, "right": 1, "bottom": -1, "top": 1"#;
    let view = format!(
        r#"{{"origin": [0, 0, 0.1], "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            "near": {{"z": -1, {side}}}, "far": {{"z": -9, {side}}}}}"#
    );
    let view = folder.write("view.json", view);
    // Within a roundoff of the near face, and far from all faces.
    let file = folder.write("a.csv", "0,0,-0.9,0.1,0,-0.9\n0,0,-5,0.1,0,-5\n");
    let found = statistics(&[&file, "--frustum", &view]);
    assert_eq!(found["stages"]["filter_failures"], 1);
    assert_eq!(found["filter_failure_share"], 0.5);
    for (rival, _) in ALGORITHMS {
        let args = [&file, "--frustum", &view, "--algorithm", rival];
        let exact = statistics(&args);
        assert_eq!(exact["stages"]["filter_failures"], 1, "{rival}");
        assert_eq!(exact["stages"]["double_doubles"], 2, "{rival}");
        assert_eq!(exact["filter_failure_share"], 0.5, "{rival}");
        assert_eq!(exact["classes"], found["classes"]);
        let plain = statistics(&[&args[..], &["--arithmetic", "plain"]].concat());
        assert_eq!(plain["stages"], Value::Null, "{rival}");
        assert_eq!(plain["filter_failure_share"], Value::Null, "{rival}");
    }
}

#[test]
fn every_algorithm_agrees_on_an_assembly_when_exact() {
    let file = fixture("6814_ice_tunnelator.glb");
    let expected = statistics(&[&file]);
    for (name, full) in ALGORITHMS {
        for precision in ["f32", "f64"] {
            let found = statistics(&[&file, "--algorithm", name, "--precision", precision]);
            assert_eq!(found["algorithm"], full);
            if precision == "f64" {
                assert_eq!(found["classes"], expected["classes"], "{name}");
            }
            let plain = statistics(&[
                &file,
                "--algorithm",
                name,
                "--precision",
                precision,
                "--arithmetic",
                "plain",
            ]);
            assert_eq!(plain["arithmetic"], "plain");
            assert_eq!(plain["accuracy"], serde_json::Value::Null);
            // Plain arithmetic may err on a few.
            let inside = |s: &serde_json::Value| s["classes"]["inside"].as_f64().unwrap();
            let difference = (inside(&plain) - inside(&expected)).abs();
            assert!(difference < 20.0, "{name} {precision}: {plain}");
        }
    }
}

#[test]
fn the_table_says_the_same_and_how_to_repeat_it() {
    let run = clip([&fixture("six.csv"), "--frustum", &fixture("pair.json")]);
    let table = text(&run.stdout);
    assert!(run.status.success());
    assert!(run.stderr.is_empty(), "no progress bar without a terminal");
    for line in [
        "segments      6\n",
        "cross                     2   33.33 %\n",
        "algorithm     vw, exact (fast), f64\n",
    ] {
        assert!(table.contains(line), "{line:?} in {table}");
    }
    let chosen = text(&clip([&fixture("six.csv")]).stdout);
    assert!(chosen.contains("view          --eye "), "{chosen}");
    assert!(chosen.contains("(chosen from the scene's extent)"));
}

#[test]
fn what_a_matrix_conversion_misses_is_reported() {
    let folder = Folder::new();
    let file = fixture("six.csv");
    let matrix = |tilt: f64| {
        let content = json!({"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, tilt, -2, -3, 0, 0, -1, 0],
            "layout": "row-major", "depth": "-1..1", "precision": "f32"});
        folder.write("view.json", content.to_string())
    };
    let deviation = |view: &str| {
        let found = statistics(&[&file, "--frustum", view]);
        let deviation = &found["view"]["deviation"];
        ["sides", "near", "far"].map(|key| deviation[key].as_f64().unwrap())
    };
    let [sides, near, far] = deviation(&matrix(0.0));
    assert!(sides == 0.0 && near < 1e-15 && far < 1e-15, "{near} {far}");
    // Near and far not quite parallel to the picture.
    let [sides, near, far] = deviation(&matrix(1e-6));
    assert!(sides == 0.0 && near > 1e-7 && far > 1e-7, "{near} {far}");
    let view = matrix(1e-6);
    let table = text(&clip([&file, "--frustum", &view]).stdout);
    let row = "\ndeviation     from the matrix: sides 0.0e0, near ";
    assert!(table.contains(row), "{table}");
    let pair = statistics(&[&file, "--frustum", &fixture("pair.json")]);
    assert_eq!(pair["view"]["deviation"], Value::Null);
}

#[test]
fn numbers_of_any_size_are_short() {
    let folder = Folder::new();
    let file = folder.write("a.csv", "1e300,0,0,1e300,1,1\n");
    let flags = "--eye 1e300,0,3 --target 1e300,1e-300,0.5 --up 0,1,0 --fovy 30 --aspect 1.5 \
                 --near 1e-200 --far inf";
    let args = [&[file.as_str()], &flags.split(' ').collect::<Vec<_>>()[..]].concat();
    assert_eq!(statistics(&args)["view"]["flags"], flags);
    let wrong = clip(args.iter().map(|a| if *a == "inf" { "-1e300" } else { a }));
    let message = text(&wrong.stderr);
    assert!(
        message.contains("far is -1e300; it must be beyond near, 1e-200"),
        "{message}"
    );
}

#[test]
fn help_tells_formats_examples_and_exit_codes() {
    let help = text(&clip(["--help"]).stdout);
    for part in [
        "Exit codes",
        "Examples",
        "x0,y0,z0,x1,y1,z1",
        "\"slopes\"",
        "column-major",
        "--accuracy",
    ] {
        assert!(help.contains(part), "{part}");
    }
    assert_eq!(clip(["--help"]).status.code(), Some(0));
}
