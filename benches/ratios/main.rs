//! How fast the clippers are, as ratios to textbook Liang-Barsky.
//!
//! `cargo bench --bench ratios [-- ROUNDS] [segments|slices|projection]`. The clippers take turns
//! ([`frusta_lab::turns`]); medians over the rounds are printed. Answers are compared first.

mod projection;
mod slices;

use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::{Accuracy, Frustum, Pose, Real, Segment};
use frusta_lab::mixes::{COUNT, Form, Mix, assert_answers_agree, call, form_cases, frustum};
use frusta_lab::turns::{Pass, Timing, take_turns};
use std::hint::black_box;
use std::time::Instant;

/// Times one pass over the segments, in nanoseconds each.
fn pass<T: Real>(clipper: impl SegmentClipper<T>, frustum: &Frustum, all: &[Segment<T>]) -> f64 {
    let start = Instant::now();
    for segment in all {
        let _ = black_box(&call(&clipper, frustum, segment));
    }
    start.elapsed().as_nanos() as f64 / all.len() as f64
}

/// The clippers that take turns; the first is the reference.
fn clippers<'a, T: Real>(f: &'a Frustum, all: &'a [Segment<T>]) -> Vec<(&'static str, Pass<'a>)> {
    use LiangBarskyVariant::{Textbook, Tuned};
    vec![
        (
            "textbook",
            Box::new(|| pass(LiangBarsky::plain(Textbook), f, all)),
        ),
        (
            "tuned",
            Box::new(|| pass(LiangBarsky::plain(Tuned), f, all)),
        ),
        ("vw", Box::new(|| pass(VwProjection::plain(), f, all))),
        ("cyrus-beck", Box::new(|| pass(CyrusBeck::plain(), f, all))),
        (
            "cohen-s",
            Box::new(|| pass(CohenSutherland::plain(), f, all)),
        ),
        ("six-planes", Box::new(|| pass(SixPlanes::plain(), f, all))),
        (
            "vw-exact",
            Box::new(|| pass(VwProjection::exact(Accuracy::Fast), f, all)),
        ),
    ]
}

fn heading(names: &[&str]) {
    print!("{:14} {:>5} {:>5} {:>5}", "", "out", "in", "cross");
    names.iter().for_each(|name| print!(" {name:>14}"));
    println!();
}

fn row(turns: &[Timing]) {
    for timing in turns {
        print!(
            " {:6.1} ({:5.2})",
            timing.nanoseconds,
            timing.ratio.inverse().median
        );
    }
    println!();
}

fn table<T: Real>(scalar: &str, form: Form, (place, pose): (&str, Pose), rounds: usize) {
    println!("\n{scalar}, {}, in the {place}", form.name());
    let frustum = frustum(form.shape(), &pose);
    for mix in Mix::ALL {
        let segments = mix.segments::<T>(COUNT, &pose);
        let [out, _, _, inside, cross] = assert_answers_agree(&frustum, &segments);
        let (names, mut passes): (Vec<_>, Vec<_>) =
            clippers(&frustum, &segments).into_iter().unzip();
        if mix == Mix::ALL[0] {
            heading(&names);
        }
        print!("{:14} {out:5} {inside:5} {cross:5}", mix.name());
        row(&take_turns(&mut passes, rounds));
    }
}

/// The 78 singular samples: here plain answers may be wrong, so they are
/// counted instead.
fn singular(rounds: usize) {
    for case in frusta_lab::mixes::singular() {
        println!("\nf64, the 78 singular samples, in the {}", case.place);
        let passes = clippers(&case.frustum, &case.segments);
        let (names, mut passes): (Vec<_>, Vec<_>) = passes.into_iter().unzip();
        heading(&names);
        print!("{:32}", "");
        row(&take_turns(&mut passes, rounds));
        print!("{:32}", format!("wrong of {COUNT}"));
        for (_, wrong) in case.wrong {
            print!(" {wrong:14}");
        }
        println!();
    }
}

/// Plain V/W on each form, compared with nearly the same set of points in the
/// general form.
fn forms(rounds: usize) {
    println!("\nf64, in the frame: plain V/W in the general form, and in its own");
    for case in form_cases() {
        let all = &case.segments;
        let mut passes: [Pass<'_>; 2] = [
            Box::new(|| pass(VwProjection::plain(), &case.general, all)),
            Box::new(|| pass(VwProjection::plain(), &case.own, all)),
        ];
        let turns = take_turns(&mut passes, rounds);
        let [general, own] = [turns[0].nanoseconds, turns[1].nanoseconds];
        let speed = turns[1].ratio.inverse().median;
        let (form, mix) = (case.form.name(), case.mix.name());
        println!("{form:14} {mix:14} {general:6.1} {own:6.1} ({speed:5.2})");
    }
}

/// One segment a call.
fn segments(rounds: usize) {
    println!("nanoseconds a segment; in brackets how many times as fast as textbook Liang-Barsky");
    for place in Mix::poses() {
        table::<f64>("f64", Form::Symmetric, place, rounds);
        table::<f32>("f32", Form::Symmetric, place, rounds);
    }
    for form in &Form::ALL[1..] {
        table::<f64>("f64", *form, Mix::poses()[0], rounds);
    }
    singular(rounds);
    forms(rounds);
}

/// A name, and what prints its tables with a number of rounds.
type Part = (&'static str, fn(usize));

fn main() {
    // Cargo passes --bench, too.
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rounds = args.iter().find_map(|arg| arg.parse().ok());
    let rounds = rounds.unwrap_or(10_usize).max(1);
    let asked = |name: &str| args.iter().any(|arg| arg == name);
    let parts: [Part; 3] = [
        ("segments", segments),
        ("slices", slices::print),
        ("projection", projection::print),
    ];
    // Without a name, all.
    let is_named = parts.iter().any(|(name, _)| asked(name));
    for (name, print) in parts {
        if asked(name) || !is_named {
            print(rounds);
        }
    }
}
