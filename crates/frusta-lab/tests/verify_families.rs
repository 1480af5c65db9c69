//! G1 to G6 of the exact clipper on every family of cases, f64 and f32.

use frusta_lab::{ExactClipper, Options, VerifyTable, verify};

#[test]
fn the_exact_clipper_is_clean_in_every_family() {
    let options = Options {
        cases: 1024,
        threads: 2,
        seed: 20_261_122,
        ..Options::default()
    };
    let rows = verify(&ExactClipper, &options, |_| {});
    let table = VerifyTable(&rows);
    assert!(rows.iter().all(|row| row.is_clean()), "\n{table}");
    for row in &rows {
        assert!(2 * row.near >= row.cases, "{}\n{table}", row.family);
    }
    // Each stage of the predicates must have been reached.
    let reached = |stage: fn(&frusta_lab::FamilyRow) -> u64| rows.iter().map(stage).sum::<u64>();
    assert!(reached(|r| r.cases - r.filter_failures) > 0, "\n{table}");
    assert!(reached(|r| r.expansions) > 0, "\n{table}");
    assert!(reached(|r| r.integers) > 0, "\n{table}");
}
