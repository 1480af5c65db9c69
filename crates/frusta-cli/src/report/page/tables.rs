//! The page's tables.

use super::totals::Total;
use super::words::{count, figure, median, percent, quartiles};
use frusta_lab::{PaperTable, Spread, Survey, SurveyAlgorithm, SurveyRow, SurveyTier, Tier};
use maud::{Markup, html};

/// A table that a click on a heading sorts.
pub(super) fn sortable(heads: &[(&str, &str)], rows: &Markup) -> Markup {
    html! {
        div.scroll {
            table.sort {
                thead { tr { @for (head, class) in heads { th class=(class) { (head) } } } }
                tbody { (rows) }
            }
        }
    }
}

/// A count of faults, which should be 0.
fn wrong(n: u64, of: u64) -> Markup {
    let share = n as f64 / of.max(1) as f64;
    html! { td.bad[n > 0] data-v=(n) title=(percent(share)) { (count(n)) } }
}

/// A number that counts no fault.
fn cell(value: f64) -> Markup {
    html! { td data-v=(value) { (figure(value)) } }
}

/// A ratio of times with its quartiles.
pub(super) fn ratio(spread: Spread) -> Markup {
    html! {
        td data-v=(spread.median) {
            @if spread.median > 0.0 {
                (median(spread)) " " span.soft { "[" (quartiles(spread)) "]" }
            } @else { "-" }
        }
    }
}

/// The columns of sums.
const SUMS: [(&str, &str); 12] = [
    ("tier", "t"),
    ("answers", ""),
    ("wrong class", ""),
    ("wrong faces", ""),
    ("refused", ""),
    ("outside", ""),
    ("swapped", ""),
    ("again", ""),
    ("max u·scale", ""),
    ("time ratio", ""),
    ("filter failed", ""),
    ("exact stage", ""),
];

/// A sum's cells, in the order of [`SUMS`] without the first.
fn sums(t: &Total) -> Markup {
    let share = |n: u64| html! { td data-v=(t.share(n)) { (percent(t.share(n))) } };
    html! {
        td data-v=(t.cases) { (count(t.cases)) }
        (wrong(t.wrong_class, t.cases))
        (wrong(t.wrong_faces, t.cases))
        (wrong(t.refused, t.cases))
        (share(t.outside))
        (share(t.asymmetric))
        (share(t.non_idempotent))
        (cell(t.max_u_scale))
        (ratio(t.time_ratio.unwrap_or_default()))
        (share(t.filter_failures))
        (share(t.exact_stage))
    }
}

/// Over all families and algorithms, a row for each tier.
pub(super) fn tiers(survey: &Survey) -> Markup {
    let rows = html! {
        @for tier in SurveyTier::ALL {
            @let t = Total::of(survey, |row| row.tier == tier);
            @if t.cases > 0 { tr { td.t { (tier) } (sums(&t)) } }
        }
    };
    sortable(&SUMS, &rows)
}

/// Over all families, a row for each algorithm in each tier.
pub(super) fn totals(survey: &Survey) -> Markup {
    let mut heads = vec![("algorithm", "t")];
    heads.extend(SUMS);
    let rows = html! {
        @for tier in SurveyTier::ALL {
            @for algorithm in SurveyAlgorithm::ALL {
                @let t = Total::of_clipper(survey, algorithm, tier);
                @if t.cases > 0 { tr { td.t { (algorithm) } td.t { (tier) } (sums(&t)) } }
            }
        }
    };
    sortable(&heads, &rows)
}

/// All rows of a family.
pub(super) fn family(rows: &[&SurveyRow]) -> Markup {
    let heads = [
        ("algorithm", "t"),
        ("tier", "t"),
        ("class", ""),
        ("faces", ""),
        ("refused", ""),
        ("ns", ""),
        ("ratio", ""),
        ("max ulp", ""),
        ("99.9 %", ""),
        ("max u·scale", ""),
        ("99.9 %", ""),
        ("outside", ""),
        ("swap", ""),
        ("again", ""),
        ("filter", ""),
        ("exact", ""),
    ];
    let rows = html! {
        @for r in rows {
            tr {
                td.t { (r.algorithm) }
                td.t { (r.tier) }
                (wrong(r.wrong_class, r.cases))
                (wrong(r.wrong_faces, r.cases))
                (wrong(r.refused, r.cases))
                (cell(r.ns_median))
                (ratio(r.time_ratio))
                (cell(r.error_ulp.max))
                (cell(r.error_ulp.p999))
                (cell(r.error_u_scale.max))
                (cell(r.error_u_scale.p999))
                td { (r.outside) }
                td { (r.asymmetric) }
                td { (r.non_idempotent) }
                td { (r.filter_failures) }
                td { (r.exact_stage) }
            }
        }
    };
    sortable(&heads, &rows)
}

/// The paper's times beside ours.
pub(super) fn paper(table: &PaperTable) -> Markup {
    let heads = [
        ("algorithm", "t"),
        ("arithmetic", "t"),
        ("type", "t"),
        ("paper", ""),
        ("here, in order", ""),
        ("here, shuffled", ""),
        ("ns", ""),
        ("right of 78", ""),
        ("wrong, stretched", ""),
        ("wrong, turned", ""),
        ("wrong, rotated", ""),
    ];
    let rows = html! {
        @for row in &table.rows {
            @let [standard, stretched, turned, rotated] = row.scores();
            tr {
                td.t { (row.algorithm) }
                td.t { (row.tier.name()) }
                td.t { (row.scalar) }
                td { @if let Some(paper) = row.paper { (format!("{paper:.4}")) } }
                (ratio(row.in_order.ratio))
                (ratio(row.shuffled.ratio))
                (cell(row.shuffled.nanoseconds))
                td.bad[standard.right_sets < standard.samples] { (standard.right_sets) }
                @for score in [stretched, turned, rotated] {
                    (wrong((score.samples - score.right_sets) as u64, score.samples as u64))
                }
            }
        }
    };
    sortable(&heads, &rows)
}

/// The three ratios of the paper and ours, in its own form.
pub(super) fn proportion(table: &PaperTable) -> Option<String> {
    let ratio = |name: &str| {
        let row = table.row(name, Tier::Plain, "f64")?;
        Some(format!("{:.0}", 4243.0 * row.in_order.ratio.median))
    };
    let all = ["liang-barsky-textbook", "six-planes", "vw"].map(ratio);
    let all: Option<Vec<String>> = all.into_iter().collect();
    all.map(|all| all.join(" : "))
}
