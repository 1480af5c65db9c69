//! Times taken in turns.
//!
//! Time on a machine that others use drifts within seconds; ratios drift less. So
//! times are taken in rounds: within each, all who are timed take turns, each round
//! begun by another one, and a ratio is taken; the medians over the rounds are told.

/// A median time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// In times of textbook Liang-Barsky in plain arithmetic, or of the first of a job's
    /// functions: larger is slower.
    pub ratio: f64,
    /// In nanoseconds a segment, or a volume.
    pub nanoseconds: f64,
}

/// The times and ratios of each, round by round.
pub(super) struct Turns {
    reference: usize,
    rounds: usize,
    nanoseconds: Vec<Vec<f64>>,
    ratios: Vec<Vec<f64>>,
}

impl Turns {
    /// Of so many; ratios are to the one of number `reference`.
    pub(super) fn new(count: usize, reference: usize) -> Self {
        Self {
            reference,
            rounds: 0,
            nanoseconds: vec![Vec::new(); count],
            ratios: vec![Vec::new(); count],
        }
    }

    /// A round: `time` is asked once for the time of each number.
    pub(super) fn round(&mut self, mut time: impl FnMut(usize) -> f64) {
        let count = self.nanoseconds.len();
        let mut now = vec![0.0; count];
        for turn in 0..count {
            let i = (self.rounds + turn) % count;
            now[i] = time(i);
        }
        for (i, &time) in now.iter().enumerate() {
            self.nanoseconds[i].push(time);
            // Where the reference has no time, nobody has a ratio.
            let ratio: f64 = time / now[self.reference];
            self.ratios[i].push(if ratio.is_finite() { ratio } else { 0.0 });
        }
        self.rounds += 1;
    }

    /// What is told of each.
    pub(super) fn medians(self) -> Vec<Timing> {
        let both = self.nanoseconds.into_iter().zip(self.ratios);
        both.map(|(nanoseconds, ratios)| Timing {
            ratio: median(ratios),
            nanoseconds: median(nanoseconds),
        })
        .collect()
    }
}

/// The middle one, the greater of two; 0 of none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

/// The geometric mean of what is positive and finite, which is what ratios have;
/// `None` without any.
///
/// ```
/// use frusta::report::geometric_mean;
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

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(vec![5.0, 1.0, 3.0]), 3.0);
        assert_eq!(median(vec![4.0, 1.0]), 4.0);
        assert_eq!(median(Vec::new()), 0.0);
    }

    #[test]
    fn each_has_its_turn_and_ratios_are_of_one_round() {
        let mut turns = Turns::new(3, 1);
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
        let medians = turns.medians();
        assert_eq!(
            medians.iter().map(|t| t.ratio).sum::<f64>(),
            0.5 + 1.0 + 3.0
        );
        assert_eq!(medians[2].nanoseconds, 600.0);
        assert!(Turns::new(0, 0).medians().is_empty());
    }
}
