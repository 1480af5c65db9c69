//! The table on the terminal, 100 columns wide.

use crate::facts::Fact;
use crate::file::{Headline, Row};
use std::fmt::Write;

/// The columns' names.
pub fn heading() -> String {
    format!(
        "{:<43} {:>3} {:>6} {:>5} {:>7} {:>7} {:>7} {:>7} {:>7}",
        "", "", "ns", "ratio", "phantom", "missed", "place", "outside", "refused"
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
        return format!("{name:<43}");
    }
    let time = |t: Option<f64>, digits| t.map_or("-".into(), |t| format!("{t:.digits$}"));
    let count = |n: Option<u64>| n.map_or("-".into(), |n| n.to_string());
    let mut line = format!(
        "{:<43} {:>3} {:>6} {:>5}",
        fitted(&name, 43),
        row.scalar,
        time(row.ns_median, 1),
        time(row.time_ratio, 2)
    );
    for n in [
        row.phantom,
        row.missed,
        row.misplaced,
        row.outside,
        row.refused,
    ] {
        // A text cannot fail to be written to.
        let _ = write!(line, " {:>7}", count(n));
    }
    line
}

/// The first so many characters, a dot for what is missing.
fn fitted(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    text.chars().take(width - 1).chain(['…']).collect()
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
        assert_eq!(fitted("abcdefg", 6), "abcde…");
        assert_eq!(heading().chars().count(), 100);
    }
}
