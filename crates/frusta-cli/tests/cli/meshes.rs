//! STL and PLY in, GLB out.

use super::{Folder, WIDE, clip, fixture, statistics, text};
use std::fmt::Write;

/// The corners of a cube's twelve triangles.
fn cube() -> Vec<[[f64; 3]; 3]> {
    let corner = |i: i32| [i & 1, i >> 1 & 1, i >> 2 & 1].map(f64::from);
    QUADS
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .map(|t| t.map(corner))
        .collect()
}

fn stl_text() -> String {
    let mut out = String::from("solid\n");
    for triangle in cube() {
        out += "  facet normal 0 0 1\n    outer loop\n";
        for [x, y, z] in triangle {
            writeln!(out, "      vertex {x} {y} {z}").unwrap();
        }
        out += "    endloop\n  endfacet\n";
    }
    out + "endsolid\n"
}

/// A binary file; its header begins like a text's, as many do.
fn stl_binary() -> Vec<u8> {
    let mut out = b"solid but binary".to_vec();
    out.resize(80, 0);
    out.extend(12_u32.to_le_bytes());
    for triangle in cube() {
        out.extend([0; 12]);
        for coordinate in triangle.as_flattened() {
            out.extend((*coordinate as f32).to_le_bytes());
        }
        out.extend([0; 2]);
    }
    out
}

/// A cube's header; its edges 0-1 and 6-7 are lines, too.
fn ply_header(format: &str) -> String {
    format!(
        "ply\r\nformat {format} 1.0\r\ncomment a cube\r\nMade by hand\r\nelement vertex 8\r\n\
         property float x\r\nproperty float y\r\nproperty uchar red\r\nproperty double z\r\n\
         element face 6\r\nproperty list uchar int vertex_indices\r\nelement edge 2\r\n\
         property ushort vertex1\r\nproperty ushort vertex2\r\nend_header\n"
    )
}

const QUADS: [[i32; 4]; 6] = [
    [0, 1, 3, 2],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 3, 7, 6],
    [0, 2, 6, 4],
    [1, 3, 7, 5],
];

fn ply_text() -> String {
    let mut out = ply_header("ascii");
    for i in 0..8 {
        writeln!(out, "{} {} 255 {}", i & 1, i >> 1 & 1, i >> 2 & 1).unwrap();
    }
    for [a, b, c, d] in QUADS {
        writeln!(out, "4 {a} {b} {c} {d}").unwrap();
    }
    out + "0 1\n6 7\n"
}

fn ply_binary(big: bool) -> Vec<u8> {
    let order = |mut bytes: Vec<u8>| {
        if big {
            bytes.reverse();
        }
        bytes
    };
    let mut out = ply_header(if big {
        "binary_big_endian"
    } else {
        "binary_little_endian"
    })
    .into_bytes();
    for i in 0..8_u8 {
        for k in [0, 1] {
            out.extend(order(f32::from(i >> k & 1).to_le_bytes().to_vec()));
        }
        out.push(255);
        out.extend(order(f64::from(i >> 2).to_le_bytes().to_vec()));
    }
    for quad in QUADS {
        out.push(4);
        for v in quad {
            out.extend(order(v.to_le_bytes().to_vec()));
        }
    }
    for v in [0_u16, 1, 6, 7] {
        out.extend(order(v.to_le_bytes().to_vec()));
    }
    out
}

/// All rows, but for their numbers, in the order of their text.
fn sorted(folder: &Folder, args: &[&str]) -> Vec<String> {
    let mut args = args.to_vec();
    args.extend(WIDE);
    let rows = folder.rows(&args);
    let mut rows: Vec<String> = rows
        .iter()
        .map(|row| row.split_once(',').unwrap().1.to_owned())
        .collect();
    rows.sort();
    rows
}

#[test]
fn stl_text_and_binary_have_the_same_edges() {
    let folder = Folder::new();
    let text = folder.write("text.stl", stl_text());
    let binary = folder.write("binary.stl", stl_binary());
    let rows = sorted(&folder, &[&text]);
    // 12 edges of the cube and a diagonal of each face.
    assert_eq!(rows.len(), 18);
    assert_eq!(rows, sorted(&folder, &[&binary]));
    // The same by another name, capitals, and two solids in a file.
    let twice = stl_text()
        .to_uppercase()
        .replace("FACET NORMAL", "facet normal")
        + &stl_text();
    let other = folder.write("other.bin", twice);
    assert_eq!(rows, sorted(&folder, &[&other, "--from", "stl"]));
    assert_eq!(statistics(&[&text])["format"], "stl");
}

#[test]
fn ply_in_all_encodings_has_the_same_lines_and_edges() {
    let folder = Folder::new();
    let files = [
        folder.write("text.ply", ply_text()),
        folder.write("little.ply", ply_binary(false)),
        folder.write("big.ply", ply_binary(true)),
    ];
    for file in &files {
        assert_eq!(
            sorted(&folder, &[file]),
            ["inside,0,1,0,0,0,1,0,0,,,", "inside,0,1,0,1,1,1,1,1,,,"],
            "lines, by default, in {file}"
        );
        assert_eq!(statistics(&[file])["edges"], "lines");
        let edges = sorted(&folder, &[file, "--edges", "triangles"]);
        assert_eq!(edges.len(), 12);
        assert_eq!(edges, sorted(&folder, &[&files[0], "--edges", "triangles"]));
        assert_eq!(sorted(&folder, &[file, "--edges", "all"]).len(), 14);
    }
    let strips = "ply\nformat ascii 1.0\nelement vertex 4\nproperty int x\nproperty int y\n\
                  property int z\nelement tristrips 1\nproperty list int int vertex_indices\n\
                  end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n\n8 0 1 2 3 -1 0 1 3\n";
    let strips = folder.write("strips.ply", strips);
    // Two triangles, then one that adds the other diagonal.
    assert_eq!(sorted(&folder, &[&strips]).len(), 6);
}

#[test]
fn glb_holds_what_csv_holds() {
    let folder = Folder::new();
    let scene = fixture("6814_ice_tunnelator.glb");
    let glb = folder.name("parts.glb");
    let rows = folder.rows(&[&scene, "--precision", "f32"]);
    let run = clip([&scene, "--precision", "f32", "-o", &glb]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    // Points by class, as they were written.
    let mut expected: Vec<String> = rows
        .iter()
        .filter(|row| !row.contains(",outside,"))
        .map(|row| row.splitn(5, ',').nth(4).unwrap().to_owned())
        .collect();
    expected.sort();
    let far = [
        "--eye", "0,0,1e6", "--target", "0,0,0", "--ortho", "1e6", "--far", "2e6",
    ];
    let back = folder.rows(&[&[glb.as_str()], &far[..]].concat());
    assert_eq!(back.len(), expected.len());
    let mut back: Vec<String> = back
        .iter()
        .map(|row| {
            let fields: Vec<&str> = row.split(',').collect();
            assert_eq!(fields[1], "inside");
            let singles = fields[4..10]
                .iter()
                .map(|f| f.parse::<f64>().unwrap() as f32);
            singles.map(|v| v.to_string()).collect::<Vec<_>>().join(",") + ",,,"
        })
        .collect();
    back.sort();
    let plain = |row: &String| {
        let fields = row
            .split(',')
            .take(6)
            .map(|f| f.parse::<f32>().unwrap().to_string());
        fields.collect::<Vec<_>>().join(",") + ",,,"
    };
    let mut expected: Vec<String> = expected.iter().map(plain).collect();
    expected.sort();
    assert_eq!(back, expected);
}

#[test]
fn glb_of_touches_of_nothing_and_far_away() {
    let folder = Folder::new();
    let glb = folder.name("a.glb");
    let frustum = [
        "--eye", "0,0,5", "--target", "0,0,0", "--near", "1", "--far", "9",
    ];
    let write = |content: &str, view: &[&str]| {
        let file = folder.write("a.csv", content);
        let run = clip([&[file.as_str(), "-o", &glb], view].concat());
        (run.status.code(), text(&run.stderr))
    };
    // A touch is a point, which has no lines to read back.
    let touch = "0,0,4,0,0,9\n0,0,0,0,0,1\n";
    assert_eq!(write(touch, &frustum).0, Some(0));
    assert_eq!(statistics(&[&glb])["segments"], 1);
    assert_eq!(write("0,0,6,0,0,9\n", &frustum).0, Some(0));
    let bytes = std::fs::read(&glb).unwrap();
    assert_eq!(
        bytes.len(),
        u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize
    );
    // Metres on the earth: a millimetre survives single precision.
    let far = [
        "--eye",
        "4e6,0,5e6",
        "--target",
        "4e6,0,4999990",
        "--near",
        "1",
        "--far",
        "20",
    ];
    assert_eq!(
        write("4000000.001,0,4999990,4000000.002,0,4999990\n", &far).0,
        Some(0)
    );
    let wide = [
        "--eye",
        "4e6,0,6e6",
        "--target",
        "4e6,0,0",
        "--ortho",
        "9e6",
        "--far",
        "9e6",
    ];
    let rows = folder.rows(&[&[glb.as_str()], &wide[..]].concat());
    let x: f64 = rows[0].split(',').nth(4).unwrap().parse().unwrap();
    assert!((x - 4_000_000.001).abs() < 1e-6, "{x}");
    // And what single precision cannot hold is said.
    let huge = [
        "--eye",
        "0,0,1e300",
        "--target",
        "0,0,0",
        "--ortho",
        "1e300",
        "--far",
        "1e301",
    ];
    std::fs::remove_file(&glb).unwrap();
    let (code, message) = write("1e299,0,0,2e299,0,0\n", &huge);
    assert_eq!(code, Some(2));
    assert!(message.contains("single precision"), "{message}");
    assert_eq!(folder.files(), ["a.csv", "rows.csv"]);
}
