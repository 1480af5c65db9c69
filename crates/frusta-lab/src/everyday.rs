//! Everyday segments: the clippers' run times where hardly anything is singular.
//!
//! # What is measured
//! On each [`Mix`], in the view's frame and in the world of a turned camera, in `f64`:
//! Liang-Barsky, textbook and tuned, and V/W in plain arithmetic, exact V/W with
//! [`Accuracy::Fast`]; one segment a call, and all but the first over slices, into a
//! buffer that is used again. All are called through `dyn SegmentClipper` and take
//! [turns](super::turns). Branch predictors do not learn the order of [`FEW`] segments or more,
//! clipped over and over; fewer flatter clippers that branch.
//!
//! # Answers
//! All are compared before anything is timed. Those of the exact tier must be those
//! of another exact algorithm, one segment a call, to the bit, and the first of each
//! mix must agree with rational arithmetic; plain ones must have the same class,
//! sets and clipped flags.

use super::paper::Tier;
use super::paper_answers::Topology;
use super::turns::{Spread, Timing, Turns};
use frusta::clip::{
    Accuracy, LiangBarsky, LiangBarskyVariant, SegmentClip, SegmentClipper, VwProjection,
};
use frusta::frustum::Frustum;
use frusta::math::Segment;
use frusta::oracle::check;
use frusta::samples::Mix;
use std::hint::black_box;
use std::time::Instant;

/// Branch predictors learn the order of fewer segments.
const FEW: usize = 65_536;

/// How many of the exact answers to each mix are compared with the oracle, which takes
/// a thousand times as long as clipping.
const JUDGED: usize = 256;

/// The findings on everyday segments.
#[derive(Clone, Debug, PartialEq)]
pub struct Everyday {
    /// How many segments there were of each mix.
    pub segments: usize,
    /// The number of timed rounds.
    pub rounds: u32,
    /// Place by place and mix by mix, a row for each clipper and way of calling it, always in the
    /// same order; the first is the reference.
    pub rows: Vec<EverydayRow>,
}

/// A clipper on a mix, called in one way.
#[derive(Clone, Debug, PartialEq)]
pub struct EverydayRow {
    /// The segments.
    pub mix: Mix,
    /// The pose's name: [`Mix::poses`].
    pub place: &'static str,
    /// The clipper's name.
    pub algorithm: &'static str,
    /// Its arithmetic.
    pub tier: Tier,
    /// Whether it was called for slices, [`Everyday::SLICE`] segments each.
    pub slices: bool,
    /// The time; the ratio is to textbook Liang-Barsky in plain arithmetic, one
    /// segment a call.
    pub timing: Timing,
    /// The number of wrong answers. In the exact tier, an answer that differs from another
    /// algorithm's in any bit is wrong.
    pub wrong: usize,
}

impl Everyday {
    /// Segments in one call, over slices.
    pub const SLICE: usize = 1024;

    /// Whether every answer of the exact tier is right.
    pub fn exact_is_right(&self) -> bool {
        self.wrong(Tier::Exact) == 0
    }

    /// How many answers of a tier are wrong.
    pub fn wrong(&self, tier: Tier) -> usize {
        let rows = self.rows.iter().filter(|row| row.tier == tier);
        rows.map(|row| row.wrong).sum()
    }

    /// The rows of each mix at each place.
    pub fn by_mix(&self) -> impl Iterator<Item = &[EverydayRow]> {
        self.rows
            .chunk_by(|a, b| (a.mix, a.place) == (b.mix, b.place))
    }

    /// How many times as fast as textbook Liang-Barsky in plain arithmetic, one segment
    /// a call, a clipper is: the geometric mean over mixes and places.
    pub fn speed(&self, algorithm: &str, tier: Tier, slices: bool) -> Option<Spread> {
        let is_it =
            |row: &&EverydayRow| (row.algorithm, row.tier, row.slices) == (algorithm, tier, slices);
        let rows = self.rows.iter().filter(is_it);
        Spread::geometric_mean(rows.filter_map(EverydayRow::speed))
    }

    /// Whether there were so few segments that branch predictors learnt them, which
    /// flatters clippers that branch.
    pub fn flatters_branches(&self) -> bool {
        self.segments < FEW
    }
}

impl EverydayRow {
    /// How many times as fast as textbook Liang-Barsky; `None` if nothing was timed.
    pub fn speed(&self) -> Option<Spread> {
        self.timing.speed()
    }
}

/// Compares and times the clippers on this many segments of each mix; `on_round` is called after
/// each of [`everyday_rounds`].
///
/// ```
/// use frusta_lab::{Tier, everyday, everyday_rounds};
/// let mut rounds = 0;
/// let found = everyday(2_000, 1, || rounds += 1);
/// assert!(found.exact_is_right() && found.flatters_branches());
/// assert!(found.speed("vw", Tier::Exact, true).unwrap().median > 0.0);
/// assert_eq!(rounds, everyday_rounds(1));
/// ```
pub fn everyday(segments: usize, rounds: u32, mut on_round: impl FnMut()) -> Everyday {
    let mut rows = Vec::new();
    for (name, pose) in Mix::poses() {
        let Ok(frustum) = Frustum::new(pose, Mix::shape()) else {
            continue;
        };
        for mix in Mix::ALL {
            let place = Place::new(&frustum, mix.segments(segments, &pose));
            let entrants = Entrant::all();
            let wrong: Vec<usize> = entrants.iter().map(|e| place.wrong(e)).collect();
            let times = place.times(&entrants, rounds, &mut on_round);
            for ((entrant, wrong), timing) in entrants.into_iter().zip(wrong).zip(times) {
                rows.push(EverydayRow {
                    mix,
                    place: name,
                    algorithm: entrant.clipper.name(),
                    tier: entrant.tier,
                    slices: entrant.slices,
                    timing,
                    wrong,
                });
            }
        }
    }
    Everyday {
        segments,
        rounds,
        rows,
    }
}

/// How many rounds [`everyday`] goes through, warm-up included, if this many count on each mix.
pub fn everyday_rounds(rounds: u32) -> u64 {
    (Mix::poses().len() * Mix::ALL.len() * Turns::rounds(rounds as usize)) as u64
}

/// A clipper, and how it is called.
struct Entrant {
    tier: Tier,
    slices: bool,
    clipper: Box<dyn SegmentClipper<f64>>,
}

impl Entrant {
    fn new(tier: Tier, slices: bool, clipper: impl SegmentClipper<f64> + 'static) -> Self {
        Self {
            tier,
            slices,
            clipper: Box::new(clipper),
        }
    }

    /// All clippers; the first is the reference.
    fn all() -> Vec<Self> {
        use LiangBarskyVariant::{Textbook, Tuned};
        let textbook = Self::new(Tier::Plain, false, LiangBarsky::plain(Textbook));
        let others = [false, true].map(|slices| {
            [
                Self::new(Tier::Plain, slices, LiangBarsky::plain(Tuned)),
                Self::new(Tier::Plain, slices, VwProjection::plain()),
                Self::new(Tier::Exact, slices, VwProjection::exact(Accuracy::Fast)),
            ]
        });
        [textbook]
            .into_iter()
            .chain(others.into_iter().flatten())
            .collect()
    }

    /// One clip for each segment of a slice, in this way of calling; refused segments have none.
    #[inline(never)]
    fn clip(&self, frustum: &Frustum, slice: &[Segment<f64>], clips: &mut Vec<SegmentClip<f64>>) {
        if self.slices {
            // A refusal leaves no clips.
            let _ = self.clipper.clip_segments(frustum, slice, clips);
        } else {
            clips.clear();
            let one = |s| self.clipper.clip_segment(frustum, s);
            clips.extend(slice.iter().map_while(|s| one(s).ok()));
        }
    }
}

/// Segments, their frustum, and the answers of an exact clipper that is not timed.
struct Place<'a> {
    frustum: &'a Frustum,
    segments: Vec<Segment<f64>>,
    answers: Vec<SegmentClip<f64>>,
}

impl<'a> Place<'a> {
    fn new(frustum: &'a Frustum, segments: Vec<Segment<f64>>) -> Self {
        let other = LiangBarsky::exact(LiangBarskyVariant::Tuned, Accuracy::Fast);
        let mut answers = Vec::new();
        Entrant::new(Tier::Exact, false, other).clip(frustum, &segments, &mut answers);
        Self {
            frustum,
            segments,
            answers,
        }
    }

    /// How many of a clipper's answers are wrong.
    fn wrong(&self, entrant: &Entrant) -> usize {
        let mut clips = Vec::new();
        let mut wrong = self.segments.len() - self.answers.len();
        let slices = self
            .segments
            .chunks(Everyday::SLICE)
            .zip(self.answers.chunks(Everyday::SLICE));
        for (index, (slice, answers)) in slices.enumerate() {
            entrant.clip(self.frustum, slice, &mut clips);
            wrong += slice.len() - clips.len();
            for (i, (clip, answer)) in clips.iter().zip(answers).enumerate() {
                let judged = index * Everyday::SLICE + i < JUDGED;
                let right = match entrant.tier {
                    Tier::Plain => Topology::of_answer(clip) == Topology::of_answer(answer),
                    Tier::Exact => {
                        is_same(clip, answer) && (!judged || self.is_true(&slice[i], clip))
                    }
                };
                wrong += usize::from(!right);
            }
        }
        wrong
    }

    /// Whether rational arithmetic confirms the answer.
    fn is_true(&self, segment: &Segment<f64>, clip: &SegmentClip<f64>) -> bool {
        let violations = check(self.frustum, segment, Accuracy::Fast, clip);
        violations.is_ok_and(|violations| violations.is_empty())
    }

    fn times(&self, entrants: &[Entrant], rounds: u32, on_round: &mut dyn FnMut()) -> Vec<Timing> {
        let mut turns = Turns::new(entrants.len());
        let mut clips = Vec::with_capacity(Everyday::SLICE);
        let time = |i: usize| self.pass(&entrants[i], &mut clips);
        turns.take(rounds as usize, time, on_round);
        turns.timings(0)
    }

    /// Nanoseconds a segment, of one pass.
    #[inline(never)]
    fn pass(&self, entrant: &Entrant, clips: &mut Vec<SegmentClip<f64>>) -> f64 {
        let start = Instant::now();
        if entrant.slices {
            for slice in self.segments.chunks(Everyday::SLICE) {
                let _ = entrant.clipper.clip_segments(self.frustum, slice, clips);
                black_box(&*clips);
            }
        } else {
            for segment in &self.segments {
                let _ = black_box(&entrant.clipper.clip_segment(self.frustum, segment));
            }
        }
        let time = start.elapsed().as_nanos().max(1) as f64;
        time / self.segments.len().max(1) as f64
    }
}

/// Whether two answers are the same, their numbers to the bit.
fn is_same(a: &SegmentClip<f64>, b: &SegmentClip<f64>) -> bool {
    let numbers = |clip: &SegmentClip<f64>| {
        clip.part.map(|part| {
            [part.entry, part.exit].map(|end| {
                let [x, y, z] = end.point.to_array();
                [end.t, x, y, z].map(f64::to_bits)
            })
        })
    };
    a == b && numbers(a) == numbers(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::clip::StageCounts;
    use frusta::math::NonFinite;

    /// Exact V/W, its answers spoilt by a function.
    struct Spoilt(fn(&mut SegmentClip<f64>));

    impl SegmentClipper<f64> for Spoilt {
        fn name(&self) -> &'static str {
            "spoilt"
        }

        fn clip_segment_counted(
            &self,
            frustum: &Frustum,
            segment: &Segment<f64>,
            _: &mut StageCounts,
        ) -> Result<SegmentClip<f64>, NonFinite> {
            let mut clip = frustum.clip_segment(segment)?;
            (self.0)(&mut clip);
            Ok(clip)
        }
    }

    #[test]
    fn one_bit_is_noticed_in_exact_answers_and_a_class_in_all() {
        let [_, (_, pose)] = Mix::poses();
        let frustum = Frustum::new(pose, Mix::shape()).unwrap();
        let place = Place::new(&frustum, Mix::Mixed.segments(3_000, &pose));
        let cut = |clip: &&SegmentClip<f64>| clip.part.is_some_and(|p| p.exit.clipped);
        let [all, cut] = [3_000, place.answers.iter().filter(cut).count()];
        assert!(cut > 400);
        let bit: fn(&mut SegmentClip<f64>) = |clip| {
            if let Some(part) = &mut clip.part
                && part.exit.clipped
            {
                part.exit.point.x = part.exit.point.x.next_up();
            }
        };
        let swapped: fn(&mut SegmentClip<f64>) = |clip| {
            *clip = match clip.part {
                Some(_) => SegmentClip::OUTSIDE,
                None => SegmentClip {
                    class: frusta::Class::Touch,
                    part: None,
                },
            };
        };
        for slices in [false, true] {
            let wrong = |tier, spoil| place.wrong(&Entrant::new(tier, slices, Spoilt(spoil)));
            for tier in Tier::ALL {
                assert_eq!(wrong(tier, |_| ()), 0);
                assert_eq!(wrong(tier, swapped), all);
            }
            assert_eq!([wrong(Tier::Plain, bit), wrong(Tier::Exact, bit)], [0, cut]);
        }
    }

    #[test]
    fn the_oracle_judges_answers_that_all_agree_on() {
        let [(_, pose), _] = Mix::poses();
        let frustum = Frustum::new(pose, Mix::shape()).unwrap();
        let mut place = Place::new(&frustum, Mix::MostlyIn.segments(JUDGED + 200, &pose));
        let inside = |clip: &SegmentClip<f64>| clip.class == frusta::Class::Inside;
        let spoil: fn(&mut SegmentClip<f64>) = |clip| {
            if clip.class == frusta::Class::Inside {
                clip.class = frusta::Class::Boundary;
            }
        };
        let judged = place.answers[..JUDGED]
            .iter()
            .copied()
            .filter(inside)
            .count();
        assert!(judged > JUDGED / 2);
        place.answers.iter_mut().for_each(spoil);
        let entrant = Entrant::new(Tier::Exact, false, Spoilt(spoil));
        assert_eq!(place.wrong(&entrant), judged);
    }

    #[test]
    fn a_wrong_answer_spoils_the_exact_tier_alone() {
        let found = everyday(600, 0, || ());
        assert!(found.exact_is_right() && found.rows.len() == 7 * 8);
        for (i, row) in found.rows.iter().enumerate() {
            assert_eq!((row.wrong, row.timing), (0, Timing::default()));
            let mut spoilt = found.clone();
            spoilt.rows[i].wrong = 1;
            assert_eq!(spoilt.exact_is_right(), row.tier == Tier::Plain);
        }
        assert_eq!(found.speed("vw", Tier::Exact, false), None);
    }

    #[test]
    fn speeds_are_geometric_means_of_one_clipper_called_in_one_way() {
        let mut found = everyday(10, 0, || ());
        for (i, row) in found.rows.iter_mut().enumerate() {
            let is_it = row.algorithm == "vw" && row.tier == Tier::Exact && row.slices;
            row.timing.ratio = Spread::new(vec![match (is_it, i % 2) {
                (true, 0) => 0.25,
                (true, _) => 1.0,
                _ => 3.0,
            }]);
        }
        let speed = found.speed("vw", Tier::Exact, true).map(|s| s.median);
        assert_eq!(speed, Some(2.0));
        assert!(found.flatters_branches());
        found.segments = FEW;
        assert!(!found.flatters_branches());
    }
}
