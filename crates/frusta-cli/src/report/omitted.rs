//! What was not measured, and why.

use frusta::samples::Family;
use frusta_lab::Survey;
use serde::Serialize;

/// Something that was not measured.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Omission {
    /// What it is.
    pub(crate) what: String,
    /// Why it was not measured.
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

/// Everything that this report does not measure.
pub(crate) fn omissions(survey: &Survey, has_peers: bool) -> Vec<Omission> {
    let surveyed = |family: &Family| survey.rows.iter().any(|row| row.family == *family);
    let names = |families: Vec<Family>| -> String {
        let names: Vec<&str> = families.iter().map(|f| f.name()).collect();
        names.join(", ")
    };
    let (present, missing): (Vec<Family>, Vec<Family>) =
        Family::ALL.iter().copied().partition(surveyed);
    let only_f64: Vec<Family> = present.into_iter().filter(|f| !f.has_f32()).collect();
    let mut omitted = Vec::new();
    if !missing.is_empty() {
        omitted.push(Omission::new(
            format!("the families {}", names(missing)),
            "this run was restricted to others",
        ));
    }
    if !only_f64.is_empty() {
        omitted.push(Omission::new(
            format!("f32 in the families {}", names(only_f64)),
            "their coordinates are beyond the range of f32, or rounding to f32 removes their singularity",
        ));
    }
    omitted.push(Omission::new(
        "hard cases over slices",
        "families are timed with one segment a call, slices on everyday segments",
    ));
    if !has_peers {
        omitted.push(Omission::new(
            "other libraries",
            "no file of their results was given (--peers)",
        ));
    }
    omitted
}
