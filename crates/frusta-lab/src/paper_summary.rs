//! The paper's table in short: `f64` alone, one count of wrong answers.

use super::figures::{RATIO_LEGEND, fit, ratio};
use super::paper::{PaperRow, PaperTable};
use super::turns::Spread;
use std::fmt;

/// Displays the table's rows in `f64`, in lines of at most 100 columns; [`PaperTable`] itself
/// displays all of it.
#[derive(Clone, Copy, Debug)]
pub struct PaperSummary<'a>(pub &'a PaperTable);

const LEGEND: &str = "
the paper  \"View Frustum Culling Geometric Algorithm\" (in Chinese), the source of projection
           reduction onto two planes: V/W, or vw. It gives 4243 : 4228 : 4212 for the first three
           rows, without a unit or a machine, and says that six planes err where the others do not
the 78     segments that touch, cross or lie in corners, edges and faces of a frustum, derived from
           the paper's description; the larger number: also lengthened, in 48 orientations of the
           axes, and in rotated poses
time       as a multiple of plain textbook Liang-Barsky's. In order, as in the paper, branch
           predictors learn the samples by heart; shuffled, they cannot
wrong      class (outside, touching, crossing ..), faces, or whether an end was clipped
";

impl fmt::Display for PaperSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows: Vec<&PaperRow> = self.0.rows.iter().filter(|r| r.scalar == "f64").collect();
        let Some(first) = rows.first() else {
            return Ok(());
        };
        let [own, all] = samples(first);
        writeln!(
            f,
            "The paper's table, made again: its {own} singular samples in f64, each clipped {} times\n",
            self.0.repeats
        )?;
        let counts = [own, all].map(|n| format!("of {n}"));
        writeln!(
            f,
            "{:27} {:^33} {:>9} {:^20}",
            "", "time", "ns", "wrong answers"
        )?;
        writeln!(
            f,
            "{:27} {:>9} {:>11} {:>11} {:>9} {:>9} {:>10}",
            "", "the paper", "in order", "shuffled", "shuffled", counts[0], counts[1]
        )?;
        rows.into_iter().try_for_each(|row| line(f, row))?;
        f.write_str(LEGEND)?;
        f.write_str(RATIO_LEGEND)
    }
}

/// How many samples there are as in the paper, and in all.
fn samples(row: &PaperRow) -> [usize; 2] {
    let all = row.scores().iter().map(|score| score.samples).sum();
    [row.standard.samples, all]
}

fn line(f: &mut fmt::Formatter<'_>, row: &PaperRow) -> fmt::Result {
    let paper = row.paper.map_or("-".into(), |r| format!("{r:.3}"));
    let wrong: usize = row.scores().iter().map(|score| score.wrong()[1]).sum();
    let [order, shuffled]: [Spread; 2] = [row.in_order.ratio, row.shuffled.ratio];
    writeln!(
        f,
        "{:<5} {:<21} {paper:>9} {:>11} {:>11} {:>9} {:>9} {wrong:>10}",
        row.tier.name(),
        row.algorithm,
        ratio(order),
        ratio(shuffled),
        fit(row.shuffled.nanoseconds, 1, 6),
        row.standard.wrong()[1],
    )
}

#[cfg(test)]
mod tests {
    use crate::{PaperSummary, paper_table};

    #[test]
    fn the_summary_is_short_and_has_every_algorithm_twice() {
        let table = paper_table(20, || ());
        let text = PaperSummary(&table).to_string();
        let widest = text.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(100), "{text}");
        assert!(text.lines().count() <= 30, "{text}");
        for part in ["\nplain six-planes ", "\nexact vw ", " of 27456\n", "0.996"] {
            assert!(text.contains(part), "{part:?} not in\n{text}");
        }
        let lines = |tier: &str| text.lines().filter(|line| line.starts_with(tier)).count();
        assert_eq!((lines("plain "), lines("exact ")), (6, 6));
    }
}
