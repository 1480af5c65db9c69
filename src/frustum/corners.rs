//! A frustum's vertices and planes in the world, rounded.
//!
//! They serve drawing, bounding and plain algorithms. Each coordinate of a vertex
//! is the exact one, rounded once: Cramer's rule in exact arithmetic and one
//! division. Planes are exact up to the final scaling to unit length. No exact
//! decision uses a rounded value from here: it starts from the frustum itself or, for
//! spheres, from the unrounded vertices.

use super::eval::exact_vec::{Dyadic, Dyadic3, Rounded, cross, dot, exact, normalised_by_power};
use super::{EndRect, Face, Frustum, Shape};
use crate::math::{Rect, Vec3};

/// The vertices of a frustum, in the world.
///
/// Each end has four, in the order left bottom, right bottom, right top, left top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners {
    /// The near end's vertices; at an edge or an apex some or all are equal.
    pub near: [Vec3<f64>; 4],
    /// The far end's vertices, or the directions of the edges that have no end.
    pub far: FarCorners,
}

/// The far half of [`Corners`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FarCorners {
    /// The far end's vertices.
    Points([Vec3<f64>; 4]),
    /// For an infinite frustum: the direction of each edge from its near vertex, per
    /// unit of depth.
    Directions([Vec3<f64>; 4]),
}

/// A plane in Hessian normal form: `normal . p + offset` is the signed distance of `p`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The unit normal.
    pub normal: Vec3<f64>,
    /// The signed distance of the world's origin.
    pub offset: f64,
}

impl Plane {
    /// The signed distance of a point, in plain arithmetic; positive inside the frustum.
    #[must_use]
    #[inline]
    pub fn signed_distance(&self, p: Vec3<f64>) -> f64 {
        self.normal.dot(p) + self.offset
    }
}

/// The exact inverse of a pose, over one denominator.
pub(crate) struct Inverse {
    /// Columns of the adjugate.
    columns: [Dyadic3; 3],
    origin_times_determinant: Dyadic3,
    pub(crate) determinant: Dyadic,
}

impl Inverse {
    pub(crate) fn new(frustum: &Frustum) -> Self {
        let pose = frustum.pose();
        let [a, b, c] = pose.axes.map(exact);
        let columns = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
        let determinant = dot(&a, &columns[0]);
        let origin = exact(pose.origin);
        Self {
            origin_times_determinant: origin.map(|x| &x * &determinant),
            columns,
            determinant,
        }
    }

    /// The vector with these frame coordinates, times the determinant.
    pub(crate) fn vector(&self, frame: &Dyadic3) -> Dyadic3 {
        std::array::from_fn(|i| {
            let row = [0, 1, 2].map(|k| &self.columns[k][i] * &frame[k]);
            &(&row[0] + &row[1]) + &row[2]
        })
    }

    /// The point with these frame coordinates, times the determinant.
    pub(crate) fn point(&self, frame: &Dyadic3) -> Dyadic3 {
        let (v, o) = (self.vector(frame), &self.origin_times_determinant);
        [0, 1, 2].map(|i| &v[i] + &o[i])
    }

    /// A result of [`Inverse::vector`] or [`Inverse::point`], divided by the determinant;
    /// each coordinate is rounded once.
    pub(crate) fn rounded(&self, times_determinant: &Dyadic3) -> Vec3<f64> {
        Vec3::from([0, 1, 2].map(|i| times_determinant[i].ratio(&self.determinant)))
    }
}

/// The corners of an end in the frame, in order around it.
fn around(end: &EndRect) -> [Dyadic3; 4] {
    let (r, z) = (end.rect, end.z);
    let corners = [
        [r.left, r.bottom, z],
        [r.right, r.bottom, z],
        [r.right, r.top, z],
        [r.left, r.top, z],
    ];
    corners.map(|corner| corner.map(Dyadic::from))
}

/// The corners of the near and the far end in the frame; for an infinite frustum the rays
/// instead of the far corners.
pub(crate) fn ends(shape: &Shape) -> [[Dyadic3; 4]; 2] {
    let other = match *shape {
        Shape::Finite { far, .. } => far,
        Shape::Infinite {
            slopes, direction, ..
        } => EndRect {
            z: direction.sign(),
            rect: slopes,
        },
    };
    [around(&shape.near()), around(&other)]
}

impl Frustum {
    /// The vertices of the frustum, in the world.
    ///
    /// Error: each coordinate is correctly rounded (half an ulp); one beyond
    /// the range of `f64` is infinite.
    ///
    /// ```
    /// use frusta::{EndRect, FarCorners, Frustum, Pose, Shape, Vec3};
    /// let shape = Shape::Finite {
    ///     near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    ///     far: EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0),
    /// };
    /// let corners = Frustum::new(Pose::IDENTITY, shape)?.corners();
    /// assert_eq!(corners.near[1], Vec3::new(1.0, -1.0, 1.0));
    /// let FarCorners::Points(far) = corners.far else { unreachable!() };
    /// assert_eq!(far[2], Vec3::new(3.0, 3.0, 3.0));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    #[must_use]
    pub fn corners(&self) -> Corners {
        let inverse = Inverse::new(self);
        let point = |corner| inverse.rounded(&inverse.point(&corner));
        let direction = |ray| inverse.rounded(&inverse.vector(&ray));
        let [near, other] = ends(self.shape());
        Corners {
            near: near.map(point),
            far: match self.shape() {
                Shape::Finite { .. } => FarCorners::Points(other.map(point)),
                Shape::Infinite { .. } => FarCorners::Directions(other.map(direction)),
            },
        }
    }

    /// The plane of a face, its normal pointing inwards; `None` for the far
    /// face of an infinite frustum.
    ///
    /// Error: each number is within 4 ulp of the exact unit plane's (3.5 u: one
    /// rounding, the length 1.5, the quotient 1). The signed distance itself is
    /// computed within 4 u, so it is off by at most `8 u (|p| + |offset|)`, and a
    /// vertex may lie off its own planes by that much. An offset beyond the range of
    /// `f64` is infinite.
    ///
    /// ```
    /// use frusta::{EndRect, Face, Frustum, Pose, Shape, Vec3};
    /// let shape = Shape::Finite {
    ///     near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    ///     far: EndRect::new(3.0, -1.0, 1.0, -1.0, 1.0),
    /// };
    /// let frustum = Frustum::new(Pose::IDENTITY, shape)?;
    /// let left = frustum.plane(Face::Left).unwrap();
    /// assert_eq!((left.normal, left.offset), (Vec3::new(1.0, 0.0, 0.0), 1.0));
    /// # Ok::<(), frusta::FrustumError>(())
    /// ```
    #[must_use]
    pub fn plane(&self, face: Face) -> Option<Plane> {
        let axes = self.pose().axes;
        let [across, along, constant] = self.frame_plane(face)?;
        let (u, v) = match face {
            Face::Bottom | Face::Top => (exact(axes[1]), exact(axes[2])),
            _ => (exact(axes[0]), exact(axes[2])),
        };
        let normal: Dyadic3 = std::array::from_fn(|i| &(&u[i] * &across) + &(&v[i] * &along));
        let offset = &constant - &dot(&normal, &exact(self.pose().origin));
        // Never `None`: the axes are independent, and one coefficient is not zero.
        let (n, length, shift) = normalised_by_power(&normal)?;
        Some(Plane {
            normal: Vec3::new(n.x / length, n.y / length, n.z / length),
            offset: offset.scaled(shift) / length,
        })
    }

    /// The planes of all faces of the frustum, in the order of [`Face::ALL`].
    pub fn planes(&self) -> impl Iterator<Item = (Face, Plane)> + '_ {
        Face::ALL
            .into_iter()
            .filter_map(|face| self.plane(face).map(|plane| (face, plane)))
    }

    /// A face's plane in the frame: coefficients of `x` (or `y`) and of `z`,
    /// and the constant.
    fn frame_plane(&self, face: Face) -> Option<[Dyadic; 3]> {
        let zero = Dyadic::from(0.0);
        let near = self.shape().near();
        let sign = Dyadic::from(self.shape().direction().sign());
        let near_z = Dyadic::from(near.z);
        let bound = |r: Rect| match face {
            Face::Left => r.left,
            Face::Right => r.right,
            Face::Bottom => r.bottom,
            _ => r.top,
        };
        // The bound grows by `rise` over the depth `run`.
        let at_near = Dyadic::from(bound(near.rect));
        let (rise, run) = match *self.shape() {
            Shape::Finite { far, .. } => (
                &Dyadic::from(bound(far.rect)) - &at_near,
                &(&Dyadic::from(far.z) - &near_z) * &sign,
            ),
            Shape::Infinite { slopes, .. } => (Dyadic::from(bound(slopes)), Dyadic::from(1.0)),
        };
        let rise = &rise * &sign;
        Some(match face {
            Face::Near => {
                let constant = -&(&near_z * &sign);
                [zero, sign, constant]
            }
            Face::Far => {
                let far_z = Dyadic::from(self.shape().far()?.z);
                let constant = &far_z * &sign;
                [zero, -&sign, constant]
            }
            // (x - at_near) run - rise (z - near.z) >= 0, or the opposite.
            Face::Left | Face::Bottom => {
                let constant = &(&rise * &near_z) - &(&at_near * &run);
                [run, -&rise, constant]
            }
            Face::Right | Face::Top => {
                let constant = &(&at_near * &run) - &(&rise * &near_z);
                [-&run, rise, constant]
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Direction;
    use crate::math::Pose;

    fn shape(infinite: bool) -> Shape {
        let near = EndRect::new(-2.0, 0.0, 1.0, -1.0, 0.5);
        if infinite {
            Shape::Infinite {
                near,
                slopes: Rect::new(-0.5, 1.0, 0.25, 2.0),
                direction: Direction::MinusZ,
            }
        } else {
            Shape::Finite {
                near,
                far: EndRect::new(-6.0, -3.0, 1.0, -2.0, 4.0),
            }
        }
    }

    /// Vertices lie on their planes and inside the others, up to rounding.
    fn check(frustum: &Frustum, scale: f64) {
        let corners = frustum.corners();
        let far = match corners.far {
            FarCorners::Points(far) => far,
            FarCorners::Directions(d) => [0, 1, 2, 3].map(|i| corners.near[i] + d[i] * 4.0),
        };
        let sides = [
            [Face::Left, Face::Bottom],
            [Face::Right, Face::Bottom],
            [Face::Right, Face::Top],
            [Face::Left, Face::Top],
        ];
        for (points, end) in [(corners.near, Face::Near), (far, Face::Far)] {
            for (p, sides) in points.into_iter().zip(sides) {
                for (face, plane) in frustum.planes() {
                    let distance = plane.signed_distance(p);
                    assert!((plane.normal.dot(plane.normal) - 1.0).abs() < 1e-15);
                    if face == end || sides.contains(&face) {
                        assert!(distance.abs() < 1e-14 * scale, "{face}: {distance}");
                    } else {
                        assert!(distance > 0.1, "{face}: {distance}");
                    }
                }
            }
        }
    }

    #[test]
    fn vertices_and_planes_agree() {
        for infinite in [false, true] {
            let turned = Pose::new(
                Vec3::new(3.0, -1.0, 1e3),
                [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]].map(Vec3::from),
            );
            let skew = Pose::new(
                Vec3::new(0.0, 7.0, 0.0),
                [[1.0, 0.5, 0.0], [0.0, -1.0, 0.25], [0.0, 0.0, 0.5]].map(Vec3::from),
            );
            for (pose, scale) in [(Pose::IDENTITY, 1.0), (turned, 1e3), (skew, 10.0)] {
                let frustum = Frustum::new(pose, shape(infinite)).unwrap();
                check(&frustum, scale);
                assert_eq!(frustum.planes().count(), if infinite { 5 } else { 6 });
            }
        }
    }

    #[test]
    fn vertices_are_correctly_rounded() {
        // Thirds are not representable; the literals are the nearest values.
        let pose = Pose::new(
            Vec3::default(),
            [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]].map(Vec3::from),
        );
        let frustum = Frustum::new(pose, shape(false)).unwrap();
        let near = frustum.corners().near;
        assert_eq!(near[0], Vec3::new(0.0, -1.0 / 3.0, -2.0 / 3.0));
        assert_eq!(near[2], Vec3::new(1.0 / 3.0, 0.5 / 3.0, -2.0 / 3.0));
    }

    #[test]
    fn extreme_scales() {
        for s in [1e-300, 1e-160, 1e155, 1e300] {
            let pose = Pose::new(
                Vec3::default(),
                [[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]].map(Vec3::from),
            );
            let frustum = Frustum::new(pose, shape(false)).unwrap();
            assert_eq!(frustum.corners().near[1].x, 1.0 / s);
            let near = frustum.plane(Face::Near).unwrap();
            assert_eq!(near.normal, Vec3::new(0.0, 0.0, -1.0));
            assert!((near.offset * s / -2.0 - 1.0).abs() < 1e-15);
        }
    }
}
