//! Parameters and points of a decided segment.
//!
//! With A and B the magnitudes of the crossed face's boundary values at start
//! and end, the crossing is at t = A / (A + B), and each coordinate is
//! `(B start + A end) / (A + B)`.
//!
//! *Fast* takes A and B with a relative error of at most 2 u and steps from the
//! nearer end, by the rule of `clip/rules/site.rs`, so that swapping the ends gives the
//! same bits. With M the largest coordinate: tau is within
//! tau (1 - tau) 4 u + 2 u tau <= 2 u, which moves the point by at most
//! 2 u * 2 M; the difference of the ends, the product and the sum add
//! u M each: 7 u M together, below the promised 8. t is tau or 1 - tau: within
//! 2.5 u (`proofs/points.gappa`).
//!
//! *Nearest* evaluates in double-double with an error bound, and rounds where
//! both ends of the error interval round alike (Ziv's test); else in integers.
//! A coordinate that the face itself determines is not evaluated: boxes have faces at
//! zero, where no error bound proves the sign.

use super::decide::{At, Decision};
use super::inward;
use super::staged::Staged;
use crate::clip::rules::site::{NearerEnd, Step, end_is_smaller};
use crate::clip::{Accuracy, Part, PartEnd, SegmentClip};
use crate::exact::Number;
use crate::exact::double_double::Dd;
use crate::exact::dyadic::Dyadic;
use crate::exact::float::Single;
use crate::frustum::eval::filter::Filter;
use crate::frustum::{Face, FaceSet};
use crate::math::{End, Real, Segment, Vec3};
use std::cmp::Ordering;

/// The result for a decided segment.
#[inline]
pub(crate) fn build<T: Real>(
    staged: &mut Staged<'_>,
    segment: &Segment<T>,
    decision: &Decision,
    accuracy: Accuracy,
) -> SegmentClip<T> {
    let entry = end(staged, segment, decision, 0, accuracy);
    let mut exit = if decision.at[0] == decision.at[1] {
        let clipped = decision.clipped[1];
        PartEnd {
            clipped,
            inward: if accuracy == Accuracy::Inward {
                entry.inward
            } else {
                !clipped
            },
            ..entry
        }
    } else {
        end(staged, segment, decision, 1, accuracy)
    };
    if exit.t < entry.t {
        // Both are within the bound of the exact parameters, which are in
        // order; so is the greater of the two.
        exit.t = entry.t;
    }
    SegmentClip {
        class: decision.class,
        part: Some(Part {
            entry,
            exit,
            coplanar: decision.coplanar,
        }),
    }
}

#[inline(always)]
fn end<T: Real>(
    staged: &mut Staged<'_>,
    segment: &Segment<T>,
    decision: &Decision,
    which: usize,
    accuracy: Accuracy,
) -> PartEnd<T> {
    let faces = decision.faces[which];
    let (t, point, inward) = match decision.at[which] {
        At::End(End::Start) => (T::ZERO, segment.start, true),
        At::End(End::End) => (T::ONE, segment.end, true),
        At::Crossing(face) => crossing(staged, face, faces, accuracy),
    };
    let clipped = decision.clipped[which];
    PartEnd {
        t,
        point,
        clipped,
        faces,
        inward: inward && (!clipped || accuracy == Accuracy::Inward),
    }
}

/// Parameter, point, and whether the point is known to be in the frustum.
#[inline]
fn crossing<T: Real>(
    staged: &mut Staged<'_>,
    face: Face,
    faces: FaceSet,
    accuracy: Accuracy,
) -> (T, Vec3<T>, bool) {
    match accuracy {
        Accuracy::Fast => {
            let (t, point) = fast(staged, face, faces);
            (t, point, false)
        }
        Accuracy::Nearest => {
            let (t, point) = nearest(staged, face);
            (t, point, false)
        }
        Accuracy::Inward => {
            let (t, point) = nearest(staged, face);
            let (point, inward) = inward::search(staged, face, faces, point);
            (t, point, inward)
        }
    }
}

/// From the magnitudes at start and end.
#[inline(always)]
fn step_from(a: f64, b: f64, segment: &Segment<f64>) -> Step<f64> {
    let nearer = NearerEnd::new(a, b);
    let from_end = if nearer.has_ties() {
        nearer.with_ties(is_smaller(segment))
    } else {
        nearer.without_ties()
    };
    Step::new(a, b, from_end)
}

/// Whether the end is lexicographically smaller than the start.
#[cold]
fn is_smaller(segment: &Segment<f64>) -> bool {
    end_is_smaller(segment.start, segment.end)
}

/// The step to a crossed face. The way its boundary values are found depends
/// on the two points and the face alone, not on which point comes first nor on
/// the algorithm: rounded values where they are exact, double-double where the
/// filter is certain, else exact.
fn step(staged: &mut Staged<'_>, face: Face) -> Step<f64> {
    if staged.lattice {
        let [p, q] = [0, 1].map(|i| staged.values[i].of(face as usize).abs());
        return step_from(p, q, &staged.segment);
    }
    if staged.certain(face) {
        let Segment { start, end } = staged.segment;
        let precise = &staged.filter().precise;
        let value = |p| precise.magnitudes(Single, [face as usize], [p]);
        return step_from(value(start), value(end), &staged.segment);
    }
    // Near and far of the identity pose are one subtraction, the same bits as
    // in double-double, unless they overflow.
    let [p, q] = [0, 1].map(|i| staged.values[i].of(face as usize).abs());
    let depth = matches!(face, Face::Near | Face::Far) && staged.filter().identity;
    if depth && p + q < f64::MAX {
        return step_from(p, q, &staged.segment);
    }
    exact_step(staged, face)
}

#[cold]
fn exact_step(staged: &mut Staged<'_>, face: Face) -> Step<f64> {
    if let Some([a, b]) = staged.expansions(face) {
        return step_from(a.estimate().abs(), b.estimate().abs(), &staged.segment);
    }
    let [a, b] = staged.integers(face).map(Dyadic::abs);
    let order = (&a - &b).sign();
    let from_end = match order {
        Ordering::Less => false,
        Ordering::Equal => is_smaller(&staged.segment),
        Ordering::Greater => true,
    };
    let nearer = if from_end { &b } else { &a };
    Step {
        from_end,
        tau: nearer.round_quotient(&(&a + &b)),
    }
}

fn fast<T: Real>(staged: &mut Staged<'_>, face: Face, faces: FaceSet) -> (T, Vec3<T>) {
    let step = step(staged, face);
    place(staged.filter(), &staged.segment, step, faces)
}

/// Parameter and point of a step.
#[inline(always)]
fn place<T: Real>(
    filter: &Filter,
    segment: &Segment<f64>,
    step: Step<f64>,
    faces: FaceSet,
) -> (T, Vec3<T>) {
    let Segment { start, end } = *segment;
    let [x, y, z] = [0, 1, 2].map(|k| step.coordinate(start[k], end[k]));
    let mut point = Vec3::new(x, y, z);
    if !(x + y + z).is_finite() {
        point = huge(segment, step);
    }
    if filter.identity {
        // The exact hit has exactly this coordinate.
        if faces.contains(Face::Near) {
            point.z = filter.near;
        } else if faces.contains(Face::Far) {
            point.z = filter.far;
        }
    }
    (T::from_f64(step.parameter()), Vec3::from_f64(point))
}

/// Where the difference of the ends overflows, or the sum of the coordinates.
#[cold]
fn huge(segment: &Segment<f64>, step: Step<f64>) -> Vec3<f64> {
    let Segment { start, end } = *segment;
    let nearer = if step.from_end { end } else { start };
    let half = end * 0.5 - start * 0.5;
    (nearer * 0.5 + half * step.signed()) * 2.0 + Vec3::default()
}

/// Correctly rounded parameter and point.
fn nearest<T: Real>(staged: &mut Staged<'_>, face: Face) -> (T, Vec3<T>) {
    if staged.certain(face)
        && let Some(result) = nearest_double_double(staged, face)
    {
        return result;
    }
    let exact = ExactPoint::new(staged, face);
    (exact.parameter(), exact.rounded())
}

/// Upper bound of the relative error of a few double-double operations: 2^-99 = 128 u^2, with at
/// most 15 u^2 for one.
const DOUBLE_DOUBLE_RELATIVE_ERROR: f64 = 128.0 * f64::UNIT_ROUNDOFF * f64::UNIT_ROUNDOFF;

fn nearest_double_double<T: Real>(staged: &Staged<'_>, face: Face) -> Option<(T, Vec3<T>)> {
    let filter = staged.filter();
    let Segment { start, end } = staged.segment;
    let value = |p| filter.precise.value(face as usize, p).abs();
    let (a, b) = (value(start), value(end));
    let total = a.add(b);
    let from_start = a.hi <= b.hi;
    let tau = if from_start { a } else { b }.div(total);
    // The values are within 60 u^2 scale < 2^-54 thresholds.
    let threshold = |v| filter.threshold(face, v);
    let threshold = threshold(staged.values[0].size).max(threshold(staged.values[1].size));
    let tau_error = 1.2e-16 * threshold / total.hi + DOUBLE_DOUBLE_RELATIVE_ERROR;
    let t = if from_start {
        tau
    } else {
        Dd::new(1.0, 0.0).add(tau.neg())
    };
    let (from, to) = if from_start {
        (start, end)
    } else {
        (end, start)
    };
    let exact = filter
        .identity
        .then(|| staged.frustum.shape().constant_coordinate(face));
    let coordinate = |k: usize| {
        if let Some(Some((axis, at))) = exact
            && axis == k
        {
            return Some(T::from_f64(at + 0.0));
        }
        if from[k] == to[k] {
            return Some(T::from_f64(from[k] + 0.0));
        }
        let d = Dd::difference(to[k], from[k]);
        let v = Dd::new(from[k], 0.0).add(tau.mul(d));
        let error =
            d.hi.abs() * tau_error + DOUBLE_DOUBLE_RELATIVE_ERROR * (from[k].abs() + d.hi.abs());
        round(v, error)
    };
    let point = Vec3::new(coordinate(0)?, coordinate(1)?, coordinate(2)?);
    Some((round(t, tau_error)?, point))
}

/// The value rounded to `T`, if everything within `error` of it rounds alike.
fn round<T: Real>(v: Dd, error: f64) -> Option<T> {
    // Products of tiny numbers lose bits that no relative bound covers.
    let error = 2.0 * error + 1e-315;
    let (mut low, mut high) = (v.hi + (v.lo - error), v.hi + (v.lo + error));
    if T::DIGITS == 24 {
        // Real bounds, not rounded ones: no double rounding.
        (low, high) = (low.next_down(), high.next_up());
    }
    let (low, high) = (T::from_f64(low), T::from_f64(high));
    // By bits: the sign of a zero must be certain too.
    let bits = |v: T| v.to_f64().to_bits();
    (bits(low) == bits(high)).then_some(low)
}

/// A crossing as ratios of integers.
pub(super) struct ExactPoint {
    numerators: [Dyadic; 3],
    at: Dyadic,
    denominator: Dyadic,
}

impl ExactPoint {
    pub(super) fn new(staged: &mut Staged<'_>, face: Face) -> Self {
        let [a, b] = staged.integers(face).map(Dyadic::abs);
        let Segment { start, end } = staged.segment;
        let numerators = [0, 1, 2].map(|k| {
            let [from, to] = [start[k], end[k]].map(Dyadic::from);
            &(&from * &b) + &(&to * &a)
        });
        ExactPoint {
            numerators,
            denominator: &a + &b,
            at: a,
        }
    }

    fn parameter<T: Real>(&self) -> T {
        self.at.round_quotient(&self.denominator)
    }

    fn rounded<T: Real>(&self) -> Vec3<T> {
        let [x, y, z] = [0, 1, 2].map(|k| self.numerators[k].round_quotient(&self.denominator));
        Vec3::new(x, y, z)
    }

    /// The sign of `|coordinate k - value| - distance`.
    pub(super) fn distance_order(&self, k: usize, value: f64, distance: f64) -> Ordering {
        let value = &Dyadic::from(value) * &self.denominator;
        let distance = &Dyadic::from(distance) * &self.denominator;
        (&(&self.numerators[k] - &value).abs() - &distance).sign()
    }

    /// The order of coordinate k to a value.
    pub(super) fn order(&self, k: usize, value: f64) -> Ordering {
        let value = &Dyadic::from(value) * &self.denominator;
        (&self.numerators[k] - &value).sign()
    }
}
