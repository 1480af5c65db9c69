//! The paper's table as text, in lines of at most 100 columns.

use super::figures::{fit, ratio};
use super::paper::{PaperRow, PaperTable};
use super::paper_answers::{PaperFailure, Score};
use std::fmt;

/// How many failing samples are listed for a clipper other than [`LISTED_IN_FULL`].
const FIRST: usize = 3;

/// The clipper that the paper says errs.
const LISTED_IN_FULL: &str = "six-planes";

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
paper     its run times, 4243 : 4228 : 4212, as multiples of Liang-Barsky's
in order  time as a multiple of plain textbook Liang-Barsky's in the same type, with its spread;
          the samples in order, as in the paper
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
    let [stretched, turned, rotated] =
        [&row.stretched, &row.turned, &row.rotated].map(|s| format!("of {}", s.samples));
    writeln!(
        f,
        "\n{:21} {:^29} {right:>10} {:^26}",
        "", "run time", "wrong"
    )?;
    writeln!(f, "{:62}{stretched:>9}{turned:>9}{rotated:>9}", "")?;
    writeln!(
        f,
        "{:21} {:>5} {:>8} {:>8} {:>5} {:>5} {:>4}{:>9}{:>9}{:>9} {:>5} {:>4}",
        "",
        "paper",
        "in order",
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
    let [order, shuffled] = [row.in_order, row.shuffled].map(|timing| ratio(timing.ratio));
    let nanoseconds = fit(row.shuffled.nanoseconds, 1, 5);
    writeln!(
        f,
        "{:<21} {paper:>5} {order:>8} {shuffled:>8} {nanoseconds:>5} {:>5} {:>4}{:>9}{:>9}{:>9} {error:>5} {ulps:>4}",
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
    let listed = if row.algorithm == LISTED_IN_FULL {
        samples
    } else {
        FIRST.min(samples)
    };
    for failure in &row.failures[..listed] {
        let PaperFailure {
            sample,
            count,
            said,
            truth,
            ..
        } = failure;
        writeln!(f, "{count:>5} {sample:<33} gave {said}")?;
        writeln!(f, "{:39} true {truth}", "")?;
    }
    if listed < samples {
        writeln!(f, "      and on {} more samples", samples - listed)?;
    }
    Ok(())
}
