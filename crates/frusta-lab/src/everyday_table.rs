//! Everyday segments as text, in lines of at most 100 columns.

use super::everyday::{Everyday, EverydayRow};
use super::figures::{self, fit};
use super::paper::Tier;
use super::turns::Spread;
use std::fmt;

const LEGEND: &str = "
L-B ns      nanoseconds a segment of textbook Liang-Barsky, plain, one segment a call
all others  how many times as fast as that, with the spread over the rounds; tuned: Liang-Barsky
";

const FEW: &str = "Branch predictors learn so few segments: the times flatter branches.\n";

impl fmt::Display for Everyday {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "Everyday segments: {} of each mix, f64, {} rounds",
            self.segments, self.rounds
        )?;
        let Some([_, clippers @ ..]) = self.by_mix().next() else {
            return Ok(());
        };
        heading(f, clippers)?;
        self.by_mix().try_for_each(|rows| line(f, rows))?;
        write!(f, "{:30}", "geometric mean")?;
        for row in clippers {
            cell(f, self.speed(row.algorithm, row.tier, row.slices))?;
        }
        writeln!(f)?;
        f.write_str(LEGEND)?;
        let [plain, exact] = Tier::ALL.map(|tier| self.wrong(tier));
        writeln!(f, "wrong       answers: {plain} plain, {exact} exact")?;
        f.write_str(if self.flatters_branches() { FEW } else { "" })
    }
}

fn heading(f: &mut fmt::Formatter<'_>, clippers: &[EverydayRow]) -> fmt::Result {
    let slices = format!("slices of {}", Everyday::SLICE);
    write!(f, "\n{:30} {:^32}      {slices}", "", "one segment a call")?;
    write!(f, "\n{:21} {:>8}", "", "L-B ns")?;
    for row in clippers {
        let name = row.algorithm.trim_start_matches("liang-barsky-");
        write!(f, " {name:>10}")?;
    }
    write!(f, "\n{:30}", "")?;
    for row in clippers {
        write!(f, " {:>10}", row.tier.name())?;
    }
    writeln!(f)
}

/// A mix at a place.
fn line(f: &mut fmt::Formatter<'_>, rows: &[EverydayRow]) -> fmt::Result {
    let [reference, clippers @ ..] = rows else {
        return Ok(());
    };
    let nanoseconds = fit(reference.timing.nanoseconds, 1, 8);
    let EverydayRow { place, mix, .. } = reference;
    write!(f, "{place:<6} {mix:<14} {nanoseconds:>8}")?;
    for row in clippers {
        cell(f, row.speed())?;
    }
    writeln!(f)
}

fn cell(f: &mut fmt::Formatter<'_>, speed: Option<Spread>) -> fmt::Result {
    write!(f, " {:>10}", figures::ratio(speed.unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use crate::everyday;

    #[test]
    fn the_table_fits_a_terminal_and_says_what_flatters() {
        let mut found = everyday(100, 1, || ());
        let text = found.to_string();
        assert!(
            text.lines().all(|line| line.chars().count() <= 100),
            "{text}"
        );
        for part in [
            "\nworld  long-crossing ",
            "\ngeometric mean ",
            "flatter branches",
        ] {
            assert!(text.contains(part), "{part:?} not in\n{text}");
        }
        found.segments = 1_000_000;
        assert!(!found.to_string().contains("flatter"));
        // Without times there is a dash for each speed and each mean.
        let untimed = everyday(100, 0, || ()).to_string();
        assert_eq!(untimed.matches(" -").count(), 6 * 9, "{untimed}");
    }
}
