//! What is said about a run.

use super::{clip, fixture, statistics, text};

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
            "exact_share",
            "file",
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
    // Segments through corners are beyond the floating-point filter.
    assert!(found["stages"]["filter_failures"].as_u64().unwrap() > 0);
    assert!(found["exact_share"].as_f64().unwrap() > 0.0);
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
