//! Whether an axis-aligned box is apart from the frustum.
//!
//! # Idea
//! A box's edges are the world's axes, so all 26 axes are known before any
//! box is: along each, the frustum's support is a half space that contains it. Of an edge
//! of the frustum and an axis of the world it is one only if the edge bounds the
//! frustum's shadow along that axis; so there are 24 of them, and six around the
//! frustum's bounding box, less those that are the same or a face's. They are made once, exactly, when first asked for; a box is
//! apart exactly if one of them has all of it outside. That is the test of faces again,
//! with their filter, their stages and their corners (`half_space.rs`).
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

use super::hull::Hull;
use crate::cull::VolumeCounts;
use crate::cull::support::{Centred, Extent};
use crate::cull::volume::Aabb;
use crate::exact::Number;
use crate::frustum::Frustum;
use crate::frustum::eval::exact_vec::{Dyadic, Dyadic3, cross, dot};
use crate::frustum::eval::half_space::{HalfSpace, MOST, threshold};
use std::cmp::Ordering;
use wide::f64x4;

/// The images of the world's axes in the frame.
fn images(frustum: &Frustum) -> [Dyadic3; 3] {
    let axes = frustum.pose().axes;
    [0, 1, 2].map(|k| axes.map(|a| Dyadic::from(a[k])))
}

/// The half space of a normal in the frame that a vertex bounds, in the world.
fn to_world(
    frustum: &Frustum,
    images: &[Dyadic3; 3],
    normal: &Dyadic3,
    vertex: &Dyadic3,
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
    all
}

/// Four half spaces side by side: normals and offsets, and the normals' magnitudes.
#[derive(Clone, Debug)]
struct Four {
    numbers: [f64x4; 4],
    magnitudes: [f64x4; 3],
}

impl Four {
    /// Where there are fewer, everything is inside of the others.
    fn new(some: &[HalfSpace]) -> Self {
        let nothing = [0.0, 0.0, 0.0, MOST];
        let rows = [0, 1, 2, 3].map(|i| some.get(i).map_or(nothing, HalfSpace::rounded));
        let numbers = [0, 1, 2, 3].map(|k| f64x4::new(rows.map(|row| row[k])));
        let [a, b, c, _] = numbers;
        Self {
            numbers,
            magnitudes: [a.abs(), b.abs(), c.abs()],
        }
    }

    /// The least of a box's greatest values, as [`Extent::values`] has them.
    #[inline(always)]
    fn least(&self, Centred { center, half }: &Centred) -> f64 {
        let all = f64x4::splat;
        let ([a, b, c, d], [x, y, z]) = (self.numbers, self.magnitudes);
        let middle = (a * all(center.x) + b * all(center.y)) + (c * all(center.z) + d);
        let reach = x * all(half.x) + y * all(half.y) + z * all(half.z);
        let [a, b, c, d] = (middle + reach).to_array();
        let less = |a: f64, b: f64| if b < a { b } else { a };
        less(less(a, b), less(c, d))
    }
}

/// What axis-aligned boxes need of a frustum.
#[derive(Clone, Debug)]
pub(super) struct Aligned {
    separators: Box<[HalfSpace]>,
    fours: Box<[Four]>,
    /// The greatest of the thresholds' constant parts.
    constant: f64,
}

impl Aligned {
    /// `faces` are held to before.
    pub(super) fn new(frustum: &Frustum, faces: &[HalfSpace]) -> Self {
        let mut all: Vec<HalfSpace> = Vec::new();
        for half_space in separators(frustum, &Hull::new(frustum.shape())) {
            if !faces.iter().chain(&all).any(|h| h.is_the_same(&half_space)) {
                all.push(half_space);
            }
        }
        let constants = all.iter().map(HalfSpace::constant);
        Self {
            fours: all.chunks(4).map(Four::new).collect(),
            constant: constants.fold(0.0, f64::max),
            separators: all.into(),
        }
    }

    /// Of a box that is outside of no face.
    pub(super) fn is_apart(&self, volume: &Aabb<f64>, counts: &mut VolumeCounts) -> bool {
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
}
