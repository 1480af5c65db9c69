//! Meshes and where they stand: the segments of a file without a copy for
//! each instance.

use super::EdgeChoice;
use frusta::{Real, Segment, Vec3};

/// Points and the edges between them.
#[derive(Debug, Default)]
pub(crate) struct Mesh {
    /// The points, in the mesh's own coordinates.
    pub(crate) points: Vec<Vec3<f64>>,
    /// Pairs of indices into `points`; readers check them.
    pub(crate) edges: Vec<[u32; 2]>,
}

/// Rows of a 3 x 4 matrix: mesh to world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Transform(pub(crate) [[f64; 4]; 3]);

impl Transform {
    /// World coordinates are mesh coordinates.
    pub(crate) const IDENTITY: Self = Self([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ]);

    /// Where a point goes.
    #[inline(always)]
    pub(crate) fn apply(&self, p: Vec3<f64>) -> Vec3<f64> {
        // No `map` over arrays: nested ones become calls, which took half of a run's time.
        let row = |[a, b, c, d]: [f64; 4]| a * p.x + b * p.y + c * p.z + d;
        Vec3::new(row(self.0[0]), row(self.0[1]), row(self.0[2]))
    }

    /// `self` after `inner`.
    pub(crate) fn after(&self, inner: &Self) -> Self {
        let mut rows = [[0.0; 4]; 3];
        for (row, out) in self.0.iter().zip(&mut rows) {
            for (k, cell) in out.iter_mut().enumerate() {
                *cell = (0..3).map(|i| row[i] * inner.0[i][k]).sum::<f64>();
            }
            out[3] += row[3];
        }
        Self(rows)
    }
}

/// A mesh in the world.
#[derive(Debug)]
pub(crate) struct Instance {
    /// The mesh's index.
    pub(crate) mesh: usize,
    /// The index of its node, for messages.
    pub(crate) node: usize,
    /// `None` leaves the mesh's coordinates as they are, to the bit.
    pub(crate) transform: Option<Transform>,
}

impl Instance {
    /// The only mesh, where it is.
    pub(crate) const PLAIN: Self = Self {
        mesh: 0,
        node: 0,
        transform: None,
    };
}

/// An axis-aligned box around points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least coordinates.
    pub low: Vec3<f64>,
    /// The greatest coordinates.
    pub high: Vec3<f64>,
}

impl Bounds {
    /// The box around no point.
    pub const EMPTY: Self = Self {
        low: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// Grows to take in a point.
    pub fn add(&mut self, p: Vec3<f64>) {
        for i in 0..3 {
            self.low[i] = self.low[i].min(p[i]);
            self.high[i] = self.high[i].max(p[i]);
        }
    }

    /// Whether there is no point in it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.low.x > self.high.x
    }

    fn corners(&self) -> [Vec3<f64>; 8] {
        let pick = |i: usize, bit: usize, k: usize| {
            if i & bit == 0 {
                self.low[k]
            } else {
                self.high[k]
            }
        };
        std::array::from_fn(|i| Vec3::new(pick(i, 1, 0), pick(i, 2, 1), pick(i, 4, 2)))
    }
}

/// Everything in a mesh file that can be clipped.
#[derive(Debug)]
pub struct Scene {
    meshes: Vec<Mesh>,
    instances: Vec<Instance>,
    /// Entry `i`: the number of edges of the instances before `i`; one more entry
    /// than instances.
    firsts: Vec<u64>,
    kind: EdgeChoice,
}

impl Scene {
    /// From meshes and instances that name them.
    pub(crate) fn new(meshes: Vec<Mesh>, instances: Vec<Instance>, kind: EdgeChoice) -> Self {
        let mut firsts = vec![0];
        let mut total = 0;
        for instance in &instances {
            total += meshes[instance.mesh].edges.len() as u64;
            firsts.push(total);
        }
        Self {
            meshes,
            instances,
            firsts,
            kind,
        }
    }

    /// Which edges were read.
    #[must_use]
    pub fn kind(&self) -> EdgeChoice {
        self.kind
    }

    /// Number of segments.
    #[must_use]
    pub fn len(&self) -> u64 {
        self.firsts.last().copied().unwrap_or(0)
    }

    /// Whether there are no segments.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Appends `count` segments from index `first` on, in world coordinates.
    pub fn fill<T: Real>(&self, first: u64, count: u64, out: &mut Vec<Segment<T>>) {
        let (mut next, last) = (first, first.saturating_add(count).min(self.len()));
        let mut i = self.instance_of(first);
        while next < last {
            let instance = &self.instances[i];
            let mesh = &self.meshes[instance.mesh];
            let from = (next - self.firsts[i]) as usize;
            let to = (last.min(self.firsts[i + 1]) - self.firsts[i]) as usize;
            let edges = mesh.edges[from..to].iter();
            let ends = edges.map(|&[a, b]| [mesh.points[a as usize], mesh.points[b as usize]]);
            match &instance.transform {
                None => out.extend(ends.map(segment)),
                Some(t) => out.extend(ends.map(|[a, b]| segment([t.apply(a), t.apply(b)]))),
            }
            next = self.firsts[i + 1];
            i += 1;
        }
    }

    /// All segments.
    #[cfg(test)]
    pub(crate) fn segments(&self) -> Vec<Segment<f64>> {
        let mut out = Vec::new();
        self.fill(0, self.len(), &mut out);
        out
    }

    /// Where a segment comes from, for messages.
    pub(crate) fn place(&self, index: u64) -> String {
        let i = self.instance_of(index);
        match (self.instances.get(i), self.firsts.get(i)) {
            (Some(Instance { node, .. }), Some(first)) => {
                format!("node {node}, edge {}", index - first)
            }
            _ => format!("segment {index}"),
        }
    }

    /// A box around all segments: around the boxes of the instances.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let own: Vec<Bounds> = self
            .meshes
            .iter()
            .map(|mesh| {
                let mut bounds = Bounds::EMPTY;
                for vertex in mesh.edges.as_flattened() {
                    bounds.add(mesh.points[*vertex as usize]);
                }
                bounds
            })
            .collect();
        let mut all = Bounds::EMPTY;
        for instance in &self.instances {
            let mesh = &own[instance.mesh];
            if mesh.is_empty() {
                continue;
            }
            for corner in mesh.corners() {
                all.add(instance.transform.map_or(corner, |t| t.apply(corner)));
            }
        }
        all
    }

    /// The instance that holds a segment; an empty instance holds no segment.
    fn instance_of(&self, index: u64) -> usize {
        self.firsts
            .partition_point(|&f| f <= index)
            .saturating_sub(1)
    }
}

#[inline]
fn segment<T: Real>([start, end]: [Vec3<f64>; 2]) -> Segment<T> {
    Segment {
        start: Vec3::from_f64(start),
        end: Vec3::from_f64(end),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[[f64; 3]]) -> Mesh {
        Mesh {
            points: points.iter().map(|&p| p.into()).collect(),
            edges: (1..points.len() as u32).map(|i| [i - 1, i]).collect(),
        }
    }

    #[test]
    fn chunks_of_any_size_give_the_same_segments() {
        let shift = Transform([
            [1.0, 0.0, 0.0, 5.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ]);
        let instance = |mesh, transform| Instance {
            mesh,
            node: 0,
            transform,
        };
        let scene = Scene::new(
            vec![
                line(&[[0.0; 3], [1.0; 3], [2.0; 3]]),
                Mesh::default(),
                line(&[[7.0; 3], [8.0; 3]]),
            ],
            vec![
                instance(1, None),
                instance(0, Some(shift)),
                instance(1, None),
                instance(2, None),
            ],
            EdgeChoice::Lines,
        );
        let mut whole = Vec::<Segment<f64>>::new();
        scene.fill(0, 100, &mut whole);
        assert_eq!(whole.len(), 3);
        assert_eq!(whole[1], Segment::new([6.0, 1.0, 1.0], [7.0, 2.0, 2.0]));
        assert_eq!(whole[2], Segment::new([7.0; 3], [8.0; 3]));
        let mut pieces = Vec::new();
        for i in 0..3 {
            scene.fill(i, 1, &mut pieces);
        }
        assert_eq!(pieces, whole);
        assert_eq!(scene.place(2), "node 0, edge 0");
    }

    #[test]
    fn transforms_compose_from_the_right() {
        let scale = Transform([
            [2.0, 0.0, 0.0, 1.0],
            [0.0, 3.0, 0.0, 0.0],
            [0.0, 0.0, 4.0, 0.0],
        ]);
        let turn = Transform([
            [0.0, -1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 7.0],
        ]);
        let p = Vec3::new(1.0, 2.0, 3.0);
        assert_eq!(turn.after(&scale).apply(p), turn.apply(scale.apply(p)));
        assert_eq!(Transform::IDENTITY.after(&turn), turn);
    }
}
