//! A survey finds a clipper's faults, does not depend on the number of threads, and fits its table.

use super::entrant::AnyClipper;
use super::*;
use crate::turns::Spread;
use frusta::clip::{Accuracy, Class, SegmentClip, SegmentClipper, StageCounts, VwProjection};
use frusta::frustum::{FaceSet, Frustum};
use frusta::math::{NonFinite, Segment};

/// The exact answer, spoilt by a function.
struct Spoilt(Accuracy, fn(&Segment<f64>, &mut SegmentClip<f64>));

impl SegmentClipper<f64> for Spoilt {
    fn name(&self) -> &'static str {
        "spoilt"
    }

    fn clip_segment_counted(
        &self,
        frustum: &Frustum,
        segment: &Segment<f64>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<f64>, NonFinite> {
        let mut answer = frustum.clip_segment_counted(segment, self.0, counts)?;
        self.1(segment, &mut answer);
        Ok(answer)
    }
}

/// In the place of V/W.
fn entrant(tier: SurveyTier, clipper: impl SegmentClipper<f64> + Sync + 'static) -> Entrant {
    Entrant {
        algorithm: SurveyAlgorithm::Vw,
        tier,
        clipper: AnyClipper::Double(Box::new(clipper)),
    }
}

fn options(families: &[Family], cases: u64) -> SurveyOptions {
    SurveyOptions {
        families: families.to_vec(),
        cases,
        rounds: 1,
        timed: 16,
        threads: 2,
        ..SurveyOptions::default()
    }
}

/// A spoilt clipper's row, behind one that is right, and its survey.
fn found(
    tier: SurveyTier,
    accuracy: Accuracy,
    spoil: fn(&Segment<f64>, &mut SegmentClip<f64>),
) -> (SurveyRow, Survey) {
    let right = entrant(tier, VwProjection::exact(accuracy));
    let entrants = [right, entrant(tier, Spoilt(accuracy, spoil))];
    let options = options(&[Family::OffAxis], 256);
    let survey = survey_of(&entrants, &options, &|_, _| {});
    assert!(survey.rows[0].is_right(), "{:?}", survey.rows[0]);
    assert!(!survey.rows[1].is_right() && !survey.exact_is_right());
    (survey.rows[1].clone(), survey)
}

#[test]
fn a_missed_touch_is_a_wrong_class() {
    let (row, survey) = found(SurveyTier::ExactFast, Accuracy::Fast, |_, answer| {
        if answer.class == Class::Touch {
            *answer = SegmentClip::OUTSIDE;
        }
    });
    assert!(row.wrong_class > 5 && row.cases == 256);
    assert_eq!((row.wrong_faces, row.refused, row.asymmetric), (0, 0, 0));
    let witness = survey
        .witnesses
        .iter()
        .rfind(|w| w.worst == SurveyWorst::Class);
    let witness = witness.unwrap();
    assert_eq!(witness.value, row.wrong_class as f64);
    // The witness is the case, to the bit, and such a one.
    let (frustum, segment) = Family::OffAxis.case(survey.seed, witness.case);
    let case: CaseLine = witness.line.parse().unwrap();
    assert_eq!(case, CaseLine::new(&frustum, &segment));
    assert_eq!(frustum.clip_segment(&segment).unwrap().class, Class::Touch);
}

#[test]
fn forgotten_faces_are_wrong_faces() {
    let (row, _) = found(SurveyTier::ExactFast, Accuracy::Fast, |_, answer| {
        if let Some(part) = &mut answer.part {
            part.entry.faces = FaceSet::EMPTY;
        }
    });
    assert!(row.wrong_faces > 5 && row.asymmetric > 5);
    assert_eq!(row.wrong_class, 0);
}

#[test]
fn one_bit_of_one_answer_is_noticed_behind_a_right_one() {
    let (row, _) = found(SurveyTier::ExactNearest, Accuracy::Nearest, |_, answer| {
        if let Some(part) = &mut answer.part
            && part.exit.clipped
        {
            part.exit.point.x = part.exit.point.x.next_up();
        }
    });
    assert!(row.error_ulp.max > 0.5 && row.error_ulp.max <= 1.5);
    assert!(row.error_ulp.p999 > 0.5 && row.error_u_scale.max > 0.0);
    assert!(row.asymmetric > 5);
    assert_eq!(row.wrong_class + row.wrong_faces + row.refused, 0);
}

#[test]
fn points_beyond_the_faces_are_outside_and_clipped_again() {
    let halfway: fn(&Segment<f64>, &mut SegmentClip<f64>) = |segment, answer| {
        if let Some(part) = &mut answer.part
            && part.exit.clipped
        {
            part.exit.point = (part.exit.point + segment.end) * 0.5;
        }
    };
    let (row, _) = found(SurveyTier::ExactInward, Accuracy::Inward, halfway);
    assert!(row.outside > 5 && row.non_idempotent > 5, "{row:?}");
    // What is flagged promises nothing.
    let flagged: fn(&Segment<f64>, &mut SegmentClip<f64>) = |segment, answer| {
        let beyond = segment.end;
        if let Some(part) = &mut answer.part
            && part.exit.clipped
        {
            (part.exit.point, part.exit.inward) = (beyond, false);
        }
    };
    let (row, _) = found(SurveyTier::ExactInward, Accuracy::Inward, flagged);
    assert_eq!(row.outside + row.non_idempotent, 0);
    assert!(row.error_ulp.max > 2.0);
}

#[test]
fn panics_and_numbers_that_are_not_finite_are_refusals() {
    let (row, survey) = found(SurveyTier::ExactFast, Accuracy::Fast, |segment, answer| {
        assert!(answer.class != Class::Boundary, "{segment:?}");
        if let Some(part) = &mut answer.part
            && answer.class == Class::Cross
        {
            part.entry.t = f64::NAN;
        }
    });
    assert!(row.refused > 50);
    assert_eq!(row.wrong_class + row.wrong_faces + row.asymmetric, 0);
    let numbers = [row.ns_median, row.time_ratio.median, row.error_ulp.max];
    assert!(numbers.iter().all(|n| n.is_finite()));
    let first = survey
        .witnesses
        .iter()
        .find(|w| w.worst == SurveyWorst::Refused);
    assert_eq!(first.unwrap().value, row.refused as f64);
}

#[test]
fn every_tier_is_there_and_threads_change_nothing() {
    let families = [Family::Bumps, Family::Subnormal, Family::Thin];
    let with = |threads| {
        let options = SurveyOptions {
            threads,
            ..options(&families, 150)
        };
        let done = [const { AtomicU64::new(0) }; 2];
        let on_work = |work, units| {
            done[usize::from(work == Work::CaseRounds)].fetch_add(units, Ordering::Relaxed);
        };
        let mut survey = survey(&options, &on_work);
        let done = done.map(AtomicU64::into_inner);
        assert_eq!(
            options.work(),
            [(Work::Cases, done[0]), (Work::CaseRounds, done[1])]
        );
        for row in &mut survey.rows {
            assert!(row.ns_median > 0.0 && row.time_ratio.median > 0.0);
            (row.ns_median, row.time_ratio) = (0.0, Spread::default());
        }
        survey
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(one, three);
    assert!(one.exact_is_right());
    // Eight tiers of six algorithms; four of them without f32.
    assert_eq!(one.rows.len(), 6 * (8 + 4 + 8));
    assert!(one.rows.iter().all(|row| row.cases == 150));
    for algorithm in SurveyAlgorithm::ALL {
        let row = |tier| one.row(algorithm, tier, Family::Thin).unwrap();
        for tier in [SurveyTier::PlainF32, SurveyTier::PlainF64] {
            assert!(row(tier).wrong_class > 0, "{algorithm} {tier}");
            assert_eq!(row(tier).filter_failures, 0);
        }
        assert!(row(SurveyTier::ExactFast).filter_failures > 0);
        assert!(row(SurveyTier::ExactNearest).error_ulp.max > 0.0);
    }
}

#[test]
fn the_reference_is_one_and_no_rounds_are_no_times() {
    let mut options = options(&[Family::Points], 1);
    let reference = |survey: &Survey| {
        let name = SurveyAlgorithm::REFERENCE;
        let row = survey.row(name, SurveyTier::PlainF64, Family::Points);
        row.unwrap().time_ratio.median
    };
    assert_eq!(reference(&survey(&options, &|_, _| {})), 1.0);
    options.rounds = 0;
    let none = survey(&options, &|_, _| {});
    assert!(none.rows.iter().all(|row| row.ns_median == 0.0));
}

#[test]
fn what_spoils_an_exact_row() {
    let survey = survey(&options(&[Family::OffAxis], 64), &|_, _| {});
    let spoilt = |tier, spoil: fn(&mut SurveyRow)| {
        let mut survey = survey.clone();
        let row = survey.rows.iter_mut().find(|row| row.tier == tier);
        spoil(row.unwrap());
        !survey.exact_is_right()
    };
    let fast = SurveyTier::ExactFastF32;
    assert!(survey.exact_is_right());
    assert!(spoilt(fast, |row| row.wrong_class = 1));
    assert!(spoilt(fast, |row| row.wrong_faces = 1));
    assert!(spoilt(fast, |row| row.refused = 1));
    assert!(spoilt(fast, |row| row.asymmetric = 1));
    assert!(spoilt(fast, |row| row.error_u_scale.max = 8.1));
    assert!(!spoilt(fast, |row| row.outside = 1));
    assert!(spoilt(SurveyTier::ExactNearest, |row| row.error_ulp.max = 0.51));
    assert!(spoilt(SurveyTier::ExactInward, |row| row.outside = 1));
    assert!(spoilt(SurveyTier::ExactInward, |row| row.non_idempotent = 1));
    assert!(!spoilt(SurveyTier::PlainF64, |row| row.wrong_class = 9));
}

#[test]
fn the_tables_fit_a_terminal() {
    let mut survey = survey(
        &options(&[Family::CrossingNearEnds, Family::Huge], 64),
        &|_, _| {},
    );
    let fits = |survey: &Survey| {
        let text = SurveyTable(survey).to_string();
        let widest = text.lines().map(|line| line.chars().count()).max();
        let wide = text
            .lines()
            .find(|line| Some(line.chars().count()) == widest);
        assert!(widest <= Some(100), "{wide:?}");
        text
    };
    let text = fits(&survey);
    for part in [
        "\nexact-inward-f32: 64 cases\n",
        "\nplain-f64: 128 cases\n",
        "\nhuge ",
    ] {
        assert!(text.contains(part), "{part:?} not in\n{text}");
    }
    // As wide as numbers get.
    for row in &mut survey.rows {
        row.cases = 1 << 16;
        for count in [&mut row.wrong_class, &mut row.wrong_faces, &mut row.refused] {
            *count = 1 << 16;
        }
        (row.outside, row.asymmetric) = (1, 1 << 16);
        row.error_ulp.max = f64::MAX;
        row.error_u_scale.max = 9_999.0;
        (row.ns_median, row.time_ratio) = (1e7, Spread::new(vec![1e5, 1e6]));
    }
    fits(&survey);
}
