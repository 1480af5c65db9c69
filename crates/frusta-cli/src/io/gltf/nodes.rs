//! The tree of nodes: where meshes are placed in the world.
//!
//! Transforms are read and composed in `f64`: a translation of 4470000.123 m, as in models in
//! earth-centred coordinates, is not an `f32`. The `gltf` crate holds them as `f32`, so that
//! they are read a second time, from the document's text. Rejected alternatives: a
//! `serde_json::Value` of the document (tens of bytes of memory for each byte of text), and a
//! document whose nodes are kept as raw text (errors in them would lose their line).

use crate::io::scene::Transform;
use gltf::json;
use serde::Deserialize;

/// A mesh on a node.
pub(super) struct Placed {
    pub(super) node: usize,
    pub(super) mesh: usize,
    pub(super) transform: Transform,
}

/// All nodes with a mesh, in the order of the tree, with world transforms; `text` is the
/// document's.
///
/// glTF requires a forest; a node met twice is an error, which also ends cycles.
pub(super) fn place(root: &json::Root, text: &[u8]) -> Result<Vec<Placed>, String> {
    let locals = local_transforms(root, text)?;
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
                "node {index} is in the scene twice; nodes must form a tree"
            ));
        }
        let node = &root.nodes[index];
        let transform = match locals.get(index) {
            Some(local) => parent.after(&local.transform()),
            None => parent,
        };
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

/// The transforms of all nodes, by index; none if no node has one.
fn local_transforms(root: &json::Root, text: &[u8]) -> Result<Vec<Local>, String> {
    let is_placed = |n: &json::Node| {
        n.matrix.is_some() || n.translation.is_some() || n.rotation.is_some() || n.scale.is_some()
    };
    if !root.nodes.iter().any(is_placed) {
        return Ok(Vec::new());
    }
    // The text has been parsed before, so that this does not fail but for numbers.
    let nodes: Nodes = serde_json::from_slice(text).map_err(|e| format!("nodes: {e}"))?;
    Ok(nodes.nodes)
}

/// The document, without anything but its nodes.
#[derive(Deserialize)]
struct Nodes {
    nodes: Vec<Local>,
}

/// A node's own transform.
#[derive(Deserialize)]
struct Local {
    /// Column by column.
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    /// The quaternion x, y, z, w.
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

impl Local {
    /// The matrix, or translation after rotation after scale.
    fn transform(&self) -> Transform {
        if let Some(m) = self.matrix {
            let row = |r| [m[r], m[4 + r], m[8 + r], m[12 + r]];
            return Transform(std::array::from_fn(row));
        }
        let [x, y, z, w] = self.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let s = self.scale.unwrap_or([1.0; 3]);
        let t = self.translation.unwrap_or([0.0; 3]);
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
            let [a, b, c] = turn[r];
            [a * s[0], b * s[1], c * s[2], t[r]]
        }))
    }
}
