//! The exact separating axis test of a box and a frustum.
//!
//! A box here is any `B = { c + s u + t v + w n : s, t, w in -1..=1 }`: half axes may
//! be zero, of any length and angle, or dependent.
//!
//! # Why a finite number of axes is enough
//! The frustum F is a polyhedron with vertices and with points inside, B a polytope.
//! They have no point in common exactly if 0 is not in `D = F - B`, which is a closed
//! polyhedron, and full-dimensional because F is, however flat B may be. So D is the
//! intersection of the half-spaces of its own facets, and 0 is outside of one of these.
//! The points of D at which a normal is greatest are the sums of those of F and of -B at
//! which it is greatest. A facet is therefore the sum of a face of F and a face of -B, and
//! for the two to span a plane
//!
//! - the face of F spans it: the normal is that of a face of F; or
//! - the face of -B spans it. The faces of a box in a direction are spanned by the half
//!   axes across it, so the normal is the cross product of two half axes; or
//! - each has a direction that the other does not have: that of an edge of F, and a half
//!   axis. (A face that spans the plane is one of the cases above.)
//!
//! Dependent half axes are no special case: the argument does not depend on the number of
//! half axes of a face, and a flat box is a face of itself. Additional axes do no harm:
//! for any normal, disjoint intervals prove disjoint sets.
//!
//! An infinite frustum's interval has no end where the normal rises along one of its
//! rays. Its edges are then rays, with directions like any other.
//!
//! # Where it is computed
//! Separation is invariant under linear maps, so it can be tested in the frame, where a
//! frustum's corners are short numbers. The axes of an axis-aligned box are
//! the same for all boxes: they and the frustum's intervals are prepared once, over
//! world coordinates.

use super::dyadic::Dyadic;
use super::frame::Frame;
use super::vector::{Vector, align, cross, dot, is_zero};
use std::slice;

/// An exact box.
#[derive(Clone, Debug)]
pub(crate) struct ExactBox {
    pub(crate) center: Vector,
    pub(crate) half_axes: [Vector; 3],
}

impl ExactBox {
    pub(crate) fn new(mut center: Vector, mut half_axes: [Vector; 3]) -> Self {
        align(slice::from_mut(&mut center));
        align(&mut half_axes);
        Self { center, half_axes }
    }

    /// The largest difference of a linear function on the box from its value at the centre.
    pub(crate) fn reach(&self, normal: &Vector) -> Dyadic {
        let [a, b, c] = self.half_axes.each_ref().map(|h| dot(normal, h).abs());
        a + b + c
    }

    fn in_frame(&self, frame: &Frame) -> Self {
        let half_axes = self.half_axes.each_ref().map(|h| frame.vector(h));
        Self::new(frame.point(&self.center), half_axes)
    }
}

/// The range of a linear function on a frustum; an end is `None` if it is infinite.
#[derive(Debug)]
struct Slab {
    normal: Vector,
    least: Option<Dyadic>,
    greatest: Option<Dyadic>,
}

impl Slab {
    /// In the frame; `None` for the zero vector, which bounds nothing.
    fn new(frame: &Frame, normal: Vector) -> Option<Self> {
        if is_zero(&normal) {
            return None;
        }
        let values = || frame.corners.iter().map(|c| dot(&normal, c));
        let slopes: Vec<i32> = frame
            .rays()
            .iter()
            .map(|r| dot(&normal, r).signum())
            .collect();
        let falls = slopes.iter().any(|s| *s < 0);
        let rises = slopes.iter().any(|s| *s > 0);
        Some(Self {
            least: values().min().filter(|_| !falls),
            greatest: values().max().filter(|_| !rises),
            normal,
        })
    }

    /// The same slab over world coordinates.
    fn in_world(self, frame: &Frame) -> Self {
        let normal = frame.normal_in_world(&self.normal);
        let shift = frame.at_origin(&normal);
        let moved = |v: Option<Dyadic>| v.map(|v| &v + &shift);
        Self {
            least: moved(self.least),
            greatest: moved(self.greatest),
            normal,
        }
    }

    /// Whether the box's values are all less or all greater than the frustum's.
    fn separates(&self, shape: &ExactBox) -> bool {
        let middle = dot(&self.normal, &shape.center);
        let reach = shape.reach(&self.normal);
        let below = |least: &Dyadic| &middle + &reach < *least;
        let above = |greatest: &Dyadic| &middle - &reach > *greatest;
        self.least.as_ref().is_some_and(below) || self.greatest.as_ref().is_some_and(above)
    }
}

/// The axes that are not normals of the frustum's faces, for half axes in these
/// directions of the frame.
fn axes(frame: &Frame, half_axes: &[Vector; 3]) -> impl Iterator<Item = Vector> {
    let [a, b, c] = half_axes;
    let faces = [cross(a, b), cross(b, c), cross(c, a)];
    let edges = frame
        .directions()
        .flat_map(|edge| half_axes.each_ref().map(|h| cross(&edge, h)));
    faces.into_iter().chain(edges)
}

/// The constants prepared for one frustum.
#[derive(Debug)]
pub(crate) struct Separation {
    frame: Frame,
    /// For boxes along the world's axes.
    aligned: Vec<Slab>,
}

impl Separation {
    pub(crate) fn new(frame: Frame) -> Self {
        let [x, y, z] = &frame.axes;
        // The world's axes in the frame: the columns of the pose's matrix.
        let along = [0, 1, 2].map(|j| [x[j].clone(), y[j].clone(), z[j].clone()]);
        let slabs = axes(&frame, &along).filter_map(|n| Slab::new(&frame, n));
        let aligned = slabs.map(|s| s.in_world(&frame)).collect();
        Self { frame, aligned }
    }

    /// Whether one of these axes separates a box along the world's axes.
    pub(crate) fn separates_aligned(&self, shape: &ExactBox) -> bool {
        self.aligned.iter().any(|slab| slab.separates(shape))
    }

    /// Whether one of these axes separates a box.
    pub(crate) fn separates(&self, shape: &ExactBox) -> bool {
        let shape = shape.in_frame(&self.frame);
        axes(&self.frame, &shape.half_axes)
            .filter_map(|n| Slab::new(&self.frame, n))
            .any(|slab| slab.separates(&shape))
    }
}
