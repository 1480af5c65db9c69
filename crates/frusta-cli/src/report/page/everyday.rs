//! Run times on everyday segments.

use super::words::{count, figure, median, quartiles};
use frusta::samples::Mix;
use frusta_lab::{Everyday, EverydayRow, Spread, Tier};
use maud::{Markup, html};

/// The section.
pub(super) fn section(everyday: &Everyday) -> Markup {
    let of = count(everyday.segments as u64);
    html! {
        h2 #everyday { "Everyday segments" }
        p {
            "The families of this report are hard on purpose. These are segments as programs have them: "
            (of) " of each of four mixes, clipped by a camera\'s frustum, in its own frame and in a world \
             where it is turned and moved. Hardly anything is singular here: plain arithmetic got "
            b { (count(everyday.wrong(Tier::Plain) as u64)) } " classes or face sets wrong, exact arithmetic "
            b { (count(everyday.wrong(Tier::Exact) as u64)) } "."
        }
        ul {
            @for mix in Mix::ALL { li { b { (mix) } ": " (mix.describe()) } }
        }
        (table(everyday))
        p.soft {
            "How many times as fast as textbook Liang-Barsky in plain arithmetic, one segment a call: larger \
             is faster. All in f64; exact is with Fast. Slices: " (count(Everyday::SLICE as u64))
            " segments a call, into a buffer that is used again. Medians over " (everyday.rounds)
            " rounds, in which all took turns, and their quartiles; ~ marks a ratio whose quartiles \
             are more than 25 % off. Point at a number for its nanoseconds."
        }
        @if everyday.flatters_branches() {
            p {
                "Branch predictors learn so few segments, clipped over and over: these times flatter \
                 clippers that branch, such as Liang-Barsky. " code { "--everyday 65536" } " is enough."
            }
        }
    }
}

/// A row for each mix and place. The table cannot be sorted, since the last row is the mean.
fn table(everyday: &Everyday) -> Markup {
    let Some([reference, clippers @ ..]) = everyday.by_mix().next() else {
        return html! {};
    };
    let slices = clippers.iter().filter(|row| row.slices).count();
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        th colspan="3" {}
                        th.group colspan=(clippers.len() - slices) { "one segment a call" }
                        th.group colspan=(slices) { "over slices" }
                    }
                    tr {
                        th.t { "where" } th.t { "mix" } th { (reference.algorithm) ", ns" }
                        @for row in clippers { th { (row.algorithm) ", " (row.tier.name()) } }
                    }
                }
                tbody {
                    @for rows in everyday.by_mix() { (line(rows)) }
                    tr {
                        td.t colspan="3" { "geometric mean" }
                        @for row in clippers {
                            (cell(row, everyday.speed(row.algorithm, row.tier, row.slices), ""))
                        }
                    }
                }
            }
        }
    }
}

/// A mix at a place.
fn line(rows: &[EverydayRow]) -> Markup {
    let nanoseconds = |row: &EverydayRow| figure(row.timing.nanoseconds);
    html! {
        @if let [reference, clippers @ ..] = rows {
            tr {
                td.t { (reference.place) }
                td.t { (reference.mix) }
                td { (nanoseconds(reference)) }
                @for row in clippers {
                    (cell(row, row.speed(), &format!("{} ns", nanoseconds(row))))
                }
            }
        }
    }
}

/// A clipper's speed; those of the exact clippers stand out.
fn cell(row: &EverydayRow, speed: Option<Spread>, title: &str) -> Markup {
    html! {
        td.own[row.tier == Tier::Exact] title=(title) {
            @match speed {
                Some(speed) => { (median(speed)) " " span.soft { "[" (quartiles(speed)) "]" } }
                None => "-",
            }
        }
    }
}
