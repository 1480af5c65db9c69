//! The file: `README.md` documents its keys.

use crate::boxes::{REFERENCE_BOX, REFERENCE_BOXES, REFERENCE_SLICE};
use crate::contest::{Contest, Effort, Outcome};
use crate::facts::Fact;
use crate::machine::Machine;
use crate::versions::version;
use frusta_lab::turns::geometric_mean;
use serde::Serialize;

/// Everything that a run found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The schema of this file.
    pub schema: &'static str,
    /// The machine that the times are from.
    pub machine: Machine,
    /// The seed of random input.
    pub seed: u64,
    /// Rounds that were timed.
    pub rounds: usize,
    /// A row for each contestant in each contest.
    pub rows: Vec<Row>,
    /// Single inputs that end badly.
    pub facts: Vec<Fact>,
    /// Ratios of means over the mixes.
    pub headlines: Vec<Headline>,
    /// What is unfair about this comparison.
    pub bias: &'static str,
}

/// What one contestant did in one contest.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The job.
    pub job: &'static str,
    /// The crate.
    pub library: &'static str,
    /// Its version, from `Cargo.lock`.
    pub version: &'static str,
    /// The function that was called.
    pub function: &'static str,
    /// The scalar type.
    pub scalar: &'static str,
    /// The input.
    pub input: String,
    /// How many answers were judged; null if none.
    pub cases: Option<u64>,
    /// Median nanoseconds a case; null if there is nothing to time.
    pub ns_median: Option<f64>,
    /// The time as a multiple of that of exact-class V/W in `f64`, median over rounds; for boxes,
    /// of that of `Culler::classify` in `f32`.
    pub time_ratio: Option<f64>,
    /// Its lower and upper quartile over rounds.
    pub time_ratio_quartiles: Option<[f64; 2]>,
    /// The same of exact-class V/W in `f32`; null for boxes.
    pub time_ratio_f32: Option<f64>,
    /// The same of exact-class V/W in `f64` over slices; for boxes, of `Culler::over(..).visible(..)` of
    /// a set.
    pub time_ratio_slices: Option<f64>,
    /// The same of exact-class V/W in `f32` over slices; null for boxes.
    pub time_ratio_slices_f32: Option<f64>,
    /// For boxes, the same of `Culler::over(..).visible(..)` of a plain slice; null for other jobs.
    pub time_ratio_boxes: Option<f64>,
    /// Wrong answers: phantom, missed, misplaced and refused.
    pub wrong: Option<u64>,
    /// Hits where there is nothing.
    pub phantom: Option<u64>,
    /// Nothing where there is a hit.
    pub missed: Option<u64>,
    /// Hits, rightly, with an end that is outside, exactly.
    pub outside: Option<u64>,
    /// Hits, rightly, with an end in a wrong place.
    pub misplaced: Option<u64>,
    /// Errors and numbers that are not finite.
    pub refused: Option<u64>,
    /// The largest error of an end, in unit roundoffs of the largest coordinate; null where
    /// no end was computed.
    pub max_error_u_scale: Option<f64>,
    /// What a reader must know about it.
    pub note: &'static str,
}

/// A ratio of times over several inputs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Headline {
    /// Which ratio.
    pub what: String,
    /// The geometric mean over the mixes.
    pub ratio: f64,
    /// The least over the mixes.
    pub least: f64,
}

/// The schema's name.
pub const SCHEMA: &str = "frusta-peers/1";

/// Our bias, in words.
pub const BIAS: &str = "We wrote frusta, and we chose the jobs, the inputs and what right means: \
closed sets, touching included, decided exactly. None of the peers promises that. parry clips by \
axis-aligned boxes, for physics; retrofire clips what it draws, in f32 clip space; line-clipping \
draws in terminals; plane-split orders quads for a compositor; the cullers are meant to say yes \
too often. The half-integer lattice is where plain arithmetic fails most, which is why it is \
there, beside mixes where it hardly fails. Everybody is called for one case at a time (retrofire \
and frusta also for slices, which parry and line-clipping do not offer), with planes, matrices and types prepared; peers that work in f32 get frusta's \
f32 beside its f64. The tests of boxes are timed in a loop that makes a list, too, beside \
frusta's lists. Most clipped ends of everybody are outside by a rounding: that is counted, \
and not called wrong.";

impl Row {
    /// Of a contestant.
    pub fn new(contest: &dyn Contest, outcome: &Outcome) -> Self {
        let Outcome { who, tally, time } = outcome;
        let is_computed = |error: &f64| *error > 0.0;
        let median = |reference: usize| time.ratios[reference].map(|spread| spread.median);
        Self {
            job: contest.job(),
            library: who.library,
            version: version(who.library).unwrap_or_default(),
            function: who.function,
            scalar: who.scalar,
            input: contest.input().to_owned(),
            cases: tally.map(|t| t.cases),
            ns_median: Some(time.nanoseconds),
            time_ratio: median(0),
            time_ratio_quartiles: time.ratios[0].map(|spread| [spread.lower, spread.upper]),
            time_ratio_f32: median(1),
            time_ratio_slices: median(2),
            time_ratio_slices_f32: median(3),
            time_ratio_boxes: median(4),
            wrong: tally.map(|t| t.wrong()),
            phantom: tally.map(|t| t.phantom),
            missed: tally.map(|t| t.missed),
            outside: tally.map(|t| t.outside),
            misplaced: tally.map(|t| t.misplaced),
            refused: tally.map(|t| t.refused),
            max_error_u_scale: tally.map(|t| t.max_error).filter(is_computed),
            note: who.note,
        }
    }

    /// Of frusta, where it cannot do the job yet.
    pub fn not_built(contest: &dyn Contest) -> Self {
        Self {
            job: contest.job(),
            library: "frusta",
            version: version("frusta").unwrap_or_default(),
            function: "not built yet",
            scalar: "",
            input: contest.input().to_owned(),
            cases: None,
            ns_median: None,
            time_ratio: None,
            time_ratio_quartiles: None,
            time_ratio_f32: None,
            time_ratio_slices: None,
            time_ratio_slices_f32: None,
            time_ratio_boxes: None,
            wrong: None,
            phantom: None,
            missed: None,
            outside: None,
            misplaced: None,
            refused: None,
            max_error_u_scale: None,
            note: "ours: not built yet",
        }
    }

    /// Broken promises of frusta: wrong answers of the exact tier, and misses of the conservative
    /// test of boxes.
    pub fn broken_promises(&self) -> u64 {
        let is_exact = self.function.contains("exact") || self.job == "cull-point";
        match (self.library, self.job) {
            ("frusta", _) if is_exact => self.wrong.unwrap_or(0),
            ("frusta", "cull-box") => self.missed.unwrap_or(0) + self.refused.unwrap_or(0),
            _ => 0,
        }
    }
}

/// A job, a function and its library, whose times are reported as means.
type Reported = (&'static str, &'static str, &'static str);

/// The first two are the most usual questions.
const REPORTED: [Reported; 19] = {
    let cull = "cull-box";
    let (boxes, window, frustum) = ("segment-box", "segment-window", "segment-frustum");
    let (clip, bounds) = ("Aabb::clip_segment", "clip_segment, bounding box");
    let retrofire = "retrofire-core";
    [
        (boxes, clip, "parry3d-f64"),
        (frustum, "transform + clip", retrofire),
        (frustum, "transform + clip, slices", retrofire),
        (frustum, "transform + clip, positions", retrofire),
        (boxes, clip, "parry3d"),
        (frustum, bounds, "parry3d-f64"),
        (frustum, bounds, "parry3d"),
        (window, "cohen_sutherland::clip_line", "line-clipping"),
        (cull, "overlaps_box", "packed_spatial_index"),
        (cull, "BVol::test_against_plane, six", "treeculler"),
        (cull, "BVol::test_against_frustum", "treeculler"),
        (cull, "HalfSpace, in bevy_camera's loop", "bevy_shape"),
        (cull, "Culler::classify_exact", "frusta"),
        (cull, "overlaps_box, list", "packed_spatial_index"),
        (cull, "BVol::test_against_plane, six, list", "treeculler"),
        (cull, "BVol::test_against_frustum, list", "treeculler"),
        (cull, "HalfSpace, in bevy_camera's loop, list", "bevy_shape"),
        (cull, "Culler::classify, list", "frusta"),
        (cull, "Culler::classify_exact, list", "frusta"),
    ]
};

/// A row's ratio of times.
type Ratio = fn(&Row) -> Option<f64>;

/// What times are compared with: exact-class V/W in four ways; for boxes, three of frusta's
/// functions.
const OURS: [(&str, Ratio); 5] = [
    ("f64", |row| row.time_ratio),
    ("f64, slices", |row| row.time_ratio_slices),
    ("f32", |row| row.time_ratio_f32),
    ("f32, slices", |row| row.time_ratio_slices_f32),
    (REFERENCE_SLICE, |row| row.time_ratio_boxes),
];

/// What the times of boxes are compared with; `None` where one call a box would be compared with
/// a list.
fn boxes(ours: &str, function: &str) -> Option<&'static str> {
    match (ours, function.ends_with(", list")) {
        ("f64", false) => Some(REFERENCE_BOX),
        ("f64, slices", true) => Some(REFERENCE_BOXES),
        (REFERENCE_SLICE, true) => Some(REFERENCE_SLICE),
        _ => None,
    }
}

/// The peers' times over ours, for segments exact-class V/W's, in means over the mixes.
pub fn headlines(rows: &[Row]) -> Vec<Headline> {
    let is_mix = |row: &&Row| !matches!(&row.input[..], "half-lattice" | "uniform");
    let mut all = Vec::new();
    for reported in REPORTED {
        let is_it = |row: &&Row| (row.job, row.function, row.library) == reported;
        let (job, function, library) = reported;
        for (ours, ratio) in OURS {
            let found = rows.iter().filter(is_it).filter(is_mix);
            let ratios: Vec<f64> = found.filter_map(ratio).collect();
            let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
            let Some(ratio) = geometric_mean(ratios) else {
                continue;
            };
            let reference = match job {
                "cull-box" => boxes(ours, function).map(str::to_owned),
                _ => Some(format!("exact V/W {ours}")),
            };
            all.extend(reference.map(|reference| Headline {
                what: format!("{job}: {library} {function} / {reference}"),
                ratio,
                least,
            }));
        }
    }
    all
}

impl Report {
    /// From what was found.
    pub fn new(effort: &Effort, rows: Vec<Row>, facts: Vec<Fact>) -> Self {
        let headlines = headlines(&rows);
        Self {
            schema: SCHEMA,
            machine: Machine::this(),
            seed: effort.seed,
            rounds: effort.rounds,
            rows,
            facts,
            headlines,
            bias: BIAS,
        }
    }
}
