//! How far a volume reaches along a half space's normal, rounded and exactly.
//!
//! A linear function's extremes over a volume are its value at the middle plus and minus a
//! reach: half extents times magnitudes of the normal's components, or half axes' inner products
//! with the normal, or the radius times the normal's length. Where rounding leaves a sign open, a
//! box's extreme is the value at a corner, which is a point; which corner it is follows, exactly,
//! from the signs of the normal's components.
//!
//! # Rounded
//! In units of u (see [`crate::frustum::eval::half_space`]), with S the sum of the magnitudes of
//! the middle's coordinates, H that of the half extents or of all half axes' coordinates, r the
//! radius, |n_j| < 1 and so |n| < 1.74:
//! ```text
//! middle    4.01 S + 3.01 |d|; of a box 1 S more, since it is rounded itself
//! reach     box: extent 1, component 1, product 1, sums 2: 5.01 H; oriented box: 4.01 H,
//!           two sums 2 H; sphere: 3 * 1.74 r
//! sum       S + |d| + H, or + 1.74 r
//! ```
//! In all no more than 7.01 (S + H) + 4.01 |d|, or 6.96 (S + r) + 4.01 |d|: below the threshold
//! of 8 each, at the size S + H, or S + r.

use super::volume::{Aabb, Obb, Sphere};
use super::{Containment, VolumeCounts};
use crate::exact::Number;
use crate::exact::dyadic::Dyadic;
use crate::exact::float::Lanes;
use crate::frustum::eval::half_space::{HalfSpace, size, value};
use crate::math::Vec3;
use std::cmp::Ordering;

/// Which end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extreme {
    Least,
    Greatest,
}

/// A volume whose extremes along a normal can be computed.
pub(super) trait Extent {
    /// The form of the volume that is computed once for all half spaces.
    type Middle;

    /// Computes that form.
    fn middle(&self) -> Self::Middle;

    /// The size that rounding errors are relative to.
    fn size(middle: &Self::Middle) -> f64;

    /// Whether the volume is valid if its components are finite.
    fn is_ordered(&self) -> bool;

    /// The least and the greatest value of half spaces with these coefficients, rounded.
    fn values<F: Lanes>(middle: &Self::Middle, coefficients: [F; 4], length: F) -> [F; 2];

    /// The exact sign of an extreme value whose rounded value leaves it open.
    fn sign_beyond_filter(
        &self,
        of: &HalfSpace,
        extreme: Extreme,
        counts: &mut VolumeCounts,
    ) -> Ordering;

    /// The position of the volume relative to the half space.
    #[inline(always)]
    fn side(
        &self,
        middle: &Self::Middle,
        size: f64,
        of: &HalfSpace,
        counts: &mut VolumeCounts,
    ) -> Containment {
        let [least, greatest] = Self::values(middle, of.rounded(), of.length());
        let threshold = of.threshold(size);
        if self.is_negative(greatest, threshold, of, Extreme::Greatest, counts) {
            Containment::Outside
        } else if self.is_negative(least, threshold, of, Extreme::Least, counts) {
            Containment::Crossing
        } else {
            Containment::Inside
        }
    }

    /// Whether all of the volume is outside the half space.
    fn is_outside(
        &self,
        middle: &Self::Middle,
        size: f64,
        of: &HalfSpace,
        counts: &mut VolumeCounts,
    ) -> bool {
        let [_, greatest] = Self::values(middle, of.rounded(), of.length());
        self.is_negative(greatest, of.threshold(size), of, Extreme::Greatest, counts)
    }

    /// Whether an extreme value is negative; `value` is the rounded one.
    #[inline(always)]
    fn is_negative(
        &self,
        value: f64,
        threshold: f64,
        of: &HalfSpace,
        extreme: Extreme,
        counts: &mut VolumeCounts,
    ) -> bool {
        if value > threshold {
            return false;
        }
        value < -threshold || {
            counts.filter_failures += 1;
            self.sign_beyond_filter(of, extreme, counts) == Ordering::Less
        }
    }
}

/// A middle value minus and plus a reach.
#[inline(always)]
fn around<F: Lanes>(middle: F, reach: F) -> [F; 2] {
    [middle - reach, middle + reach]
}

/// A box's middle and half extents.
pub(super) struct Centred {
    pub(super) center: Vec3<f64>,
    pub(super) half: Vec3<f64>,
}

impl Aabb<f64> {
    /// The corner at which a half space's function is extreme.
    #[inline(always)]
    fn corner(&self, of: &HalfSpace, extreme: Extreme) -> Vec3<f64> {
        let pick = |axis: usize| {
            let up = of.points_up(axis) == (extreme == Extreme::Greatest);
            if up { self.max[axis] } else { self.min[axis] }
        };
        Vec3::new(pick(0), pick(1), pick(2))
    }
}

impl Extent for Aabb<f64> {
    type Middle = Centred;

    #[inline(always)]
    fn middle(&self) -> Centred {
        Centred {
            center: (self.min + self.max) * 0.5,
            half: (self.max - self.min) * 0.5,
        }
    }

    #[inline(always)]
    fn size(Centred { center, half }: &Centred) -> f64 {
        size(*center) + size(*half)
    }

    #[inline(always)]
    fn is_ordered(&self) -> bool {
        let (a, b) = (self.min, self.max);
        (a.x <= b.x) & (a.y <= b.y) & (a.z <= b.z)
    }

    #[inline(always)]
    fn values<F: Lanes>(Centred { center, half }: &Centred, n: [F; 4], _: F) -> [F; 2] {
        let [a, b, c, _] = n;
        let reach =
            a.abs() * a.splat(half.x) + b.abs() * a.splat(half.y) + c.abs() * a.splat(half.z);
        around(value(n, *center), reach)
    }

    fn sign_beyond_filter(
        &self,
        of: &HalfSpace,
        extreme: Extreme,
        counts: &mut VolumeCounts,
    ) -> Ordering {
        let (sign, stage) = of.sign_beyond_filter(self.corner(of, extreme));
        counts.add_stage(stage);
        sign
    }
}

impl Extent for Obb<f64> {
    type Middle = Obb<f64>;

    #[inline(always)]
    fn middle(&self) -> Obb<f64> {
        *self
    }

    #[inline(always)]
    fn size(middle: &Obb<f64>) -> f64 {
        let [u, v, n] = &middle.half_axes;
        size(middle.center) + ((size(*u) + size(*v)) + size(*n))
    }

    #[inline(always)]
    fn is_ordered(&self) -> bool {
        true
    }

    #[inline(always)]
    fn values<F: Lanes>(middle: &Obb<f64>, n: [F; 4], _: F) -> [F; 2] {
        let [a, b, c, _] = n;
        let along = |h: &Vec3<f64>| (a * a.splat(h.x) + b * a.splat(h.y) + c * a.splat(h.z)).abs();
        let [u, v, w] = &middle.half_axes;
        around(value(n, middle.center), (along(u) + along(v)) + along(w))
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
    type Middle = Sphere<f64>;

    #[inline(always)]
    fn middle(&self) -> Sphere<f64> {
        *self
    }

    #[inline(always)]
    fn size(middle: &Sphere<f64>) -> f64 {
        size(middle.center) + middle.radius
    }

    #[inline(always)]
    fn is_ordered(&self) -> bool {
        self.radius >= 0.0
    }

    #[inline(always)]
    fn values<F: Lanes>(middle: &Sphere<f64>, n: [F; 4], length: F) -> [F; 2] {
        around(
            value(n, middle.center),
            length * length.splat(middle.radius),
        )
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

/// Runs code that is generic over [`Extent`].
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
