//! Where the frustum comes from.

use super::{Folder, clip, fixture, statistics, text};
use frusta::Frustum;
use serde_json::{Value, json};

/// The rows of `six.csv` in the frustum of a file.
fn rows(content: &Value) -> Vec<String> {
    let folder = Folder::new();
    let view = folder.write("view.json", content.to_string());
    folder.rows(&[&fixture("six.csv"), "--frustum", &view])
}

/// The rows of `six.csv` in the frustum of `infinite.json`.
fn infinite_rows() -> Vec<String> {
    let folder = Folder::new();
    folder.rows(&[&fixture("six.csv"), "--frustum", &fixture("infinite.json")])
}

#[test]
fn an_infinite_frustum_has_no_far_face() {
    let rows = infinite_rows();
    assert_eq!(rows[1], "1,cross,0.375,0.625,-2,0,-2,2,0,-2,left,right,");
    assert_eq!(rows[5], "5,cross,0.25,1,0,0,-1,0,0,-4,near,,");
}

#[test]
fn a_camera_by_file_and_by_flags_is_the_same() {
    let file = statistics(&[&fixture("six.csv"), "--frustum", &fixture("camera.json")]);
    let flags = statistics(&[
        &fixture("six.csv"),
        "--eye",
        "0,0,0",
        "--target",
        "0,0,-1",
        "--up",
        "0,1,0",
        "--fovy",
        "90",
        "--aspect",
        "1",
        "--near",
        "1",
        "--far",
        "inf",
    ]);
    assert_eq!(file["frustum"], flags["frustum"]);
    assert_eq!(file["classes"], flags["classes"]);
    assert_eq!(file["frustum"]["direction"], json!(1));
}

#[test]
fn the_statistics_hold_a_frustum_that_reads_back() {
    let off_axis = json!({"matrix": [1, 0, 0.25, 0, 0, 1, -0.125, 0, 0, 0, -2, -3, 0, 0, -1, 0],
        "layout": "row-major", "depth": "-1..1"});
    let parallel = json!({"eye": [1, 2, 3], "target": [0, 0, 0.1], "up": [0, 1, 0],
        "ortho_height": 7, "aspect": 1.3, "near": -5e-324, "far": 1e300});
    let upwards = json!({"origin": [-0.0, 1e-300, 3], "axes": [[1, 0, 0], [0, -2, 0], [0, 0, 0.1]],
        "near": {"z": 1, "left": -1, "right": 1, "bottom": 0, "top": 0},
        "slopes": {"left": -1, "right": 1, "bottom": -1, "top": 0.5}, "direction": 1});
    let mut views = ["pair.json", "infinite.json", "camera.json"]
        .map(|name| std::fs::read_to_string(fixture(name)).unwrap())
        .to_vec();
    views.extend([off_axis, parallel, upwards].map(|view| view.to_string()));
    let folder = Folder::new();
    for view in views {
        let file = folder.write("view.json", &view);
        let first = statistics(&[&fixture("six.csv"), "--frustum", &file]);
        let again = folder.write("again.json", first["frustum"].to_string());
        let second = statistics(&[&fixture("six.csv"), "--frustum", &again]);
        assert_eq!(first["frustum"], second["frustum"], "{view}");
        // The library's own reader knows the form, too.
        let frustum: Frustum = serde_json::from_value(first["frustum"].clone()).unwrap();
        assert_eq!(serde_json::to_value(&frustum).unwrap(), first["frustum"]);
    }
}

#[test]
fn decimals_in_a_frustum_file_are_correctly_rounded() {
    let folder = Folder::new();
    // A reader that is off by one unit in the last place gets some of these
    // wrong; the two frusta are the same only if none is.
    let decimal = [0.1, 1.7976931348623157e-5, 8.41e-11, 2.2250738585072014e-8];
    let view = |numbers: [Value; 4]| {
        let [a, b, c, d] = numbers;
        json!({"origin": [a, b, c], "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            "near": {"z": 0, "left": -1, "right": 1, "bottom": -1, "top": d},
            "far": {"z": 1, "left": -1, "right": 1, "bottom": -1, "top": 1}})
    };
    let frusta = [
        view(decimal.map(|v| json!(v))),
        view(decimal.map(|v| json!(frusta::math::hex::format(v)))),
    ]
    .map(|content| {
        let file = folder.write("view.json", content.to_string());
        statistics(&[&fixture("six.csv"), "--frustum", &file])["frustum"].clone()
    });
    assert_eq!(frusta[0], frusta[1]);
    assert_eq!(frusta[0]["origin"][1], 1.7976931348623157e-5);
}

#[test]
fn matrices_of_both_layouts_and_depths() {
    // OpenGL, 90 degrees, near 1, far 3; and the same for depth 0..1.
    let gl = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -2, -3], [0, 0, -1, 0]].map(|r| r.map(f64::from));
    let d3d = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, -1.5, -1.5],
        [0.0, 0.0, -1.0, 0.0],
    ];
    let reversed = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.5, 1.5],
        [0.0, 0.0, -1.0, 0.0],
    ];
    let columns = |m: [[f64; 4]; 4]| -> [[f64; 4]; 4] { std::array::from_fn(|i| m.map(|r| r[i])) };
    let expected = rows(
        &serde_json::from_str(&std::fs::read_to_string(fixture("pair.json")).unwrap()).unwrap(),
    );
    for content in [
        json!({"matrix": gl.as_flattened(), "layout": "row-major", "depth": "-1..1"}),
        json!({"matrix": columns(gl).as_flattened(), "layout": "column-major", "depth": "-1..1", "reversed": false}),
        json!({"matrix": d3d.as_flattened(), "layout": "row-major", "depth": "0..1", "y": "up", "precision": "f32"}),
        json!({"matrix": reversed.as_flattened(), "layout": "row-major", "depth": "0..1", "reversed": true}),
    ] {
        assert_eq!(rows(&content), expected, "{content}");
    }
}

#[test]
fn the_chosen_camera_takes_in_a_part_and_can_be_repeated() {
    let file = fixture("6814_ice_tunnelator.glb");
    for up in ["0,1,0", "0,-1,0", "0,0,1", "1,0,0"] {
        let chosen = statistics(&[&file, "--up", up]);
        assert_eq!(chosen["view"]["chosen"], true);
        for class in ["inside", "outside", "cross"] {
            assert!(
                chosen["classes"][class].as_u64().unwrap() > 0,
                "{up} {class}: {chosen}"
            );
        }
        let flags = chosen["view"]["flags"].as_str().unwrap();
        let mut args = vec![file.as_str()];
        args.extend(flags.split(' '));
        let again = statistics(&args);
        assert_eq!(again["view"]["chosen"], false);
        assert_eq!(again["frustum"], chosen["frustum"]);
        assert_eq!(again["classes"], chosen["classes"]);
    }
}

#[test]
fn a_camera_is_chosen_for_scenes_of_any_size() {
    let folder = Folder::new();
    for content in [
        "5,5,5,5,5,5\n",
        "0,0,0,0,0,0\n",
        "1e-200,0,0,0,1e-200,0\n",
        "1e150,0,0,0,-1e150,3\n",
        "1e15,0,0,1000000000000000.5,0,0.001\n",
        "1e300,0,0,-1e300,0,0\n",
    ] {
        let file = folder.write("a.csv", content);
        let found = clip([file.as_str(), "--json"]);
        let message = text(&found.stderr);
        assert!(found.status.success(), "{content}: {message}");
    }
    // Its extent is beyond the range of doubles: an error that says what to do.
    let file = folder.write("a.csv", "1.7e308,0,0,-1.7e308,0,0\n");
    let found = clip([file.as_str()]);
    assert_eq!(found.status.code(), Some(2));
    assert!(text(&found.stderr).contains("give --eye and --target"));
}

#[test]
fn numbers_of_the_lens_are_told_as_they_were_given() {
    for (flags, part) in [
        (
            ["--fovy", "200"],
            "--fovy is 200; it must be between 0 and 180",
        ),
        (["--fovy", "0"], "--fovy is 0; it must be"),
        (["--fovy", "-3"], "--fovy is -3; it must be"),
        (["--ortho", "-3"], "height is -3; it must be"),
        (["--aspect", "-3"], "aspect is -3; it must be"),
    ] {
        let run = clip([fixture("six.csv").as_str()].into_iter().chain(flags));
        assert_eq!(run.status.code(), Some(2), "{flags:?}");
        let message = text(&run.stderr);
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains(part), "{message}");
    }
}
