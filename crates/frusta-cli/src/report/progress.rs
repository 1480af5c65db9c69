//! How much of a long run is done, and about how long the rest takes.
//!
//! # Idea
//! The work falls into kinds; the units of a kind take about the same time each.
//! ```text
//! a unit's time    of a kind that has begun: the mean of its units so far
//!                  of another: its usual time, scaled by how fast the others were here
//! time left        the sum over the kinds of units left times a unit's time
//! shown            follows that smoothly, so that no single unit makes it jump
//! ```
//! All of it is measured while the run goes on: a slow or busy machine makes every estimate
//! longer in proportion, from the first second.

use frusta_lab::geometric_mean;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// A kind of work.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kind {
    /// How many units there are.
    pub(crate) units: u64,
    /// Seconds that a unit usually takes; only their proportions between kinds matter.
    pub(crate) usual: f64,
}

/// A bar on the error stream, with the time that is left; invisible where that is no terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    state: Mutex<State>,
}

struct State {
    estimate: Estimate,
    shown: Shown,
    /// When units were reported last, in seconds from the start.
    last: f64,
}

/// The bar's length.
const STEPS: f64 = 1000.0;

impl Progress {
    /// Nothing done of this work.
    pub(crate) fn new(kinds: impl IntoIterator<Item = Kind>) -> Self {
        let bar = ProgressBar::new(STEPS as u64);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
            bar.set_style(style);
        }
        Self {
            bar,
            start: Instant::now(),
            state: Mutex::new(State {
                estimate: Estimate::new(kinds),
                shown: Shown::default(),
                last: 0.0,
            }),
        }
    }

    /// Units of a kind are done, by any thread.
    pub(crate) fn add(&self, kind: usize, units: u64) {
        // Counts are whole after every call, so a panic elsewhere has not torn them.
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let now = self.start.elapsed().as_secs_f64();
        let seconds = now - std::mem::replace(&mut state.last, now);
        state.estimate.add(kind, units, seconds);
        let left = state.estimate.seconds_left();
        let left = state.shown.follow(left, now);
        let position = STEPS * now / (now + left).max(f64::MIN_POSITIVE);
        self.bar
            .set_position(self.bar.position().max(position as u64));
        self.bar.set_message(words(left));
    }

    /// Hides the bar while something is printed.
    pub(crate) fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// Removes the bar.
    pub(crate) fn finish(self) {
        self.bar.finish_and_clear();
    }
}

/// A duration, coarsely.
fn words(seconds: f64) -> String {
    match seconds {
        s if s < 10.0 => "seconds left".to_owned(),
        s if s < 90.0 => format!("about {:.0} s left", 10.0 * (s / 10.0).round()),
        s => format!("about {:.0} min left", s / 60.0),
    }
}

/// What is known of each kind of work.
#[derive(Clone, Debug)]
struct Estimate(Vec<Measured>);

#[derive(Clone, Copy, Debug)]
struct Measured {
    kind: Kind,
    done: u64,
    /// Seconds that the units so far took.
    seconds: f64,
}

/// A kind's usual time counts as much as this share of its units: the first of them are few.
const WEIGHT: f64 = 0.02;

impl Estimate {
    fn new(kinds: impl IntoIterator<Item = Kind>) -> Self {
        let measured = |kind| Measured {
            kind,
            done: 0,
            seconds: 0.0,
        };
        Self(kinds.into_iter().map(measured).collect())
    }

    fn add(&mut self, kind: usize, units: u64, seconds: f64) {
        let measured = &mut self.0[kind];
        measured.done = measured.kind.units.min(measured.done + units);
        measured.seconds += seconds;
    }

    /// How many times as long as usual the kinds that have begun take: the geometric mean, so that
    /// one kind whose usual time is wrong does not count for the others.
    fn slowness(&self) -> f64 {
        let begun = self.0.iter().filter(|m| m.done > 0);
        let ratios = begun.map(|m| m.seconds / (m.kind.usual * m.done as f64));
        geometric_mean(ratios).unwrap_or(1.0)
    }

    fn seconds_left(&self) -> f64 {
        let slowness = self.slowness();
        let left = self.0.iter().map(|m| {
            let weight = WEIGHT * m.kind.units as f64;
            let seconds = m.seconds + weight * m.kind.usual * slowness;
            let each = seconds / (m.done as f64 + weight).max(f64::MIN_POSITIVE);
            (m.kind.units - m.done) as f64 * each
        });
        left.sum()
    }
}

/// The time left as it is shown.
#[derive(Clone, Copy, Debug, Default)]
struct Shown(Option<(f64, f64)>);

/// Seconds within which most of a change of the estimate is shown.
const DELAY: f64 = 8.0;

impl Shown {
    /// The time to show at a time, in seconds.
    fn follow(&mut self, left: f64, now: f64) -> f64 {
        let shown = match self.0 {
            None => left,
            Some((shown, at)) => {
                let passed = (now - at).max(0.0);
                let expected = (shown - passed).max(0.0);
                expected + (left - expected) * (passed / DELAY).min(1.0)
            }
        };
        self.0 = Some((shown, now));
        shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs this work, each unit of which takes so long, and returns the shown and the true time
    /// left after each unit. Kinds are gone through as a survey does: the first two in turns.
    fn run(kinds: &[Kind], seconds: &[f64], load: fn(f64) -> f64) -> Vec<(f64, f64)> {
        let mut order: Vec<usize> = (0..kinds[0].units).flat_map(|_| [0, 1]).collect();
        for (kind, k) in kinds.iter().enumerate().skip(2) {
            order.extend(std::iter::repeat_n(kind, k.units as usize));
        }
        let mut estimate = Estimate::new(kinds.iter().copied());
        let (mut shown, mut now, mut all) = (Shown::default(), 0.0, Vec::new());
        for kind in order {
            let passed = seconds[kind] * load(now);
            now += passed;
            estimate.add(kind, 1, passed);
            all.push((now, shown.follow(estimate.seconds_left(), now)));
        }
        let end = all.last().map_or(0.0, |(now, _)| *now);
        all.into_iter()
            .map(|(now, shown)| (shown, end - now))
            .collect()
    }

    const KINDS: [Kind; 4] = [
        Kind {
            units: 40,
            usual: 1.0,
        },
        Kind {
            units: 40,
            usual: 3.0,
        },
        Kind {
            units: 50,
            usual: 2.0,
        },
        Kind {
            units: 80,
            usual: 0.5,
        },
    ];

    #[test]
    fn a_machine_as_slow_as_it_may_be_is_estimated_at_once() {
        for slow in [0.01, 1.0, 30.0] {
            let seconds = KINDS.map(|kind| slow * kind.usual);
            for (shown, left) in run(&KINDS, &seconds, |_| 1.0) {
                assert!((shown - left).abs() < 1e-6 * (1.0 + left), "{shown} {left}");
            }
        }
    }

    #[test]
    fn wrong_usual_times_and_load_do_not_make_it_swing() {
        // One kind takes four times as long as usual, another a third; a load comes and goes.
        let seconds = [1.0, 12.0, 0.7, 0.5];
        let load = |now: f64| {
            if (now / 20.0) as u64 % 2 == 1 {
                2.0
            } else {
                1.0
            }
        };
        let all = run(&KINDS, &seconds, load);
        let end = all[0].1;
        // Both kinds that alternate have begun after a few units; until then the usual times rule.
        for (shown, left) in &all[6..] {
            assert!((shown - left).abs() < 0.4 * end, "{shown} {left}");
        }
        for pair in all[6..].windows(2) {
            let passed = pair[0].1 - pair[1].1;
            let jump = (pair[1].0 - (pair[0].0 - passed)).abs();
            // Within a unit's time it moves by little more than that time would explain.
            assert!(jump < 0.1 * end + 1.5 * passed, "{jump} {passed} {end}");
        }
        // Towards the end it is right.
        let (shown, left) = all[all.len() - 20];
        assert!((shown - left).abs() < 0.5 * left, "{shown} {left}");
    }

    #[test]
    fn nothing_to_do_takes_no_time() {
        assert_eq!(Estimate::new([]).seconds_left(), 0.0);
        let none = Kind {
            units: 0,
            usual: 1.0,
        };
        assert_eq!(Estimate::new([none]).seconds_left(), 0.0);
        let texts = [0.0, 44.0, 600.0].map(words);
        assert_eq!(
            texts,
            ["seconds left", "about 40 s left", "about 10 min left"]
        );
    }
}
