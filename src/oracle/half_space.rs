//! A frustum's faces as linear inequalities over world coordinates, exactly.
//!
//! They follow from the definition: frame coordinates are `a_k . (p - o)`, and
//! the frustum is the closed convex hull of two rectangles (or a rectangle that
//! grows with depth). Between two rectangles at `zn` and `zf` the right bound at
//! `z` is `(rn (zf - z) + rf (z - zn)) / (zf - zn)`; multiplied by `|zf - zn|` it has no
//! division. Ends that shrink to an edge or a point are no special case: the
//! inequalities of all faces together hold there and nowhere beyond.

use super::dyadic::Dyadic;
use super::vector::{Vector, align, dot, exact, exact_point, plus, times};
use crate::frustum::{Direction, EndRect, Face, Frustum, Shape};
use crate::math::{Rect, Vec3};
use std::slice;

/// The points `p` with `normal . p + offset >= 0`; zero on the face's plane.
#[derive(Debug)]
pub(crate) struct HalfSpace {
    pub(crate) face: Face,
    pub(crate) normal: Vector,
    offset: Dyadic,
}

/// A linear function of a point: `gradient . p + constant`.
#[derive(Clone)]
struct Linear {
    gradient: Vector,
    constant: Dyadic,
}

impl HalfSpace {
    /// The boundary function: positive inside, zero on the plane.
    pub(crate) fn value_at(&self, point: &Vector) -> Dyadic {
        &dot(&self.normal, point) + &self.offset
    }
}

/// The six faces' half-spaces, five if there is no far face.
///
/// A number that is not finite counts as zero; no frustum has one.
pub(crate) fn half_spaces(frustum: &Frustum) -> Vec<HalfSpace> {
    let pose = frustum.pose();
    let origin = exact_point(pose.origin);
    let [x, y, z] = pose.axes.map(|axis| frame_coordinate(axis, &origin));
    let (ends, sides) = match *frustum.shape() {
        Shape::Finite { near, far } => finite(&near, &far, [&x, &y], &z),
        Shape::Infinite {
            near,
            slopes,
            direction,
        } => infinite(&near, &slopes, direction, [&x, &y], &z),
    };
    ends.into_iter()
        .chain(sides)
        .map(|(face, mut f)| {
            align(slice::from_mut(&mut f.gradient));
            HalfSpace {
                face,
                normal: f.gradient,
                offset: f.constant,
            }
        })
        .collect()
}

type Bounds = Vec<(Face, Linear)>;

/// The sides of a rectangle: the face, its index in the rectangle's array, the
/// coordinate it bounds, and whether it is an upper bound.
const SIDES: [(Face, usize, usize, bool); 4] = [
    (Face::Left, 0, 0, false),
    (Face::Right, 1, 0, true),
    (Face::Bottom, 2, 1, false),
    (Face::Top, 3, 1, true),
];

fn finite(near: &EndRect, far: &EndRect, xy: [&Linear; 2], z: &Linear) -> (Bounds, Bounds) {
    let (zn, zf) = (exact(near.z), exact(far.z));
    // Positive inside, whichever end has the larger z.
    let upwards = zn < zf;
    let oriented = |f: Linear| if upwards { f } else { f.negated() };
    let from_near = oriented(z.plus(&-&zn));
    let to_far = oriented(z.negated().plus(&zf));
    let length = (&zf - &zn).abs();

    let sides = SIDES.map(|(face, side, coordinate, above)| {
        let at_near = exact(near.rect.to_array()[side]);
        let at_far = exact(far.rect.to_array()[side]);
        let bound = to_far.times(&at_near).add(&from_near.times(&at_far));
        let below_bound = bound.add(&xy[coordinate].times(&length).negated());
        (
            face,
            if above {
                below_bound
            } else {
                below_bound.negated()
            },
        )
    });
    let ends = vec![(Face::Near, from_near), (Face::Far, to_far)];
    (ends, sides.into())
}

fn infinite(
    near: &EndRect,
    slopes: &Rect,
    direction: Direction,
    xy: [&Linear; 2],
    z: &Linear,
) -> (Bounds, Bounds) {
    let from_near = z.plus(&-&exact(near.z));
    let depth = match direction {
        Direction::PlusZ => from_near,
        Direction::MinusZ => from_near.negated(),
    };
    let sides = SIDES.map(|(face, side, coordinate, above)| {
        let at_near = exact(near.rect.to_array()[side]);
        let slope = exact(slopes.to_array()[side]);
        let bound = depth.times(&slope).plus(&at_near);
        let below_bound = bound.add(&xy[coordinate].negated());
        (
            face,
            if above {
                below_bound
            } else {
                below_bound.negated()
            },
        )
    });
    (vec![(Face::Near, depth)], sides.into())
}

/// `axis . (p - origin)` as a function of `p`.
fn frame_coordinate(axis: Vec3<f64>, origin: &Vector) -> Linear {
    let gradient = exact_point(axis);
    let constant = -&dot(&gradient, origin);
    Linear { gradient, constant }
}

impl Linear {
    fn plus(&self, constant: &Dyadic) -> Self {
        Linear {
            gradient: self.gradient.clone(),
            constant: &self.constant + constant,
        }
    }

    fn add(&self, other: &Linear) -> Self {
        Linear {
            gradient: plus(&self.gradient, &other.gradient),
            constant: &self.constant + &other.constant,
        }
    }

    fn times(&self, factor: &Dyadic) -> Self {
        Linear {
            gradient: times(&self.gradient, factor),
            constant: &self.constant * factor,
        }
    }

    fn negated(&self) -> Self {
        Linear {
            gradient: self.gradient.each_ref().map(|g| -g),
            constant: -&self.constant,
        }
    }
}
