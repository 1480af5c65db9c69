//! Batches, as ratios: to one by one, to reading or copying their bytes, and with threads to
//! without.
//!
//! `cargo bench --features parallel --bench batch [-- ROUNDS] [segments|boxes|threads]`. All
//! take turns, a ratio is taken within each round, and medians over the rounds are printed.
//! Answers are compared with those of one at a time first.
//!
//! *In cache* are 262,144 of them, which branch predictors cannot learn, 4,096 a call, as a
//! program would that goes on with the answers; *out of cache* four million with one call.

mod data;
#[path = "../mixes/mod.rs"]
#[allow(
    dead_code,
    unused_imports,
    reason = "the other benchmarks use more of it"
)]
mod mixes;
#[path = "../ratios/turns.rs"]
mod turns;

use data::{BoxColumns, SegmentColumns};
use frusta::batch::{ContainmentMasks, SegmentIntervals};
use frusta::{Accuracy, Class, Culler, Pose, SegmentClip, SegmentClipper};
use frusta::{Segment, VwProjection};
use mixes::{COUNT, Form, Mix, call, frustum};
use std::hint::black_box;
use std::time::Instant;
use turns::{Pass, take_turns};

/// How many are asked about with one call.
const PIECE: usize = 4096;

/// What does not fit in caches.
const MANY: usize = 4_000_000;

/// Times what is done with so many, in nanoseconds each.
fn time(count: usize, mut work: impl FnMut()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_nanos() as f64 / count as f64
}

fn row(name: &str, names: &[&str], mut passes: Vec<Pass<'_>>, rounds: usize) -> Vec<(f64, f64)> {
    let turns = take_turns(&mut passes, rounds);
    print!("{name:28}");
    for (name, (time, ratio)) in names.iter().zip(&turns) {
        print!("  {name} {time:.2} ({ratio:.2})");
    }
    println!();
    turns
}

fn assert_intervals(culler: &Culler, all: &[Segment<f32>], intervals: &SegmentIntervals<f32>) {
    assert_eq!(intervals.len(), all.len());
    for (segment, (class, t0, t1)) in all.iter().zip(intervals.iter()) {
        let clip = culler.frustum().clip_segment(segment).expect("finite");
        assert_eq!(class, clip.class, "{segment:?}");
        let expected = clip.part.map_or((1.0, 0.0), |p| (p.entry.t, p.exit.t));
        assert_eq!((t0, t1), expected, "{segment:?}");
    }
}

fn segments_in_cache(rounds: usize) {
    println!("\nsegments, f32, in cache: ns (times as fast as exact V/W one by one)");
    let exact = VwProjection::exact(Accuracy::Fast);
    let mut ratios = Vec::new();
    for (place, pose) in Mix::poses() {
        let frustum = frustum(Form::Symmetric.shape(), &pose);
        let culler = &Culler::new(&frustum);
        for mix in Mix::ALL {
            let all = &mix.segments::<f32>(COUNT, &pose);
            let columns = &SegmentColumns::new(all);
            let mut intervals = SegmentIntervals::default();
            culler
                .clip_intervals(columns.range(0..all.len()), &mut intervals)
                .expect("finite");
            assert_intervals(culler, all, &intervals);
            if rounds == 4 {
                println!("unsure {}", intervals.unsure());
            }
            let mut clips: Vec<SegmentClip<f32>> = Vec::new();
            let passes: Vec<Pass<'_>> = vec![
                Box::new(|| {
                    time(COUNT, || {
                        all.iter().for_each(|s| {
                            let _ = black_box(&call(&exact, &frustum, s));
                        });
                    })
                }),
                Box::new(|| {
                    time(COUNT, || {
                        for piece in all.chunks(PIECE) {
                            exact
                                .clip_segments(&frustum, piece, &mut clips)
                                .expect("finite");
                            black_box(&clips);
                        }
                    })
                }),
                Box::new(|| {
                    time(COUNT, || {
                        for start in (0..COUNT).step_by(PIECE) {
                            let piece = columns.range(start..start + PIECE);
                            culler
                                .clip_intervals(piece, &mut intervals)
                                .expect("finite");
                            black_box(&intervals);
                        }
                    })
                }),
            ];
            let name = format!("{} in the {place}", mix.name());
            let turns = row(&name, &["one by one", "slice", "batch"], passes, rounds);
            ratios.push(turns[2].1);
        }
    }
    let mean = ratios.iter().map(|r| r.ln()).sum::<f64>() / ratios.len() as f64;
    println!("geometric mean of the batch's: {:.2}", mean.exp());
}

fn segments_out_of_cache(rounds: usize) {
    println!("\nsegments, f32, out of cache: ns (times as fast as a copy of their bytes)");
    for mix in Mix::ALL {
        let pose = Pose::IDENTITY;
        let culler = &Culler::new(&frustum(Form::Symmetric.shape(), &pose));
        let columns = &SegmentColumns::new(&mix.segments::<f32>(MANY, &pose));
        let mut copy = columns.clone();
        let mut intervals = SegmentIntervals::default();
        let passes: Vec<Pass<'_>> = vec![
            Box::new(|| {
                time(MANY, || {
                    copy.copy_from(columns);
                    black_box(&copy);
                })
            }),
            Box::new(|| {
                time(MANY, || {
                    culler
                        .clip_intervals(columns.range(0..MANY), &mut intervals)
                        .expect("finite");
                    black_box(&intervals);
                })
            }),
        ];
        row(mix.name(), &["copy", "batch"], passes, rounds);
    }
}

fn boxes(rounds: usize) {
    println!("\nboxes, f32, out of cache: ns (times as fast as reading their bytes)");
    let frustum = frustum(Form::Symmetric.shape(), &Pose::IDENTITY);
    let culler = &Culler::new(&frustum);
    for (name, size) in [("small", 0.02), ("large", 0.5)] {
        let boxes = &BoxColumns::about(&frustum, size, MANY);
        let (mut masks, mut list) = (ContainmentMasks::default(), Vec::new());
        culler.mask_boxes(boxes.all(), &mut masks).expect("boxes");
        for i in (0..MANY).step_by(97) {
            let one = culler.classify(boxes.get(i)).expect("a box");
            assert_eq!(masks.get(i), Some(one), "{:?}", boxes.get(i));
        }
        let passes: Vec<Pass<'_>> = vec![
            Box::new(|| {
                time(MANY, || {
                    let _ = black_box(boxes.sum());
                })
            }),
            Box::new(|| {
                time(MANY, || {
                    culler.mask_boxes(boxes.all(), &mut masks).expect("boxes")
                })
            }),
            Box::new(|| {
                time(MANY, || {
                    culler.visible_boxes(boxes.all(), &mut list).expect("boxes")
                })
            }),
        ];
        row(name, &["read", "masks", "list"], passes, rounds);
    }
}

fn threads(rounds: usize) {
    let count = rayon::current_num_threads();
    println!("\n{count} threads: ns (times as fast as one)");
    let pose = Pose::IDENTITY;
    let frustum = frustum(Form::Symmetric.shape(), &pose);
    let culler = &Culler::new(&frustum);
    let mix = Mix::ALL[1];
    let columns = &SegmentColumns::new(&mix.segments::<f32>(MANY, &pose));
    let boxes = &BoxColumns::about(&frustum, 0.02, MANY);
    let mut copy = columns.clone();
    let (mut one, mut many) = (SegmentIntervals::default(), SegmentIntervals::default());
    culler
        .clip_intervals(columns.range(0..MANY), &mut one)
        .expect("finite");
    culler
        .par_clip_intervals(columns.range(0..MANY), &mut many)
        .expect("finite");
    assert!(one == many && one.classes().contains(&Class::Cross));
    let mut other = columns.clone();
    let copies: Vec<Pass<'_>> = vec![
        Box::new(|| time(MANY, || copy.copy_from(columns))),
        Box::new(|| time(MANY, || other.par_copy_from(columns))),
    ];
    row("a copy, out of cache", &["one", "all"], copies, rounds);
    let passes: Vec<Pass<'_>> = vec![
        Box::new(|| {
            time(MANY, || {
                culler
                    .clip_intervals(columns.range(0..MANY), &mut one)
                    .expect("finite")
            })
        }),
        Box::new(|| {
            time(MANY, || {
                culler
                    .par_clip_intervals(columns.range(0..MANY), &mut many)
                    .expect("finite")
            })
        }),
    ];
    row("segments, out of cache", &["one", "all"], passes, rounds);
    let (mut one, mut many) = (SegmentIntervals::default(), SegmentIntervals::default());
    let passes: Vec<Pass<'_>> = vec![
        Box::new(|| {
            time(COUNT, || {
                culler
                    .clip_intervals(columns.range(0..COUNT), &mut one)
                    .expect("finite")
            })
        }),
        Box::new(|| {
            time(COUNT, || {
                culler
                    .par_clip_intervals(columns.range(0..COUNT), &mut many)
                    .expect("finite")
            })
        }),
    ];
    row("segments, in cache", &["one", "all"], passes, rounds);
    let (mut one, mut many) = (ContainmentMasks::default(), ContainmentMasks::default());
    for (name, count) in [("boxes, out of cache", MANY), ("boxes, in cache", COUNT)] {
        let passes: Vec<Pass<'_>> = vec![
            Box::new(|| {
                time(count, || {
                    culler
                        .mask_boxes(boxes.range(0..count), &mut one)
                        .expect("boxes")
                })
            }),
            Box::new(|| {
                time(count, || {
                    culler
                        .par_mask_boxes(boxes.range(0..count), &mut many)
                        .expect("boxes")
                })
            }),
        ];
        row(name, &["one", "all"], passes, rounds);
        assert!(one == many && one.visible().count() > count / 100);
    }
}

fn main() {
    // Cargo passes --bench, too.
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rounds = args.iter().find_map(|arg| arg.parse().ok());
    let rounds = rounds.unwrap_or(10_usize).max(1);
    let parts = ["segments", "boxes", "threads"];
    let asked = args.iter().find(|arg| parts.contains(&arg.as_str()));
    let wanted = |part: &str| asked.is_none_or(|asked| asked == part);
    if wanted("segments") {
        segments_in_cache(rounds);
        segments_out_of_cache(rounds);
    }
    if wanted("boxes") {
        boxes(rounds);
    }
    if wanted("threads") {
        threads(rounds);
    }
}
