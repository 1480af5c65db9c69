//! The report as text: the answer, the paper's table, where the rest is; and all tables.

use super::machine::Machine;
use super::{Measured, Page, answer};
use crate::draw::wrapped;
use frusta_lab::{PaperSummary, SurveyTable};
use std::path::Path;

/// Columns of a line at most.
const WIDTH: usize = 100;

/// What stands above the answer.
const TITLE: &str = "What does an exactly right clip of a segment against a view frustum cost?";

/// What the terms of the answer mean.
const TERMS: &str = "\
V/W         projection reduction: clipping by the frustum's two outlines, in the planes V and W
wrong       outside, touching or crossing mistaken; a wrong face; or no answer
[a to b]    quartiles over the rounds in which all took turns; noisy ratios are left out";

/// About 50 lines.
pub(super) fn short(page: &Page<'_>) -> String {
    let mut text = format!("{TITLE}\n");
    for sentence in answer::sentences(page.measured) {
        text += "\n";
        for line in wrapped(&sentence, WIDTH) {
            text += &format!("{}\n", line.trim_end());
        }
    }
    text + &format!("\n{TERMS}\n\n{}", PaperSummary(&page.measured.paper))
}

/// Every table.
pub(super) fn tables(measured: &Measured) -> String {
    let Measured {
        survey,
        everyday,
        volumes,
        paper,
    } = measured;
    format!("{}\n{everyday}\n{volumes}\n{paper}", SurveyTable(survey))
}

/// What it was measured on, how to repeat it, and where the rest is.
pub(super) fn closing(page: &Page<'_>, out: Option<&Path>) -> String {
    let Machine {
        cpu,
        cores,
        os,
        arch,
        rustc,
        simd,
    } = page.machine;
    let mut text = format!("\n{cpu}, {cores} cores, {os} {arch}, {simd}; Rust {rustc}");
    text += &format!(
        "\n{:.0} s; the same again:\n{}\n",
        page.seconds, page.command
    );
    if let Some(out) = out {
        let file = |name: &str| out.join(name).display().to_string();
        text += &format!(
            "\nthe page      {}\nall tables    {}\nthe data      {}\nworst inputs  frusta replay {}\n",
            file("report.html"),
            file("tables.txt"),
            file("report.json"),
            file("witnesses.txt")
        );
    }
    text
}
