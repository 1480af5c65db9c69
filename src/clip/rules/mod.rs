//! The rules that a single segment, a slice and a set of intervals share, each written once.
//!
//! ```text
//! compare      comparison and selection, lane by lane
//! triage       what the signs of boundary values prove
//! certificate  what rounded crossing parameters prove
//! site         the tie rule, and parameters and points of crossings
//! ```
//! A register holds either the faces of one segment (`f64x2`) or one face of several segments
//! (`f64x4`, and for intervals also `f32x8` and `f32x16`). The rules are the same operations in
//! the same order, so that the bits are the same.

pub(crate) mod certificate;
pub(crate) mod compare;
pub(crate) mod site;
pub(crate) mod triage;
