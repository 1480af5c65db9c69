//! Whether a sphere is separate from the frustum.
//!
//! The point of the frustum nearest to the sphere's center is the center itself, or lies in a face
//! that has the center strictly outside, in an edge, or is a vertex; in a face or an edge it is the
//! foot of the perpendicular. So the sphere meets the frustum exactly if its center is inside or one
//! of these feet is in the frustum and close enough:
//! ```text
//! face i      the foot is in the frustum if g_j n_i.n_i - g_i n_i.n_j >= 0 for all faces j;
//!             close enough, since the face plane does not reject the sphere
//! edge        w = c - start, t = w.along: in the edge if 0 <= t <= along.along;
//!             close if |w x along|^2 <= r^2 along.along
//! vertex      close if w.w <= r^2
//! ```
//! where g_i is the value of a face's half space at the center. All is done in `f64`, and where that
//! leaves the answer open in integers. There everything is multiplied by the determinant of the
//! pose, which is the denominator of vertices in the world.
//!
//! # Error bounds
//! With u = 2^-53, a vertex is rounded once, and so is a difference to it: its coordinates are off
//! by at most `e = u (|start| + |w|)`. The bound of a formula is relative to the sum of its terms'
//! magnitudes, and more than one and a half times the sum of its rounding errors. Every input is
//! zero or between 2^-150 and 2^150: no product overflows, and what underflow does is far below the
//! bounds.

use super::hull::{Edge, Hull};
use super::is_moderate;
use crate::cull::VolumeCounts;
use crate::cull::volume::Sphere;
use crate::exact::Number;
use crate::frustum::Frustum;
use crate::frustum::corners::Inverse;
use crate::frustum::eval::exact_vec::{Dyadic, Dyadic3, Rounded, cross, dot, exact};
use crate::frustum::eval::half_space::{HalfSpace, size, value};
use crate::math::{Real, Vec3};
use std::cmp::Ordering;

const U: f64 = f64::UNIT_ROUNDOFF;

/// The data of a frustum that the test of spheres needs.
#[derive(Clone, Debug)]
pub(super) struct SphereSeparation {
    exact: Skeleton,
    /// The inner products of the half spaces' normals.
    products: Vec<[f64; 6]>,
    vertices: Vec<Vec3<f64>>,
    edges: Vec<RoundedEdge>,
    /// Whether all vertices and edges are moderate, so that `f64` can decide.
    is_moderate: bool,
}

#[derive(Clone, Debug)]
struct RoundedEdge {
    start: Vec3<f64>,
    along: Vec3<f64>,
    has_end: bool,
}

/// Vertices and edges in the world, multiplied by the pose's determinant.
#[derive(Clone, Debug)]
struct Skeleton {
    determinant: Dyadic,
    vertices: Vec<Dyadic3>,
    /// Start, direction, and whether the edge has an end.
    edges: Vec<(Dyadic3, Dyadic3, bool)>,
    products: Vec<Vec<Dyadic>>,
}

impl Skeleton {
    fn new(inverse: &Inverse, hull: &Hull, half_spaces: &[HalfSpace]) -> Self {
        let points = &hull.points;
        let to_world = |edge: &Edge| {
            let along = match edge.to {
                Some(to) => [0, 1, 2].map(|k| &points[to][k] - &points[edge.from][k]),
                None => edge.along.clone(),
            };
            let is_point = along.iter().all(|x| x.order().is_eq());
            (!is_point).then(|| {
                let start = inverse.point(&points[edge.from]);
                (start, inverse.vector(&along), edge.to.is_some())
            })
        };
        let products = |a: &HalfSpace| half_spaces.iter().map(|b| a.product(b)).collect();
        Self {
            vertices: points.iter().map(|p| inverse.point(p)).collect(),
            edges: hull.edges.iter().filter_map(to_world).collect(),
            products: half_spaces.iter().map(products).collect(),
            determinant: inverse.determinant.clone(),
        }
    }

    /// Precondition: no face plane rejects the sphere.
    fn is_separate(&self, half_spaces: &[HalfSpace], sphere: &Sphere<f64>) -> bool {
        let values: Vec<Dyadic> = half_spaces
            .iter()
            .map(|h| h.integer(sphere.center))
            .collect();
        if values.iter().all(|v| v.sign() != Ordering::Less) {
            return false;
        }
        let center = exact(sphere.center).map(|x| &x * &self.determinant);
        let radius = &Dyadic::from(sphere.radius) * &self.determinant;
        let square = &radius * &radius;
        let has_vertex = |v: &Dyadic3| {
            let w = [0, 1, 2].map(|k| &center[k] - &v[k]);
            at_most(&dot(&w, &w), &square)
        };
        let has_edge = |(start, along, has_end): &(Dyadic3, Dyadic3, bool)| {
            let w = [0, 1, 2].map(|k| &center[k] - &start[k]);
            let (t, length) = (dot(&w, along), dot(along, along));
            let across = cross(&w, along);
            t.sign() != Ordering::Less
                && (!has_end || at_most(&t, &length))
                && at_most(&dot(&across, &across), &(&square * &length))
        };
        !(self.has_foot(&values)
            || self.vertices.iter().any(has_vertex)
            || self.edges.iter().any(has_edge))
    }

    /// Whether the foot on a face that has the center outside is in the frustum.
    fn has_foot(&self, values: &[Dyadic]) -> bool {
        let is_in = |i: usize| {
            let (value, products) = (&values[i], &self.products[i]);
            let mut others = values.iter().zip(products);
            value.sign() == Ordering::Less
                && others.all(|(v, product)| at_most(&(value * product), &(v * &products[i])))
        };
        (0..values.len()).any(is_in)
    }
}

fn at_most(a: &Dyadic, b: &Dyadic) -> bool {
    (a - b).sign() != Ordering::Greater
}

/// Whether a foot is a point of the frustum in the sphere.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Foot {
    Yes,
    No,
    Undecided,
}

/// Whether `a <= b`, if that is certain with an error of the difference.
fn is_at_most(a: f64, b: f64, error: f64) -> Foot {
    if a + error < b {
        Foot::Yes
    } else if a - error > b {
        Foot::No
    } else {
        Foot::Undecided
    }
}

impl Foot {
    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Foot::Yes, Foot::Yes) => Foot::Yes,
            (Foot::No, _) | (_, Foot::No) => Foot::No,
            _ => Foot::Undecided,
        }
    }
}

impl SphereSeparation {
    pub(super) fn new(frustum: &Frustum, half_spaces: &[HalfSpace]) -> Self {
        let inverse = Inverse::new(frustum);
        let exact = Skeleton::new(&inverse, &Hull::new(frustum.shape()), half_spaces);
        let vertices: Vec<_> = exact.vertices.iter().map(|v| inverse.rounded(v)).collect();
        let edges = exact
            .edges
            .iter()
            .map(|(start, along, has_end)| RoundedEdge {
                start: inverse.rounded(start),
                along: inverse.rounded(along),
                has_end: *has_end,
            });
        let edges: Vec<_> = edges.collect();
        let products = exact.products.iter().map(|products| {
            let mut rounded = [0.0; 6];
            for (to, product) in rounded.iter_mut().zip(products) {
                *to = product.to_f64();
            }
            rounded
        });
        let inputs = vertices.iter().chain(edges.iter().map(|e| &e.along));
        Self {
            is_moderate: inputs.flat_map(|v| v.to_array()).all(is_moderate),
            products: products.collect(),
            vertices,
            edges,
            exact,
        }
    }

    /// Precondition: no face plane rejects the sphere.
    pub(super) fn is_separate(
        &self,
        half_spaces: &[HalfSpace],
        sphere: &Sphere<f64>,
        counts: &mut VolumeCounts,
    ) -> bool {
        match self.is_separate_rounded(half_spaces, sphere) {
            Some(is_separate) => is_separate,
            None => {
                counts.filter_failures += 1;
                counts.integers += 1;
                self.exact.is_separate(half_spaces, sphere)
            }
        }
    }

    /// The answer in `f64`, if that is certain.
    fn is_separate_rounded(&self, half_spaces: &[HalfSpace], sphere: &Sphere<f64>) -> Option<bool> {
        let [x, y, z] = sphere.center.to_array();
        if !self.is_moderate || ![x, y, z, sphere.radius].into_iter().all(is_moderate) {
            return None;
        }
        let size = size(sphere.center);
        let (mut values, mut errors) = ([0.0; 6], [0.0; 6]);
        for (i, half_space) in half_spaces.iter().enumerate().take(6) {
            values[i] = value(half_space.rounded(), sphere.center);
            errors[i] = half_space.threshold(size);
        }
        let count = half_spaces.len().min(6);
        // A center inside all faces has no foot.
        if (0..count).all(|i| values[i] > errors[i]) {
            return Some(false);
        }
        let faces = (0..count).map(|i| self.face(i, &values[..count], &errors));
        let edges = self.edges.iter().map(|edge| edge.foot(sphere));
        let vertices = self.vertices.iter().map(|&v| vertex(v, sphere));
        let mut is_certain = true;
        for foot in faces.chain(vertices).chain(edges) {
            match foot {
                Foot::Yes => return Some(false),
                Foot::No => {}
                Foot::Undecided => is_certain = false,
            }
        }
        is_certain.then_some(true)
    }

    /// The foot on a face, if that has the center outside.
    fn face(&self, i: usize, values: &[f64], errors: &[f64; 6]) -> Foot {
        if values[i] > errors[i] {
            return Foot::No;
        }
        let products = &self.products[i];
        let square = products[i];
        let mut foot = is_at_most(values[i], 0.0, errors[i]);
        for (j, value) in values.iter().enumerate().filter(|(j, _)| *j != i) {
            let (a, b) = (values[i] * products[j], value * square);
            let error = errors[i] * products[j].abs() + errors[j] * square;
            foot = foot.and(is_at_most(a, b, error + 16.0 * U * (a.abs() + b.abs())));
        }
        foot
    }
}

/// The vector from a vertex to the center, the sum of its coordinates' magnitudes, and the error
/// bound of a coordinate.
fn from(start: Vec3<f64>, sphere: &Sphere<f64>) -> (Vec3<f64>, f64, f64) {
    let w = sphere.center - start;
    (w, size(w), 2.0 * U * (size(start) + 2.0 * size(w)))
}

fn vertex(v: Vec3<f64>, sphere: &Sphere<f64>) -> Foot {
    let (w, long, off) = from(v, sphere);
    let (distance, square) = (w.dot(w), sphere.radius * sphere.radius);
    let error = 2.0 * long * off + 3.0 * off * off + 8.0 * U * (distance + square);
    is_at_most(distance, square, error)
}

impl RoundedEdge {
    fn foot(&self, sphere: &Sphere<f64>) -> Foot {
        let (w, long, off) = from(self.start, sphere);
        let across = w.cross(self.along);
        let along = size(self.along);
        // The error bound of a coordinate of the product, and of t.
        let off = along * (2.0 * off + 8.0 * U * long);
        let (t, length) = (w.dot(self.along), self.along.dot(self.along));
        let (distance, reach) = (across.dot(across), sphere.radius * sphere.radius * length);
        let error =
            2.0 * size(across) * off + 3.0 * off * off + 8.0 * U * distance + 16.0 * U * reach;
        let mut foot = is_at_most(distance, reach, error).and(is_at_most(0.0, t, off));
        if self.has_end {
            foot = foot.and(is_at_most(t, length, off + 8.0 * U * length));
        }
        foot
    }
}
