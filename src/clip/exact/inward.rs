//! The representable point next to an exact crossing that is in the frustum.
//!
//! Candidates are taken in the order of their distance from the correctly
//! rounded point, in representable steps summed over the coordinates, then by
//! coordinates: first those at most one step away in each coordinate, if all
//! three are evenly spaced there, then all. That order is a function of the
//! exact point and the frustum alone. Every coordinate of a candidate is within 2 ulp of
//! the exact one. One step from the rounded value always is, where the spacing
//! does not change; otherwise, and for two and more steps, the distance is
//! compared exactly.

use super::points::ExactPoint;
use super::staged::Staged;
use crate::frustum::{Face, FaceSet};
use crate::math::{Real, Vec3};
use std::cmp::Ordering;

/// Upper bound of the steps that can be within 2 ulp: next to a power of two the spacing below is
/// half the spacing above.
const MAX_STEPS: i32 = 5;

/// The first candidate in the frustum and true, or the rounded point and false.
///
/// With the identity pose an end on near or far keeps exactly that `z` where a
/// candidate with it is in the frustum.
pub(super) fn search<T: Real>(
    staged: &mut Staged<'_>,
    face: Face,
    faces: FaceSet,
    rounded: Vec3<T>,
) -> (Vec3<T>, bool) {
    if contains(staged, rounded) {
        return (rounded, true);
    }
    let ends = faces.contains(Face::Near) || faces.contains(Face::Far);
    let keep_depth = staged.filter().identity && ends;
    let even = rounded.to_array().into_iter().all(evenly_spaced);
    if even {
        let keep = |k, steps| k < 2 || steps == 0 || !keep_depth;
        if let Some(point) = nearest_inside(staged, rounded, 1, keep) {
            return (point, true);
        }
    }
    let exact = ExactPoint::new(staged, face);
    let mut known = [[None; 2 * MAX_STEPS as usize + 1]; 3];
    let mut near = |k: usize, steps: i32| {
        let slot = &mut known[k][(steps + MAX_STEPS).unsigned_abs() as usize];
        let value = walk(rounded.to_array()[k], steps);
        *slot.get_or_insert_with(|| within_two_ulp(&exact, k, value))
    };
    let mut found = None;
    if keep_depth {
        let keep = |k: usize, steps: i32| (k < 2 || steps == 0) && near(k, steps);
        found = nearest_inside(staged, rounded, MAX_STEPS, keep);
    }
    match found.or_else(|| nearest_inside(staged, rounded, MAX_STEPS, near)) {
        Some(point) => (point, true),
        None => (rounded, false),
    }
}

/// The first candidate within `reach` steps a coordinate that is in the
/// frustum.
fn nearest_inside<T: Real>(
    staged: &mut Staged<'_>,
    rounded: Vec3<T>,
    reach: i32,
    mut allowed: impl FnMut(usize, i32) -> bool,
) -> Option<Vec3<T>> {
    for distance in 1..=3 * reach {
        for x in -reach..=reach {
            for y in -reach..=reach {
                let rest = distance - x.abs() - y.abs();
                if !(0..=reach).contains(&rest) {
                    continue;
                }
                for z in [-rest, rest] {
                    if !(allowed(0, x) && allowed(1, y) && allowed(2, z)) {
                        continue;
                    }
                    let point =
                        Vec3::new(walk(rounded.x, x), walk(rounded.y, y), walk(rounded.z, z));
                    if point.is_finite() && contains(staged, point) {
                        return Some(point);
                    }
                    if rest == 0 {
                        break;
                    }
                }
            }
        }
    }
    None
}

/// Whether a point is in the frustum, exactly.
fn contains<T: Real>(staged: &mut Staged<'_>, point: Vec3<T>) -> bool {
    let point = point.to_f64();
    let values = staged.filter().values(point);
    let faces = staged.frustum.faces();
    faces
        .iter()
        .all(|&face| staged.sign_at(face, point, &values) != Ordering::Less)
}

/// The value a number of steps up or down, by representable values.
fn walk<T: Real>(value: T, steps: i32) -> T {
    (0..steps.abs()).fold(value, |v, _| {
        if steps < 0 {
            v.next_down()
        } else {
            v.next_up()
        }
    })
}

/// Whether the values on both sides are equally far, two steps out.
fn evenly_spaced<T: Real>(value: T) -> bool {
    let gap = |a: T, b: T| a.to_f64() - b.to_f64();
    let (low, high) = (walk(value, -2), walk(value, 2));
    low.is_finite() && high.is_finite() && gap(high, value) == gap(value, low) && {
        let step = gap(value.next_up(), value);
        gap(high, value) == 2.0 * step && gap(value, value.next_down()) == step
    }
}

/// Whether a value is within 2 ulp of the exact coordinate. One ulp is the
/// spacing of the representable values where the exact one lies.
fn within_two_ulp<T: Real>(exact: &ExactPoint, k: usize, value: T) -> bool {
    if !value.is_finite() {
        return false;
    }
    // The representable values that enclose the exact one.
    let mut low = value;
    for _ in 0..2 * MAX_STEPS {
        match exact.order(k, low.to_f64()) {
            Ordering::Less => low = low.next_down(),
            _ if exact.order(k, low.next_up().to_f64()) == Ordering::Less => break,
            _ => low = low.next_up(),
        }
    }
    // The ulp of a representable value is the spacing away from zero, if there is a next value.
    let (below, above) = (low.next_down(), low.next_up());
    let away_is_below = low < T::ZERO && exact.order(k, low.to_f64()) == Ordering::Equal;
    let ulp = if (away_is_below && below.is_finite()) || !above.is_finite() {
        low.to_f64() - below.to_f64()
    } else {
        above.to_f64() - low.to_f64()
    };
    exact.distance_order(k, value.to_f64(), 2.0 * ulp) != Ordering::Greater
}
