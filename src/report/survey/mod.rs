//! Error against run time: every algorithm in every arithmetic tier on every
//! family, held against the oracle.

mod row;

pub use row::{
    Survey, SurveyAlgorithm, SurveyError, SurveyRow, SurveyTier, SurveyWitness, SurveyWorst,
    UnknownName,
};
