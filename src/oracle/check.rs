//! Comparisons of a clipper's answer with the exact one, and with the clipper itself.
//!
//! Every comparison is exact: a coordinate is compared with a rational by
//! multiplying out. Zeros of either sign are the same value, except where an
//! answer must come back bit for bit.

use super::dyadic::Dyadic;
use super::inward::INWARD_ULPS;
use super::round::{is_within, round_nearest, ulp_exponent_at};
use super::{Oracle, OracleClip, OracleEnd, Violation, ViolationKind};
use crate::clip::{Accuracy, Part, PartEnd, SegmentClip};
use crate::frustum::Frustum;
use crate::math::hex::Hex;
use crate::math::{End, NonFinite, Real, Segment, Vec3};
use num_bigint::BigInt;
use num_rational::BigRational;

/// All violations in an answer; empty if it is right.
///
/// # Errors
/// A coordinate of the segment is infinite or NaN.
pub fn check<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    answer: &SegmentClip<T>,
) -> Result<Vec<Violation>, NonFinite> {
    let oracle = Oracle::new(frustum);
    let truth = oracle.clip(segment)?;
    Ok(oracle.check(&truth, segment, accuracy, answer))
}

impl Oracle {
    /// All violations in an answer, given the exact one for the same segment; empty if it
    /// is right.
    pub fn check<T: Real>(
        &self,
        truth: &OracleClip,
        segment: &Segment<T>,
        accuracy: Accuracy,
        answer: &SegmentClip<T>,
    ) -> Vec<Violation> {
        let mut found = Findings::default();
        if answer.class != truth.class {
            let (is, should) = (answer.class, truth.class);
            found.add(ViolationKind::Class, None, || format!("{is}, not {should}"));
        }
        let (part, exact) = match (&answer.part, &truth.part) {
            (None, None) => return found.0,
            (Some(part), Some(exact)) => (part, exact),
            (part, _) => {
                let is = if part.is_some() { "a part" } else { "no part" };
                found.add(ViolationKind::Class, None, || {
                    format!("{is} with class {}", truth.class)
                });
                return found.0;
            }
        };
        if part.coplanar != exact.coplanar {
            let (is, should) = (part.coplanar, exact.coplanar);
            found.add(ViolationKind::Set, None, || {
                format!("coplanar {{{is}}}, not {{{should}}}")
            });
        }
        if !(part.entry.t <= part.exit.t && part.entry.t >= T::ZERO && part.exit.t <= T::ONE) {
            let (a, b) = (Hex(part.entry.t), Hex(part.exit.t));
            found.add(ViolationKind::Order, None, || format!("t = {a} .. {b}"));
        }
        let reach = Reach::of(segment);
        for (end, is, should) in [
            (End::Start, &part.entry, &exact.entry),
            (End::End, &part.exit, &exact.exit),
        ] {
            let check = EndCheck {
                oracle: self,
                reach: &reach,
                accuracy,
                end,
                is,
                exact: should,
            };
            check.topology(&mut found);
            if should.clipped {
                check.parameter(&mut found);
                check.point(&mut found);
            } else {
                check.unclipped(segment, &mut found);
            }
        }
        found.0
    }
}

#[derive(Default)]
struct Findings(Vec<Violation>);

impl Findings {
    fn add(&mut self, kind: ViolationKind, end: Option<End>, detail: impl FnOnce() -> String) {
        let detail = detail();
        self.0.push(Violation { kind, end, detail });
    }
}

/// `Fast`'s tolerances: `8 u max|coordinate| + smallest subnormal` and `4 u`.
struct Reach {
    point: Dyadic,
    parameter: Dyadic,
}

impl Reach {
    fn of<T: Real>(segment: &Segment<T>) -> Self {
        let largest = [segment.start, segment.end]
            .into_iter()
            .flat_map(Vec3::to_array)
            .filter_map(|c| Dyadic::from_f64(c.abs().to_f64()))
            .max()
            .unwrap_or_else(Dyadic::zero);
        let digits = i64::from(T::DIGITS);
        let least = Dyadic::from_f64(T::MIN_SUBNORMAL).unwrap_or_else(Dyadic::zero);
        Self {
            point: &(&largest * &Dyadic::power_of_two(3 - digits)) + &least,
            parameter: Dyadic::power_of_two(2 - digits),
        }
    }
}

/// One end of an answer, and the exact one.
struct EndCheck<'a, T> {
    oracle: &'a Oracle,
    reach: &'a Reach,
    accuracy: Accuracy,
    end: End,
    is: &'a PartEnd<T>,
    exact: &'a OracleEnd,
}

impl<T: Real> EndCheck<'_, T> {
    /// G1: the face set and whether the end was clipped.
    fn topology(&self, found: &mut Findings) {
        let (is, exact) = (self.is, self.exact);
        if is.faces != exact.faces {
            found.add(ViolationKind::Set, Some(self.end), || {
                format!("faces {{{}}}, not {{{}}}", is.faces, exact.faces)
            });
        }
        if is.clipped != exact.clipped {
            found.add(ViolationKind::Set, Some(self.end), || {
                format!("clipped = {}", is.clipped)
            });
        }
    }

    /// G2: the input's own end.
    fn unclipped(&self, segment: &Segment<T>, found: &mut Findings) {
        let (t, point) = match self.end {
            End::Start => (T::ZERO, segment.start),
            End::End => (T::ONE, segment.end),
        };
        if self.is.t != t || !same_bits(self.is.point, point) || !self.is.inward {
            found.add(ViolationKind::UnclippedEnd, Some(self.end), || {
                let (is, inward) = (self.is, self.is.inward);
                format!(
                    "t = {}, {}, inward = {inward}; the end is {}",
                    Hex(is.t),
                    Hex(is.point),
                    Hex(point)
                )
            });
        }
    }

    /// G3 for the parameter.
    fn parameter(&self, found: &mut Findings) {
        let (is, exact) = (self.is.t, &self.exact.t);
        let right = match self.accuracy {
            Accuracy::Fast => is_within(exact, is, &self.reach.parameter),
            Accuracy::Nearest | Accuracy::Inward => is == round_nearest::<T>(exact),
        };
        if !right {
            found.add(ViolationKind::Parameter, Some(self.end), || {
                format!(
                    "t = {}, nearest {}",
                    Hex(is),
                    Hex(round_nearest::<T>(exact))
                )
            });
        }
    }

    /// G2's depth, G3 and G4 for the point of an end that was clipped.
    fn point(&self, found: &mut Findings) {
        if let Some(z) = self.oracle.end_depth(self.exact.faces).map(T::from_f64)
            && self.is.point.z != z
            && self.depth_is_binding(z)
        {
            found.add(ViolationKind::EndDepth, Some(self.end), || {
                format!("z = {}, not {}", Hex(self.is.point.z), Hex(z))
            });
        }
        match (self.accuracy, self.is.inward) {
            (Accuracy::Inward, true) => self.inward(found),
            (Accuracy::Inward, false) => {
                self.nearest(found);
                self.inward_missed(found);
            }
            (Accuracy::Fast | Accuracy::Nearest, true) => {
                found.add(ViolationKind::InwardFlag, Some(self.end), || {
                    format!("{:?} promises no inward point", self.accuracy)
                });
            }
            (Accuracy::Nearest, false) => self.nearest(found),
            (Accuracy::Fast, false) => self.within(found, |_| self.reach.point.clone()),
        }
    }

    /// An inward point may have another `z` than the end only if no inward point has
    /// that `z`: it may not be a value of `T`, or no value of `T` may lie between the
    /// bounds there.
    fn depth_is_binding(&self, z: T) -> bool {
        let free = self.accuracy == Accuracy::Inward
            && self.is.inward
            && self
                .oracle
                .inward_point(&self.exact.point, Some(z))
                .is_none();
        !free
    }

    fn nearest(&self, found: &mut Findings) {
        let nearest = self.exact.point.each_ref().map(round_nearest::<T>);
        if self.is.point.to_array() != nearest {
            found.add(ViolationKind::Point, Some(self.end), || {
                let (is, nearest) = (Hex(self.is.point), Hex(Vec3::from(nearest)));
                format!("{is}, nearest {nearest}")
            });
        }
    }

    fn within(&self, found: &mut Findings, tolerance: impl Fn(&BigRational) -> Dyadic) {
        let mut coordinates = self.exact.point.iter().zip(self.is.point.to_array());
        if !coordinates.all(|(exact, is)| is_within(exact, is, &tolerance(exact))) {
            found.add(ViolationKind::Point, Some(self.end), || {
                let nearest = self.exact.point.each_ref().map(round_nearest::<T>);
                let (is, nearest) = (Hex(self.is.point), Hex(Vec3::from(nearest)));
                format!("{is} is too far from {nearest}")
            });
        }
    }

    fn inward(&self, found: &mut Findings) {
        self.within(found, |exact| {
            Dyadic::new(BigInt::from(INWARD_ULPS), ulp_exponent_at::<T>(exact))
        });
        if !self.oracle.contains(self.is.point) {
            found.add(ViolationKind::NotInward, Some(self.end), || {
                format!("{} is outside", Hex(self.is.point))
            });
        }
    }

    fn inward_missed(&self, found: &mut Findings) {
        if let Some(point) = self.oracle.inward_point::<T>(&self.exact.point, None) {
            found.add(ViolationKind::InwardMissed, Some(self.end), || {
                format!("{}, but {} is inside", Hex(self.is.point), Hex(point))
            });
        }
    }
}

/// The violation of G5 by the answer for the reversed segment, given the answer for the
/// segment itself; `None` if there is none.
pub fn check_swapped<T: Real>(
    answer: &SegmentClip<T>,
    of_reversed: &SegmentClip<T>,
) -> Option<Violation> {
    (!is_mirrored(answer, of_reversed)).then(|| Violation {
        kind: ViolationKind::Swapped,
        end: None,
        detail: format!(
            "{} and, reversed, {}",
            summary(answer),
            summary(of_reversed)
        ),
    })
}

/// Whether one answer is the other with entry and exit swapped, except for the parameters,
/// which are rounded from either end.
pub fn is_mirrored<T: Real>(answer: &SegmentClip<T>, of_reversed: &SegmentClip<T>) -> bool {
    let same_part = |a: &Part<T>, b: &Part<T>| {
        a.coplanar == b.coplanar && mirrored(&a.entry, &b.exit) && mirrored(&a.exit, &b.entry)
    };
    answer.class == of_reversed.class
        && match (&answer.part, &of_reversed.part) {
            (None, None) => true,
            (Some(a), Some(b)) => same_part(a, b),
            _ => false,
        }
}

/// The violation of G6 by the answer for the segment between the two points of an
/// `Inward` answer; `None` if there is none, or if an end of the answer is not inward,
/// so that nothing is promised.
pub fn check_idempotent<T: Real>(
    answer: &SegmentClip<T>,
    clip: impl FnOnce(&Segment<T>) -> Result<SegmentClip<T>, NonFinite>,
) -> Option<Violation> {
    let part = answer.part.as_ref()?;
    if !part.entry.inward || !part.exit.inward {
        return None;
    }
    let segment = Segment::new(part.entry.point, part.exit.point);
    let again = clip(&segment);
    let stays = |end: &PartEnd<T>, point| !end.clipped && same_bits(end.point, point);
    let same = again.as_ref().is_ok_and(|again| {
        again
            .part
            .as_ref()
            .is_some_and(|p| stays(&p.entry, segment.start) && stays(&p.exit, segment.end))
    });
    (!same).then(|| Violation {
        kind: ViolationKind::Idempotence,
        end: None,
        detail: match again {
            Ok(again) => format!("{} becomes {}", Hex(segment), summary(&again)),
            Err(refusal) => refusal.to_string(),
        },
    })
}

/// Whether two ends are equal except for the parameter, which is rounded from its own start.
fn mirrored<T: Real>(a: &PartEnd<T>, b: &PartEnd<T>) -> bool {
    same_bits(a.point, b.point)
        && a.clipped == b.clipped
        && a.faces == b.faces
        && a.inward == b.inward
}

fn same_bits<T: Real>(a: Vec3<T>, b: Vec3<T>) -> bool {
    let bits = |v: Vec3<T>| v.to_f64().to_array().map(f64::to_bits);
    bits(a) == bits(b)
}

fn summary<T: Real>(answer: &SegmentClip<T>) -> String {
    let class = answer.class;
    let Some(part) = &answer.part else {
        return class.to_string();
    };
    let end = |e: &PartEnd<T>| format!("{} {{{}}}", Hex(e.point), e.faces);
    format!("{class} {} .. {}", end(&part.entry), end(&part.exit))
}
