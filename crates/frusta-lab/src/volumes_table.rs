//! Volumes as text, in lines of at most 100 columns.

use super::figures::{self, fit};
use super::volumes::VolumeSurvey;
use std::fmt;

impl fmt::Display for VolumeSurvey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Boxes, spheres and batches\n")?;
        writeln!(
            f,
            "{:<12} {:>10} {:>8} {:>8} {:>8} {:>8}   hard cases of all families",
            "", "cases", "wrong", "outside", "batch", "exact"
        )?;
        for (kind, t) in &self.errors {
            writeln!(
                f,
                "{:<12} {:>10} {:>8} {:>8} {:>8} {:>8}",
                kind.name(),
                t.cases,
                t.wrong,
                t.wrongly_outside,
                t.wrong_in_batch,
                t.wrong_exact
            )?;
        }
        writeln!(
            f,
            "\n{:>12} {:>8} {:>10} {:>10} {:>10}   boxes that no face rejects",
            "half extent", "view", "accepted", "falsely", "share"
        )?;
        for row in &self.accepts {
            writeln!(
                f,
                "{:>8} far {:>4} rad {:>10} {:>10} {:>8} %",
                row.size,
                row.field_of_view,
                row.accepted,
                row.falsely,
                fit(100.0 * row.share(), 2, 8)
            )?;
        }
        writeln!(
            f,
            "\n{:<34} {:>8} {:>14}   f32, {} of each, {} rounds",
            "", "ns", "times as fast", self.timed, self.rounds
        )?;
        for row in &self.times {
            let speed = figures::ratio(row.timing.speed().unwrap_or_default());
            let name = format!("{}: {}", row.job, row.function);
            let time = fit(row.timing.nanoseconds, 2, 8);
            writeln!(f, "{name:<34} {time:>8} {speed:>14}")?;
        }
        f.write_str(LEGEND)
    }
}

const LEGEND: &str = "
wrong, outside  wrong classes; those among them that are wrongly outside
batch, exact    wrong classes in batches; wrong answers of the exact test
falsely         boxes that are outside of the frustum; the exact test rejects them
times as fast   as the job's first function, one volume a call; with the spread over the rounds
";

#[cfg(test)]
mod tests {
    use crate::{VolumePlan, volumes};
    use frusta::samples::Family;

    #[test]
    fn the_table_fits_a_terminal_and_all_is_in_it() {
        let mut plan = VolumePlan {
            families: vec![Family::Random, Family::HalfLattice],
            cases: 70,
            seed: 2,
            threads: 2,
            boxes: 500,
            timed: 300,
            rounds: 1,
        };
        let found = volumes(&plan, &|_, _| {});
        assert!(found.is_right());
        assert!(found.errors.iter().all(|(_, tally)| tally.cases > 0));
        let text = found.to_string();
        assert!(
            text.lines().all(|line| line.chars().count() <= 100),
            "{text}"
        );
        for part in [
            "\nbox-f32 ",
            "0.5 far  0.1 rad ",
            "\nsegment: clip_intervals, arrays ",
        ] {
            assert!(text.contains(part), "{part:?} not in\n{text}");
        }
        // Larger boxes and narrower views are accepted falsely more often.
        let shares: Vec<f64> = found.accepts.iter().map(|row| row.share()).collect();
        assert!(shares[3] > shares[0] && shares[5] > shares[2], "{shares:?}");
        plan.rounds = 0;
        assert_eq!(
            volumes(&plan, &|_, _| {})
                .to_string()
                .matches(" -\n")
                .count(),
            13
        );
    }
}
