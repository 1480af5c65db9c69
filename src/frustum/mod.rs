//! The frustum: its canonical form and how to make one.

mod error;
mod face;
mod shape;

pub use error::FrustumError;
pub use face::{Face, FaceSet};
pub use shape::{Direction, EndRect, Shape};

use crate::math::Pose;

/// A view frustum: the closed set of the points whose frame coordinates (see
/// [`Pose`]) lie in a [`Shape`], under exact arithmetic on the stored doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct Frustum {
    pose: Pose,
    shape: Shape,
}

impl Frustum {
    /// From a pose and a shape.
    ///
    /// # Errors
    /// What [`Shape::validate`] finds; numbers of the pose that are not finite;
    /// axes that are exactly dependent.
    pub fn new(pose: Pose, shape: Shape) -> Result<Self, FrustumError> {
        shape.validate()?;
        Ok(Self { pose, shape })
    }

    /// The frame.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The frustum in its frame.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }
}
