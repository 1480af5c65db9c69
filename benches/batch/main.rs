//! Many segments or volumes a call, as ratios: to one a call, to reading or copying their bytes,
//! and with threads to without.
//!
//! `cargo bench --features parallel --bench batch [-- ROUNDS] [segments|boxes|exact|shadows|threads]`. All
//! take turns, a ratio is taken within each round, and medians over the rounds are printed.
//! First, every answer is compared with that of one a call.
//!
//! *In cache* are 262,144 of them, which branch predictors cannot learn, 4,096 a call, as in a
//! program that goes on with the answers; *out of cache* four million with one call.

mod data;
mod separating;
mod shadows;

use data::{BoxColumns, SegmentColumns};
use frusta::clip::{SegmentClipper, SegmentIntervals, VwProjection};
use frusta::cull::{BoxSet, ContainmentMasks};
use frusta::{Aabb, Accuracy, Class, Containment, Culler, Pose, Segment, SegmentClip};
use frusta_lab::mixes::{COUNT, Form, Mix, call, frustum};
use frusta_lab::turns::{Pass, Spread, geometric_mean, take_turns};
use separating::SeparatingAxes;
use std::hint::black_box;
use std::time::Instant;

/// Number of segments or volumes a call.
const PIECE: usize = 4096;

/// Number of segments or volumes that do not fit in caches.
const MANY: usize = 4_000_000;

/// A pass of work on `count` items, in nanoseconds each.
fn timed<'a>(count: usize, mut work: impl FnMut() + 'a) -> Pass<'a> {
    Box::new(move || {
        let start = Instant::now();
        work();
        start.elapsed().as_nanos() as f64 / count as f64
    })
}

/// Prints times and how many times as fast as the first each is, and returns the latter.
fn row(name: &str, rounds: usize, all: Vec<(&str, Pass<'_>)>) -> Vec<f64> {
    let (names, mut passes): (Vec<_>, Vec<_>) = all.into_iter().unzip();
    let turns = take_turns(&mut passes, rounds);
    print!("{name:28}");
    let speeds: Vec<Spread> = turns.iter().map(|timing| timing.ratio.inverse()).collect();
    for ((name, timing), speed) in names.iter().zip(&turns).zip(&speeds) {
        print!("  {name} {:.2} ({:.2})", timing.nanoseconds, speed.median);
    }
    println!();
    speeds.into_iter().map(|speed| speed.median).collect()
}

/// Compares all intervals with single clips.
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
            let done = culler.clip_intervals(columns.range(0..COUNT), &mut intervals);
            done.expect("finite");
            assert_intervals(culler, all, &intervals);
            let mut clips: Vec<SegmentClip<f32>> = Vec::new();
            let one_by_one = timed(COUNT, || {
                for segment in all {
                    let _ = black_box(&call(&exact, &frustum, segment));
                }
            });
            let slice = timed(COUNT, || {
                for piece in all.chunks(PIECE) {
                    let done = exact.clip_segments(&frustum, piece, &mut clips);
                    done.expect("finite");
                    black_box(&clips);
                }
            });
            let batch = timed(COUNT, || {
                for start in (0..COUNT).step_by(PIECE) {
                    let piece = columns.range(start..start + PIECE);
                    let done = culler.clip_intervals(piece, &mut intervals);
                    done.expect("finite");
                    black_box(&intervals);
                }
            });
            let passes = vec![
                ("one by one", one_by_one),
                ("slice", slice),
                ("batch", batch),
            ];
            let name = format!("{} in the {place}", mix.name());
            ratios.push(row(&name, rounds, passes)[2]);
        }
    }
    let mean = geometric_mean(ratios).unwrap_or_default();
    println!("the batch, geometric mean: {mean:.2}");
}

fn segments_out_of_cache(rounds: usize) {
    println!("\nsegments, f32, out of cache: ns (times as fast as a copy of their bytes)");
    for mix in Mix::ALL {
        let pose = Pose::IDENTITY;
        let culler = &Culler::new(&frustum(Form::Symmetric.shape(), &pose));
        let columns = &SegmentColumns::new(&mix.segments::<f32>(MANY, &pose));
        let mut to = columns.clone();
        let copy = timed(MANY, || to.copy_from(columns));
        let mut intervals = SegmentIntervals::default();
        let batch = timed(MANY, || {
            let done = culler.clip_intervals(columns.range(0..MANY), &mut intervals);
            done.expect("finite");
        });
        let mut by_all = SegmentIntervals::default();
        let threads = timed(MANY, || {
            let done = culler.par_clip_intervals(columns.range(0..MANY), &mut by_all);
            done.expect("finite");
        });
        let passes = vec![("copy", copy), ("batch", batch), ("by threads", threads)];
        row(mix.name(), rounds, passes);
    }
}

/// Times masks and lists of boxes from arrays and from a set.
fn boxes_of(name: &str, rounds: usize, culler: &Culler, all: &BoxColumns, piece: usize) {
    let sets: Vec<BoxSet<f32>> = all.pieces(piece).map(|range| all.set(range)).collect();
    let mut masks: [ContainmentMasks; 2] = Default::default();
    let mut lists: [Vec<u32>; 2] = Default::default();
    for (range, set) in all.pieces(piece).zip(&sets) {
        let arrays = all.range(range.clone());
        culler.over(arrays).masks(&mut masks[0]).expect("boxes");
        culler.over(set).masks(&mut masks[1]).expect("boxes");
        culler.over(arrays).visible(&mut lists[0]).expect("boxes");
        culler.over(set).visible(&mut lists[1]).expect("boxes");
        assert!(masks[0] == masks[1] && lists[0] == lists[1]);
        assert!(masks[0].visible().eq(lists[0].iter().map(|&i| i as usize)));
        for (i, index) in range.enumerate() {
            let one = culler.classify(all.get(index)).expect("a box");
            assert_eq!(masks[0].get(i), Some(one), "{:?}", all.get(index));
        }
    }
    let [masks, masks_of_set] = &mut masks;
    let [list, list_of_set] = &mut lists;
    let count = all.len();
    let read = timed(count, || {
        let _ = black_box(all.sum());
    });
    let masks = timed(count, || {
        for range in all.pieces(piece) {
            let query = culler.over(all.range(range));
            query.masks(masks).expect("boxes");
        }
    });
    let list = timed(count, || {
        for range in all.pieces(piece) {
            let query = culler.over(all.range(range));
            query.visible(list).expect("boxes");
        }
    });
    let masks_of_set = timed(count, || {
        for set in &sets {
            culler.over(set).masks(masks_of_set).expect("boxes");
        }
    });
    let list_of_set = timed(count, || {
        for set in &sets {
            culler.over(set).visible(list_of_set).expect("boxes");
        }
    });
    let passes = vec![
        ("read", read),
        ("masks", masks),
        ("list", list),
        ("masks of a set", masks_of_set),
        ("list of a set", list_of_set),
    ];
    row(name, rounds, passes);
}

fn boxes(rounds: usize) {
    println!("\nboxes, f32: ns (times as fast as reading their bytes)");
    let frustum = frustum(Form::Symmetric.shape(), &Pose::IDENTITY);
    let culler = &Culler::new(&frustum);
    for (name, size) in [("small", 0.02), ("large", 0.5)] {
        let some = BoxColumns::about(&frustum, size, COUNT);
        boxes_of(&format!("{name}, in cache"), rounds, culler, &some, PIECE);
        let many = BoxColumns::about(&frustum, size, MANY);
        boxes_of(
            &format!("{name}, out of cache"),
            rounds,
            culler,
            &many,
            MANY,
        );
    }
}

/// One box a call, exactly, compared with separating axes in plain arithmetic.
fn exact(rounds: usize) {
    println!("\nwhether a box meets the frustum, f32: ns (times as fast as the plain loop)");
    for (place, pose) in Mix::poses() {
        let frustum = frustum(Form::Symmetric.shape(), &pose);
        let culler = &Culler::new(&frustum);
        for (name, size) in [("small", 0.02), ("large", 0.5)] {
            let columns = BoxColumns::about(&frustum, size, COUNT);
            let all: Vec<Aabb<f32>> = (0..COUNT).map(|i| columns.get(i)).collect();
            let crosses = |b: &&Aabb<f32>| culler.classify(**b) == Ok(Containment::Crossing);
            let crossing: Vec<Aabb<f32>> = all.iter().filter(crosses).copied().collect();
            exact_of(&format!("{name}, {place}, all"), rounds, culler, &all);
            let name = format!("{name}, {place}, crossing");
            exact_of(&name, rounds, culler, &crossing);
        }
    }
}

fn exact_of(name: &str, rounds: usize, culler: &Culler, all: &[Aabb<f32>]) {
    let axes = &SeparatingAxes::new(culler.frustum());
    let meets = |b: &Aabb<f32>| culler.classify_exact(*b) != Ok(Containment::Outside);
    // Plain arithmetic may be wrong where a box touches.
    let differ =
        |rival: &dyn Fn(&Aabb<f32>) -> bool| all.iter().filter(|b| rival(b) != meets(b)).count();
    assert!(differ(&|b| axes.meets(b)) < 9 && differ(&|b| axes.meets_slabs(b)) < 9);
    let each = |meets: &dyn Fn(&Aabb<f32>) -> bool| {
        let visible = all.iter().filter(|b| meets(black_box(b))).count();
        black_box(visible);
    };
    let plain = timed(all.len(), || each(&|b| axes.meets(b)));
    let slabs = timed(all.len(), || each(&|b| axes.meets_slabs(b)));
    let exact = timed(all.len(), || each(&meets));
    let passes = vec![("plain loop", plain), ("slabs", slabs), ("exact", exact)];
    row(name, rounds, passes);
}

fn segments_by_threads(
    name: &str,
    rounds: usize,
    culler: &Culler,
    segments: &SegmentColumns,
    count: usize,
) {
    let (mut one, mut all): (SegmentIntervals<f32>, _) = Default::default();
    let range = || segments.range(0..count);
    culler.clip_intervals(range(), &mut one).expect("finite");
    culler
        .par_clip_intervals(range(), &mut all)
        .expect("finite");
    assert!(one == all && one.classes().contains(&Class::Cross));
    let by_one = timed(count, || {
        culler.clip_intervals(range(), &mut one).expect("finite")
    });
    let by_all = timed(count, || {
        culler
            .par_clip_intervals(range(), &mut all)
            .expect("finite")
    });
    row(name, rounds, vec![("one", by_one), ("all", by_all)]);
}

fn threads(rounds: usize) {
    let threads = rayon::current_num_threads();
    println!("\n{threads} threads: ns (times as fast as one)");
    let pose = Pose::IDENTITY;
    let frustum = frustum(Form::Symmetric.shape(), &pose);
    let culler = &Culler::new(&frustum);
    let segments = &SegmentColumns::new(&Mix::ALL[1].segments::<f32>(MANY, &pose));
    let boxes = &BoxColumns::about(&frustum, 0.02, MANY);
    let (mut to, mut to_by_all) = (segments.clone(), segments.clone());
    let copy = timed(MANY, || to.copy_from(segments));
    let copy_by_all = timed(MANY, || to_by_all.par_copy_from(segments));
    row("a copy", rounds, vec![("one", copy), ("all", copy_by_all)]);
    // More work than reading.
    let long = SegmentColumns::new(&Mix::ALL[3].segments::<f32>(MANY, &pose));
    segments_by_threads("long segments", rounds, culler, &long, MANY);
    for (place, count) in [("out of", MANY), ("in", COUNT)] {
        let name = format!("segments, {place} cache");
        segments_by_threads(&name, rounds, culler, segments, count);

        let (mut one, mut all): (ContainmentMasks, _) = Default::default();
        let set = &boxes.set(0..count);
        culler.over(set).masks(&mut one).expect("boxes");
        let query = culler.over(set).parallel();
        query.masks(&mut all).expect("boxes");
        assert!(one == all && one.visible().count() > count / 100);
        let by_one = timed(count, || culler.over(set).masks(&mut one).expect("boxes"));
        let by_all = timed(count, || {
            let query = culler.over(set).parallel();
            query.masks(&mut all).expect("boxes")
        });
        let name = format!("boxes, {place} cache");
        row(&name, rounds, vec![("one", by_one), ("all", by_all)]);
    }
}

fn main() {
    // Cargo passes --bench, too.
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rounds = args.iter().find_map(|arg| arg.parse().ok());
    let rounds = rounds.unwrap_or(10_usize).max(1);
    let parts = ["segments", "boxes", "exact", "shadows", "threads"];
    let chosen = args.iter().find(|arg| parts.contains(&arg.as_str()));
    let wanted = |part: &str| chosen.is_none_or(|chosen| chosen == part);
    if wanted("segments") {
        segments_in_cache(rounds);
        segments_out_of_cache(rounds);
    }
    if wanted("boxes") {
        boxes(rounds);
    }
    if wanted("exact") {
        exact(rounds);
    }
    if wanted("shadows") {
        shadows::print(rounds);
    }
    if wanted("threads") {
        threads(rounds);
    }
}
