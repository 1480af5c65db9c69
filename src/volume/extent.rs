//! How far a volume reaches along a half space's normal, rounded and exactly.
//!
//! A linear function takes its greatest and its least value over a box at corners:
//! at which ones is known from where the normal points, exactly, so a box's sign is
//! a point's. Over an oriented box and a ball it is the middle's value, more or less a
//! reach: the half axes' inner products with the normal, or the radius times its length.
//!
//! # Rounded
//! In units of u (see [`super::half_space`]), S the sum of the magnitudes of the middle's
//! coordinates, H those of all half axes', r the radius, |n_j| < 1 and so |n| < 1.74:
//! ```text
//! middle    5.01 S + 2.01 |d|
//! reach     oriented box 4.01 H, two sums 2 H;  ball 3 * 1.74 r
//! sum       S + |d| + H, or + 1.74 r
//! ```
//! In all no more than 7.01 (S + H) + 3.01 |d|, or 6.96 (S + r) + 3.01 |d|: below the
//! threshold, 8 and 4, at the size S + H, or S + r.

use super::half_space::{HalfSpace, MOST, size};
use super::shape::{Aabb, Obb, Sphere, Volume};
use super::{Containment, VolumeCounts};
use crate::exact::Number;
use crate::exact::dyadic::Dyadic;
use crate::math::Vec3;
use std::cmp::Ordering;

/// Which end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extreme {
    Least,
    Greatest,
}

/// A volume that a half space is asked about.
pub(super) trait Extent {
    /// What rounding errors are in proportion to.
    fn size(&self) -> f64;

    /// The extreme value, rounded.
    fn value(&self, of: &HalfSpace, extreme: Extreme) -> f64;

    /// Its sign, exactly, where the rounded value leaves it open.
    fn sign_beyond_filter(
        &self,
        of: &HalfSpace,
        extreme: Extreme,
        counts: &mut VolumeCounts,
    ) -> Ordering;

    /// The sign of the extreme value.
    #[inline(always)]
    fn sign(
        &self,
        of: &HalfSpace,
        extreme: Extreme,
        size: f64,
        counts: &mut VolumeCounts,
    ) -> Ordering {
        let value = self.value(of, extreme);
        let threshold = of.threshold(size);
        // The size is as good as infinite where a sum may overflow.
        if value > threshold && size < MOST {
            Ordering::Greater
        } else if value < -threshold && size < MOST {
            Ordering::Less
        } else {
            counts.filter_failures += 1;
            self.sign_beyond_filter(of, extreme, counts)
        }
    }

    /// How it lies to the half space.
    #[inline(always)]
    fn side(&self, of: &HalfSpace, size: f64, counts: &mut VolumeCounts) -> Containment {
        if self.sign(of, Extreme::Greatest, size, counts) == Ordering::Less {
            Containment::Outside
        } else if self.sign(of, Extreme::Least, size, counts) == Ordering::Less {
            Containment::Crossing
        } else {
            Containment::Inside
        }
    }
}

impl Aabb<f64> {
    /// The corner at which a half space's function is extreme.
    #[inline(always)]
    fn corner(&self, of: &HalfSpace, extreme: Extreme) -> Vec3<f64> {
        let pick = |axis: usize| {
            let up = (of.points(axis) == Ordering::Greater) == (extreme == Extreme::Greatest);
            if up { self.max[axis] } else { self.min[axis] }
        };
        Vec3::new(pick(0), pick(1), pick(2))
    }
}

impl Extent for Aabb<f64> {
    #[inline(always)]
    fn size(&self) -> f64 {
        let larger = |axis: usize| self.min[axis].abs().max(self.max[axis].abs());
        larger(0) + larger(1) + larger(2)
    }

    #[inline(always)]
    fn value(&self, of: &HalfSpace, extreme: Extreme) -> f64 {
        of.value(self.corner(of, extreme))
    }

    fn sign_beyond_filter(
        &self,
        of: &HalfSpace,
        extreme: Extreme,
        counts: &mut VolumeCounts,
    ) -> Ordering {
        of.sign_beyond_filter(self.corner(of, extreme), counts)
    }
}

impl Extent for Obb<f64> {
    #[inline(always)]
    fn size(&self) -> f64 {
        let [u, v, n] = self.half_axes.map(size);
        size(self.center) + ((u + v) + n)
    }

    #[inline(always)]
    fn value(&self, of: &HalfSpace, extreme: Extreme) -> f64 {
        let [a, b, c, _] = of.high;
        let along = |h: Vec3<f64>| (a * h.x + b * h.y + c * h.z).abs();
        let [u, v, n] = self.half_axes.map(along);
        let reach = (u + v) + n;
        let middle = of.value(self.center);
        match extreme {
            Extreme::Least => middle - reach,
            Extreme::Greatest => middle + reach,
        }
    }

    #[cold]
    fn sign_beyond_filter(
        &self,
        of: &HalfSpace,
        extreme: Extreme,
        counts: &mut VolumeCounts,
    ) -> Ordering {
        counts.integers += 1;
        let reach = self.half_axes.map(|h| of.along(h).abs());
        let reach = &(&reach[0] + &reach[1]) + &reach[2];
        let middle = of.integer(self.center);
        match extreme {
            Extreme::Least => (&middle - &reach).sign(),
            Extreme::Greatest => (&middle + &reach).sign(),
        }
    }
}

impl Extent for Sphere<f64> {
    #[inline(always)]
    fn size(&self) -> f64 {
        size(self.center) + self.radius
    }

    #[inline(always)]
    fn value(&self, of: &HalfSpace, extreme: Extreme) -> f64 {
        let reach = self.radius * of.length;
        let middle = of.value(self.center);
        match extreme {
            Extreme::Least => middle - reach,
            Extreme::Greatest => middle + reach,
        }
    }

    /// `g + r |n|` has the sign of g where that is not negative, else that of the
    /// difference of squares.
    #[cold]
    fn sign_beyond_filter(
        &self,
        of: &HalfSpace,
        extreme: Extreme,
        counts: &mut VolumeCounts,
    ) -> Ordering {
        counts.integers += 1;
        let middle = of.integer(self.center);
        let radius = Dyadic::from(self.radius);
        let reach = &(&radius * &radius) * &of.square();
        let more = (&(&middle * &middle) - &reach).sign();
        match (extreme, middle.sign()) {
            (Extreme::Greatest, Ordering::Less) => more.reverse(),
            (Extreme::Least, Ordering::Greater) => more,
            (Extreme::Greatest, sign) => sign.max(reach.sign()),
            (Extreme::Least, sign) => sign.min(reach.sign().reverse()),
        }
    }
}

/// Runs what is generic over volumes.
macro_rules! with_extent {
    ($volume:expr, $v:ident => $run:expr) => {
        match $volume {
            Volume::Aabb($v) => $run,
            Volume::Obb($v) => $run,
            Volume::Sphere($v) => $run,
        }
    };
}
pub(super) use with_extent;
