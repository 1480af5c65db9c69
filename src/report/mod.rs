//! Measuring clippers and saying what was found.

mod verify;
mod verify_table;

pub use verify::{ExactClipper, FamilyRow, Options, Subject, Witness, verify, verify_watched};
pub use verify_table::VerifyTable;

#[cfg(test)]
mod tests;
