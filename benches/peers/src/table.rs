//! The table on the terminal, 100 columns wide.

use crate::facts::Fact;
use crate::file::{Headline, Row};
use std::fmt::Write;

/// The columns' names.
pub fn heading() -> String {
    format!(
        "{:<39} {:>3} {:>5} {:>5} {:>6} {:>7} {:>6} {:>6} {:>7} {:>7}",
        "", "", "ns", "ratio", "slices", "phantom", "missed", "place", "outside", "refused"
    )
}

/// The line above the rows of a contest.
pub fn title(row: &Row) -> String {
    let of = row.cases.map(|n| format!(", {} cases judged", grouped(n)));
    format!("\n{}: {}{}", row.job, row.input, of.unwrap_or_default())
}

/// A row.
pub fn line(row: &Row) -> String {
    let name = format!("{} {}", row.library, row.function);
    if row.ns_median.is_none() {
        return name;
    }
    let time = |t: Option<f64>, digits| t.map_or("-".into(), |t| format!("{t:.digits$}"));
    let count = |n: Option<u64>| n.map_or("-".into(), |n| n.to_string());
    let mut line = format!(
        "{:<39} {:>3} {:>5} {:>5} {:>6}",
        fitted(&name, 39),
        row.scalar,
        time(row.ns_median, usize::from(row.ns_median < Some(1e3))),
        time(row.time_ratio, 2),
        time(row.time_ratio_slices, 2)
    );
    for (n, width) in [
        (row.phantom, 7),
        (row.missed, 6),
        (row.misplaced, 6),
        (row.outside, 7),
        (row.refused, 7),
    ] {
        // A text cannot fail to be written to.
        let _ = write!(line, " {:>width$}", count(n));
    }
    line
}

/// The beginning and the end, a dot for what is missing between.
fn fitted(text: &str, width: usize) -> String {
    let count = text.chars().count();
    if count <= width {
        return text.to_owned();
    }
    let end = width / 5;
    let start = text.chars().take(width - 1 - end);
    start
        .chain(['…'])
        .chain(text.chars().skip(count - end))
        .collect()
}

/// Thousands apart.
fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let first = digits.len() % 3;
    let (head, tail) = digits.split_at(first);
    let groups = tail.as_bytes().chunks(3).map(String::from_utf8_lossy);
    let all = Some(head.into()).filter(|h: &std::borrow::Cow<'_, str>| !h.is_empty());
    all.into_iter().chain(groups).collect::<Vec<_>>().join(",")
}

/// A fact, on a few lines.
pub fn fact(fact: &Fact) -> String {
    let Fact {
        library,
        version,
        what,
        input,
        result,
        ours,
    } = fact;
    let mut text = format!("{library} {version} {what}\n  {input}\n  gives: {result}");
    if !ours.is_empty() {
        text += &format!("\n  frusta: {ours}");
    }
    text
}

/// A headline.
pub fn headline(headline: &Headline) -> String {
    let Headline { what, ratio, least } = headline;
    format!("{what:<86} {ratio:5.2} {least:5.2}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_fit() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(123), "123");
        assert_eq!(grouped(2_000_000), "2,000,000");
        assert_eq!(fitted("abcdef", 6), "abcdef");
        assert_eq!(fitted("abcdefg", 6), "abcd…g");
        assert_eq!(fitted("abcdefghijklm", 8), "abcdef…m");
        assert_eq!(heading().chars().count(), 100);
    }
}
