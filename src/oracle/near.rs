//! Nearly singular segments: those within a few ulp of a singular one, for which wrong answers are
//! most likely.

use super::dyadic::Dyadic;
use super::vector::exact_point;
use super::{Fraction, Oracle};
use crate::math::{Real, Segment, Vec3};

/// The largest distance that counts as near, in ulps.
const ULPS: i64 = 4;

/// A boundary function along a segment, and by how much it changes if every
/// coordinate of an end moves by [`ULPS`].
struct Along {
    values: [Dyadic; 2],
    slacks: [Dyadic; 2],
}

/// The position of a point relative to a face: beyond it by more than the slack, on it
/// within the slack, or inside.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Beyond,
    On,
    Inside,
}

fn side(value: &Dyadic, slack: &Dyadic) -> Side {
    if value.abs() <= *slack {
        Side::On
    } else if value.is_negative() {
        Side::Beyond
    } else {
        Side::Inside
    }
}

/// Whether a point is on at least `least` faces and beyond none.
fn on_surface(sides: impl Iterator<Item = Side>, least: usize) -> bool {
    let mut on = 0;
    for side in sides {
        match side {
            Side::Beyond => return false,
            Side::On => on += 1,
            Side::Inside => {}
        }
    }
    on >= least
}

impl Oracle {
    /// Whether a segment is within 4 ulp of a face, an edge or a vertex, such that
    /// moving each end's coordinates by up to 4 ulp could make it singular:
    ///
    /// - an end is on a face, or
    /// - it passes through an edge or a vertex.
    ///
    /// A crossing in the middle of a face is not singular. A point counts as on a face if
    /// its distance from the plane is at most the effect of such a move, and it is beyond
    /// no other face by more than that. A zero coordinate has the ulp of the point's
    /// largest one.
    ///
    /// The test uses rational arithmetic; it is false for a segment that is not finite.
    pub fn is_near<T: Real>(&self, segment: &Segment<T>) -> bool {
        if segment.check_finite().is_err() {
            return false;
        }
        let ends = [segment.start, segment.end];
        let points = ends.map(|p| exact_point(p.to_f64()));
        let steps = ends.map(steps);
        let faces: Vec<Along> = self
            .half_spaces
            .iter()
            .map(|h| Along {
                values: points.each_ref().map(|p| h.value_at(p)),
                slacks: steps.each_ref().map(|s| {
                    let [x, y, z] = [0, 1, 2].map(|k| &h.normal[k].abs() * &s[k]);
                    &(&x + &y) + &z
                }),
            })
            .collect();
        let near_end =
            |i: usize| on_surface(faces.iter().map(|f| side(&f.values[i], &f.slacks[i])), 1);
        near_end(0) || near_end(1) || passes_an_edge(&faces)
    }
}

/// Whether the segment meets two faces at a point where it crosses one of them.
fn passes_an_edge(faces: &[Along]) -> bool {
    faces.iter().any(|crossed| {
        let [p, q] = &crossed.values;
        if p.is_negative() == q.is_negative() {
            return false;
        }
        let t = Fraction::root(p, q);
        let at = |[p, q]: &[Dyadic; 2]| t.between(p, q);
        on_surface(
            faces.iter().map(|f| side(&at(&f.values), &at(&f.slacks))),
            2,
        )
    })
}

/// [`ULPS`] at each coordinate of a point.
fn steps<T: Real>(p: Vec3<T>) -> [Dyadic; 3] {
    let coordinates = p.to_array().map(Real::abs);
    let largest = coordinates
        .into_iter()
        .fold(T::ZERO, |a, b| if b > a { b } else { a });
    coordinates.map(|c| {
        let at = if c == T::ZERO { largest } else { c };
        // The ulp of the largest finite number is the one below it.
        let (low, high) = if at.next_up().is_finite() {
            (at, at.next_up())
        } else {
            (at.next_down(), at)
        };
        let [low, high] =
            [low, high].map(|v| Dyadic::from_f64(v.to_f64()).unwrap_or_else(Dyadic::zero));
        &(&high - &low) * &num_bigint::BigInt::from(ULPS)
    })
}
