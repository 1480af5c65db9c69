//! What a report leaves out, and why.

use frusta::samples::Family;
use frusta_lab::Survey;
use serde::Serialize;

/// Something that was not measured.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Omission {
    /// What it is.
    pub(crate) what: String,
    /// Why it is not there.
    pub(crate) why: String,
}

impl Omission {
    fn new(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            why: why.into(),
        }
    }
}

/// What a survey, and a report of it, lacks.
pub(crate) fn omissions(survey: &Survey, has_peers: bool) -> Vec<Omission> {
    let surveyed = |family: &Family| survey.rows.iter().any(|row| row.family == *family);
    let names = |families: Vec<Family>| -> String {
        let names: Vec<&str> = families.iter().map(|f| f.name()).collect();
        names.join(", ")
    };
    let (there, missing): (Vec<Family>, Vec<Family>) =
        Family::ALL.iter().copied().partition(surveyed);
    let doubles: Vec<Family> = there.into_iter().filter(|f| !f.has_f32()).collect();
    let mut omitted = Vec::new();
    if !missing.is_empty() {
        omitted.push(Omission::new(
            format!("the families {}", names(missing)),
            "this run was asked for others only",
        ));
    }
    if !doubles.is_empty() {
        omitted.push(Omission::new(
            format!("f32 in the families {}", names(doubles)),
            "their numbers are beyond the range of f32, or what is singular about them does not \
             survive the rounding",
        ));
    }
    omitted.push(Omission::new(
        "f32 with fused multiply-add",
        "it would show what f64 shows already",
    ));
    omitted.push(Omission::new(
        "hard cases over slices",
        "families are timed one segment a call; slices, on everyday segments",
    ));
    if !has_peers {
        omitted.push(Omission::new(
            "other libraries",
            "no file of theirs was given (--peers)",
        ));
    }
    omitted
}
