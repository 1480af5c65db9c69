//! The separating axis test of oriented boxes.
//!
//! The axes besides the frustum's face normals are the cross products of the box's half axes, and
//! those of a half axis and one of six edge directions: 21 axes. All is done in the frame, where
//! the frustum's vertices are stored values: in `f64`, and where that leaves the answer open in
//! integers.
//!
//! # Error bound
//! With u = 2^-53 and A the pose's matrix, `A v` takes three roundings, and the difference of
//! center and origin one: 4 u |A||v|. An edge's direction is rounded once, a cross product twice:
//! a coordinate of an axis is off by at most 8 u N, where N is the cross product of magnitudes,
//! with sums for differences. Along an axis a value takes three roundings more, a gap between two
//! intervals five. So if M is the sum of the magnitudes of all terms of a gap, the gap is off by
//! ```text
//! (8 + 4 + 3 + 5) u |N| M = 20 u |N| M
//! ```
//! and the threshold is 64 u |N| M. If N is zero the axis is exactly zero. Every input is zero or
//! between 2^-150 and 2^150: no product overflows, and what underflow does is far below the
//! threshold.

use super::hull::{Hull, ToFrame, crosses};
use super::is_moderate;
use crate::cull::VolumeCounts;
use crate::cull::volume::Obb;
use crate::frustum::corners::ends;
use crate::frustum::eval::exact_vec::{Dyadic, Dyadic3, Rounded, cross, dot};
use crate::frustum::{Frustum, Shape};
use crate::math::{Real, Vec3};

/// Bounds the error of a gap relative to |N| M: 64 u, where 20 u is needed.
const GAP_RELATIVE_ERROR: f64 = 64.0 * f64::UNIT_ROUNDOFF;

/// The data of a frustum that the test of oriented boxes needs.
#[derive(Clone, Debug)]
pub(super) struct Oriented {
    hull: Hull,
    /// The axes of the pose.
    axes: [Vec3<f64>; 3],
    /// The origin of the pose.
    origin: Vec3<f64>,
    /// Coordinates of the vertices in the frame; an infinite frustum has each twice.
    vertices: [[f64; 8]; 3],
    /// The directions in which the frustum is infinite.
    rays: Vec<Vec3<f64>>,
    /// The directions of the edges: of the ends' sides, then from near to far.
    directions: [Vec3<f64>; 6],
    /// The largest coordinate of a vertex or a ray; `None` if one is not moderate.
    reach: Option<f64>,
}

/// The position of a box relative to the frustum along one axis.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Along {
    Separate,
    Overlapping,
    Undecided,
}

/// A box in the frame, and the magnitudes that its rounding errors are relative to.
struct InFrame {
    middle: Vec3<f64>,
    half_axes: [Vec3<f64>; 3],
    magnitudes: [Vec3<f64>; 3],
    /// The sum of the magnitudes of all terms of a gap.
    size: f64,
}

fn magnitude(v: Vec3<f64>) -> Vec3<f64> {
    Vec3::new(v.x.abs(), v.y.abs(), v.z.abs())
}

fn sum(v: Vec3<f64>) -> f64 {
    v.x + v.y + v.z
}

/// The cross product of magnitudes, with sums for differences.
fn cross_of_magnitudes(a: Vec3<f64>, b: Vec3<f64>) -> Vec3<f64> {
    Vec3::new(
        a.y * b.z + a.z * b.y,
        a.z * b.x + a.x * b.z,
        a.x * b.y + a.y * b.x,
    )
}

impl Oriented {
    pub(super) fn new(frustum: &Frustum) -> Self {
        let shape = frustum.shape();
        // Stored values: nothing is rounded.
        let rounded = |v: Dyadic3| Vec3::from(v.map(|x| x.to_f64()));
        let [near, other] = ends(shape).map(|corners| corners.map(rounded));
        let is_infinite = matches!(shape, Shape::Infinite { .. });
        let far = if is_infinite { near } else { other };
        let all: [Vec3<f64>; 8] = std::array::from_fn(|i| if i < 4 { near[i] } else { far[i - 4] });
        let sides = [0, 1, 2, 3].map(|i| match is_infinite {
            true => other[i],
            false => other[i] - near[i],
        });
        let (x, y) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
        let [a, b, c, d] = sides;
        let pose = frustum.pose();
        let inputs = all.iter().chain(&other).chain(&pose.axes).chain(&sides);
        let are_moderate = inputs.flat_map(|v| v.to_array()).all(is_moderate);
        let reach = all.iter().chain(&other).flat_map(|v| v.to_array());
        Self {
            hull: Hull::new(shape),
            axes: pose.axes,
            origin: pose.origin,
            vertices: [0, 1, 2].map(|k| all.map(|v| v[k])),
            rays: if is_infinite { other.to_vec() } else { vec![] },
            directions: [x, y, a, b, c, d],
            reach: are_moderate.then(|| reach.fold(0.0, |a, b| b.abs().max(a))),
        }
    }

    /// Precondition: no face plane rejects the box.
    pub(super) fn is_separate(&self, volume: &Obb<f64>, counts: &mut VolumeCounts) -> bool {
        match self.is_separate_rounded(volume) {
            Some(is_separate) => is_separate,
            None => {
                counts.filter_failures += 1;
                counts.integers += 1;
                self.is_separate_exactly(volume)
            }
        }
    }

    /// A vector in the frame, and the magnitudes of its terms.
    fn turned(&self, v: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>) {
        let dots =
            |of: fn(Vec3<f64>) -> Vec3<f64>| Vec3::from(self.axes.map(|axis| of(axis).dot(of(v))));
        (dots(|v| v), dots(magnitude))
    }

    fn in_frame(&self, volume: &Obb<f64>) -> Option<InFrame> {
        let from_origin = volume.center - self.origin;
        let inputs = volume.half_axes.iter().chain([&from_origin]);
        if !inputs.flat_map(|v| v.to_array()).all(is_moderate) {
            return None;
        }
        let (middle, mut size) = self.turned(from_origin);
        let turned = volume.half_axes.map(|h| self.turned(h));
        for (_, magnitude) in turned {
            size = size + magnitude;
        }
        Some(InFrame {
            middle,
            half_axes: turned.map(|(h, _)| h),
            magnitudes: turned.map(|(_, m)| m),
            size: sum(size) + self.reach?,
        })
    }

    /// The answer in `f64`, if that is certain.
    fn is_separate_rounded(&self, volume: &Obb<f64>) -> Option<bool> {
        let volume = &self.in_frame(volume)?;
        let (h, m) = (&volume.half_axes, &volume.magnitudes);
        let mut all_overlap = true;
        let mut is_separated = |normal: Vec3<f64>, magnitude: Vec3<f64>, across: Option<usize>| {
            let along = self.along(volume, normal, sum(magnitude), across);
            all_overlap &= along == Along::Overlapping;
            along == Along::Separate
        };
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            if is_separated(h[i].cross(h[j]), cross_of_magnitudes(m[i], m[j]), None) {
                return Some(true);
            }
        }
        for (i, direction) in self.directions.into_iter().enumerate() {
            for k in 0..3 {
                let magnitude = cross_of_magnitudes(magnitude(direction), m[k]);
                if is_separated(direction.cross(h[k]), magnitude, i.checked_sub(2)) {
                    return Some(true);
                }
            }
        }
        all_overlap.then_some(false)
    }

    /// Compares the ranges along a normal. `across` is the ray that the normal is perpendicular to
    /// by construction.
    fn along(
        &self,
        volume: &InFrame,
        normal: Vec3<f64>,
        magnitude: f64,
        across: Option<usize>,
    ) -> Along {
        if magnitude == 0.0 {
            return Along::Overlapping;
        }
        let [xs, ys, zs] = &self.vertices;
        let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..8 {
            let at = normal.dot(Vec3::new(xs[i], ys[i], zs[i]));
            least = if at < least { at } else { least };
            greatest = if at > greatest { at } else { greatest };
        }
        let middle = normal.dot(volume.middle);
        let [a, b, c] = volume.half_axes.map(|h| normal.dot(h).abs());
        let reach = a + b + c;
        let threshold = GAP_RELATIVE_ERROR * magnitude * volume.size;
        let (below, above) = (least - (middle + reach), (middle - reach) - greatest);
        let sides = [
            (below, self.rays_rise(normal, threshold, across)),
            (above, self.rays_rise(-normal, threshold, across)),
        ];
        let mut result = Along::Overlapping;
        for (gap, rise) in sides {
            match rise {
                _ if gap < -threshold => {}
                Some(false) => {}
                Some(true) if gap > threshold => return Along::Separate,
                _ => result = Along::Undecided,
            }
        }
        result
    }

    /// Whether all rays rise along a normal, if that is certain.
    fn rays_rise(&self, normal: Vec3<f64>, threshold: f64, across: Option<usize>) -> Option<bool> {
        let rays = self.rays.iter().enumerate();
        let rises = rays
            .filter(|(i, _)| Some(*i) != across)
            .map(|(_, ray)| normal.dot(*ray));
        let least = rises.fold(f64::INFINITY, |a, b| if b < a { b } else { a });
        if least < -threshold {
            Some(false)
        } else if least > threshold {
            Some(true)
        } else {
            None
        }
    }

    fn is_separate_exactly(&self, volume: &Obb<f64>) -> bool {
        let to_frame = ToFrame::new(self.axes, self.origin);
        let middle = to_frame.point(volume.center);
        let half_axes = volume.half_axes.map(|h| to_frame.vector(h));
        let is_separate = |normal: &Dyadic3| {
            let reach = half_axes.iter().map(|h| dot(normal, h).abs());
            let reach = reach.fold(Dyadic::from(0.0), |a, b| &a + &b);
            let middle = dot(normal, &middle);
            self.hull.is_separated(normal, &middle, &reach)
        };
        let edges = self.hull.edges.iter();
        crosses(&half_axes).iter().any(is_separate)
            || edges
                .flat_map(|edge| half_axes.iter().map(|h| cross(&edge.along, h)))
                .any(|normal| is_separate(&normal))
    }
}
