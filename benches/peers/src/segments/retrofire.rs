//! retrofire: an edge by the view frustum, in clip space and in `f32`.
//!
//! Its function takes a slice of edges whose vertices are in clip space already. It is asked
//! in four ways, so that nobody can say it was asked the wrong one: with the
//! transform from the world as part of the job, or prepared; with the world's position as an
//! attribute of the vertices, which is what gives ends in the world, as frusta does, or without;
//! edge by edge, or all in one slice.

use super::{Found, FoundEnd, PIECE, part};
use crate::peer::{Peer, Who};
use frusta::{Real, Segment, Vec3};
use retrofire_core::geom::{Edge, vertex};
use retrofire_core::math::{Lerp, Point3, ProjMat3, ProjVec3, pt3};
use retrofire_core::render::clip::{ClipVert, view_frustum};

type World = Point3<()>;
type ClipEdge<A> = Edge<ClipVert<A>>;

/// A camera's matrix in retrofire's type.
fn projection(clip_from_world: [[f32; 4]; 4]) -> ProjMat3 {
    ProjMat3::new(clip_from_world)
}

/// The matrix of the cube from -1 to 1: clip space itself.
pub fn cube_matrix() -> [[f32; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|j| f32::from(u8::from(i == j))))
}

fn clip_vertex<A>(matrix: &ProjMat3, world: &World, attribute: A) -> ClipVert<A> {
    ClipVert::new(vertex(matrix.apply(world), attribute))
}

fn world_points(segment: &Segment<f32>) -> [World; 2] {
    [segment.start, segment.end].map(|p| pt3(p.x, p.y, p.z))
}

fn plain_edge(matrix: &ProjMat3, [p, q]: &[World; 2]) -> ClipEdge<()> {
    Edge(clip_vertex(matrix, p, ()), clip_vertex(matrix, q, ()))
}

/// Clips one edge, in a vector that keeps its memory.
fn clip_one<A: Lerp + Clone>(
    edge: &ClipEdge<A>,
    out: &mut Vec<ClipEdge<A>>,
) -> Option<ClipEdge<A>> {
    out.clear();
    view_frustum::clip(std::slice::from_ref(edge), out);
    out.pop()
}

/// The way back from clip space, to compare with the truth.
#[derive(Clone)]
struct Unprojected {
    world_from_clip: [[f64; 4]; 4],
}

impl Unprojected {
    fn new(clip_from_world: &[[f32; 4]; 4]) -> Self {
        let m = clip_from_world.map(|row| row.map(f64::from));
        Self {
            world_from_clip: inverse(m),
        }
    }

    /// What an edge in clip space says of the segment. Whether an end is inside is decided in
    /// clip space, by comparisons, where nothing is rounded any more.
    fn answer(
        &self,
        segment: &Segment<f32>,
        given: &ClipEdge<()>,
        found: Option<ClipEdge<()>>,
    ) -> Found<f32> {
        let Some(Edge(a, b)) = found else {
            return Found::Nothing;
        };
        let own = [(given.0.pos, segment.start), (given.1.pos, segment.end)];
        let ends = [0, 1].map(|i| {
            let (before, end) = own[i];
            let after = [a.pos, b.pos][i];
            let kept = after == before;
            FoundEnd {
                point: if kept { end } else { self.world(&after) },
                kept,
                inside: Some(is_inside(&after)),
            }
        });
        if ends.iter().all(|end| end.point.is_finite()) {
            Found::Part(ends)
        } else {
            Found::Refused
        }
    }

    fn world(&self, clip: &ProjVec3) -> Vec3<f32> {
        let c = clip.0.map(f64::from);
        let [x, y, z, w] = self
            .world_from_clip
            .map(|row| (0..4).map(|k| row[k] * c[k]).sum::<f64>());
        Vec3::from_f64(Vec3::new(x / w, y / w, z / w))
    }
}

fn is_inside(clip: &ProjVec3) -> bool {
    let [x, y, z, w] = clip.0;
    [x, y, z].into_iter().all(|c| Real::abs(c) <= w)
}

/// Gauss-Jordan with pivots; the cameras' matrices are regular.
fn inverse(mut m: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let mut inverse = cube_matrix().map(|row| row.map(f64::from));
    for column in 0..4 {
        let size = |row: &usize| m[*row][column].abs();
        let pivot = (column..4).max_by(|a, b| size(a).total_cmp(&size(b)));
        let pivot = pivot.unwrap_or(column);
        m.swap(column, pivot);
        inverse.swap(column, pivot);
        let scale = 1.0 / m[column][column];
        m[column] = m[column].map(|c| c * scale);
        inverse[column] = inverse[column].map(|c| c * scale);
        for row in (0..4).filter(|row| *row != column) {
            let factor = m[row][column];
            for k in 0..4 {
                m[row][k] -= factor * m[column][k];
                inverse[row][k] -= factor * inverse[column][k];
            }
        }
    }
    inverse
}

/// Clip-space vertices without attributes, prepared: clipping alone.
pub struct Prepared {
    matrix: ProjMat3,
    back: Unprojected,
    out: Vec<ClipEdge<()>>,
}

impl Prepared {
    /// With a matrix from the world to clip space.
    pub fn new(clip_from_world: [[f32; 4]; 4]) -> Self {
        Self {
            matrix: projection(clip_from_world),
            back: Unprojected::new(&clip_from_world),
            out: Vec::with_capacity(4),
        }
    }
}

impl Peer for Prepared {
    type Case = Segment<f32>;
    type Input = ClipEdge<()>;
    type Output<'a> = Option<ClipEdge<()>>;

    fn who(&self) -> Who {
        who(
            "view_frustum::clip",
            "vertices and their outcodes prepared; ends in clip space",
        )
    }

    fn prepare(&self, segment: &Segment<f32>) -> ClipEdge<()> {
        plain_edge(&self.matrix, &world_points(segment))
    }

    fn run(&mut self, edge: &ClipEdge<()>) -> Option<ClipEdge<()>> {
        clip_one(edge, &mut self.out)
    }

    fn answer(&mut self, segment: &Segment<f32>) -> Found<f32> {
        let edge = self.prepare(segment);
        let found = self.run(&edge);
        self.back.answer(segment, &edge, found)
    }
}

const fn who(function: &'static str, note: &'static str) -> Who {
    Who {
        library: "retrofire-core",
        function,
        scalar: "f32",
        note,
    }
}

/// The transform and the clipping; ends in clip space.
pub struct Transformed(Prepared);

impl Transformed {
    /// With a matrix from the world to clip space.
    pub fn new(clip_from_world: [[f32; 4]; 4]) -> Self {
        Self(Prepared::new(clip_from_world))
    }
}

impl Peer for Transformed {
    type Case = Segment<f32>;
    type Input = [World; 2];
    type Output<'a> = Option<ClipEdge<()>>;

    fn who(&self) -> Who {
        who("transform + clip", "view_frustum::clip; ends in clip space")
    }

    fn prepare(&self, segment: &Segment<f32>) -> [World; 2] {
        world_points(segment)
    }

    fn run(&mut self, points: &[World; 2]) -> Option<ClipEdge<()>> {
        let edge = plain_edge(&self.0.matrix, points);
        clip_one(&edge, &mut self.0.out)
    }

    fn answer(&mut self, segment: &Segment<f32>) -> Found<f32> {
        self.0.answer(segment)
    }
}

/// The transform and the clipping of all edges in one slice; ends in clip space.
pub struct Slice {
    inner: Prepared,
    edges: Vec<ClipEdge<()>>,
}

impl Slice {
    /// With a matrix from the world to clip space.
    pub fn new(clip_from_world: [[f32; 4]; 4]) -> Self {
        Self {
            inner: Prepared::new(clip_from_world),
            edges: Vec::new(),
        }
    }
}

impl Peer for Slice {
    type Case = Segment<f32>;
    type Input = [World; 2];
    type Output<'a> = Option<ClipEdge<()>>;

    fn who(&self) -> Who {
        who(
            "transform + clip, slices",
            "view_frustum::clip of 1,024 edges a call; ends in clip space",
        )
    }

    fn prepare(&self, segment: &Segment<f32>) -> [World; 2] {
        world_points(segment)
    }

    fn run(&mut self, points: &[World; 2]) -> Option<ClipEdge<()>> {
        let edge = plain_edge(&self.inner.matrix, points);
        clip_one(&edge, &mut self.inner.out)
    }

    fn answer(&mut self, segment: &Segment<f32>) -> Found<f32> {
        self.inner.answer(segment)
    }

    fn pass(&mut self, inputs: &[[World; 2]]) {
        let matrix = &self.inner.matrix;
        for some in inputs.chunks(PIECE) {
            self.edges.clear();
            let edges = some.iter().map(|points| plain_edge(matrix, points));
            self.edges.extend(edges);
            self.inner.out.clear();
            view_frustum::clip(&self.edges[..], &mut self.inner.out);
            std::hint::black_box(&self.inner.out);
        }
    }
}

/// The transform and the clipping, the world's position an attribute; ends in the world.
pub struct Attributed {
    matrix: ProjMat3,
    out: Vec<ClipEdge<World>>,
}

impl Attributed {
    /// With a matrix from the world to clip space.
    pub fn new(clip_from_world: [[f32; 4]; 4]) -> Self {
        Self {
            matrix: projection(clip_from_world),
            out: Vec::with_capacity(4),
        }
    }
}

impl Peer for Attributed {
    type Case = Segment<f32>;
    type Input = [World; 2];
    type Output<'a> = Option<ClipEdge<World>>;

    fn who(&self) -> Who {
        who(
            "transform + clip, positions",
            "view_frustum::clip; positions as attributes give ends in the world",
        )
    }

    fn prepare(&self, segment: &Segment<f32>) -> [World; 2] {
        world_points(segment)
    }

    fn run(&mut self, [p, q]: &[World; 2]) -> Option<ClipEdge<World>> {
        // Not `[p, q].map(...)`: that made it four times as slow as without positions.
        let a = clip_vertex(&self.matrix, p, *p);
        let b = clip_vertex(&self.matrix, q, *q);
        clip_one(&Edge(a, b), &mut self.out)
    }

    fn answer(&mut self, segment: &Segment<f32>) -> Found<f32> {
        match self.run(&world_points(segment)) {
            None => Found::Nothing,
            Some(Edge(a, b)) => part(segment, [a.attrib.0, b.attrib.0]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Camera;

    #[test]
    fn the_way_back_is_the_inverse() {
        let matrix = Camera::LATTICE.clip_from_world_f32();
        let back = Unprojected::new(&matrix);
        let clip = projection(matrix).apply(&pt3(0.5, -1.25, 2.0));
        assert_eq!(clip.0, [0.5, -1.25, 1.0, 2.0]);
        assert_eq!(back.world(&clip), [0.5, -1.25, 2.0].into());
    }
}
