//! What measures [`frusta`]: the paper's table, error against run time, verification, and the
//! scenes and checks that tests, benchmarks and fuzz targets share.

mod case_line;
pub mod check;
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
