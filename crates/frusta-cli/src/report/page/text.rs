//! The page from top to bottom: the question, the first chart, the answer, and everything else.

use super::drawing::Drawing;
use super::marks::colour;
use super::overview::{self, overview};
use super::panel::{KEY, by_family, panel};
use super::words::count;
use super::{chart, everyday, peers, style, tables, volumes, worst};
use crate::draw::Theme;
use crate::failure::Failure;
use crate::replay;
use crate::report::{Measured, Page, answer};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use frusta_lab::{SurveyAlgorithm, SurveyTier};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::Value;

/// The whole page.
pub(super) fn page(page: &Page<'_>) -> Result<String, Failure> {
    let body = html! {
        (headline(page.measured))
        (first_chart(page.measured))
        (answer(page.measured))
        (paper(page))
        (how_to_read())
        (all_families(page))
        (panels(page))
        (everyday::section(&page.measured.everyday))
        (volumes::section(&page.measured.volumes))
        (worst_cases(page)?)
        (in_full(page))
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

/// What was asked.
fn headline(measured: &Measured) -> Markup {
    let families = by_family(&measured.survey.rows).len();
    let rows = &measured.survey.rows;
    let used = |tier: &SurveyTier| rows.iter().any(|row| row.tier == *tier);
    let tiers = SurveyTier::ALL.iter().filter(|tier| used(tier)).count();
    html! {
        p.soft { "frusta report" }
        h1 { "What does an exactly right clip of a segment against a view frustum cost?" }
        p.lead {
            "Six algorithms in " (tiers) " kinds of arithmetic clipped the same segments, in "
            (families) " families of singular, stiff and extreme cases. Every answer was compared with \
             rational arithmetic, and every clipper was timed."
        }
    }
}

/// Error against run time over all families, and what its terms mean.
fn first_chart(measured: &Measured) -> Markup {
    html! {
        figure #chart {
            div.scroll.wide { (PreEscaped(chart::chart(&measured.survey))) }
            figcaption {
                b { "Error against run time over all families. " }
                b { "u" } " is the unit roundoff of the type, 2" sup { "-53" } " in f64 and 2" sup { "-24" }
                " in f32; an error of 1 u·scale is u times the largest coordinate of the segment. "
                b { "Exact" } " clippers decide by the exact signs of what " b { "plain" }
                " ones round; fast, nearest and inward differ in the rounding of the points. "
                b { "V/W" } " is projection reduction, the method of the paper below: it clips by the \
                 frustum's outlines in two planes, V and W."
            }
        }
    }
}

/// The answer in three sentences.
fn answer(measured: &Measured) -> Markup {
    html! {
        h2 #answer { "The answer" }
        ul.answer { @for sentence in answer::sentences(measured) { li { (sentence) } } }
        p.soft {
            "Wrong: outside, touching or crossing mistaken, a wrong face, or no answer. In brackets: the \
             lower and the upper quartile over the rounds, in each of which all clippers took turns. A \
             ratio with a quartile that is more than 25 % off its median is noisy: it is marked ~ in the \
             tables, and takes no part in these sentences."
        }
        (contents())
    }
}

/// Links to all sections that follow.
fn contents() -> Markup {
    html! {
        nav {
            @for (id, name) in [
                ("paper", "the paper's table"), ("read", "how to read a panel"), ("overview", "all families"),
                ("panels", "panels"), ("everyday", "everyday segments"), ("volumes", "boxes and spheres"),
                ("worst", "worst cases"), ("tables", "tables"), ("peers", "other libraries"),
                ("bias", "our bias"), ("omitted", "left out"), ("made", "how it was made"),
            ] {
                a href={ "#" (id) } { (name) }
            }
        }
    }
}

/// The key and the axes.
fn how_to_read() -> Markup {
    let icon = |algorithm, tier| {
        let mut drawing = Drawing::icon(18);
        drawing.mark((algorithm, tier), [9.0, 9.0], 5.5, "");
        PreEscaped(drawing.finish())
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
                 the type times the segment's largest coordinate (u·scale). Exact points are on the rail \
                 at the bottom."
            }
            li {
                "A wrong class, such as a hit reported as a miss, has no error that could be averaged. Such \
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
                span.any { (icon(algorithm, SurveyTier::PlainF64)) (algorithm) }
            }
        }
        div.key {
            @for (tier, name) in KEY {
                span class=(colour(tier)) { (icon(SurveyAlgorithm::Vw, tier)) (name) }
            }
            span { (icon(SurveyAlgorithm::Vw, SurveyTier::ExactFastF32)) "hollow: the same in f32" }
        }
    }
}

fn all_families(page: &Page<'_>) -> Markup {
    html! {
        h2 #overview { "All families" }
        p {
            "A thumbnail of each panel, all on the same axes, those of the first chart with one family \
             each. " (overview::axes(&page.measured.survey.rows)) " The dashed line across is the bound of "
            code { "exact-fast" } "; the line upwards is the time of textbook Liang-Barsky. A click leads \
             to the panel."
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
             for swapped ends; again: other answers when clipped again; unbounded: the exact coordinate is \
             0 or next to it, so that no number of its units in the last place measures the error. A \
             click on a heading sorts."
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
                "The worst of each kind, from different families. Red marks wrong answers: bands and crosses \
                 have a wrong class or wrong faces. The lower picture is a close view of where answers and \
                 truth differ. The line under a picture is the case, to the bit: "
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
                        b { (title) } ", " (worst::describe(witness)) " (case " (witness.case) ")"
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
             the filter did not settle, and that needed expansions or big integers. Ratios are times as \
             multiples of textbook Liang-Barsky's, with quartiles."
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
            "\u{201c}View Frustum Culling Geometric Algorithm\u{201d} (\u{89c6}\u{9525}\u{4f53}\u{88c1}\u{526a}\u{51e0}\u{4f55}\u{7b97}\u{6cd5}\u{7814}\u{7a76}, in Chinese), the paper \
             that describes projection reduction (V/W), gives run times of Liang-Barsky, of the general \
             algorithm (six planes) and of projection reduction as 4243 : 4228 : 4212, without a unit or a \
             machine"
            @if let Some(ours) = tables::proportion(&page.measured.paper) {
                "; ours, on the same scale, are " b { (ours) }
            }
            ". It says that the general algorithm errs where the two others do not."
        }
        p {
            "The times are of " b { "78 singular samples" } ": segments that touch, cross or lie in the \
             corners, edges and faces of a frustum. The paper does not list them; these are derived from \
             its description. Each was clipped " (count(u64::from(page.measured.paper.repeats)))
            " times, in " (page.measured.paper.rounds) " rounds."
        }
        (tables::paper(&page.measured.paper))
        p.soft {
            "Ratios are to textbook Liang-Barsky, plain, in the same type, with quartiles; larger is \
             slower. In order: as in the paper, which branch predictors learn by heart. Wrong counts \
             classes and face sets: of the 78; of samples whose outer parts are longer; of both in 48 \
             orientations of the axes; and in rotated poses."
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
                 here, and its shares here are no estimate for any scene."
            }
            li {
                "The plain algorithms are our own writing of textbooks. They were written to be fast and \
                 fair, but whoever wrote the exact tier wrote them, too."
            }
            li {
                "The truth is computed by this crate's oracle: independent code, in rational arithmetic, but by \
                 the same authors. With the files beside this page anybody can check it."
            }
            li {
                "Singular cases need the slower exact stages, so run times on the families flatter plain \
                 arithmetic. They are taken with one segment a call."
            }
            li {
                "We made up the mixes of everyday segments; no program's scene was recorded. How much \
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
