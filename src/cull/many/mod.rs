//! One query for many volumes: boxes and spheres in vector registers, on one thread or many.
//!
//! Answers are those of [`Culler::classify`](crate::Culler::classify), for every input. What a
//! kernel cannot decide in the volumes' own scalar type is classified one by one. Answers go
//! to the caller's buffers, which are used again: nothing is allocated once these are large
//! enough, except where big integers are needed and, in parallel, a little for each piece.
//!
//! ```text
//! query         Culler::over and its options
//! source        where volumes come from: arrays, slices, sets
//! output        where answers go: masks, classes, indices
//! masks         a bit for each volume
//! block_driver  256 volumes at a time; undecided ones one by one
//! kernels       a block of boxes or spheres, by vector registers
//! one           the same without vector registers
//! boxes         axis-aligned boxes in arrays and slices
//! oriented      oriented boxes in slices
//! box_set       boxes that are kept: validated and laid out once, fastest to query
//! relative      boxes in f64, read in f32 relative to an anchor near them
//! spheres       spheres in arrays and slices
//! parallel      (feature) pieces on rayon's threads
//! ```

mod block_driver;
mod box_set;
mod boxes;
#[cfg(simd)]
mod kernels;
mod masks;
#[cfg(not(simd))]
mod one;
mod oriented;
mod output;
#[cfg(feature = "parallel")]
pub(super) mod parallel;
mod query;
mod relative;
mod source;
mod spheres;

pub use box_set::BoxSet;
pub use boxes::BoxArrays;
pub use masks::ContainmentMasks;
pub use query::VolumeQuery;
pub use relative::{RelativeBoxes, RelativeError};
pub use source::VolumeSource;
pub use spheres::SphereArrays;

#[cfg(test)]
mod query_tests;
#[cfg(test)]
pub(super) mod tests;
