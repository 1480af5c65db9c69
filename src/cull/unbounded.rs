//! Boxes without bounds in some directions, and the empty box.
//!
//! A box's sides may be infinite: it is then the closed set of the points between them, which has
//! no corner there. A linear function's extreme over it is infinite if its coefficient in such a
//! direction is not zero; else it does not depend on that coordinate. So all questions have the same
//! answers as for a box of growing sides, in the limit, and are decided exactly from the signs of
//! the coefficients and the values at finite corners.
//!
//! The separating axes of two polyhedra are the same without bounds: normals of faces, and products
//! of edges. The difference of frustum and box is still a closed polyhedron with an interior.
//!
//! Such boxes are rare: none of this is in the way of others.

use super::support::Extreme;
use super::volume::{Aabb, Volume};
use super::{Containment, VolumeCounts};
use crate::frustum::eval::half_space::HalfSpace;
use crate::math::Vec3;
use std::cmp::Ordering;

/// A valid box that is not finite.
#[derive(Clone, Copy, Debug)]
pub(super) enum Unbounded {
    Empty,
    Sides(Aabb<f64>),
}

impl Unbounded {
    /// `None` for a finite volume. Precondition: the volume is valid.
    #[inline]
    pub(super) fn of(volume: &Volume) -> Option<Self> {
        match volume {
            Volume::Aabb(v) if !v.min.is_finite() || !v.max.is_finite() => Some(if v.is_empty() {
                Self::Empty
            } else {
                Self::Sides(*v)
            }),
            _ => None,
        }
    }

    /// Where it is relative to a half space.
    pub(super) fn side(&self, of: &HalfSpace, counts: &mut VolumeCounts) -> Containment {
        let Self::Sides(v) = self else {
            return Containment::Outside;
        };
        let mut is_negative = |extreme| {
            corner(v, of, extreme).map(|corner| {
                counts.filter_failures += 1;
                let (sign, stage) = of.sign_beyond_filter(corner);
                counts.add_stage(stage);
                sign == Ordering::Less
            })
        };
        // No corner: the extreme is infinite.
        if is_negative(Extreme::Greatest).unwrap_or(false) {
            Containment::Outside
        } else if is_negative(Extreme::Least).unwrap_or(true) {
            Containment::Crossing
        } else {
            Containment::Inside
        }
    }

    /// The class by some half spaces: those of a frustum's faces.
    #[cold]
    pub(super) fn classify(
        &self,
        half_spaces: &[HalfSpace],
        counts: &mut VolumeCounts,
    ) -> Containment {
        // An empty box has no half space to be outside of where there is none.
        let sides = half_spaces.iter().map(|h| self.side(h, counts));
        sides.min().unwrap_or(Containment::Outside)
    }
}

/// The corner at which a half space's function is extreme; `None` if it has none.
fn corner(v: &Aabb<f64>, of: &HalfSpace, extreme: Extreme) -> Option<Vec3<f64>> {
    let mut corner = [0.0; 3];
    for (axis, to) in corner.iter_mut().enumerate() {
        let towards_max = match of.direction(axis) {
            // Any coordinate will do.
            Ordering::Equal => continue,
            direction => direction.is_gt() == (extreme == Extreme::Greatest),
        };
        *to = if towards_max {
            v.max[axis]
        } else {
            v.min[axis]
        };
    }
    let corner = Vec3::from(corner);
    corner.is_finite().then_some(corner)
}
