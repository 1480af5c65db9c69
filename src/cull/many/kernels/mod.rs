//! The kernels: the answers about a block of volumes, a register of them at a time.
//!
//! Where no code for vector registers is compiled (see `build.rs`), [`super::one`] takes their place.

pub(super) mod boxes;
pub(super) mod spheres;
