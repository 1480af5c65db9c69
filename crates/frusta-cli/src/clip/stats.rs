//! The statistics of a run, for people and for programs.

use crate::failure::one_line;
use frusta::{Class, Deviation, Frustum, SegmentClip, StageCounts};
use serde_json::{Value, json};
use std::fmt::Write;
use std::time::Duration;

/// Sums over segments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Counts {
    /// By class, in the order of [`Class::ALL`].
    pub(crate) classes: [u64; 5],
    /// Number of clipped ends.
    pub(crate) clipped_ends: u64,
    /// Number of clipped ends that are not proven inside: all, except with `--accuracy inward`.
    pub(crate) not_inward: u64,
    /// Which stages decided.
    pub(crate) stages: StageCounts,
}

impl Counts {
    /// Counts a result.
    pub(crate) fn add<T>(&mut self, clip: &SegmentClip<T>) {
        self.classes[clip.class as usize] += 1;
        if let Some(part) = &clip.part {
            for end in [&part.entry, &part.exit] {
                self.clipped_ends += u64::from(end.clipped);
                self.not_inward += u64::from(!end.inward);
            }
        }
    }

    /// Adds another sum.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (mine, theirs) in self.classes.iter_mut().zip(other.classes) {
            *mine += theirs;
        }
        self.clipped_ends += other.clipped_ends;
        self.not_inward += other.not_inward;
        self.stages += other.stages;
    }

    /// Number of segments.
    pub(crate) fn segments(&self) -> u64 {
        self.classes.iter().sum()
    }
}

/// Where the time went. `read`, `clip` and `write` are sums over the threads;
/// they overlap.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Times {
    pub(crate) read: Duration,
    pub(crate) clip: Duration,
    pub(crate) write: Duration,
    pub(crate) total: Duration,
}

/// Everything about a run.
pub(crate) struct Report<'a> {
    pub(crate) file: String,
    pub(crate) format: &'static str,
    pub(crate) edges: Option<&'static str>,
    pub(crate) algorithm: &'static str,
    pub(crate) arithmetic: &'static str,
    /// With exact arithmetic.
    pub(crate) accuracy: Option<&'static str>,
    pub(crate) precision: &'static str,
    pub(crate) threads: usize,
    pub(crate) flags: &'a str,
    pub(crate) chosen: bool,
    /// For a frustum from a matrix.
    pub(crate) deviation: Option<Deviation>,
    pub(crate) frustum: &'a Frustum,
    pub(crate) output: Option<String>,
    pub(crate) counts: Counts,
    /// Whether `counts.stages` means anything.
    pub(crate) staged: bool,
    pub(crate) times: Times,
}

impl Report<'_> {
    /// The share of segments with a sign that the floating-point filter did not decide;
    /// later stages did, double-double included.
    fn filter_failure_share(&self) -> Option<f64> {
        let segments = self.counts.segments().max(1) as f64;
        let failures = self.counts.stages.filter_failures as f64;
        self.staged.then_some(failures / segments)
    }

    /// As JSON.
    pub(crate) fn to_json(&self) -> Value {
        let counts = &self.counts;
        let classes: serde_json::Map<String, Value> = Class::ALL
            .iter()
            .zip(counts.classes)
            .map(|(class, count)| (class.name().to_owned(), json!(count)))
            .collect();
        json!({
            "file": self.file,
            "format": self.format,
            "edges": self.edges,
            "segments": counts.segments(),
            "classes": classes,
            "clipped_ends": counts.clipped_ends,
            "not_inward": counts.not_inward,
            "stages": self.staged.then_some(counts.stages),
            "filter_failure_share": self.filter_failure_share(),
            "algorithm": self.algorithm,
            "arithmetic": self.arithmetic,
            "accuracy": self.accuracy,
            "precision": self.precision,
            "threads": self.threads,
            "view": {
                "flags": self.flags,
                "chosen": self.chosen,
                "deviation": self.deviation.as_ref().map(deviation_json),
            },
            // In the form that `--frustum` and the library read.
            "frustum": self.frustum,
            "output": self.output,
            "time": {
                "read_s": self.times.read.as_secs_f64(),
                "clip_s": self.times.clip.as_secs_f64(),
                "write_s": self.times.write.as_secs_f64(),
                "total_s": self.times.total.as_secs_f64(),
            },
            "peak_memory_bytes": peak_memory(),
        })
    }

    /// As a table.
    pub(crate) fn to_table(&self) -> String {
        let edges = self.edges.map_or(String::new(), |e| format!(", {e}"));
        let chosen = if self.chosen {
            " (chosen from the scene's extent)"
        } else {
            ""
        };
        let accuracy = self.accuracy.map_or(String::new(), |a| format!(" ({a})"));
        let mut rows = vec![
            ("file", format!("{} ({}{edges})", self.file, self.format)),
            ("view", format!("{}{chosen}", self.flags)),
        ];
        if let Some(Deviation { sides, near, far }) = self.deviation {
            let row = format!("from the matrix: sides {sides:.1e}, near {near:.1e}, far {far:.1e}");
            rows.push(("deviation", row));
        }
        rows.push((
            "algorithm",
            format!(
                "{}, {}{accuracy}, {}",
                self.algorithm, self.arithmetic, self.precision
            ),
        ));
        self.count_rows(&mut rows);
        rows.push(("time", self.time_row()));
        if let Some(bytes) = peak_memory() {
            rows.push(("peak memory", format!("{:.1} MB", bytes as f64 / 1e6)));
        }
        if let Some(output) = &self.output {
            rows.push(("written", output.clone()));
        }
        let mut table = String::new();
        for (name, value) in rows {
            // Writing into memory cannot fail. A file's name may hold anything.
            let _ = writeln!(table, "{name:<13} {}", one_line(&value));
        }
        table
    }

    fn count_rows(&self, rows: &mut Vec<(&str, String)>) {
        let counts = &self.counts;
        let segments = counts.segments();
        rows.push(("segments", grouped(segments)));
        for (class, count) in Class::ALL.iter().zip(counts.classes) {
            let share = 100.0 * count as f64 / segments.max(1) as f64;
            let row = format!("{:>13}  {share:6.2} %", grouped(count));
            rows.push((class.name(), row));
        }
        rows.push(("clipped ends", grouped(counts.clipped_ends)));
        if self.accuracy == Some("inward") {
            rows.push(("not inward", grouped(counts.not_inward)));
        }
        if let Some(share) = self.filter_failure_share() {
            let row = format!(
                "{:.4} % of the segments; later stages gave {} signs by double-double, {} by expansions, {} by integers; {} segments needed no filter, being on a coarse grid",
                100.0 * share,
                grouped(counts.stages.double_doubles),
                grouped(counts.stages.expansions),
                grouped(counts.stages.integers),
                grouped(counts.stages.lattice)
            );
            rows.push(("filter failed", row));
        }
    }

    fn time_row(&self) -> String {
        let times = &self.times;
        format!(
            "{:.3} s (read {:.3}, clip {:.3}, write {:.3}, summed over {} thread{})",
            times.total.as_secs_f64(),
            times.read.as_secs_f64(),
            times.clip.as_secs_f64(),
            times.write.as_secs_f64(),
            self.threads,
            if self.threads == 1 { "" } else { "s" }
        )
    }
}

/// A matrix's deviation; JSON has no infinity.
fn deviation_json(deviation: &Deviation) -> Value {
    let number = |value: f64| {
        if value.is_finite() {
            json!(value)
        } else {
            json!("inf")
        }
    };
    json!({
        "sides": number(deviation.sides),
        "near": number(deviation.near),
        "far": number(deviation.far),
    })
}

/// Digits in groups of three.
fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// Peak memory of the process, if the system reports it.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_come_in_groups_of_three() {
        for (value, text) in [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (3_009_570, "3,009,570"),
        ] {
            assert_eq!(grouped(value), text);
        }
    }
}
