//! Sums over families.

use frusta_lab::{Spread, Survey, SurveyAlgorithm, SurveyRow, SurveyTier};

/// Some rows, added.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Total {
    pub(super) cases: u64,
    pub(super) wrong_class: u64,
    pub(super) wrong_faces: u64,
    pub(super) refused: u64,
    pub(super) outside: u64,
    pub(super) asymmetric: u64,
    pub(super) non_idempotent: u64,
    pub(super) filter_failures: u64,
    pub(super) exact_stage: u64,
    pub(super) max_u_scale: f64,
    /// The geometric mean over the rows; `None` if nothing was timed.
    pub(super) time_ratio: Option<Spread>,
}

impl Total {
    /// The sum of the rows that satisfy a condition.
    pub(super) fn of(survey: &Survey, which: impl Fn(&SurveyRow) -> bool) -> Self {
        let rows: Vec<&SurveyRow> = survey.rows.iter().filter(|row| which(row)).collect();
        let sum = |of: fn(&SurveyRow) -> u64| rows.iter().map(|row| of(row)).sum();
        let largest =
            |of: fn(&SurveyRow) -> f64| rows.iter().map(|row| of(row)).fold(0.0, f64::max);
        Self {
            cases: sum(|row| row.cases),
            wrong_class: sum(|row| row.wrong_class),
            wrong_faces: sum(|row| row.wrong_faces),
            refused: sum(|row| row.refused),
            outside: sum(|row| row.outside),
            asymmetric: sum(|row| row.asymmetric),
            non_idempotent: sum(|row| row.non_idempotent),
            filter_failures: sum(|row| row.filter_failures),
            exact_stage: sum(|row| row.exact_stage),
            max_u_scale: largest(|row| row.error_u_scale.max),
            time_ratio: Spread::geometric_mean(rows.iter().map(|row| row.time_ratio)),
        }
    }

    /// An algorithm in a tier, over all families.
    pub(super) fn of_clipper(
        survey: &Survey,
        algorithm: SurveyAlgorithm,
        tier: SurveyTier,
    ) -> Self {
        Self::of(survey, |row| row.algorithm == algorithm && row.tier == tier)
    }

    /// Wrong answers: class, faces, or no answer.
    pub(super) fn wrong(&self) -> u64 {
        self.wrong_class + self.wrong_faces + self.refused
    }

    /// A count's share of the cases.
    pub(super) fn share(&self, count: u64) -> f64 {
        count as f64 / self.cases.max(1) as f64
    }
}
