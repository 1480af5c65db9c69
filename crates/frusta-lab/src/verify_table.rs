//! The table of a verification, in lines of at most 120 columns.

use super::verify::FamilyRow;
use frusta::oracle::ViolationKind as Kind;
use std::fmt;

/// Displays rows as a table, their sum, and the first witnesses.
#[derive(Clone, Copy, Debug)]
pub struct VerifyTable<'a>(pub &'a [FamilyRow]);

/// The table's columns of violations, and the kinds that each sums up.
const COLUMNS: [(&str, &[Kind]); 7] = [
    ("class", &[Kind::Class]),
    ("sets", &[Kind::Set]),
    ("ends", &[Kind::UnclippedEnd, Kind::EndDepth]),
    ("points", &[Kind::Point, Kind::Parameter, Kind::Order]),
    (
        "inward",
        &[Kind::NotInward, Kind::InwardMissed, Kind::InwardFlag],
    ),
    ("G5", &[Kind::Swapped]),
    ("G6", &[Kind::Idempotence]),
];

const WIDTH: usize = 120;

/// The width of a column of violations.
const fn width(name: &str) -> usize {
    if name.len() > 5 { name.len() } else { 5 }
}

impl VerifyTable<'_> {
    /// The columns' names.
    pub fn heading() -> String {
        let mut line = format!("{:<18} {:>3} {:>8}", "family", "", "cases");
        for (name, _) in COLUMNS {
            line += &format!(" {name:>0$}", width(name));
        }
        let names = [
            "near%", "filt.%", "exp.%", "int.%", "none%", "G7max", "mean",
        ];
        let [near, filter, expansions, integers, none, max, mean] = names;
        line += &format!(" {near:>5} {filter:>6} {expansions:>5} {integers:>5} {none:>5}");
        line + &format!(" {max:>6} {mean:>5}")
    }

    /// The lines after the families': their sum, and the first witnesses.
    pub fn summary(&self) -> String {
        Summary(self.0).to_string()
    }
}

struct Summary<'a>(&'a [FamilyRow]);

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut rows = self.0.iter().cloned();
        if let Some(mut total) = rows.next() {
            rows.for_each(|row| total.merge(row));
            line(f, "all", "", &total)?;
            writeln!(f)?;
        }
        let refused: u64 = self.0.iter().map(|r| r.count(Kind::Refused)).sum();
        if refused > 0 {
            writeln!(f, "{refused} cases were refused or panicked")?;
        }
        for row in self.0 {
            if let Some(witness) = &row.witness {
                let text = format!("{} {} {witness}", row.family, row.scalar);
                wrapped(f, &text)?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for VerifyTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", Self::heading())?;
        for row in self.0 {
            writeln!(f, "{row}")?;
        }
        Summary(self.0).fmt(f)
    }
}

/// The family's line of the table.
impl fmt::Display for FamilyRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        line(f, self.family.name(), self.scalar, self)
    }
}

fn line(f: &mut fmt::Formatter<'_>, name: &str, scalar: &str, row: &FamilyRow) -> fmt::Result {
    write!(f, "{name:<18} {scalar:>3} {:>8}", row.cases)?;
    for (name, kinds) in COLUMNS {
        let count: u64 = kinds.iter().map(|&k| row.count(k)).sum();
        write!(f, " {count:>0$}", width(name))?;
    }
    let share = |n: u64, of: u64| {
        let percent = 100.0 * n as f64 / of.max(1) as f64;
        // Three digits, however small.
        let decimals = if percent < 9.995 { 2 } else { 1 };
        format!("{percent:.decimals$}")
    };
    write!(
        f,
        " {:>5} {:>6} {:>5} {:>5} {:>5} {:>6.3} {:>5.2}",
        share(row.near, row.cases),
        share(row.filter_failures, row.cases),
        share(row.expansions, row.cases),
        share(row.integers, row.cases),
        share(row.not_inward, row.inward_ends),
        row.room_max,
        row.room_mean(),
    )
}

/// Words in lines of at most [`WIDTH`] columns, those after the first indented.
fn wrapped(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    let mut column = 0;
    for word in text.split(' ') {
        if column > 0 && column + 1 + word.len() > WIDTH {
            write!(f, "\n   ")?;
            column = 3;
        }
        if column > 0 {
            f.write_str(" ")?;
            column += 1;
        }
        f.write_str(word)?;
        column += word.len();
    }
    writeln!(f)
}
