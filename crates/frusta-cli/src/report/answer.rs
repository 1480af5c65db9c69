//! The answer in three sentences: how often who is wrong, and what being right costs.
//!
//! Noisy ratios (see [`Spread::is_noisy`]) take no part.

use super::Measured;
use super::page::words::{count, figure, percent};
use frusta_lab::{Everyday, Spread, Survey, SurveyAlgorithm, SurveyRow, SurveyTier, Tier};

/// The three sentences.
pub(crate) fn sentences(measured: &Measured) -> [String; 3] {
    [
        wrong_answers(&measured.survey),
        everyday(&measured.everyday),
        hard_cases(&measured.survey),
    ]
}

/// Wrong answers among these rows, and how many answers there are.
fn wrong<'a>(rows: impl Iterator<Item = &'a SurveyRow>) -> (u64, u64) {
    rows.fold((0, 0), |(wrong, cases), row| {
        let own = row.wrong_class + row.wrong_faces + row.refused;
        (wrong + own, cases + row.cases)
    })
}

fn wrong_answers(survey: &Survey) -> String {
    let exact = survey.rows.iter().filter(|row| row.tier.is_exact());
    let (wrong_exact, cases) = wrong(exact);
    let families = survey.rows.chunk_by(|a, b| a.family == b.family).count();
    let mut text = format!(
        "Exact clipping gave {} wrong answers of {}, on {families} families of hard cases",
        count(wrong_exact),
        count(cases)
    );
    let plain = [SurveyTier::PlainF64, SurveyTier::PlainF32]
        .into_iter()
        .flat_map(|tier| SurveyAlgorithm::ALL.map(|algorithm| (algorithm, tier)));
    let worst = plain
        .map(|(algorithm, tier)| {
            let is_it = |row: &&SurveyRow| (row.algorithm, row.tier) == (algorithm, tier);
            (wrong(survey.rows.iter().filter(is_it)), algorithm, tier)
        })
        .filter(|((_, cases), ..)| *cases > 0)
        .max_by(|((a, m), ..), ((b, n), ..)| (a * n).cmp(&(b * m)));
    if let Some(((wrong, cases), algorithm, tier)) = worst {
        let share = percent(wrong as f64 / cases as f64);
        let scalar = if tier.is_single() { "f32" } else { "f64" };
        text += &format!(
            "; plain arithmetic gave up to {} wrong of {} ({share}; worst: {algorithm} in {scalar})",
            count(wrong),
            count(cases)
        );
    }
    text + "."
}

fn everyday(everyday: &Everyday) -> String {
    let ratio = |slices| {
        let rows = everyday.rows.iter();
        let rows = rows.filter(|r| (r.algorithm, r.tier, r.slices) == ("vw", Tier::Exact, slices));
        mean(rows.map(|row| row.timing.ratio))
    };
    match (ratio(false), ratio(true)) {
        (Some(single), Some(slices)) => format!(
            "On everyday segments exact V/W takes {} the time of textbook Liang-Barsky in plain \
             f64 with one call a segment, and {} over slices.",
            single.times(),
            slices.times()
        ),
        (Some(single), None) => format!(
            "On everyday segments exact V/W takes {} the time of textbook Liang-Barsky in plain \
             f64; the times over slices are too noisy to be stated.",
            single.times()
        ),
        _ => NOISY.replace("{}", "everyday segments"),
    }
}

/// Stands in for a sentence without ratios.
const NOISY: &str = "The run times on {} were not taken, or are too noisy to be stated: see the \
                     tables, and run it again on a quieter machine or with more --rounds.";

fn hard_cases(survey: &Survey) -> String {
    let rows = |tier: SurveyTier| {
        let is_it =
            move |row: &&SurveyRow| row.algorithm == SurveyAlgorithm::Vw && row.tier == tier;
        survey.rows.iter().filter(is_it)
    };
    let Some(exact) = mean(rows(SurveyTier::ExactFast).map(|row| row.time_ratio)) else {
        return NOISY.replace("{}", "the hard families");
    };
    let mut text = format!(
        "On the hard families, where at least half of the cases are next to singular, exact V/W takes \
         {} the time of textbook Liang-Barsky",
        exact.times()
    );
    let both = rows(SurveyTier::ExactFast).zip(rows(SurveyTier::PlainF64));
    let pairs = both.map(|(a, b)| [a.time_ratio, b.time_ratio]);
    let quiet = pairs.filter(|pair| !pair.iter().any(Spread::is_noisy));
    let ratios = quiet.map(|[exact, plain]| Spread::new(vec![exact.median / plain.median]));
    if let Some(price) = mean(ratios) {
        text += &format!(
            ", {} times that of the same algorithm in plain arithmetic",
            figure(price.spread.median)
        );
    }
    text + "."
}

/// A mean of ratios.
struct Mean {
    spread: Spread,
    /// How many ratios were left out because they are noisy, and how many there were.
    noisy: [usize; 2],
}

/// The geometric mean of the ratios that are not noisy.
fn mean(ratios: impl Iterator<Item = Spread>) -> Option<Mean> {
    let all: Vec<Spread> = ratios.collect();
    let quiet: Vec<Spread> = all.iter().filter(|r| !r.is_noisy()).copied().collect();
    let noisy = [all.len() - quiet.len(), all.len()];
    let spread = Spread::geometric_mean(quiet)?;
    Some(Mean { spread, noisy })
}

impl Mean {
    /// In words, with quartiles.
    fn times(&self) -> String {
        let Spread {
            lower,
            median,
            upper,
        } = self.spread;
        let [lower, median, upper] = [lower, median, upper].map(figure);
        let range = format!("{median} times [{lower} to {upper}]");
        match self.noisy {
            [0, _] => range,
            [noisy, all] => format!("{range} ({noisy} of {all} ratios are noisy and left out)"),
        }
    }
}
