//! The frustum: its canonical form and how to make one.

mod camera;
mod corners;
mod dyadic;
mod error;
mod face;
mod independent;
mod matrix;
mod shape;
mod six_points;
mod trapezoid;
mod window;

pub use camera::{Camera, Projection};
pub use corners::{Corners, FarCorners, Plane};
pub use error::FrustumError;
pub use face::{Face, FaceSet};
pub use matrix::{
    ClipSpace, ClipY, DepthRange, Deviation, MatrixFrustum, MatrixLayout, ViewProjection,
};
pub use shape::{Direction, EndRect, Shape};
pub use six_points::SixPoints;
pub use trapezoid::{Trapezoid, TrapezoidEnd};

use crate::math::{Pose, Vec3};
use independent::independent;

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
        check_pose(&pose)?;
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

fn check_pose(pose: &Pose) -> Result<(), FrustumError> {
    let vectors = [pose.origin, pose.axes[0], pose.axes[1], pose.axes[2]];
    let numbers = vectors.into_iter().flat_map(Vec3::to_array);
    for (what, value) in POSE_NAMES.into_iter().zip(numbers) {
        FrustumError::check_finite(what, value)?;
    }
    if independent(&pose.axes) {
        Ok(())
    } else {
        Err(FrustumError::DependentAxes)
    }
}

const POSE_NAMES: [&str; 12] = [
    "pose.origin.x",
    "pose.origin.y",
    "pose.origin.z",
    "pose.axes[0].x",
    "pose.axes[0].y",
    "pose.axes[0].z",
    "pose.axes[1].x",
    "pose.axes[1].y",
    "pose.axes[1].z",
    "pose.axes[2].x",
    "pose.axes[2].y",
    "pose.axes[2].z",
];
