//! glTF 2.0: line and triangle primitives of the default scene's nodes.
//!
//! ```text
//! container  GLB's chunks and the JSON document
//! nodes      the tree of nodes: where meshes are placed
//! mesh       the edges of primitives
//! accessors  the bytes behind positions and indices
//! ```
//!
//! The `gltf` crate reads the JSON and checks its indices. What it trusts is checked
//! here first, because a lying file would make it panic: the header's length, the node
//! tree (a cycle never ends), and everything about the bytes behind an accessor.
//!
//! Skins, morph targets and animations are not applied.

mod accessors;
mod container;
mod mesh;
mod nodes;

use super::scene::{Instance, Mesh, Transform};
use super::{Contents, EdgeChoice, Format, Input, ReadOptions, Scene};
use crate::failure::{Failure, shorten};
use accessors::Data;
use container::Document;
use gltf::json;
use gltf::json::validation::Checked;
use mesh::Source;
use nodes::Placed;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::collections::HashMap;
use std::io::BufRead;
use std::path::Path;

/// Extensions that do not affect edges, or that are supported.
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

/// The format.
pub(super) struct Gltf;

impl Format for Gltf {
    fn name(&self) -> &'static str {
        "gltf"
    }

    fn description(&self) -> &'static str {
        "glTF 2.0, text or binary"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["gltf", "glb"]
    }

    fn is_mesh(&self) -> bool {
        true
    }

    fn open(&self, input: &Input, options: ReadOptions) -> Result<Contents, Failure> {
        let scene = read_from(input.name(), input.open()?, input.size(), options.edges);
        scene.map(Contents::Scene)
    }
}

/// Reads edges from a file's bytes, of which there are `size`, if that is known.
fn read_from(
    file: &Path,
    reader: impl BufRead,
    size: Option<u64>,
    choice: Option<EdgeChoice>,
) -> Result<Scene, Failure> {
    let (Document { root, text }, blob) = container::read(file, reader, size)?;
    let root = validated(file, root)?;
    let placed = nodes::place(&root, &text).map_err(|why| Failure::in_file(file, why))?;
    drop(text);
    let data = Data::load(file, &root, blob.as_deref())?;
    let kind = choice.unwrap_or_else(|| default_kind(&root, &placed));
    read_scene(file, &root, &data, placed, kind)
}

/// Reads the meshes that are placed: each once, in the order in which the tree comes to it,
/// and meshes of the same accessors as one.
fn read_scene(
    file: &Path,
    root: &json::Root,
    data: &Data<'_>,
    placed: Vec<Placed>,
    kind: EdgeChoice,
) -> Result<Scene, Failure> {
    let mut wanted: Vec<(usize, Vec<Source>)> = Vec::new();
    let mut by_mesh = HashMap::new();
    let mut by_sources = HashMap::new();
    let mut instances = Vec::with_capacity(placed.len());
    for placed in placed {
        let mesh = *by_mesh.entry(placed.mesh).or_insert_with(|| {
            let sources = mesh::sources(root, placed.mesh, kind);
            *by_sources.entry(sources.clone()).or_insert_with(|| {
                wanted.push((placed.mesh, sources));
                wanted.len() - 1
            })
        });
        instances.push(Instance {
            mesh,
            node: placed.node,
            transform: (placed.transform != Transform::IDENTITY).then_some(placed.transform),
        });
    }
    let sources = || wanted.iter().flat_map(|(_, sources)| sources);
    let positions = data.all_positions(sources().filter_map(|source| source.positions));
    let read = |(mesh, sources): &(usize, Vec<Source>)| {
        let read = mesh::read(data, &positions, sources);
        read.map_err(|why| Failure::at(file, format_args!("mesh {mesh}"), why))
    };
    // Collected before they are looked at: the first failure is the one reported.
    let meshes: Vec<Result<Mesh, Failure>> = wanted.par_iter().map(read).collect();
    let meshes = meshes.into_iter().collect::<Result<_, _>>()?;
    Ok(Scene::new(meshes, instances, kind))
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

/// Lines if any mesh in the scene has some, else triangles.
fn default_kind(root: &json::Root, placed: &[Placed]) -> EdgeChoice {
    let has_lines = placed.iter().any(|p| {
        let primitives = root.meshes[p.mesh].primitives.iter();
        primitives.map(mesh::mode).any(mesh::is_line)
    });
    if has_lines {
        EdgeChoice::Lines
    } else {
        EdgeChoice::Triangles
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::corruption::check_message;

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
    fn corrupted_files_are_read_or_refused_and_never_panic() {
        let whole = sample();
        let file = Path::new("corrupted.glb");
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
