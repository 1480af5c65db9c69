//! A report as data: `report.json` and the CSV files.
//!
//! `docs/report.md` documents the keys. They are stable within a schema; a test compares the two.

use super::machine::Machine;
use super::omitted::Omission;
use super::{Measured, Page, answer};
use frusta::math::hex::Hex;
use frusta_lab::{
    Everyday, FalseAccepts, PaperFailure, PaperRow, PaperTable, SurveyRow, SurveyWitness,
    VolumeKind, VolumeSurvey, VolumeTally, VolumeTime,
};
use serde::Serialize;
use serde_json::{Value, json};

/// Changes when a key is removed or changes its meaning.
const SCHEMA: &str = "frusta-report/1";

/// All of `report.json`.
#[derive(Debug, Serialize)]
pub(crate) struct Report<'a> {
    schema: &'static str,
    frusta: &'static str,
    command: &'a str,
    machine: &'a Machine,
    seconds: f64,
    seed: u64,
    cases: u64,
    rounds: u32,
    answer: [String; 3],
    pub(crate) rows: Vec<Row>,
    pub(crate) witnesses: Vec<Witness<'a>>,
    everyday: Vec<EverydayRow>,
    volumes: Vec<Value>,
    false_accepts: Vec<Value>,
    volume_times: Vec<Value>,
    paper: Vec<Value>,
    peers: Option<&'a Value>,
    omitted: &'a [Omission],
}

impl<'a> Report<'a> {
    pub(crate) fn new(page: &Page<'a>) -> Self {
        let Measured {
            survey,
            everyday,
            volumes,
            paper,
        } = page.measured;
        Self {
            schema: SCHEMA,
            frusta: env!("CARGO_PKG_VERSION"),
            command: page.command,
            machine: page.machine,
            seconds: page.seconds,
            seed: survey.seed,
            cases: survey.cases,
            rounds: survey.rounds,
            answer: answer::sentences(page.measured),
            rows: survey.rows.iter().map(Row::new).collect(),
            witnesses: survey.witnesses.iter().map(Witness::new).collect(),
            everyday: self::everyday(everyday),
            volumes: volumes.errors.iter().map(volume).collect(),
            false_accepts: volumes.accepts.iter().map(false_accept).collect(),
            volume_times: volumes
                .times
                .iter()
                .map(|row| volume_time(volumes, row))
                .collect(),
            paper: self::paper(paper),
            peers: page.peers,
            omitted: page.omitted,
        }
    }

    /// The text of `report.json`.
    pub(crate) fn to_json(&self) -> String {
        // Keys are strings and all numbers are finite, so this cannot fail.
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        text + "\n"
    }
}

/// One algorithm in one tier on one family.
#[derive(Debug, Serialize)]
pub(crate) struct Row {
    algorithm: &'static str,
    tier: &'static str,
    family: &'static str,
    cases: u64,
    wrong_class: u64,
    wrong_faces: u64,
    refused: u64,
    ns_median: f64,
    time_ratio: f64,
    time_ratio_lower: f64,
    time_ratio_upper: f64,
    max_error_ulp: f64,
    p999_error_ulp: f64,
    max_error_u_scale: f64,
    p999_error_u_scale: f64,
    outside: u64,
    asymmetric: u64,
    non_idempotent: u64,
    filter_failures: u64,
    exact_stage: u64,
}

impl Row {
    fn new(row: &SurveyRow) -> Self {
        Self {
            algorithm: row.algorithm.name(),
            tier: row.tier.name(),
            family: row.family.name(),
            cases: row.cases,
            wrong_class: row.wrong_class,
            wrong_faces: row.wrong_faces,
            refused: row.refused,
            ns_median: row.ns_median,
            time_ratio: row.time_ratio.median,
            time_ratio_lower: row.time_ratio.lower,
            time_ratio_upper: row.time_ratio.upper,
            max_error_ulp: row.error_ulp.max,
            p999_error_ulp: row.error_ulp.p999,
            max_error_u_scale: row.error_u_scale.max,
            p999_error_u_scale: row.error_u_scale.p999,
            outside: row.outside,
            asymmetric: row.asymmetric,
            non_idempotent: row.non_idempotent,
            filter_failures: row.filter_failures,
            exact_stage: row.exact_stage,
        }
    }
}

/// A worst input of a row.
#[derive(Debug, Serialize)]
pub(crate) struct Witness<'a> {
    pub(crate) algorithm: &'static str,
    pub(crate) tier: &'static str,
    pub(crate) family: &'static str,
    pub(crate) worst: &'static str,
    pub(crate) value: f64,
    pub(crate) case: u64,
    pub(crate) line: &'a str,
}

impl<'a> Witness<'a> {
    fn new(witness: &'a SurveyWitness) -> Self {
        Self {
            algorithm: witness.algorithm.name(),
            tier: witness.tier.name(),
            family: witness.family.name(),
            worst: witness.worst.name(),
            value: witness.value,
            case: witness.case,
            line: &witness.line,
        }
    }
}

/// A clipper on a mix of everyday segments.
#[derive(Debug, Serialize)]
struct EverydayRow {
    mix: &'static str,
    place: &'static str,
    algorithm: &'static str,
    tier: &'static str,
    slices: bool,
    segments: usize,
    rounds: u32,
    ns_median: f64,
    time_ratio: f64,
    time_ratio_lower: f64,
    time_ratio_upper: f64,
    wrong: usize,
}

fn everyday(everyday: &Everyday) -> Vec<EverydayRow> {
    let rows = everyday.rows.iter();
    rows.map(|row| EverydayRow {
        mix: row.mix.name(),
        place: row.place,
        algorithm: row.algorithm,
        tier: row.tier.name(),
        slices: row.slices,
        segments: everyday.segments,
        rounds: everyday.rounds,
        ns_median: row.timing.nanoseconds,
        time_ratio: row.timing.ratio.median,
        time_ratio_lower: row.timing.ratio.lower,
        time_ratio_upper: row.timing.ratio.upper,
        wrong: row.wrong,
    })
    .collect()
}

/// A kind of volume in all families.
fn volume((kind, tally): &(VolumeKind, VolumeTally)) -> Value {
    json!({
        "kind": kind.name(),
        "cases": tally.cases,
        "wrong_class": tally.wrong,
        "wrongly_outside": tally.wrongly_outside,
        "wrong_in_batch": tally.wrong_in_batch,
        "wrong_exact": tally.wrong_exact,
        "false_accepts": tally.counts.false_accepts,
    })
}

/// Boxes of a size before a view.
fn false_accept(row: &FalseAccepts) -> Value {
    json!({
        "half_extent": row.size,
        "field_of_view": row.field_of_view,
        "boxes": row.boxes,
        "accepted": row.accepted,
        "falsely": row.falsely,
        "share": row.share(),
    })
}

fn volume_time(volumes: &VolumeSurvey, row: &VolumeTime) -> Value {
    json!({
        "job": row.job,
        "function": row.function,
        "scalar": "f32",
        "timed": volumes.timed,
        "rounds": volumes.rounds,
        "ns_median": row.timing.nanoseconds,
        "time_ratio": row.timing.ratio.median,
        "time_ratio_lower": row.timing.ratio.lower,
        "time_ratio_upper": row.timing.ratio.upper,
    })
}

/// The paper's table: a row for each algorithm, tier and scalar type, then one for each sample that
/// one of them got wrong.
fn paper(table: &PaperTable) -> Vec<Value> {
    let clippers = table.rows.iter().map(|row| clipper(table, row));
    let failures = table.rows.iter().flat_map(|row| {
        let failure = |found| failure(row, found);
        row.failures.iter().map(failure)
    });
    clippers.chain(failures).collect()
}

/// A flat row.
fn clipper(table: &PaperTable, row: &PaperRow) -> Value {
    let mut object = json!({
        "row": "clipper",
        "algorithm": row.algorithm,
        "tier": row.tier.name(),
        "scalar": row.scalar,
        "repeats": table.repeats,
        "rounds": table.rounds,
        "paper_ratio": row.paper,
        "ratio_in_order": row.in_order.ratio.median,
        "ratio_in_order_lower": row.in_order.ratio.lower,
        "ratio_in_order_upper": row.in_order.ratio.upper,
        "ratio_shuffled": row.shuffled.ratio.median,
        "ratio_shuffled_lower": row.shuffled.ratio.lower,
        "ratio_shuffled_upper": row.shuffled.ratio.upper,
        "ns_in_order": row.in_order.nanoseconds,
        "ns_shuffled": row.shuffled.nanoseconds,
        "steady": row.steady,
    });
    let places = ["standard", "stretched", "turned", "rotated"];
    for (place, score) in places.into_iter().zip(row.scores()) {
        for (name, value) in [
            ("samples", json!(score.samples)),
            ("right_classes", json!(score.right_classes)),
            ("right_sets", json!(score.right_sets)),
            ("max_error_roundoffs", json!(score.max_error)),
            ("max_error_ulp", json!(score.max_error_ulps)),
        ] {
            object[format!("{place}_{name}")] = value;
        }
    }
    object
}

fn failure(row: &PaperRow, failure: &PaperFailure) -> Value {
    json!({
        "row": "failure",
        "algorithm": row.algorithm,
        "tier": row.tier.name(),
        "scalar": row.scalar,
        "sample": failure.sample,
        "count": failure.count,
        "segment": Hex(failure.segment).to_string(),
        "said": failure.said.to_string(),
        "true": failure.truth.to_string(),
    })
}
