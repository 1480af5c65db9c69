//! Exactly right and fast clipping against view frusta.
//!
//! | module | what is in it |
//! |---|---|
//! | [`math`] | points, segments, rectangles, poses |
//! | [`frustum`] | [`Frustum`] and its constructors: [`Camera`], [`ViewProjection`], [`SixPoints`] |
//! | [`clip`] | [`Frustum::clip_segment`], [`Frustum::clip_segments`], and the algorithms behind [`SegmentClipper`] |
//! | [`cull`] | boxes, oriented boxes, spheres: outside, crossing or inside a frustum |
//! | [`guarantees`] | a page: what is guaranteed, and how it is known |
//! | [`samples`] | the 78 singular samples, and seeded families of hard cases |
//! | `oracle` | (feature `oracle`) the truth by rational arithmetic |
//! | `report` | (feature `report`) measuring and verifying |
//!
//! # A first example
//! ```
//! use frusta::{Class, EndRect, Face, Frustum, Pose, Segment, Shape};
//!
//! // From a unit square at z = 1 to a square three times as large at z = 3.
//! let frustum = Frustum::new(
//!     Pose::IDENTITY,
//!     Shape::Finite {
//!         near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
//!         far: EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0),
//!     },
//! )?;
//! let clip = frustum.clip_segment(&Segment::new([0.0, 0.0, 2.0], [4.0, 0.0, 2.0]))?;
//! assert_eq!(clip.class, Class::Cross);
//! let exit = clip.part.unwrap().exit;
//! assert_eq!((exit.t, exit.point), (0.5, [2.0, 0.0, 2.0].into()));
//! assert!(exit.faces.contains(Face::Right));
//!
//! // Through an edge from outside to outside: one point in common.
//! let clip = frustum.clip_segment(&Segment::new([3.0, 1.0, 2.0], [1.0, 3.0, 2.0]))?;
//! assert_eq!(clip.class, Class::Touch);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Guarantees
//! For every finite segment, exact arithmetic (the default) gives:
//!
//! - **G1** the exact [`Class`] and face sets;
//! - **G2** unclipped ends bit for bit; in the identity pose a hit on near or far has that
//!   face's `z`, rounded to the segment's type (`Inward`: if a point with it is inside);
//! - **G3** points to the [`Accuracy`] asked for;
//! - **G4** with [`Accuracy::Inward`], points that are in the frustum, where any
//!   representable point near is (`PartEnd::inward` tells);
//! - **G5** the swapped result for swapped ends, bit for bit;
//! - **G6** `Inward` results, `inward` at both ends, that clip to themselves;
//! - **G8** the same bits with every algorithm, on every platform and number of
//!   threads, one by one or in slices, with SIMD or without.
//!
//! (**G7**, how far an `Inward` end could still move outwards, is measured, not
//! promised.) A coordinate that is not finite is an error, never a panic.

pub mod clip;
pub mod cull;
mod exact;
pub mod frustum;
pub mod guarantees;
mod interop;
pub mod math;
#[cfg(feature = "oracle")]
pub mod oracle;
#[cfg(feature = "samples")]
pub mod samples;
mod simd;

pub use clip::{
    Accuracy, Arithmetic, Class, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, Part,
    PartEnd, SegmentClip, SegmentClipper, SixPlanes, StageCounts, VwProjection,
};
pub use cull::{
    Aabb, Containment, Culler, MaskedContainment, Obb, Sphere, Volume, VolumeCounts, VolumeError,
    VolumeErrorAt,
};
pub use frustum::{
    Camera, ClipSpace, ClipY, Corners, DepthRange, Deviation, Direction, EndRect, Face, FaceSet,
    FaceSetIter, FarCorners, Frustum, FrustumError, MatrixFrustum, MatrixLayout, Plane, Projection,
    Shape, SixPoints, Trapezoid, TrapezoidEnd, ViewProjection,
};
pub use math::{Axis, End, Interval, NonFinite, NonFiniteAt, Pose, Real, Rect, Segment, Vec3};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
