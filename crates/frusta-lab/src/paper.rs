//! The paper's table, reproduced.
//!
//! # Source
//! "View Frustum Culling Geometric Algorithm" (视锥体裁剪几何算法研究, in Chinese)
//! clips 78 singular samples 100,000 times each in the standard frame, gives the
//! run times of Liang-Barsky, the general algorithm (six planes) and projection
//! reduction (V/W) as 4243 : 4228 : 4212, and says that the general algorithm
//! errs where the two others do not. It names neither machine nor unit, and lists
//! no samples; [`singular_samples`](frusta::samples::singular_samples) are our derivation of the 78.
//!
//! # What is measured
//! - *Time*: see [`super::paper_timing`]. A ratio to textbook Liang-Barsky in
//!   plain arithmetic of the same scalar type, which is what the paper compares
//!   with.
//! - *Answers*: class and face sets against rational arithmetic, in the standard
//!   frame, under the 48 signed permutations of the axes, and in
//!   [`rotated_poses`]. All these samples are exact in both scalar types.
//!   The crossing parameters of the 78 are exact, too, so that hardly anything is rounded and
//!   no clipper errs. So they are also stretched, by all factors of a list, none of which was
//!   chosen for its effect.
//! - *Error*: the largest distance of a point from the exact one, over the answers
//!   with the right class. A wrong class is counted, never averaged.

use super::paper_answers::{Exam, PaperFailure, Score};
use super::paper_timing;
use super::turns::Timing;
use frusta::clip::{
    Accuracy, Arithmetic, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant,
    SegmentClipper, SixPlanes, VwProjection,
};
use frusta::math::{Real, Vec3};
use frusta::samples::{Placement, Solid};

/// The frustum that the samples are made for.
pub(super) const SOLID: Solid = Solid::SYMMETRIC;

/// The paper's run times; their unit is not given.
const PAPER_TIMES: [(&str, f64); 3] = [(REFERENCE, 4243.0), ("six-planes", 4228.0), ("vw", 4212.0)];

/// The reference of all ratios.
const REFERENCE: &str = "liang-barsky-textbook";

/// By how many roundoffs of the segment's largest coordinate `Accuracy::Fast` may
/// be off.
const FAST_BOUND: f64 = 8.0;

/// The arithmetic of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// The textbook's algorithm in floating point.
    Plain,
    /// Exact decisions, points to [`Accuracy::Fast`].
    Exact,
}

impl Tier {
    /// Both tiers.
    pub const ALL: [Tier; 2] = [Tier::Plain, Tier::Exact];

    /// The tier's name in lower case.
    pub const fn name(self) -> &'static str {
        ["plain", "exact"][self as usize]
    }
}

/// The table's data.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperTable {
    /// How often each sample was clipped by each clipper for each time.
    pub repeats: u32,
    /// The number of timed rounds.
    pub rounds: u32,
    /// A row for each clipper, tier and scalar type.
    pub rows: Vec<PaperRow>,
}

/// A clipper in a tier and a scalar type.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperRow {
    /// The clipper's name.
    pub algorithm: &'static str,
    /// Its arithmetic.
    pub tier: Tier,
    /// `f64` or `f32`.
    pub scalar: &'static str,
    /// The paper's ratio of run times, where it gives one.
    pub paper: Option<f64>,
    /// The samples in their order, over and over, as in the paper.
    pub in_order: Timing,
    /// The samples in an order that never repeats.
    pub shuffled: Timing,
    /// Whether every answer while the time was taken was the same as before.
    pub steady: bool,
    /// The answers to the 78 samples in the standard frame.
    pub standard: Score,
    /// The answers to stretched samples there: the parts outside of the frustum are
    /// lengthened by each of 63 pairs of factors.
    pub stretched: Score,
    /// Samples as they are, and stretched by a pair of factors, under the 48
    /// signed permutations of the axes.
    pub turned: Score,
    /// Both in each of [`rotated_poses`].
    pub rotated: Score,
    /// The samples that were answered wrongly anywhere.
    pub failures: Vec<PaperFailure>,
}

impl PaperRow {
    /// All answers.
    pub fn scores(&self) -> [&Score; 4] {
        [&self.standard, &self.stretched, &self.turned, &self.rotated]
    }

    /// The largest error of all: in unit roundoffs of the segment's largest
    /// coordinate, and in units in the last place.
    pub fn max_error(&self) -> [f64; 2] {
        let largest = |of: fn(&Score) -> f64| self.scores().map(of).into_iter().fold(0.0, f64::max);
        [largest(|s| s.max_error), largest(|s| s.max_error_ulps)]
    }

    /// Whether every class and every set is right, and every point within
    /// [`Accuracy::Fast`].
    pub fn is_right(&self) -> bool {
        let right = |s: &Score| {
            s.right_classes == s.samples && s.right_sets == s.samples && s.max_error <= FAST_BOUND
        };
        self.steady && self.scores().into_iter().all(right)
    }
}

impl PaperTable {
    /// Whether all rows of the exact tier are right.
    pub fn exact_is_right(&self) -> bool {
        let mut exact = self.rows.iter().filter(|r| r.tier == Tier::Exact);
        exact.all(PaperRow::is_right)
    }

    /// A row.
    pub fn row(&self, algorithm: &str, tier: Tier, scalar: &str) -> Option<&PaperRow> {
        self.rows
            .iter()
            .find(|r| r.algorithm == algorithm && r.tier == tier && r.scalar == scalar)
    }
}

/// Measures all clippers, `repeats` times; `on_round` is called after each of
/// [`paper_rounds`].
///
/// ```
/// let mut rounds = 0;
/// let table = frusta_lab::paper_table(20, || rounds += 1);
/// assert!(table.exact_is_right());
/// assert_eq!(rounds, frusta_lab::paper_rounds(20));
/// ```
pub fn paper_table(repeats: u32, mut on_round: impl FnMut()) -> PaperTable {
    let mut rows = rows::<f64>("f64", repeats, &mut on_round);
    rows.extend(self::rows::<f32>("f32", repeats, &mut on_round));
    PaperTable {
        repeats,
        rounds: paper_timing::rounds(repeats),
        rows,
    }
}

/// The number of rounds that [`paper_table`] goes through.
pub fn paper_rounds(repeats: u32) -> u64 {
    2 * u64::from(paper_timing::rounds(repeats))
}

/// Poses turned by quaternions of small integers and moved by small integers, oblique to the
/// coordinate axes. The samples are exact there.
pub fn rotated_poses() -> Vec<Placement> {
    let entries = [-2_i8, -1, 1, 2];
    let mut poses = Vec::new();
    for w in [1, 2] {
        for x in entries {
            for y in entries {
                for z in entries {
                    let primitive = [w, x, y, z].iter().any(|v| v % 2 != 0);
                    let pose = Placement::rotated([w, x, y, z]);
                    let axis = pose.point(Vec3::new(1.0, 0.0, 0.0)).to_array();
                    let oblique = axis.iter().filter(|&&c| c != 0.0).count() > 1;
                    if primitive && oblique {
                        poses.push(pose.moved_to(Vec3::new(17.0, -9.0, 23.0)));
                    }
                }
            }
        }
    }
    poses
}

fn rows<T: Real>(scalar: &'static str, repeats: u32, on_round: &mut dyn FnMut()) -> Vec<PaperRow> {
    let exams = [
        Exam::<T>::standard(),
        Exam::stretched(),
        Exam::at(&Placement::signed_permutations()),
        Exam::at(&rotated_poses()),
    ];
    let clippers = clippers::<T>();
    let measured = paper_timing::measure(&clippers, reference(&clippers), repeats, on_round);
    clippers
        .iter()
        .zip(measured)
        .map(|((tier, clipper), measured)| {
            let mut failures = Vec::new();
            let scores = exams.each_ref();
            let scores = scores.map(|e| e.score(clipper.as_ref(), &mut failures));
            let [standard, stretched, turned, rotated] = scores;
            PaperRow {
                algorithm: clipper.name(),
                tier: *tier,
                scalar,
                paper: (*tier == Tier::Plain)
                    .then(|| paper_ratio(clipper.name()))
                    .flatten(),
                in_order: measured.in_order,
                shuffled: measured.shuffled,
                steady: measured.steady,
                standard,
                stretched,
                turned,
                rotated,
                failures,
            }
        })
        .collect()
}

fn paper_ratio(algorithm: &str) -> Option<f64> {
    let [(_, reference), ..] = PAPER_TIMES;
    let found = PAPER_TIMES.iter().find(|(name, _)| *name == algorithm);
    found.map(|(_, time)| time / reference)
}

/// A clipper behind the trait, as all of them are called.
pub(super) type Clipper<T> = (Tier, Box<dyn SegmentClipper<T>>);

/// The index of textbook Liang-Barsky in plain arithmetic.
fn reference<T: Real>(clippers: &[Clipper<T>]) -> usize {
    let is = |(tier, c): &Clipper<T>| *tier == Tier::Plain && c.name() == REFERENCE;
    clippers.iter().position(is).unwrap_or(0)
}

/// Every clipper, plain, then every one exact.
pub(super) fn clippers<T: Real>() -> Vec<Clipper<T>> {
    use LiangBarskyVariant::{Textbook, Tuned};
    let in_tier = |tier: Tier| -> [Clipper<T>; 6] {
        let arithmetic = match tier {
            Tier::Plain => Arithmetic::Plain,
            Tier::Exact => Arithmetic::Exact(Accuracy::Fast),
        };
        let liang_barsky = |variant| LiangBarsky {
            arithmetic,
            variant,
        };
        [
            (tier, Box::new(liang_barsky(Textbook))),
            (tier, Box::new(SixPlanes { arithmetic })),
            (tier, Box::new(VwProjection { arithmetic })),
            (tier, Box::new(liang_barsky(Tuned))),
            (tier, Box::new(CyrusBeck { arithmetic })),
            (tier, Box::new(CohenSutherland { arithmetic })),
        ]
    };
    Tier::ALL.into_iter().flat_map(in_tier).collect()
}
