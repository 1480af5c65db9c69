//! Run times taken in turns.
//!
//! The speed of a machine that other programs use drifts within seconds; ratios of times taken
//! side by side drift less. Everything that is timed therefore takes one turn in each round, and a
//! ratio is formed within a round. Another one begins each round, so that no position in the order
//! is favoured. The first rounds warm up caches and branch predictors and do not count.
//!
//! Reported are the median over the rounds and, as the spread, the lower and the upper quartile.

/// Rounds that warm up before those that count.
pub const WARM_UP: usize = 2;

/// Ratios whose quartiles are farther from the median than this factor are noisy.
pub const NOISY: f64 = 1.25;

/// Median and quartiles of some values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// A quarter of the values are at most this.
    pub lower: f64,
    /// The median.
    pub median: f64,
    /// Three quarters of the values are at most this.
    pub upper: f64,
}

impl Spread {
    /// Quartiles of these values, interpolated linearly between neighbours; all 0 without values.
    ///
    /// ```
    /// use frusta_lab::turns::Spread;
    /// let spread = Spread::new(vec![5.0, 1.0, 2.0, 3.0, 4.0]);
    /// assert_eq!([spread.lower, spread.median, spread.upper], [2.0, 3.0, 4.0]);
    /// ```
    pub fn new(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let [lower, median, upper] = [1, 2, 3].map(|k| quantile(&values, k));
        Self {
            lower,
            median,
            upper,
        }
    }

    /// Whether a quartile differs from the median by more than the factor [`NOISY`].
    pub fn is_noisy(&self) -> bool {
        self.upper > self.median * NOISY || self.lower * NOISY < self.median
    }

    /// The factor between the median and the farther quartile, less 1; infinite where the lower
    /// quartile is 0.
    pub fn noise(&self) -> f64 {
        let factor = (self.upper / self.median).max(self.median / self.lower);
        if self.median > 0.0 { factor - 1.0 } else { 0.0 }
    }

    /// The spread of the inverse: of speeds where this is one of times.
    pub fn inverse(&self) -> Self {
        let inverse = |value: f64| if value > 0.0 { 1.0 / value } else { 0.0 };
        Self {
            lower: inverse(self.upper),
            median: inverse(self.median),
            upper: inverse(self.lower),
        }
    }

    /// The geometric means of medians and of quartiles; `None` without positive medians.
    ///
    /// The spread is that of a typical input, not the smaller one of the mean.
    pub fn geometric_mean(all: impl IntoIterator<Item = Self>) -> Option<Self> {
        let all: Vec<Self> = all.into_iter().collect();
        let mean = |of: fn(&Self) -> f64| geometric_mean(all.iter().map(of));
        let median = mean(|s| s.median)?;
        Some(Self {
            lower: mean(|s| s.lower).unwrap_or(median),
            median,
            upper: mean(|s| s.upper).unwrap_or(median),
        })
    }
}

/// The `k`-th quartile of sorted values.
fn quantile(sorted: &[f64], k: usize) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return 0.0;
    };
    let (index, rest) = (last * k / 4, last * k % 4);
    let low = sorted[index];
    match rest {
        0 => low,
        _ => low + (sorted[index + 1] - low) * (rest as f64 / 4.0),
    }
}

/// What was measured of one contestant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// The time as a multiple of the reference's in the same round: larger is slower. 0 where
    /// nothing was timed.
    pub ratio: Spread,
    /// Nanoseconds a segment, or a volume: the median over the rounds.
    pub nanoseconds: f64,
}

impl Timing {
    /// How many times as fast as the reference, or `None` if nothing was timed.
    pub fn speed(&self) -> Option<Spread> {
        (self.ratio.median > 0.0).then(|| self.ratio.inverse())
    }
}

/// Times of several contestants, round by round.
///
/// ```
/// use frusta_lab::turns::Turns;
/// let mut turns = Turns::new(2);
/// turns.take(5, |i| [2.0, 6.0][i], || ());
/// let timings = turns.timings(0);
/// assert_eq!(timings[1].ratio.median, 3.0);
/// assert_eq!(timings[1].nanoseconds, 6.0);
/// ```
#[derive(Clone, Debug)]
pub struct Turns {
    /// Rounds begun, warm-up included.
    begun: usize,
    /// Nanoseconds, contestant by contestant.
    times: Vec<Vec<f64>>,
}

impl Turns {
    /// No rounds of this many contestants.
    pub fn new(count: usize) -> Self {
        Self {
            begun: 0,
            times: vec![Vec::new(); count],
        }
    }

    /// Warms up, then takes this many rounds.
    ///
    /// `time` returns a contestant's time by its index; `on_round` is called
    /// [`Turns::rounds`] times. Without rounds nothing is called.
    pub fn take(
        &mut self,
        rounds: usize,
        mut time: impl FnMut(usize) -> f64,
        mut on_round: impl FnMut(),
    ) {
        for round in 0..Self::rounds(rounds) {
            match round < WARM_UP {
                true => drop(self.turn(&mut time)),
                false => self.round(&mut time),
            }
            on_round();
        }
    }

    /// How many rounds [`Turns::take`] goes through, warm-up included.
    pub const fn rounds(counted: usize) -> usize {
        if counted == 0 { 0 } else { counted + WARM_UP }
    }

    /// A round: `time` is called once for each contestant's index.
    pub fn round(&mut self, time: impl FnMut(usize) -> f64) {
        let now = self.turn(time);
        for (times, time) in self.times.iter_mut().zip(now) {
            times.push(time);
        }
    }

    fn turn(&mut self, mut time: impl FnMut(usize) -> f64) -> Vec<f64> {
        let count = self.times.len();
        let mut now = vec![0.0; count];
        for turn in 0..count {
            let i = (self.begun + turn) % count;
            now[i] = time(i);
        }
        self.begun += 1;
        now
    }

    /// Median times of all contestants, and ratios to the one with this index.
    pub fn timings(&self, reference: usize) -> Vec<Timing> {
        let timing = |own: usize| Timing {
            ratio: self.ratios(own, reference),
            nanoseconds: self.nanoseconds(own),
        };
        (0..self.times.len()).map(timing).collect()
    }

    /// A contestant's median time.
    pub fn nanoseconds(&self, index: usize) -> f64 {
        Spread::new(self.times[index].clone()).median
    }

    /// A contestant's time divided by the reference's, round by round.
    pub fn ratios(&self, index: usize, reference: usize) -> Spread {
        let rounds = self.times[index].iter().zip(&self.times[reference]);
        // Without a time of the reference there is no ratio.
        let ratio = |(own, other): (&f64, &f64)| Some(own / other).filter(|r| r.is_finite());
        Spread::new(rounds.map(|pair| ratio(pair).unwrap_or(0.0)).collect())
    }
}

/// One pass over the input that is timed; returns its nanoseconds for each segment or volume.
pub type Pass<'a> = Box<dyn FnMut() -> f64 + 'a>;

/// Takes this many rounds of turns; ratios are to the first pass.
pub fn take_turns(passes: &mut [Pass<'_>], rounds: usize) -> Vec<Timing> {
    let mut turns = Turns::new(passes.len());
    turns.take(rounds, |i| passes[i](), || ());
    turns.timings(0)
}

/// The geometric mean of the positive and finite values, `None` without any.
///
/// ```
/// use frusta_lab::turns::geometric_mean;
/// assert_eq!(geometric_mean([0.5, 2.0, 0.0, f64::NAN]), Some(1.0));
/// assert_eq!(geometric_mean([0.0]), None);
/// ```
pub fn geometric_mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0_u32);
    let positive = |v: &f64| v.is_finite() && *v > 0.0;
    for value in values.into_iter().filter(positive) {
        sum += value.ln();
        count += 1;
    }
    (count > 0).then(|| (sum / f64::from(count)).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quartiles(values: &[f64]) -> [f64; 3] {
        let spread = Spread::new(values.to_vec());
        [spread.lower, spread.median, spread.upper]
    }

    #[test]
    fn quartiles_of_few_values() {
        assert_eq!(quartiles(&[]), [0.0; 3]);
        assert_eq!(quartiles(&[7.0]), [7.0; 3]);
        assert_eq!(quartiles(&[4.0, 1.0]), [1.75, 2.5, 3.25]);
        assert_eq!(quartiles(&[3.0, 1.0, 2.0]), [1.5, 2.0, 2.5]);
        assert_eq!(quartiles(&[5.0, 4.0, 3.0, 2.0, 1.0]), [2.0, 3.0, 4.0]);
    }

    #[test]
    fn scattered_quartiles_are_noisy() {
        let spread = |lower, upper| Spread {
            lower,
            median: 1.0,
            upper,
        };
        assert!(!spread(0.8, 1.25).is_noisy() && !Spread::default().is_noisy());
        assert!(spread(0.79, 1.0).is_noisy() && spread(1.0, 1.26).is_noisy());
        // An inverse is as noisy.
        assert!(spread(0.79, 1.0).inverse().is_noisy() && !spread(0.81, 1.2).inverse().is_noisy());
        assert_eq!(spread(0.5, 2.0).inverse(), spread(0.5, 2.0));
        let mean = Spread::geometric_mean([spread(0.5, 2.0), spread(0.125, 8.0)]);
        let mean = mean.map(|s| [s.lower, s.median, s.upper].map(|v| (v * 1e9).round() / 1e9));
        assert_eq!(mean, Some([0.25, 1.0, 4.0]));
        assert_eq!(Spread::geometric_mean([Spread::default()]), None);
    }

    #[test]
    fn each_has_its_turn_and_ratios_are_of_one_round() {
        let mut turns = Turns::new(3);
        let mut order = Vec::new();
        // Each round takes ten times as long as the one before, and in the last the
        // reference has no time.
        for (scale, reference) in [(1.0, 2.0), (10.0, 2.0), (100.0, 2.0), (1000.0, 0.0)] {
            turns.round(|i| {
                order.push(i);
                scale * [1.0, reference, 6.0][i]
            });
        }
        assert_eq!(order, [0, 1, 2, 1, 2, 0, 2, 0, 1, 0, 1, 2]);
        let timings = turns.timings(1);
        let medians = timings.iter().map(|t| t.ratio.median);
        assert_eq!(medians.sum::<f64>(), 0.5 + 1.0 + 3.0);
        assert_eq!(timings[2].nanoseconds, 330.0);
        assert!(Turns::new(0).timings(0).is_empty());
    }

    #[test]
    fn rounds_that_warm_up_do_not_count_but_rotate() {
        let mut turns = Turns::new(2);
        let (mut calls, mut rounds) = (0, 0);
        let time = |i: usize| {
            calls += 1;
            // A machine that slows down: ratios do not change.
            [1.0, 4.0][i] * f64::from((calls - 1) / 2)
        };
        turns.take(3, time, || rounds += 1);
        assert_eq!((calls, rounds), (2 * (3 + WARM_UP as i32), 3 + WARM_UP));
        let timings = turns.timings(0);
        assert_eq!(timings[1].ratio, Spread::new(vec![4.0]));
        assert_eq!(timings[0].nanoseconds, 1.0 + WARM_UP as f64);
        assert_eq!(timings[1].speed().map(|s| s.median), Some(0.25));
        assert_eq!(Timing::default().speed(), None);
        turns.take(
            0,
            |_| unreachable!("no rounds"),
            || unreachable!("no rounds"),
        );
    }
}
