//! Boundary values in double-double: the filter's values (see
//! [`super::filter`]) with a relative error small enough to compute with.
//!
//! The face is selected by a look-up, not a branch, and several faces, at one
//! point or at several, are evaluated side by side. The rounded value is computed
//! as usual; the rounding error of each of its operations is computed beside it,
//! exactly for sums and products, and added at the end.
//!
//! # The error bound
//! In u^2, with X = A_x S, Z = A_z S (see [`super::filter`]) and c, c_low the
//! rounded difference of a point and the pose's origin, and its rounding error. Only
//! the terms beside the rounded value are rounded; each such sum or product is
//! u times something, so its rounding error is u^2 times that.
//!
//! *The identity pose*, where frame coordinates are the point's: one formula
//! for all faces, `c - at - m (z - z_near)`, with W = Z + |z_near|:
//! ```text
//! depth        slope times w_rest 1, rest times w 1, sums 2 + 3; the slope 15     22 |m| W
//! value        more - low, + rest                        1 + 2 X, |n|; 3 + 5 |m| W
//! ```
//! *Any other pose*: each face is a plane in the world, `N . (p - o) + d`, with
//! N = a_x - m a_z and d = m z_near - at prepared to 106 bits. With Y = sum
//! |N_j c_j| <= X + |m| Z and K = |m z_near| + |at|:
//! ```text
//! N            the slope 15, times a_z 3, minus a_x 3                3 X, 21 |m| Z
//! products     N c_low 1, N_low c 1, both 2, with the rest 3, N_low c_low 1   8 Y
//! rests        of products 3 + 3, of sums 2, with d_low 1, all together 3 + 6  18 Y, 6 K
//! d            the slope 15, times z_near 3, minus at 3         21 |m z_near|, 3 |at|
//! ```
//! Both are below 47.2 u^2 scale (`proofs/precise.gappa`); code that relies on it assumes 60.

use crate::exact::double_double::Dd;
use crate::exact::float::{Lanes, Single, Width, split, two_diff, two_prod_split, two_sum};
use crate::frustum::Shape;
use crate::math::{Pose, Vec3};
use wide::f64x2;

/// A face over the coordinates of the identity pose.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FaceInFrame {
    /// The index of the coordinate.
    axis: usize,
    at: f64,
    /// The slope by z, its upper and lower half, and its rounding error.
    slope: f64,
    halves: (f64, f64),
    rest: f64,
    /// All bits set if every point on the face has the exact `z` of `at`: near
    /// and far of the identity pose.
    exact_z: f64,
}

/// A face as a plane over offsets from the pose's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FaceInWorld {
    normal: [f64; 3],
    halves: [(f64, f64); 3],
    rests: [f64; 3],
    offset: f64,
    offset_rest: f64,
}

impl FaceInWorld {
    /// The plane of a face, from the pose, the face in the frame, and the near `z`.
    fn new(pose: &Pose, face: &FaceInFrame, near: f64) -> Self {
        let slope = Dd::new(face.slope, face.rest);
        let (across, along) = (pose.axes[face.axis], pose.axes[2]);
        let normal = [0, 1, 2].map(|j| {
            let part = slope.mul_f64(along[j]).neg();
            Dd::new(across[j], 0.0).add(part)
        });
        let offset = slope.mul_f64(near).add(Dd::new(-face.at, 0.0));
        FaceInWorld {
            normal: normal.map(|n| n.hi),
            halves: normal.map(|n| split(n.hi)),
            rests: normal.map(|n| n.lo),
            offset: offset.hi,
            offset_rest: offset.lo,
        }
    }
}

impl FaceInWorld {
    /// The contribution of coordinate j, for the same face in each lane.
    #[inline(always)]
    fn term<F: Lanes>(&self, j: usize, p: F, origin: Vec3<f64>) -> (F, F) {
        let halves = (p.splat(self.halves[j].0), p.splat(self.halves[j].1));
        term(
            p,
            origin[j],
            p.splat(self.normal[j]),
            halves,
            p.splat(self.rests[j]),
        )
    }
}

/// The six faces, in the order of [`Face::ALL`](crate::Face::ALL).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Precise {
    /// Padded to eight, so that an index modulo 8 needs no bounds check.
    faces: [FaceInFrame; 8],
    near: f64,
    /// The factors that turn `c - at - m (z - z_near)` into the boundary values.
    signs: [f64; 6],
    /// Origin and planes of a pose that is not the identity.
    world: Option<(Vec3<f64>, [FaceInWorld; 8])>,
}

impl Precise {
    /// From the four sides' slopes by depth.
    pub(crate) fn new(pose: &Pose, shape: &Shape, slopes: &[Dd; 4]) -> Self {
        let sigma = shape.direction().sign();
        let near = shape.near();
        let bounds = near.rect.to_array();
        let face = |axis, at, slope: Dd| FaceInFrame {
            axis,
            at,
            slope: sigma * slope.hi,
            halves: split(sigma * slope.hi),
            rest: sigma * slope.lo,
            exact_z: f64::from_bits(if axis == 2 && pose.is_identity() {
                u64::MAX
            } else {
                0
            }),
        };
        let side = |i: usize| face(i / 2, bounds[i], slopes[i]);
        let no_slope = Dd::new(0.0, 0.0);
        let far = shape.far().map_or(near.z, |far| far.z);
        let faces = [
            face(2, near.z + 0.0, no_slope),
            face(2, far + 0.0, no_slope),
            side(0),
            side(1),
            side(2),
            side(3),
            side(3),
            side(3),
        ];
        let world = || {
            (
                pose.origin,
                faces.map(|f| FaceInWorld::new(pose, &f, near.z)),
            )
        };
        Precise {
            faces,
            near: near.z,
            signs: [sigma, -sigma, 1.0, -1.0, 1.0, -1.0],
            world: (!pose.is_identity()).then(world),
        }
    }

    /// Values of faces (by index) at points, side by side, up to their signs: each
    /// as a rounded value and a small rest, whose exact sum is within 60 u^2 scale of
    /// the exact value.
    #[inline(always)]
    fn values<W: Width<N>, const N: usize>(
        &self,
        width: W,
        faces: [usize; N],
        points: [Vec3<f64>; N],
    ) -> (W::Lanes, W::Lanes) {
        match &self.world {
            None => self.values_in_frame(width, faces, points),
            Some((origin, all)) => {
                values_in_world(width, *origin, faces.map(|f| &all[f & 7]), points)
            }
        }
    }

    #[inline(always)]
    fn values_in_frame<W: Width<N>, const N: usize>(
        &self,
        width: W,
        faces: [usize; N],
        points: [Vec3<f64>; N],
    ) -> (W::Lanes, W::Lanes) {
        let faces = faces.map(|f| &self.faces[f & 7]);
        let coordinate = |j: usize| {
            let p = points[j];
            [p.x, p.y, p.z, 0.0][faces[j].axis & 3]
        };
        let c = width.lanes(std::array::from_fn(coordinate));
        let z = width.lanes(points.map(|p| p.z));
        let slope = width.lanes(faces.map(|f| f.slope));
        let upper = width.lanes(faces.map(|f| f.halves.0));
        let lower = width.lanes(faces.map(|f| f.halves.1));
        let lanes = FaceLanes {
            at: width.lanes(faces.map(|f| f.at)),
            slope,
            halves: (upper, lower),
            rest: width.lanes(faces.map(|f| f.rest)),
        };
        value_in_frame(&lanes, self.near, c, z)
    }

    /// One face's magnitudes at points whose coordinates are given axis by axis, with the same
    /// bits as [`Precise::magnitudes`].
    #[inline(always)]
    pub(crate) fn magnitude<F: Lanes>(&self, face: usize, p: impl Fn(usize) -> F) -> F {
        let (g, rest) = match &self.world {
            None => {
                let face = &self.faces[face & 7];
                let z = p(2);
                let c = if face.axis == 2 { z } else { p(face.axis) };
                let splat = |v: f64| z.splat(v);
                value_in_frame(
                    &FaceLanes {
                        at: splat(face.at),
                        slope: splat(face.slope),
                        halves: (splat(face.halves.0), splat(face.halves.1)),
                        rest: splat(face.rest),
                    },
                    self.near,
                    c,
                    z,
                )
            }
            Some((origin, all)) => {
                let face = &all[face & 7];
                let x = face.term(0, p(0), *origin);
                let y = face.term(1, p(1), *origin);
                let z = face.term(2, p(2), *origin);
                sum(
                    [x, y, z],
                    z.0.splat(face.offset),
                    z.0.splat(face.offset_rest),
                )
            }
        };
        (g + rest).abs()
    }

    /// One face's value with its sign, the high part rounded.
    pub(crate) fn value(&self, face: usize, p: Vec3<f64>) -> Dd {
        let (g, rest) = self.values(Single, [face], [p]);
        let value = Dd::new(g, rest).normal();
        if self.signs[face] < 0.0 {
            value.neg()
        } else {
            value
        }
    }

    /// For each face whether its points have one exact `z`, and that `z`; `None`
    /// unless the pose is the identity.
    #[inline(always)]
    pub(crate) fn exact_z<const N: usize>(
        &self,
        faces: [usize; N],
    ) -> Option<([bool; N], [f64; N])> {
        let faces = faces.map(|f| &self.faces[f & 7]);
        let exact_z = (faces.map(|f| f.exact_z != 0.0), faces.map(|f| f.at));
        self.world.is_none().then_some(exact_z)
    }

    /// `z`, or the exact `z` of the near or far face that was hit.
    #[inline(always)]
    pub(crate) fn z_or_exact(&self, faces: [usize; 2], z: f64x2) -> f64x2 {
        let [a, b] = faces.map(|f| &self.faces[f & 7]);
        f64x2::new([a.exact_z, b.exact_z]).bitselect(f64x2::new([a.at, b.at]), z)
    }

    /// The values' magnitudes, rounded: relative error below u (1 + 1/2) where
    /// the filter is certain.
    #[inline(always)]
    pub(crate) fn magnitudes<W: Width<N>, const N: usize>(
        &self,
        width: W,
        faces: [usize; N],
        points: [Vec3<f64>; N],
    ) -> W::Lanes {
        let (g, rest) = self.values(width, faces, points);
        (g + rest).abs()
    }
}

/// A face over the coordinates of the identity pose, in each lane.
struct FaceLanes<F> {
    at: F,
    slope: F,
    halves: (F, F),
    rest: F,
}

#[inline(always)]
fn value_in_frame<F: Lanes>(face: &FaceLanes<F>, near: f64, c: F, z: F) -> (F, F) {
    let (w, w_rest) = two_diff(z, z.splat(near));
    let (product, low) = two_prod_split(face.slope, face.halves, w);
    let low = low + (face.slope * w_rest + face.rest * w);
    let (across, more) = two_diff(c, face.at);
    let (g, rest) = two_diff(across, product);
    (g, rest + (more - low))
}

#[inline(always)]
fn values_in_world<W: Width<N>, const N: usize>(
    width: W,
    origin: Vec3<f64>,
    faces: [&FaceInWorld; N],
    points: [Vec3<f64>; N],
) -> (W::Lanes, W::Lanes) {
    let x = lanes_term(width, 0, faces, points, origin);
    let y = lanes_term(width, 1, faces, points, origin);
    let z = lanes_term(width, 2, faces, points, origin);
    sum(
        [x, y, z],
        width.lanes(faces.map(|f| f.offset)),
        width.lanes(faces.map(|f| f.offset_rest)),
    )
}

/// The contribution of coordinate j, with one face in each lane.
#[inline(always)]
fn lanes_term<W: Width<N>, const N: usize>(
    width: W,
    j: usize,
    faces: [&FaceInWorld; N],
    points: [Vec3<f64>; N],
    origin: Vec3<f64>,
) -> (W::Lanes, W::Lanes) {
    let normal = width.lanes(faces.map(|f| f.normal[j]));
    let upper = width.lanes(faces.map(|f| f.halves[j].0));
    let lower = width.lanes(faces.map(|f| f.halves[j].1));
    let rest = width.lanes(faces.map(|f| f.rests[j]));
    let p = width.lanes(points.map(|p| p[j]));
    term(p, origin[j], normal, (upper, lower), rest)
}

/// The contribution of one coordinate: its product with the normal's, and the rest.
#[inline(always)]
fn term<F: Lanes>(p: F, origin: f64, normal: F, halves: (F, F), rest: F) -> (F, F) {
    let (c, c_low) = two_diff(p, p.splat(origin));
    let (product, lost) = two_prod_split(normal, halves, c);
    let low = normal * c_low + rest * c;
    (product, lost + low)
}

/// The sum of the three contributions and the offset.
#[inline(always)]
fn sum<F: Lanes>(
    [(x, x_rest), (y, y_rest), (z, z_rest)]: [(F, F); 3],
    offset: F,
    low: F,
) -> (F, F) {
    let (xy, e) = two_sum(x, y);
    let (xyz, f) = two_sum(xy, z);
    let (g, h) = two_sum(xyz, offset);
    let sums = (e + f) + (h + low);
    (g, ((x_rest + y_rest) + z_rest) + sums)
}
