//! Bounding volumes against a frustum: outside, crossing or inside, decided exactly.
//!
//! Use it to find which objects can be visible, by their bounding boxes or spheres, before they
//! are drawn, picked or loaded. [`Culler`] is a frustum that is prepared for this; its page lists
//! the calls.
//!
//! ```
//! use frusta::cull::{Aabb, Containment, Culler, Sphere};
//! use frusta::{Camera, Projection};
//! let camera = Camera {
//!     eye: [0.0, 0.0, 5.0].into(),
//!     target: [0.0, 0.0, 0.0].into(),
//!     up: [0.0, 1.0, 0.0].into(),
//!     projection: Projection::Perspective { fovy: 1.0, aspect: 1.5 },
//!     near: 0.1,
//!     far: 100.0,
//! };
//! let culler = Culler::new(&camera.frustum()?);
//! assert_eq!(culler.classify(Sphere::new([0.0, 0.0, 0.0], 1.0))?, Containment::Inside);
//! let boxes = [Aabb::new([-1.0_f32; 3], [1.0; 3]), Aabb::new([0.0, 0.0, 6.0], [1.0, 1.0, 7.0])];
//! let mut visible = Vec::new();
//! culler.over(&boxes).visible(&mut visible)?;
//! assert_eq!(visible, [0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ```text
//! volume      the volumes, and what makes one invalid
//! support     how far a volume reaches along a normal
//! culler      one volume, face plane by face plane
//! unbounded   boxes with infinite sides, and the empty box
//! separation  the separating axis test, for volumes that no face plane rejects
//! many        one query for many volumes, in vector registers and on threads
//! segments    intervals of many segments
//! counts      which stages an answer needed
//! ```

mod counts;
mod culler;
mod many;
mod segments;
mod separation;
mod support;
mod unbounded;
mod volume;

pub use counts::VolumeCounts;
pub use culler::{Culler, MaskedContainment};
pub use many::{
    BoxArrays, BoxSet, ContainmentMasks, RelativeBoxes, RelativeError, SphereArrays, VolumeQuery,
    VolumeSource,
};
pub use volume::{Aabb, Containment, Obb, Sphere, Volume, VolumeError, VolumeErrorAt};
