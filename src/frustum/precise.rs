//! Boundary values in double-double: the filter's values (see
//! [`super::filter`]) with a relative error small enough to compute with.
//!
//! All six faces are one formula, `sign (c - at - m (z - z_near))` with c a
//! frame coordinate, so that which face it is costs a look-up and no branch.
//! The rounded value goes straight through; what each of its operations lost
//! is computed beside it, exactly for sums and products, and added at the end.

use super::Shape;
use crate::exact::double_double::Dd;
use crate::exact::float::{Lanes, Two, split, two_diff, two_prod, two_prod_split, two_sum};
use crate::math::{Pose, Vec3};

/// A face.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    /// Which frame coordinate.
    axis: usize,
    at: f64,
    /// The slope by z, with its upper and lower half, and what rounding it lost.
    slope: f64,
    halves: (f64, f64),
    rest: f64,
    sign: f64,
}

/// The six faces, in the order of [`super::Face::ALL`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Precise {
    rows: [Row; 6],
    near: f64,
    /// `None` for the identity.
    pose: Option<Pose>,
}

impl Precise {
    /// From the four sides' slopes by depth.
    pub(super) fn new(pose: &Pose, shape: &Shape, slopes: &[Dd; 4]) -> Self {
        let sigma = shape.direction().sign();
        let near = shape.near();
        let bounds = near.rect.to_array();
        let row = |axis, at, slope: Dd, sign| Row {
            axis,
            at,
            slope: sigma * slope.hi,
            halves: split(sigma * slope.hi),
            rest: sigma * slope.lo,
            sign,
        };
        let side = |i: usize| row(i / 2, bounds[i], slopes[i], [1.0, -1.0][i % 2]);
        let level = Dd::new(0.0, 0.0);
        let far = shape.far().map_or(near.z, |far| far.z);
        Precise {
            rows: [
                row(2, near.z, level, sigma),
                row(2, far, level, -sigma),
                side(0),
                side(1),
                side(2),
                side(3),
            ],
            near: near.z,
            pose: (!pose.is_identity()).then_some(*pose),
        }
    }

    /// A face's values (by number) at two points, each as a rounded value and
    /// a small rest; their exact sum is within 60 u^2 scale of the truth.
    #[inline(always)]
    pub(crate) fn values(&self, face: usize, p: Vec3<f64>, q: Vec3<f64>) -> (Two, Two) {
        let row = &self.rows[face];
        let ends = Vec3::new(Two([p.x, q.x]), Two([p.y, q.y]), Two([p.z, q.z]));
        let ((z, z_low), (c, c_low)) = match &self.pose {
            None => {
                let c = Two([p.to_array()[row.axis], q.to_array()[row.axis]]);
                let none = Two::splat(0.0);
                ((ends.z, none), (c, none))
            }
            Some(pose) => (coordinate(pose, 2, ends), coordinate(pose, row.axis, ends)),
        };
        let all = Two::splat;
        let (w, w_rest) = two_diff(z, all(self.near));
        let halves = (all(row.halves.0), all(row.halves.1));
        let (product, low) = two_prod_split(all(row.slope), halves, w);
        let low = low + (all(row.slope) * (w_rest + z_low) + all(row.rest) * w);
        let (across, more) = two_diff(c, all(row.at));
        let (g, rest) = two_diff(across, product);
        let rest = rest + ((more + c_low) - low);
        (all(row.sign) * g, all(row.sign) * rest)
    }
}

/// A frame coordinate as a rounded value and a rest.
#[inline(always)]
fn coordinate(pose: &Pose, k: usize, p: Vec3<Two>) -> (Two, Two) {
    let all = Two::splat;
    let (o, a) = (pose.origin.to_array(), pose.axes[k].to_array());
    let term = |c: Two, j: usize| {
        let (c, low) = two_diff(c, all(o[j]));
        let (product, rest) = two_prod(all(a[j]), c);
        (product, rest + all(a[j]) * low)
    };
    let (x, x_rest) = term(p.x, 0);
    let (y, y_rest) = term(p.y, 1);
    let (z, z_rest) = term(p.z, 2);
    let (xy, more) = two_sum(x, y);
    let (sum, rest) = two_sum(xy, z);
    let rest = (rest + more) + ((x_rest + y_rest) + z_rest);
    two_sum(sum, rest)
}
