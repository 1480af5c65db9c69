//! What is read from each format.

use super::{Folder, WIDE, fixture, statistics};
use std::collections::BTreeSet;

/// The segments of a file that the wide view takes in unclipped.
fn segments(file: &str, more: &[&str]) -> Vec<[f64; 6]> {
    let folder = Folder::new();
    let mut args = vec![file];
    args.extend(WIDE);
    args.extend(more);
    folder
        .rows(&args)
        .iter()
        .map(|row| {
            let fields: Vec<&str> = row.split(',').collect();
            assert_eq!(fields[1], "inside", "{row}");
            std::array::from_fn(|i| fields[4 + i].parse().unwrap())
        })
        .collect()
}

#[test]
fn a_mesh_is_read_once_and_stands_where_its_nodes_put_it() {
    let edges = segments(&fixture("cubes.gltf"), &[]);
    assert_eq!(edges.len(), 24);
    let corners = |edges: &[[f64; 6]]| -> BTreeSet<String> {
        let ends = edges
            .iter()
            .flat_map(|e| [[e[0], e[1], e[2]], [e[3], e[4], e[5]]]);
        // The turn's sine and cosine are rounded to f32 in the file.
        ends.map(|p| format!("{:.3?}", p.map(|c| c + 0.0)))
            .collect()
    };
    let cube = |centre: [f64; 3], half: [f64; 3]| -> BTreeSet<String> {
        let sign = |i: usize, k: usize| if i >> k & 1 == 0 { -1.0 } else { 1.0 };
        (0..8)
            .map(|i| {
                let p: [f64; 3] = std::array::from_fn(|k| centre[k] + sign(i, k) * half[k]);
                format!("{p:.3?}")
            })
            .collect()
    };
    // Scaled by 2 in x, then turned a quarter about z, then moved.
    assert_eq!(
        corners(&edges[..12]),
        cube([10.0, 0.0, 0.0], [1.0, 2.0, 1.0])
    );
    assert_eq!(
        corners(&edges[12..]),
        cube([10.0, 5.0, 0.0], [1.0, 1.0, 1.0])
    );
}

#[test]
fn all_primitive_modes_and_accessors_of_gltf() {
    let file = fixture("modes.gltf");
    let lines = segments(&file, &[]);
    // Mode 1: 3 pairs; mode 2: 6 and back; mode 3: 5; mode 3, sparse: 2.
    assert_eq!(lines.len(), 3 + 6 + 5 + 2);
    assert_eq!(lines[1], [1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    assert_eq!(lines[8], [0.0, -1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(
        lines[14..],
        [
            [5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 5.0, 0.0]
        ]
    );

    // Of all triangles, each edge once: 6 of the two triangles, and what the
    // strip and the fan add to them. Points 0..5.
    let pair = |a: u8, b: u8| (a.min(b), a.max(b));
    let mut expected = BTreeSet::new();
    let mut triangle = |a, b, c| expected.extend([pair(a, b), pair(b, c), pair(c, a)]);
    triangle(0, 1, 2);
    triangle(3, 4, 5);
    (0..4).for_each(|i| triangle(i, i + 1, i + 2));
    (1..5).for_each(|i| triangle(0, i, i + 1));
    let triangles = segments(&file, &["--edges", "triangles"]);
    assert_eq!(triangles.len(), expected.len());
    assert_eq!(
        segments(&file, &["--edges", "all"]).len(),
        16 + expected.len()
    );
}

#[test]
fn obj_lines_polylines_and_polygons() {
    let file = fixture("shapes.obj");
    let lines = segments(&file, &[]);
    assert_eq!(
        lines,
        [
            [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0, 1.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0, 1.0, 1.0, 0.0],
        ]
    );
    // The square's outline, without the diagonal of a triangulation.
    assert_eq!(segments(&file, &["--edges", "triangles"]).len(), 4);
    assert_eq!(segments(&file, &["--edges", "all"]).len(), 7);
}

#[test]
fn a_binary_assembly_gives_lines_or_triangle_edges() {
    let file = fixture("6814_ice_tunnelator.glb");
    let lines = statistics(&[&file]);
    assert_eq!(lines["segments"], 10_901);
    assert_eq!(lines["edges"], "lines");
    let triangles = statistics(&[&file, "--edges", "triangles"]);
    let all = statistics(&[&file, "--edges", "all"]);
    let count = |s: &serde_json::Value| s["segments"].as_u64().unwrap();
    // A closed mesh has 3/2 edges a triangle; 25,544 triangles, some open.
    assert!((38_316..76_632).contains(&count(&triangles)), "{triangles}");
    assert_eq!(count(&all), count(&lines) + count(&triangles));
}

#[test]
fn csv_with_and_without_header_decimal_and_hexadecimal() {
    let folder = Folder::new();
    let plain = folder.write(
        "plain.csv",
        "1,2,3,0x1p2,-0X1.4p2,6e0\n\n# note\n 7 ,8,9,10,11,\"12\"\n",
    );
    let expected = [
        [1.0, 2.0, 3.0, 4.0, -5.0, 6.0],
        [7.0, 8.0, 9.0, 10.0, 11.0, 12.0],
    ];
    assert_eq!(segments(&plain, &[]), expected);
    let named = folder.write(
        "named.csv",
        "\u{feff}name,z1,y1,x1,z0,y0,x0\r\na,6,-5,4,3,2,1\r\nb,12,11,10,9,8,7",
    );
    assert_eq!(segments(&named, &[]), expected);
}

#[test]
fn an_empty_list_is_no_error_and_gives_an_empty_list() {
    let folder = Folder::new();
    for content in ["x0,y0,z0,x1,y1,z1\n", "# nothing\n", "\n"] {
        let file = folder.write("none.csv", content);
        assert_eq!(folder.rows(&[&file]), Vec::<String>::new());
    }
}

#[test]
fn single_precision_rounds_coordinates_once() {
    let folder = Folder::new();
    // Halfway between two singles but for the last digit: rounding to double
    // first would lose it and round to even.
    let file = folder.write(
        "a.csv",
        "1.00000005960464477540,0,0,1.000000059604644775390625,0.1,1\n",
    );
    let mut args = vec![file.as_str(), "--precision", "f32"];
    args.extend(WIDE);
    assert_eq!(
        folder.rows(&args),
        ["0,inside,0,1,1.0000001,0,0,1,0.1,1,,,"]
    );
}
