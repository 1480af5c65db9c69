//! Conversions to and from the types of other libraries, with one feature for each
//! (of glam, for each version).
//!
//! All are exact, and nothing but moves. Matrices convert to and from
//! [`ViewProjection`](crate::ViewProjection), each with the layout that its library
//! documents, so that callers need not name one.

#[cfg(feature = "approx")]
mod approx;
#[cfg(feature = "bytemuck")]
#[allow(
    unsafe_code,
    reason = "promises about layouts, for a feature that is off by default"
)]
mod bytemuck;
#[cfg(any(
    feature = "glam",
    feature = "glam027",
    feature = "glam030",
    feature = "glam033"
))]
mod glam;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;
#[cfg(feature = "serde")]
mod serde;
