//! A survey as text, in lines of at most 100 columns: the algorithms over all families in each
//! tier, and the most telling ones on each family.
//!
//! All rows are in files. Here counts are summed, errors are the largest, and times are geometric
//! means over the families, so that no family outweighs the others.

use super::row::{Survey, SurveyAlgorithm, SurveyRow, SurveyTier};
use crate::figures::{RATIO_LEGEND, error, fit, ratio};
use crate::geometric_mean;
use crate::turns::Spread;
use frusta::samples::Family;
use std::fmt;

/// Displays a survey as two tables.
#[derive(Clone, Copy, Debug)]
pub struct SurveyTable<'a>(pub &'a Survey);

impl fmt::Display for SurveyTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let survey = self.0;
        let families = families(survey);
        writeln!(
            f,
            "families: {}; cases of each in each scalar type: {}; seed: {}; rounds of times: {}",
            families.len(),
            survey.cases,
            survey.seed,
            survey.rounds
        )?;
        tiers(f, survey)?;
        f.write_str(TIERS_LEGEND)?;
        if survey.rows.iter().any(|row| row.error_ulp.max == f64::MAX) {
            f.write_str(UNBOUNDED_LEGEND)?;
        }
        f.write_str(RATIO_LEGEND)?;
        by_family(f, survey, &families)?;
        f.write_str(FAMILIES_LEGEND)
    }
}

const TIERS_LEGEND: &str = "
class, faces  cases with a wrong class; with the right one and a wrong face set or clipped flag
refused       refused, panicked, or not finite
outside       share of cases with a clipped end that is outside of the frustum, exactly (inward:
              and flagged inside); swapped: whose answer changes when the ends are swapped;
              again: whose answer changes when it is clipped again (inward: if flagged inside)
ulp, u*max    the largest error of a clipped end of an answer of the right class: in units in the
              last place of the exact coordinate; in roundoffs of the segment's largest coordinate
ns, times     a segment, and as a multiple of plain textbook Liang-Barsky in f64 on the same cases;
              geometric means over the families
";

/// Follows where there is one.
const UNBOUNDED_LEGEND: &str = "\
*             beyond the range of f64: the exact coordinate is 0 or next to it, so that no number of
              its units in the last place measures the error
";

const FAMILIES_LEGEND: &str = "
plain: wrong  wrong classes and faces in f64: V/W, textbook Liang-Barsky, six planes
exact: wrong  of all algorithms in all exact tiers, refused and asymmetric ones included
u*max, ulp    the largest error with Fast, and with Nearest (f64)
filter, exact share of cases that V/W's filter did not settle; that needed expansions or integers
times         Liang-Barsky's ns (textbook, plain, f64); as multiples: V/W plain, V/W exact with Fast
";

/// In the survey's order.
fn families(survey: &Survey) -> Vec<Family> {
    let mut families: Vec<Family> = survey.rows.iter().map(|row| row.family).collect();
    families.dedup();
    families
}

fn tiers(f: &mut fmt::Formatter<'_>, survey: &Survey) -> fmt::Result {
    writeln!(f, "\n{:21}{TIERS_COLUMNS}", "")?;
    for tier in SurveyTier::ALL {
        let rows = |algorithm: SurveyAlgorithm| -> Vec<&SurveyRow> {
            let named = |row: &&SurveyRow| row.tier == tier && row.algorithm == algorithm;
            survey.rows.iter().filter(named).collect()
        };
        let cases: u64 = rows(SurveyAlgorithm::REFERENCE)
            .iter()
            .map(|r| r.cases)
            .sum();
        if cases == 0 {
            continue;
        }
        writeln!(f, "{tier}: {cases} cases")?;
        for algorithm in SurveyAlgorithm::ALL {
            tier_line(f, algorithm, &rows(algorithm))?;
        }
    }
    Ok(())
}

const TIERS_COLUMNS: &str =
    "  class   faces refused outside swapped  again     ulp   u*max      ns    times";

fn tier_line(
    f: &mut fmt::Formatter<'_>,
    algorithm: SurveyAlgorithm,
    rows: &[&SurveyRow],
) -> fmt::Result {
    let cases = sum(rows, |r| r.cases);
    let count = |of: fn(&SurveyRow) -> u64| sum(rows, of);
    let share = |of| percent(count(of), cases);
    writeln!(
        f,
        "{algorithm:<21}{:>7}{:>8}{:>8}{:>8}{:>8}{:>7}{:>8}{:>8}{:>8}{:>9}",
        count(|r| r.wrong_class),
        count(|r| r.wrong_faces),
        count(|r| r.refused),
        share(|r| r.outside),
        share(|r| r.asymmetric),
        share(|r| r.non_idempotent),
        error(largest(rows, |r| r.error_ulp.max)),
        error(largest(rows, |r| r.error_u_scale.max)),
        fit(mean(rows, |r| r.ns_median), 1, 7),
        ratio(Spread::geometric_mean(rows.iter().map(|r| r.time_ratio)).unwrap_or_default()),
    )
}

fn by_family(f: &mut fmt::Formatter<'_>, survey: &Survey, families: &[Family]) -> fmt::Result {
    writeln!(f, "\n{:18}{FAMILIES_COLUMNS_ABOVE}", "")?;
    writeln!(f, "{:18}{FAMILIES_COLUMNS}", "")?;
    let mut families = families.iter();
    families.try_for_each(|&family| family_line(f, survey, family))
}

const FAMILIES_COLUMNS_ABOVE: &str =
    "     plain: wrong     exact:   u*max    ulp filter  exact       times";
const FAMILIES_COLUMNS: &str =
    "    V/W    L-B planes  wrong    Fast Nearest              L-B ns    plain    exact";

fn family_line(f: &mut fmt::Formatter<'_>, survey: &Survey, family: Family) -> fmt::Result {
    use SurveyAlgorithm::{LiangBarskyTextbook, SixPlanes, Vw};
    let row = |algorithm, tier| survey.row(algorithm, tier, family);
    let text = |row: Option<&SurveyRow>, say: &dyn Fn(&SurveyRow) -> String| {
        row.map_or_else(|| "-".to_owned(), say)
    };
    let plain = |algorithm| row(algorithm, SurveyTier::PlainF64);
    let wrong = |row: &SurveyRow| (row.wrong_class + row.wrong_faces).to_string();
    let fast = row(Vw, SurveyTier::ExactFast);
    let nearest = row(Vw, SurveyTier::ExactNearest);
    let here = |r: &&SurveyRow| r.family == family && r.tier.is_exact();
    let exact: Vec<&SurveyRow> = survey.rows.iter().filter(here).collect();
    let all = |r: &SurveyRow| r.wrong_class + r.wrong_faces + r.refused + r.asymmetric;
    writeln!(
        f,
        "{family:<18}{:>7}{:>7}{:>7}{:>7}{:>8}{:>7}{:>7}{:>7}{:>7}{:>9}{:>9}",
        text(plain(Vw), &wrong),
        text(plain(LiangBarskyTextbook), &wrong),
        text(plain(SixPlanes), &wrong),
        sum(&exact, all),
        text(fast, &|r| error(r.error_u_scale.max)),
        text(nearest, &|r| error(r.error_ulp.max)),
        text(fast, &|r| percent(r.filter_failures, r.cases)),
        text(fast, &|r| percent(r.exact_stage, r.cases)),
        text(plain(LiangBarskyTextbook), &|r| fit(r.ns_median, 1, 6)),
        text(plain(Vw), &|r| ratio(r.time_ratio)),
        text(fast, &|r| ratio(r.time_ratio)),
    )
}

fn sum(rows: &[&SurveyRow], of: impl Fn(&SurveyRow) -> u64) -> u64 {
    rows.iter().map(|row| of(row)).sum()
}

fn largest(rows: &[&SurveyRow], of: impl Fn(&SurveyRow) -> f64) -> f64 {
    rows.iter().map(|row| of(row)).fold(0.0, f64::max)
}

/// The geometric mean; 0 of nothing.
fn mean(rows: &[&SurveyRow], of: impl Fn(&SurveyRow) -> f64) -> f64 {
    geometric_mean(rows.iter().map(|row| of(row))).unwrap_or(0.0)
}

/// A share; one that is not 0 never reads as 0.
fn percent(count: u64, of: u64) -> String {
    let percent = 100.0 * count as f64 / of.max(1) as f64;
    match percent {
        0.0 => "0 %".to_owned(),
        p if p < 0.01 => "<.01 %".to_owned(),
        p if p < 10.0 => format!("{p:.2} %"),
        p => format!("{p:.1} %"),
    }
}
