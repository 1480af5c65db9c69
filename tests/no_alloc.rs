//! Clipping allocates nothing, except where big integers are needed.

#[path = "../benches/mixes/mod.rs"]
#[expect(dead_code, unused_imports, reason = "the benchmarks need more of it")]
mod mixes;

use frusta::samples::{BLOCK, Family, Placement};
use frusta::{Accuracy, Frustum, Pose, Real, Segment, StageCounts};
use mixes::{Form, Mix, frustum, poses, samples};

/// Allocations while a segment is clipped, and what it needed.
fn clip<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
) -> (u64, StageCounts) {
    let mut counts = StageCounts::default();
    let info = allocation_counter::measure(|| {
        let clipped = frustum.clip_segment_counted(segment, accuracy, &mut counts);
        assert!(clipped.is_ok());
    });
    (info.count_total, counts)
}

/// How many segments were clipped without and with allocations.
#[derive(Debug, Default)]
struct Tally {
    without: u64,
    with: u64,
}

impl Tally {
    fn add<T: Real>(&mut self, frustum: &Frustum, segment: &Segment<T>) {
        for accuracy in [Accuracy::Fast, Accuracy::Nearest] {
            let (allocations, counts) = clip(frustum, segment, accuracy);
            if allocations == 0 {
                self.without += 1;
            } else {
                assert!(
                    counts.integers > 0,
                    "{accuracy:?}\n{frustum:?}\n{segment:?}"
                );
                self.with += 1;
            }
        }
    }
}

#[test]
fn the_counter_counts() {
    let info = allocation_counter::measure(|| drop(std::hint::black_box(vec![1, 2, 3])));
    assert_eq!(info.count_total, 1);
}

#[test]
fn realistic_mixes_allocate_nothing() {
    let mut tally = Tally::default();
    for (_, pose) in poses() {
        for form in Form::ALL {
            let frustum = frustum(form.shape(), &pose);
            for mix in Mix::ALL {
                for segment in mix.segments::<f64>(&pose) {
                    tally.add(&frustum, &segment);
                }
                for segment in mix.segments::<f32>(&pose) {
                    tally.add(&frustum, &segment);
                }
            }
        }
    }
    assert!(tally.without > 500_000, "{tally:?}");
    assert_eq!(tally.with, 0, "{tally:?}");
}

/// Touching and running along faces costs no allocation where the coordinates
/// are a designer's.
#[test]
fn the_singular_samples_allocate_nothing_in_the_frame() {
    let (frustum, segments) = samples::<f64>(&Placement::IDENTITY);
    assert_eq!(*frustum.pose(), Pose::IDENTITY);
    for segment in &segments {
        let (allocations, counts) = clip(&frustum, segment, Accuracy::Fast);
        assert_eq!((allocations, counts.integers), (0, 0), "{segment:?}");
    }
}

#[test]
fn only_big_integers_allocate_in_any_family() {
    let mut tally = Tally::default();
    for &family in Family::ALL {
        for block in 0..2 {
            let scene = family.scene(5, block);
            for index in block * BLOCK..(block + 1) * BLOCK {
                tally.add(scene.frustum(), &family.segment::<f64>(&scene, 5, index));
            }
        }
    }
    assert!(tally.without > tally.with, "{tally:?}");
    // Some families exist to need integers.
    assert!(tally.with > 100, "{tally:?}");
}
