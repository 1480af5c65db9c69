//! The worst cases that are drawn.

use frusta_lab::{Survey, SurveyTier, SurveyWitness, SurveyWorst};

/// How many of each kind are drawn, plain tiers first.
const PLAIN: [(SurveyWorst, usize); 5] = [
    (SurveyWorst::Class, 4),
    (SurveyWorst::Refused, 2),
    (SurveyWorst::Faces, 2),
    (SurveyWorst::ErrorScale, 2),
    (SurveyWorst::ErrorUlp, 1),
];

/// Exact tiers have errors only; anything else would be a bug.
const EXACT: [(SurveyWorst, usize); 5] = [
    (SurveyWorst::Class, 2),
    (SurveyWorst::Refused, 2),
    (SurveyWorst::Faces, 2),
    (SurveyWorst::ErrorScale, 1),
    (SurveyWorst::ErrorUlp, 0),
];

/// The worst of each kind, of different families as far as there are: of what is
/// counted, the first cases where most went wrong.
pub(super) fn choose(survey: &Survey) -> Vec<&SurveyWitness> {
    let mut chosen: Vec<&SurveyWitness> = Vec::new();
    let kinds = PLAIN.map(|kind| (false, kind)).into_iter();
    for (exact, (worst, most)) in kinds.chain(EXACT.map(|kind| (true, kind))) {
        let mut of_kind: Vec<&SurveyWitness> = survey
            .witnesses
            .iter()
            // f32 adds nothing where f64 is wrong, too.
            .filter(|w| w.worst == worst && w.tier.is_exact() == exact)
            .filter(|w| exact || w.tier == SurveyTier::PlainF64)
            .collect();
        of_kind.sort_by(|a, b| b.value.total_cmp(&a.value));
        let before = chosen.len();
        for witness in of_kind {
            let known = |w: &&SurveyWitness| w.family == witness.family || w.line == witness.line;
            if chosen.len() - before < most && !chosen.iter().any(known) {
                chosen.push(witness);
            }
        }
    }
    chosen
}

/// What is wrong with a case, in words.
pub(super) fn describe(witness: &SurveyWitness) -> String {
    let value = witness.value;
    let number = super::words::figure(value);
    match witness.worst {
        SurveyWorst::Class => format!("the first of {value} wrong classes"),
        SurveyWorst::Refused => format!("the first of {value} cases without an answer"),
        SurveyWorst::Faces => format!("the first of {value} wrong face sets"),
        SurveyWorst::ErrorUlp => format!("the largest error: {number} ulp"),
        SurveyWorst::ErrorScale => format!("the largest error: {number} u·scale"),
    }
}
