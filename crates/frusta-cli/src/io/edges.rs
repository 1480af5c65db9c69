//! The edges of faces, each once.

use frusta::Vec3;
use rayon::slice::ParallelSliceMut;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Points without repetition, for files that list a triangle's corners again and
/// again.
#[derive(Debug, Default)]
pub(crate) struct PointSet {
    points: Vec<Vec3<f64>>,
    indices: HashMap<[u64; 3], u32>,
}

impl PointSet {
    /// A point's index.
    pub(crate) fn index(&mut self, point: Vec3<f64>) -> Result<u32, String> {
        let next = self.points.len();
        match self.indices.entry(key(point)) {
            Entry::Occupied(known) => Ok(*known.get()),
            Entry::Vacant(_) if next >= u32::MAX as usize => {
                Err("more than 4294967295 different points".to_owned())
            }
            Entry::Vacant(new) => {
                self.points.push(point);
                Ok(*new.insert(next as u32))
            }
        }
    }

    /// The points, in the order in which they came.
    pub(crate) fn finish(self) -> Vec<Vec3<f64>> {
        self.points
    }
}

/// What equal points have in common; adding zero makes the two zeros one.
fn key(point: Vec3<f64>) -> [u64; 3] {
    point.to_array().map(|c| (c + 0.0).to_bits())
}

/// Collects the edges of faces and gives each once.
///
/// Vertices at the same place count as one, so that an edge along which a
/// file splits its vertices (for normals, say) is not drawn twice. Edges of no
/// length are dropped: they are artefacts of degenerate triangles.
#[derive(Debug, Default)]
pub(crate) struct UniqueEdges(Vec<[u32; 2]>);

impl From<Vec<[u32; 2]>> for UniqueEdges {
    fn from(edges: Vec<[u32; 2]>) -> Self {
        Self(edges)
    }
}

impl UniqueEdges {
    /// Adds the edge between two vertices.
    pub(crate) fn add(&mut self, a: u32, b: u32) {
        self.0.push([a, b]);
    }

    /// The edges, lower vertex first, in the order of their vertices.
    pub(crate) fn finish(mut self, points: &[Vec3<f64>]) -> Vec<[u32; 2]> {
        let same = first_at_same_place(points);
        for edge in &mut self.0 {
            *edge = edge.map(|v| same[v as usize]);
        }
        self.finish_set()
    }

    /// The same between the points of a [`PointSet`], which are one a place.
    pub(crate) fn finish_set(mut self) -> Vec<[u32; 2]> {
        for edge in &mut self.0 {
            edge.sort_unstable();
        }
        self.0.retain(|[a, b]| a != b);
        self.0.par_sort_unstable();
        self.0.dedup();
        self.0.shrink_to_fit();
        self.0
    }
}

/// For each point the first point that equals it.
fn first_at_same_place(points: &[Vec3<f64>]) -> Vec<u32> {
    let key = |i: u32| key(points[i as usize]);
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.par_sort_unstable_by_key(|&i| (key(i), i));
    let mut same: Vec<u32> = (0..points.len() as u32).collect();
    for pair in order.windows(2) {
        if key(pair[0]) == key(pair[1]) {
            same[pair[1] as usize] = same[pair[0] as usize];
        }
    }
    same
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_between_split_vertices_counts_once() {
        let points: Vec<Vec3<f64>> = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, -0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
        ]
        .map(Vec3::from)
        .to_vec();
        let mut edges = UniqueEdges::default();
        for [a, b, c] in [[0, 1, 2], [4, 3, 5], [1, 3, 5]] {
            edges.add(a, b);
            edges.add(b, c);
            edges.add(c, a);
        }
        assert_eq!(
            edges.finish(&points),
            [[0, 1], [0, 2], [1, 2], [1, 5], [2, 5]]
        );
    }
}
