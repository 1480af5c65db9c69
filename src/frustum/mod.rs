//! The frustum: its canonical form and how to make one.

pub(crate) mod boundary;
mod camera;
mod corners;
mod error;
mod exact_vec;
mod face;
pub(crate) mod filter;
mod independent;
mod matrix;
mod plain;
mod precise;
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
pub(crate) use plain::{Form, General, Layout, Orthographic, PlainFrustum, Symmetric};
pub use shape::{Direction, EndRect, Shape};
pub use six_points::SixPoints;
pub use trapezoid::{Trapezoid, TrapezoidEnd};

use crate::math::{Pose, Real, Vec3};
use filter::Filter;
use independent::independent;
use plain::PlainPair;

/// A view frustum: the closed set of the points whose frame coordinates (see
/// [`Pose`]) lie in a [`Shape`], under exact arithmetic on the stored doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct Frustum {
    pose: Pose,
    shape: Shape,
    filter: Filter,
    plain: PlainPair,
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
        let filter = Filter::new(&pose, &shape);
        let plain = PlainPair::new(&pose, &shape);
        Ok(Self {
            pose,
            shape,
            filter,
            plain,
        })
    }

    /// The frame.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The faces there are, in the order of [`Face::ALL`]: six, or five for an
    /// infinite frustum.
    pub fn faces(&self) -> &'static [Face] {
        match self.shape {
            Shape::Finite { .. } => &Face::ALL,
            Shape::Infinite { .. } => &Face::WITHOUT_FAR,
        }
    }

    /// The frustum in its frame.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Coefficients for plain arithmetic in `T`.
    #[inline(always)]
    pub(crate) fn plain<T: Real>(&self) -> &PlainFrustum<T> {
        T::pick(&self.plain)
    }

    /// The same for the frustum scaled about the world's origin.
    pub(crate) fn plain_scaled<T: Real>(&self, scale: f64) -> PlainFrustum<T> {
        let pose = Pose::new(self.pose.origin * scale, self.pose.axes);
        PlainFrustum::new(&pose, &self.shape.scaled(scale))
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
