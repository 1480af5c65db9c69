//! Hard inputs: the singular samples with their exact answers, and seeded families of cases
//! around them. For comparison there are everyday segments, in seeded [`Mix`]es.
//!
//! A singular case must be exact to be singular. So the [`Solid`]s are
//! dyadic, and a [`Placement`] carries their [`singular_samples`] and [`near_misses`] to
//! other poses without rounding. [`hard_box`], [`hard_obb`]
//! and [`hard_sphere`] make bounding volumes for the frustum of any family.
//!
//! ```
//! use frusta::samples::{Family, Placement, Solid, singular_samples};
//! let solid = Solid::SYMMETRIC;
//! let samples = singular_samples(&solid);
//! assert_eq!(samples.len(), 78);
//! let frustum = Placement::IDENTITY.place(&solid)?;
//! for sample in samples {
//!     let clip = frustum.clip_segment(&Placement::IDENTITY.segment(&sample.segment))?;
//!     assert_eq!(clip.class, sample.expected.class);
//! }
//!
//! // A case of a family depends on its seed and index alone.
//! for family in Family::ALL {
//!     let (frustum, segment) = family.case(7, 1_000_000);
//!     let _ = frustum.clip_segment(&segment)?;
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod family;
mod mix;
mod placement;
mod random;
mod scene;
mod segments;
mod singular;
mod solid;
mod stiff;
mod volumes;

pub use family::{BLOCK, Family, UnknownFamily};
pub use mix::Mix;
pub use placement::Placement;
pub use random::Random;
pub use scene::Scene;
pub use singular::{
    Crossing, Expected, ExpectedPart, FrameSample, Intersections, Labels, Relation, near_misses,
    singular_samples,
};
pub use solid::{Feature, FeatureKind, Solid};
pub use volumes::{hard_box, hard_obb, hard_sphere};

#[cfg(test)]
mod tests;
#[cfg(all(test, feature = "oracle"))]
mod volume_tests;
