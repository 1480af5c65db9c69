//! Every clipper on every mix: `cargo bench --bench clip`.
//!
//! For ratios that stand on a machine that others use, too, see `ratios`: here
//! one clipper runs over the same segments again and again, and a good branch
//! predictor learns much of them, which flatters branches.
//! Answers are compared before anything is timed.

mod mixes;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use frusta::samples::Placement;
use frusta::{
    Accuracy, CohenSutherland, CyrusBeck, Frustum, LiangBarsky, LiangBarskyVariant, NonFinite,
    Pose, Real, Segment, SegmentClip, SegmentClipper, SixPlanes, VwProjection,
};
use mixes::{COUNT, Form, Mix, assert_answers_agree, frustum, poses, samples, wrong_answers};
use std::hint::black_box;
use std::time::Duration;

/// A call like any other, so that inlining into the loop decides nothing.
#[inline(never)]
fn call<T: Real>(
    clipper: &impl SegmentClipper<T>,
    frustum: &Frustum,
    segment: &Segment<T>,
) -> Result<SegmentClip<T>, NonFinite> {
    clipper.clip_segment(frustum, segment)
}

fn bench<T: Real>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    tier: &str,
    clipper: impl SegmentClipper<T>,
    frustum: &Frustum,
    segments: &[Segment<T>],
) {
    group.bench_function(format!("{}/{tier}", clipper.name()), |b| {
        b.iter(|| {
            for segment in segments {
                let _ = black_box(&call(&clipper, frustum, segment));
            }
        });
    });
}

fn all<T: Real>(c: &mut Criterion, scalar: &str, form: Form, (place, pose): (&str, Pose)) {
    let f = &frustum(form.shape(), &pose);
    for mix in Mix::ALL {
        let s = &mix.segments::<T>(&pose);
        assert_answers_agree(f, s);
        let name = format!("{scalar}/{}/{place}/{}", form.name(), mix.name());
        clippers(c, &name, f, s);
    }
}

fn clippers<T: Real>(c: &mut Criterion, name: &str, f: &Frustum, s: &[Segment<T>]) {
    use LiangBarskyVariant::{Textbook, Tuned};
    let group = &mut c.benchmark_group(name);
    group.throughput(Throughput::Elements(COUNT as u64));
    bench(group, "plain", LiangBarsky::plain(Textbook), f, s);
    bench(group, "plain", LiangBarsky::plain(Tuned), f, s);
    bench(group, "plain", VwProjection::plain(), f, s);
    bench(group, "plain", CyrusBeck::plain(), f, s);
    bench(group, "plain", CohenSutherland::plain(), f, s);
    bench(group, "plain", SixPlanes::plain(), f, s);
    for (tier, accuracy) in [
        ("fast", Accuracy::Fast),
        ("nearest", Accuracy::Nearest),
        ("inward", Accuracy::Inward),
    ] {
        bench(group, tier, VwProjection::exact(accuracy), f, s);
    }
    bench(
        group,
        "fast",
        LiangBarsky::exact(Tuned, Accuracy::Fast),
        f,
        s,
    );
}

/// Plain V/W on one set of points in its own form, and in the general one.
fn forms(c: &mut Criterion) {
    for form in [Form::Symmetric, Form::Orthographic, Form::Infinite] {
        for mix in Mix::ALL {
            let s = &mix.segments::<f64>(&Pose::IDENTITY);
            let name = format!("f64/{}/form/{}", form.name(), mix.name());
            let group = &mut c.benchmark_group(name);
            for (tier, shape) in [("own", form.shape()), ("general", form.generalised())] {
                let f = &frustum(shape, &Pose::IDENTITY);
                bench(group, tier, VwProjection::plain(), f, s);
            }
        }
    }
}

fn clip(c: &mut Criterion) {
    for place in poses() {
        all::<f64>(c, "f64", Form::Symmetric, place);
        all::<f32>(c, "f32", Form::Symmetric, place);
    }
    for form in &Form::ALL[1..] {
        all::<f64>(c, "f64", *form, poses()[0]);
    }
    for (place, placement) in [
        ("frame", Placement::IDENTITY),
        ("world", Placement::rotated([1, 2, 2, 4])),
    ] {
        let (f, s) = samples::<f64>(&placement);
        // Plain answers to singular samples may be wrong: no more than counted.
        let wrong: usize = wrong_answers(&f, &s).iter().map(|(_, n)| n).sum();
        println!("{wrong} wrong plain answers to the samples in the {place}");
        clippers(c, &format!("f64/singular-78/{place}"), &f, &s);
    }
}

/// Short, since there are many: raise with `--measurement-time`.
fn config() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
}

criterion_group! {
    name = benches;
    config = config();
    targets = clip, forms
}
criterion_main!(benches);
