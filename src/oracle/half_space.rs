//! A frustum's faces as linear inequalities over world coordinates, exactly.
//!
//! Written down from the definition: frame coordinates are `a_k . (p - o)`, and
//! the frustum is the closed convex hull of two rectangles (or a rectangle that
//! grows with depth). Between two rectangles at `zn` and `zf` the right bound at
//! `z` is `(rn (zf - z) + rf (z - zn)) / (zf - zn)`; times `|zf - zn|` there is
//! nothing left to divide. Ends that shrink to an edge or a point need nothing
//! special: the inequalities of all faces together hold there and nowhere beyond.

use super::dyadic::Dyadic;
use crate::frustum::{Direction, EndRect, Face, Frustum, Shape};
use crate::math::{Rect, Vec3};

/// The points `p` with `normal . p + offset >= 0`; zero on the face's plane.
#[derive(Debug)]
pub(crate) struct HalfSpace {
    pub(crate) face: Face,
    pub(crate) normal: [Dyadic; 3],
    offset: Dyadic,
}

/// A linear function of a point: `gradient . p + constant`.
#[derive(Clone)]
struct Linear {
    gradient: [Dyadic; 3],
    constant: Dyadic,
}

impl HalfSpace {
    /// The boundary function: positive inside, zero on the plane.
    pub(crate) fn value_at(&self, point: &[Dyadic; 3]) -> Dyadic {
        let [x, y, z] = &self.normal;
        let [px, py, pz] = point;
        &(&(x * px) + &(y * py)) + &(&(z * pz) + &self.offset)
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
        .map(|(face, f)| HalfSpace {
            face,
            normal: f.gradient,
            offset: f.constant,
        })
        .collect()
}

type Bounds = Vec<(Face, Linear)>;

/// Which sides a rectangle has: the face, its index in a rectangle's array, the
/// coordinate it bounds, and whether from above.
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
        let room = bound.add(&xy[coordinate].times(&length).negated());
        (face, if above { room } else { room.negated() })
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
        let room = bound.add(&xy[coordinate].negated());
        (face, if above { room } else { room.negated() })
    });
    (vec![(Face::Near, depth)], sides.into())
}

/// `axis . (p - origin)` as a function of `p`.
fn frame_coordinate(axis: Vec3<f64>, origin: &[Dyadic; 3]) -> Linear {
    let gradient = exact_point(axis);
    let [x, y, z] = &gradient;
    let [ox, oy, oz] = origin;
    let constant = -&(&(&(x * ox) + &(y * oy)) + &(z * oz));
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
        let [a, b, c] = &self.gradient;
        let [d, e, f] = &other.gradient;
        Linear {
            gradient: [a + d, b + e, c + f],
            constant: &self.constant + &other.constant,
        }
    }

    fn times(&self, factor: &Dyadic) -> Self {
        Linear {
            gradient: self.gradient.each_ref().map(|g| g * factor),
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

pub(crate) fn exact_point(p: Vec3<f64>) -> [Dyadic; 3] {
    p.to_array().map(exact)
}

fn exact(value: f64) -> Dyadic {
    Dyadic::from_f64(value).unwrap_or_else(Dyadic::zero)
}
