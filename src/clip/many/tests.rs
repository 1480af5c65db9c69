//! Slices compared with single segments, to the bit, at every vector width.

use super::*;
use crate::clip::{SegmentClipper, VwProjection};
use crate::frustum::{EndRect, Shape};
use crate::math::Pose;
use crate::samples::{BLOCK, Family};
use crate::simd::levels;

/// The families compared: under Miri, which takes a thousand times as long, two
/// that between them reach every queue.
fn families() -> Vec<Family> {
    if cfg!(miri) {
        return vec![Family::Random, Family::HalfLattice];
    }
    Family::ALL.to_vec()
}

/// Compares a family's first cases, a scene at a time, in slices of many lengths.
fn compare<T: Real>(
    family: Family,
    clip: impl Fn(&Frustum, &[Segment<T>], &mut Vec<SegmentClip<T>>, &mut StageCounts),
    single: &dyn SegmentClipper<T>,
    blocks: u64,
) {
    let mut clips = Vec::new();
    let (blocks, cases_each) = if cfg!(miri) { (1, 5) } else { (blocks, BLOCK) };
    for block in 0..blocks {
        let scene = family.scene(7, block);
        let frustum = scene.frustum();
        let cases = block * BLOCK..block * BLOCK + cases_each;
        let segments: Vec<Segment<T>> = cases.map(|i| family.segment(&scene, 7, i)).collect();
        // More than a block, so that each segment takes every place in a group.
        let many: Vec<_> = (0..5).flat_map(|k| &segments[k..]).copied().collect();
        let length = many.len() - block as usize % 5;
        let (mut counts, mut expected_counts) = Default::default();
        clip(frustum, &many[..length], &mut clips, &mut counts);
        assert_eq!(clips.len(), length);
        for (segment, clip) in many.iter().zip(&clips) {
            let expected = single.clip_segment_counted(frustum, segment, &mut expected_counts);
            let expected = expected.expect("finite");
            assert_eq!(
                format!("{clip:?}"),
                format!("{expected:?}"),
                "{family}: {segment:?}"
            );
        }
        assert_eq!(counts, expected_counts, "{family}");
    }
}

fn compare_exact<T: Real>(family: Family, level: Level, accuracy: Accuracy, blocks: u64) {
    let clip = |f: &Frustum, s: &[Segment<T>], c: &mut Vec<_>, counts: &mut StageCounts| {
        clip_exact(level, f, s.into(), accuracy, c, counts).expect("finite");
    };
    compare(family, clip, &VwProjection::exact(accuracy), blocks);
}

#[test]
fn exact_slices_have_the_bits_of_single_segments() {
    for family in families() {
        for level in levels() {
            compare_exact::<f64>(family, level, Accuracy::Fast, 6);
            if family.has_f32() {
                compare_exact::<f32>(family, level, Accuracy::Fast, 3);
            }
        }
        for accuracy in [Accuracy::Nearest, Accuracy::Inward] {
            compare_exact::<f64>(family, Level::new(), accuracy, 1);
        }
    }
}

fn compare_plain<T: Real>(family: Family, level: Level, blocks: u64) {
    let clip = |f: &Frustum, s: &[Segment<T>], c: &mut Vec<_>, _: &mut StageCounts| {
        clip_plain(level, f, s, c).expect("finite");
    };
    compare(family, clip, &VwProjection::plain(), blocks);
}

#[test]
fn plain_slices_have_the_bits_of_single_segments() {
    for family in families() {
        for level in levels() {
            compare_plain::<f64>(family, level, 12);
            if family.has_f32() {
                compare_plain::<f32>(family, level, 12);
            }
        }
    }
}

/// A group that is not whole repeats its last segment: one of zero length must not be counted
/// again.
#[test]
fn segments_of_zero_length_are_counted_once() {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    // On a face, so that no sign is certain at once.
    let points = [
        [2.0, 0.0, 2.0],
        [0.0, 2.0, 2.0],
        [1.0, 1.0, 1.0],
        [0.5, 0.0, 1.0],
    ];
    let segments: Vec<Segment<f64>> = (0..11)
        .map(|i| points[i % 4])
        .map(|p| Segment::new(p, p))
        .collect();
    let single = VwProjection::exact(Accuracy::Fast);
    for level in levels() {
        for count in 0..=segments.len() {
            let (mut clips, mut counts) = (Vec::new(), StageCounts::default());
            let some = &segments[..count];
            clip_exact(
                level,
                &frustum,
                some.into(),
                Accuracy::Fast,
                &mut clips,
                &mut counts,
            )
            .unwrap();
            let mut expected = StageCounts::default();
            for (segment, clip) in some.iter().zip(&clips) {
                let one = single.clip_segment_counted(&frustum, segment, &mut expected);
                assert_eq!(one.as_ref(), Ok(clip));
            }
            assert_eq!(counts, expected, "{count} segments");
        }
    }
}
