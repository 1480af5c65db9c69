//! A frustum in its own frame.

use super::{Face, FrustumError};
use crate::math::Rect;

/// A rectangle across the frame's `z` axis: one end of a frustum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EndRect {
    /// The frame `z` of the rectangle.
    pub z: f64,
    /// The bounds in frame `x` and `y`.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub rect: Rect,
}

impl EndRect {
    /// The rectangle `left..right` by `bottom..top` at `z`.
    pub const fn new(z: f64, left: f64, right: f64, bottom: f64, top: f64) -> Self {
        Self {
            z,
            rect: Rect::new(left, right, bottom, top),
        }
    }
}

/// The direction in which an infinite frustum extends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Towards larger `z`.
    PlusZ,
    /// Towards smaller `z`.
    MinusZ,
}

impl Direction {
    /// `1.0` or `-1.0`.
    #[inline(always)]
    pub const fn sign(self) -> f64 {
        match self {
            Direction::PlusZ => 1.0,
            Direction::MinusZ => -1.0,
        }
    }
}

/// A frustum in its own frame: the closed convex hull of two rectangles, or the
/// closed set swept by a rectangle that grows without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// The hull of two rectangles. `near.z != far.z`, in either order. An end may
    /// shrink to an edge or to a point (a pyramid), but the two ends must not both
    /// lack width, nor both lack height.
    Finite {
        /// The end at depth zero.
        near: EndRect,
        /// The end at the greatest depth.
        far: EndRect,
    },
    /// A rectangle and everything beyond it; no far face.
    Infinite {
        /// The end at depth zero.
        near: EndRect,
        /// The change of each side's bound per unit of depth.
        slopes: Rect,
        /// The direction in which depth grows.
        direction: Direction,
    },
}

impl Shape {
    /// The near end.
    pub const fn near(&self) -> EndRect {
        match *self {
            Shape::Finite { near, .. } | Shape::Infinite { near, .. } => near,
        }
    }

    /// The far end; `None` for an infinite frustum.
    pub const fn far(&self) -> Option<EndRect> {
        match *self {
            Shape::Finite { far, .. } => Some(far),
            Shape::Infinite { .. } => None,
        }
    }

    /// The direction in which depth grows.
    pub fn direction(&self) -> Direction {
        match *self {
            Shape::Finite { near, far } if far.z < near.z => Direction::MinusZ,
            Shape::Finite { .. } => Direction::PlusZ,
            Shape::Infinite { direction, .. } => direction,
        }
    }

    /// The axis and the value of the frame coordinate that all points of a face have
    /// in common, if there is one.
    pub(crate) fn constant_coordinate(&self, face: Face) -> Option<(usize, f64)> {
        let i = match face {
            Face::Near => return Some((2, self.near().z)),
            Face::Far => return self.far().map(|far| (2, far.z)),
            _ => face as usize - 2,
        };
        let at = self.near().rect.to_array()[i];
        let is_constant = match self {
            Shape::Finite { far, .. } => far.rect.to_array()[i] == at,
            Shape::Infinite { slopes, .. } => slopes.to_array()[i] == 0.0,
        };
        is_constant.then_some((i / 2, at))
    }

    /// The shape scaled about its frame's origin; slopes stay.
    pub(super) fn scaled(&self, scale: f64) -> Shape {
        let end = |e: EndRect| {
            let [left, right, bottom, top] = e.rect.to_array().map(|side| side * scale);
            EndRect::new(e.z * scale, left, right, bottom, top)
        };
        match *self {
            Shape::Finite { near, far } => Shape::Finite {
                near: end(near),
                far: end(far),
            },
            Shape::Infinite {
                near,
                slopes,
                direction,
            } => Shape::Infinite {
                near: end(near),
                slopes,
                direction,
            },
        }
    }

    /// Checks the conditions that [`Shape`] documents.
    ///
    /// # Errors
    /// The first condition that fails: [`FrustumError::NonFinite`],
    /// [`FrustumError::NoDepth`], [`FrustumError::Inverted`] or
    /// [`FrustumError::Flat`].
    pub fn validate(&self) -> Result<(), FrustumError> {
        let (near, far, other, names) = match self {
            Shape::Finite { near, far } => (near, far.rect, "far", FINITE_NAMES),
            Shape::Infinite { near, slopes, .. } => (near, *slopes, "slopes", INFINITE_NAMES),
        };
        FrustumError::check_finite(names[0], near.z)?;
        if let Shape::Finite { far, .. } = self {
            FrustumError::check_finite(names[1], far.z)?;
            if near.z == far.z {
                return Err(FrustumError::NoDepth { z: near.z });
            }
        }
        let sides = near.rect.to_array().into_iter().chain(far.to_array());
        for (name, value) in names[2..].iter().zip(sides) {
            FrustumError::check_finite(name, value)?;
        }
        for (i, what) in ["left..right", "bottom..top"].into_iter().enumerate() {
            let (n, f) = (near.rect.to_array(), far.to_array());
            let (n, f) = ((n[2 * i], n[2 * i + 1]), (f[2 * i], f[2 * i + 1]));
            for (end, (low, high)) in [("near", n), (other, f)] {
                if low > high {
                    return Err(FrustumError::Inverted {
                        end,
                        what,
                        low,
                        high,
                    });
                }
            }
            if n.0 == n.1 && f.0 == f.1 {
                return Err(FrustumError::Flat { what });
            }
        }
        Ok(())
    }
}

const FINITE_NAMES: [&str; 10] = [
    "near.z",
    "far.z",
    "near.left",
    "near.right",
    "near.bottom",
    "near.top",
    "far.left",
    "far.right",
    "far.bottom",
    "far.top",
];
const INFINITE_NAMES: [&str; 10] = [
    "near.z",
    "slopes",
    "near.left",
    "near.right",
    "near.bottom",
    "near.top",
    "slopes.left",
    "slopes.right",
    "slopes.bottom",
    "slopes.top",
];
