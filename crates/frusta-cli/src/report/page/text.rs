//! The page: what was asked, what was found, how to read it.

use super::marks::{colour, mark};
use super::panel::{KEY, by_family, overview, panel};
use super::totals::Total;
use super::words::{count, figure, percent};
use super::{everyday, peers, style, tables, volumes, worst};
use crate::draw::Theme;
use crate::failure::Failure;
use crate::replay;
use crate::report::{Measured, Page};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use frusta_lab::{SurveyAlgorithm, SurveyTier};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::Value;

/// All of it.
pub(super) fn page(page: &Page<'_>) -> Result<String, Failure> {
    let body = html! {
        (headline(page.measured))
        (everyday::section(&page.measured.everyday))
        (volumes::section(&page.measured.volumes))
        (how_to_read())
        (all_families(page))
        (panels(page))
        (worst_cases(page)?)
        (in_full(page))
        (paper(page))
        (peers::section(page.peers))
        (bias())
        (left_out(page))
        (made(page))
    };
    let html = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "frusta: error against run time" }
                // The browser would ask for one.
                link rel="icon" href="data:,";
                style {
                    (PreEscaped(style::COLOURS)) (PreEscaped(style::PANELS)) (PreEscaped(style::PAGE))
                }
            }
            body { main { (body) } script { (PreEscaped(style::SCRIPT)) } }
        }
    };
    Ok(html.into_string())
}

/// What was asked, and the answer in five numbers.
fn headline(measured: &Measured) -> Markup {
    let families = by_family(&measured.survey.rows).len();
    html! {
        p.soft { "frusta report" }
        h1 { "What does an exactly right clip of a segment against a view frustum cost?" }
        p.lead {
            "Six algorithms in nine kinds of arithmetic clipped the same segments, in " (families)
            " families of singular, stiff and extreme cases. Every answer was held against rational \
             arithmetic, and every clipper was timed; four of them on everyday segments, too."
        }
        (numbers(measured))
        (contents())
    }
}

/// How many answers are wrong, and what it costs that none is.
fn numbers(measured: &Measured) -> Markup {
    let survey = &measured.survey;
    let plain = Total::of(survey, |row| !row.tier.is_exact());
    let exact = Total::of(survey, |row| row.tier.is_exact());
    let fast = Total::of_clipper(survey, SurveyAlgorithm::Vw, SurveyTier::ExactFast);
    let same = Total::of_clipper(survey, SurveyAlgorithm::Vw, SurveyTier::PlainF64);
    let slower = fast.time_ratio.zip(same.time_ratio).map(|(a, b)| a / b);
    html! {
        div.numbers {
            div.number {
                b { (percent(plain.share(plain.wrong()))) }
                span {
                    "of the answers of plain arithmetic are wrong: " (count(plain.wrong())) " of "
                    (count(plain.cases)) " have a wrong class or face set, or there is no answer. A \
                     wrong class alone: " (count(plain.wrong_class)) "."
                }
            }
            div.number {
                b { (count(exact.wrong())) }
                span {
                    "answers of exact arithmetic are wrong, of " (count(exact.cases)) ". "
                    (percent(exact.share(exact.exact_stage)))
                    " of them needed expansions or big integers."
                }
            }
            div.number {
                @if let Some(ratio) = fast.time_ratio {
                    b { (figure(ratio)) " times" }
                    span {
                        "the run time of textbook Liang-Barsky in plain f64 is what exact V/W takes \
                         on these families (exact-fast, geometric mean)."
                    }
                } @else {
                    b { "not timed" }
                    span { "This run took no times." }
                }
            }
            div.number {
                @if let Some(slower) = slower {
                    b { (figure(slower)) " times" }
                    span {
                        "the time of the same algorithm in plain arithmetic: the price of being \
                         right, where at least half of the cases are next to singular."
                    }
                } @else {
                    b { (count(survey.cases)) }
                    span { "cases of each family in each scalar type." }
                }
            }
            (everyday::number(&measured.everyday))
        }
    }
}

/// Links to all that follows.
fn contents() -> Markup {
    html! {
        nav {
            @for (id, name) in [
                ("everyday", "everyday segments"), ("volumes", "boxes and balls"), ("read", "how to read a panel"),
                ("overview", "all families"), ("panels", "panels"), ("worst", "worst cases"), ("tables", "tables"), ("paper", "the paper's table"),
                ("peers", "other libraries"), ("bias", "our bias"), ("omitted", "left out"),
                ("made", "how it was made"),
            ] {
                a href={ "#" (id) } { (name) }
            }
        }
    }
}

/// The key and the axes.
fn how_to_read() -> Markup {
    let little = |algorithm, tier| {
        let shape = mark(algorithm, tier, [9.0, 9.0], 5.5, "");
        html! {
            svg.panel viewBox="0 0 18 18" aria-hidden="true" { (PreEscaped(shape)) }
        }
    };
    html! {
        h2 #read { "How to read a panel" }
        p {
            "A panel is a family of cases; a mark is an algorithm (its shape) in an arithmetic (its \
             colour). " b { "Up is worse, right is slower" } ", both in decades."
        }
        ul {
            li {
                "Error is the largest distance of a coordinate from the exact one, in unit roundoffs of \
                 the type times the segment's largest coordinate (u·scale). Points that are exact \
                 have the rail at the bottom."
            }
            li {
                "A wrong class, such as a hit called a miss, has no error that could be averaged. Such \
                 clippers have a mark on the rail at the top, at the share of cases that are wrong or \
                 refused, and a second one for their right answers, tied to it by a thin line."
            }
            li {
                "Time is the median of ratios to textbook Liang-Barsky in plain f64 on the same cases, \
                 taken in turns. Point at a mark to read its numbers."
            }
        }
        div.key {
            @for algorithm in SurveyAlgorithm::ALL {
                span.any { (little(algorithm, SurveyTier::PlainF64)) (algorithm) }
            }
        }
        div.key {
            @for (tier, name) in KEY {
                span class=(colour(tier)) { (little(SurveyAlgorithm::Vw, tier)) (name) }
            }
            span { (little(SurveyAlgorithm::Vw, SurveyTier::ExactFastF32)) "hollow: the same in f32" }
        }
    }
}

fn all_families(page: &Page<'_>) -> Markup {
    html! {
        h2 #overview { "All families" }
        p {
            "The same axes for all. The grey line across is where " code { "exact-fast" }
            " promises to stay below; the one upwards is the time of textbook Liang-Barsky."
        }
        figure { div.scroll.wide { (PreEscaped(overview(&page.measured.survey.rows))) } }
        h3 { "Totals" }
        (tables::tiers(&page.measured.survey))
        details {
            summary { "each algorithm in each tier" }
            (tables::totals(&page.measured.survey))
        }
        p.soft {
            "Time ratios are geometric means over the families. f32 tiers only run on families that \
             make sense in f32. Errors are of answers whose class is right; swapped: other answers \
             for swapped ends; again: other answers when clipped again. Headings sort."
        }
    }
}

fn panels(page: &Page<'_>) -> Markup {
    html! {
        h2 #panels { "Panels" }
        div.panels {
            @for rows in by_family(&page.measured.survey.rows) {
                @if let Some(first) = rows.first() {
                    figure id=(first.family.name()) {
                        (PreEscaped(panel(&rows)))
                        figcaption { (first.family.describe()) }
                    }
                }
            }
        }
    }
}

/// Drawn in both themes; the browser shows the one of its own.
fn worst_cases(page: &Page<'_>) -> Result<Markup, Failure> {
    let mut drawn = Vec::new();
    for witness in worst::choose(&page.measured.survey) {
        let title = format!(
            "{}: {} in {}",
            witness.family, witness.algorithm, witness.tier
        );
        let picture = |theme| -> Result<String, Failure> {
            let svg = replay::drawn(&witness.line, &title, theme)?;
            Ok(format!(
                "data:image/svg+xml;base64,{}",
                STANDARD.encode(svg)
            ))
        };
        let [light, dark] = [picture(Theme::Light)?, picture(Theme::Dark)?];
        drawn.push((witness, title, light, dark));
    }
    Ok(html! {
        h2 #worst { "Worst cases, drawn" }
        @if drawn.is_empty() {
            p { "There are none." }
        } @else {
            p {
                "The worst of each kind, of different families. Red is what was wrong: bands and crosses \
                 are answers whose class or faces are wrong. Below, closely, is where answers part from \
                 the truth. Each line under a picture is the case, to the bit: "
                code { "frusta replay" } " runs it through all clippers again. The rest is in "
                code { "report.json" } "."
            }
        }
        div.cases {
            @for (witness, title, light, dark) in &drawn {
                figure.case {
                    picture {
                        source media="(prefers-color-scheme: dark)" srcset=(dark);
                        img src=(light) alt=(title) loading="lazy";
                    }
                    figcaption {
                        b { (title) } ", " (worst::says(witness)) " (case " (witness.case) ")"
                        pre { "frusta replay \"" (witness.line) "\"" }
                    }
                }
            }
        }
    })
}

fn in_full(page: &Page<'_>) -> Markup {
    html! {
        h2 #tables { "Everything, family by family" }
        p {
            "Counts are out of the family's cases: wrong classes, wrong face sets or clipped flags, \
             refusals (also panics and numbers that are not finite); ends outside of the frustum, \
             answers that differ for swapped ends, answers that change when clipped again; cases that \
             the filter did not settle, and that needed expansions or big integers."
        }
        @for rows in by_family(&page.measured.survey.rows) {
            @if let Some(first) = rows.first() {
                details {
                    summary { b { (first.family.name()) } " " span.soft { (first.family.describe()) } }
                    (tables::family(&rows))
                }
            }
        }
    }
}

fn paper(page: &Page<'_>) -> Markup {
    html! {
        h2 #paper { "The paper's table" }
        p {
            "The paper that projection reduction (V/W) is from gives run times of Liang-Barsky, of the \
             general algorithm (six planes) and of projection reduction on 78 singular samples as \
             4243 : 4228 : 4212, without a unit or a machine"
            @if let Some(ours) = tables::proportion(&page.measured.paper) {
                "; ours, on the same scale, are " b { (ours) }
            }
            ". It says that the general algorithm errs where the two others do not. The 78 samples are \
             our derivation: it lists none. Each was clipped " (count(u64::from(page.measured.paper.repeats)))
            " times, in " (page.measured.paper.rounds) " rounds."
        }
        (tables::paper(&page.measured.paper))
        p.soft {
            "Ratios are to textbook Liang-Barsky, plain, in the same type; larger is slower. In order: as \
             in the paper, which branch predictors learn by heart. Wrong counts classes and face sets."
        }
    }
}

fn bias() -> Markup {
    html! {
        h2 #bias { "Our bias" }
        ul {
            li {
                "The families are chosen to be hard: in each, at least half of the cases are within 4 ulp \
                 of a singular one. On segments at random, plain arithmetic is wrong far more rarely than \
                 here, and its shares here are no estimate for anybody's scene."
            }
            li {
                "The plain algorithms are our own writing of textbooks. They were written to be fast and \
                 fair, but whoever wrote the exact tier wrote them, too."
            }
            li {
                "Truth is this crate's oracle. It is independent code, in rational arithmetic, but of the \
                 same hands; the files that come with this page let anybody check it with other ones."
            }
            li {
                "Singular cases take the exact stages' time, so run times on the families flatter plain \
                 arithmetic. They are of one segment a call."
            }
            li {
                "The mixes of everyday segments are made up, by us; nobody's scene was recorded. How much \
                 faster or slower exact clipping is depends on how many segments are outside, inside and cut."
            }
            li { "The reference of all ratios, textbook Liang-Barsky, is not the fastest plain algorithm." }
        }
    }
}

fn left_out(page: &Page<'_>) -> Markup {
    html! {
        h2 #omitted { "What was left out, and why" }
        ul { @for o in page.omitted { li { b { (o.what) } ": " (o.why) } } }
    }
}

fn made(page: &Page<'_>) -> Markup {
    let machine = serde_json::to_value(page.machine).unwrap_or_default();
    let survey = &page.measured.survey;
    html! {
        h2 #made { "How it was made, and how to make it again" }
        pre { (page.command) }
        p {
            "Seed " (survey.seed) ", " (count(survey.cases)) " cases of each family in each scalar type, "
            (survey.rounds) " rounds of times, " (format!("{:.0}", page.seconds)) " s in all, by frusta "
            (env!("CARGO_PKG_VERSION")) ". The same seed gives the same cases, counts and errors on every \
             machine; times are this machine's."
        }
        div.scroll {
            table {
                tbody {
                    @for (key, value) in machine.as_object().into_iter().flatten() {
                        tr {
                            td.t { (key.replace('_', " ")) }
                            td.t {
                                @match value {
                                    Value::String(text) => (text),
                                    other => (other.to_string()),
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
