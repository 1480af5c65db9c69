//! Exactly right and fast clipping and culling against view frusta.
//!
//! Every decision is the sign of an exact value: which edges a frustum cuts and by which faces, which
//! boxes and spheres its faces reject. That holds for every finite `f32` and `f64` input, however large,
//! small or degenerate. Coordinates of points follow from the decisions, to an accuracy that is an
//! argument. A frustum is a closed set: touching counts as meeting it, everywhere.
//!
//! | job | start with |
//! |---|---|
//! | cull or select boxes and spheres | [`Culler`]: one by one, many at once, for trees, exactly; [`cull`] |
//! | clip edges | [`Frustum::clip_segment`], [`Frustum::clip_segments`] (slices, arrays, indexed edges); [`clip`] |
//! | project points to pixels, pixels to rays | [`Projector`]; [`Frustum::view_projection`] for a matrix |
//! | make frusta | [`Camera`], [`ViewProjection`] (matrices of every convention), [`Frustum::new`], [`SixPoints`]; [`frustum`] |
//!
//! # Cull
//! ```
//! use frusta::{Aabb, Camera, Containment, Culler, Projection, Sphere};
//!
//! let camera = Camera {
//!     eye: [0.0, 0.0, 5.0].into(),
//!     target: [0.0, 0.0, 0.0].into(),
//!     up: [0.0, 1.0, 0.0].into(),
//!     projection: Projection::Perspective { fovy: 1.0, aspect: 1.5 },
//!     near: 0.1,
//!     far: 100.0,
//! };
//! let culler = Culler::new(&camera.frustum()?);
//! assert_eq!(culler.classify(Sphere::new([0.0_f32; 3], 1.0))?, Containment::Inside);
//!
//! let in_view = Aabb::new([-1.0_f32; 3], [1.0; 3]);
//! let behind = Aabb::new([-1.0, -1.0, 9.0], [1.0, 1.0, 10.0]);
//! let mut visible = Vec::new();
//! culler.over(&[in_view, behind]).visible(&mut visible)?;
//! assert_eq!(visible, [0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Clip
//! ```
//! use frusta::{Class, EndRect, Face, Frustum, Pose, Segment, Shape};
//!
//! // From a square at z = 1 to a square three times as large at z = 3.
//! let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
//! let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
//! let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
//!
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
//! # Project
//! ```
//! use frusta::{Accuracy, Camera, Projection, Projector, Segment};
//!
//! let projection = Projection::Perspective { fovy: 1.0, aspect: 1.5 };
//! let (eye, target, up) = ([0.0_f32, 0.0, 5.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
//! let frustum = Camera::new(eye, target, up, projection, 0.1, 100.0).frustum()?;
//! let screen = Projector::new(&frustum).pixels(1200, 800);
//!
//! // An edge in pixels: what `Inward` calls inside never leaves the window.
//! let edge = Segment::new([0.0_f32, 0.0, 0.0], [9.0, 0.0, 0.0]);
//! let part = frustum.clip_segment_with(&edge, Accuracy::Inward)?.part.unwrap();
//! let pixel = screen.project(part.exit.point)?.unwrap();
//! assert!(pixel.x > 1199.9 && pixel.x <= 1200.0);
//!
//! // What is in a rectangle of pixels.
//! let band = screen.window([500.0, 300.0], [700.0, 500.0])?;
//! assert!(band.contains([0.0, 0.0, 0.0])?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Make frusta
//! ```
//! use frusta::{ClipSpace, MatrixLayout, ViewProjection};
//!
//! // The columns of a perspective matrix, as glam has them: near 1, far 9, depth from 0 to 1.
//! let columns = [
//!     1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.125, -1.0, 0.0, 0.0, -1.125, 0.0,
//! ];
//! let matrix = ViewProjection::from_flat(columns, MatrixLayout::ColumnMajorColumnVectors);
//! let found = matrix.frustum(ClipSpace::ZERO_TO_ONE)?;
//! assert!(found.frustum.contains([0.0, 5.0, -5.0])?);
//! assert_eq!(found.deviation().sides, 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Modules
//! | module | contents |
//! |---|---|
//! | [`math`] | points, segments, rectangles, poses |
//! | [`frustum`] | [`Frustum`] and its constructors, projection |
//! | [`clip`] | clipping of segments: one, slices, intervals; six algorithms behind [`clip::SegmentClipper`], for comparison |
//! | [`cull`] | boxes, oriented boxes and spheres: outside, crossing or inside |
//! | [`guarantees`] | a page: the guarantees, and how they are known to hold |
//! | `samples` | (feature) the 78 singular samples, and seeded families of hard cases |
//! | `oracle` | (feature) the truth by rational arithmetic |
//!
//! # Features
//! None is on by default.
//!
//! | feature | adds |
//! |---|---|
//! | `parallel` | `.parallel()` on queries, `Culler::par_clip_intervals`: rayon's threads, the same bits |
//! | `glam` (0.34), `glam033`, `glam030`, `glam027` | conversions of points and matrices: bevy 0.20 and rapier 0.36 have 0.33, macroquad 0.4 has 0.27; one feature does not exclude another |
//! | `nalgebra` (0.35), `mint` (0.5) | the same; `mint` is the way round for other versions, as are arrays |
//! | `serde`, `approx` | their traits |
//! | `bytemuck` | points, segments and volumes as plain bytes: slices are cast from and to other types without a copy |
//! | `samples`, `oracle` | the modules above, for tests of clippers and cullers |
//!
//! # Targets
//! Answers are the same to the bit everywhere (`scripts/targets` runs the same work on all of these but the last
//! two rows); speed depends on the vector registers that a target is sure to have, or that are found at run time.
//!
//! | target | slices and queries use |
//! |---|---|
//! | x86-64 | AVX2 where it is found at run time, else SSE2; AVX-512 for intervals in `f32` |
//! | aarch64 | NEON |
//! | wasm32 with `-C target-feature=+simd128` | simd128; without it one segment or volume at a time |
//! | others | one segment or volume at a time |
//! | any, in unoptimised builds (`opt-level = 0`) | one segment or volume at a time |
//!
//! In a development build `[profile.dev.package."*"] opt-level = 3` in the program's `Cargo.toml` gives
//! slices and queries nearly their release speed: their code is compiled here, not in the program.
//!
//! # Guarantees
//! For every finite segment, exact arithmetic (the default) gives:
//!
//! - **G1** the exact [`Class`] and face sets;
//! - **G2** unclipped ends bit for bit; in the identity pose a hit on near or far has that
//!   face's `z`, rounded to the segment's type (`Inward`: if a point with it is inside);
//! - **G3** points to the requested [`Accuracy`];
//! - **G4** with [`Accuracy::Inward`], points in the frustum, where any
//!   representable point near is (see `PartEnd::inward`);
//! - **G5** the swapped result for swapped ends, bit for bit, except parameters, which are measured
//!   from the start;
//! - **G6** `Inward` results, `inward` at both ends, that clip to themselves;
//! - **G8** the same bits with every algorithm, on every platform and number of
//!   threads, one by one or in slices, with SIMD or without.
//!
//! (**G7**, how far an `Inward` end could still move outwards, is measured, not
//! promised.) For volumes: exactly the class by face planes, or with
//! [`Culler::classify_exact`] the exact class. A coordinate that is not finite is an error, never a
//! panic. [`guarantees`] explains each, and how it is known to hold.

#![cfg_attr(
    not(simd),
    allow(
        dead_code,
        unused_imports,
        reason = "what only code for vector registers needs"
    )
)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(not(feature = "bytemuck"), forbid(unsafe_code))]

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

pub use clip::{Accuracy, Class, Part, PartEnd, SegmentClip, StageCounts};
pub use cull::{
    Aabb, Containment, Culler, MaskedContainment, Obb, Sphere, Volume, VolumeCounts, VolumeError,
    VolumeErrorAt,
};
pub use frustum::{
    Camera, ClipSpace, ClipY, Corners, DepthRange, Deviation, Direction, EndRect, Face, FaceSet,
    FaceSetIter, FarCorners, Frustum, FrustumError, MatrixFrustum, MatrixLayout, Plane, Projection,
    Projector, Ray, Shape, SixPoints, Trapezoid, TrapezoidEnd, ViewProjection,
};
pub use math::{Axis, End, Interval, NonFinite, NonFiniteAt, Pose, Real, Rect, Segment, Vec3};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
