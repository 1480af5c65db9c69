//! Pictures of samples.
//!
//! ```text
//! page       one sample, large
//! sheet      all samples, small
//! ```

mod page;
mod sheet;

pub(super) use page::page;
pub(super) use sheet::sheet;
