//! View frusta: their canonical form and the constructors.
//!
//! A [`Frustum`] is a closed convex set, defined exactly by a [`Pose`] (a frame in the
//! world) and a [`Shape`] in that frame: two rectangles, or one rectangle swept to infinity. All
//! clipping and culling in this crate is relative to one.
//!
//! | given | constructor |
//! |---|---|
//! | eye, target, field of view or view rectangle | [`Camera::frustum`] |
//! | a view-projection matrix | [`ViewProjection::frustum`] |
//! | two rectangles, in any frame | [`Frustum::new`] |
//! | six points, as in "View Frustum Culling Geometric Algorithm" (the paper of projection reduction) | [`SixPoints::frustum`] |
//! | another frustum, for a pick box, a tile or one eye of a stereo pair | [`Frustum::window`], [`Projector::window`] (pixels), [`Frustum::tile`], [`Frustum::stereo_eye`] |
//!
//! And back: [`Frustum::view_projection`] gives a matrix of any convention, [`Projector`] takes points to pixels and
//! pixels to rays.
//!
//! A frustum has six faces in pairs, or five: left and right, bottom and top, near and far, of which near and far are
//! parallel. That is what the method rests on, so other convex sets have no form here:
//!
//! | wanted | way |
//! |---|---|
//! | a rectangle of the picture, a portal's bounds | [`Frustum::window`], [`Projector::window`] |
//! | a portal of any outline | the frustum of its bounds, which rejects nothing that is seen; then what remains by the outline |
//! | an oblique near plane (mirrors, water) | the frustum of the matrix before it was made oblique; then what is left by that plane. The oblique matrix itself is [`FrustumError::TiltedDepth`] |
//! | six planes of any direction | their matrix, if they come from one; else as above |
//!
//! If both a camera and a matrix are available, prefer the [`Camera`]: it keeps the near and far
//! distances as given, while the entries of a matrix have been rounded already. The constructors
//! that round state their error bound; after that the stored numbers *are* the frustum, and no answer depends on what
//! they were rounded from.
//!
//! ```
//! use frusta::{Camera, Projection, Rect, Vec3};
//!
//! let camera = Camera {
//!     eye: [0.0, 0.0, 10.0].into(),
//!     target: [0.0, 0.0, 0.0].into(),
//!     up: [0.0, 1.0, 0.0].into(),
//!     projection: Projection::Perspective {
//!         fovy: 60_f64.to_radians(),
//!         aspect: 16.0 / 9.0,
//!     },
//!     near: 0.1,
//!     far: 100.0,
//! };
//! let frustum = camera.frustum()?;
//! assert!(frustum.contains(Vec3::new(0.0, 0.0, 0.0)).unwrap());
//!
//! // The left half of the picture.
//! let left = frustum.window(Rect::new(0.0, 0.5, 0.0, 1.0))?;
//! assert!(!left.contains(Vec3::new(0.5, 0.0, 0.0)).unwrap());
//! # Ok::<(), frusta::FrustumError>(())
//! ```
//!
//! [`Frustum::corners`] and [`Frustum::planes`] give vertices and planes in the world, rounded, for drawing;
//! [`Frustum::tv`] and [`Frustum::tw`] the two [`Trapezoid`]s of the paper's method.

mod camera;
pub(crate) mod corners;
mod error;
pub(crate) mod eval;
mod face;
mod independent;
mod matrix;
mod project;
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
pub use project::{Projector, Ray};
pub use shape::{Direction, EndRect, Shape};
pub use six_points::SixPoints;
pub use trapezoid::{Trapezoid, TrapezoidEnd};

use crate::math::{Pose, Real, Vec3};
use eval::filter::Filter;
use eval::plain::PlainPair;
use independent::independent;
use std::fmt;
use std::sync::OnceLock;

/// A view frustum: the closed set of the points whose frame coordinates (see
/// [`Pose`]) lie in a [`Shape`], by exact arithmetic on the stored `f64` values.
///
/// Two frusta are equal if their poses and shapes are equal.
#[derive(Clone)]
pub struct Frustum {
    pose: Pose,
    shape: Shape,
    filter: Filter,
    /// What plain arithmetic alone needs, when it is first asked for.
    plain: OnceLock<PlainPair>,
}

impl Frustum {
    /// Creates a frustum from a pose and a shape, both stored as given.
    ///
    /// ```
    /// use frusta::{Direction, EndRect, Face, Frustum, FrustumError, Pose, Rect, Shape, Vec3};
    /// let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// assert_eq!(frustum.faces(), Face::ALL);
    ///
    /// // The same sides without a far end, in another place. Axes need not be of
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
    /// Any error of [`Shape::validate`]; [`FrustumError::NonFinite`] for the pose;
    /// [`FrustumError::DependentAxes`] if the axes are exactly dependent.
    pub fn new(pose: Pose, shape: Shape) -> Result<Self, FrustumError> {
        shape.validate()?;
        check_pose(&pose)?;
        let filter = Filter::new(&pose, &shape);
        Ok(Self {
            pose,
            shape,
            filter,
            plain: OnceLock::new(),
        })
    }

    /// The frame of the frustum in the world.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The faces of the frustum, in the order of [`Face::ALL`]: six, or five for an
    /// infinite frustum.
    pub fn faces(&self) -> &'static [Face] {
        match self.shape {
            Shape::Finite { .. } => &Face::ALL,
            Shape::Infinite { .. } => &Face::WITHOUT_FAR,
        }
    }

    /// The shape of the frustum in its frame.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Coefficients for plain arithmetic in `T`.
    #[inline(always)]
    pub(crate) fn plain<T: Real>(&self) -> &PlainFrustum<T> {
        let make = || PlainPair::new(&self.pose, &self.shape);
        T::pick(self.plain.get_or_init(make))
    }

    /// The same for the frustum scaled about the world's origin.
    pub(crate) fn plain_scaled<T: Real>(&self, scale: f64) -> PlainFrustum<T> {
        let pose = Pose::new(self.pose.origin * scale, self.pose.axes);
        PlainFrustum::new(&pose, &self.shape.scaled(scale))
    }
}

// Compares what defines a frustum. The prepared constants follow from it, and may be NaN
// where the numbers are out of the filter's range.
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
