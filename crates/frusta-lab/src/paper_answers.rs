//! Clippers' answers to the singular samples, compared with rational arithmetic.

use super::paper::SOLID;
use frusta::clip::{Class, PartEnd, SegmentClip, SegmentClipper};
use frusta::frustum::{FaceSet, Frustum};
use frusta::math::{Real, Segment, Vec3};
use frusta::oracle::{Gauge, Oracle, OracleClip, OracleEnd};
use frusta::samples::{FrameSample, Placement, singular_samples};
use std::fmt;

/// How right a clipper's answers are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Score {
    /// How many samples there were.
    pub samples: usize,
    /// How often the class was right.
    pub right_classes: usize,
    /// How often entry, exit and coplanar set and the clipped flags were right.
    pub right_sets: usize,
    /// The largest distance of a coordinate from the exact one, over the answers
    /// of the right class: in unit roundoffs of the segment's largest coordinate.
    pub max_error: f64,
    /// The same in units in the last place of the exact coordinate.
    pub max_error_ulps: f64,
}

impl Score {
    /// How many answers have a wrong class or a wrong set.
    pub fn wrong(&self) -> [usize; 2] {
        [
            self.samples - self.right_classes,
            self.samples - self.right_sets,
        ]
    }
}

/// A sample that a clipper got wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperFailure {
    /// The sample's name.
    pub sample: String,
    /// How often its class or a set was wrong, in all places.
    pub count: usize,
    /// The first such segment.
    pub segment: Segment<f64>,
    /// The clipper's answer.
    pub said: Topology,
    /// The true answer.
    pub truth: Topology,
}

/// An answer without its numbers.
///
/// Displays as the class and what happens at the ends: `cross: enters near+left,
/// ends`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Topology {
    /// The class.
    pub class: Class,
    /// Entry and exit, if there is a part.
    pub ends: Option<[(bool, FaceSet); 2]>,
    /// The faces that contain the whole segment.
    pub coplanar: FaceSet,
}

impl Topology {
    pub(super) fn of_answer<T: Real>(answer: &SegmentClip<T>) -> Self {
        let end = |e: &PartEnd<T>| (e.clipped, e.faces);
        Self {
            class: answer.class,
            ends: answer.part.map(|p| [end(&p.entry), end(&p.exit)]),
            coplanar: answer.part.map_or(FaceSet::EMPTY, |p| p.coplanar),
        }
    }

    fn of_truth(truth: &OracleClip) -> Self {
        let end = |e: &OracleEnd| (e.clipped, e.faces);
        let part = truth.part.as_ref();
        Self {
            class: truth.class,
            ends: part.map(|p| [end(&p.entry), end(&p.exit)]),
            coplanar: part.map_or(FaceSet::EMPTY, |p| p.coplanar),
        }
    }

    fn same_sets(&self, other: &Self) -> bool {
        self.ends == other.ends && self.coplanar == other.coplanar
    }
}

impl fmt::Display for Topology {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.class)?;
        let Some(ends) = self.ends else {
            return Ok(());
        };
        if let [(true, first), (true, last)] = ends
            && self.class == Class::Touch
            && first == last
        {
            return write!(f, ": passes {first}");
        }
        let words = [["starts", "enters"], ["ends", "leaves"]];
        for (i, (clipped, faces)) in ends.into_iter().enumerate() {
            let mark = [":", ","][i];
            write!(f, "{mark} {}", words[i][usize::from(clipped)])?;
            if !faces.is_empty() {
                write!(f, " {faces}")?;
            }
        }
        if !self.coplanar.is_empty() {
            write!(f, ", within {}", self.coplanar)?;
        }
        Ok(())
    }
}

/// A sample's name and its segment in the frustum's frame.
type SampleSegment = (String, Segment<f64>);

/// By what factors the ends that jut out are moved along their lines.
type Stretch = [f64; 2];

/// The samples as they are made.
const AS_MADE: Stretch = [1.0, 1.0];

/// All pairs of whole factors up to 8 but [`AS_MADE`].
fn stretches() -> Vec<Stretch> {
    let pairs = (0..64).map(|i| [f64::from(i / 8 + 1), f64::from(i % 8 + 1)]);
    pairs.skip(1).collect()
}

/// The samples with what juts out of the frustum made longer, by a factor at the
/// start and one at the end. Class and sets stay the same; the crossing
/// parameters, which are quarters and so exact in floating point, become
/// fractions such as 2/7.
fn samples(factors: Stretch) -> Vec<SampleSegment> {
    let stretch = |sample: &FrameSample| {
        let Segment { mut start, mut end } = sample.segment;
        if let Some(part) = sample.expected.part {
            let along = end - start;
            let [entry, exit] = part.t.map(|t| sample.segment.start + along * t);
            if part.clipped[0] {
                start = entry - (entry - start) * factors[0];
            }
            if part.clipped[1] {
                end = exit + (end - exit) * factors[1];
            }
        }
        (sample.name(), Segment::new(start, end))
    };
    singular_samples(&SOLID).iter().map(stretch).collect()
}

/// Segments at places, with the truth about each.
pub(super) struct Exam<T> {
    places: Vec<(Frustum, Vec<Question<T>>)>,
}

struct Question<T> {
    name: String,
    segment: Segment<T>,
    truth: Topology,
    points: Option<[Gauge; 2]>,
    /// The unit roundoff of the largest coordinate.
    unit: f64,
}

impl<T: Real> Exam<T> {
    /// The samples as they are made, in the standard frame.
    pub(super) fn standard() -> Self {
        Self::new([(Placement::IDENTITY, samples(AS_MADE))])
    }

    /// The stretched samples in the standard frame.
    pub(super) fn stretched() -> Self {
        let all = stretches().into_iter().flat_map(samples).collect();
        Self::new([(Placement::IDENTITY, all)])
    }

    /// The samples as they are made, and stretched by factors that change from
    /// place to place.
    pub(super) fn at(placements: &[Placement]) -> Self {
        let stretches = stretches();
        let factors = stretches.iter().cycle();
        let places = placements.iter().zip(factors);
        Self::new(places.map(|(p, f)| (*p, [samples(AS_MADE), samples(*f)].concat())))
    }

    fn new(places: impl IntoIterator<Item = (Placement, Vec<SampleSegment>)>) -> Self {
        let place = |(placement, segments): (Placement, Vec<SampleSegment>)| {
            let frustum = placement.place(&SOLID).ok()?;
            let oracle = Oracle::new(&frustum);
            let ask = |(name, segment): SampleSegment| {
                question(&oracle, name, placement.segment(&segment))
            };
            let questions = segments.into_iter().filter_map(ask).collect();
            Some((frustum, questions))
        };
        Self {
            places: places.into_iter().filter_map(place).collect(),
        }
    }

    /// Asks everything; adds to the failures.
    pub(super) fn score(
        &self,
        clipper: &dyn SegmentClipper<T>,
        failures: &mut Vec<PaperFailure>,
    ) -> Score {
        let mut score = Score::default();
        for (frustum, questions) in &self.places {
            for question in questions {
                score.samples += 1;
                if let Ok(answer) = clipper.clip_segment(frustum, &question.segment) {
                    score.add(question, &answer, failures);
                }
            }
        }
        score
    }
}

/// Asks about a segment; `None` does not occur, as all numbers are finite.
fn question<T: Real>(oracle: &Oracle, name: String, segment: Segment<f64>) -> Option<Question<T>> {
    let [start, end] = [segment.start, segment.end].map(Vec3::from_f64);
    let segment = Segment::new(start, end);
    let truth = oracle.clip(&segment).ok()?;
    let points = truth.part.as_ref();
    let points = points.map(|p| [&p.entry, &p.exit].map(Gauge::new::<T>));
    let largest = [segment.start, segment.end]
        .into_iter()
        .flat_map(|p| p.to_f64().to_array())
        .fold(0.0_f64, |largest, c| largest.max(c.abs()));
    Some(Question {
        name,
        segment,
        truth: Topology::of_truth(&truth),
        points,
        unit: T::UNIT_ROUNDOFF * largest,
    })
}

impl Score {
    fn add<T: Real>(
        &mut self,
        question: &Question<T>,
        answer: &SegmentClip<T>,
        failures: &mut Vec<PaperFailure>,
    ) {
        let said = Topology::of_answer(answer);
        let right_class = said.class == question.truth.class;
        let right_sets = said.same_sets(&question.truth);
        self.right_classes += usize::from(right_class);
        self.right_sets += usize::from(right_sets);
        if !(right_class && right_sets) {
            question.failed(said, failures);
        }
        if !right_class {
            return;
        }
        let (Some(points), Some(exact)) = (answer.points(), &question.points) else {
            return;
        };
        for (gauge, point) in exact.iter().zip(points) {
            let error = gauge.deviation(point) / question.unit;
            self.max_error = self.max_error.max(error);
            let ulps = gauge.deviation_in_ulps(point);
            self.max_error_ulps = self.max_error_ulps.max(ulps);
        }
    }
}

impl<T: Real> Question<T> {
    fn failed(&self, said: Topology, failures: &mut Vec<PaperFailure>) {
        if let Some(known) = failures.iter_mut().find(|f| f.sample == self.name) {
            known.count += 1;
        } else {
            failures.push(PaperFailure {
                sample: self.name.clone(),
                count: 1,
                segment: self.segment.to_f64(),
                said,
                truth: self.truth,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotated_poses;

    #[test]
    fn all_questions_are_exact_and_stretching_changes_no_answer() {
        fn check<T: Real>() {
            let expected: Vec<_> = singular_samples(&SOLID)
                .iter()
                .map(|s| s.expected)
                .collect();
            for (exam, places) in [
                (Exam::<T>::standard(), 1),
                (Exam::stretched(), 63),
                (Exam::at(&Placement::signed_permutations()), 2 * 48),
                (Exam::at(&rotated_poses()), 2 * rotated_poses().len()),
            ] {
                let questions = exam.places.iter().flat_map(|(_, questions)| questions);
                let answers = questions.clone().zip(expected.iter().cycle());
                assert_eq!(questions.count(), 78 * places);
                for (question, expected) in answers {
                    // Rounded to T, it would no longer be singular.
                    let truth = question.truth;
                    assert_eq!(truth.class, expected.class, "{}", question.name);
                    let ends = expected
                        .part
                        .map(|p| [0, 1].map(|i| (p.clipped[i], p.faces[i])));
                    assert_eq!(truth.ends, ends, "{}", question.name);
                }
            }
        }
        check::<f64>();
        check::<f32>();
    }

    #[test]
    fn answers_are_described_in_words() {
        let faces = FaceSet::from_bits(0b101);
        let mut answer = Topology {
            class: Class::Cross,
            ends: Some([(true, faces), (false, FaceSet::EMPTY)]),
            coplanar: FaceSet::EMPTY,
        };
        assert_eq!(answer.to_string(), "cross: enters near+left, ends");
        answer.ends = Some([(false, FaceSet::EMPTY), (true, faces)]);
        answer.coplanar = FaceSet::from_bits(1);
        assert_eq!(
            answer.to_string(),
            "cross: starts, leaves near+left, within near"
        );
        answer.class = Class::Touch;
        answer.ends = Some([(true, faces); 2]);
        assert_eq!(answer.to_string(), "touch: passes near+left");
    }
}
