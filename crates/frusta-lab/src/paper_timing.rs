//! The run times of the paper's table.
//!
//! The repeats are split into rounds, in which the clippers take [turns](super::turns).
//! All clippers are called the same way, through `dyn SegmentClipper`: whether the
//! compiler would inline one into this loop says nothing about it. A digest of every
//! answer is summed, and the sums must not change from pass to pass.
//!
//! The paper's procedure, the same samples in the same order over and over, lets
//! a processor's branch predictor learn them by heart, which flatters branches.
//! So each round is run on a shuffled sequence as well.

use super::paper::{Clipper, SOLID};
use super::turns::{Timing, Turns};
use frusta::clip::{SegmentClip, SegmentClipper};
use frusta::frustum::Frustum;
use frusta::math::{Real, Segment, Vec3};
use frusta::samples::{Placement, Random, singular_samples};
use std::hint::black_box;
use std::time::Instant;

/// Passes over the samples in a round: long against the clock's resolution,
/// short against the drift.
const PASSES: u32 = 100;

/// The measurements of one clipper.
pub(super) struct Measured {
    pub(super) in_order: Timing,
    pub(super) shuffled: Timing,
    pub(super) steady: bool,
}

/// The number of rounds for this many repeats.
pub(super) fn rounds(repeats: u32) -> u32 {
    repeats.div_ceil(PASSES)
}

/// Measures clippers; ratios are to the one with the index `reference`.
pub(super) fn measure<T: Real>(
    clippers: &[Clipper<T>],
    reference: usize,
    repeats: u32,
    on_round: &mut dyn FnMut(),
) -> Vec<Measured> {
    let Ok(frustum) = Placement::IDENTITY.place(&SOLID) else {
        return Vec::new();
    };
    let samples: Vec<Segment<T>> = singular_samples(&SOLID)
        .iter()
        .map(|s| {
            Segment::new(
                Vec3::from_f64(s.segment.start),
                Vec3::from_f64(s.segment.end),
            )
        })
        .collect();
    let sums: Vec<u64> = clippers
        .iter()
        .map(|(_, c)| pass(c.as_ref(), &frustum, &samples, 1).1)
        .collect();
    let mut steady = vec![true; clippers.len()];
    let mut turns = [(); 2].map(|()| Turns::new(clippers.len()));
    let mut random = Random::new(&[u64::from(repeats)]);
    for round in 0..rounds(repeats) {
        let passes = PASSES.min(repeats - round * PASSES);
        let mut sequence = samples.repeat(passes as usize);
        shuffle(&mut sequence, &mut random);
        for (turns, (segments, again)) in turns
            .iter_mut()
            .zip([(&samples[..], passes), (&sequence[..], 1)])
        {
            turns.round(|i| {
                let (time, sum) = pass(clippers[i].1.as_ref(), &frustum, segments, again);
                steady[i] &= sum == sums[i] * u64::from(passes);
                time
            });
        }
        on_round();
    }
    let [in_order, shuffled] = turns.map(|turns| turns.timings(reference));
    in_order
        .into_iter()
        .zip(shuffled)
        .zip(steady)
        .map(|((in_order, shuffled), steady)| Measured {
            in_order,
            shuffled,
            steady,
        })
        .collect()
}

/// Clips the segments several times: nanoseconds a segment, and a sum over the
/// answers.
#[inline(never)]
fn pass<T: Real>(
    clipper: &dyn SegmentClipper<T>,
    frustum: &Frustum,
    segments: &[Segment<T>],
    again: u32,
) -> (f64, u64) {
    let mut sum = 0;
    let start = Instant::now();
    for _ in 0..again {
        for segment in segments {
            let answer = clipper.clip_segment(frustum, segment);
            if let Ok(clip) = black_box(&answer) {
                sum += digest(clip);
            }
        }
    }
    let time = start.elapsed().as_nanos().max(1) as f64;
    let count = f64::from(again) * segments.len() as f64;
    (time / count, sum)
}

/// A digest of an answer.
#[inline(always)]
fn digest<T: Real>(clip: &SegmentClip<T>) -> u64 {
    let faces = clip
        .part
        .map_or(0, |p| p.entry.faces.bits() ^ p.exit.faces.bits());
    clip.class as u64 + u64::from(faces)
}

/// Fisher-Yates.
pub(super) fn shuffle<T>(values: &mut [T], random: &mut Random) {
    for i in (1..values.len()).rev() {
        values.swap(i, random.below(i as u64 + 1) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Tier;
    use frusta::clip::{StageCounts, VwProjection};
    use frusta::math::NonFinite;
    use std::cell::Cell;

    #[test]
    fn shuffles_keep_what_there_is() {
        let mut values: Vec<u32> = (0..100).collect();
        shuffle(&mut values, &mut Random::new(&[1]));
        assert!(!values.is_sorted());
        values.sort_unstable();
        assert!(values.iter().copied().eq(0..100));
    }

    /// Answers otherwise once in a thousand times.
    struct Unsteady(Cell<u32>);

    impl SegmentClipper<f64> for Unsteady {
        fn name(&self) -> &'static str {
            "unsteady"
        }

        fn clip_segment_counted(
            &self,
            frustum: &Frustum,
            segment: &Segment<f64>,
            _: &mut StageCounts,
        ) -> Result<SegmentClip<f64>, NonFinite> {
            self.0.set(self.0.get() + 1);
            if self.0.get().is_multiple_of(1000) {
                Ok(SegmentClip::OUTSIDE)
            } else {
                VwProjection::plain().clip_segment(frustum, segment)
            }
        }
    }

    #[test]
    fn a_changed_answer_is_noticed() {
        let clippers: [Clipper<f64>; 2] = [
            (Tier::Plain, Box::new(VwProjection::plain())),
            (Tier::Plain, Box::new(Unsteady(Cell::new(0)))),
        ];
        let mut heard = 0;
        let measured = measure(&clippers, 0, 250, &mut || heard += 1);
        assert_eq!((heard, rounds(250)), (3, 3));
        assert!(measured[0].steady && !measured[1].steady);
        assert_eq!(measured[0].in_order.ratio.median, 1.0);
        assert!(measured[1].shuffled.nanoseconds > 0.0);
    }
}
