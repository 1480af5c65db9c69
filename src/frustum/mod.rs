//! The frustum: its canonical form and how to make one.

mod camera;
pub(crate) mod corners;
mod error;
pub(crate) mod eval;
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
pub(crate) use eval::plain::{Form, General, Layout, Orthographic, PlainFrustum, Symmetric, Term};
pub use face::{Face, FaceSet, FaceSetIter};
pub use matrix::{
    ClipSpace, ClipY, DepthRange, Deviation, MatrixFrustum, MatrixLayout, ViewProjection,
};
pub use shape::{Direction, EndRect, Shape};
pub use six_points::SixPoints;
pub use trapezoid::{Trapezoid, TrapezoidEnd};

use crate::math::{Pose, Real, Vec3};
use eval::filter::Filter;
use eval::plain::PlainPair;
use independent::independent;
use std::fmt;

/// A view frustum: the closed set of the points whose frame coordinates (see
/// [`Pose`]) lie in a [`Shape`], under exact arithmetic on the stored doubles.
///
/// Two frusta are equal if their poses and shapes are.
#[derive(Clone)]
pub struct Frustum {
    pose: Pose,
    shape: Shape,
    filter: Filter,
    plain: PlainPair,
}

impl Frustum {
    /// From a pose and a shape.
    ///
    /// ```
    /// use frusta::{Direction, EndRect, Face, Frustum, FrustumError, Pose, Rect, Shape, Vec3};
    /// let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// assert_eq!(frustum.faces(), Face::ALL);
    ///
    /// // The same sides without end, from another place. Axes need not be of
    /// // unit length.
    /// let mut pose = Pose::IDENTITY;
    /// pose.origin = Vec3::new(10.0, 0.0, 0.0);
    /// pose.axes[1] = Vec3::new(0.0, 3.0, 4.0);
    /// let slopes = Rect::centred(1.0, 1.0);
    /// let endless = Shape::Infinite { near, slopes, direction: Direction::PlusZ };
    /// assert_eq!(Frustum::new(pose, endless)?.faces().len(), 5);
    ///
    /// let flat = Shape::Finite { near, far: near };
    /// assert_eq!(Frustum::new(pose, flat), Err(FrustumError::NoDepth { z: 1.0 }));
    /// # Ok::<(), FrustumError>(())
    /// ```
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

// By what defines a frustum: what is prepared from it follows, and may hold a
// NaN where a filter has no room.
impl PartialEq for Frustum {
    fn eq(&self, other: &Self) -> bool {
        self.pose == other.pose && self.shape == other.shape
    }
}

impl fmt::Debug for Frustum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Frustum")
            .field("pose", &self.pose)
            .field("shape", &self.shape)
            .finish_non_exhaustive()
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
