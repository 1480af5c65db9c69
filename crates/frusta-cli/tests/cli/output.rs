//! The output files.

use super::{Folder, clip, fixture, random_segments, text};
use frusta::{Accuracy, EndRect, Frustum, Pose, Real, Shape};
use std::str::FromStr;

/// The frustum of `pair.json`.
fn frustum() -> Frustum {
    let end = |z: f64| EndRect::new(z, z, -z, z, -z);
    let shape = Shape::Finite {
        near: end(-1.0),
        far: end(-3.0),
    };
    Frustum::new(Pose::IDENTITY, shape).unwrap()
}

#[test]
fn rows_of_each_class_to_the_letter() {
    let folder = Folder::new();
    let rows = folder.rows(&[&fixture("six.csv"), "--frustum", &fixture("pair.json")]);
    assert_eq!(
        rows,
        [
            "0,inside,0,1,0,0,-2,0.5,0.5,-2,,,",
            "1,cross,0.375,0.625,-2,0,-2,2,0,-2,left,right,",
            "2,outside,,,,,,,,,,,",
            "3,touch,0.5,0.5,2,2,-2,2,2,-2,right+top,right+top,",
            "4,boundary,0,1,-0.5,0,-1,0.5,0,-1,near,near,near",
            "5,cross,0.25,0.75,0,0,-1,0,0,-3,near,far,",
        ]
    );
}

#[test]
fn obj_lines_and_points() {
    let folder = Folder::new();
    let out = folder.name("parts.obj");
    let run = clip([
        &fixture("six.csv"),
        "--frustum",
        &fixture("pair.json"),
        "-o",
        &out,
    ]);
    assert!(run.status.success());
    assert_eq!(
        folder.read("parts.obj"),
        "# parts of segments inside a view frustum\n\
         v 0 0 -2\nv 0.5 0.5 -2\nl -2 -1\nv -2 0 -2\nv 2 0 -2\nl -2 -1\nv 2 2 -2\np -1\n\
         v -0.5 0 -1\nv 0.5 0 -1\nl -2 -1\nv 0 0 -1\nv 0 0 -3\nl -2 -1\n"
    );
    // What was written can be read again.
    let rows = folder.rows(&[&out, "--frustum", &fixture("pair.json")]);
    assert_eq!(rows.len(), 4);
    assert!(rows.iter().all(|row| !row.contains("outside")), "{rows:?}");
}

/// What is read back from a row has the bits that the library computes.
fn round_trip<T: Real + FromStr>(precision: &str, accuracy: Accuracy, name: &str)
where
    T::Err: std::fmt::Debug,
{
    let folder = Folder::new();
    let segments = random_segments::<T>(10_000);
    let mut csv = String::new();
    for s in &segments {
        let [a, b] = [s.start, s.end];
        csv += &format!("{},{},{},{},{},{}\n", a.x, a.y, a.z, b.x, b.y, b.z);
    }
    let file = folder.write("random.csv", csv);
    let pair = fixture("pair.json");
    let rows = folder.rows(&[
        &file,
        "--frustum",
        &pair,
        "--precision",
        precision,
        "--accuracy",
        name,
    ]);
    assert_eq!(rows.len(), segments.len());
    let (frustum, mut parts) = (frustum(), 0);
    for (i, (segment, row)) in segments.iter().zip(&rows).enumerate() {
        let fields: Vec<&str> = row.split(',').collect();
        let clip = frustum.clip_segment_with(segment, accuracy).unwrap();
        assert_eq!(fields[..2], [i.to_string().as_str(), clip.class.name()]);
        let Some(part) = clip.part else {
            assert!(fields[2..].iter().all(|f| f.is_empty()), "{row}");
            continue;
        };
        parts += 1;
        let (a, b) = (part.entry.point, part.exit.point);
        let expected = [part.entry.t, part.exit.t, a.x, a.y, a.z, b.x, b.y, b.z];
        for (field, value) in fields[2..10].iter().zip(expected) {
            let read: T = field.parse().unwrap();
            assert_eq!(read.to_f64().to_bits(), value.to_f64().to_bits(), "{row}");
        }
        let sets = [part.entry.faces, part.exit.faces, part.coplanar];
        assert_eq!(fields[10..], sets.map(|s| s.to_string()));
    }
    assert!(parts > 1000, "{parts}");
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    round_trip::<f64>("f64", Accuracy::Fast, "fast");
    round_trip::<f64>("f64", Accuracy::Nearest, "nearest");
    round_trip::<f32>("f32", Accuracy::Inward, "inward");
}

#[test]
fn the_number_of_threads_does_not_show() {
    let folder = Folder::new();
    let rows: String = (0..20_000)
        .map(|i| format!("{},{},-3,{},1,{}\n", i % 17, i % 11, i % 13, i % 23))
        .collect();
    let points: Vec<String> = (0..20_000)
        .map(|i| format!("[{}, {}]", i % 17, i % 11))
        .collect();
    let line = format!(
        "{{\"type\": \"LineString\", \"coordinates\": [{}]}}",
        points.join(",")
    );
    let files = [
        fixture("6814_ice_tunnelator.glb"),
        folder.write("rows.csv", rows),
        folder.write("line.geojson", line),
    ];
    for file in &files {
        for extension in ["csv", "obj", "glb", "svg"] {
            let contents = ["1", "2", "5"].map(|threads| {
                let out = folder.name(&format!("out.{extension}"));
                let run = clip([file, "--threads", threads, "-o", &out]);
                assert!(run.status.success(), "{}", text(&run.stderr));
                std::fs::read(out).unwrap()
            });
            assert!(contents[0].len() > 10_000);
            assert!(contents.iter().all(|c| *c == contents[0]), "{extension}");
        }
    }
}

#[test]
fn a_failure_leaves_the_old_file_and_nothing_else() {
    let folder = Folder::new();
    let good = "0,0,0,1,1,1\n".repeat(20_000);
    let file = folder.write("torn.csv", format!("{good}0,0,0\n"));
    let out = folder.write("out.csv", "old");
    let run = clip([&file, "-o", &out, "--frustum", &fixture("pair.json")]);
    assert_eq!(run.status.code(), Some(2));
    assert_eq!(folder.read("out.csv"), "old");
    assert_eq!(folder.files(), ["out.csv", "torn.csv"]);
    // And a success replaces it.
    let file = folder.write("torn.csv", good);
    assert!(clip([&file, "-o", &out]).status.success());
    assert_eq!(folder.read("out.csv").lines().count(), 20_001);
    assert_eq!(folder.files(), ["out.csv", "torn.csv"]);
}

#[cfg(unix)]
#[test]
fn a_written_file_has_the_usual_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let file = folder.write("a.csv", "0,0,0,1,1,1\n");
    assert!(
        clip([&file, "-o", &folder.name("out.csv")])
            .status
            .success()
    );
    let mode = |name: &str| folder.path(name).metadata().unwrap().permissions().mode();
    assert_eq!(mode("out.csv"), mode("a.csv"));
}
