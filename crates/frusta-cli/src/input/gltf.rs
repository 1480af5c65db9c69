//! glTF 2.0: line and triangle primitives of the default scene's nodes.
//!
//! The `gltf` crate reads the container and the JSON and checks the JSON's
//! indices. What it trusts, this file checks first, because a lying file would
//! make it panic: the header's length, the node tree (a cycle never ends), and
//! everything about the bytes behind an accessor (in `gltf_data.rs`).
//!
//! Node transforms are read in f32, as the crate stores them, and composed in
//! f64. Skins, morph targets and animations are not applied.

use super::edges::UniqueEdges;
use super::gltf_data::{self, Data};
use super::opened::Input;
use super::scene::{Instance, Mesh, Transform};
use super::{EdgeChoice, Scene, stl};
use crate::failure::{Failure, shorten};
use gltf::json;
use gltf::json::validation::Checked;
use gltf::mesh::Mode;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::collections::HashMap;
use std::io::{BufRead, Read};
use std::path::Path;

/// Extensions that change nothing of what is read here, or that it handles.
const HARMLESS: [&str; 6] = [
    "KHR_mesh_quantization",
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "EXT_texture_",
    "MSFT_texture_",
];

/// Extensions that add geometry; without them the answer would be wrong.
const MISSING: [&str; 1] = ["EXT_mesh_gpu_instancing"];

/// The attribute that holds the points.
pub(super) const POSITIONS: Checked<gltf::Semantic> = Checked::Valid(gltf::Semantic::Positions);

/// Reads a file's edges.
pub(super) fn read(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    read_from(input.name(), input.open()?, input.size(), choice)
}

/// Reads edges from a file's bytes, of which there are `size`, if that is known.
fn read_from(
    file: &Path,
    mut reader: impl BufRead,
    size: Option<u64>,
    choice: Option<EdgeChoice>,
) -> Result<Scene, Failure> {
    let start = reader.fill_buf().map_err(|e| Failure::in_file(file, e))?;
    let (root, blob) = if start.starts_with(b"glTF") {
        glb(file, &mut reader, size)?
    } else if start.trim_ascii_start().starts_with(b"{") {
        let root = document(reader, size).map_err(|e| not_gltf(file, "", &e))?;
        (root, None)
    } else {
        let why = "not glTF: it begins neither with glTF nor with {";
        return Err(Failure::in_file(file, why));
    };
    let root = validated(file, root)?;
    let data = Data::load(file, &root, blob.as_deref())?;
    let placed = place_nodes(&root).map_err(|why| Failure::in_file(file, why))?;
    let kind = choice.unwrap_or_else(|| default_kind(&root, &placed));

    // Each mesh once, in the order in which the tree comes to it.
    let mut wanted = Vec::new();
    let mut numbers = HashMap::new();
    let instances = placed.into_iter().map(|placed| Instance {
        mesh: *numbers.entry(placed.mesh).or_insert_with(|| {
            wanted.push(placed.mesh);
            wanted.len() - 1
        }),
        node: placed.node,
        transform: (placed.transform != Transform::IDENTITY).then_some(placed.transform),
    });
    let instances = instances.collect();
    let read = |&mesh: &usize| {
        let read = read_mesh(&data, &root, mesh, kind);
        read.map_err(|why| Failure::at(file, format_args!("mesh {mesh}"), why))
    };
    // Collected before they are looked at: the first failure is the one told.
    let meshes: Vec<Result<Mesh, Failure>> = wanted.par_iter().map(read).collect();
    let meshes = meshes.into_iter().collect::<Result<_, _>>()?;
    Ok(Scene::new(meshes, instances, kind))
}

/// JSON up to this length is parsed from memory, which is faster.
const SHORT: u64 = 1 << 26;

/// Parses JSON. A long one is not read as a whole first: it could be anything.
fn document(mut reader: impl Read, size: Option<u64>) -> Result<json::Root, json::Error> {
    if size.is_none_or(|size| size > SHORT) {
        return json::deserialize::from_reader(reader);
    }
    let mut text = Vec::new();
    match reader.read_to_end(&mut text) {
        Ok(_) => json::deserialize::from_slice(&text),
        Err(e) => Err(json::Error::io(e)),
    }
}

fn not_gltf(file: &Path, chunk: &str, why: &json::Error) -> Failure {
    Failure::in_file(file, format_args!("not glTF: at {chunk}{}", shorten(why)))
}

/// The JSON, checked.
fn validated(file: &Path, mut root: json::Root) -> Result<json::Root, Failure> {
    root.extensions_required
        .retain(|name| !HARMLESS.iter().any(|known| name.starts_with(known)));
    if let Some(name) = root
        .extensions_used
        .iter()
        .find(|n| MISSING.contains(&n.as_str()))
    {
        return Err(Failure::in_file(
            file,
            format_args!("it uses the extension {name}, which is not supported"),
        ));
    }
    check_positions(&root).map_err(|(place, why)| Failure::at(file, place, why))?;
    let document = gltf::Document::from_json(root).map_err(|e| match e {
        gltf::Error::Validation(found) => match found.first() {
            // A path may end with a text of the file.
            Some((path, why)) => Failure::at(file, shorten(path), why),
            None => Failure::in_file(file, "invalid glTF"),
        },
        other => Failure::in_file(file, other),
    })?;
    Ok(document.into_json())
}

/// The crate's check of positions indexes the accessors before it has checked
/// the index.
fn check_positions(root: &json::Root) -> Result<(), (String, String)> {
    let count = root.accessors.len();
    for (i, mesh) in root.meshes.iter().enumerate() {
        for (k, primitive) in mesh.primitives.iter().enumerate() {
            let positions = primitive.attributes.get(&POSITIONS).map(json::Index::value);
            if let Some(index) = positions.filter(|&index| index >= count) {
                let place = format!("meshes[{i}].primitives[{k}].attributes[\"POSITION\"]");
                return Err((place, format!("accessor {index} of {count}")));
            }
        }
    }
    Ok(())
}

/// The JSON and, if there is one, the binary chunk of a GLB file. Errors of the
/// container name the byte.
fn glb(
    file: &Path,
    reader: &mut impl Read,
    size: Option<u64>,
) -> Result<(json::Root, Option<Vec<u8>>), Failure> {
    let fail = |byte: u64, why: String| Failure::at(file, format_args!("byte {byte}"), why);
    let mut header = [0; 12];
    fill_all(reader, &mut header, 0).map_err(|(at, why)| fail(at, why))?;
    let [_, version, total] = words(&header);
    if version != 2 {
        return Err(fail(4, format!("GLB version {version}; expected 2")));
    }
    let total = u64::from(total);
    if let Some(have) = size.filter(|&have| have < total) {
        let why = format!("the header says {total} bytes; the file has {have}");
        return Err(fail(8, why));
    }
    let length = chunk(reader, 12, total, b"JSON").map_err(|(at, why)| fail(at, why))?;
    let root = document(reader.take(length), Some(length))
        .map_err(|e| not_gltf(file, "the JSON chunk's ", &e))?;
    let at = 20 + length;
    if at + 8 > total {
        return Ok((root, None));
    }
    let length = chunk(reader, at, total, b"BIN\0").map_err(|(at, why)| fail(at, why))?;
    let mut blob = Vec::new();
    let read = reader.take(length).read_to_end(&mut blob);
    let have = read.map_err(|e| fail(at, e.to_string()))? as u64;
    if have < length {
        let why = format!("the BIN chunk says {length} bytes; {have} are left");
        return Err(fail(at, why));
    }
    Ok((root, Some(blob)))
}

/// The length of the chunk that begins at a byte, which must be of a kind.
fn chunk(
    reader: &mut impl Read,
    at: u64,
    total: u64,
    kind: &[u8; 4],
) -> Result<u64, (u64, String)> {
    let mut header = [0; 8];
    fill_all(reader, &mut header, at)?;
    let [length, found] = words(&header);
    let name = String::from_utf8_lossy(&kind[..3 + usize::from(kind[3] != 0)]);
    if found != u32::from_le_bytes(*kind) {
        return Err((at + 4, format!("expected a {name} chunk")));
    }
    let (length, left) = (u64::from(length), total.saturating_sub(at + 8));
    if length > left {
        let why = format!("the {name} chunk says {length} bytes; {left} are left");
        return Err((at, why));
    }
    Ok(length)
}

/// Little-endian numbers.
fn words<const N: usize>(bytes: &[u8]) -> [u32; N] {
    std::array::from_fn(|i| {
        let four = bytes.get(4 * i..).and_then(|rest| rest.first_chunk());
        u32::from_le_bytes(four.copied().unwrap_or_default())
    })
}

/// Fills a header that begins at a byte.
fn fill_all(reader: &mut impl Read, header: &mut [u8], at: u64) -> Result<(), (u64, String)> {
    let have = stl::fill(reader, header).map_err(|why| (at, why))?;
    if have < header.len() {
        // The word that is torn.
        let word = at + have as u64 / 4 * 4;
        return Err((word, "the file ends inside a header".to_owned()));
    }
    Ok(())
}

/// A mesh on a node.
struct Placed {
    node: usize,
    mesh: usize,
    transform: Transform,
}

/// All nodes with a mesh, in the order of the tree, with world transforms.
///
/// glTF wants a forest; a node met twice is an error, which also ends cycles.
fn place_nodes(root: &json::Root) -> Result<Vec<Placed>, String> {
    let scene = match root.scene {
        Some(index) => root.scenes.get(index.value()),
        None => root.scenes.first(),
    };
    let mut stack: Vec<(usize, Transform)> = match scene {
        Some(scene) => scene.nodes.iter().map(json::Index::value).collect(),
        None => roots(root),
    }
    .into_iter()
    .map(|node| (node, Transform::IDENTITY))
    .rev()
    .collect();
    let mut seen = vec![false; root.nodes.len()];
    let mut placed = Vec::new();
    while let Some((index, parent)) = stack.pop() {
        if std::mem::replace(&mut seen[index], true) {
            return Err(format!(
                "node {index} hangs in the scene twice; nodes must form a tree"
            ));
        }
        let node = &root.nodes[index];
        let transform = parent.after(&local_transform(node));
        if !transform.0.as_flattened().iter().all(|v| v.is_finite()) {
            return Err(format!("node {index}: its transform is not finite"));
        }
        if let Some(mesh) = node.mesh {
            placed.push(Placed {
                node: index,
                mesh: mesh.value(),
                transform,
            });
        }
        let children = node.children.as_deref().unwrap_or_default();
        stack.extend(children.iter().rev().map(|c| (c.value(), transform)));
    }
    Ok(placed)
}

/// The nodes that are no node's child.
fn roots(root: &json::Root) -> Vec<usize> {
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|n| n.children.iter().flatten()) {
        is_child[child.value()] = true;
    }
    (0..is_child.len()).filter(|&i| !is_child[i]).collect()
}

/// A node's own matrix, or translation after rotation after scale.
fn local_transform(node: &json::Node) -> Transform {
    if let Some(m) = node.matrix {
        let m = m.map(f64::from);
        return Transform(std::array::from_fn(|r| {
            [m[r], m[4 + r], m[8 + r], m[12 + r]]
        }));
    }
    let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
    let s = node.scale.unwrap_or([1.0; 3]).map(f64::from);
    let t = node.translation.unwrap_or([0.0; 3]).map(f64::from);
    let turn = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ];
    Transform(std::array::from_fn(|r| {
        [
            turn[r][0] * s[0],
            turn[r][1] * s[1],
            turn[r][2] * s[2],
            t[r],
        ]
    }))
}

/// Lines if any mesh in the scene has some, else triangles.
fn default_kind(root: &json::Root, placed: &[Placed]) -> EdgeChoice {
    let has_lines = placed.iter().any(|p| {
        let primitives = root.meshes[p.mesh].primitives.iter();
        primitives.map(mode).any(is_line)
    });
    if has_lines {
        EdgeChoice::Lines
    } else {
        EdgeChoice::Triangles
    }
}

fn mode(primitive: &json::mesh::Primitive) -> Mode {
    match primitive.mode {
        Checked::Valid(mode) => mode,
        // The validation has refused it already.
        Checked::Invalid => Mode::Points,
    }
}

fn is_line(mode: Mode) -> bool {
    matches!(mode, Mode::Lines | Mode::LineLoop | Mode::LineStrip)
}

fn read_mesh(
    data: &Data<'_>,
    root: &json::Root,
    index: usize,
    kind: EdgeChoice,
) -> Result<Mesh, String> {
    let mut mesh = Mesh::default();
    let mut faces = UniqueEdges::default();
    // Where an accessor's points begin in the mesh: primitives share them.
    let mut bases = HashMap::new();
    for (i, primitive) in root.meshes[index].primitives.iter().enumerate() {
        let mode = mode(primitive);
        let wanted = match mode {
            Mode::Points => false,
            _ if is_line(mode) => kind.wants_lines(),
            _ => kind.wants_faces(),
        };
        if !wanted {
            continue;
        }
        let mut read = || {
            let positions = primitive.attributes.get(&POSITIONS);
            let positions = positions.ok_or("it has no POSITION attribute")?.value();
            let base = match bases.get(&positions) {
                Some(&base) => base,
                None => {
                    let base = mesh.points.len();
                    gltf_data::positions(data, positions, &mut mesh.points)?;
                    bases.insert(positions, base);
                    base
                }
            };
            let count = root.accessors[positions].count.0 as usize;
            let indices = match primitive.indices {
                Some(accessor) => gltf_data::indices(data, accessor.value(), count)?,
                None => (0..count as u32).collect(),
            };
            let shifted = |v: u32| v + base as u32;
            if is_line(mode) {
                lines(mode, &indices, |a, b| mesh.edges.push([a, b].map(shifted)));
            } else {
                triangle_edges(mode, &indices, |a, b| faces.add(shifted(a), shifted(b)));
            }
            Ok(())
        };
        read().map_err(|why: String| format!("primitive {i}: {why}"))?;
    }
    mesh.edges.extend(faces.finish(&mesh.points));
    Ok(mesh)
}

/// A line primitive's edges; a vertex too many is ignored, as glTF says.
fn lines(mode: Mode, indices: &[u32], mut edge: impl FnMut(u32, u32)) {
    match mode {
        Mode::Lines => {
            for pair in indices.chunks_exact(2) {
                edge(pair[0], pair[1]);
            }
        }
        _ => {
            for pair in indices.windows(2) {
                edge(pair[0], pair[1]);
            }
            if let (Mode::LineLoop, [first, _, .., last]) = (mode, indices) {
                edge(*last, *first);
            }
        }
    }
}

/// The three edges of each triangle; those that strips and fans share, twice.
fn triangle_edges(mode: Mode, indices: &[u32], mut edge: impl FnMut(u32, u32)) {
    let mut triangle = |a, b, c| {
        edge(a, b);
        edge(b, c);
        edge(c, a);
    };
    match (mode, indices) {
        (Mode::TriangleStrip, _) => {
            indices.windows(3).for_each(|t| triangle(t[0], t[1], t[2]));
        }
        (Mode::TriangleFan, [hub, rim @ ..]) => {
            rim.windows(2).for_each(|t| triangle(*hub, t[0], t[1]));
        }
        _ => indices
            .chunks_exact(3)
            .for_each(|t| triangle(t[0], t[1], t[2])),
    }
}

#[cfg(test)]
mod tests {
    use super::super::damaged::check_message;
    use super::*;

    /// A GLB file with every kind of primitive and accessor that is read.
    fn sample() -> Vec<u8> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/");
        let mut text = std::fs::read_to_string(format!("{folder}modes.gltf")).unwrap();
        text = text.replace(", \"uri\": \"modes%20buffer.bin\"", "");
        text = text.replace("\"uri\": \"modes%20buffer.bin\"", "\"name\": \"b\"");
        let blob = std::fs::read(format!("{folder}modes buffer.bin")).unwrap();
        while text.len() % 4 != 0 {
            text.push(' ');
        }
        let mut glb = b"glTF\x02\0\0\0".to_vec();
        glb.extend((28 + text.len() as u32 + blob.len() as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", text.as_bytes()), (b"BIN\0", &blob)] {
            glb.extend((chunk.len() as u32).to_le_bytes());
            glb.extend(kind);
            glb.extend(chunk);
        }
        glb
    }

    /// Found by fuzzing: the name of a missing file stood whole in the message.
    #[test]
    fn a_long_text_of_the_file_is_shortened_in_the_message() {
        let long = "x1/-".repeat(300);
        let buffer = format!("\"buffers\": [{{\"byteLength\": 1, \"uri\": \"{long}\"}}]");
        let name = format!("{long}.bin");
        let extension = format!("\"extensionsRequired\": [\"{name}\"]");
        for rest in [buffer, extension] {
            let text = format!("{{\"asset\": {{\"version\": \"2.0\"}}, {rest}}}");
            let bytes = text.as_bytes();
            let failure = read_from(Path::new("a.gltf"), bytes, Some(bytes.len() as u64), None);
            check_message(&failure.unwrap_err(), "a.gltf");
        }
    }

    #[test]
    fn damaged_files_are_read_or_refused_and_never_panic() {
        let whole = sample();
        let file = Path::new("damaged.glb");
        let scene = read_from(
            file,
            &whole[..],
            Some(whole.len() as u64),
            Some(EdgeChoice::All),
        )
        .unwrap();
        assert_eq!(scene.len(), 16 + 12);
        let mut state = 88_172_645_463_325_252_u64;
        let mut next = |most: usize| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 16) as usize % most
        };
        let (mut read_whole, mut refused) = (0, 0);
        for round in 0..30_000 {
            let mut bytes = whole.clone();
            for _ in 0..=next(3) {
                let at = next(bytes.len());
                // Digits for digits keep the JSON's grammar and change its sense.
                bytes[at] = match bytes[at] {
                    b'0'..=b'9' if round % 4 != 0 => b"0123456789-"[next(11)],
                    _ if round % 4 == 0 => next(256) as u8,
                    other => other,
                };
            }
            if round % 16 == 0 {
                bytes.truncate(next(bytes.len()));
            }
            match read_from(
                file,
                &bytes[..],
                Some(bytes.len() as u64),
                Some(EdgeChoice::All),
            ) {
                Ok(scene) => {
                    let mut segments = Vec::<frusta::Segment<f32>>::new();
                    scene.fill(0, scene.len(), &mut segments);
                    assert_eq!(segments.len() as u64, scene.len());
                    read_whole += 1;
                }
                Err(failure) => {
                    assert!(!failure.to_string().contains('\n'));
                    refused += 1;
                }
            }
        }
        assert!(
            read_whole > 1_000 && refused > 1_000,
            "{read_whole} {refused}"
        );
    }
}
