//! Over slices, as ratios to tuned Liang-Barsky.
//!
//! All write one clip for each segment into the same buffer, a thousand segments at a time, as a
//! program does that uses the clips while they are in the cache. The clippers take turns; medians
//! over rounds are printed. First every answer of a slice is compared with that of the segment alone.

use frusta::clip::{LiangBarsky, LiangBarskyVariant, SegmentClipper, VwProjection};
use frusta::{Accuracy, Frustum, Real, Segment, SegmentClip};
use frusta_lab::mixes::{self, COUNT, Form, Mix, frustum};
use frusta_lab::turns::{Pass, take_turns};
use std::hint::black_box;
use std::time::Instant;

/// Segments clipped with one call.
const PIECE: usize = 1024;

/// Times one pass over the segments, in nanoseconds each.
fn pass<T: Real>(clipper: impl SegmentClipper<T>, f: &Frustum, all: &[Segment<T>]) -> f64 {
    let mut clips = Vec::with_capacity(PIECE);
    let start = Instant::now();
    for piece in all.chunks(PIECE) {
        slice(&clipper, f, piece, &mut clips);
        black_box(&clips);
    }
    start.elapsed().as_nanos() as f64 / all.len() as f64
}

/// A call like any other.
#[inline(never)]
fn slice<T: Real>(
    clipper: &impl SegmentClipper<T>,
    frustum: &Frustum,
    segments: &[Segment<T>],
    clips: &mut Vec<SegmentClip<T>>,
) {
    let done = clipper.clip_segments(frustum, segments, clips);
    done.expect("finite");
}

/// Asserts that a slice is clipped as its segments are, to the bit.
fn assert_same<T: Real>(clipper: &impl SegmentClipper<T>, f: &Frustum, all: &[Segment<T>]) {
    let mut clips = Vec::new();
    slice(clipper, f, all, &mut clips);
    assert_eq!(clips.len(), all.len());
    for (segment, clip) in all.iter().zip(&clips) {
        let single = clipper.clip_segment(f, segment).expect("finite");
        assert_eq!(*clip, single, "{} of {segment:?}", clipper.name());
    }
}

fn row<T: Real>(frustum: &Frustum, all: &[Segment<T>], rounds: usize) {
    use LiangBarskyVariant::{Textbook, Tuned};
    assert_same(&VwProjection::plain(), frustum, all);
    assert_same(&VwProjection::exact(Accuracy::Fast), frustum, all);
    assert_same(&LiangBarsky::plain(Tuned), frustum, all);
    let mut passes: [Pass<'_>; 4] = [
        Box::new(|| pass(LiangBarsky::plain(Tuned), frustum, all)),
        Box::new(|| pass(LiangBarsky::plain(Textbook), frustum, all)),
        Box::new(|| pass(VwProjection::plain(), frustum, all)),
        Box::new(|| pass(VwProjection::exact(Accuracy::Fast), frustum, all)),
    ];
    for timing in take_turns(&mut passes, rounds) {
        print!(
            " {:6.1} ({:5.2})",
            timing.nanoseconds,
            timing.ratio.inverse().median
        );
    }
    println!();
}

fn table<T: Real>(scalar: &str, form: Form, rounds: usize) {
    for (place, pose) in Mix::poses() {
        println!("\n{scalar}, {}, in the {place}", form.name());
        println!(
            "{:14} {:>14} {:>14} {:>14} {:>14}",
            "", "tuned", "textbook", "vw", "vw-exact"
        );
        let frustum = frustum(form.shape(), &pose);
        for mix in Mix::ALL {
            print!("{:14}", mix.name());
            row::<T>(&frustum, &mix.segments(COUNT, &pose), rounds);
        }
    }
}

/// All tables.
pub(super) fn print(rounds: usize) {
    println!("\nSlices; in brackets how many times as fast as tuned Liang-Barsky");
    table::<f64>("f64", Form::Symmetric, rounds);
    table::<f32>("f32", Form::Symmetric, rounds);
    for form in &Form::ALL[1..] {
        table::<f64>("f64", *form, rounds);
    }
    for case in mixes::singular() {
        println!("\nf64, the 78 singular samples, in the {}", case.place);
        print!("{:14}", "");
        row(&case.frustum, &case.segments, rounds);
    }
}
