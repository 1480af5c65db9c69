//! The floating-point filter: boundary values in `f64` with a bound on their error, from
//! constants prepared once per frustum.
//!
//! # Values
//! In the frame, with w = s (z - z_near) the depth, a side's bound is
//! `n + m w`, m = (f - n) / |D| its slope per unit of depth (see
//! [`boundary`](super::boundary) for the letters), and the values are
//! `g = x - (n + m w)` and `(n + m w) - x`: the boundary functions divided by
//! |D| > 0, so with the same signs and the same crossing parameters.
//!
//! # The error bound
//! u = 2^-53. Let S = sum_j |p_j - o_j| (rounded), A_k the largest magnitude
//! in axis k, and *scale* = |n| + |m| |z_near| + (A_x + |m| A_z) S.
//! Rounding: p_j - o_j has relative error u, a frame coordinate
//! `fl(a.c)` is within 4.01 u A S of the exact one; z - z_near adds
//! u (|z| + |z_near|), the rounded slope u, the product u, the two sums
//! u (|n| + |m w|) and u |g|. In total
//! |g~ - g| <= 9.2 u scale, plus underflow, which [`UNDERFLOW_ERROR`] covers.
//! With the identity pose it is 5.1 u scale. `proofs/filter.gappa` proves both.
//!
//! The double-double values of [`precise`](super::precise) are within 47.2 u^2 scale, as derived
//! there. The code assumes 60.
//!
//! The *threshold* is T = 2^-46 scale + UNDERFLOW_ERROR = 128 u scale + UNDERFLOW_ERROR. So
//! |g~| > T means:
//! - the sign of g~ is the sign of g, with a factor of 13 to spare;
//! - the double-double value has a relative error below u / 2: 47.2 u^2 of
//!   (128 - 9.2) u, where 60 would be 0.505 u (`proofs/threshold.gappa`).
//!
//! T is evaluated as `const + factor * S`, its rounding covered by that factor.
//! The comparison is written with `>`, so that NaN and infinity fail it.

use crate::exact::double_double::Dd;
use crate::exact::expansion::in_safe_range;
use crate::exact::float::{Lanes, exp2, exponent_above, lowest_bit, two_diff, two_prod};
use crate::frustum::eval::plain::{Form, General, Layout, Term};
use crate::frustum::eval::precise::Precise;
use crate::frustum::{Face, Frustum, Shape};
use crate::math::{Pose, Segment, Vec3};
use std::cmp::Ordering;
use wide::f64x2;

/// 128 u: the threshold as a fraction of the scale.
const THRESHOLD_PER_SCALE: f64 = exp2(-46);
/// u: more than the error of a normalised double-double value as a fraction of the
/// threshold, which is 60 u^2 of (128 u) at most, less than u / 2.
pub(crate) const DOUBLE_DOUBLE_ERROR_PER_THRESHOLD: f64 = exp2(-53);
/// More than the error that underflow causes: each of a few products loses at most 2^-1075,
/// and no more than a slope below 2^200 ([`Filter::in_range`]) multiplies it afterwards.
pub(crate) const UNDERFLOW_ERROR: f64 = exp2(-500);
/// The far value of an infinite frustum: positive everywhere, so never crossed.
pub(crate) const NO_FAR: f64 = 1e300;

/// Constants prepared for a frustum.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Filter {
    pub(crate) identity: bool,
    pub(crate) form: Form,
    /// The direction of depth, 1 or -1.
    sigma: f64,
    pub(crate) near: f64,
    pub(crate) far: f64,
    /// left, right, bottom, top at the near end.
    at_near: [f64; 4],
    /// Change of the four bounds for a unit of depth.
    slope: [f64; 4],
    origin: Vec3<f64>,
    axes: [Vec3<f64>; 3],
    /// Thresholds: `side.0 + side.1 * S`.
    side: (f64, f64),
    depth: (f64, f64),
    /// S must be below this; 0 if the filter does not apply at all.
    limit: f64,
    lattice: Option<Lattice>,
    /// The constants of the values to 106 bits.
    pub(crate) precise: Precise,
    /// Whether all numbers of the frustum are in the range of expansions.
    pub(crate) expansions: bool,
}

/// Coordinates for which plain arithmetic is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lattice {
    /// `(v + round) - round == v` exactly if v is a multiple of the unit.
    round: f64,
    /// S must be below this.
    limit: f64,
}

/// The six boundary values at a point, rounded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Values {
    /// (near, far), (left, right), (bottom, top).
    pub(crate) pairs: [f64x2; 3],
    /// S, the size of the point in the error bound.
    pub(crate) size: f64,
}

impl Values {
    /// A face's value, by index in the order of [`Face::ALL`].
    #[inline(always)]
    pub(crate) fn of(&self, face: usize) -> f64 {
        self.pairs[face / 2].to_array()[face % 2]
    }
}

/// A distance for segments whose coordinates' magnitudes have a sum S below the limit:
/// `constant + factor * S`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beyond {
    pub(crate) constant: f64,
    pub(crate) factor: f64,
    pub(crate) limit: f64,
}

impl Filter {
    /// The values at a point.
    pub(crate) fn values(&self, p: Vec3<f64>) -> Values {
        self.values_of(&Segment::new(p, p))[0]
    }

    /// The values at both ends of a segment.
    pub(crate) fn values_of(&self, segment: &Segment<f64>) -> [Values; 2] {
        if matches!(self.form, Form::Infinite | Form::InfiniteSymmetric) {
            self.values_in::<General<false>>(segment)
        } else {
            self.values_in::<General<true>>(segment)
        }
    }

    /// The values at both ends by the operations that the layout needs, with the same
    /// bits as in any other layout, in the order that the error bound assumes.
    #[inline(always)]
    pub(crate) fn values_in<L: Layout>(&self, segment: &Segment<f64>) -> [Values; 2] {
        let Segment { start, end } = segment;
        let p = Vec3::new(
            f64x2::new([start.x, end.x]),
            f64x2::new([start.y, end.y]),
            f64x2::new([start.z, end.z]),
        );
        let ([near, far, left, right, bottom, top], size) = self.values_at::<L, _>(p);
        let depths = f64x2::transpose([near, far]);
        let widths = f64x2::transpose([left, right]);
        let heights = f64x2::transpose([bottom, top]);
        let size = size.to_array();
        let values = |i: usize| Values {
            pairs: [depths[i], widths[i], heights[i]],
            size: size[i],
        };
        [values(0), values(1)]
    }

    /// The six values in the order of [`Face::ALL`], and S, for points side by side.
    #[inline(always)]
    pub(crate) fn values_at<L: Layout, F: Lanes + Term>(&self, p: Vec3<F>) -> ([F; 6], F) {
        let splat = |v: f64| p.x.splat(v);
        let (q, size) = self.frame(p);
        let sigma = splat(self.sigma);
        let depth = sigma * (q.z - splat(self.near));
        let far = if L::FAR {
            sigma * (splat(self.far) - q.z)
        } else {
            splat(NO_FAR)
        };
        let (bounds, slopes) = (self.at_near.map(splat), self.slope.map(splat));
        let [left, right] = L::sides(&bounds, &slopes, 0, depth, q.x);
        let [bottom, top] = L::sides(&bounds, &slopes, 2, depth, q.y);
        ([depth, far, left, right, bottom, top], size)
    }

    /// Rounded frame coordinates, and S.
    #[inline(always)]
    fn frame<F: Lanes>(&self, p: Vec3<F>) -> (Vec3<F>, F) {
        if self.identity {
            return (p, size(p));
        }
        let splat = |v: f64| p.x.splat(v);
        let o = self.origin;
        let c = Vec3::new(p.x - splat(o.x), p.y - splat(o.y), p.z - splat(o.z));
        let [x, y, z] = self.axes;
        (Vec3::new(dot(x, c), dot(y, c), dot(z, c)), size(c))
    }

    /// Whether the bound holds for points of this size. False for NaN.
    #[inline(always)]
    pub(crate) fn covers(&self, size: f64) -> bool {
        size < self.limit
    }

    /// The bound holds for sizes less than this.
    pub(crate) fn limit(&self) -> f64 {
        self.limit
    }

    /// The threshold of the four sides at a point of this size.
    #[inline(always)]
    fn side_threshold<F: Lanes>(&self, size: F) -> F {
        size.splat(self.side.0) + size.splat(self.side.1) * size
    }

    /// The threshold of near and far.
    #[inline(always)]
    fn depth_threshold<F: Lanes>(&self, size: F) -> F {
        size.splat(self.depth.0) + size.splat(self.depth.1) * size
    }

    /// The thresholds of the four sides, and of near and far, at a point of this size.
    #[inline(always)]
    pub(crate) fn thresholds(&self, size: f64) -> (f64, f64) {
        (self.side_threshold(size), self.depth_threshold(size))
    }

    /// The thresholds of depth and sides that certify crossing parameters. With
    /// the identity pose, near and far values are differences of two coordinates:
    /// their relative error is u, and only their reciprocals must be finite.
    #[inline(always)]
    pub(crate) fn crossing_thresholds<F: Lanes>(&self, size: F) -> (F, F) {
        let depth = if self.identity {
            size.splat(UNDERFLOW_ERROR)
        } else {
            self.depth_threshold(size)
        };
        (depth, self.side_threshold(size))
    }

    /// The distance from a face beyond which this filter is certain of both ends of a segment,
    /// in units of the largest magnitude in the face's normal (see
    /// `clip/many/intervals/frustum_lanes.rs`).
    pub(crate) fn certain_beyond(&self) -> Beyond {
        let never = Beyond {
            constant: f64::INFINITY,
            factor: 0.0,
            limit: 0.0,
        };
        let away = 2.0 * size(self.origin);
        let limit = self.limit / 2.0 - away;
        // The largest coordinate of the rounded normal, minus its largest rounding error.
        let largest = |across: Vec3<f64>, slope: f64| {
            let coordinate = |j: usize| {
                let (a, b) = (across[j], slope * self.axes[2][j]);
                (a - self.sigma * b).abs() - 2.0 * f64::EPSILON * (a.abs() + b.abs())
            };
            coordinate(0).max(coordinate(1)).max(coordinate(2))
        };
        let [x, y, z] = self.axes;
        let across = [x, x, y, y];
        let side = (0..4).map(|i| largest(across[i], self.slope[i]));
        let side = side.fold(f64::INFINITY, f64::min);
        let depth = z.x.abs().max(z.y.abs()).max(z.z.abs());
        if !(side > 0.0 && depth > 0.0 && limit > 0.0) {
            return never;
        }
        // A rounded value is off by less than a tenth of its threshold, so 1.25 covers it.
        let part = |(constant, factor): (f64, f64), normal: f64| {
            let scale = 1.25 / normal;
            ((constant + factor * away) * scale, factor * scale)
        };
        let (side, depth) = (part(self.side, side), part(self.depth, depth));
        Beyond {
            constant: side.0.max(depth.0),
            factor: side.1.max(depth.1),
            limit,
        }
    }

    /// A face's threshold.
    #[inline(always)]
    pub(crate) fn threshold(&self, face: Face, size: f64) -> f64 {
        match face {
            Face::Near | Face::Far => self.depth_threshold(size),
            _ => self.side_threshold(size),
        }
    }

    /// The sign of a boundary function, if the rounded value decides it. With the
    /// identity pose the difference of two coordinates has the exact sign.
    #[inline(always)]
    pub(crate) fn sign(&self, face: Face, values: &Values) -> Option<Ordering> {
        let g = values.of(face as usize);
        if !self.covers(values.size) {
            return None;
        }
        if self.identity && matches!(face, Face::Near | Face::Far) {
            return g.partial_cmp(&0.0);
        }
        let t = self.threshold(face, values.size);
        if g > t {
            Some(Ordering::Greater)
        } else if g < -t {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    /// The sign by double-double values; `None` only for the smallest distances.
    pub(crate) fn precise_sign(
        &self,
        face: Face,
        p: Vec3<f64>,
        values: &Values,
    ) -> Option<Ordering> {
        if !self.covers(values.size) {
            return None;
        }
        let value = self.precise.value(face as usize, p).hi;
        let certain =
            value.abs() > DOUBLE_DOUBLE_ERROR_PER_THRESHOLD * self.threshold(face, values.size);
        if certain {
            value.partial_cmp(&0.0)
        } else {
            None
        }
    }

    /// Whether all values at both ends are exact, and products of two of them, too: see
    /// [`Lattice`].
    #[inline(always)]
    pub(crate) fn on_lattice(&self, segment: &Segment<f64>, p: &Values, q: &Values) -> bool {
        let Some(lattice) = self.lattice else {
            return false;
        };
        let round = f64x2::splat(lattice.round);
        let on = |p: f64, q: f64| {
            let v = f64x2::new([p, q]);
            ((v + round) - round).simd_eq(v)
        };
        let Segment { start, end } = segment;
        let all = on(start.x, end.x) & on(start.y, end.y) & on(start.z, end.z);
        all.all() & (p.size < lattice.limit) & (q.size < lattice.limit)
    }

    /// The lattice's rounding constant and limit of size, if there is one: see
    /// [`Filter::on_lattice`].
    pub(crate) fn lattice(&self) -> Option<(f64, f64)> {
        self.lattice.map(|lattice| (lattice.round, lattice.limit))
    }

    /// A cheap necessary condition: false for nearly all points off the lattice.
    #[inline(always)]
    pub(crate) fn may_be_lattice(&self, p: Vec3<f64>) -> bool {
        let Some(lattice) = self.lattice else {
            return false;
        };
        let round = f64x2::splat(lattice.round);
        let v = f64x2::new([p.x, p.y]);
        ((v + round) - round).simd_eq(v).all()
    }

    /// Prepares the constants of a valid frustum.
    pub(crate) fn new(pose: &Pose, shape: &Shape) -> Self {
        let near = shape.near();
        let far = shape.far();
        let sigma = shape.direction().sign();
        let slopes = slopes(shape);
        let identity = pose.is_identity();
        let mut filter = Filter {
            identity,
            form: Form::of(shape),
            sigma,
            // Never minus zero: a hit takes its coordinate from here.
            near: near.z + 0.0,
            far: far.map_or(near.z, |far| far.z) + 0.0,
            at_near: near.rect.to_array(),
            slope: slopes.map(|s| s.hi),
            origin: pose.origin,
            axes: pose.axes,
            side: (0.0, 0.0),
            depth: (0.0, 0.0),
            limit: 0.0,
            lattice: None,
            precise: Precise::new(pose, shape, &slopes),
            expansions: fits_expansions(pose, shape),
        };
        filter.prepare_thresholds();
        filter.lattice = filter.find_lattice(shape, &slopes);
        filter
    }

    /// The largest magnitude in each axis.
    fn axis_sizes(&self) -> [f64; 3] {
        self.axes.map(|a| a.x.abs().max(a.y.abs()).max(a.z.abs()))
    }

    fn prepare_thresholds(&mut self) {
        if !self.in_range() {
            return;
        }
        let [x, y, z] = self.axis_sizes();
        let mut constant = 0.0_f64;
        let mut factor = 0.0_f64;
        for i in 0..4 {
            let slope = self.slope[i].abs();
            constant = constant.max(self.at_near[i].abs() + slope * self.near.abs());
            factor = factor.max(if i < 2 { x } else { y } + slope * z);
        }
        let terms = |constant: f64, factor: f64| {
            let constant = THRESHOLD_PER_SCALE * constant + UNDERFLOW_ERROR;
            (constant, THRESHOLD_PER_SCALE * factor)
        };
        self.side = terms(constant, factor);
        let reach = self.near.abs().max(self.far.abs());
        self.depth = terms(reach, z);
        // Below this limit the part of a value that depends on the point is less than
        // 2^480. A face with values of both signs then has no value of 2^482 or more, so
        // products of two do not overflow, nor do the halves of any operand. A face far
        // from all such points may have values up to 2^602, but all of one sign, and they
        // are not multiplied.
        self.limit = exp2(480) / factor.max(z).max(1.0);
    }

    /// Whether every constant is in the range that the error analysis assumes:
    /// zero, or of a magnitude at which products neither overflow nor lose
    /// more than [`UNDERFLOW_ERROR`].
    fn in_range(&self) -> bool {
        let within =
            |v: f64, low: i32, high: i32| v == 0.0 || (v.abs() > exp2(low) && v.abs() < exp2(high));
        let depth = self.far - self.near;
        within(self.near, -400, 400)
            && within(self.far, -400, 400)
            && within(depth, -400, 400)
            && self.at_near.iter().all(|&v| within(v, -400, 400))
            && self.slope.iter().all(|&v| within(v, -200, 200))
            && self.origin.to_array().iter().all(|&v| v.abs() < exp2(400))
            && self
                .axes
                .iter()
                .flat_map(|a| a.to_array())
                .all(|v| within(v, -200, 200))
    }

    /// The finest unit for which points on its multiples, up to a few times the
    /// frustum's size away, have values of at most 25 bits: the values and the
    /// products of two are then exact. `None` if there is none, or if such products
    /// could underflow.
    fn find_lattice(&self, shape: &Shape, slopes: &[Dd; 4]) -> Option<Lattice> {
        if self.limit == 0.0 || !slopes_exact(shape, slopes) {
            return None;
        }
        let sizes = self.axis_sizes();
        let slope_size = self.slope.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
        let factor = sizes[0].max(sizes[1]) + (slope_size + 1.0) * sizes[2];
        let fixed = |v: &f64| v.abs();
        let constants = self.at_near.iter().chain([&self.near, &self.far]);
        let largest = constants.clone().map(fixed).fold(0.0, f64::max);
        let smallest_axis = sizes.into_iter().fold(f64::INFINITY, f64::min);
        let reach = (largest / smallest_axis)
            .max(self.origin.to_array().iter().map(fixed).fold(0.0, f64::max));
        if reach == 0.0 {
            // An infinite pyramid from the world's origin has no size.
            return None;
        }
        let limit = exp2(exponent_above(4.0 * reach));
        let size = factor * limit + 2.0 * largest * (1.0 + slope_size);
        let top = exponent_above(size);

        let least = |v: &mut dyn Iterator<Item = f64>| v.filter_map(lowest_bit).min();
        let axes = least(&mut self.axes.iter().flat_map(|a| a.to_array()))?;
        let constants = least(&mut constants.copied()).unwrap_or(0);
        let origin = least(&mut self.origin.to_array().into_iter());
        let slopes = least(&mut self.slope.into_iter()).map_or(0, |s| s.min(0));
        // lowest bit of a value = min(unit + axes, constants) + slopes >= top - 25
        let unit = top - 25 - slopes - axes;
        let coarsest = constants.min(origin.map_or(constants, |o| o + axes));
        if coarsest + slopes < top - 25 || top < -475 {
            return None;
        }
        Some(Lattice {
            round: 1.5 * exp2(52 + unit),
            limit: limit.min(exp2(51 + unit)),
        })
    }
}

/// The sum of the coordinates' magnitudes.
#[inline(always)]
fn size<F: Lanes>(v: Vec3<F>) -> F {
    v.x.abs() + v.y.abs() + v.z.abs()
}

#[inline(always)]
fn dot<F: Lanes>(a: Vec3<f64>, c: Vec3<F>) -> F {
    c.x.splat(a.x) * c.x + c.x.splat(a.y) * c.y + c.x.splat(a.z) * c.z
}

/// Whether all numbers of a frustum are in the range in which expansions are exact.
fn fits_expansions(pose: &Pose, shape: &Shape) -> bool {
    let near = shape.near();
    let other = match shape {
        Shape::Finite { far, .. } => far.rect,
        Shape::Infinite { slopes, .. } => *slopes,
    };
    let far = shape.far().map_or(0.0, |far| far.z);
    let axes = pose.axes.iter().flat_map(|a| a.to_array());
    [near.z, far]
        .into_iter()
        .chain(pose.origin.to_array())
        .chain(near.rect.to_array())
        .chain(other.to_array())
        .chain(axes)
        .all(in_safe_range)
}

/// The four slopes per unit of depth, to 106 bits where nothing underflows.
fn slopes(shape: &Shape) -> [Dd; 4] {
    match shape {
        Shape::Finite { near, far } => {
            let depth = Dd::difference(far.z, near.z).abs();
            let (n, f) = (near.rect.to_array(), far.rect.to_array());
            std::array::from_fn(|i| match Dd::difference(f[i], n[i]) {
                rise if rise.hi == 0.0 => Dd::new(0.0, 0.0),
                rise => rise.div(depth),
            })
        }
        Shape::Infinite { slopes, .. } => slopes.to_array().map(|s| Dd::new(s, 0.0)),
    }
}

/// Whether the rounded slopes are exact.
fn slopes_exact(shape: &Shape, slopes: &[Dd; 4]) -> bool {
    let Shape::Finite { near, far } = shape else {
        return true;
    };
    let (depth, rest) = two_diff(far.z, near.z);
    let (n, f) = (near.rect.to_array(), far.rect.to_array());
    rest == 0.0
        && (0..4).all(|i| {
            let (rise, more) = two_diff(f[i], n[i]);
            slopes[i].lo == 0.0 && more == 0.0 && two_prod(slopes[i].hi, depth.abs()) == (rise, 0.0)
        })
}

impl Frustum {
    pub(crate) fn filter(&self) -> &Filter {
        &self.filter
    }
}

#[cfg(test)]
mod tests;
