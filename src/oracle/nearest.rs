//! Exact test of whether the distance of a frustum from a point is at most a radius.
//!
//! Distances are those of the world, whatever the frame's axes are. The point of a
//! closed convex set nearest to `c` is `c` itself, or it is in the interior of a face or
//! of an edge, or it is a vertex. In the interior of a face or an edge it is the foot of
//! the perpendicular from `c`. Every such foot in the frustum is one of its points, so the
//! distance is the least of theirs:
//!
//! ```text
//! face i      foot = c - f_i(c) n_i / n_i.n_i     distance^2 = f_i(c)^2 / n_i.n_i
//!             in the frustum if f_j(c) n_i.n_i - f_i(c) n_i.n_j >= 0 for all faces j
//! edge        w = c - start, t = w.along          distance^2 = w.w - t^2 / along.along
//!             in the edge if 0 <= t <= along.along, a ray having no upper end
//! vertex                                          distance^2 = w.w
//! ```
//!
//! Each is compared with the square of the radius, with all denominators multiplied out:
//! those above, and the determinant of the pose's axes, the denominator of a frustum's
//! corners in the world.

use super::dyadic::Dyadic;
use super::frame::{Edge, Frame, Skeleton};
use super::half_space::HalfSpace;
use super::vector::{Vector, dot, minus, times};

/// An exact sphere.
#[derive(Debug)]
pub(crate) struct ExactSphere {
    pub(crate) center: Vector,
    pub(crate) radius: Dyadic,
}

/// The constants prepared for one frustum.
#[derive(Debug)]
pub(crate) struct Nearest {
    /// The inner products of the faces' normals.
    products: Vec<Vec<Dyadic>>,
    skeleton: Skeleton,
}

impl Nearest {
    pub(crate) fn new(half_spaces: &[HalfSpace], frame: &Frame) -> Self {
        let with_all = |a: &HalfSpace| {
            let all = half_spaces.iter();
            all.map(|b| dot(&a.normal, &b.normal)).collect()
        };
        Self {
            products: half_spaces.iter().map(with_all).collect(),
            skeleton: Skeleton::new(frame),
        }
    }

    /// Whether a sphere with its centre outside has a point in common with the frustum;
    /// `values` are the boundary functions at its centre.
    pub(crate) fn touches(&self, sphere: &ExactSphere, values: &[Dyadic]) -> bool {
        let square = &sphere.radius * &sphere.radius;
        self.has_face_within(values, &square)
            || self.has_edge_or_corner_within(&sphere.center, &square)
    }

    fn has_face_within(&self, values: &[Dyadic], square: &Dyadic) -> bool {
        values
            .iter()
            .zip(&self.products)
            .enumerate()
            .any(|(i, (value, products))| {
                let normal = &products[i];
                let is_close = || value * value <= square * normal;
                let foot_is_inside = || {
                    let mut others = values.iter().zip(products);
                    others.all(|(v, product)| v * normal >= value * product)
                };
                is_close() && foot_is_inside()
            })
    }

    fn has_edge_or_corner_within(&self, center: &Vector, square: &Dyadic) -> bool {
        let skeleton = &self.skeleton;
        let determinant = &skeleton.determinant;
        // In coordinates multiplied by the determinant.
        let center = times(center, determinant);
        let square = square * &(determinant * determinant);
        let corner_is_close = |corner: &Vector| {
            let w = minus(&center, corner);
            dot(&w, &w) <= square
        };
        skeleton.corners.iter().any(corner_is_close)
            || skeleton
                .edges
                .iter()
                .any(|e| is_edge_within(e, &center, &square))
    }
}

/// Whether the interior of an edge has a point within the radius.
fn is_edge_within(edge: &Edge, center: &Vector, square: &Dyadic) -> bool {
    let w = minus(center, &edge.start);
    let t = dot(&w, &edge.along);
    let length = dot(&edge.along, &edge.along);
    if t.is_negative() || (edge.has_end && t > length) {
        return false;
    }
    &(&dot(&w, &w) * &length) - &(&t * &t) <= square * &length
}
