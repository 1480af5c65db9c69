//! The answers of every algorithm in every tier for one case, compared with the truth.

use frusta::oracle::{Gauge, Oracle, OracleClip, check_idempotent, check_swapped};
use frusta::{
    Accuracy, Class, FaceSet, NonFinite, Part, PartEnd, Real, Segment, SegmentClip, StageCounts,
};
use frusta_lab::{CaseLine, CaseSegment, SurveyAlgorithm, SurveyClipper, SurveyTier};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A case, the truth about it, and all answers.
pub(super) struct Replay {
    pub(super) case: CaseLine,
    /// The segment in `f64`, which holds every `f32`.
    pub(super) segment: Segment<f64>,
    pub(super) truth: OracleClip,
    /// By tier, in each by algorithm.
    pub(super) answers: Vec<Answer>,
    /// Whether there are answers in `f32`: it must have the segment's coordinates.
    pub(super) has_f32: bool,
}

/// The answer of one algorithm in one tier.
pub(super) struct Answer {
    pub(super) algorithm: SurveyAlgorithm,
    pub(super) tier: SurveyTier,
    pub(super) verdict: Verdict,
}

/// An answer and its faults.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Verdict {
    /// `None` if there was no answer, or one with a number that is not finite.
    pub(super) clip: Option<SegmentClip<f64>>,
    /// Why there is no answer.
    pub(super) refusal: Option<String>,
    pub(super) class: bool,
    /// Face sets and clipped flags; as right as they can be if the class is wrong.
    pub(super) faces: bool,
    /// The errors at entry and exit, if the class is right and there are ends.
    pub(super) errors: Option<[EndError; 2]>,
    /// Whether a clipped end is outside.
    pub(super) outside: bool,
    /// Whether the swapped segment has the swapped answer.
    pub(super) symmetric: bool,
    /// Whether the answer, clipped again, stays.
    pub(super) idempotent: bool,
    /// For an exact tier, everything that breaks a guarantee.
    pub(super) violations: Vec<String>,
    /// Which stages the exact tiers' predicates needed.
    pub(super) stages: StageCounts,
}

/// How far an end is from the exact one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EndError {
    pub(super) ulp: f64,
    pub(super) u_scale: f64,
}

impl Verdict {
    /// Whether class and sets are right, so that only roundings are left.
    pub(super) fn is_right(&self) -> bool {
        self.class && self.faces && self.refusal.is_none()
    }

    /// The faults, a word each.
    pub(super) fn remarks(&self) -> Vec<&'static str> {
        let mut remarks = Vec::new();
        for (wrong, word) in [
            (self.refusal.is_some(), "refused"),
            (!self.class && self.refusal.is_none(), "CLASS"),
            (self.class && !self.faces, "FACES"),
            (self.outside, "out"),
            (!self.symmetric, "swap"),
            (!self.idempotent, "again"),
            (!self.violations.is_empty(), "GUARANTEE"),
        ] {
            if wrong {
                remarks.push(word);
            }
        }
        remarks
    }
}

impl Replay {
    /// Runs a case through everything.
    ///
    /// # Errors
    /// A coordinate of the segment is not finite, which no line has.
    pub(super) fn new(case: CaseLine) -> Result<Self, NonFinite> {
        let segment = match case.segment {
            CaseSegment::Single(segment) => segment.to_f64(),
            CaseSegment::Double(segment) => segment,
        };
        let oracle = Oracle::new(&case.frustum);
        let truth = oracle.clip(&segment)?;
        let single = as_single(&segment);
        let answer = |algorithm, tier: SurveyTier| {
            let clipper = SurveyClipper::new(algorithm, tier, &case.frustum);
            let verdict = if tier.is_single() {
                let clip: Clip<'_, f32> = &|s, counts| clipper.clip_f32(s, counts);
                Judge::new(&oracle, &truth, single.as_ref()?, clip).verdict(tier)
            } else {
                let clip: Clip<'_, f64> = &|s, counts| clipper.clip_f64(s, counts);
                Judge::new(&oracle, &truth, &segment, clip).verdict(tier)
            };
            Some(Answer {
                algorithm,
                tier,
                verdict,
            })
        };
        let tiers = SurveyTier::ALL.into_iter();
        let answers = tiers
            .flat_map(|tier| SurveyAlgorithm::ALL.map(|a| answer(a, tier)))
            .flatten()
            .collect();
        let has_f32 = single.is_some();
        Ok(Self {
            case,
            segment,
            truth,
            answers,
            has_f32,
        })
    }

    /// The crate's own: projection reduction, exact, fast.
    pub(super) fn own(&self) -> Option<&Answer> {
        let own = |a: &&Answer| {
            a.algorithm == SurveyAlgorithm::Vw
                && a.tier.is_exact()
                && a.tier.is_single() == matches!(self.case.segment, CaseSegment::Single(_))
        };
        self.answers.iter().find(own)
    }

    /// Whether an exact answer breaks a guarantee.
    pub(super) fn exact_is_wrong(&self) -> bool {
        let wrong = |a: &Answer| {
            let v = &a.verdict;
            a.tier.is_exact() && !(v.is_right() && v.symmetric && v.violations.is_empty())
        };
        self.answers.iter().any(wrong)
    }
}

/// The same segment in `f32`, if that has its coordinates.
fn as_single(segment: &Segment<f64>) -> Option<Segment<f32>> {
    let single = |p: frusta::Vec3<f64>| frusta::Vec3::<f32>::from_f64(p);
    let rounded = Segment::new(single(segment.start), single(segment.end));
    (rounded.to_f64() == *segment).then_some(rounded)
}

/// A tier's clipper; `None` if it is of the other scalar type.
type Clip<'a, T> =
    &'a dyn Fn(&Segment<T>, &mut StageCounts) -> Option<Result<SegmentClip<T>, NonFinite>>;

/// What an answer in `T` is compared with, and what gives the answer.
struct Judge<'a, T> {
    oracle: &'a Oracle,
    truth: &'a OracleClip,
    segment: &'a Segment<T>,
    clip: Clip<'a, T>,
}

impl<'a, T: Real> Judge<'a, T> {
    fn new(
        oracle: &'a Oracle,
        truth: &'a OracleClip,
        segment: &'a Segment<T>,
        clip: Clip<'a, T>,
    ) -> Self {
        Self {
            oracle,
            truth,
            segment,
            clip,
        }
    }

    fn verdict(&self, tier: SurveyTier) -> Verdict {
        let mut stages = StageCounts::default();
        let answer = self.attempt(self.segment, &mut stages);
        let found = match (&answer, accuracy(tier)) {
            (Ok(answer), Some(accuracy)) => {
                self.oracle
                    .check(self.truth, self.segment, accuracy, answer)
            }
            _ => Vec::new(),
        };
        let again = |segment: &Segment<T>| self.attempt(segment, &mut StageCounts::default());
        let mut verdict = self.judge(answer, again);
        verdict.stages = stages;
        verdict.violations = found.iter().map(ToString::to_string).collect();
        verdict
    }

    /// A clipper that panics has a bug; the others' answers are wanted all the same.
    fn attempt(
        &self,
        segment: &Segment<T>,
        stages: &mut StageCounts,
    ) -> Result<SegmentClip<T>, String> {
        let clip = AssertUnwindSafe(|| (self.clip)(segment, stages));
        match catch_unwind(clip) {
            Ok(Some(Ok(answer))) if is_finite(&answer) => Ok(answer),
            Ok(Some(Ok(_))) => Err("not finite".to_owned()),
            Ok(Some(Err(refusal))) => Err(refusal.to_string()),
            Ok(None) => Err("another type".to_owned()),
            Err(_) => Err("it panicked".to_owned()),
        }
    }

    fn judge(
        &self,
        answer: Result<SegmentClip<T>, String>,
        clip: impl Fn(&Segment<T>) -> Result<SegmentClip<T>, String>,
    ) -> Verdict {
        let answer = match answer {
            Ok(answer) => answer,
            Err(why) => return Verdict::refused(why),
        };
        let truth = self.truth;
        let class = answer.class == truth.class && answer.part.is_some() == truth.part.is_some();
        let parts = answer.part.as_ref().zip(truth.part.as_ref());
        let clipped = |part: &Part<T>| {
            let ends = [part.entry, part.exit];
            let left = |e: &PartEnd<T>| e.clipped && !self.oracle.contains(e.point);
            ends.iter().any(left)
        };
        let swapped = clip(&self.segment.reversed());
        let symmetric = swapped.is_ok_and(|swapped| check_swapped(&answer, &swapped).is_none());
        Verdict {
            clip: Some(widened(&answer)),
            refusal: None,
            class,
            faces: parts.is_none_or(|(is, should)| {
                is.coplanar == should.coplanar
                    && [(is.entry, &should.entry), (is.exit, &should.exit)]
                        .iter()
                        .all(|(is, should)| {
                            is.faces == should.faces && is.clipped == should.clipped
                        })
            }),
            errors: parts.filter(|_| class).map(|(is, should)| {
                [(is.entry, &should.entry), (is.exit, &should.exit)]
                    .map(|(is, should)| self.error(&Gauge::new::<T>(should), is))
            }),
            outside: class && answer.part.as_ref().is_some_and(clipped),
            symmetric,
            idempotent: is_idempotent(&answer, clip),
            violations: Vec::new(),
            stages: StageCounts::default(),
        }
    }

    fn error(&self, gauge: &Gauge, end: PartEnd<T>) -> EndError {
        let coordinates = [self.segment.start, self.segment.end].map(|p| p.to_f64().to_array());
        let largest = coordinates.as_flattened().iter();
        let scale = largest.fold(0.0_f64, |a, c| a.max(c.abs()));
        let deviation = gauge.deviation(end.point);
        EndError {
            ulp: gauge.deviation_in_ulps(end.point),
            // No product that underflows; without a deviation nothing is divided.
            u_scale: if deviation == 0.0 {
                0.0
            } else {
                deviation / scale / T::UNIT_ROUNDOFF
            },
        }
    }
}

impl Verdict {
    fn refused(why: String) -> Self {
        Self {
            clip: None,
            refusal: Some(why),
            class: false,
            faces: false,
            errors: None,
            outside: false,
            symmetric: true,
            idempotent: true,
            violations: Vec::new(),
            stages: StageCounts::default(),
        }
    }
}

/// Whether the part, clipped again, comes back; whatever its clipper promises.
fn is_idempotent<T: Real>(
    answer: &SegmentClip<T>,
    clip: impl Fn(&Segment<T>) -> Result<SegmentClip<T>, String>,
) -> bool {
    let mut claimed = *answer;
    if let Some(part) = &mut claimed.part {
        (part.entry.inward, part.exit.inward) = (true, true);
    }
    let again = |segment: &Segment<T>| Ok(clip(segment).unwrap_or(SegmentClip::OUTSIDE));
    check_idempotent(&claimed, again).is_none()
}

fn is_finite<T: Real>(answer: &SegmentClip<T>) -> bool {
    let finite = |e: &PartEnd<T>| e.t.is_finite() && e.point.is_finite();
    let part = answer.part.as_ref();
    part.is_none_or(|p| finite(&p.entry) && finite(&p.exit))
}

/// The same answer in `f64`.
fn widened<T: Real>(answer: &SegmentClip<T>) -> SegmentClip<f64> {
    let end = |e: PartEnd<T>| PartEnd {
        t: e.t.to_f64(),
        point: e.point.to_f64(),
        clipped: e.clipped,
        faces: e.faces,
        inward: e.inward,
    };
    SegmentClip {
        class: answer.class,
        part: answer.part.map(|part| Part {
            entry: end(part.entry),
            exit: end(part.exit),
            coplanar: part.coplanar,
        }),
    }
}

/// The accuracy of a tier's points; `None` for plain arithmetic.
fn accuracy(tier: SurveyTier) -> Option<Accuracy> {
    match tier {
        SurveyTier::PlainF32 | SurveyTier::PlainF64 => None,
        SurveyTier::ExactFast | SurveyTier::ExactFastF32 => Some(Accuracy::Fast),
        SurveyTier::ExactNearest | SurveyTier::ExactNearestF32 => Some(Accuracy::Nearest),
        SurveyTier::ExactInward | SurveyTier::ExactInwardF32 => Some(Accuracy::Inward),
    }
}

/// The sets of an answer in letters: `NLT>FR`, with `|B` for what it lies in.
pub(super) fn letters(class: Class, sets: [FaceSet; 3]) -> String {
    const LETTERS: [char; 6] = ['N', 'F', 'L', 'R', 'B', 'T'];
    if class == Class::Outside {
        return String::new();
    }
    let of = |set: FaceSet| -> String { set.iter().map(|face| LETTERS[face as usize]).collect() };
    let [enter, leave, coplanar] = sets.map(of);
    let dash = |set: String| if set.is_empty() { "-".to_owned() } else { set };
    let mut text = format!("{}>{}", dash(enter), dash(leave));
    if !coplanar.is_empty() {
        text += &format!("|{coplanar}");
    }
    text
}
