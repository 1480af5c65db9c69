//! Axis-aligned boxes: does a perspective frustum see them?
//!
//! All coordinates are small multiples of 2^-10, so that the truth is decided in integers
//! ([`Truth`]), and every library gets exactly the same boxes.

mod bevy;
mod collision;
mod exact;
mod listed;
mod ours;
mod packed;
mod treeculler;

pub use self::collision::Collision;
pub use self::treeculler::TreeCuller;
pub use bevy::BevyLoop;
pub use exact::Truth;
pub use listed::{BoxTest, Listed};
pub use ours::{
    Batch, OursBatch, OursBox, OursPoint, REFERENCE_BOX, REFERENCE_BOXES, REFERENCE_SLICE,
};
pub use packed::PackedSpatialIndex;

use crate::peer::Case;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridBox {
    /// Least coordinates, multiples of [`GridBox::STEP`] below 512.
    pub min: [f32; 3],
    /// Greatest coordinates.
    pub max: [f32; 3],
}

impl GridBox {
    /// What all coordinates are multiples of.
    pub const STEP: f64 = 1.0 / 1024.0;
}

impl Case for GridBox {
    /// Whether the frustum may see it; `None` if that is refused.
    type Answer = Option<bool>;
}
