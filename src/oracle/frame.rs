//! An exact frustum in its own frame: corners, edges and infinite rays.
//!
//! In frame coordinates `x_k = a_k . (p - o)` a frustum is the hull of two
//! rectangles, so its corners are the numbers that define it, and a point or a
//! vector of the world is transformed without a division. An infinite one is the hull
//! of a rectangle's corners, plus the cone of four rays: at depth t its section is
//! the near rectangle plus t times the rectangle of slopes.
//!
//! The way back is `p = o + (x_0 a_1 x a_2 + x_1 a_2 x a_0 + x_2 a_0 x a_1) / det`;
//! callers multiply everything by `det` instead of dividing.

use super::dyadic::Dyadic;
use super::vector::{
    Vector, align, combine, cross, dot, exact, exact_point, is_zero, minus, plus, times,
};
use crate::frustum::{EndRect, Shape};
use crate::math::{Pose, Rect, Vec3};

/// A frustum in its frame, with the frame's position in the world.
#[derive(Debug)]
pub(crate) struct Frame {
    origin: Vector,
    pub(crate) axes: [Vector; 3],
    /// The near end's four, then the far end's if there is one.
    pub(crate) corners: Vec<Vector>,
    /// From each near corner to the far one, or the direction of the ray.
    pub(crate) sides: [Vector; 4],
    is_infinite: bool,
}

/// An edge of a frustum.
#[derive(Debug)]
pub(crate) struct Edge {
    pub(crate) start: Vector,
    /// The vector to its end, or the direction of a ray.
    pub(crate) along: Vector,
    pub(crate) has_end: bool,
}

impl Frame {
    pub(crate) fn new(pose: &Pose, shape: &Shape) -> Self {
        let near = corners(&shape.near());
        let (far, sides) = match *shape {
            Shape::Finite { far, .. } => {
                let far = corners(&far);
                let sides = [0, 1, 2, 3].map(|i| minus(&far[i], &near[i]));
                (Some(far), sides)
            }
            Shape::Infinite {
                slopes, direction, ..
            } => {
                let z = direction.sign();
                (None, corners(&EndRect { z, rect: slopes }))
            }
        };
        let mut frame = Self {
            origin: exact_point(pose.origin),
            axes: pose.axes.map(exact_point),
            is_infinite: far.is_none(),
            corners: near.into_iter().chain(far.into_iter().flatten()).collect(),
            sides,
        };
        align(&mut frame.axes);
        align(&mut frame.corners);
        align(&mut frame.sides);
        frame
    }

    /// Frame coordinates of a point.
    pub(crate) fn point(&self, p: &Vector) -> Vector {
        self.vector(&minus(p, &self.origin))
    }

    /// Frame coordinates of a vector.
    pub(crate) fn vector(&self, v: &Vector) -> Vector {
        self.axes.each_ref().map(|axis| dot(axis, v))
    }

    /// The normal in the world of a plane with this normal in the frame: its inner
    /// product with `p - o` is `n . x`.
    pub(crate) fn normal_in_world(&self, n: &Vector) -> Vector {
        combine(n, &self.axes)
    }

    /// The inner product of a normal in the world with the frame's origin.
    pub(crate) fn at_origin(&self, normal: &Vector) -> Dyadic {
        dot(normal, &self.origin)
    }

    /// The directions of all edges.
    pub(crate) fn directions(&self) -> impl Iterator<Item = Vector> {
        let across = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let across = across.map(|v| v.map(exact));
        across.into_iter().chain(self.sides.clone())
    }

    /// The directions of the infinite edges.
    pub(crate) fn rays(&self) -> &[Vector] {
        if self.is_infinite { &self.sides } else { &[] }
    }

    /// The edges, without those that are a point.
    fn edges(&self) -> Vec<Edge> {
        let ends = self.corners.chunks(4).flat_map(|c| {
            let pairs = [[0, 1], [2, 3], [0, 2], [1, 3]];
            pairs.map(|[i, j]| Edge {
                start: c[i].clone(),
                along: minus(&c[j], &c[i]),
                has_end: true,
            })
        });
        let sides = self.corners.iter().zip(&self.sides).map(|(c, along)| Edge {
            start: c.clone(),
            along: along.clone(),
            has_end: !self.is_infinite,
        });
        ends.chain(sides).filter(|e| !is_zero(&e.along)).collect()
    }
}

/// Corners and edges in the world, everything multiplied by the determinant of the
/// pose's axes.
#[derive(Debug)]
pub(crate) struct Skeleton {
    pub(crate) determinant: Dyadic,
    pub(crate) corners: Vec<Vector>,
    pub(crate) edges: Vec<Edge>,
}

impl Skeleton {
    pub(crate) fn new(frame: &Frame) -> Self {
        let [a, b, c] = &frame.axes;
        let columns = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, &columns[0]);
        let origin = times(&frame.origin, &determinant);
        let point = |x: &Vector| plus(&origin, &combine(x, &columns));
        let edges = frame.edges().into_iter().map(|e| Edge {
            start: point(&e.start),
            along: combine(&e.along, &columns),
            has_end: e.has_end,
        });
        Self {
            corners: frame.corners.iter().map(point).collect(),
            edges: edges.collect(),
            determinant,
        }
    }
}

fn corners(end: &EndRect) -> [Vector; 4] {
    let Rect {
        left,
        right,
        bottom,
        top,
    } = end.rect;
    let corners = [[left, bottom], [right, bottom], [left, top], [right, top]];
    corners.map(|[x, y]| exact_point(Vec3::new(x, y, end.z)))
}
