//! Bounding volumes against a frustum: outside, crossing or inside, exactly.
//!
//! [`Culler`] is a frustum made ready for it. [`Culler::classify`] goes plane by plane;
//! [`Culler::classify_masked`] does so for trees, with face masks and hints;
//! [`Culler::classify_exact`] goes on where that only may be wrong.
//!
//! ```text
//! volume      the volumes, and what makes one invalid
//! support     how far a volume reaches along a normal
//! culler      one volume, face plane by face plane
//! separation  the separating axis test, for volumes that no face plane rejects
//! many        one query for many volumes, in vector registers and by threads
//! counts      which stages an answer needed
//! ```

mod counts;
mod culler;
mod many;
mod separation;
mod support;
mod volume;

pub use counts::VolumeCounts;
pub use culler::{Culler, MaskedContainment};
pub use many::{
    BoxArrays, BoxBlocks, BoxSet, Boxes, ContainmentMasks, RelativeBoxes, RelativeError,
    SphereArrays, Spheres,
};
pub use volume::{Aabb, Containment, Obb, Sphere, Volume, VolumeError, VolumeErrorAt};
