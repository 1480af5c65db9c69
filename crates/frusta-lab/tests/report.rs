//! The paper's table and the verification, with small counts.

use frusta::clip::{SegmentClipper, SixPlanes};
use frusta::oracle::ViolationKind;
use frusta::samples::Family;
use frusta::{Accuracy, Frustum, NonFinite, Segment, SegmentClip, StageCounts};
use frusta_lab::{
    ExactClipper, Options, PaperTable, Subject, Tier, paper_table, rotated_poses, verify,
};
use std::sync::OnceLock;

fn table() -> &'static PaperTable {
    static TABLE: OnceLock<PaperTable> = OnceLock::new();
    TABLE.get_or_init(|| paper_table(20, || {}))
}

#[test]
fn exact_rows_are_right_everywhere() {
    let exact: Vec<_> = table()
        .rows
        .iter()
        .filter(|r| r.tier == Tier::Exact)
        .collect();
    assert_eq!(exact.len(), 12);
    for row in exact {
        let name = (row.algorithm, row.scalar);
        let counts = row.scores().map(|s| s.samples);
        let poses = rotated_poses().len();
        assert_eq!(counts, [78, 63 * 78, 96 * 78, 2 * poses * 78], "{name:?}");
        for score in row.scores() {
            assert_eq!(score.right_classes, score.samples, "{name:?}");
            assert_eq!(score.right_sets, score.samples, "{name:?}");
            assert!(score.max_error <= 8.0, "{name:?}");
        }
        assert!(row.is_right() && row.failures.is_empty(), "{name:?}");
    }
    assert!(table().exact_is_right());
    assert!(rotated_poses().len() >= 90);
}

#[test]
fn plain_six_planes_errs_and_is_named_for_it() {
    for scalar in ["f64", "f32"] {
        let row = table().row("six-planes", Tier::Plain, scalar).unwrap();
        assert!(!row.is_right());
        assert!(row.stretched.wrong()[0] >= 10, "{scalar}");
        let counted: usize = row.failures.iter().map(|f| f.count).sum();
        let wrong: usize = row.scores().iter().map(|s| s.wrong()[0]).sum();
        assert!(counted >= wrong);
        for failure in &row.failures {
            assert_ne!(failure.said, failure.truth);
            assert!(failure.sample.contains('/'));
        }
        // What the paper says of the two others.
        for other in ["liang-barsky-textbook", "vw"] {
            let row = table().row(other, Tier::Plain, scalar).unwrap();
            assert_eq!(row.standard.wrong(), [0, 0], "{other}");
            assert_eq!(row.stretched.wrong(), [0, 0], "{other}");
        }
    }
}

#[test]
fn run_times_stand_beside_the_papers() {
    let table = table();
    assert_eq!((table.repeats, table.rounds, table.rows.len()), (20, 1, 24));
    for row in &table.rows {
        for timing in [row.in_order, row.shuffled] {
            assert!(timing.nanoseconds > 0.0 && timing.ratio.median > 0.0);
        }
        let paper = match (row.tier, row.algorithm) {
            (Tier::Plain, "liang-barsky-textbook") => Some(1.0),
            (Tier::Plain, "six-planes") => Some(4228.0 / 4243.0),
            (Tier::Plain, "vw") => Some(4212.0 / 4243.0),
            _ => None,
        };
        assert_eq!(row.paper, paper, "{}", row.algorithm);
        if paper == Some(1.0) {
            assert_eq!(row.in_order.ratio.median, 1.0);
        }
    }
}

#[test]
fn a_wrong_answer_spoils_an_exact_row() {
    let spoilt = |spoil: fn(&mut frusta_lab::PaperRow)| {
        let mut table = table().clone();
        let row = table.rows.iter_mut().find(|r| r.tier == Tier::Exact);
        spoil(row.unwrap());
        !table.exact_is_right()
    };
    assert!(spoilt(|row| row.standard.right_classes -= 1));
    assert!(spoilt(|row| row.rotated.right_sets -= 1));
    assert!(spoilt(|row| row.turned.max_error = 8.5));
    assert!(spoilt(|row| row.steady = false));
    assert!(!spoilt(|row| row.standard.max_error = 7.5));
}

#[test]
fn the_table_fits_a_terminal() {
    let text = table().to_string();
    let widest = text.lines().max_by_key(|l| l.chars().count()).unwrap();
    assert!(widest.chars().count() <= 100, "{widest}");
    for part in ["f32, exact", "4243 : 4228 : 4212", "six-planes plain f64: "] {
        assert!(text.contains(part), "{part} not in\n{text}");
    }
    let named = table().row("six-planes", Tier::Plain, "f64").unwrap();
    for failure in &named.failures {
        assert!(text.contains(&failure.sample));
    }
}

/// Plain six planes, which claims nothing of what is asked for here.
struct Claims;

impl Subject for Claims {
    fn clip_f64(
        &self,
        frustum: &Frustum,
        segment: &Segment<f64>,
        _: Accuracy,
        _: &mut StageCounts,
    ) -> Result<SegmentClip<f64>, NonFinite> {
        SixPlanes::plain().clip_segment(frustum, segment)
    }

    fn clip_f32(
        &self,
        frustum: &Frustum,
        segment: &Segment<f32>,
        _: Accuracy,
        _: &mut StageCounts,
    ) -> Result<SegmentClip<f32>, NonFinite> {
        SixPlanes::plain().clip_segment(frustum, segment)
    }
}

#[test]
fn verification_tells_the_exact_clipper_from_a_plain_one() {
    let options = Options {
        families: vec![Family::Collinear, Family::HalfLattice, Family::Rotated],
        cases: 200,
        ..Options::default()
    };
    for row in verify(&ExactClipper, &options, |_| {}) {
        assert!(row.is_clean(), "{:?}", row.witness);
    }
    for row in verify(&Claims, &options, |_| {}) {
        assert!(row.count(ViolationKind::Class) > 0, "{row}");
        assert!(row.witness.is_some());
    }
}
