//! Seeded pseudo-random numbers, the same on every platform.
//!
//! SplitMix64 (Steele, Lea, Flood, *Fast splittable pseudorandom number
//! generators*, 2014): a counter stepped by the golden ratio and scrambled by
//! two multiply-xorshift rounds. Any seed is as good as any other, so the seed of a case
//! contains its index, and it does not depend on other cases.

/// A SplitMix64 generator.
#[derive(Clone, Debug)]
pub struct Random(u64);

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl Random {
    /// Creates a generator from several numbers; a change of any of them changes the whole
    /// sequence.
    #[must_use]
    pub fn new(parts: &[u64]) -> Self {
        let mut state = Self(0);
        for &part in parts {
            state = Self(state.next_u64() ^ part);
        }
        Self(state.next_u64())
    }

    /// The next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `0..n`; 0 if `n` is 0. The bias is below `n / 2^64`.
    pub fn below(&mut self, n: u64) -> u64 {
        ((u128::from(self.next_u64()) * u128::from(n)) >> 64) as u64
    }

    /// Uniform in `low..=high`, which may be all integers; `low` if `high` is
    /// less.
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        let steps = if high < low { 0 } else { high.abs_diff(low) };
        let step = match steps.checked_add(1) {
            Some(count) => self.below(count),
            None => self.next_u64(),
        };
        low.wrapping_add_unsigned(step)
    }

    /// Uniform in `0.0..1.0`, a multiple of 2^-53.
    pub fn unit(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * (0.5 * f64::EPSILON)
    }

    /// Uniform in `low..high`, rounded.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }

    /// True with probability `1 / n`.
    pub fn one_in(&mut self, n: u64) -> bool {
        self.below(n) == 0
    }

    /// -1.0 or 1.0.
    pub fn sign(&mut self) -> f64 {
        if self.one_in(2) { -1.0 } else { 1.0 }
    }

    /// One of several values, with equal probability.
    ///
    /// # Panics
    /// If `values` is empty.
    pub fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len() as u64) as usize]
    }

    /// A power of ten with an exponent in `low..=high`, rounded to the nearest `f64`: it is
    /// parsed from decimal text.
    pub fn power_of_ten(&mut self, low: i64, high: i64) -> f64 {
        let exponent = self.integer(low, high);
        format!("1e{exponent}").parse().unwrap_or(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_sequence() {
        // The reference implementation's first values from state 1234567.
        let mut random = Random(1_234_567);
        let found = [(); 3].map(|()| random.next_u64());
        assert_eq!(
            found,
            [
                6_457_827_717_110_365_317,
                3_203_168_211_198_807_973,
                9_817_491_932_198_370_423
            ]
        );
    }

    #[test]
    fn ranges_are_kept_and_reached() {
        let mut random = Random::new(&[1, 2]);
        let mut seen = [false; 7];
        for _ in 0..1000 {
            seen[(random.integer(-3, 3) + 3) as usize] = true;
            assert!((0.0..1.0).contains(&random.unit()));
        }
        assert_eq!(seen, [true; 7]);
        assert_eq!(random.power_of_ten(-30, -30), 1e-30);
        assert_eq!(random.integer(7, 3), 7);
        let all = [(); 64].map(|()| random.integer(i64::MIN, i64::MAX));
        assert!(all.iter().any(|i| *i < 0) && all.iter().any(|i| *i > i64::MAX / 2));
    }
}
