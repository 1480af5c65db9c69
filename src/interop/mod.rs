//! Conversions to and from the types of other libraries, with one feature for each.
//!
//! All are exact, and nothing but moves. Matrices convert to and from
//! [`ViewProjection`](crate::ViewProjection), each with the layout that its library
//! documents, so that callers need not name one.

#[cfg(feature = "approx")]
mod approx;
#[cfg(feature = "glam")]
mod glam;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;
#[cfg(feature = "serde")]
mod serde;
