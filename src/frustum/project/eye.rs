//! The eye: where the four sides of a shape converge.
//!
//! A side's bounds have been rounded, so that the sides of a camera's frustum converge at its eye
//! only up to rounding. If they do within [`BOUNDS_ERROR`], the frustum is that of this eye: at
//! frame `z = 0` if that is one such point, as for cameras, matrices and windows of these; otherwise
//! where left and right converge. No decision about points depends on it: it serves matrices and
//! depths.

use crate::exact::dyadic::Dyadic;
use crate::exact::float::exp2;
use crate::frustum::eval::exact_vec::Rounded;
use crate::frustum::{EndRect, Shape};
use std::cmp::Ordering;

/// Error of a bound as a fraction of the largest one across the same axis: 8 u. Cameras' bounds
/// have 4 u at most, windows' 1 u.
const BOUNDS_ERROR: f64 = exp2(-50);

/// The kind of projection that a shape is the view of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Eye {
    /// Sides converge at a point; the distances of near and, if there is one, far from it along the depth.
    Central { near: f64, far: Option<f64> },
    /// Sides are parallel; whether there is a far end.
    Parallel { is_finite: bool },
    /// Left and right converge at another depth than bottom and top, or behind far.
    None { is_finite: bool },
}

/// Widths across an axis, and the largest bounds, at near and at far (without far: by unit of depth).
struct Widths {
    near: Dyadic,
    far: Dyadic,
    near_bound: Dyadic,
    far_bound: Dyadic,
}

impl Widths {
    fn of(shape: &Shape) -> [Self; 2] {
        let near = shape.near().rect.to_array();
        let far = match shape {
            Shape::Finite { far, .. } => far.rect,
            Shape::Infinite { slopes, .. } => *slopes,
        };
        let far = far.to_array();
        let width = |r: [f64; 4], i: usize| &Dyadic::from(r[i + 1]) - &Dyadic::from(r[i]);
        let bound = |r: [f64; 4], i: usize| r[i].abs().max(r[i + 1].abs()).into();
        [0, 2].map(|i| Self {
            near: width(near, i),
            far: width(far, i),
            near_bound: bound(near, i),
            far_bound: bound(far, i),
        })
    }

    /// Whether these widths are in the ratio of two distances, up to the rounding of bounds.
    fn are_as(&self, near: &Dyadic, far: &Dyadic) -> bool {
        let difference = &(&self.near * far) - &(&self.far * near);
        let bounds = &(&self.near_bound * far) + &(&self.far_bound * near);
        (&difference.abs() - &(&bounds * &BOUNDS_ERROR.into())).order() != Ordering::Greater
    }
}

impl Eye {
    pub(super) fn of(shape: &Shape) -> Self {
        let widths = Widths::of(shape);
        match *shape {
            Shape::Finite { near, far } => Self::of_finite(&widths, near, far),
            Shape::Infinite {
                near, direction, ..
            } => Self::of_infinite(&widths, direction.sign() * near.z),
        }
    }

    fn of_finite(widths: &[Widths; 2], near: EndRect, far: EndRect) -> Self {
        if widths
            .iter()
            .all(|w| (&w.far - &w.near).order() == Ordering::Equal)
        {
            return Self::Parallel { is_finite: true };
        }
        let sigma = (far.z - near.z).signum();
        let (n, f) = (sigma * near.z, sigma * far.z);
        let are_as = |n: &Dyadic, f: &Dyadic| widths.iter().all(|w| w.are_as(n, f));
        if n >= 0.0 && are_as(&n.into(), &f.into()) {
            return Self::Central {
                near: n + 0.0,
                far: Some(f),
            };
        }
        let none = Self::None { is_finite: true };
        let x = &widths[0];
        let growth = &x.far - &x.near;
        if growth.order() != Ordering::Greater || !are_as(&x.near, &x.far) {
            return none;
        }
        let depth = (&Dyadic::from(far.z) - &Dyadic::from(near.z)).abs();
        let [n, f] = [&x.near, &x.far].map(|w| (w * &depth).ratio(&growth));
        if f.is_finite() {
            Self::Central {
                near: n,
                far: Some(f),
            }
        } else {
            none
        }
    }

    /// For the distance of near from frame `z = 0` along the depth.
    fn of_infinite(widths: &[Widths; 2], near: f64) -> Self {
        if widths.iter().all(|w| w.far.order() == Ordering::Equal) {
            return Self::Parallel { is_finite: false };
        }
        let are_as = |n: &Dyadic, f: &Dyadic| widths.iter().all(|w| w.are_as(n, f));
        if near >= 0.0 && are_as(&near.into(), &1.0.into()) {
            return Self::Central {
                near: near + 0.0,
                far: None,
            };
        }
        let none = Self::None { is_finite: false };
        let x = &widths[0];
        if x.far.order() != Ordering::Greater || !are_as(&x.near, &x.far) {
            return none;
        }
        let near = x.near.ratio(&x.far);
        if near.is_finite() {
            Self::Central { near, far: None }
        } else {
            none
        }
    }

    /// Two values in the ratio of a depth's distances from those of near and far, and their sum,
    /// from the values of near and far and their sum `depth` (without far: any number).
    #[inline(always)]
    pub(super) fn depths(self, [near, far]: [f64; 2], depth: f64) -> ([f64; 2], f64) {
        let is_between = near >= 0.0 && far >= 0.0;
        match self {
            Self::Central {
                near: n,
                far: Some(f),
            } => {
                let ratio = n / f;
                let (a, b) = (near, far * ratio);
                // Far outside the sum of the two would cancel.
                let sum = near * ((f - n) / f) + depth * ratio;
                ([a, b], if is_between { a + b } else { sum })
            }
            Self::Central { near: n, far: None } => ([near, n], near + n),
            Self::Parallel { is_finite: true } | Self::None { is_finite: true } => {
                let sum = if is_between { near + far } else { depth };
                ([near, far], sum)
            }
            _ => ([0.0, 1.0], 1.0),
        }
    }

    /// The values of near and far, up to a factor, from what [`Eye::depths`] gives. Without far:
    /// the value of near and 1.
    pub(super) fn distances(self, [low, high]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Central {
                near: n,
                far: Some(f),
            } => [low * (n / f), high],
            Self::Central { near: n, far: None } => [n * low, high],
            _ => [low, high],
        }
    }
}
