//! The paper's table as text, in lines of at most 100 columns.

use super::paper::{PaperRow, PaperTable};
use super::paper_answers::{PaperFailure, Score};
use std::fmt;

/// How many failing samples are told of a clipper other than [`TOLD_IN_FULL`].
const FIRST: usize = 3;

/// The clipper that the paper says errs.
const TOLD_IN_FULL: &str = "six-planes";

impl fmt::Display for PaperTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(first) = self.rows.first() else {
            return Ok(());
        };
        let samples = first.standard.samples;
        writeln!(
            f,
            "The {samples} singular samples in the standard frame, each clipped {} times in {} rounds",
            self.repeats, self.rounds
        )?;
        heading(f, first)?;
        let mut group = None;
        for row in &self.rows {
            let (tier, scalar) = (row.tier.name(), row.scalar);
            if group.replace((tier, scalar)) != Some((tier, scalar)) {
                writeln!(f, "{scalar}, {tier}")?;
            }
            line(f, row)?;
        }
        f.write_str(LEGEND)?;
        self.rows.iter().try_for_each(|row| failures(f, row))
    }
}

const LEGEND: &str = "
paper     its run times, 4243 : 4228 : 4212, as ratios to Liang-Barsky's
order     median ratio to textbook Liang-Barsky, plain, same type; the samples in order, as there
shuffled  the same in an order that never repeats, which branch predictors cannot learn
ns        nanoseconds a segment, shuffled
wrong     classes/sets (entry, exit, coplanar, clipped flags), by rational arithmetic. Stretched:
          what juts out is longer by whole factors, so crossing parameters are rounded. Turned,
          rotated: samples, and stretched ones, in 48 axis orientations and in rotated poses
error     the largest of all answers of the right class: in roundoffs of the segment's largest
          coordinate (u*max), and in units in the last place of the exact coordinate
";

fn heading(f: &mut fmt::Formatter<'_>, row: &PaperRow) -> fmt::Result {
    let right = format!("right of {}", row.standard.samples);
    writeln!(
        f,
        "\n{:21} {:^27} {right:>11} {:^28} {:>9}",
        "", "run time", "wrong", "error"
    )?;
    let [stretched, turned, rotated] =
        [&row.stretched, &row.turned, &row.rotated].map(|s| format!("of {}", s.samples));
    writeln!(f, "{:59}{stretched:>10}{turned:>9}{rotated:>10}", "")?;
    writeln!(
        f,
        "{:21} {:>5} {:>6} {:>8} {:>5} {:>5} {:>4}{:>10}{:>9}{:>10} {:>5} {:>4}",
        "",
        "paper",
        "order",
        "shuffled",
        "ns",
        "class",
        "sets",
        "stretched",
        "turned",
        "rotated",
        "u*max",
        "ulp"
    )
}

fn line(f: &mut fmt::Formatter<'_>, row: &PaperRow) -> fmt::Result {
    let paper = row.paper.map_or("-".into(), |r| format!("{r:.3}"));
    let wrong = |s: &Score| format!("{}/{}", s.wrong()[0], s.wrong()[1]);
    let [error, ulps] = row.max_error().map(|e| fit(e, 2, 4));
    let ratios = [row.in_order, row.shuffled].map(|timing| fit(timing.ratio, 3, 6));
    let [order, shuffled] = ratios;
    let nanoseconds = fit(row.shuffled.nanoseconds, 1, 5);
    writeln!(
        f,
        "{:<21} {paper:>5} {order:>6} {shuffled:>8} {nanoseconds:>5} {:>5} {:>4}{:>10}{:>9}{:>10} {error:>5} {ulps:>4}",
        row.algorithm,
        row.standard.right_classes,
        row.standard.right_sets,
        wrong(&row.stretched),
        wrong(&row.turned),
        wrong(&row.rotated),
    )?;
    if row.steady {
        Ok(())
    } else {
        writeln!(f, "{:21} answers differed between passes", "")
    }
}

/// A number in so many columns, with as many of the decimals as fit.
pub(super) fn fit(value: f64, decimals: usize, columns: usize) -> String {
    let decimals = (0..=decimals).rev();
    let texts = decimals.map(|digits| format!("{value:.digits$}"));
    let fitting = texts.into_iter().find(|text| text.len() <= columns);
    fitting.unwrap_or_else(|| format!("{value:.0e}"))
}

/// Which samples were answered wrongly, and how the first time.
fn failures(f: &mut fmt::Formatter<'_>, row: &PaperRow) -> fmt::Result {
    if row.failures.is_empty() {
        return Ok(());
    }
    let (tier, scalar) = (row.tier.name(), row.scalar);
    let samples = row.failures.len();
    let answers: usize = row.failures.iter().map(|failure| failure.count).sum();
    let asked: usize = row.scores().iter().map(|s| s.samples).sum();
    writeln!(
        f,
        "\n{} {tier} {scalar}: {answers} wrong answers of {asked}, on {samples} samples; how often, \
         and the first",
        row.algorithm
    )?;
    let told = if row.algorithm == TOLD_IN_FULL {
        samples
    } else {
        FIRST.min(samples)
    };
    for failure in &row.failures[..told] {
        let PaperFailure {
            sample,
            count,
            said,
            truth,
            ..
        } = failure;
        writeln!(f, "{count:>5} {sample:<33} said {said}")?;
        writeln!(f, "{:39} true {truth}", "")?;
    }
    if told < samples {
        writeln!(f, "      and on {} more samples", samples - told)?;
    }
    Ok(())
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
    }
}
