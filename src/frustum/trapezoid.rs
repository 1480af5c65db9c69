//! The two trapezoids that a frustum projects to, and clipping by one.
//!
//! Source: "View Frustum Culling Geometric Algorithm" (视锥体裁剪几何算法研究, in Chinese),
//! the projection-reduction ("V/W") method. In the
//! computing frame ([`Pose`](crate::Pose)) the plane V holds `x` and `z`, the
//! plane W holds `y` and `z`. The frustum's projections on them are the
//! trapezoids TV and TW; a point is in the frustum exactly if its projections
//! are in both. So clipping in space is clipping twice in the plane and
//! intersecting two intervals. Each step is a public function:
//!
//! 1. [`Pose::to_frame`](crate::Pose::to_frame) both ends;
//! 2. [`Trapezoid::clip_segment`] the projections by [`Frustum::tv`] and
//!    [`Frustum::tw`];
//! 3. [`Interval::intersection`] of the two;
//! 4. [`Pose::to_world`](crate::Pose::to_world) the points at its ends.
//!
//! These steps are plain arithmetic, for learning and for plain results; the
//! library's exact clippers decide by exact signs instead. A trapezoid may be a
//! triangle (a pyramid), a rectangle (orthographic) or infinite. Segments that have
//! zero length or are parallel to a side need no special case: a division occurs
//! only for a side at which the values of the two ends differ in sign.

use super::{Direction, EndRect, Frustum, Shape};
use crate::math::Interval;

/// One of a trapezoid's parallel sides: `low..high` at `z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrapezoidEnd {
    /// The frame `z` of the side.
    pub z: f64,
    /// The lower bound.
    pub low: f64,
    /// The upper bound.
    pub high: f64,
}

/// A closed trapezoid whose parallel sides are perpendicular to `z`. Its points are
/// `[x, z]` or `[y, z]` in the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trapezoid {
    /// The hull of two parallel sides.
    Finite {
        /// The side at depth zero.
        near: TrapezoidEnd,
        /// The side at the greatest depth.
        far: TrapezoidEnd,
    },
    /// One side and everything beyond it.
    Infinite {
        /// The side at depth zero.
        near: TrapezoidEnd,
        /// The change of `low` per unit of depth.
        low_slope: f64,
        /// The change of `high` per unit of depth.
        high_slope: f64,
        /// The direction in which depth grows.
        direction: Direction,
    },
}

impl Frustum {
    /// The paper's TV: the projection on the plane of the frame's `x` and `z`.
    ///
    /// The paper's method, step by step:
    /// ```
    /// use frusta::{EndRect, Frustum, Pose, Shape, Vec3};
    ///
    /// let shape = Shape::Finite {
    ///     near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    ///     far: EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0),
    /// };
    /// let frustum = Frustum::new(Pose::IDENTITY, shape)?;
    /// let (a, b) = (Vec3::new(-4.0, 0.0, 2.0), Vec3::new(4.0, 0.0, 2.0));
    ///
    /// let (p, q) = (frustum.pose().to_frame(a), frustum.pose().to_frame(b));
    /// let on_v = frustum.tv().clip_segment([p.x, p.z], [q.x, q.z]);
    /// let on_w = frustum.tw().clip_segment([p.y, p.z], [q.y, q.z]);
    /// let both = on_v.unwrap().intersection(on_w.unwrap()).unwrap();
    /// assert_eq!((both.start(), both.end()), (0.25, 0.75));
    /// let entry = frustum.pose().to_world(p + (q - p) * both.start());
    /// assert_eq!(entry, Vec3::new(-2.0, 0.0, 2.0));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    #[must_use]
    pub fn tv(&self) -> Trapezoid {
        self.project(|r| [r.left, r.right])
    }

    /// The paper's TW: the projection on the plane of the frame's `y` and `z`.
    #[must_use]
    pub fn tw(&self) -> Trapezoid {
        self.project(|r| [r.bottom, r.top])
    }

    fn project(&self, bounds: impl Fn(crate::Rect) -> [f64; 2]) -> Trapezoid {
        let side = |end: EndRect| {
            let [low, high] = bounds(end.rect);
            TrapezoidEnd {
                z: end.z,
                low,
                high,
            }
        };
        match *self.shape() {
            Shape::Finite { near, far } => Trapezoid::Finite {
                near: side(near),
                far: side(far),
            },
            Shape::Infinite {
                near,
                slopes,
                direction,
            } => {
                let [low_slope, high_slope] = bounds(slopes);
                Trapezoid::Infinite {
                    near: side(near),
                    low_slope,
                    high_slope,
                    direction,
                }
            }
        }
    }
}

impl Trapezoid {
    /// The side at depth zero.
    pub fn near(&self) -> TrapezoidEnd {
        match *self {
            Self::Finite { near, .. } | Self::Infinite { near, .. } => near,
        }
    }

    /// The side at the greatest depth; `None` for an infinite trapezoid.
    pub fn far(&self) -> Option<TrapezoidEnd> {
        match *self {
            Self::Finite { far, .. } => Some(far),
            Self::Infinite { .. } => None,
        }
    }

    /// Whether the trapezoid is symmetric about the frame's `z` axis, so that both legs
    /// have the same half-width.
    pub fn is_isosceles(&self) -> bool {
        let near = self.near();
        let (low, high) = match *self {
            Self::Finite { far, .. } => (far.low, far.high),
            Self::Infinite {
                low_slope,
                high_slope,
                ..
            } => (low_slope, high_slope),
        };
        -near.low == near.high && -low == high
    }

    /// Whether a point is in the closed trapezoid, by plain arithmetic.
    ///
    /// The answer is right for every point farther from the outline than about `8 u`
    /// times the largest coordinate. False if a number is infinite or NaN.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        self.clip_segment(point, point).is_some()
    }

    /// The parameters `t` for which `p + t (q - p)`, `0 <= t <= 1`, is in the
    /// closed trapezoid, by plain arithmetic; `None` if there are none or if a
    /// number is infinite or NaN.
    ///
    /// A segment of zero length in the trapezoid gives `0..=1`. Each boundary
    /// value errs by at most about `8 u` times its largest term; an end within
    /// that of a side may come out on either side of it.
    #[must_use]
    pub fn clip_segment(&self, p: [f64; 2], q: [f64; 2]) -> Option<Interval> {
        let (trapezoid, [p, q]) = self.in_range(p, q)?;
        let (at_p, at_q) = (trapezoid.values(p), trapezoid.values(q));
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for (f, g) in at_p.into_iter().zip(at_q) {
            match (f < 0.0, g < 0.0) {
                (true, true) => return None,
                (true, false) => start = start.max(f / (f - g)),
                (false, true) => end = end.min(f / (f - g)),
                (false, false) => {}
            }
        }
        Interval::new(start, end)
    }

    /// Values of the four sides (near, far, low, high) at a point: positive
    /// inside, zero on the side. A missing far side has the value 1.
    fn values(&self, [x, z]: [f64; 2]) -> [f64; 4] {
        match *self {
            Self::Finite { near, far } => {
                let sign = if far.z < near.z { -1.0 } else { 1.0 };
                let depth = sign * (z - near.z);
                let whole = sign * (far.z - near.z);
                [
                    depth,
                    sign * (far.z - z),
                    (x - near.low) * whole - (far.low - near.low) * depth,
                    (near.high - x) * whole + (far.high - near.high) * depth,
                ]
            }
            Self::Infinite {
                near,
                low_slope,
                high_slope,
                direction,
            } => {
                let depth = direction.sign() * (z - near.z);
                [
                    depth,
                    1.0,
                    (x - near.low) - low_slope * depth,
                    (near.high - x) + high_slope * depth,
                ]
            }
        }
    }

    /// The trapezoid and the points, scaled by powers of two where products could leave
    /// the range of `f64`; `None` if a number is infinite or NaN.
    fn in_range(&self, p: [f64; 2], q: [f64; 2]) -> Option<(Self, [[f64; 2]; 2])> {
        let near = self.near();
        let (across, slope) = match *self {
            Self::Finite { far, .. } => ([far.low, far.high], 0.0),
            Self::Infinite {
                low_slope,
                high_slope,
                ..
            } => ([0.0; 2], largest(&[low_slope, high_slope])),
        };
        let far_z = self.far().map_or(0.0, |far| far.z);
        let x = largest(&[p[0], q[0], near.low, near.high, across[0], across[1]]);
        let z = largest(&[p[1], q[1], near.z, far_z]);
        if [x, z].iter().all(|m| (1e-70..1e70).contains(m)) && slope < 1e70 {
            return Some((*self, [p, q]));
        }
        if !(x.is_finite() && z.is_finite() && slope.is_finite()) {
            return None;
        }
        let z_shift = -exponent(z);
        let x_shift = -exponent(x).max(exponent(slope) + exponent(z));
        let point = |[x, z]: [f64; 2]| [libm::ldexp(x, x_shift), libm::ldexp(z, z_shift)];
        Some((self.shifted(x_shift, z_shift), [point(p), point(q)]))
    }

    fn shifted(&self, x_shift: i32, z_shift: i32) -> Self {
        let side = |end: TrapezoidEnd| TrapezoidEnd {
            z: libm::ldexp(end.z, z_shift),
            low: libm::ldexp(end.low, x_shift),
            high: libm::ldexp(end.high, x_shift),
        };
        match *self {
            Self::Finite { near, far } => Self::Finite {
                near: side(near),
                far: side(far),
            },
            Self::Infinite {
                near,
                low_slope,
                high_slope,
                direction,
            } => Self::Infinite {
                near: side(near),
                low_slope: libm::ldexp(low_slope, x_shift - z_shift),
                high_slope: libm::ldexp(high_slope, x_shift - z_shift),
                direction,
            },
        }
    }
}

/// The largest magnitude; NaN if any value is NaN.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, v| {
        if v.abs() > m || v.is_nan() {
            v.abs()
        } else {
            m
        }
    })
}

/// An `e` with `|x| <= 2^e / 4`, so that sums of two stay below `2^e`.
fn exponent(x: f64) -> i32 {
    if x == 0.0 { -1100 } else { libm::ilogb(x) + 3 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangle() -> Trapezoid {
        Trapezoid::Finite {
            near: TrapezoidEnd {
                z: 0.0,
                low: 0.0,
                high: 0.0,
            },
            far: TrapezoidEnd {
                z: 4.0,
                low: -4.0,
                high: 2.0,
            },
        }
    }

    fn wedge() -> Trapezoid {
        Trapezoid::Infinite {
            near: TrapezoidEnd {
                z: -1.0,
                low: -1.0,
                high: 1.0,
            },
            low_slope: -1.0,
            high_slope: 0.5,
            direction: Direction::MinusZ,
        }
    }

    #[test]
    fn closed_at_every_side() {
        let clip = |t: Trapezoid, p, q| t.clip_segment(p, q).map(|i| (i.start(), i.end()));
        let t = triangle();
        assert_eq!(clip(t, [-1.0, 0.0], [1.0, 0.0]), Some((0.5, 0.5)));
        assert_eq!(
            clip(t, [-9.0, 4.0], [9.0, 4.0]),
            Some((5.0 / 18.0, 11.0 / 18.0))
        );
        assert_eq!(clip(t, [-1.0, 1.0], [-4.0, 4.0]), Some((0.0, 1.0)));
        assert_eq!(clip(t, [-2.0, 1.0], [-5.0, 4.0]), None);
        assert_eq!(clip(t, [1.0, 2.0], [1.0, 2.0]), Some((0.0, 1.0)));
        assert_eq!(clip(t, [1.5, 2.0], [1.5, 2.0]), None);
        let w = wedge();
        assert_eq!(clip(w, [0.0, 0.0], [0.0, -1e300]), Some((1e-300, 1.0)));
        assert_eq!(clip(w, [-3.0, -3.0], [3.0, -3.0]), Some((0.0, 5.0 / 6.0)));
        assert!(!w.contains([0.0, 0.0]) && w.contains([-1e200, -1e201]));
    }

    #[test]
    fn isosceles() {
        assert!(!triangle().is_isosceles() && !wedge().is_isosceles());
        let side = |z, h: f64| TrapezoidEnd {
            z,
            low: -h,
            high: h,
        };
        let t = Trapezoid::Finite {
            near: side(0.0, 0.5),
            far: side(1.0, 3.0),
        };
        assert!(t.is_isosceles());
    }

    #[test]
    fn any_power_of_two_gives_the_same_answer() {
        // Across the depth and, in both directions, across both legs.
        let ends = [
            ([-3.0, 1.0], [2.0, 3.5]),
            ([-9.0, 3.0], [9.0, 3.5]),
            ([9.0, 3.0], [-9.0, 2.5]),
        ];
        for (t, sign) in [(triangle(), 1.0), (wedge(), -1.0)] {
            for (p, q) in ends {
                let (p, q) = ([p[0], sign * p[1]], [q[0], sign * q[1]]);
                let expected = t.clip_segment(p, q);
                assert!(expected.is_some_and(|i| i.end() < 1.0 || i.start() > 0.0));
                for e in [-1060, -800, -600, 300, 600, 1015] {
                    for f in [-900, 0, 1015] {
                        let point = |[x, z]: [f64; 2]| [libm::ldexp(x, e), libm::ldexp(z, f)];
                        // Slopes must be in the range of `f64`, too.
                        if (e - f).abs() < 1000 {
                            let got = t.shifted(e, f).clip_segment(point(p), point(q));
                            assert_eq!(got, expected, "{e} {f}");
                        }
                    }
                }
            }
        }
    }

    proptest! {
        #[test]
        fn never_nan(bits in prop::array::uniform10(any::<u64>()), infinite in any::<bool>()) {
            let v = bits.map(f64::from_bits);
            let near = TrapezoidEnd { z: v[0], low: v[1], high: v[2] };
            let t = if infinite {
                Trapezoid::Infinite { near, low_slope: v[3], high_slope: v[4],
                                      direction: Direction::PlusZ }
            } else {
                Trapezoid::Finite { near, far: TrapezoidEnd { z: v[3], low: v[4], high: v[5] } }
            };
            if let Some(i) = t.clip_segment([v[6], v[7]], [v[8], v[9]]) {
                prop_assert!(0.0 <= i.start() && i.start() <= i.end() && i.end() <= 1.0);
            }
        }

        #[test]
        fn agrees_with_membership(p in prop::array::uniform2(-6.0..6.0), q in prop::array::uniform2(-6.0..6.0),
                                  s in 0.0..1.0) {
            for t in [triangle(), wedge()] {
                let at = |s: f64| [p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])];
                let clip = t.clip_segment(p, q);
                let inside = t.contains(at(s));
                // Away from the ends of the interval the two must agree.
                let margin = clip.map_or(1.0, |i| (s - i.start()).abs().min((s - i.end()).abs()));
                if margin > 1e-9 {
                    prop_assert_eq!(clip.is_some_and(|i| i.contains(s)), inside);
                }
            }
        }
    }
}
