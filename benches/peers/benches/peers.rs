//! The same contests by Criterion:
//! `cargo bench --manifest-path benches/peers/Cargo.toml [-- FILTER]`.
//!
//! Answers are judged before they are timed: the exact tier must be right, and no library may
//! refuse an input. The program itself takes times in turns, which is better on a shared machine.

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use frusta_peers::contest::{self, Effort};
use std::time::Duration;

/// Cases whose answers are judged before.
const JUDGED: Effort = Effort {
    lattice: 2000,
    mix: 2000,
    rounds: 0,
    ..Effort::FULL
};

fn peers(c: &mut Criterion) {
    for contest in contest::all() {
        let tallies = contest.tallies(&JUDGED, &|_| ());
        let mut group = c.benchmark_group(format!("{}/{}", contest.job(), contest.input()));
        group.throughput(Throughput::Elements(JUDGED.timed as u64));
        group.sampling_mode(SamplingMode::Flat);
        for (mut contestant, tally) in contest.loaded(&JUDGED).into_iter().zip(tallies) {
            let who = contestant.who();
            if let Some(tally) = tally {
                assert_eq!(tally.refused, 0, "{who:?}");
                let is_exact = who.library == "frusta" && !who.function.contains("plain");
                assert!(!is_exact || tally.wrong() == 0, "{who:?}: {tally:?}");
            }
            let name = format!("{}/{}/{}", who.library, who.function, who.scalar);
            group.bench_function(name, |b| b.iter(|| contestant.pass()));
        }
    }
}

/// Short, since there are many: raise with `--measurement-time`.
fn config() -> Criterion {
    Criterion::default()
        .without_plots()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(400))
}

criterion_group! {
    name = benches;
    config = config();
    targets = peers
}
criterion_main!(benches);
