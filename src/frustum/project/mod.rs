//! World points to the window and back: pixels, depth, rays.
//!
//! # Idea
//! A point's place across the picture is a quotient of the values that decide on which side of
//! two opposite faces it is:
//!
//! ```text
//! x, in fractions of the picture:  left / (left + right)
//! y                                bottom / (bottom + top)
//! depth                            n F / (n F + f N)
//! ```
//!
//! where left .. top are distances from the faces, positive inside, n and f those from near and
//! far, and N and F how far near and far are from the eye along the view. This is the
//! perspective projection, without its matrix: nothing cancels that would for an eye far from the
//! origin, the depth is accurate at both ends whatever its direction, and the signs are the
//! clippers' own exact ones (see [`place`]). So a point of the frustum, such as an end that
//! [`Accuracy::Inward`](crate::Accuracy) gives, never leaves the window.
//!
//! [`matrix`] has the way from a frustum to a matrix, for those who need one.

mod eye;
mod matrix;
mod place;
mod ray;

use super::{ClipSpace, DepthRange, Frustum, FrustumError};
use crate::math::{NonFinite, NonFiniteAt, Real, Rect, Vec3};
use eye::Eye;
pub use ray::Ray;

/// The projection of a frustum to a window.
///
/// `x`, `y` and `z` of a result are the coordinates in the window and the depth. The window is the
/// near and far rectangles' image, by default in fractions of the picture from the left and from
/// the bottom, with depth from 0 at near to 1 at far:
///
/// | window | call |
/// |---|---|
/// | fractions, `y` up | `Projector::new(&frustum)` |
/// | pixels, `y` down | [`.pixels(width, height)`](Self::pixels); the center of the first pixel is at 0.5, 0.5 |
/// | any other, such as a viewport or -1 to 1 | [`.onto(rect)`](Self::onto) |
/// | depth of another convention | [`.depth(clip_space)`](Self::depth) |
///
/// A point in the frustum has its image in the window and the depth's range, exactly: no rounding
/// puts it outside. A point beside the frustum has an image outside of the window. A point that is
/// not in front of the eye has none.
///
/// Left and right, bottom and top are those of the frustum's frame: as seen, for a
/// [`Camera`](crate::Camera) and a matrix. Where the four sides do not converge at one eye
/// (see [`Frustum::view_projection`]), `x` and `y` are the place between the sides at the point's
/// depth, and the depth is linear, as for parallel projections.
///
/// # Error
/// With u = 2^-53, `W` the window's width and `w` that of the frustum at the point's depth, `x` is
/// within `(10 s / w + 5) u W` of the exact image, if the window is no farther from zero than it is
/// wide, and the same holds for `y`. Here `s = |x_n| + |m z_near| + (A_x + |m| A_z) S`, with `x_n`
/// the larger bound at near, `m` its change by depth, `A` the largest coordinates of the frame's axes
/// and `S` the sum of the magnitudes of `point - origin`; `s / w` is about 4 for a field of view of
/// 60 degrees, 120 for one of 1 degree. The depth is within `10 u s N F / (w^2 D) + 5 u`, for distances
/// `N`, `F` and `w` of near, far and the point from the eye, and `D = F - N`, with
/// `s = |z_near| + |z_far| + A_z S`. Outside of the frustum the first bound grows by the number of
/// window widths to its middle. Single precision adds the rounding of the result.
///
/// ```
/// use frusta::{Camera, Projection, Projector, Vec3};
///
/// let camera = Camera {
///     eye: [0.0, 0.0, 10.0].into(),
///     target: [0.0, 0.0, 0.0].into(),
///     up: [0.0, 1.0, 0.0].into(),
///     projection: Projection::Perspective { fovy: 1.0, aspect: 1.5 },
///     near: 0.1,
///     far: 100.0,
/// };
/// let screen = Projector::new(&camera.frustum()?).pixels(1200, 800);
/// let p = screen.project([0.0, 0.0, 0.0])?.unwrap();
/// assert_eq!((p.x, p.y), (600.0, 400.0));
/// assert_eq!(screen.project([0.0, 0.0, 11.0])?, None);
///
/// // Back: the ray under a pixel.
/// let ray = screen.ray(600.0, 400.0).unwrap();
/// assert_eq!(ray.origin, Vec3::new(0.0, 0.0, 9.9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Projector {
    frustum: Frustum,
    eye: Eye,
    /// The distance of far from near along the depth; 1 without far.
    depth: f64,
    /// For each coordinate of an image the two sides, low and high: the coordinate there, and the
    /// difference to the other side's.
    sides: [[(f64, f64); 2]; 3],
}

impl Projector {
    /// The projection to fractions of the picture: `x` from 0 at the left side to 1 at the right, `y` from 0 at the
    /// bottom to 1 at the top, depth from 0 at near to 1 at far.
    #[must_use]
    pub fn new(frustum: &Frustum) -> Self {
        let shape = frustum.shape();
        let near = shape.near().z;
        Self {
            frustum: frustum.clone(),
            eye: Eye::of(shape),
            depth: shape.far().map_or(1.0, |far| (far.z - near).abs()),
            sides: [[(0.0, 1.0), (1.0, -1.0)]; 3],
        }
    }

    fn with_side(mut self, axis: usize, (low, high): (f64, f64)) -> Self {
        self.sides[axis] = [(low + 0.0, high - low), (high + 0.0, low - high)];
        self
    }

    /// The projection to pixels: `x` from 0 at the left side to `width` at the right, `y` from 0
    /// at the top to `height` at the bottom.
    #[must_use]
    pub fn pixels(self, width: u32, height: u32) -> Self {
        self.with_side(0, (0.0, width.into()))
            .with_side(1, (height.into(), 0.0))
    }

    /// The projection to a rectangle, whose `left`, `right`, `bottom` and `top` are the
    /// coordinates of the frustum's sides: `bottom > top` where `y` runs down, as in a viewport at an
    /// offset.
    ///
    /// ```
    /// # use frusta::{EndRect, Frustum, Pose, Projector, Rect, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// // The right half of a window of 800 by 400 pixels.
    /// let half = Projector::new(&frustum).onto(Rect::new(400.0, 800.0, 400.0, 0.0))?;
    /// let p = half.project([0.0, 2.0, 2.0])?.unwrap();
    /// assert_eq!((p.x, p.y), (600.0, 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FrustumError::NonFinite`]; [`FrustumError::Flat`] for a rectangle without width or height;
    /// [`FrustumError::Overflow`] for one whose width or height is beyond the range of `f64`.
    pub fn onto(mut self, window: Rect) -> Result<Self, FrustumError> {
        let names = ["window.left", "window.right", "window.bottom", "window.top"];
        for (what, value) in names.into_iter().zip(window.to_array()) {
            FrustumError::check_finite(what, value)?;
        }
        for (axis, (what, low, high)) in [
            ("left..right", window.left, window.right),
            ("bottom..top", window.bottom, window.top),
        ]
        .into_iter()
        .enumerate()
        {
            if low == high {
                return Err(FrustumError::Flat { what });
            }
            if !(high - low).is_finite() {
                return Err(FrustumError::Overflow { what });
            }
            self = self.with_side(axis, (low, high));
        }
        Ok(self)
    }

    /// The depth of another clip space: its range, and whether near has the largest depth. (The
    /// direction of its `Y` does not matter.)
    #[must_use]
    pub fn depth(self, clip: ClipSpace) -> Self {
        self.with_side(2, clip.depths())
    }

    /// The frustum.
    #[must_use]
    pub fn frustum(&self) -> &Frustum {
        &self.frustum
    }

    /// A point's coordinates in the window, and its depth; `None` if it is not in front of the
    /// eye (for points outside of the frustum: up to rounding), or so close to the eye's plane that they are beyond the range of `T`.
    ///
    /// # Errors
    /// A coordinate of the point is infinite or NaN.
    #[inline]
    pub fn project<T: Real>(
        &self,
        point: impl Into<Vec3<T>>,
    ) -> Result<Option<Vec3<T>>, NonFinite> {
        let point = point.into();
        if !point.is_finite() {
            NonFinite::check(None, point)?;
        }
        Ok(self.image(point.to_f64()).and_then(narrowed))
    }

    /// The images of a slice of points, with the same bits as from [`Projector::project`]: `images` is
    /// cleared, then gets one for each point, in order.
    ///
    /// ```
    /// # use frusta::{EndRect, Frustum, Pose, Projector, Rect, Shape, Vec3};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let screen = Projector::new(&frustum).pixels(640, 480);
    /// let points = [[0.0_f32, 0.0, 2.0], [1.0, 1.0, 1.0], [0.0, 0.0, -1.0]];
    /// let mut images = Vec::new();
    /// screen.project_points(&points, &mut images)?;
    /// assert_eq!(images[0], Some(Vec3::new(320.0, 240.0, 0.75)));
    /// assert_eq!(images[1], Some(Vec3::new(640.0, 0.0, 0.0)));
    /// assert_eq!(images[2], None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate of a point is infinite or NaN; `images` is empty then.
    pub fn project_points<T: Real, P: Copy + Into<Vec3<T>>>(
        &self,
        points: &[P],
        images: &mut Vec<Option<Vec3<T>>>,
    ) -> Result<(), NonFiniteAt> {
        images.clear();
        images.reserve(points.len());
        for (index, &point) in points.iter().enumerate() {
            match self.project(point) {
                Ok(image) => images.push(image),
                Err(found) => {
                    images.clear();
                    return Err(NonFiniteAt { index, found });
                }
            }
        }
        Ok(())
    }
}

/// Each coordinate rounded to `T`; `None` if one is beyond its range.
#[inline(always)]
fn narrowed<T: Real>(image: Vec3<f64>) -> Option<Vec3<T>> {
    let image = Vec3::from(image.to_array().map(T::from_f64));
    image.is_finite().then_some(image)
}

impl ClipSpace {
    /// The depths of near and far.
    pub(super) fn depths(self) -> (f64, f64) {
        let low = match self.depth {
            DepthRange::ZeroToOne => 0.0,
            DepthRange::MinusOneToOne => -1.0,
        };
        if self.reversed {
            (1.0, low)
        } else {
            (low, 1.0)
        }
    }
}
