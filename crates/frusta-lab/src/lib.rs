//! Measures [`frusta`]: error against run time, the paper's table, verification; and holds the
//! scenes and checks that tests, benchmarks and fuzz targets share. The command `frusta` prints
//! what this crate measures.
//!
//! ```text
//! survey/    every algorithm in every arithmetic on families of hard cases: errors and run times
//! everyday   run times on segments as programs have them
//! volumes    boxes, spheres and batches: errors, false accepts, run times
//! paper      the paper's table on its 78 singular samples: paper_answers, paper_timing
//! verify     every family through the exact clipper; verify_volumes: through the culler
//! *_table    the same as text; paper_summary: the paper's table in short; figures: numbers
//! turns      how all run times are taken; work: how much of a measurement is done
//! case_line  a frustum and a segment as one line of text, to the bit
//! check      all guarantees of one segment's answers at once
//! digest     the bits of a fixed set of answers, as recorded; the program frusta-digest prints them
//! mixes      frusta and everyday segments of the benchmarks
//! ```

mod case_line;
pub mod check;
pub mod digest;
mod everyday;
mod everyday_table;
pub mod figures;
pub mod mixes;
mod paper;
mod paper_answers;
mod paper_summary;
mod paper_table;
mod paper_timing;
mod survey;
pub mod turns;
mod verify;
mod verify_table;
mod verify_volumes;
mod volumes;
mod volumes_table;
mod work;

pub use case_line::{CaseLine, CaseLineError, CaseSegment};
pub use everyday::{Everyday, EverydayRow, everyday, everyday_rounds};
pub use paper::{PaperRow, PaperTable, Tier, paper_rounds, paper_table, rotated_poses};
pub use paper_answers::{PaperFailure, Score, Topology};
pub use paper_summary::PaperSummary;
pub use survey::{
    Survey, SurveyAlgorithm, SurveyClipper, SurveyError, SurveyOptions, SurveyRow, SurveyTable,
    SurveyTier, SurveyWitness, SurveyWorst, UnknownName, survey,
};
pub use turns::{Spread, Timing, geometric_mean};
pub use verify::{ExactClipper, FamilyRow, Options, Subject, Witness, verify, verify_watched};
pub use verify_table::VerifyTable;
pub use verify_volumes::{VolumeKind, VolumeRow, VolumeTally, verify_volumes};
pub use volumes::{FalseAccepts, VolumePlan, VolumeSurvey, VolumeTime, volumes};
pub use work::{OnWork, Work};

#[cfg(test)]
mod tests;
