//! G8 between machines: the bits of a fixed set of answers, recorded (see `frusta_lab::digest`). The same
//! test runs again in a build that may use AVX2 and fused multiply-add, and in one without vector registers;
//! `scripts/targets` runs the same work on other targets.

use frusta_lab::digest::records;

#[test]
fn g8_all_answers_are_as_recorded() {
    let mut count = 0;
    for record in records() {
        assert!(record.is_met(), "{record:#x?}");
        count += 1;
    }
    assert_eq!(count, 5);
}
