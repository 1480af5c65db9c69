//! From the window back to the world: rays and points.

use super::Projector;
use super::eye::Eye;
use crate::frustum::{Frustum, FrustumError, Shape};
use crate::math::{Pose, Rect, Vec3};

/// A ray in the world: the points `origin + t direction`, `t >= 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3<f64>,
    /// Its direction, of any length.
    pub direction: Vec3<f64>,
}

impl Ray {
    /// The point `origin + t direction`, rounded.
    #[must_use]
    pub fn at(&self, t: f64) -> Vec3<f64> {
        self.origin + self.direction * t
    }
}

/// A point of the window: its places between left and right, and between bottom and top, each as the two
/// weights of the sides.
struct Weights {
    x: [f64; 2],
    y: [f64; 2],
}

impl Weights {
    /// Between the sides `left, right, bottom, top`.
    fn between(&self, [left, right, bottom, top]: [f64; 4]) -> [f64; 2] {
        [
            left * self.x[0] + right * self.x[1],
            bottom * self.y[0] + top * self.y[1],
        ]
    }
}

impl Projector {
    /// The ray of the points that are seen at a place of the window. It starts on the near face,
    /// and is on the far face at `t = 1`; without a far face its direction goes one unit of the frame's
    /// depth. `None` if a coordinate is not finite, or the ray is beyond the range of `f64`.
    ///
    /// For picking, take the center of a pixel: `ray(i + 0.5, j + 0.5)`. A rectangle of pixels has a
    /// frustum of its own: [`Frustum::window`](crate::Frustum::window).
    ///
    /// Error: the start is off by at most `8 u` of the near face's bounds and its rounding by
    /// [`Pose::to_world`]; the direction the same, of the far face's.
    ///
    /// ```
    /// # use frusta::{EndRect, Frustum, Pose, Projector, Shape, Vec3};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let screen = Projector::new(&frustum).pixels(640, 480);
    /// let ray = screen.ray(480.0, 240.0).unwrap();
    /// assert_eq!(ray.origin, Vec3::new(0.5, 0.0, 1.0));
    /// assert_eq!(ray.at(1.0), Vec3::new(1.5, 0.0, 3.0));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    #[must_use]
    pub fn ray(&self, x: f64, y: f64) -> Option<Ray> {
        let weights = self.weights(x, y)?;
        let pose = self.frustum.pose();
        let shape = self.frustum.shape();
        let near = shape.near();
        let [x0, y0] = weights.between(near.rect.to_array());
        let along = match shape {
            Shape::Finite { far, .. } => {
                let [x1, y1] = weights.between(far.rect.to_array());
                Vec3::new(x1 - x0, y1 - y0, far.z - near.z)
            }
            Shape::Infinite {
                slopes, direction, ..
            } => {
                let [x, y] = weights.between(slopes.to_array());
                Vec3::new(x, y, direction.sign())
            }
        };
        let ray = Ray {
            origin: pose.to_world(Vec3::new(x0, y0, near.z)),
            direction: Pose::new(Vec3::default(), pose.axes).to_world(along),
        };
        (ray.origin.is_finite() && ray.direction.is_finite()).then_some(ray)
    }

    /// The part of the frustum that is seen through a rectangle of the window, such as a rubber band: two
    /// opposite corners in the window's coordinates, in any order.
    ///
    /// Rectangles that share a border share a side, bit for bit; the window's own borders give the frustum's own
    /// sides. Each bound is within 3 u of the frustum's width of the exact one (see [`Frustum::window`], which takes fractions).
    ///
    /// ```
    /// # use frusta::{EndRect, Frustum, Pose, Projector, Rect, Shape};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let screen = Projector::new(&frustum).pixels(640, 480);
    /// let band = screen.window([480.0, 240.0], [320.0, 120.0])?;
    /// assert_eq!(band.shape().near().rect, Rect::new(0.0, 0.5, 0.0, 0.5));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Frustum::window`].
    pub fn window(&self, corner: [f64; 2], opposite: [f64; 2]) -> Result<Frustum, FrustumError> {
        let [x, y] = [0, 1].map(|axis| {
            let [(low, width), _] = self.sides[axis];
            let [a, b] = [corner, opposite].map(|point| (point[axis] - low) / width);
            // NaN stays, as `window` says which bound has it.
            if a > b { [b, a] } else { [a, b] }
        });
        self.frustum.window(Rect::new(x[0], x[1], y[0], y[1]))
    }

    /// The point that is seen at a place of the window with a depth, as read from a depth buffer;
    /// rounded. `None` if a number is not finite, or there is no such point: no depth beyond that of
    /// infinity.
    ///
    /// Error: as of [`Projector::ray`], and along the ray that of the depth, whose digits
    /// are unevenly spread: a buffer of 24 bits with near at 0.1 gives a point at 1,000 to some 0.6.
    ///
    /// ```
    /// # use frusta::{EndRect, Frustum, Pose, Projector, Shape, Vec3};
    /// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    /// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    /// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
    /// let screen = Projector::new(&frustum).pixels(640, 480);
    /// assert_eq!(screen.point(320.0, 0.0, 0.75), Some(Vec3::new(0.0, 2.0, 2.0)));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    #[must_use]
    pub fn point(&self, x: f64, y: f64, depth: f64) -> Option<Vec3<f64>> {
        let weights = self.weights(x, y)?;
        let shape = self.frustum.shape();
        // The weight of the far depth is the distance from near.
        let [of_near, of_far] = self.place_of(2, depth)?;
        let [low, high] = self.eye.distances([of_far, of_near]);
        let near = shape.near();
        let [x0, y0] = weights.between(near.rect.to_array());
        let in_frame = match shape {
            Shape::Finite { far, .. } => {
                let sum = low + high;
                let (f, n) = (low / sum, high / sum);
                let [x1, y1] = weights.between(far.rect.to_array());
                // Behind the eye the weights of a central projection have another sign.
                let is_seen = sum > 0.0 || !matches!(self.eye, Eye::Central { .. });
                is_seen.then(|| {
                    let z = n * near.z + f * far.z;
                    Vec3::new(n * x0 + f * x1, n * y0 + f * y1, z)
                })
            }
            Shape::Infinite {
                slopes, direction, ..
            } => {
                let [x, y] = weights.between(slopes.to_array());
                let depth = low / high;
                (high > 0.0).then(|| {
                    let z = near.z + direction.sign() * depth;
                    Vec3::new(x0 + depth * x, y0 + depth * y, z)
                })
            }
        }?;
        let point = self.frustum.pose().to_world(in_frame);
        point.is_finite().then_some(point)
    }

    fn weights(&self, x: f64, y: f64) -> Option<Weights> {
        Some(Weights {
            x: self.place_of(0, x)?,
            y: self.place_of(1, y)?,
        })
    }

    /// A coordinate's place between the window's sides, as their weights; `None` if it is not finite.
    fn place_of(&self, axis: usize, value: f64) -> Option<[f64; 2]> {
        let [(low, width), (high, _)] = self.sides[axis];
        let weights = [(high - value) / width, (value - low) / width];
        weights.iter().all(|w| w.is_finite()).then_some(weights)
    }
}
