//! The clippers' run times on a family.
//!
//! All clippers of a family take turns (`turns`), and go through the same list:
//! cases of several frusta, in an order that no branch predictor knows. An answer
//! is written where the compiler must assume that it is read.

use super::SurveyOptions;
use super::entrant::{AnyAlgorithm, AnyClipper, Entrant};
use crate::paper_timing::shuffle;
use crate::turns::{Timing, Turns};
use frusta::clip::StageCounts;
use frusta::frustum::Frustum;
use frusta::math::{Real, Segment};
use frusta::samples::{BLOCK, Family, Random};
use std::hint::black_box;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// How many frusta the cases are from.
const SCENES: u64 = 16;

/// What is clipped.
struct Cases {
    frusta: Vec<Frustum>,
    in_f32: Vec<(usize, Segment<f32>)>,
    in_f64: Vec<(usize, Segment<f64>)>,
}

impl Cases {
    fn new(family: Family, options: &SurveyOptions) -> Self {
        let (seed, count) = (options.seed, u64::from(options.timed));
        let scenes: Vec<_> = (0..SCENES).map(|block| family.scene(seed, block)).collect();
        let mut order: Vec<u64> = (0..count).collect();
        shuffle(&mut order, &mut Random::new(&[family as u64, seed]));
        // The n-th case is number n / SCENES of scene n % SCENES.
        let place = |n: u64| {
            (
                (n % SCENES) as usize,
                n % SCENES * BLOCK + n / SCENES % BLOCK,
            )
        };
        let in_f32 = |n: &u64| {
            let (scene, case) = place(*n);
            (scene, family.segment(&scenes[scene], seed, case))
        };
        let in_f64 = |n: &u64| {
            let (scene, case) = place(*n);
            (scene, family.segment(&scenes[scene], seed, case))
        };
        Self {
            frusta: scenes.iter().map(|s| s.frustum().clone()).collect(),
            in_f32: if family.has_f32() {
                order.iter().map(in_f32).collect()
            } else {
                Vec::new()
            },
            in_f64: order.iter().map(in_f64).collect(),
        }
    }

    /// Nanoseconds a segment, of one pass.
    fn pass(&self, entrant: &Entrant) -> f64 {
        let time = AssertUnwindSafe(|| match &entrant.clipper {
            AnyClipper::Single(clipper) => pass(clipper.as_ref(), &self.frusta, &self.in_f32),
            AnyClipper::Double(clipper) => pass(clipper.as_ref(), &self.frusta, &self.in_f64),
        });
        // A panic was counted as a refusal; it has no time.
        catch_unwind(time).unwrap_or(0.0)
    }
}

/// The times of these clippers, in their order; `on_round` is called after each round.
pub(super) fn measure(
    entrants: &[&Entrant],
    family: Family,
    options: &SurveyOptions,
    on_round: impl Fn(),
) -> Vec<Timing> {
    let cases = Cases::new(family, options);
    let reference = entrants.iter().position(|e| e.is_reference()).unwrap_or(0);
    let mut turns = Turns::new(entrants.len());
    let time = |i: usize| cases.pass(entrants[i]);
    turns.take(options.rounds as usize, time, on_round);
    turns.timings(reference)
}

#[inline(never)]
fn pass<T: Real>(
    clipper: &AnyAlgorithm<T>,
    frusta: &[Frustum],
    cases: &[(usize, Segment<T>)],
) -> f64 {
    let mut counts = StageCounts::default();
    let start = Instant::now();
    for (frustum, segment) in cases {
        let _ = black_box(&clipper.clip_segment_counted(
            &frusta[*frustum],
            black_box(segment),
            &mut counts,
        ));
    }
    let time = start.elapsed().as_nanos().max(1) as f64;
    time / cases.len().max(1) as f64
}
