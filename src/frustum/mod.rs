//! The frustum: its canonical form and how to make one.

pub(crate) mod boundary;
mod error;
mod face;
pub(crate) mod filter;
mod plain;
mod shape;

pub use error::FrustumError;
pub use face::{Face, FaceSet};
pub(crate) use plain::{Form, General, Layout, Orthographic, PlainFrustum, Symmetric};
pub use shape::{Direction, EndRect, Shape};

use crate::math::{Pose, Real};
use filter::Filter;
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
        const INFINITE: [Face; 5] = [Face::Near, Face::Left, Face::Right, Face::Bottom, Face::Top];
        match self.shape {
            Shape::Finite { .. } => &Face::ALL,
            Shape::Infinite { .. } => &INFINITE,
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
