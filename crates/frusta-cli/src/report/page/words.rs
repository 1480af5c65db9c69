//! Numbers as text.

use frusta_lab::Spread;

/// A ratio of times with its quartiles; `~` marks a noisy one.
pub(crate) fn times(ratio: Spread) -> String {
    format!("{} [{}]", median(ratio), quartiles(ratio))
}

/// A ratio of times without its quartiles; `~` marks a noisy one.
pub(crate) fn median(ratio: Spread) -> String {
    let mark = if ratio.is_noisy() { "~" } else { "" };
    format!("{mark}{}", figure(ratio.median))
}

/// A ratio's quartiles.
pub(crate) fn quartiles(ratio: Spread) -> String {
    format!("{} to {}", figure(ratio.lower), figure(ratio.upper))
}

/// Three digits of a time or an error.
pub(crate) fn figure(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        f64::MAX => "unbounded".to_owned(),
        v if !v.is_finite() => "-".to_owned(),
        v if !(0.000_95..9999.5).contains(&v) => format!("{v:.1e}"),
        v if v >= 99.95 => format!("{v:.0}"),
        v if v >= 9.995 => format!("{v:.1}"),
        v if v >= 0.0995 => format!("{v:.2}"),
        v => format!("{v:.4}"),
    }
}

/// A share as a percentage.
pub(crate) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent {
        0.0 => "0 %".to_owned(),
        p if p >= 9.95 => format!("{p:.0} %"),
        p if p >= 0.095 => {
            let text = format!("{p:.1}");
            format!("{} %", text.trim_end_matches(".0"))
        }
        p => {
            let text = format!("{p:.4}");
            format!("{} %", text.trim_end_matches('0').trim_end_matches('.'))
        }
    }
}

/// A count with commas between thousands.
pub(crate) fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let figures = [0.0, 0.5, 1.234, 23.456, 456.7, 1e16, 1e-9, f64::NAN].map(figure);
        assert_eq!(
            figures,
            ["0", "0.50", "1.23", "23.5", "457", "1.0e16", "1.0e-9", "-"]
        );
        assert_eq!(figure(f64::MAX), "unbounded");
        let spread = |values: [f64; 3]| times(Spread::new(values.to_vec()));
        assert_eq!(spread([1.0, 2.0, 3.0]), "~2.00 [1.50 to 2.50]");
        assert_eq!(spread([1.0, 1.1, 1.2]), "1.10 [1.05 to 1.15]");
        let shares = [0.0, 1.0, 0.34, 0.012, 1e-4, 1e-6].map(percent);
        assert_eq!(
            shares,
            ["0 %", "100 %", "34 %", "1.2 %", "0.01 %", "0.0001 %"]
        );
        assert_eq!(
            [0, 999, 1000, 12_345_678].map(count),
            ["0", "999", "1,000", "12,345,678"]
        );
    }
}
