//! The boundary functions as polynomials over any exact number type.
//!
//! `f_i(p) >= 0` for each of the faces i means that p is in the frustum; `f_i`
//! vanishes on the face's plane. With frame coordinates `x_k = a_k . (p - o)`,
//! s = 1 or -1 the direction of depth, D = z_far - z_near, and a side's bound
//! going from n at the near to f at the far end:
//!
//! ```text
//! near    s (z - z_near)              far    s (z_far - z)
//! low     s [(x - n) D - (f - n)(z - z_near)]     high   the negative of it
//! ```
//!
//! A side without slope (f = n) is `x - n`; an infinite frustum's side with slope
//! m is `x - n - m s (z - z_near)`. The form of a face is the same at all points, so
//! that ratios of its values at two points are ratios of distances.

use crate::exact::Number;
use crate::frustum::{Face, Frustum, Shape};
use crate::math::{Pose, Vec3};

/// The frame coordinate `axes[k] . (p - origin)`.
fn frame_coordinate<N: Number>(pose: &Pose, k: usize, p: Vec3<f64>) -> Result<N, N::Overflow> {
    let mut sum: Option<N> = None;
    for j in 0..3 {
        let axis = pose.axes[k][j];
        if axis == 0.0 {
            continue;
        }
        let c = N::difference(p[j], pose.origin[j]);
        let term = if axis == 1.0 {
            c
        } else {
            c.mul(&N::from_f64(axis))?
        };
        sum = Some(match sum {
            None => term,
            Some(sum) => sum.add(&term)?,
        });
    }
    Ok(sum.unwrap_or_else(|| N::from_f64(0.0)))
}

/// The exact value of a face's boundary function, or an error if it overflows `N`. For the
/// far face of an infinite frustum it is 1.
pub(crate) fn boundary<N: Number>(
    frustum: &Frustum,
    face: Face,
    p: Vec3<f64>,
) -> Result<N, N::Overflow> {
    boundary_in(frustum.pose(), frustum.shape(), face, p)
}

/// As [`boundary`], of a frustum with this pose and shape.
pub(crate) fn boundary_in<N: Number>(
    pose: &Pose,
    shape: &Shape,
    face: Face,
    p: Vec3<f64>,
) -> Result<N, N::Overflow> {
    let near = shape.near();
    let flip = shape.direction().sign() < 0.0;
    let signed = |v: N, negative: bool| if negative { v.neg() } else { v };
    let z = || frame_coordinate::<N>(pose, 2, p);
    let (axis, side) = match face {
        Face::Near => return Ok(signed(z()?.add(&N::from_f64(-near.z))?, flip)),
        Face::Far => {
            let Some(far) = shape.far() else {
                return Ok(N::from_f64(1.0));
            };
            return Ok(signed(z()?.add(&N::from_f64(-far.z))?, !flip));
        }
        Face::Left => (0, 0),
        Face::Right => (0, 1),
        Face::Bottom => (1, 2),
        Face::Top => (1, 3),
    };
    let n = near.rect.to_array()[side];
    let across = frame_coordinate::<N>(pose, axis, p)?.add(&N::from_f64(-n))?;
    let low = match shape {
        Shape::Finite { far, .. } => {
            let f = far.rect.to_array()[side];
            if f == n {
                across
            } else {
                let depth = z()?.add(&N::from_f64(-near.z))?;
                let shift = N::difference(f, n).mul(&depth)?;
                let across = across.mul(&N::difference(far.z, near.z))?;
                signed(across.sub(shift)?, flip)
            }
        }
        Shape::Infinite { slopes, .. } => {
            let slope = slopes.to_array()[side];
            if slope == 0.0 {
                across
            } else {
                let depth = z()?.add(&N::from_f64(-near.z))?;
                let shift = depth.mul(&N::from_f64(if flip { -slope } else { slope }))?;
                across.sub(shift)?
            }
        }
    };
    Ok(signed(low, side % 2 == 1))
}
