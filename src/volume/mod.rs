//! Bounding volumes against a frustum: outside, crossing or inside, exactly.
//!
//! [`Culler`] is a frustum made ready for it. [`Culler::classify`] goes plane by plane;
//! [`Culler::classify_among`] does so for trees, with face masks and hints;
//! [`Culler::classify_exact`] goes on where that only may be wrong.
//!
//! ```text
//! shape       the volumes, and why numbers are none
//! half_space  a half space that is known exactly, and signs in stages
//! rows        the faces' half spaces in the scalar type of a batch
//! extent      how far a volume reaches along a normal
//! culler      plane by plane
//! apart       separating axes, for boxes that are outside of no face
//! ```

mod apart;
mod counts;
mod culler;
mod extent;
mod half_space;
mod rows;
mod shape;

pub use counts::VolumeCounts;
pub use culler::{Among, Culler};
pub(crate) use rows::{Row, Rows};
pub use shape::{Aabb, Containment, Obb, Sphere, Volume, VolumeError, VolumeErrorAt};
