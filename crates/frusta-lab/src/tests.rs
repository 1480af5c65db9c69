//! The harness accepts a right clipper and catches wrong ones.

use super::*;
use frusta::clip::{Accuracy, SegmentClip, StageCounts};
use frusta::frustum::{FaceSet, Frustum};
use frusta::math::{NonFinite, Real, Segment};
use frusta::oracle::{Oracle, ViolationKind};
use frusta::samples::{BLOCK, Family};

/// The oracle's rounded answers, spoilt by a function.
struct Spoilt<F>(F);

/// What spoils an answer, in either scalar type.
trait Spoil: Sync {
    fn spoil<T: Real>(&self, segment: &Segment<T>, answer: &mut SegmentClip<T>);
}

impl<F: Spoil> Spoilt<F> {
    fn clip<T: Real>(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        counts.integers += 1;
        let mut answer = Oracle::new(frustum).answer(segment, accuracy)?;
        self.0.spoil(segment, &mut answer);
        Ok(answer)
    }
}

impl<F: Spoil> Subject for Spoilt<F> {
    fn clip_f64(
        &self,
        frustum: &Frustum,
        segment: &Segment<f64>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<f64>, NonFinite> {
        self.clip(frustum, segment, accuracy, counts)
    }

    fn clip_f32(
        &self,
        frustum: &Frustum,
        segment: &Segment<f32>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<f32>, NonFinite> {
        self.clip(frustum, segment, accuracy, counts)
    }
}

struct Unspoilt;
impl Spoil for Unspoilt {
    fn spoil<T: Real>(&self, _: &Segment<T>, _: &mut SegmentClip<T>) {}
}

/// Misses what only touches, as an open or a rounded test does.
struct MissesTouches;
impl Spoil for MissesTouches {
    fn spoil<T: Real>(&self, _: &Segment<T>, answer: &mut SegmentClip<T>) {
        if answer.class == frusta::Class::Touch {
            *answer = SegmentClip::OUTSIDE;
        }
    }
}

/// Rounds entries up, whichever way the segment goes.
struct Biased;
impl Spoil for Biased {
    fn spoil<T: Real>(&self, _: &Segment<T>, answer: &mut SegmentClip<T>) {
        if let Some(part) = &mut answer.part
            && part.entry.clipped
        {
            part.entry.point.x = part.entry.point.x.next_up();
        }
    }
}

/// Forgets what contains the segment, and panics on some input.
struct Forgets;
impl Spoil for Forgets {
    fn spoil<T: Real>(&self, segment: &Segment<T>, answer: &mut SegmentClip<T>) {
        assert!(segment.start != segment.end, "zero length");
        if let Some(part) = &mut answer.part {
            part.coplanar = FaceSet::EMPTY;
        }
    }
}

fn options(cases: u64) -> Options {
    Options {
        cases,
        threads: 2,
        ..Options::default()
    }
}

fn total(rows: &[FamilyRow]) -> FamilyRow {
    let mut total = rows[0].clone();
    rows[1..].iter().for_each(|r| total.merge(r.clone()));
    total
}

#[test]
fn a_right_clipper_is_clean_in_every_family() {
    let mut seen = 0;
    let rows = verify(&Spoilt(Unspoilt), &options(2 * BLOCK), |row| {
        assert!(row.is_clean(), "{}", VerifyTable(std::slice::from_ref(row)));
        seen += 1;
    });
    assert_eq!(rows.len(), seen);
    let with_f32 = Family::ALL.iter().filter(|f| f.has_f32()).count();
    assert_eq!(rows.len(), Family::ALL.len() + with_f32);
    let total = total(&rows);
    assert_eq!(total.integers, total.cases);
    assert!(total.inward_ends > 1_000 && total.room_ends > 100);
    assert!(total.not_inward > 0, "thin frusta hold no inward points");
    // Two ulps a coordinate is how far an inward point may be.
    assert!(total.room_mean() < 4.0, "{}", total.room_mean());
}

#[test]
fn missed_touches_are_wrong_classes() {
    let rows = verify(&Spoilt(MissesTouches), &options(BLOCK), |_| {});
    let total = total(&rows);
    assert!(total.count(ViolationKind::Class) > 200);
    assert_eq!(total.count(ViolationKind::Refused), 0);
}

#[test]
fn a_bias_breaks_symmetry_and_rounding() {
    let options = Options {
        families: vec![Family::Random, Family::OffAxis],
        ..options(BLOCK)
    };
    for row in verify(&Spoilt(Biased), &options, |_| {}) {
        assert!(row.count(ViolationKind::Swapped) > 5);
        assert!(row.count(ViolationKind::Point) > 5);
        assert_eq!(row.count(ViolationKind::Class), 0);
        let witness = row.witness.unwrap();
        assert_eq!(witness.violation.kind, ViolationKind::Swapped);
        assert!(witness.input.contains("0x1."), "{witness}");
    }
}

#[test]
fn forgotten_sets_and_panics_are_findings() {
    let options = Options {
        families: vec![Family::Bumps, Family::Points],
        with_f32: false,
        ..options(4 * BLOCK)
    };
    let rows = verify(&Spoilt(Forgets), &options, |_| {});
    assert!(rows[0].count(ViolationKind::Set) > 5);
    assert_eq!(rows[1].count(ViolationKind::Refused), rows[1].cases);
}

#[test]
fn threads_do_not_change_the_outcome() {
    let with = |threads| {
        let options = Options {
            families: vec![Family::Bumps, Family::HalfLattice],
            cases: 300,
            threads,
            ..Options::default()
        };
        verify(&Spoilt(MissesTouches), &options, |_| {})
    };
    let (one, three) = (with(1), with(3));
    for (mut a, b) in one.into_iter().zip(three) {
        assert_eq!(a.cases, 300);
        // Only the order of the additions may differ.
        assert!((a.room_sum - b.room_sum).abs() < 1e-9);
        a.room_sum = b.room_sum;
        assert_eq!(a, b);
    }
}

#[test]
fn the_table_fits_its_width() {
    let options = Options {
        families: vec![Family::FreePose, Family::CrossingNearEnds],
        ..options(BLOCK)
    };
    let rows = verify(&Spoilt(Biased), &options, |_| {});
    let table = VerifyTable(&rows).to_string();
    assert!(table.lines().all(|l| l.chars().count() <= 120), "{table}");
    assert!(table.lines().count() > rows.len() + 2);
    assert!(table.contains("free-pose") && table.contains("0x1."));
}
