//! Bounding volumes against a frustum: outside, crossing or inside.

mod shape;

pub use shape::{Aabb, Containment, Obb, Sphere, Volume, VolumeError, VolumeErrorAt};
