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
use crate::failure::Failure;
use gltf::json;
use gltf::json::validation::Checked;
use gltf::mesh::Mode;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::collections::HashMap;
use std::io::Read;
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
const POSITIONS: Checked<gltf::Semantic> = Checked::Valid(gltf::Semantic::Positions);

/// Reads a file's edges.
pub(super) fn read(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    let mut reader = input.open()?;
    let mut bytes = vec![0; 12];
    let have = stl::fill(&mut reader, &mut bytes).map_err(|e| input.failure(e))?;
    bytes.truncate(have);
    // What cannot be glTF is not read: it could be of any length.
    let limit = match bytes.get(8..12).and_then(|b| b.first_chunk()) {
        Some(&length) if bytes.starts_with(b"glTF") => {
            u64::from(u32::from_le_bytes(length)).max(20)
        }
        _ if bytes.starts_with(b"glTF") || bytes.trim_ascii_start().starts_with(b"{") => u64::MAX,
        _ if have == 0 => return Err(input.failure("the file is empty")),
        _ => {
            let why = "not glTF: it begins neither with glTF nor with {";
            return Err(input.failure(why));
        }
    };
    reader
        .take(limit.saturating_sub(have as u64))
        .read_to_end(&mut bytes)
        .map_err(|e| input.failure(e))?;
    read_bytes(input.name(), &bytes, choice)
}

/// Reads the edges in a file's bytes.
fn read_bytes(file: &Path, bytes: &[u8], choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    let (root, blob) = parse(file, bytes)?;
    let data = Data::load(file, &root, blob)?;
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

/// The JSON, checked, and the binary chunk if there is one.
fn parse<'a>(file: &Path, bytes: &'a [u8]) -> Result<(json::Root, Option<&'a [u8]>), Failure> {
    let (text, blob, start) = if bytes.starts_with(b"glTF") {
        let chunks = split_glb(bytes)
            .map_err(|(byte, why)| Failure::at(file, format_args!("byte {byte}"), why))?;
        (chunks.0, chunks.1, "the JSON chunk's ")
    } else {
        (bytes, None, "")
    };
    let mut root: json::Root = json::deserialize::from_slice(text)
        .map_err(|e| Failure::in_file(file, format_args!("not glTF: at {start}{e}")))?;
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
            Some((path, why)) => Failure::at(file, path, why),
            None => Failure::in_file(file, "invalid glTF"),
        },
        other => Failure::in_file(file, other),
    })?;
    Ok((document.into_json(), blob))
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

/// The JSON chunk and, if there is one, the binary chunk.
type Chunks<'a> = (&'a [u8], Option<&'a [u8]>);

/// The chunks of a GLB file; an error comes with its byte.
fn split_glb(bytes: &[u8]) -> Result<Chunks<'_>, (usize, String)> {
    let word = |at: usize| -> Result<u32, (usize, String)> {
        let four = bytes.get(at..).and_then(|rest| rest.first_chunk());
        let four = four.ok_or_else(|| (at, "the file ends inside a header".to_owned()))?;
        Ok(u32::from_le_bytes(*four))
    };
    let version = word(4)?;
    if version != 2 {
        return Err((4, format!("GLB version {version}; expected 2")));
    }
    let total = word(8)? as usize;
    let Some(all) = bytes.get(..total) else {
        let have = bytes.len();
        return Err((
            8,
            format!("the header says {total} bytes; the file has {have}"),
        ));
    };
    let chunk = |at: usize, kind: &[u8; 4]| -> Result<&[u8], (usize, String)> {
        let length = word(at)? as usize;
        let name = String::from_utf8_lossy(&kind[..3 + usize::from(kind[3] != 0)]);
        if word(at + 4)? != u32::from_le_bytes(*kind) {
            return Err((at + 4, format!("expected a {name} chunk")));
        }
        let data = all.get(at + 8..).and_then(|rest| rest.get(..length));
        data.ok_or_else(|| {
            let left = all.len().saturating_sub(at + 8);
            (
                at,
                format!("the {name} chunk says {length} bytes; {left} are left"),
            )
        })
    };
    let text = chunk(12, b"JSON")?;
    let at = 20 + text.len();
    let blob = if at + 8 <= all.len() {
        Some(chunk(at, b"BIN\0")?)
    } else {
        None
    };
    Ok((text, blob))
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

    #[test]
    fn damaged_files_are_read_or_refused_and_never_panic() {
        let whole = sample();
        let file = Path::new("damaged.glb");
        let scene = read_bytes(file, &whole, Some(EdgeChoice::All)).unwrap();
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
            match read_bytes(file, &bytes, Some(EdgeChoice::All)) {
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
