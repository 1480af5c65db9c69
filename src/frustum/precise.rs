//! Boundary values in double-double: the filter's values (see
//! [`super::filter`]) with a relative error small enough to compute with.
//!
//! All six faces are one formula, `|c - at - m (z - z_near)|` with c a frame
//! coordinate, so that which face it is costs a look-up and no branch, and two
//! faces are evaluated side by side. The rounded value goes straight through;
//! what each of its operations lost is computed beside it, exactly for sums
//! and products, and added at the end.
//!
//! # The error bound
//! Only what is added beside the rounded value is rounded; each such sum or
//! product is u times something, so its rounding is u^2 times that. With X =
//! A_x S, Z = A_z S (see [`super::filter`]) and W = Z + |z_near|, in u^2:
//! ```text
//! coordinate   products 3, sums of the rests 2 + 2 + 2, all together 4     13 X, 13 Z
//! depth        w_rest + z_low 2, times slope 2, rest w 1, sums 3 + 4, the
//!              slope's rest times those of w 2, the slope itself 15        29 |m| W
//! value        more + c_low, - low, + rest       2 + 2 + 3 X, 1 + 1 + 2 |n|, 4 + 5 |m| W
//! ```
//! That is 20 X + 4 |n| + 51 |m| W, below 60 u^2 scale. With the identity pose
//! the coordinates are exact.

use super::Shape;
use crate::exact::double_double::Dd;
use crate::exact::float::{split, two_diff, two_prod, two_prod_split, two_sum};
use crate::math::{Pose, Vec3};
use wide::f64x2;

/// A face.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    /// Which frame coordinate.
    axis: usize,
    at: f64,
    /// The slope by z, with its upper and lower half, and what rounding it lost.
    slope: f64,
    high: f64,
    low: f64,
    rest: f64,
    /// All bits set where a point on the face has exactly `at` for its `z`:
    /// near and far of the identity pose.
    level: f64,
}

/// The six faces, in the order of [`super::Face::ALL`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Precise {
    /// Two more than there are, so that no bound is checked.
    rows: [Row; 8],
    near: f64,
    /// What turns `c - at - m (z - z_near)` into the boundary value.
    signs: [f64; 6],
    /// `None` for the identity.
    pose: Option<Pose>,
}

impl Precise {
    /// From the four sides' slopes by depth.
    pub(super) fn new(pose: &Pose, shape: &Shape, slopes: &[Dd; 4]) -> Self {
        let sigma = shape.direction().sign();
        let near = shape.near();
        let bounds = near.rect.to_array();
        let row = |axis, at, slope: Dd| {
            let (high, low) = split(sigma * slope.hi);
            Row {
                axis,
                at,
                slope: sigma * slope.hi,
                high,
                low,
                rest: sigma * slope.lo,
                level: f64::from_bits(if axis == 2 && pose.is_identity() {
                    u64::MAX
                } else {
                    0
                }),
            }
        };
        let side = |i: usize| row(i / 2, bounds[i], slopes[i]);
        let level = Dd::new(0.0, 0.0);
        let far = shape.far().map_or(near.z, |far| far.z);
        Precise {
            rows: [
                row(2, near.z + 0.0, level),
                row(2, far + 0.0, level),
                side(0),
                side(1),
                side(2),
                side(3),
                side(3),
                side(3),
            ],
            near: near.z,
            signs: [sigma, -sigma, 1.0, -1.0, 1.0, -1.0],
            pose: (!pose.is_identity()).then_some(*pose),
        }
    }

    /// Two faces' values (by number) at a point, up to their signs, each as a
    /// rounded value and a small rest whose exact sum is within 60 u^2 scale of
    /// the truth.
    #[inline(always)]
    pub(crate) fn values(&self, faces: [usize; 2], p: Vec3<f64>) -> (f64x2, f64x2) {
        let (a, b) = self.rows(faces);
        let all = f64x2::splat;
        match &self.pose {
            None => {
                let c = [p.x, p.y, p.z, 0.0];
                let c = f64x2::new([c[a.axis & 3], c[b.axis & 3]]);
                self.combine::<true>(a, b, (all(p.z), all(0.0)), (c, all(0.0)))
            }
            Some(pose) => {
                let z = coordinate(pose, [2, 2], p);
                self.combine::<false>(a, b, z, coordinate(pose, [a.axis, b.axis], p))
            }
        }
    }

    /// From frame coordinates z and c; EXACT where their rests are zero.
    #[inline(always)]
    fn combine<const EXACT: bool>(
        &self,
        a: &Row,
        b: &Row,
        (z, z_low): (f64x2, f64x2),
        (c, c_low): (f64x2, f64x2),
    ) -> (f64x2, f64x2) {
        let with = |v: f64x2, low: f64x2| if EXACT { v } else { v + low };
        let slope = f64x2::new([a.slope, b.slope]);
        let halves = (f64x2::new([a.high, b.high]), f64x2::new([a.low, b.low]));
        let (w, w_rest) = two_diff(z, f64x2::splat(self.near));
        let (product, low) = two_prod_split(slope, halves, w);
        let low = low + (slope * with(w_rest, z_low) + f64x2::new([a.rest, b.rest]) * w);
        let (across, more) = two_diff(c, f64x2::new([a.at, b.at]));
        let (g, rest) = two_diff(across, product);
        (g, rest + (with(more, c_low) - low))
    }

    #[inline(always)]
    fn rows(&self, faces: [usize; 2]) -> (&Row, &Row) {
        (&self.rows[faces[0] & 7], &self.rows[faces[1] & 7])
    }

    /// One face's value with its sign, the high part rounded.
    pub(crate) fn value(&self, face: usize, p: Vec3<f64>) -> Dd {
        let (g, rest) = self.values([face; 2], p);
        let value = Dd::new(g.to_array()[0], rest.to_array()[0]).normal();
        if self.signs[face] < 0.0 {
            value.neg()
        } else {
            value
        }
    }

    /// `z`, but what near or far says of it for points that are on them.
    #[inline(always)]
    pub(crate) fn exact_depth(&self, faces: [usize; 2], z: f64x2) -> f64x2 {
        let (a, b) = self.rows(faces);
        f64x2::new([a.level, b.level]).bitselect(f64x2::new([a.at, b.at]), z)
    }

    /// The same two values' magnitudes, rounded: relative error below u (1 + 1/2)
    /// where the filter is certain.
    #[inline(always)]
    pub(crate) fn magnitudes(&self, faces: [usize; 2], p: Vec3<f64>) -> f64x2 {
        let (g, rest) = self.values(faces, p);
        (g + rest).abs()
    }
}

/// Two frame coordinates of a point, each as a rounded value and a rest.
#[inline(always)]
fn coordinate(pose: &Pose, axes: [usize; 2], p: Vec3<f64>) -> (f64x2, f64x2) {
    let (a, b) = (pose.axes[axes[0]], pose.axes[axes[1]]);
    let o = pose.origin;
    let term = |p: f64, o: f64, a: f64, b: f64| {
        let axis = f64x2::new([a, b]);
        let (c, low) = two_diff(f64x2::splat(p), f64x2::splat(o));
        let (product, rest) = two_prod(axis, c);
        (product, rest + axis * low)
    };
    let (x, x_rest) = term(p.x, o.x, a.x, b.x);
    let (y, y_rest) = term(p.y, o.y, a.y, b.y);
    let (z, z_rest) = term(p.z, o.z, a.z, b.z);
    let (xy, more) = two_sum(x, y);
    let (sum, rest) = two_sum(xy, z);
    two_sum(sum, (rest + more) + ((x_rest + y_rest) + z_rest))
}
