//! Whether a box that is outside of no face is apart from the frustum all the same:
//! separating axes, decided exactly.
//!
//! # Source
//! Gottschalk, Lin, Manocha, "OBBTree" (1996): two convex polyhedra are apart exactly if
//! they are along the normal of a face of one of them or the cross product of two of
//! their edges. That is Minkowski's sum: the difference of frustum and box is a polyhedron,
//! closed and, as a frustum is never flat, with an inside; its faces' normals are these,
//! and it holds the origin exactly if frustum and box meet. So flat boxes, edges and points
//! need no case of their own, and neither does an infinite frustum, whose rays bound
//! along which normals it reaches to infinity.
//!
//! # Idea
//! An axis-aligned box's edges are the world's axes, so all 26 axes are known before any
//! box is: along each, the frustum's support is a half space that contains it. Of an edge
//! of the frustum and an axis of the world it is one only if the edge bounds the
//! frustum's shadow along that axis; so there are at most 24 of them, and six around the
//! frustum's bounding box. They are made once, exactly, when first asked for; a box is
//! apart exactly if one of them has all of it outside. That is the test of faces again,
//! with their filter, their stages and their corners ([`super::half_space`]).
//!
//! ```text
//! for each axis j of the world, in the frame: u
//!     for each edge of the frustum through v along w:
//!         n = u x w; if n . (x - v) has one sign over the frustum: the half space
//!     for the other two axes' product n: the half spaces at the least and greatest n . x
//! ```
//! In the frame the frustum's vertices are its own numbers, so all of it is sums and products
//! of doubles. A half space goes to the world by what it does to the axes:
//! `n . A (p - o)` has the normal `(n . A e_k)`.

use super::extent::Extent;
use super::half_space::HalfSpace;
use super::shape::{Aabb, VolumeError};
use super::{Containment, Culler, VolumeCounts};
use crate::exact::Number;
use crate::exact::dyadic::Dyadic;
use crate::frustum::{EndRect, Frustum, Shape};
use crate::math::Real;
use std::cmp::Ordering;

/// Exact coordinates in the frame.
type Exact = [Dyadic; 3];

fn exact(v: [f64; 3]) -> Exact {
    v.map(Dyadic::from)
}

fn dot(a: &Exact, b: &Exact) -> Dyadic {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

fn cross(a: &Exact, b: &Exact) -> Exact {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// A frustum in its frame as points, directions in which it has no end, and lines along
/// its edges.
struct Hull {
    points: Vec<Exact>,
    rays: Vec<Exact>,
    /// A point's number, and a direction.
    edges: Vec<(usize, Exact)>,
}

/// The corners of an end, going round.
fn around(end: &EndRect) -> [[f64; 3]; 4] {
    let (r, z) = (end.rect, end.z);
    [
        [r.left, r.bottom, z],
        [r.right, r.bottom, z],
        [r.right, r.top, z],
        [r.left, r.top, z],
    ]
}

impl Hull {
    fn new(shape: &Shape) -> Self {
        let mut hull = Self {
            points: around(&shape.near()).map(exact).to_vec(),
            rays: Vec::new(),
            edges: Vec::new(),
        };
        match shape {
            Shape::Finite { far, .. } => {
                hull.points.extend(around(far).map(exact));
                hull.rim(4);
                for i in 0..4 {
                    let (from, to) = (&hull.points[i], &hull.points[4 + i]);
                    let along = [0, 1, 2].map(|k| &to[k] - &from[k]);
                    hull.edges.push((i, along));
                }
            }
            Shape::Infinite {
                slopes, direction, ..
            } => {
                let z = direction.sign();
                hull.rays = around(&EndRect { z, rect: *slopes }).map(exact).to_vec();
                let rays = hull.rays.iter().cloned().enumerate();
                hull.edges.extend(rays);
            }
        }
        hull.rim(0);
        hull
    }

    /// The edges of the end whose first corner is this.
    fn rim(&mut self, first: usize) {
        let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let along = [x, y, x, y].map(exact);
        let corners = first..first + 4;
        self.edges.extend(corners.zip(along));
    }

    /// The sign that `n . x` minus its value at a point has over the frustum, if it has
    /// only one.
    fn side(&self, normal: &Exact, point: usize) -> Option<Ordering> {
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
}

/// The images of the world's axes in the frame.
fn images(frustum: &Frustum) -> [Exact; 3] {
    let axes = frustum.pose().axes;
    [0, 1, 2].map(|k| exact(axes.map(|a| a[k])))
}

/// The half space of a normal in the frame that a vertex bounds, in the world.
fn to_world(
    frustum: &Frustum,
    images: &[Exact; 3],
    normal: &Exact,
    vertex: &Exact,
) -> Option<HalfSpace> {
    let origin = frustum.pose().origin;
    let [x, y, z] = images.each_ref().map(|image| dot(normal, image));
    let mut offset = -&dot(normal, vertex);
    for (number, o) in [&x, &y, &z].into_iter().zip(origin.to_array()) {
        offset = &offset - &(number * &Dyadic::from(o));
    }
    HalfSpace::new([x, y, z, offset])
}

/// The half spaces that have an axis-aligned box outside of one of them if it is apart from
/// the frustum, but for those of its faces.
pub(super) fn separators(frustum: &Frustum) -> Box<[HalfSpace]> {
    let hull = Hull::new(frustum.shape());
    let images = images(frustum);
    let mut all = Vec::new();
    let mut add = |normal: &Exact, point: usize| {
        let normal = match hull.side(normal, point) {
            Some(Ordering::Greater) => normal.clone(),
            Some(Ordering::Less) => normal.each_ref().map(|n| -n),
            _ => return,
        };
        all.extend(to_world(frustum, &images, &normal, &hull.points[point]));
    };
    for j in 0..3 {
        for (point, along) in &hull.edges {
            add(&cross(&images[j], along), *point);
        }
        // The face of a box: at the first vertex that is least, and at the first greatest.
        let normal = cross(&images[(j + 1) % 3], &images[(j + 2) % 3]);
        let at = hull.points.iter().map(|p| dot(&normal, p));
        let at: Vec<Dyadic> = at.collect();
        for wanted in [Ordering::Less, Ordering::Greater] {
            let better = |a: &usize, b: &usize| (&at[*a] - &at[*b]).sign() == wanted;
            let best = (1..at.len()).fold(0, |best, i| if better(&i, &best) { i } else { best });
            add(&normal, best);
        }
    }
    all.into()
}

impl Culler {
    /// How a box lies to the frustum, exactly: `Crossing` only where they have a point in
    /// common and the frustum does not contain the box.
    ///
    /// Costs what [`Culler::classify`] does where that settles it, a few times that where it
    /// says `Crossing`; some hundred microseconds more the first time.
    ///
    /// ```
    /// use frusta::{Aabb, Containment, Culler, EndRect, Frustum, Pose, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let culler = Culler::new(&frustum);
    /// // Beyond the edge between right and far, outside of neither.
    /// let beyond = Aabb::new([3.5, -9.0, 2.0], [9.0, 9.0, 9.0]);
    /// assert_eq!(culler.classify(beyond)?, Containment::Crossing);
    /// assert_eq!(culler.classify_exact(beyond)?, Containment::Outside);
    /// let touching = Aabb::new([3.0, -9.0, 2.0], [9.0, 9.0, 9.0]);
    /// assert_eq!(culler.classify_exact(touching)?, Containment::Crossing);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// What [`Aabb::check`] finds.
    #[inline]
    pub fn classify_exact<T: Real>(&self, volume: Aabb<T>) -> Result<Containment, VolumeError> {
        self.classify_exact_counted(volume, &mut VolumeCounts::default())
    }

    /// As [`Culler::classify_exact`], and adds what it needed to counts, and how many boxes
    /// that are outside of no face it found to be outside.
    ///
    /// # Errors
    /// What [`Aabb::check`] finds.
    pub fn classify_exact_counted<T: Real>(
        &self,
        volume: Aabb<T>,
        counts: &mut VolumeCounts,
    ) -> Result<Containment, VolumeError> {
        let volume = volume.to_f64();
        volume.check()?;
        let class = self.by_planes(&volume, counts);
        if class != Containment::Crossing {
            return Ok(class);
        }
        counts.asked += 1;
        if self.is_apart(&volume, counts) {
            counts.false_accepts += 1;
            return Ok(Containment::Outside);
        }
        Ok(class)
    }

    fn is_apart(&self, volume: &Aabb<f64>, counts: &mut VolumeCounts) -> bool {
        let separators = self.separators();
        let middle = volume.middle();
        let size = Aabb::size(&middle);
        // Most separators settle it, one way or the other, by rounded values.
        let mut unsettled = false;
        for half_space in separators {
            let [_, greatest] = Aabb::values(&middle, half_space.rounded(), half_space.length());
            let threshold = half_space.threshold(size);
            if greatest < -threshold {
                return true;
            }
            let is_within = greatest > threshold;
            unsettled |= !is_within;
        }
        let outside = |h: &HalfSpace| volume.side(&middle, size, h, counts) == Containment::Outside;
        unsettled && separators.iter().any(outside)
    }
}
