//! Conversions to and from other libraries' types, one feature a library.
//!
//! All are exact and cost nothing but moves. Matrices convert to and from
//! [`ViewProjection`](crate::ViewProjection), each with the layout its library
//! documents, so that no caller has to name one.

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
