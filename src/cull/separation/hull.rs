//! A frustum as the hull of points and rays in its frame, where its vertices are stored values.

use crate::exact::Number;
use crate::frustum::Shape;
use crate::frustum::corners::ends;
use crate::frustum::eval::exact_vec::{Dyadic, Dyadic3, cross, dot, exact};
use crate::math::Vec3;
use std::cmp::Ordering;

/// An edge, possibly of zero length.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// The indices of its vertices; a ray has one.
    pub(super) from: usize,
    pub(super) to: Option<usize>,
    /// Its direction, never zero.
    pub(super) along: Dyadic3,
}

/// A frustum's vertices, the directions in which it is infinite, and its edges.
#[derive(Clone, Debug)]
pub(super) struct Hull {
    pub(super) points: Vec<Dyadic3>,
    pub(super) rays: Vec<Dyadic3>,
    pub(super) edges: Vec<Edge>,
}

impl Hull {
    pub(super) fn new(shape: &Shape) -> Self {
        let [near, other] = ends(shape);
        let mut hull = Self {
            points: near.to_vec(),
            rays: Vec::new(),
            edges: Vec::new(),
        };
        hull.rim(0);
        if let Shape::Finite { .. } = shape {
            hull.points.extend(other);
            hull.rim(4);
            for i in 0..4 {
                let (from, to) = (&hull.points[i], &hull.points[4 + i]);
                hull.edges.push(Edge {
                    from: i,
                    to: Some(4 + i),
                    along: [0, 1, 2].map(|k| &to[k] - &from[k]),
                });
            }
        } else {
            hull.rays = other.to_vec();
            let rays = hull.rays.iter().cloned().enumerate();
            hull.edges.extend(rays.map(|(from, along)| Edge {
                from,
                to: None,
                along,
            }));
        }
        hull
    }

    /// Adds the edges of the end whose first corner has this index.
    fn rim(&mut self, first: usize) {
        let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        for (i, along) in [x, y, x, y].into_iter().enumerate() {
            self.edges.push(Edge {
                from: first + i,
                to: Some(first + (i + 1) % 4),
                along: along.map(Dyadic::from),
            });
        }
    }

    /// The sign over the frustum of `n . x` minus its value at a point; `None` if there are two.
    pub(super) fn side(&self, normal: &Dyadic3, point: usize) -> Option<Ordering> {
        let at = dot(normal, &self.points[point]);
        let points = self.points.iter().map(|p| (&dot(normal, p) - &at).sign());
        let rays = self.rays.iter().map(|r| dot(normal, r).sign());
        let mut side = Ordering::Equal;
        for sign in points.chain(rays) {
            match (side, sign) {
                (_, Ordering::Equal) => {}
                (Ordering::Equal, _) => side = sign,
                (side, sign) if side != sign => return None,
                _ => {}
            }
        }
        Some(side)
    }

    /// Whether the range of `n . x` from `middle - reach` to `middle + reach` is disjoint from the
    /// frustum's.
    pub(super) fn is_separated(&self, normal: &Dyadic3, middle: &Dyadic, reach: &Dyadic) -> bool {
        let has_ray = |wanted: Ordering| {
            let mut rays = self.rays.iter();
            rays.any(|r| dot(normal, r).sign() == wanted)
        };
        let all = |end: &Dyadic, wanted: Ordering| {
            let mut points = self.points.iter();
            points.all(|p| (&dot(normal, p) - end).sign() == wanted)
        };
        all(&(middle + reach), Ordering::Greater) && !has_ray(Ordering::Less)
            || all(&(middle - reach), Ordering::Less) && !has_ray(Ordering::Greater)
    }
}

/// Takes points and vectors of the world to a frustum's frame.
pub(super) struct ToFrame {
    axes: [Dyadic3; 3],
    origin: Dyadic3,
}

impl ToFrame {
    /// From a pose.
    pub(super) fn new(axes: [Vec3<f64>; 3], origin: Vec3<f64>) -> Self {
        Self {
            axes: axes.map(exact),
            origin: exact(origin),
        }
    }

    pub(super) fn point(&self, p: Vec3<f64>) -> Dyadic3 {
        let p = exact(p);
        self.turned(&[0, 1, 2].map(|k| &p[k] - &self.origin[k]))
    }

    pub(super) fn vector(&self, v: Vec3<f64>) -> Dyadic3 {
        self.turned(&exact(v))
    }

    fn turned(&self, v: &Dyadic3) -> Dyadic3 {
        self.axes.each_ref().map(|axis| dot(axis, v))
    }
}

/// The cross product of each pair.
pub(super) fn crosses([a, b, c]: &[Dyadic3; 3]) -> [Dyadic3; 3] {
    [cross(a, b), cross(b, c), cross(c, a)]
}
