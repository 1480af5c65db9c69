//! Frusta derived from another one: a pick box, a tile, one eye of a stereo pair.
//!
//! The frame stays; only the bounds of the rectangles change. Each new bound is
//! the exact value rounded once, a monotone function of the fraction alone. So
//! adjacent windows share their border bit for bit, the fractions 0 and 1 give
//! the parent's own bounds, and windows in order never overlap. The same holds for
//! infinite frusta, whose slopes are treated like a far rectangle. A window that
//! rounding leaves without width or height at both ends is an error.

use super::eval::exact_vec::{Dyadic, Rounded};
use super::{Frustum, FrustumError, Shape};
use crate::math::Rect;

/// The fraction `numerator / denominator`.
struct Fraction {
    numerator: Dyadic,
    denominator: Dyadic,
}

impl Fraction {
    fn new(numerator: f64, denominator: f64) -> Self {
        Self {
            numerator: numerator.into(),
            denominator: denominator.into(),
        }
    }

    /// The value at this fraction of the way from `low` to `high`, rounded once.
    fn between(&self, low: f64, high: f64) -> f64 {
        if low == high {
            return low;
        }
        let (low, high) = (Dyadic::from(low), Dyadic::from(high));
        let way = &(&high - &low) * &self.numerator;
        (&(&low * &self.denominator) + &way).ratio(&self.denominator)
    }
}

impl Frustum {
    /// The part of the frustum seen through a part of the picture.
    ///
    /// `window` is in fractions of the picture: `x` from 0 at the left side to
    /// 1 at the right, `y` from 0 at the bottom to 1 at the top. It may extend
    /// beyond the picture. (A pixel `i` of `n`, counted from the left, is `i / n ..
    /// (i + 1) / n`; rows counted from the top need `1 - `.)
    ///
    /// # Errors
    /// [`FrustumError::NonFinite`], [`FrustumError::Inverted`],
    /// [`FrustumError::Flat`] for a window that has no width or no height, or none
    /// after rounding; [`FrustumError::Overflow`].
    ///
    /// ```
    /// use frusta::{EndRect, Frustum, Pose, Rect, Shape};
    /// let shape = Shape::Finite {
    ///     near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    ///     far: EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0),
    /// };
    /// let frustum = Frustum::new(Pose::IDENTITY, shape)?;
    /// let pick = frustum.window(Rect::new(0.5, 0.75, 0.0, 0.25))?;
    /// assert_eq!(pick.shape().near().rect, Rect::new(0.0, 0.5, -1.0, -0.5));
    /// assert_eq!(pick.shape().far().unwrap().rect, Rect::new(0.0, 1.5, -3.0, -1.5));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    pub fn window(&self, window: Rect) -> Result<Frustum, FrustumError> {
        let names = ["window.left", "window.right", "window.bottom", "window.top"];
        for (what, value) in names.into_iter().zip(window.to_array()) {
            FrustumError::check_finite(what, value)?;
        }
        for (what, low, high) in [
            ("left..right", window.left, window.right),
            ("bottom..top", window.bottom, window.top),
        ] {
            if low > high {
                return Err(FrustumError::Inverted {
                    end: "window",
                    what,
                    low,
                    high,
                });
            }
        }
        self.part(&window.to_array().map(|s| Fraction::new(s, 1.0)))
    }

    /// One tile of the picture divided into `columns` by `rows`, counted from 0 at the
    /// left and at the bottom.
    ///
    /// Adjacent tiles share their border bit for bit; the outer borders are
    /// the frustum's own.
    ///
    /// # Errors
    /// [`FrustumError::NoSuchTile`]; [`FrustumError::Flat`] if the tile has no width
    /// or no height after rounding.
    ///
    /// ```
    /// # use frusta::{EndRect, Frustum, Pose, Shape};
    /// # let shape = Shape::Finite {
    /// #     near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    /// #     far: EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0),
    /// # };
    /// # let frustum = Frustum::new(Pose::IDENTITY, shape)?;
    /// let (a, b) = (frustum.tile(0, 0, 3, 1)?, frustum.tile(1, 0, 3, 1)?);
    /// assert_eq!(a.shape().near().rect.right, b.shape().near().rect.left);
    /// assert_eq!(a.shape().near().rect.left, -1.0);
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    pub fn tile(
        &self,
        column: u32,
        row: u32,
        columns: u32,
        rows: u32,
    ) -> Result<Frustum, FrustumError> {
        if column >= columns || row >= rows {
            return Err(FrustumError::NoSuchTile {
                column,
                row,
                columns,
                rows,
            });
        }
        let [i, j, columns, rows] = [column, row, columns, rows].map(f64::from);
        self.part(&[
            Fraction::new(i, columns),
            Fraction::new(i + 1.0, columns),
            Fraction::new(j, rows),
            Fraction::new(j + 1.0, rows),
        ])
    }

    /// The frustum of one eye of a stereo pair: moved sideways, with the same
    /// picture at the distance of convergence.
    ///
    /// For a frustum whose eye is at frame `z = 0`, such as a
    /// [`Camera`](crate::Camera)'s or a perspective matrix's. The eye moves by
    /// `offset` along the frame's `x` (to the right if positive), the sides
    /// turn to pass through the parent's sides at frame `z = convergence`, and
    /// near and far stay. The frame stays too: the new eye is at frame `x =
    /// offset`, so the pose is not rounded. A convergence of `f64::INFINITY` gives
    /// parallel eyes.
    ///
    /// In general it is the shear that moves the plane `z = 0` by `offset` and
    /// keeps the plane `z = convergence`. Each new bound is rounded once.
    ///
    /// # Errors
    /// [`FrustumError::NonFinite`] for the offset; [`FrustumError::Convergence`]
    /// for a convergence that is 0 or NaN; [`FrustumError::Flat`],
    /// [`FrustumError::Overflow`].
    ///
    /// ```
    /// # use frusta::{EndRect, Frustum, Pose, Rect, Shape};
    /// let shape = Shape::Finite {
    ///     near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    ///     far: EndRect::new(4.0, -4.0, 4.0, -4.0, 4.0),
    /// };
    /// let frustum = Frustum::new(Pose::IDENTITY, shape)?;
    /// let right = frustum.stereo_eye(0.25, 2.0)?;
    /// assert_eq!(right.shape().near().rect, Rect::new(-0.875, 1.125, -1.0, 1.0));
    /// assert_eq!(right.shape().far().unwrap().rect, Rect::new(-4.25, 3.75, -4.0, 4.0));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    pub fn stereo_eye(&self, offset: f64, convergence: f64) -> Result<Frustum, FrustumError> {
        FrustumError::check_finite("offset", offset)?;
        if convergence == 0.0 || convergence.is_nan() {
            return Err(FrustumError::Convergence { convergence });
        }
        // offset (1 - z / convergence), as gain / whole * (whole - z).
        let (gain, whole) = if convergence.is_infinite() {
            (0.0, 1.0)
        } else {
            (1.0, convergence)
        };
        let (gain, whole) = (Dyadic::from(gain), Dyadic::from(whole));
        let offset = Dyadic::from(offset);
        let moved = |x: f64, z: f64| {
            let way = &offset * &(&whole - &(&gain * &z.into()));
            (&(&Dyadic::from(x) * &whole) + &way).ratio(&whole)
        };
        let turned = |slope: f64, sign: f64| {
            let way = &(&offset * &gain) * &sign.into();
            (&(&Dyadic::from(slope) * &whole) - &way).ratio(&whole)
        };
        let shape = match *self.shape() {
            Shape::Finite { mut near, mut far } => {
                for end in [&mut near, &mut far] {
                    end.rect.left = moved(end.rect.left, end.z);
                    end.rect.right = moved(end.rect.right, end.z);
                }
                Shape::Finite { near, far }
            }
            Shape::Infinite {
                mut near,
                mut slopes,
                direction,
            } => {
                near.rect.left = moved(near.rect.left, near.z);
                near.rect.right = moved(near.rect.right, near.z);
                slopes.left = turned(slopes.left, direction.sign());
                slopes.right = turned(slopes.right, direction.sign());
                Shape::Infinite {
                    near,
                    slopes,
                    direction,
                }
            }
        };
        self.with_shape(shape, "a bound of the eye's frustum")
    }

    fn part(&self, fractions: &[Fraction; 4]) -> Result<Frustum, FrustumError> {
        let [left, right, bottom, top] = fractions;
        let cut = |r: Rect| {
            Rect::new(
                left.between(r.left, r.right),
                right.between(r.left, r.right),
                bottom.between(r.bottom, r.top),
                top.between(r.bottom, r.top),
            )
        };
        let shape = match *self.shape() {
            Shape::Finite { mut near, mut far } => {
                near.rect = cut(near.rect);
                far.rect = cut(far.rect);
                Shape::Finite { near, far }
            }
            Shape::Infinite {
                mut near,
                slopes,
                direction,
            } => {
                near.rect = cut(near.rect);
                Shape::Infinite {
                    near,
                    slopes: cut(slopes),
                    direction,
                }
            }
        };
        self.with_shape(shape, "a bound of the window")
    }

    fn with_shape(&self, shape: Shape, what: &'static str) -> Result<Frustum, FrustumError> {
        let sides = match shape {
            Shape::Finite { near, far } => [near.rect, far.rect],
            Shape::Infinite { near, slopes, .. } => [near.rect, slopes],
        };
        let infinite = |r: &Rect| r.to_array().iter().any(|x| x.is_infinite());
        if sides.iter().any(infinite) {
            return Err(FrustumError::Overflow { what });
        }
        Frustum::new(*self.pose(), shape)
    }
}
