//! Logarithmic axes.

/// Decades from a power of ten to another, on a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Decades {
    low: f64,
    high: f64,
    /// The positions of the lowest and the highest value.
    ends: [f64; 2],
}

impl Decades {
    /// Whole decades that contain these values and at least the range `least`; only positive
    /// finite values count.
    pub(super) fn around(
        values: impl Iterator<Item = f64>,
        least: [f64; 2],
        ends: [f64; 2],
    ) -> Self {
        let [mut low, mut high] = least;
        for value in values.filter(|v| v.is_finite() && *v > 0.0) {
            (low, high) = (low.min(value), high.max(value));
        }
        let (low, high) = (low.log10().floor(), high.log10().ceil());
        Self {
            low,
            high: high.max(low + 1.0),
            ends,
        }
    }

    /// Exactly this range.
    pub(super) fn between(low: f64, high: f64, ends: [f64; 2]) -> Self {
        let (low, high) = (low.log10(), high.log10());
        Self { low, high, ends }
    }

    /// The position of a value; values beyond the ends are placed at them.
    pub(super) fn place(&self, value: f64) -> f64 {
        let share = (value.log10() - self.low) / (self.high - self.low);
        let [from, to] = self.ends;
        // Zero and NaN are placed at the lowest value.
        from + (to - from) * share.clamp(0.0, 1.0).max(0.0)
    }

    /// Powers of ten, at most this many.
    pub(super) fn ticks(&self, most: usize) -> Vec<f64> {
        let count = (self.high.floor() - self.low.ceil()) as usize + 1;
        let step = count.div_ceil(most.max(1)).max(1);
        let first = self.low.ceil();
        let exponents = (0..count).step_by(step).map(|i| first + i as f64);
        exponents.map(|e| 10.0_f64.powi(e as i32)).collect()
    }
}

/// A power of ten, or 2 to 5 times one, as a label.
pub(super) fn label(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        let text = format!("{value:.4}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        text.to_owned()
    } else {
        format!("{value:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_has_a_place_between_the_ends() {
        let values = [0.3, 4e7, f64::NAN, f64::INFINITY, 0.0];
        let axis = Decades::around(values.into_iter(), [1.0, 10.0], [100.0, 20.0]);
        assert_eq!((axis.place(0.1), axis.place(1e8)), (100.0, 20.0));
        for value in values {
            assert!((20.0..=100.0).contains(&axis.place(value)), "{value}");
        }
        assert_eq!(axis.ticks(20).len(), 10);
        assert_eq!(axis.ticks(5), [0.1, 10.0, 1e3, 1e5, 1e7]);
        let narrow = Decades::around([2.0].into_iter(), [2.0, 3.0], [0.0, 1.0]);
        assert_eq!(narrow.ticks(9), [1.0, 10.0]);
    }

    #[test]
    fn labels_are_short() {
        let labels = [0.001, 0.5, 1.0, 1e4, 1e16, 1e-9].map(label);
        assert_eq!(labels, ["0.001", "0.5", "1", "10000", "1e16", "1e-9"]);
    }
}
