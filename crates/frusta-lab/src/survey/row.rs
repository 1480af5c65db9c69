//! The findings of a survey: a row for each algorithm, tier and family, and the worst inputs.

use crate::turns::Spread;
use frusta::samples::Family;
use std::fmt;
use std::str::FromStr;

/// Arithmetic, scalar type, and accuracy of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SurveyTier {
    /// The textbook's algorithm in `f32`.
    PlainF32,
    /// The textbook's algorithm in `f64`.
    PlainF64,
    /// Exact decisions, `Accuracy::Fast`, `f64`.
    ExactFast,
    /// Exact decisions, `Accuracy::Nearest`, `f64`.
    ExactNearest,
    /// Exact decisions, `Accuracy::Inward`, `f64`.
    ExactInward,
    /// Exact decisions, `Accuracy::Fast`, `f32`.
    ExactFastF32,
    /// Exact decisions, `Accuracy::Nearest`, `f32`.
    ExactNearestF32,
    /// Exact decisions, `Accuracy::Inward`, `f32`.
    ExactInwardF32,
}

impl SurveyTier {
    /// All tiers, in the order of tables.
    pub const ALL: [SurveyTier; 8] = [
        SurveyTier::PlainF32,
        SurveyTier::PlainF64,
        SurveyTier::ExactFast,
        SurveyTier::ExactNearest,
        SurveyTier::ExactInward,
        SurveyTier::ExactFastF32,
        SurveyTier::ExactNearestF32,
        SurveyTier::ExactInwardF32,
    ];

    /// The tier's name, as in `report.json`.
    pub const fn name(self) -> &'static str {
        [
            "plain-f32",
            "plain-f64",
            "exact-fast",
            "exact-nearest",
            "exact-inward",
            "exact-fast-f32",
            "exact-nearest-f32",
            "exact-inward-f32",
        ][self as usize]
    }

    /// Whether every decision is an exact sign.
    pub const fn is_exact(self) -> bool {
        self as usize >= SurveyTier::ExactFast as usize
    }

    /// Whether points are promised to be inside: [`Accuracy::Inward`](frusta::Accuracy).
    pub const fn is_inward(self) -> bool {
        matches!(self, SurveyTier::ExactInward | SurveyTier::ExactInwardF32)
    }

    /// Whether segments and answers are in `f32`.
    pub const fn is_single(self) -> bool {
        matches!(
            self,
            SurveyTier::PlainF32
                | SurveyTier::ExactFastF32
                | SurveyTier::ExactNearestF32
                | SurveyTier::ExactInwardF32
        )
    }
}

impl fmt::Display for SurveyTier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// An algorithm, as a survey names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SurveyAlgorithm {
    /// Projection reduction.
    Vw,
    /// Liang-Barsky that divides only where the signs ask for it.
    LiangBarskyTuned,
    /// Liang-Barsky with a division for each side that is not parallel.
    LiangBarskyTextbook,
    /// Entering and leaving parameters against oriented planes.
    CyrusBeck,
    /// Region codes in the frustum's frame.
    CohenSutherland,
    /// Intersection with each face's plane, points kept that are inside.
    SixPlanes,
}

impl SurveyAlgorithm {
    /// All algorithms, in the order of tables.
    pub const ALL: [SurveyAlgorithm; 6] = [
        SurveyAlgorithm::Vw,
        SurveyAlgorithm::LiangBarskyTuned,
        SurveyAlgorithm::LiangBarskyTextbook,
        SurveyAlgorithm::CyrusBeck,
        SurveyAlgorithm::CohenSutherland,
        SurveyAlgorithm::SixPlanes,
    ];

    /// The reference of a row's time, in the same family: this algorithm in plain `f64`.
    pub const REFERENCE: SurveyAlgorithm = SurveyAlgorithm::LiangBarskyTextbook;

    /// The algorithm's name, the same as [`SegmentClipper::name`](frusta::clip::SegmentClipper::name)
    /// gives.
    pub const fn name(self) -> &'static str {
        [
            "vw",
            "liang-barsky-tuned",
            "liang-barsky-textbook",
            "cyrus-beck",
            "cohen-sutherland",
            "six-planes",
        ][self as usize]
    }
}

impl fmt::Display for SurveyAlgorithm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A largest and a nearly largest error.
///
/// Over the clipped ends of answers whose class is right: a wrong class is
/// counted, never averaged. Infinite or missing numbers are counted as
/// [`SurveyRow::refused`], so both are finite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurveyError {
    /// The largest error.
    pub max: f64,
    /// 99.9 % of the ends are at most this far off.
    pub p999: f64,
}

/// One algorithm in one tier on one family. Shares of cases are counts out of
/// `cases`.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyRow {
    /// The algorithm.
    pub algorithm: SurveyAlgorithm,
    /// The tier.
    pub tier: SurveyTier,
    /// The family.
    pub family: Family,
    /// How many cases were tried.
    pub cases: u64,
    /// Cases with a wrong class.
    pub wrong_class: u64,
    /// Cases of the right class with a wrong face set or clipped flag.
    pub wrong_faces: u64,
    /// Cases that were refused, panicked, or had a number that is not finite, also
    /// with the ends swapped or clipped again. They are in no other count.
    pub refused: u64,
    /// Nanoseconds a segment: the median over rounds.
    pub ns_median: f64,
    /// The time divided by the reference's in the same round. Larger is slower.
    pub time_ratio: Spread,
    /// Errors in units in the last place of the exact coordinate, fractional.
    pub error_ulp: SurveyError,
    /// Errors in unit roundoffs times the segment's largest coordinate, after the
    /// smallest subnormal, which every bound allows for.
    pub error_u_scale: SurveyError,
    /// Cases of the right class with an end that was clipped and is outside of
    /// the frustum, exactly. In inward tiers only ends that are flagged inward count:
    /// where no representable point near an end is inside, the end is not flagged.
    pub outside: u64,
    /// Cases whose answer is not the mirrored one when the ends are swapped.
    pub asymmetric: u64,
    /// Cases whose answer, clipped again, changes: one of its points, or nothing is
    /// left. In inward tiers only answers of which both ends are flagged inward.
    pub non_idempotent: u64,
    /// Cases that the floating-point filter did not settle; 0 in plain tiers.
    pub filter_failures: u64,
    /// Cases that needed expansions or integers; 0 in plain tiers.
    pub exact_stage: u64,
}

impl SurveyRow {
    /// Whether the row is as an exact tier promises: nothing wrong, refused or
    /// asymmetric, and all points within the accuracy's bound (G3: `Fast` 8 u times
    /// scale, `Nearest` half an ulp, `Inward` 2 ulp). With `Inward`, no end may be outside or
    /// change when it is clipped again, except ends flagged as not inward, which are only nearest.
    pub fn is_right(&self) -> bool {
        use SurveyTier as Tier;
        let wrong = self.wrong_class + self.wrong_faces + self.refused + self.asymmetric;
        let bound = match self.tier {
            Tier::ExactNearest | Tier::ExactNearestF32 => self.error_ulp.max <= 0.5,
            Tier::ExactInward | Tier::ExactInwardF32 => {
                self.error_ulp.max <= 2.0 && self.outside + self.non_idempotent == 0
            }
            _ => self.error_u_scale.max <= 8.0,
        };
        wrong == 0 && bound
    }
}

/// The way in which an input is the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SurveyWorst {
    /// Refused, panicked, or not finite; the first such case.
    Refused,
    /// A wrong class; the first such case.
    Class,
    /// A wrong face set or flag; the first such case.
    Faces,
    /// The largest error in ulp.
    ErrorUlp,
    /// The largest error in u times scale.
    ErrorScale,
}

impl SurveyWorst {
    /// All of them.
    pub const ALL: [SurveyWorst; 5] = [
        SurveyWorst::Refused,
        SurveyWorst::Class,
        SurveyWorst::Faces,
        SurveyWorst::ErrorUlp,
        SurveyWorst::ErrorScale,
    ];

    /// The name, as in `report.json`.
    pub const fn name(self) -> &'static str {
        ["refused", "class", "faces", "error-ulp", "error-u-scale"][self as usize]
    }
}

/// An input that was the worst for a row.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyWitness {
    /// The row's algorithm.
    pub algorithm: SurveyAlgorithm,
    /// The row's tier.
    pub tier: SurveyTier,
    /// The row's family.
    pub family: Family,
    /// The way in which it is the worst.
    pub worst: SurveyWorst,
    /// The error, or how many such cases the row has.
    pub value: f64,
    /// The case's index in its family.
    pub case: u64,
    /// The input as a line that `frusta replay` takes.
    pub line: String,
}

/// All findings of a survey.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// The seed of all cases.
    pub seed: u64,
    /// The number of cases of each family.
    pub cases: u64,
    /// The number of timed rounds.
    pub rounds: u32,
    /// Families in order, in each the algorithms, in each the tiers; `f32` tiers
    /// only where the family has `f32`.
    pub rows: Vec<SurveyRow>,
    /// For each row the worst inputs, where there are any.
    pub witnesses: Vec<SurveyWitness>,
}

impl Survey {
    /// Whether every row of an exact tier [is right](SurveyRow::is_right).
    pub fn exact_is_right(&self) -> bool {
        let mut exact = self.rows.iter().filter(|row| row.tier.is_exact());
        exact.all(SurveyRow::is_right)
    }

    /// A row, if it was surveyed.
    pub fn row(
        &self,
        algorithm: SurveyAlgorithm,
        tier: SurveyTier,
        family: Family,
    ) -> Option<&SurveyRow> {
        let names = (algorithm, tier, family);
        self.rows
            .iter()
            .find(|row| (row.algorithm, row.tier, row.family) == names)
    }
}

/// An unknown name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    what: &'static str,
    name: String,
    known: Vec<&'static str>,
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, name, known } = self;
        write!(f, "no {what} {name:?}; there are {}", known.join(", "))
    }
}

impl std::error::Error for UnknownName {}

macro_rules! from_name {
    ($($t:ident $what:literal),*) => {$(
        impl FromStr for $t {
            type Err = UnknownName;

            fn from_str(name: &str) -> Result<Self, UnknownName> {
                let found = $t::ALL.into_iter().find(|t| t.name() == name);
                found.ok_or_else(|| UnknownName {
                    what: $what,
                    name: name.to_owned(),
                    known: $t::ALL.iter().map(|t| t.name()).collect(),
                })
            }
        }
    )*};
}

from_name!(SurveyTier "tier", SurveyAlgorithm "algorithm");
