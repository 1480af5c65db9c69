//! A frustum from a camera: eye, target, up, projection, near and far.
//!
//! The frame's origin is the eye; its axes are *right*, *up* and *forward*, of
//! unit length, so that frame `z` is the distance along the view direction and
//! `near` and `far` are kept bit for bit. Nothing cancels: the axes are rounded
//! from exact cross products of the given `f64` values, and the rectangles are
//! slopes times distances, never entries of a projection matrix, so that
//! `near = 1e-6`, `far = 1e6` loses no digit. Transcendental functions are those
//! of `libm`, which gives the same bits on every platform.
//!
//! Each kind of degenerate input has an error of its own. `near = 0` makes a
//! perspective frustum a pyramid with its apex at the eye; `far = f64::INFINITY`
//! makes an infinite frustum.

use super::eval::exact_vec::{cross, difference, exact, unit};
use super::{Direction, EndRect, Frustum, FrustumError, Shape};
use crate::math::{Pose, Real, Rect, Vec3};
use std::f64::consts::PI;

/// A camera, given by its eye, its target and its projection.
///
/// ```
/// use frusta::{Camera, Projection};
///
/// let camera = Camera {
///     eye: [0.0, 0.0, 10.0].into(),
///     target: [0.0, 0.0, 0.0].into(),
///     up: [0.0, 1.0, 0.0].into(),
///     projection: Projection::Perspective {
///         fovy: 60_f64.to_radians(),
///         aspect: 16.0 / 9.0,
///     },
///     near: 0.1,
///     far: f64::INFINITY,
/// };
/// let frustum = camera.frustum()?;
/// assert_eq!(frustum.shape().near().z, 0.1);
/// assert!(frustum.shape().far().is_none());
/// # Ok::<(), frusta::FrustumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The position of the camera, in world units.
    pub eye: Vec3<f64>,
    /// A point in the middle of the view (for an off-centre rectangle: on the
    /// perpendicular to it through the eye). Only its direction from the eye
    /// matters.
    pub target: Vec3<f64>,
    /// A vector that points upwards in the picture, of any length and any direction
    /// that is not exactly the view direction or its opposite.
    pub up: Vec3<f64>,
    /// The kind of projection, with its extent.
    pub projection: Projection,
    /// Distance of the near face along the view direction, in world units: at
    /// least 0 for [`Projection::Perspective`] (0: a pyramid), above 0 for
    /// [`Projection::OffAxis`], any finite number for the orthographic ones
    /// (below 0: the near face is behind the eye).
    pub near: f64,
    /// Distance of the far face, above `near`; [`f64::INFINITY`] for an infinite
    /// frustum.
    pub far: f64,
}

/// The projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Projection {
    /// Centred perspective.
    Perspective {
        /// The full vertical field of view, in radians, `0 < fovy < PI`.
        fovy: f64,
        /// Width over height, above 0.
        aspect: f64,
    },
    /// Perspective through a rectangle (`glFrustum`): a tiled wall, one eye of
    /// a stereo pair, a shifted lens.
    OffAxis {
        /// The rectangle at the near face, in world units along the frame's
        /// `x` (right) and `y` (up).
        rect: Rect,
    },
    /// Centred parallel projection.
    Orthographic {
        /// The full height, in world units, above 0.
        height: f64,
        /// Width over height, above 0.
        aspect: f64,
    },
    /// Parallel projection through a rectangle (`glOrtho`).
    OrthographicRect {
        /// The rectangle, in world units along the frame's `x` and `y`.
        rect: Rect,
    },
}

impl Camera {
    /// Creates a camera from points of either type, `f32` or `f64`: arrays, or other libraries' (with their features).
    ///
    /// ```
    /// use frusta::{Camera, Projection};
    ///
    /// let (eye, ahead): ([f32; 3], [f32; 3]) = ([0.0, 1.7, 10.0], [0.0, 1.7, 9.0]);
    /// let projection = Projection::Perspective { fovy: 1.0, aspect: 1.5 };
    /// let camera = Camera::new(eye, ahead, [0.0, 1.0, 0.0], projection, 0.1, f64::INFINITY);
    /// assert_eq!(camera.eye.y, f64::from(1.7_f32));
    /// assert!(camera.frustum()?.contains([0.0_f32, 1.0, -1e6]).unwrap());
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    #[must_use]
    pub fn new<T: Real>(
        eye: impl Into<Vec3<T>>,
        target: impl Into<Vec3<T>>,
        up: impl Into<Vec3<T>>,
        projection: Projection,
        near: f64,
        far: f64,
    ) -> Self {
        Self {
            eye: eye.into().to_f64(),
            target: target.into().to_f64(),
            up: up.into().to_f64(),
            projection,
            near,
            far,
        }
    }

    /// The frustum that the camera sees.
    ///
    /// Error: `near`, `far` and the rectangle of a rectangle projection are
    /// stored as given. Each coordinate of an axis is within 4 ulp of the exact unit
    /// vector's, however close `up` is to the view direction. The sides of
    /// [`Projection::Perspective`] are within 4 ulp, those of the far end of
    /// [`Projection::OffAxis`] within 2 (two roundings).
    ///
    /// # Errors
    /// Each kind of invalid input has its own variant of [`FrustumError`], from
    /// [`FrustumError::NonFinite`] to [`FrustumError::Underflow`].
    pub fn frustum(&self) -> Result<Frustum, FrustumError> {
        self.check_numbers()?;
        let shape = self.shape()?;
        Frustum::new(self.pose()?, shape)
    }

    /// The camera's frame, with its origin at the eye and unit axes right, up, forward.
    ///
    /// The frame is left-handed in a right-handed world (`x` to the right, `y`
    /// up, `z` away from the viewer).
    ///
    /// # Errors
    /// [`FrustumError::NonFinite`]; [`FrustumError::EyeIsTarget`];
    /// [`FrustumError::UpAlongView`] for an `up` that is zero or along the view
    /// direction.
    pub fn pose(&self) -> Result<Pose, FrustumError> {
        for (point, names) in [
            (self.eye, ["eye.x", "eye.y", "eye.z"]),
            (self.target, ["target.x", "target.y", "target.z"]),
            (self.up, ["up.x", "up.y", "up.z"]),
        ] {
            for (value, what) in point.to_array().into_iter().zip(names) {
                FrustumError::check_finite(what, value)?;
            }
        }
        let forward = difference(self.target, self.eye);
        let up = exact(self.up);
        let right = cross(&forward, &up);
        let z = unit(&forward).ok_or(FrustumError::EyeIsTarget { eye: self.eye })?;
        let x = unit(&right).ok_or(FrustumError::UpAlongView { up: self.up })?;
        // Never `None`: both vectors are non-zero and at a right angle.
        let y = unit(&cross(&right, &forward)).ok_or(FrustumError::UpAlongView { up: self.up })?;
        Ok(Pose::new(self.eye, [x, y, z]))
    }

    fn check_numbers(&self) -> Result<(), FrustumError> {
        let (near, far) = (self.near, self.far);
        FrustumError::check_finite("near", near)?;
        if far.is_nan() {
            return Err(FrustumError::NonFinite {
                what: "far",
                value: far,
            });
        }
        match self.projection {
            Projection::Perspective { fovy, aspect } => {
                // Written so that NaN fails.
                if !(fovy > 0.0 && fovy < PI) {
                    return Err(FrustumError::FieldOfView { fovy });
                }
                check_aspect(aspect)?;
                if near < 0.0 {
                    return Err(FrustumError::NearBehindEye { near });
                }
            }
            Projection::OffAxis { rect } => {
                check_rect(rect)?;
                if near < 0.0 {
                    return Err(FrustumError::NearBehindEye { near });
                }
                if near == 0.0 {
                    return Err(FrustumError::OffAxisAtEye);
                }
            }
            Projection::Orthographic { height, aspect } => {
                if !(height > 0.0 && height < f64::INFINITY) {
                    return Err(FrustumError::Height { height });
                }
                check_aspect(aspect)?;
            }
            Projection::OrthographicRect { rect } => check_rect(rect)?,
        }
        if far <= near {
            return Err(FrustumError::FarNotBeyondNear { near, far });
        }
        Ok(())
    }

    fn shape(&self) -> Result<Shape, FrustumError> {
        match self.projection {
            Projection::Perspective { fovy, aspect } => {
                let y = libm::tan(0.5 * fovy);
                let x = factor(y * aspect, false, "the slope tan(fovy / 2) * aspect")?;
                let slopes = Rect::centred(x, y);
                self.grown(scaled(slopes, self.near, "the near rectangle")?, slopes)
            }
            Projection::OffAxis { rect } => {
                let near = self.near;
                let slopes = map(rect, |side| {
                    factor(side / near, side == 0.0, "a slope, rect / near,")
                })?;
                self.grown(rect, slopes)
            }
            Projection::Orthographic { height, aspect } => {
                let y = factor(height * 0.5, false, "half the height")?;
                let x = product(y, aspect, "half the width")?;
                self.straight(Rect::centred(x, y))
            }
            Projection::OrthographicRect { rect } => self.straight(rect),
        }
    }

    /// A near rectangle, and the slopes that give the far one.
    fn grown(&self, near: Rect, slopes: Rect) -> Result<Shape, FrustumError> {
        let near = self.near_end(near);
        Ok(if self.far == f64::INFINITY {
            Shape::Infinite {
                near,
                slopes,
                direction: Direction::PlusZ,
            }
        } else {
            let rect = scaled(slopes, self.far, "the far rectangle")?;
            Shape::Finite {
                near,
                far: EndRect { z: self.far, rect },
            }
        })
    }

    /// The same rectangle at every depth.
    fn straight(&self, rect: Rect) -> Result<Shape, FrustumError> {
        let near = self.near_end(rect);
        Ok(if self.far == f64::INFINITY {
            Shape::Infinite {
                near,
                slopes: Rect::default(),
                direction: Direction::PlusZ,
            }
        } else {
            Shape::Finite {
                near,
                far: EndRect { z: self.far, rect },
            }
        })
    }

    fn near_end(&self, rect: Rect) -> EndRect {
        // `+ 0` turns -0 into 0.
        EndRect {
            z: self.near + 0.0,
            rect: Rect::new(
                rect.left + 0.0,
                rect.right + 0.0,
                rect.bottom + 0.0,
                rect.top + 0.0,
            ),
        }
    }
}

fn check_aspect(aspect: f64) -> Result<(), FrustumError> {
    if aspect > 0.0 && aspect < f64::INFINITY {
        Ok(())
    } else {
        Err(FrustumError::Aspect { aspect })
    }
}

fn check_rect(rect: Rect) -> Result<(), FrustumError> {
    let names = ["rect.left", "rect.right", "rect.bottom", "rect.top"];
    for (value, what) in rect.to_array().into_iter().zip(names) {
        FrustumError::check_finite(what, value)?;
    }
    for (what, low, high) in [
        ("left..right", rect.left, rect.right),
        ("bottom..top", rect.bottom, rect.top),
    ] {
        if low > high {
            return Err(FrustumError::Inverted {
                end: "rect",
                what,
                low,
                high,
            });
        }
        if low == high {
            return Err(FrustumError::Flat { what });
        }
    }
    Ok(())
}

/// Each side of the rectangle times `factor`.
fn scaled(rect: Rect, factor: f64, what: &'static str) -> Result<Rect, FrustumError> {
    map(rect, |side| product(side, factor, what))
}

fn map(
    rect: Rect,
    mut f: impl FnMut(f64) -> Result<f64, FrustumError>,
) -> Result<Rect, FrustumError> {
    Ok(Rect::new(
        f(rect.left)?,
        f(rect.right)?,
        f(rect.bottom)?,
        f(rect.top)?,
    ))
}

/// `a * b`, or an error if it is out of range.
fn product(a: f64, b: f64, what: &'static str) -> Result<f64, FrustumError> {
    checked(a * b, a == 0.0 || b == 0.0, what)
}

/// As [`checked`], for a factor of further products: a subnormal one has lost bits.
fn factor(value: f64, may_be_zero: bool, what: &'static str) -> Result<f64, FrustumError> {
    if value != 0.0 && value.abs() < f64::MIN_POSITIVE {
        return Err(FrustumError::Underflow { what });
    }
    checked(value, may_be_zero, what)
}

/// An error for an infinite value, and for a zero that must not be one.
fn checked(value: f64, may_be_zero: bool, what: &'static str) -> Result<f64, FrustumError> {
    if value.is_infinite() {
        Err(FrustumError::Overflow { what })
    } else if value == 0.0 && !may_be_zero {
        Err(FrustumError::Underflow { what })
    } else {
        Ok(value)
    }
}
