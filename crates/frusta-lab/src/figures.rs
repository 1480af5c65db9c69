//! Numbers in the columns of text tables.

use crate::turns::Spread;

/// Explains [`ratio`], for legends.
pub const RATIO_LEGEND: &str = "\
1.23±4%   a median over the rounds; its farther quartile is 4 % off. With ~ for ± it is noisy: more
          than 25 % off (99: or more)
";

/// What stands for an error in units in the last place that is beyond the range of `f64`.
const UNBOUNDED: &str = "*";

/// A number in a column of this width, with as many of the decimals as fit.
pub(crate) fn fit(value: f64, decimals: usize, columns: usize) -> String {
    let decimals = (0..=decimals).rev();
    let texts = decimals.map(|digits| format!("{value:.digits$}"));
    let fitting = texts.into_iter().find(|text| text.len() <= columns);
    fitting.unwrap_or_else(|| format!("{value:.0e}"))
}

/// A ratio in four columns, and its spread in four more: `1.23±4%`, or `1.23~40%` where it is
/// noisy; `-` where nothing was timed.
pub fn ratio(spread: Spread) -> String {
    if spread.median <= 0.0 {
        return "-".to_owned();
    }
    let mark = if spread.is_noisy() { '~' } else { '±' };
    let percent = (100.0 * spread.noise()).round().min(99.0);
    format!("{}{mark}{percent}%", fit(spread.median, 2, 4))
}

/// An error in seven columns: with two decimals, or as a power of ten.
pub(crate) fn error(value: f64) -> String {
    match value {
        f64::MAX => UNBOUNDED.to_owned(),
        v if v < 1e4 => fit(v, 2, 7),
        v => format!("{v:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_to_their_columns() {
        for (value, text) in [
            (0.0, "0.00"),
            (9.994, "9.99"),
            (9.996, "10.0"),
            (128.0, "128"),
            (9999.4, "9999"),
            (123_456.0, "1e5"),
        ] {
            assert_eq!(fit(value, 2, 4), text);
        }
        assert_eq!(fit(10_515.5, 1, 5), "10516");
        assert_eq!(fit(158.858, 3, 6), "158.86");
        assert_eq!(
            [0.5, 12_345.0, f64::MAX].map(error),
            ["0.50", "1.2e4", UNBOUNDED]
        );
    }

    #[test]
    fn a_noisy_ratio_is_marked() {
        let text = |lower, median, upper| {
            ratio(Spread {
                lower,
                median,
                upper,
            })
        };
        assert_eq!(text(0.99, 1.0, 1.04), "1.00±4%");
        assert_eq!(text(10.0, 12.34, 13.0), "12.3±23%");
        assert_eq!(text(1.0, 2.0, 2.0), "2.00~99%");
        assert_eq!(text(1.5, 2.0, 2.0), "2.00~33%");
        assert_eq!(text(0.0, 0.0, 0.0), "-");
    }
}
