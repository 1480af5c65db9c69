//! Inputs that hurt: the singular samples with their exact answers, and seeded
//! families of cases around them.
//!
//! A singular case is only singular if its numbers are. So the [`Solid`]s are
//! dyadic, and their [`singular_samples`] and [`near_misses`] are carried by a
//! [`Placement`] to other poses without rounding anything.

mod family;
mod placement;
mod random;
mod scene;
mod segments;
mod singular;
mod solid;
mod stiff;

pub use family::{BLOCK, Family, UnknownFamily};
pub use placement::Placement;
pub use random::Random;
pub use scene::Scene;
pub use singular::{
    Crossing, Expected, ExpectedPart, FrameSample, Intersections, Labels, Relation, near_misses,
    singular_samples,
};
pub use solid::{Feature, FeatureKind, Solid};

#[cfg(test)]
mod tests;
