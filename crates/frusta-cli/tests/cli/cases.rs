//! Files of kinds that people have, which were once lost, rounded or too large: each with its
//! relatives.

use super::bad_table::limited;
use super::{Folder, WIDE, clip, fixture, statistics, text};
use serde_json::{Value, json};

/// The number of segments of a file, in a frustum that need not show them.
fn segments(file: &str) -> u64 {
    let found = statistics(&[&[file], &WIDE[..]].concat());
    found["segments"].as_u64().unwrap()
}

/// A facet's words.
fn facet(x: i32) -> String {
    format!(
        "facet normal 0 0 1\nouter loop\nvertex {x} 0 0\nvertex {} 0 0\nvertex {x} 1 0\nendloop\n\
         endfacet\n",
        x + 1
    )
}

#[test]
fn stl_01_a_facet_on_one_line_is_not_lost() {
    let file = fixture("cases/stl-01-facet-on-one-line-lost.stl");
    assert_eq!(segments(&file), 9);
}

#[test]
fn text_stl_has_the_same_edges_in_any_layout() {
    let folder = Folder::new();
    let plain = format!("solid a\n{}{}endsolid a\n", facet(0), facet(5));
    let rows = |content: &str| {
        let file = folder.write("a.stl", content);
        folder.rows(&[&[file.as_str()], &WIDE[..]].concat())
    };
    let expected = rows(&plain);
    assert_eq!(expected.len(), 6);
    let body = plain.replace("\nendsolid", " endsolid");
    let (name, body) = body.split_once('\n').unwrap();
    for other in [
        // All on one line, with and without names.
        plain.replace('\n', " "),
        plain.replace("solid a\n", "solid ").replace('\n', " "),
        // Facets on a line, parts of them joined, a word a line.
        format!(
            "{name}\n{}",
            body.replace('\n', " ").replace("facet n", "\nfacet n")
        ),
        plain.replace("1\nouter loop", "1 outer loop"),
        plain.replace("outer loop\nvertex", "outer loop vertex"),
        plain.replace("0 0\nvertex", "0 0 vertex"),
        plain.replace("0\nendloop\nendfacet", "0 endloop endfacet"),
        format!(
            "{name}\n{}",
            body.replace("endsolid a", "endsolid").replace(' ', "\n")
        ),
        // Coordinates and the normal over several lines, tabs, capitals.
        plain.replace("vertex 0", "vertex\n\t0"),
        plain.replace("normal 0 0 1", "NORMAL\n-nan(ind)\n0\t1"),
        // Two solids, the second on the line of the first one's end.
        plain.replace(&facet(5), &format!("endsolid a solid b {}", facet(5))),
        plain.replace(&facet(5), &format!("endsolid\nsolid\n{}", facet(5))),
        // Names hold any words.
        plain.replace("solid a", "solid facet 1 of a vertex loop"),
        plain.replace("endsolid a", "endsolid a solid body"),
    ] {
        assert_eq!(rows(&other), expected, "{other}");
    }
}

#[test]
fn text_stl_with_words_out_of_place_is_refused() {
    let folder = Folder::new();
    let good = format!("solid a\n{}endsolid a\n", facet(0));
    for (old, new, why) in [
        (
            "outer loop\n",
            "",
            "line 3: found \"vertex\"; expected outer loop",
        ),
        (
            "vertex 1 0 0\n",
            "",
            "line 6: found \"endloop\"; expected a third vertex",
        ),
        (
            "vertex 1 0 0",
            "vertex 1 0",
            "line 6: vertex: z: \"vertex\" is not a number",
        ),
        (
            "vertex 1 0 0",
            "vertex 1 0 0 0",
            "line 5: found \"0\"; expected vertex",
        ),
        (
            "endloop\n",
            "vertex 0 0 0 endloop\n",
            "line 7: found \"vertex\"; expected endloop",
        ),
        (
            "endfacet",
            "endfacet 7",
            "line 8: found \"7\"; expected facet",
        ),
        (
            "endsolid a\n",
            "endsolid a\n7\n",
            "line 10: found \"7\"; expected solid",
        ),
        ("endsolid a\n", "", "the file ends before endsolid"),
    ] {
        let file = folder.write("a.stl", good.replacen(old, new, 1));
        let run = clip([file.as_str()]);
        let message = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{why}: {message}");
        assert!(message.contains(why), "{why:?} in {message:?}");
    }
}

/// The document of a file of cases.
fn document(name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(fixture(name)).unwrap()).unwrap()
}

const ROUNDED: &str = "cases/gltf-13-translation-rounded-to-single.gltf";

/// The coordinates of the first segment, in a frustum about it.
fn first_segment(folder: &Folder, document: &Value) -> Vec<f64> {
    let file = folder.write("a.gltf", document.to_string());
    let view = [
        "--eye",
        "4470000,0,50",
        "--target",
        "4470000,0,0",
        "--ortho",
        "90",
        "--near",
        "0",
        "--far",
        "100",
    ];
    let rows = folder.rows(&[&[file.as_str()], &view[..]].concat());
    assert!(rows[0].starts_with("0,inside,"), "{}", rows[0]);
    let fields = rows[0].split(',').skip(4).take(6);
    fields.map(|field| field.parse().unwrap()).collect()
}

/// 4470000.123 is not an `f32`: the next ones are half a metre apart.
#[test]
fn gltf_13_a_translation_is_read_in_double_precision() {
    let folder = Folder::new();
    let found = first_segment(&folder, &document(ROUNDED));
    assert_eq!(
        found,
        [4_470_000.123, 0.0, 0.0, 4_470_000.123 + 1.0, 0.0, 0.0]
    );
}

#[test]
fn transforms_of_every_kind_are_read_in_double_precision() {
    let folder = Folder::new();
    let x = 4_470_000.123;
    let mut document = document(ROUNDED);
    let matrix = |x: f64| json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1]);
    // What each node does to the origin and to (1, 0, 0), in `f64`.
    for (nodes, ends) in [
        (json!([{"mesh": 0, "matrix": matrix(x)}]), [x, x + 1.0]),
        // Nested: a root far away, its child a millimetre from it.
        (
            json!([{"children": [1], "translation": [4_470_000, 0, 0]},
                {"mesh": 0, "translation": [0.001, 0, 0]}]),
            [4_470_000.001, 4_470_000.0 + 0.001 + 1.0],
        ),
        (
            json!([{"children": [1], "matrix": matrix(x)},
                {"mesh": 0, "translation": [-0.001, 0, 0]}]),
            [x - 0.001, x - 0.001 + 1.0],
        ),
        // A scale by a tenth and a half turn, far away.
        (
            json!([{"mesh": 0, "scale": [0.1, 0.1, 0.1], "translation": [x, 0, 0]}]),
            [x, 0.1 + x],
        ),
        (
            json!([{"mesh": 0, "rotation": [0, 0, 1, 0], "translation": [x, 0, 0]}]),
            [x, x - 1.0],
        ),
        // A child without a transform of its own, and a node that is not in the scene.
        (
            json!([{"children": [2], "translation": [x, 0, 0]}, {"scale": [0.1, 2, 3]},
                {"mesh": 0}]),
            [x, x + 1.0],
        ),
    ] {
        document["nodes"] = nodes;
        let found = first_segment(&folder, &document);
        assert_eq!([found[0], found[3]], ends, "{}", document["nodes"]);
    }
}

const SHARED: &str = "cases/gltf-14-meshes-share-vertices.gltf";

/// The number of segments of a document, read in 200 MB of address space.
fn segments_in_little_memory(document: &Value) -> u64 {
    let folder = Folder::new();
    let file = folder.write("a.gltf", document.to_string());
    let args = [&["clip", &file, "--json"], &WIDE[..]].concat();
    let run = limited(&folder, &args);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let found: Value = serde_json::from_slice(&run.stdout).unwrap();
    found["segments"].as_u64().unwrap()
}

/// Each mesh copied all points of the accessor: 0.95 GB.
#[test]
fn gltf_14_meshes_that_share_an_accessor_take_memory_by_their_indices() {
    assert_eq!(segments_in_little_memory(&document(SHARED)), 6_000);
}

#[test]
fn whatever_meshes_share_takes_memory_once() {
    let shared = document(SHARED);
    let count = shared["meshes"].as_array().unwrap().len();
    assert_eq!(count, 2_000);
    let primitive = |mesh: &Value| mesh["primitives"][0].clone();
    let first = primitive(&shared["meshes"][0]);
    let points = first["attributes"]["POSITION"].as_u64().unwrap() as usize;
    let changed = |change: &dyn Fn(usize, &mut Value)| {
        let mut document = shared.clone();
        for i in 0..count {
            let mut own = primitive(&document["meshes"][i]);
            change(i, &mut own);
            document["meshes"][i]["primitives"][0] = own;
        }
        document
    };
    let copies = |accessor: usize| vec![shared["accessors"][accessor].clone(); count];
    let next = shared["accessors"].as_array().unwrap().len();
    // Indices of its own for each mesh.
    let mut document = changed(&|i, primitive| primitive["indices"] = json!(next + i));
    let indices = first["indices"].as_u64().unwrap() as usize;
    let accessors = document["accessors"].as_array_mut().unwrap();
    accessors.extend(copies(indices));
    assert_eq!(segments_in_little_memory(&document), 6_000);
    // No indices: all points of a shared accessor, of which there are fewer.
    let mut document = shared.clone();
    document["accessors"][points]["count"] = json!(3_000);
    for i in 0..count {
        let primitive = &mut document["meshes"][i]["primitives"][0];
        primitive.as_object_mut().unwrap().remove("indices");
    }
    assert_eq!(segments_in_little_memory(&document), 6_000_000);
    // An accessor a mesh, all of the same view of the buffer.
    let mut document = changed(&|i, primitive| {
        primitive["attributes"]["POSITION"] = json!(next + i);
    });
    let accessors = document["accessors"].as_array_mut().unwrap();
    accessors.extend(copies(points));
    assert_eq!(segments_in_little_memory(&document), 6_000);
    // Several primitives a mesh, whose materials alone differ.
    let mut document = shared.clone();
    document["materials"] = json!([{}, {}]);
    for (i, mesh) in document["meshes"]
        .as_array_mut()
        .unwrap()
        .iter_mut()
        .enumerate()
    {
        let mut second = first.clone();
        second["material"] = json!(i % 2);
        mesh["primitives"].as_array_mut().unwrap().push(second);
    }
    assert_eq!(segments_in_little_memory(&document), 6_000);
}
