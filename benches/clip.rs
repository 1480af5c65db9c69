//! Every clipper on every mix: `cargo bench --bench clip`.
//!
//! For ratios that stand on a machine that others use, too, see `ratios`: there
//! the clippers take turns.
//! Whatever is timed has had its answers compared: plain and exact, all forms, and
//! on the 78 in the frame, where plain arithmetic makes no error.

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::{Accuracy, Frustum, Pose, Real, Segment};
use frusta_lab::mixes::{
    COUNT, Form, Mix, assert_answers_agree, call, form_cases, frustum, singular,
};
use std::hint::black_box;
use std::time::Duration;

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
        let s = &mix.segments::<T>(COUNT, &pose);
        assert_answers_agree(f, s);
        let name = format!("{scalar}/{}/{place}/{}", form.name(), mix.name());
        clippers(c, &name, f, s);
    }
}

fn clippers<T: Real>(c: &mut Criterion, name: &str, f: &Frustum, s: &[Segment<T>]) {
    use LiangBarskyVariant::{Textbook, Tuned};
    let group = &mut c.benchmark_group(name);
    group.throughput(Throughput::Elements(COUNT as u64));
    group.sampling_mode(SamplingMode::Flat);
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
    for case in form_cases() {
        let name = format!("f64/{}/form/{}", case.form.name(), case.mix.name());
        let group = &mut c.benchmark_group(name);
        group.throughput(Throughput::Elements(COUNT as u64));
        group.sampling_mode(SamplingMode::Flat);
        for (tier, f) in [("own", &case.own), ("general", &case.general)] {
            bench(group, tier, VwProjection::plain(), f, &case.segments);
        }
    }
}

fn clip(c: &mut Criterion) {
    for place in Mix::poses() {
        all::<f64>(c, "f64", Form::Symmetric, place);
        all::<f32>(c, "f32", Form::Symmetric, place);
    }
    for form in &Form::ALL[1..] {
        all::<f64>(c, "f64", *form, Mix::poses()[0]);
    }
    for case in singular() {
        let (place, wrong) = (case.place, case.wrong);
        println!("wrong plain answers to the samples in the {place}: {wrong:?}");
        let name = format!("f64/singular-78/{place}");
        clippers(c, &name, &case.frustum, &case.segments);
    }
}

/// Short, since there are many: raise with `--measurement-time`.
fn config() -> Criterion {
    Criterion::default()
        .without_plots()
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
