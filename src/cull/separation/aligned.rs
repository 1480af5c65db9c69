//! The separating axis test of axis-aligned boxes.
//!
//! # Idea
//! Every box has the world's axes as its edges, so all 26 axes are the same for all boxes: along
//! each, the frustum's support is a half space that contains the frustum. An edge of the frustum
//! and an axis of the world give one only if the edge bounds the frustum's shadow along that
//! axis; so there are at most 24 of these, and six of the frustum's bounding box, less duplicates
//! and those of faces. They are computed once, exactly, on first use; a box is separate exactly
//! if one of them has all of it outside. That is the test of faces again, with the same filter,
//! stages and corners (`frustum/eval/half_space.rs`).
//!
//! ```text
//! for each axis j of the world, in the frame: u
//!     for each edge of the frustum through v along w:
//!         n = u x w; if n . (x - v) has one sign over the frustum: the half space
//!     for the other two axes' product n: the half spaces at the least and greatest n . x
//! ```
//! In the frame the frustum's vertices are its stored values, so everything is sums and products
//! of `f64` values. A half space is taken to the world by its values on the axes:
//! `n . A (p - o)` has the normal `(n . A e_k)`.

use super::hull::Hull;
use crate::cull::support::{Centred, Extent};
use crate::cull::unbounded::Unbounded;
use crate::cull::volume::Aabb;
use crate::cull::{Containment, VolumeCounts};
use crate::exact::Number;
use crate::frustum::Frustum;
use crate::frustum::eval::exact_vec::{Dyadic, Dyadic3, cross, dot};
use crate::frustum::eval::half_space::{HalfSpace, OFFSET_LIMIT, threshold};
use std::cmp::Ordering;
use wide::f64x4;

/// The images of the world's axes in the frame.
fn images(frustum: &Frustum) -> [Dyadic3; 3] {
    let axes = frustum.pose().axes;
    [0, 1, 2].map(|k| axes.map(|a| Dyadic::from(a[k])))
}

/// The half space in the world of a normal in the frame and the vertex that bounds it.
fn to_world(
    frustum: &Frustum,
    images: &[Dyadic3; 3],
    normal: &Dyadic3,
    vertex: &Dyadic3,
) -> Option<HalfSpace> {
    let origin = frustum.pose().origin;
    let [x, y, z] = images.each_ref().map(|image| dot(normal, image));
    let mut offset = -&dot(normal, vertex);
    for (component, o) in [&x, &y, &z].into_iter().zip(origin.to_array()) {
        offset = &offset - &(component * &Dyadic::from(o));
    }
    HalfSpace::new([x, y, z, offset])
}

/// The half spaces of which at least one, or a face's, has an axis-aligned box outside if it is
/// separate from the frustum.
fn separators(frustum: &Frustum, hull: &Hull) -> Vec<HalfSpace> {
    let images = images(frustum);
    let mut all = Vec::new();
    let mut add = |normal: &Dyadic3, point: usize| {
        let normal = match hull.side(normal, point) {
            Some(Ordering::Greater) => normal.clone(),
            Some(Ordering::Less) => normal.each_ref().map(|n| -n),
            _ => return,
        };
        all.extend(to_world(frustum, &images, &normal, &hull.points[point]));
    };
    for j in 0..3 {
        for edge in &hull.edges {
            add(&cross(&images[j], &edge.along), edge.from);
        }
        // A face of the box: at the first vertex with the least value, and the first with the
        // greatest.
        let normal = cross(&images[(j + 1) % 3], &images[(j + 2) % 3]);
        let at = hull.points.iter().map(|p| dot(&normal, p));
        let at: Vec<Dyadic> = at.collect();
        for wanted in [Ordering::Less, Ordering::Greater] {
            let better = |a: &usize, b: &usize| (&at[*a] - &at[*b]).sign() == wanted;
            let best = (1..at.len()).fold(0, |best, i| if better(&i, &best) { i } else { best });
            add(&normal, best);
        }
    }
    all
}

/// Four half spaces side by side: normals and offsets, and the normals' magnitudes.
#[derive(Clone, Debug)]
struct FourPlanes {
    coefficients: [f64x4; 4],
    magnitudes: [f64x4; 3],
}

impl FourPlanes {
    /// If there are fewer than four, the others contain everything.
    fn new(some: &[HalfSpace]) -> Self {
        let everything = [0.0, 0.0, 0.0, OFFSET_LIMIT];
        let planes = [0, 1, 2, 3].map(|i| some.get(i).map_or(everything, HalfSpace::rounded));
        let coefficients = [0, 1, 2, 3].map(|k| f64x4::new(planes.map(|plane| plane[k])));
        let [a, b, c, _] = coefficients;
        Self {
            coefficients,
            magnitudes: [a.abs(), b.abs(), c.abs()],
        }
    }

    /// The least over the half spaces of a box's greatest values, as by [`Extent::values`].
    #[inline(always)]
    fn least(&self, Centred { center, half }: &Centred) -> f64 {
        let splat = f64x4::splat;
        let ([a, b, c, d], [x, y, z]) = (self.coefficients, self.magnitudes);
        let middle = (a * splat(center.x) + b * splat(center.y)) + (c * splat(center.z) + d);
        let reach = x * splat(half.x) + y * splat(half.y) + z * splat(half.z);
        let [a, b, c, d] = (middle + reach).to_array();
        let less = |a: f64, b: f64| if b < a { b } else { a };
        less(less(a, b), less(c, d))
    }
}

/// The separating half spaces of a frustum for axis-aligned boxes.
#[derive(Clone, Debug)]
pub(super) struct Aligned {
    separators: Box<[HalfSpace]>,
    /// The same, rounded.
    fours: Box<[FourPlanes]>,
    /// The greatest of the thresholds' constant parts.
    constant: f64,
}

impl Aligned {
    /// Half spaces of `faces` are left out: boxes were tested against these before.
    pub(super) fn new(frustum: &Frustum, faces: &[HalfSpace]) -> Self {
        let mut all: Vec<HalfSpace> = Vec::new();
        for half_space in separators(frustum, &Hull::new(frustum.shape())) {
            if !faces.iter().chain(&all).any(|h| h.is_the_same(&half_space)) {
                all.push(half_space);
            }
        }
        let constants = all.iter().map(HalfSpace::constant);
        Self {
            fours: all.chunks(4).map(FourPlanes::new).collect(),
            constant: constants.fold(0.0, f64::max),
            separators: all.into(),
        }
    }

    /// Precondition: no face plane rejects the box.
    pub(super) fn is_separate(&self, volume: &Aabb<f64>, counts: &mut VolumeCounts) -> bool {
        let middle = volume.middle();
        let size = Aabb::size(&middle);
        let threshold = threshold(size, self.constant);
        let mut is_within = true;
        for four in &self.fours {
            let least = four.least(&middle);
            if least < -threshold {
                return true;
            }
            is_within &= least > threshold;
        }
        let outside = |h: &HalfSpace| volume.is_outside(&middle, size, h, counts);
        !is_within && self.separators.iter().any(outside)
    }

    /// As [`Aligned::is_separate`], for a box that is not finite.
    pub(super) fn is_separate_unbounded(&self, v: &Unbounded, counts: &mut VolumeCounts) -> bool {
        let outside = |h: &HalfSpace| v.side(h, counts) == Containment::Outside;
        self.separators.iter().any(outside)
    }
}
