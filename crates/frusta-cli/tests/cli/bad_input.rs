//! Files and flags that make no sense: one line, exit code 2, no output.

use super::{Folder, clip, fixture, text};
use serde_json::{Value, json};

/// Runs the command in a folder; the failure must be one line with the parts.
fn refuse(folder: &Folder, args: &[&str], parts: &[&str]) {
    let before = folder.files();
    let out = folder.name("out.csv");
    let run = clip(args.iter().copied().chain(["-o", &out]));
    let message = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2), "{args:?}: {message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.starts_with("frusta: "), "{message}");
    for part in parts {
        assert!(message.contains(part), "{part:?} in {message:?}");
    }
    assert!(run.stdout.is_empty());
    assert_eq!(folder.files(), before);
}

/// Refuses a file of this content.
fn refuse_file(name: &str, content: impl AsRef<[u8]>, parts: &[&str]) {
    let folder = Folder::new();
    let file = folder.write(name, content);
    refuse(&folder, &[&file], &[&[name], parts].concat());
}

#[test]
fn csv() {
    for (content, parts) in [
        (
            "1,2,3,4,5\n",
            ["line 1", "5 fields; without a header a row has six"],
        ),
        (
            "1,2,3,4,5,6\n1,2,3,4,5,6,7\n",
            ["line 2", "7 fields; the rows before have 6"],
        ),
        (
            "1,2,3,4,5,6\n\n1,2,3,4,5,\n",
            ["line 3", "z1: \"\" is not a number"],
        ),
        (
            "1,2,3,4,5,6\n1,2,3,4,5,6m\n",
            ["line 2", "z1: \"6m\" is not a number"],
        ),
        ("1,2,nan,4,5,6\n", ["line 1", "z0: NaN; it must be finite"]),
        ("1,2,3,-inf,5,6\n", ["line 1", "x1: \"-inf\" is infinite"]),
        (
            "1,2,3,4,1e999,6\n",
            ["line 1", "y1: \"1e999\" is infinite in f64"],
        ),
        (
            "1,2,3,4,5,0x1.00000000000001p0\n",
            ["line 1", "z1: no f64 equals"],
        ),
        ("x0,y0,z0,x1,y1\n1,2,3,4,5\n", ["line 1", "the column z1"]),
        (
            "PK\u{3}\u{4}\u{1b}[31m zip\n",
            ["line 1", "neither six numbers nor a header"],
        ),
        (
            "1,2,3,4,5,6\n1,2,3,\"4,5,6\n",
            ["line 2", "a quoted field goes on over the line's end"],
        ),
    ] {
        refuse_file("a.csv", content, &parts);
    }
    refuse_file("a.csv", "", &["the file is empty"]);
    refuse_file("a.csv", b"1,2,3,4,5,\xff\xfe\n", &["line 1", "z1"]);
    refuse_file("a.csv", vec![0; 100_000], &["line 1"]);
    let folder = Folder::new();
    let file = folder.write("a.csv", "1,2,3,4,1e39,6\n");
    refuse(
        &folder,
        &[&file, "--precision", "f32"],
        &["line 1", "infinite in f32"],
    );
}

#[test]
fn obj() {
    for (content, parts) in [
        ("", ["the file is empty", ""]),
        ("v 0 0 0\nv 1 1 1\n", ["no triangles", ""]),
        ("v 0 0\nl 1 1\n", ["line 1", "z is missing"]),
        ("v 0 0 0\nv 1 1 1\nl 1 3\n", ["line 3", "vertex 3 of 2"]),
        (
            "v 0 0 0\nv 1 1 1\nl -3 1\n",
            ["line 3", "vertex -3 of 2 so far"],
        ),
        ("v 0 0 0\nl 0 1\n", ["line 2", "indices start at 1"]),
        ("v 0 0 inf\n", ["line 1", "must be finite"]),
        ("v 0 0 0\nf 1 1 4294967297\n", ["line 2", "4294967297"]),
    ] {
        refuse_file("a.obj", content, &parts);
    }
    refuse_file("a.obj", b"v \xff 0 0\n", &["line 1", "UTF-8"]);
}

/// The document of `cubes.gltf` with a change at a JSON pointer.
fn changed(pointer: &str, value: Value) -> String {
    let mut document: Value =
        serde_json::from_str(&std::fs::read_to_string(fixture("cubes.gltf")).unwrap()).unwrap();
    *document.pointer_mut(pointer).expect(pointer) = value;
    document.to_string()
}

#[test]
fn gltf_documents() {
    for (pointer, value, part) in [
        (
            "/nodes/1",
            json!({"children": [0]}),
            "node 0 is in the scene twice",
        ),
        (
            "/nodes/0/children",
            json!([1, 1]),
            "node 1 is in the scene twice",
        ),
        ("/nodes/1/mesh", json!(7), "nodes[1].mesh"),
        ("/nodes/1/scale", json!([1e39, 1, 1]), "number out of range"),
        ("/meshes/0/primitives/0/mode", json!(9), "mode"),
        (
            "/meshes/0/primitives/0/attributes",
            json!({"NORMAL": 0}),
            "attributes[\"POSITION\"]: Missing data",
        ),
        (
            "/meshes/0/primitives/0/attributes",
            json!({"POSITION": 2}),
            "meshes[0].primitives[0].attributes[\"POSITION\"]: accessor 2 of 2",
        ),
        (
            "/accessors/0/type",
            json!("VEC2"),
            "accessor 0: POSITION must be VEC3",
        ),
        (
            "/meshes/0/primitives/0/indices",
            json!(0),
            "accessor 0: indices must be unsigned",
        ),
        (
            "/accessors/0/count",
            json!(9),
            "9 elements from byte 0 do not fit buffer view 0 of 96 bytes",
        ),
        ("/accessors/0/count", json!(u64::MAX), "points are too many"),
        ("/accessors/0/count", json!(7), "asks for vertex 7 of 7"),
        (
            "/accessors/1/count",
            json!(4_294_967_295_u32),
            "do not fit buffer view 1",
        ),
        (
            "/accessors/0/bufferView",
            json!(12),
            "accessors[0].bufferView",
        ),
        (
            "/bufferViews/0/byteLength",
            json!(1_u64 << 40),
            "buffer view 0 reaches beyond the end",
        ),
        (
            "/bufferViews/0/byteOffset",
            json!(u64::MAX),
            "buffer view 0 reaches beyond the end",
        ),
        (
            "/buffers/0/byteLength",
            json!(1_000_000),
            "byteLength is 1000000; there are 120 bytes",
        ),
        (
            "/buffers/0/uri",
            json!("data:;base64,A"),
            "buffer 0: its data URI",
        ),
        (
            "/buffers/0/uri",
            json!("no such file.bin"),
            "no such file.bin",
        ),
        (
            "/buffers/0/uri",
            json!("https://example.org/a.bin"),
            "its uri is not a file",
        ),
        (
            "/asset",
            json!({"version": "2.0", "extensions": 5}),
            "not glTF",
        ),
        ("/scenes", json!([]), "scene"),
    ] {
        refuse_file("a.gltf", changed(pointer, value), &[part]);
    }
    let zeros = json!({"componentType": 5126, "count": 4_000_000_000_u32, "type": "VEC3",
        "min": [0, 0, 0], "max": [0, 0, 0], "sparse": {"count": 0,
        "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}});
    refuse_file(
        "a.gltf",
        changed("/accessors/0", zeros),
        &["without a buffer view"],
    );
    // 3e38 to the tenth is beyond the range of doubles.
    let chain: Vec<Value> = (1..=10)
        .map(|child| json!({"scale": [3e38, 3e38, 3e38], "children": [child]}))
        .chain([json!({"mesh": 0})])
        .collect();
    refuse_file(
        "a.gltf",
        changed("/nodes", json!(chain)),
        &["its transform is not finite"],
    );
    refuse_file("a.gltf", "", &["the file is empty"]);
    refuse_file(
        "a.gltf",
        "{\"asset\": {\"version\": \"2.0\"}}",
        &["no triangles"],
    );
    refuse_file("a.gltf", "[1, 2", &["not glTF", "begins neither"]);
    refuse_file("a.gltf", "{\"a\": 2", &["not glTF", "line 1"]);
}

#[test]
fn gltf_with_a_coordinate_that_is_no_number() {
    let folder = Folder::new();
    let mut document: Value =
        serde_json::from_str(&std::fs::read_to_string(fixture("modes.gltf")).unwrap()).unwrap();
    document["buffers"][0]["uri"] = json!("a.bin");
    let mut bytes = std::fs::read(fixture("modes buffer.bin")).unwrap();
    let last = bytes.len() - 4;
    bytes[last..].copy_from_slice(&f32::NAN.to_le_bytes());
    folder.write("a.bin", bytes);
    let file = folder.write("a.gltf", document.to_string());
    refuse(
        &folder,
        &[&file],
        &["mesh 0: primitive 7: accessor 1: point 2 is", "NaN"],
    );
}

#[test]
fn gltf_with_far_instances_in_single_precision() {
    let folder = Folder::new();
    let file = folder.write(
        "a.gltf",
        changed("/nodes/2/matrix/12", json!(3e38)).replace("[10,0,0]", "[3e38,0,0]"),
    );
    let args = [
        file.as_str(),
        "--precision",
        "f32",
        "--eye",
        "0,0,9",
        "--target",
        "0,0,0",
    ];
    refuse(&folder, &args, &["node 2, edge 0", "must be finite"]);
}

#[test]
fn truncated_and_lying_binaries() {
    let whole = std::fs::read(fixture("6814_ice_tunnelator.glb")).unwrap();
    for length in [4, 8, 11, 12, 19, 20, 1000, whole.len() - 1] {
        refuse_file("a.glb", &whole[..length], &["byte"]);
    }
    let with = |at: usize, value: u32| {
        let mut bytes = whole.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    refuse_file("a.glb", with(4, 1), &["byte 4", "GLB version 1"]);
    refuse_file("a.glb", with(8, 5), &["byte 12", "JSON chunk"]);
    refuse_file(
        "a.glb",
        with(8, u32::MAX),
        &["byte 8", "the header gives 4294967295 bytes"],
    );
    refuse_file(
        "a.glb",
        with(12, u32::MAX),
        &["byte 12", "the JSON chunk gives"],
    );
    refuse_file(
        "a.glb",
        with(12, 8),
        &["the JSON chunk's EOF while parsing"],
    );
    let json = u32::from_le_bytes(whole[12..16].try_into().unwrap()) as usize;
    let kind = 20 + json + 4;
    let place = format!("byte {kind}");
    refuse_file("a.glb", with(kind, 0), &[&place, "expected a BIN chunk"]);
    refuse_file(
        "a.glb",
        with(kind - 4, u32::MAX),
        &["the BIN chunk gives 4294967295 bytes"],
    );
    refuse_file("a.glb", with(16, 0), &["byte 16", "expected a JSON chunk"]);
}

#[test]
fn frustum_files() {
    let pair: Value =
        serde_json::from_str(&std::fs::read_to_string(fixture("pair.json")).unwrap()).unwrap();
    let camera: Value =
        serde_json::from_str(&std::fs::read_to_string(fixture("camera.json")).unwrap()).unwrap();
    let put = |base: &Value, key: &str, value: Value| {
        let mut changed = base.clone();
        changed[key] = value;
        changed.to_string()
    };
    let drop = |base: &Value, key: &str| {
        let mut changed = base.clone();
        changed.as_object_mut().unwrap().remove(key);
        changed.to_string()
    };
    for (content, part) in [
        (String::new(), "not JSON"),
        (
            "[1, 2, 3]".to_owned(),
            "found an array of 3; expected an object with origin",
        ),
        ("{}".to_owned(), "expected an object with origin"),
        (
            drop(&pair, "far"),
            "far is missing; expected an object with left",
        ),
        (
            put(&pair, "colour", json!(1)),
            "unknown key \"colour\"; expected origin, axes, near, far",
        ),
        (
            put(&pair, "origin", json!([0, 0])),
            "origin: found an array of 2; expected 3 numbers",
        ),
        (
            put(&pair, "origin", json!([0, true, 0])),
            "origin[1]: found true; expected a number",
        ),
        (
            put(&pair, "origin", json!([0, "0x1g", 0])),
            "origin[1]: \"0x1g\" is not a number",
        ),
        (
            put(&pair, "axes", json!([[1, 0, 0], [0, 1, 0], [1, 1, 0]])),
            "linearly dependent",
        ),
        (
            put(&pair, "axes", json!([[1, 0, 0], 5, [1, 1, 0]])),
            "axes[1]: found 5; expected 3 numbers",
        ),
        (
            put(
                &pair,
                "near",
                json!({"z": 0, "left": 0, "right": 1, "bottom": 0}),
            ),
            "near.top is missing",
        ),
        (
            put(&pair, "near", json!({"z": 0, "w": 0})),
            "unknown key \"near.w\"",
        ),
        (put(&pair, "far", pair["near"].clone()), "must differ"),
        (
            put(&pair, "direction", json!(1)),
            "unknown key \"far\"; expected origin, axes, near, slopes",
        ),
        (drop(&camera, "fovy_deg"), "fovy_deg is missing"),
        (put(&camera, "ortho_height", json!(2)), "exclude each other"),
        (
            put(&camera, "far", json!("never")),
            "far: \"never\" is not a number",
        ),
        (put(&camera, "target", camera["eye"].clone()), "view.json"),
        (put(&camera, "fovy_deg", json!(180)), "view.json"),
        (
            json!({"matrix": [1, 2], "layout": "row-major", "depth": "0..1"}).to_string(),
            "matrix: found an array of 2; expected 16 numbers",
        ),
        (
            json!({"matrix": vec![0; 16], "layout": "rows", "depth": "0..1"}).to_string(),
            "layout: found \"rows\"; expected \"column-major\" or \"row-major\"",
        ),
        (
            json!({"matrix": vec![0; 16], "layout": "row-major", "depth": "0..1"}).to_string(),
            "matrix: ",
        ),
    ] {
        let folder = Folder::new();
        let view = folder.write("view.json", content);
        refuse(
            &folder,
            &[&fixture("six.csv"), "--frustum", &view],
            &["view.json", part],
        );
    }
}

#[test]
fn files_and_flags() {
    let folder = Folder::new();
    let csv = fixture("six.csv");
    refuse(
        &folder,
        &[&folder.name("none.glb")],
        &["none.glb", "No such file"],
    );
    refuse(
        &folder,
        &[&folder.name("none.csv")],
        &["none.csv", "No such file"],
    );
    refuse(
        &folder,
        &[&folder.name("a.step")],
        &["a.step", "expected .gltf .glb .obj .stl", "--from"],
    );
    refuse(
        &folder,
        &[&csv, "--edges", "lines"],
        &["--edges is for meshes"],
    );
    let lines = fixture("6814_ice_tunnelator.glb");
    refuse(
        &folder,
        &[&lines, "--eye", "1,2,3", "--target", "1,2,3"],
        &["--eye and --target are the same point"],
    );
    refuse(
        &folder,
        &[&lines, "--near", "5", "--far", "4"],
        &["--near 5 --far 4"],
    );
    refuse(
        &folder,
        &[&csv, "--arithmetic", "plain", "--accuracy", "fast"],
        &["--accuracy"],
    );
    // Wrong usage has `clap`'s longer message, and the same exit code.
    for wrong in [
        &[csv.as_str(), "--eye", "1,2"][..],
        &[&csv, "--eye", "1,2,nan"],
        &[&csv, "--fovy", "30", "--ortho", "2"],
        &[&csv, "--frustum", "a.json", "--near", "1"],
        &[&csv, "--algorithm", "magic"],
        &[&csv, "--threads", "0"],
        &[],
    ] {
        assert_eq!(clip(wrong).status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn outputs_that_cannot_be_written() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("taken.csv")).unwrap();
    for (name, part) in [
        ("out.gif", "expected .csv, .obj, .glb, .svg or .png"),
        (
            "no/such/folder/out.csv",
            "out.csv: cannot be written: its folder does not exist",
        ),
        ("taken.csv", "it is a folder"),
    ] {
        let run = clip([fixture("six.csv"), "-o".to_owned(), folder.name(name)]);
        let message = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2));
        assert_eq!(message.lines().count(), 1);
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(folder.files(), ["taken.csv"]);
}
