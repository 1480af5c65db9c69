//! GeoJSON, as given and on the ellipsoid.

use super::{Folder, WIDE, clip, statistics, text};
use serde_json::json;

/// Every kind of geometry: 2 + 1 + 1 + 3 + 3 + 3 + 1 segments.
fn collection() -> serde_json::Value {
    let ring = json!([[0, 0], [4, 0], [0, 4], [0, 0]]);
    let open = json!([[1, 1], [2, 1], [1, 2]]);
    let geometry = |kind: &str, coordinates: serde_json::Value| json!({"type": kind, "coordinates": coordinates});
    let feature = |geometry: serde_json::Value| json!({"type": "Feature", "properties": {"coordinates": [1, [2]]}, "geometry": geometry});
    json!({
        // A list before the features, which is none of them.
        "bbox": [-10, -10, 10, 10],
        "features": [
            feature(geometry("LineString", json!([[0, 0], [1, 0, 5], [1, 1, 5, 99]]))),
            feature(geometry("MultiLineString", json!([[[0, 0], [1, 0]], [[5, 5]], [[2, 0], [3, 0]]]))),
            feature(json!(null)),
            feature(geometry("Point", json!([7, 7]))),
            feature(geometry("Polygon", json!([ring]))),
            feature(geometry("MultiPolygon", json!([[ring], [open]]))),
            feature(json!({"type": "GeometryCollection", "geometries": [
                geometry("MultiPoint", json!([[7, 7], [8, 8]])),
                geometry("LineString", json!([[9, 9], [9, 8]])),
            ]})),
        ],
        "type": "FeatureCollection",
    })
}

fn rows(folder: &Folder, file: &str) -> Vec<String> {
    let mut args = vec![file];
    args.extend(WIDE);
    folder.rows(&args)
}

#[test]
fn every_kind_of_geometry() {
    let folder = Folder::new();
    let file = folder.write("all.geojson", collection().to_string());
    let rows = rows(&folder, &file);
    assert_eq!(rows.len(), 14);
    assert_eq!(rows[0], "0,inside,0,1,0,0,0,1,0,5,,,");
    assert_eq!(rows[1], "1,inside,0,1,1,0,5,1,1,5,,,");
    // The open ring is closed.
    assert_eq!(rows[12], "12,inside,0,1,1,2,0,1,1,0,,,");
    assert_eq!(rows[13], "13,inside,0,1,9,9,0,9,8,0,,,");
}

#[test]
fn a_sequence_and_single_geometries_give_the_same() {
    let folder = Folder::new();
    let whole = folder.write("all.json", collection().to_string());
    let expected = rows(&folder, &whole);
    let features = collection()["features"].as_array().unwrap().clone();
    // Some writers put a record separator before each text.
    let lines: String = features.iter().map(|f| format!("\x1e{f}\n\n")).collect();
    for name in ["all.geojsonl", "all.geojsons", "all.ndjson"] {
        let sequence = folder.write(name, &lines);
        assert_eq!(rows(&folder, &sequence), expected);
        assert_eq!(statistics(&[&sequence])["format"], "geojsonl");
    }
    let alone = folder.write("one.geojson", features[0]["geometry"].to_string());
    assert_eq!(rows(&folder, &alone), expected[..2]);
    let alone = folder.write("one.geojson", features[0].to_string());
    assert_eq!(rows(&folder, &alone), expected[..2]);
}

#[test]
fn degrees_on_the_ellipsoid() {
    let folder = Folder::new();
    let line = json!({"type": "LineString", "coordinates": [[0, 0], [90, 0], [90, 90, 1000]]});
    let file = folder.write("a.geojson", line.to_string());
    let view = [
        "--eye", "0,0,9e6", "--target", "0,0,0", "--ortho", "2e7", "--near", "1", "--far", "2e7",
    ];
    let rows = folder.rows(&[&[file.as_str(), "--ecef"], &view[..]].concat());
    assert_eq!(rows[0], "0,inside,0,1,6378137,0,0,0,6378137,0,,,");
    assert!(
        rows[1].starts_with("1,inside,0,1,0,6378137,0,0,0,6357752.31424"),
        "{}",
        rows[1]
    );
}

#[test]
fn a_camera_over_the_earth_sees_to_its_horizon() {
    let folder = Folder::new();
    // From 1000 km above (0, 0) the horizon is 30 degrees off: the arc that
    // ends at 29 is all in view, that which ends at 31 is cut, beyond is nothing.
    let arc = |from: f64, to: f64| {
        let points: Vec<_> = (0..=100)
            .map(|i| [from + (to - from) * f64::from(i) / 100.0, 0.0])
            .collect();
        json!({"type": "LineString", "coordinates": points})
    };
    let classes = |from, to| {
        let file = folder.write("a.geojson", arc(from, to).to_string());
        let found = statistics(&[&file, "--ecef", "--over", "0,0,1e6"]);
        ["inside", "cross", "outside"].map(|class| found["classes"][class].as_u64().unwrap())
    };
    assert_eq!(classes(-29.0, 29.0), [100, 0, 0]);
    let [inside, cross, outside] = classes(0.0, 60.0);
    assert_eq!(cross, 1);
    assert!(
        (49..=51).contains(&inside) && inside + outside == 99,
        "{inside} {outside}"
    );
    assert_eq!(classes(31.0, 329.0), [0, 0, 100]);
    let file = folder.name("a.geojson");
    let found = statistics(&[&file, "--ecef", "--over", "10,50,1e6", "--aspect", "2"]);
    let flags = found["view"]["flags"].as_str().unwrap();
    assert_eq!(flags, "--ecef --over 10,50,1000000 --aspect 2");
    let mut again = vec![file.as_str()];
    again.extend(flags.split(' '));
    assert_eq!(statistics(&again)["frustum"], found["frustum"]);
    for (place, part) in [
        ("0,0,0", "the height must be above 0"),
        ("0,0,-5", "the height must be above 0"),
        ("0,95,1e6", "latitude 95"),
        ("0,0,1e300", "finite on the earth's scale"),
    ] {
        let run = clip([file.as_str(), "--ecef", "--over", place]);
        assert_eq!(run.status.code(), Some(2));
        assert!(text(&run.stderr).contains(part), "{}", text(&run.stderr));
    }
    let run = clip([file.as_str(), "--over", "0,0,1e6"]);
    assert!(
        text(&run.stderr).contains("--ecef"),
        "{}",
        text(&run.stderr)
    );
}
