//! Scalars, vectors, segments, rectangles and poses.
//!
//! Every operation has one fixed order of evaluation, so that the same input
//! gives the same bits on every platform. Nothing here depends on frusta.

pub mod hex;
mod interval;
mod pose;
mod real;
mod rect;
mod segment;
mod vec3;

pub use interval::Interval;
pub use pose::Pose;
pub(crate) use real::PerReal;
pub use real::Real;
pub(crate) use real::Short;
pub use rect::Rect;
pub use segment::{End, NonFinite, NonFiniteAt, Segment};
pub use vec3::{Axis, Vec3};
