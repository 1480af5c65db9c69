//! How far a matrix's frustum is from the exact clip volume.

use super::integers::{Depth, DepthBound, System};
use super::{ClipSpace, Rows};
use crate::frustum::Frustum;
use crate::frustum::eval::exact_vec::{Dyadic, Rounded, dot, exact};
use crate::math::Vec3;
use std::cmp::Ordering;

/// A frustum from a matrix.
///
/// Two are equal if their frusta and their deviations are.
#[derive(Clone, Debug)]
pub struct MatrixFrustum {
    /// The frustum. Frame `z` is clip `W`: the distance from the eye for the
    /// usual matrices, in any unit otherwise. (Orthographic: clip `Z`.)
    pub frustum: Frustum,
    rows: Rows,
    clip: ClipSpace,
}

impl PartialEq for MatrixFrustum {
    fn eq(&self, other: &Self) -> bool {
        self.frustum == other.frustum && self.deviation() == other.deviation()
    }
}

impl MatrixFrustum {
    pub(super) fn new(frustum: Frustum, rows: Rows, clip: ClipSpace) -> Self {
        Self {
            frustum,
            rows,
            clip,
        }
    }

    /// The frustum's deviation from the exact clip volume. It is computed here, in some microseconds.
    #[must_use]
    pub fn deviation(&self) -> Deviation {
        let (rows, clip) = (&self.rows, self.clip);
        let origin = self.frustum.pose().origin;
        if rows.w == Vec3::default() {
            return parallel(rows, clip, origin);
        }
        match System::new([rows.x, rows.y, rows.w]) {
            Ok(system) => perspective(rows, &Depth::new(rows, &system, clip), &self.frustum),
            // Never: the frustum has been made from it.
            Err(_) => Deviation {
                sides: f64::INFINITY,
                near: f64::INFINITY,
                far: f64::INFINITY,
            },
        }
    }
}

/// The largest deviation of a frustum's vertices from the exact clip volume of
/// its matrix.
///
/// Each number is the exact maximum, rounded up to the next `f64`: an upper
/// bound, and 0 only if there is no deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The deviation of `X / W` and `Y / W` from `+-1`, which rounding of the
    /// eye causes. Infinite if it moves a near vertex to `W <= 0`.
    pub sides: f64,
    /// The deviation of the near vertices from the matrix's near plane, along
    /// `W`, as a fraction of the near distance (orthographic: along `Z`, as a
    /// fraction of the depth). Rounding causes it, and the tilt of that plane.
    pub near: f64,
    /// The same for the far vertices and the far plane, as a fraction of the far
    /// distance (orthographic: of the depth). At 1 and above, rounding of the
    /// matrix's entries has left no usable far plane. For an infinite frustum:
    /// the near distance divided by the least `W` at which the matrix's far
    /// plane, tilted by rounding alone, enters the clip volume; 0 if it does
    /// not.
    pub far: f64,
}

/// The exact value of a row at a point.
fn value(row: Vec3<f64>, constant: f64, p: Vec3<f64>) -> Dyadic {
    &dot(&exact(row), &exact(p)) + &constant.into()
}

fn parallel(rows: &Rows, clip: ClipSpace, origin: Vec3<f64>) -> Deviation {
    let [x, y, z, w] = rows.constants;
    let low = clip.lowest_depth() * w;
    // A vertex is off by the clip coordinates of the rounded origin, which would be 0.
    let residual = |row, constant| value(row, constant, origin).abs();
    let sides = residual(rows.x, x).max(residual(rows.y, y));
    let w = Dyadic::from(w);
    let depth = residual(rows.z, z).ratio_up(&(&w - &low.into()));
    Deviation {
        sides: sides.ratio_up(&w),
        near: depth,
        far: depth,
    }
}

fn perspective(rows: &Rows, depth: &Depth, frustum: &Frustum) -> Deviation {
    let [x, y, z, w] = rows.constants;
    let (origin, near) = (frustum.pose().origin, frustum.shape().near().z);
    // Clip coordinates of the rounded origin, where X, Y and W would be 0.
    let x = value(rows.x, x, origin).abs();
    let y = value(rows.y, y, origin).abs();
    let z = value(rows.z, z, origin);
    let w = value(rows.w, w, origin);
    Deviation {
        sides: sides(x.max(y), &w, near),
        near: depth.displacement(&depth.near, near, &z, &w),
        far: match frustum.shape().far() {
            Some(far) => depth.displacement(&depth.far, far.z, &z, &w),
            None => depth.stray_far_plane(near),
        },
    }
}

impl Depth {
    /// The distance along `W` between a bound's plane and the vertices at
    /// `distance`, as a fraction of it, rounded up. `z` and `w` are the clip
    /// coordinates of the frustum's origin.
    fn displacement(&self, bound: &DepthBound, distance: f64, z: &Dyadic, w: &Dyadic) -> f64 {
        // The vertices are at D (+-1, +-1, 1) in the frame, so the bound's value there is
        // +-c D +- d D + slope D + (its value at the origin). It changes by `slope` along W.
        let distance = Dyadic::from(distance);
        let at_origin = &(z * &bound.z.into()) + &(w * &bound.w.into());
        let middle = &(&bound.slope * &distance) + &(&at_origin * &self.determinant);
        let largest = &(&self.tilt * &distance) + &middle.abs();
        largest.ratio_up(&(&bound.slope.clone().abs() * &distance))
    }

    /// The near distance divided by the least `W` at which a tilted far plane
    /// enters the clip volume, rounded up.
    fn stray_far_plane(&self, near: f64) -> f64 {
        // Along the edges X, Y = +-W the bound is (slope - tilt) W + constant >= 0.
        let excess = &self.tilt - &self.far.slope;
        match excess.order() {
            Ordering::Greater => (&excess * &near.into()).ratio_up(&self.far.constant),
            _ => 0.0,
        }
    }
}

/// [`Deviation::sides`], from the clip coordinates of the rounded origin: the
/// larger of `|X|` and `|Y|`, and `W`.
fn sides(across: Dyadic, w: &Dyadic, near: f64) -> f64 {
    // At a near vertex X is +-near + X_origin and W is near + W_origin, so |X / W -+ 1| is
    // |X_origin -+ W_origin| / W. At a far vertex W is larger.
    let at_vertex = w + &near.into();
    match at_vertex.order() {
        Ordering::Greater => (&across + &w.clone().abs()).ratio_up(&at_vertex),
        _ => f64::INFINITY,
    }
}
