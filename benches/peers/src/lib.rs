//! Other libraries' clipping and culling beside frusta's: the same jobs on the same
//! input, their times, and their wrong answers, counted by frusta's oracle.
//!
//! - [`peer`]: the interface of a library that takes part
//! - [`scene`]: the frusta and the matrices that describe them to the others
//! - [`segments`], [`quads`], [`boxes`]: the jobs, a file a library
//! - [`tally`]: wrong answers, counted
//! - [`contest`]: the jobs, their inputs, and who takes part
//! - [`facts`]: single inputs that end badly, each in a process of its own
//! - [`file`](mod@file), [`table`], [`versions`], [`machine`]: the output
//!
//! `README.md` documents the jobs, the file and our bias.

pub mod boxes;
pub mod contest;
pub mod facts;
pub mod file;
pub mod machine;
pub mod peer;
pub mod quads;
pub mod scene;
pub mod segments;
pub mod table;
pub mod tally;
pub mod versions;
