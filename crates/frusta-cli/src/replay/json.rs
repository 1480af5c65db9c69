//! The same as [`super::text`], for programs: one flat object an answer.

use super::answers::{Answer, Replay};
use super::decimal::decimal;
use frusta::FaceSet;
use frusta::oracle::OracleEnd;
use serde_json::{Value, json};

/// A case: its line, the truth, its answers.
pub(super) fn case(number: usize, title: &str, replay: &Replay) -> Value {
    let part = replay.truth.part.as_ref();
    let ends = part.map(|p| [&p.entry, &p.exit]);
    let each = |of: fn(&OracleEnd) -> Value| ends.map(|ends| Value::from(ends.map(of).to_vec()));
    json!({
        "case": number,
        "title": title,
        "line": replay.case.to_string(),
        "class": replay.truth.class.name(),
        "t": each(|end| decimal(&end.t, 20).into()),
        "points": each(|end| end.point.iter().map(|c| decimal(c, 20)).collect()),
        "clipped": each(|end| end.clipped.into()),
        "faces": each(|end| names(end.faces)),
        "coplanar": part.map(|p| names(p.coplanar)),
        "stages": replay.own().map(|own| own.verdict.stages),
        "answers": replay.answers.iter().map(answer).collect::<Value>(),
    })
}

fn names(set: FaceSet) -> Value {
    set.iter().map(|face| face.name()).collect()
}

fn answer(answer: &Answer) -> Value {
    let v = &answer.verdict;
    json!({
        "algorithm": answer.algorithm.name(),
        "tier": answer.tier.name(),
        "right_class": v.class,
        "right_faces": v.faces,
        "refused": v.refusal,
        "answer": v.clip,
        "error_ulp": v.errors.map(|ends| ends.map(|e| e.ulp)),
        "error_u_scale": v.errors.map(|ends| ends.map(|e| e.u_scale)),
        "outside": v.outside,
        "symmetric": v.symmetric,
        "idempotent": v.idempotent,
        "violations": v.violations,
        "stages": v.stages,
    })
}
