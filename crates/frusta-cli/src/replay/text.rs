//! A case as text for people: the truth, then every answer.

use super::answers::{Answer, Replay, letters};
use super::decimal::{decimal, parameter};
use crate::draw::wrapped;
use crate::io::number::short;
use frusta::oracle::OracleEnd;
use frusta::{Class, EndRect, FaceSet, Shape, Vec3};
use frusta_lab::{CaseSegment, SurveyAlgorithm, SurveyTier};
use std::fmt::Write;

/// Digits of exact numbers.
const DIGITS: usize = 20;

/// The width of everything.
const WIDTH: usize = 100;

/// The column where values begin.
const INDENT: usize = 14;

/// Names and values, one below the other, no line wider than [`WIDTH`].
struct Lines(String);

impl Lines {
    fn add(&mut self, name: &str, value: &str) {
        for (i, line) in wrapped(value, WIDTH - INDENT).iter().enumerate() {
            let name = if i == 0 { name } else { "" };
            // Writing into memory cannot fail.
            let _ = writeln!(self.0, "{:<INDENT$}{}", name, line.trim_end());
        }
    }
}

/// Everything about a case.
pub(super) fn text(replay: &Replay) -> String {
    let mut lines = Lines(String::new());
    input(replay, &mut lines);
    truth(replay, &mut lines);
    stages(replay, &mut lines);
    let mut out = lines.0;
    table(replay, &mut out);
    out
}

/// A case in a line: the truth, and the number of wrong answers.
pub(super) fn summary(number: usize, title: &str, replay: &Replay) -> String {
    let wrong = |exact: bool| {
        let of = replay.answers.iter().filter(|a| a.tier.is_exact() == exact);
        let wrong = of.clone().filter(|a| !a.verdict.is_right()).count();
        format!("{wrong} of {}", of.count())
    };
    let class = replay.truth.class.name();
    format!(
        "{number:>6}  {class:<9} wrong: plain {:<9} exact {:<9} {title}",
        wrong(false),
        wrong(true)
    )
    .trim_end()
    .to_owned()
        + "\n"
}

fn input(replay: &Replay, lines: &mut Lines) {
    let scalar = match replay.case.segment {
        CaseSegment::Single(_) => "f32",
        CaseSegment::Double(_) => "f64",
    };
    for (name, end) in ends(replay.case.frustum.shape()) {
        lines.add(name, &end);
    }
    let pose = replay.case.frustum.pose();
    if !pose.is_identity() {
        lines.add("origin", &pose.origin.to_string());
        for axis in pose.axes {
            lines.add("axis", &axis.to_string());
        }
    }
    let point = |p: Vec3<f64>| p.to_array().map(short).join("  ");
    lines.add(&format!("{scalar} from"), &point(replay.segment.start));
    lines.add("    to", &point(replay.segment.end));
}

/// The shape's two ends by name.
fn ends(shape: &Shape) -> Vec<(&'static str, String)> {
    let sides = |[left, right, bottom, top]: [f64; 4]| {
        let [left, right, bottom, top] = [left, right, bottom, top].map(short);
        format!("x {left} to {right},  y {bottom} to {top}")
    };
    let end = |e: EndRect| format!("z = {},  {}", short(e.z), sides(e.rect.to_array()));
    let other = match *shape {
        Shape::Finite { far, .. } => ("far", end(far)),
        Shape::Infinite {
            slopes, direction, ..
        } => {
            let sign = if direction.sign() > 0.0 { '+' } else { '-' };
            let slopes = sides(slopes.to_array());
            (
                "no far end",
                format!("along {sign}z, for each unit of it {slopes}"),
            )
        }
    };
    vec![("near", end(shape.near())), other]
}

fn truth(replay: &Replay, lines: &mut Lines) {
    let class = replay.truth.class;
    lines.add("truth", class.name());
    let Some(part) = &replay.truth.part else {
        return;
    };
    let mut end = |name: &str, end: &OracleEnd, t: &str| {
        let clipped = if end.clipped {
            "clipped"
        } else {
            "not clipped"
        };
        let on = if end.faces.is_empty() {
            "on no face".to_owned()
        } else {
            format!("on {}", end.faces)
        };
        let t = if t.is_empty() {
            parameter(&end.t, DIGITS)
        } else {
            t.to_owned()
        };
        lines.add(name, &format!("t = {t}, {on}, {clipped}"));
        let point = end.point.each_ref().map(|c| decimal(c, DIGITS));
        lines.add("", &format!("at {}", point.join("  ")));
    };
    end("  enters", &part.entry, "");
    let gap = &part.exit.t - &part.entry.t;
    end("  leaves", &part.exit, "");
    if part.entry.clipped && part.exit.clipped && class != Class::Touch {
        lines.add(
            "  between",
            &format!("{} of the parameter", decimal(&gap, 6)),
        );
    }
    if !part.coplanar.is_empty() {
        lines.add("  lies in", &part.coplanar.to_string());
    }
}

/// The stages that the exact clipper needed.
fn stages(replay: &Replay, lines: &mut Lines) {
    let Some(own) = replay.own() else {
        return;
    };
    let s = own.verdict.stages;
    let stages = if s == frusta::StageCounts::default() {
        "floating point settled it at once".to_owned()
    } else {
        let counts = [
            (s.lattice, "settled on the lattice"),
            (s.filter_failures, "not settled by the filter"),
            (s.double_doubles, "settled by double-double"),
            (s.expansions, "by expansions"),
            (s.integers, "by integers"),
        ];
        let used = counts.iter().filter(|(n, _)| *n > 0);
        let used: Vec<String> = used.map(|(n, what)| format!("{n} {what}")).collect();
        format!("predicates: {}", used.join(", "))
    };
    lines.add("exact vw", &stages);
}

/// Tier by tier; an answer that all algorithms share is a row.
fn table(replay: &Replay, out: &mut String) {
    let mut line = |text: String| {
        out.push_str(text.trim_end());
        out.push('\n');
    };
    line(String::new());
    line(format!(
        "{:<24}{:<9}{:<14}{:>7}{:>7}{:>8}{:>7}  wrong",
        "", "class", "faces", "ulp in", "out", "u*s in", "out"
    ));
    for tier in SurveyTier::ALL {
        let of_tier = |a: &&Answer| a.tier == tier;
        let answers: Vec<&Answer> = replay.answers.iter().filter(of_tier).collect();
        let Some((first, rest)) = answers.split_first() else {
            continue;
        };
        line(tier.to_string());
        if rest.len() + 1 == SurveyAlgorithm::ALL.len() && rest.iter().all(|a| same(a, first)) {
            line(row("all six", first));
        } else {
            answers
                .iter()
                .for_each(|a| line(row(a.algorithm.name(), a)));
        }
    }
    line(String::new());
    for text in LEGEND.lines() {
        line(text.to_owned());
    }
    if !replay.has_f32 {
        line("Not in f32, which does not have this segment's coordinates.".to_owned());
    }
}

/// Whether two answers are the same, however they were found.
fn same(a: &Answer, b: &Answer) -> bool {
    let (a, b) = (&a.verdict, &b.verdict);
    a.clip == b.clip && a.refusal == b.refusal && a.errors == b.errors && a.remarks() == b.remarks()
}

fn row(name: &str, answer: &Answer) -> String {
    let v = &answer.verdict;
    let (class, faces) = match (&v.clip, &v.refusal) {
        (Some(clip), _) => {
            let part = clip.part.as_ref();
            let sets = part.map_or([FaceSet::EMPTY; 3], |p| {
                [p.entry.faces, p.exit.faces, p.coplanar]
            });
            (clip.class.name(), letters(clip.class, sets))
        }
        (None, why) => (
            "none",
            why.as_deref().unwrap_or("").chars().take(14).collect(),
        ),
    };
    let figures = match v.errors {
        Some([a, b]) => [a.ulp, b.ulp, a.u_scale, b.u_scale].map(figure),
        None => [const { String::new() }; 4],
    };
    let [ulp_in, ulp_out, scale_in, scale_out] = figures;
    format!(
        "  {name:<22}{class:<9}{faces:<14}{ulp_in:>7}{ulp_out:>7}{scale_in:>8}{scale_out:>7}  {}",
        v.remarks().join(" ")
    )
}

/// Three digits of an error.
pub(super) fn figure(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        v if v < 0.005 => "<0.01".to_owned(),
        v if v >= 999.5 => format!("{v:.0e}"),
        v if v >= 9.995 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

const LEGEND: &str = "\
faces: entered on > left on | lying in; N near, F far, L left, R right, B bottom, T top
ulp, u*s: errors where it enters and leaves, in units in the last place of each coordinate, and
in unit roundoffs of the segment's largest coordinate
wrong: CLASS; FACES or clipped flags; an end out of the frustum; swap: the swapped segment has
another answer; again: clipped again, the part changes";
