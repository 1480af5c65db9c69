//! Error against run time: every algorithm in every arithmetic tier on every
//! family, held against the oracle.

mod fused;
mod row;

pub use fused::fuses_in_one_instruction;
pub use row::{
    Survey, SurveyAlgorithm, SurveyError, SurveyRow, SurveyTier, SurveyWitness, SurveyWorst,
    UnknownName,
};
