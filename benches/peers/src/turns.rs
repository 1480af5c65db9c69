//! Times, taken in turns.
//!
//! On a machine that others use, too, times drift within seconds; ratios drift less. So
//! everybody's pass is timed once in each round, a ratio is taken within the round, and medians over
//! the rounds are told.

use crate::peer::Timed;

/// What was measured of one contestant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Time {
    /// Nanoseconds a case, the median over rounds.
    pub nanoseconds: f64,
    /// In times of each reference, in the same round: lower quartile, median, upper quartile.
    pub ratios: [Option<[f64; 3]>; REFERENCES],
}

/// How many there may be that times are compared with.
pub const REFERENCES: usize = 4;

/// Rounds before those that count.
const WARM_UP: usize = 2;

/// Takes turns; `references` are places in `all`.
pub fn take_turns(
    all: &mut [Box<dyn Timed>],
    references: [Option<usize>; REFERENCES],
    rounds: usize,
    mut on_round: impl FnMut(),
) -> Vec<Time> {
    let count = all.len();
    let mut times = vec![Vec::with_capacity(rounds); count];
    for round in 0..rounds + WARM_UP {
        for turn in 0..count {
            let i = (round + turn) % count;
            let time = all[i].time();
            if round >= WARM_UP {
                times[i].push(time);
            }
        }
        on_round();
    }
    let ratios = |own: &[f64], reference: Option<usize>| {
        let other = &times[reference?];
        let all = own.iter().zip(other).map(|(a, b)| a / b).collect();
        Some(quartiles(all))
    };
    times
        .iter()
        .map(|own| Time {
            nanoseconds: quartiles(own.clone())[1],
            ratios: references.map(|reference| ratios(own, reference)),
        })
        .collect()
}

/// Lower quartile, median, upper quartile; 0 of nothing.
fn quartiles(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    [1, 2, 3].map(|k| values.get((last * k + 2) / 4).copied().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peer::Who;

    #[test]
    fn quartiles_of_few() {
        assert_eq!(quartiles(vec![]), [0.0; 3]);
        assert_eq!(quartiles(vec![7.0]), [7.0; 3]);
        assert_eq!(quartiles(vec![3.0, 1.0, 2.0]), [2.0, 2.0, 3.0]);
        assert_eq!(quartiles(vec![5.0, 4.0, 3.0, 2.0, 1.0]), [2.0, 3.0, 4.0]);
    }

    /// Takes as long as it says.
    struct Paced(f64, usize);

    impl Timed for Paced {
        fn who(&self) -> Who {
            unreachable!("nobody asks")
        }
        fn pass(&mut self) {
            self.1 += 1;
        }
        fn loaded(&self) -> usize {
            1
        }
        fn time(&mut self) -> f64 {
            self.pass();
            // A machine that slows down: ratios do not.
            self.0 * self.1 as f64
        }
    }

    #[test]
    fn ratios_are_taken_within_rounds() {
        let mut rounds = 0;
        let mut all: [Box<dyn Timed>; 2] = [Box::new(Paced(2.0, 0)), Box::new(Paced(6.0, 0))];
        let times = take_turns(&mut all, [Some(0), None, Some(1), None], 5, || rounds += 1);
        assert_eq!(rounds, 5 + WARM_UP);
        assert_eq!(times[0].nanoseconds, 10.0);
        let third = Some([1.0 / 3.0; 3]);
        assert_eq!(times[0].ratios, [Some([1.0; 3]), None, third, None]);
        let one = Some([1.0; 3]);
        assert_eq!(times[1].ratios, [Some([3.0; 3]), None, one, None]);
    }
}
