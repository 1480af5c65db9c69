//! The edges of a mesh's primitives.
//!
//! Only the vertices that edges use are kept and decoded. So a mesh takes memory by its
//! indices, not by the accessor behind them, which thousands of meshes may share.

use super::POSITIONS;
use super::accessors::{Data, PositionSet, Positions};
use crate::io::EdgeChoice;
use crate::io::edges::UniqueEdges;
use crate::io::scene::Mesh;
use frusta::Vec3;
use gltf::json;
use gltf::json::validation::Checked;
use gltf::mesh::Mode;
use rayon::slice::ParallelSliceMut;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// What a primitive's edges are read from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Source {
    /// The primitive's index in its mesh.
    primitive: usize,
    /// The code of its mode.
    mode: u32,
    /// Accessors.
    pub(super) positions: Option<usize>,
    indices: Option<usize>,
}

impl Source {
    fn mode(&self) -> Mode {
        let mode = MODES.get(self.mode as usize);
        mode.copied().unwrap_or(Mode::Points)
    }
}

/// Modes by their code in a file.
const MODES: [Mode; 7] = [
    Mode::Points,
    Mode::Lines,
    Mode::LineLoop,
    Mode::LineStrip,
    Mode::Triangles,
    Mode::TriangleStrip,
    Mode::TriangleFan,
];

/// The sources of a mesh's edges of a kind.
pub(super) fn sources(root: &json::Root, mesh: usize, kind: EdgeChoice) -> Vec<Source> {
    let primitives = root.meshes[mesh].primitives.iter().enumerate();
    let wanted = primitives.filter(|(_, primitive)| match mode(primitive) {
        Mode::Points => false,
        mode if is_line(mode) => kind.wants_lines(),
        _ => kind.wants_faces(),
    });
    let source = |(i, primitive): (usize, &json::mesh::Primitive)| Source {
        primitive: i,
        mode: mode(primitive).as_gl_enum(),
        positions: primitive.attributes.get(&POSITIONS).map(json::Index::value),
        indices: primitive.indices.map(|accessor| accessor.value()),
    };
    wanted.map(source).collect()
}

pub(super) fn mode(primitive: &json::mesh::Primitive) -> Mode {
    match primitive.mode {
        Checked::Valid(mode) => mode,
        // The validation has refused it already.
        Checked::Invalid => Mode::Points,
    }
}

pub(super) fn is_line(mode: Mode) -> bool {
    matches!(mode, Mode::Lines | Mode::LineLoop | Mode::LineStrip)
}

/// Reads a mesh.
pub(super) fn read(
    data: &Data<'_>,
    positions: &PositionSet<'_>,
    sources: &[Source],
) -> Result<Mesh, String> {
    let mut parts = Parts::default();
    let mut lines = Vec::new();
    let mut faces = Vec::new();
    for source in sources {
        let mut read = || {
            let accessor = source.positions.ok_or("it has no POSITION attribute")?;
            let points = positions.get(accessor)?;
            let base = parts.base(accessor, points, source.primitive)?;
            let indices = match source.indices {
                Some(accessor) => data.indices(accessor, points.len())?,
                None => (0..points.len() as u32).collect(),
            };
            let mode = source.mode();
            let edges = match is_line(mode) {
                true => &mut lines,
                false => &mut faces,
            };
            let mut add = |a: u32, b: u32| edges.push([a + base, b + base]);
            match is_line(mode) {
                true => line_edges(mode, &indices, &mut add),
                false => triangle_edges(mode, &indices, &mut add),
            }
            Ok(())
        };
        let primitive = source.primitive;
        read().map_err(|why: String| format!("primitive {primitive}: {why}"))?;
    }
    let used = renumber(parts.len, [&mut lines, &mut faces]);
    let points = parts.decode(&used)?;
    drop(used);
    let mut edges = lines;
    edges.extend(UniqueEdges::from(faces).finish(&points));
    Ok(Mesh { points, edges })
}

/// The accessors of a mesh, one after the other: primitives share them.
#[derive(Default)]
struct Parts<'a> {
    /// Where an accessor's vertices begin.
    bases: HashMap<usize, u32>,
    /// First vertices, their accessors' points and, for messages, the first primitives that
    /// use them; in order.
    parts: Vec<(u32, &'a Positions<'a>, usize)>,
    /// Number of vertices.
    len: u32,
}

impl<'a> Parts<'a> {
    /// The first vertex of an accessor.
    fn base(
        &mut self,
        accessor: usize,
        points: &'a Positions<'a>,
        primitive: usize,
    ) -> Result<u32, String> {
        match self.bases.entry(accessor) {
            Entry::Occupied(known) => Ok(*known.get()),
            Entry::Vacant(new) => {
                let count = points.len();
                let end = u64::from(self.len) + count;
                let end = u32::try_from(end).map_err(|_| format!("{count} points are too many"))?;
                let base = std::mem::replace(&mut self.len, end);
                self.parts.push((base, points, primitive));
                Ok(*new.insert(base))
            }
        }
    }

    /// The points of vertices in ascending order.
    fn decode(&self, vertices: &[u32]) -> Result<Vec<Vec3<f64>>, String> {
        let mut points = Vec::with_capacity(vertices.len());
        let mut rest = vertices;
        for (i, &(base, positions, primitive)) in self.parts.iter().enumerate() {
            let end = self.parts.get(i + 1).map_or(self.len, |next| next.0);
            let (own, others) = rest.split_at(rest.partition_point(|&v| v < end));
            for &vertex in own {
                let point = positions.point(vertex - base);
                points.push(point.map_err(|why| format!("primitive {primitive}: {why}"))?);
            }
            rest = others;
        }
        Ok(points)
    }
}

/// The vertices below `count` that edges use, in ascending order; the edges then name them
/// by their index in that list.
fn renumber(count: u32, mut lists: [&mut Vec<[u32; 2]>; 2]) -> Vec<u32> {
    let ends: usize = lists.iter().map(|edges| 2 * edges.len()).sum();
    if count as usize <= ends {
        // Most are used: a table of all.
        let mut table = vec![0; count as usize];
        for &vertex in lists.iter().flat_map(|edges| edges.as_flattened()) {
            table[vertex as usize] = 1;
        }
        let mut used = Vec::new();
        for (vertex, entry) in (0..).zip(&mut table) {
            if std::mem::replace(entry, used.len() as u32) == 1 {
                used.push(vertex);
            }
        }
        for vertex in lists.iter_mut().flat_map(|edges| edges.as_flattened_mut()) {
            *vertex = table[*vertex as usize];
        }
        return used;
    }
    let mut used: Vec<u32> = Vec::with_capacity(ends);
    for edges in &lists {
        used.extend(edges.as_flattened());
    }
    used.par_sort_unstable();
    used.dedup();
    used.shrink_to_fit();
    for vertex in lists.iter_mut().flat_map(|edges| edges.as_flattened_mut()) {
        // Each is there.
        *vertex = used.partition_point(|v| v < vertex) as u32;
    }
    used
}

/// A line primitive's edges; an odd last vertex is ignored, as the specification requires.
fn line_edges(mode: Mode, indices: &[u32], mut edge: impl FnMut(u32, u32)) {
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

    #[test]
    fn vertices_are_renumbered_in_their_order() {
        for count in [10, 1000] {
            let (mut lines, mut faces) = (vec![[7, 3], [3, 9]], vec![[9, 0], [0, 7], [7, 9]]);
            let used = renumber(count, [&mut lines, &mut faces]);
            assert_eq!(used, [0, 3, 7, 9]);
            assert_eq!(lines, [[2, 1], [1, 3]]);
            assert_eq!(faces, [[3, 0], [0, 2], [2, 3]]);
        }
        assert!(renumber(5, [&mut Vec::new(), &mut Vec::new()]).is_empty());
    }
}
