//! From the input's numbers to numbers that can be drawn, exactly.
//!
//! A case may have coordinates from 5e-324 to 1e300, and a detail to be seen may be one
//! unit in the last place. So points are rational until they are in a window: a box in
//! the frustum's frame that becomes a cube of size 2 about zero. Only there are they
//! rounded, and everything outside the window is cut off before.

use frusta::oracle::round_nearest;
use frusta::{Frustum, Pose, Shape, Vec3};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// An exact number.
pub(super) type Exact = BigRational;

/// An exact point.
pub(super) type Point = [Exact; 3];

/// An `f64` as a fraction; the numbers of a line are finite.
pub(super) fn exact(value: f64) -> Exact {
    Exact::from_float(value).unwrap_or_else(Exact::zero)
}

/// A point as it is.
pub(super) fn point(p: Vec3<f64>) -> Point {
    p.to_array().map(exact)
}

/// `a + t (b - a)`
pub(super) fn between(a: &Point, b: &Point, t: &Exact) -> Point {
    [0, 1, 2].map(|k| &a[k] + t * (&b[k] - &a[k]))
}

/// The largest difference in a coordinate.
pub(super) fn distance(a: &Point, b: &Point) -> Exact {
    let all = (0..3).map(|k| (&a[k] - &b[k]).abs());
    all.fold(Exact::zero(), |m, d| if d > m { d } else { m })
}

/// A point in the pose's frame.
pub(super) fn in_frame(pose: &Pose, p: &Point) -> Point {
    if pose.is_identity() {
        return p.clone();
    }
    let origin = point(pose.origin);
    let offset = [0, 1, 2].map(|k| &p[k] - &origin[k]);
    pose.axes.map(|axis| {
        let terms = point(axis).into_iter().zip(&offset);
        terms.fold(Exact::zero(), |sum, (a, c)| sum + a * c)
    })
}

/// The corners of an end: depth, left, right, bottom, top.
#[derive(Clone)]
pub(super) struct Rim {
    pub(super) z: Exact,
    /// Left, right, bottom, top.
    pub(super) sides: [Exact; 4],
}

/// The frustum's two ends; one without a far end is cut off at a depth that shows
/// where these points of its frame are.
pub(super) fn rims(frustum: &Frustum, points: &[Point]) -> [Rim; 2] {
    let near = frustum.shape().near();
    let first = Rim {
        z: exact(near.z),
        sides: near.rect.to_array().map(exact),
    };
    let last = match *frustum.shape() {
        Shape::Finite { far, .. } => Rim {
            z: exact(far.z),
            sides: far.rect.to_array().map(exact),
        },
        Shape::Infinite {
            slopes, direction, ..
        } => {
            let sign = exact(direction.sign());
            let [left, right, bottom, top] = &first.sides;
            let mut reach = (right - left).max(top - bottom);
            for p in points {
                reach = reach.max((&p[2] - &first.z) * &sign * exact(1.25));
            }
            if !reach.is_positive() {
                reach = Exact::one();
            }
            let slopes = slopes.to_array().map(exact);
            let side = |k: usize| &first.sides[k] + &slopes[k] * &reach;
            Rim {
                z: &first.z + sign * &reach,
                sides: [side(0), side(1), side(2), side(3)],
            }
        }
    };
    [first, last]
}

/// A box in the frame, and how large its image is.
#[derive(Clone)]
pub(super) struct Window {
    centre: Point,
    half: Point,
    size: [f64; 3],
}

impl Window {
    /// Around a point, the same in all coordinates.
    pub(super) fn around(centre: Point, half: &Exact) -> Self {
        Self {
            centre,
            half: [0, 1, 2].map(|_| half.clone()),
            size: [1.0; 3],
        }
    }

    /// So that the frustum becomes of size 2 in its longest coordinate, and in no
    /// other less than a third of that, however thin it is.
    pub(super) fn of_frustum(rims: &[Rim; 2]) -> Self {
        const LEAST: f64 = 0.34;
        let [near, far] = rims;
        let ends = |k: usize| match k {
            2 => [&near.z, &far.z].to_vec(),
            _ => [near, far]
                .iter()
                .flat_map(|r| &r.sides[2 * k..2 * k + 2])
                .collect(),
        };
        let low = |k: usize| ends(k).into_iter().min().cloned().unwrap_or_default();
        let high = |k: usize| ends(k).into_iter().max().cloned().unwrap_or_default();
        let two = exact(2.0);
        let half = [0, 1, 2].map(|k| (high(k) - low(k)) / &two);
        let largest = half.iter().max().cloned().unwrap_or_else(Exact::one);
        let size = [0, 1, 2].map(|k| {
            let share: f64 = round_nearest(&(&half[k] / &largest));
            share.max(LEAST)
        });
        Self {
            centre: [0, 1, 2].map(|k| (high(k) + low(k)) / &two),
            half,
            size,
        }
    }

    /// By how much each coordinate is drawn larger than the longest.
    pub(super) fn stretch(&self) -> [f64; 3] {
        let largest = self.half.iter().max();
        [0, 1, 2].map(|k| match largest {
            Some(largest) => self.size[k] * round_nearest::<f64>(&(largest / &self.half[k])),
            None => 1.0,
        })
    }

    /// Where a point is.
    pub(super) fn place(&self, p: &Point) -> Vec3<f64> {
        let k = |k: usize| self.coordinate(k, &p[k]);
        Vec3::new(k(0), k(1), k(2))
    }

    /// Where a coordinate is.
    pub(super) fn coordinate(&self, k: usize, c: &Exact) -> f64 {
        let place: f64 = round_nearest(&((c - &self.centre[k]) / &self.half[k]));
        place * self.size[k]
    }

    /// The parameters of what of a line is in the window, grown by a factor, in these
    /// coordinates.
    pub(super) fn within(
        &self,
        [a, b]: [&Point; 2],
        growth: f64,
        coordinates: &[usize],
    ) -> Option<[Exact; 2]> {
        let (mut low, mut high) = (Exact::zero(), Exact::one());
        for &k in coordinates {
            let half = &self.half[k] * exact(growth);
            let (from, along) = (&a[k] - &self.centre[k], &b[k] - &a[k]);
            for sign in [Exact::one(), -Exact::one()] {
                // sign (from + t along) <= half
                let (value, slope) = (&half - &sign * &from, &sign * &along);
                if slope.is_zero() {
                    if value.is_negative() {
                        return None;
                    }
                    continue;
                }
                let t = value / &slope;
                if slope.is_positive() {
                    high = high.min(t);
                } else {
                    low = low.max(t);
                }
            }
        }
        (low <= high).then_some([low, high])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::samples::Family;

    #[test]
    fn every_frustum_fills_its_window() {
        for &family in Family::ALL {
            let (frustum, segment) = family.case(3, 70);
            let ends = [segment.start, segment.end];
            let ends = ends.map(|p| in_frame(frustum.pose(), &point(p)));
            let rims = rims(&frustum, &ends);
            let window = Window::of_frustum(&rims);
            let mut seen = 0.0_f64;
            for rim in &rims {
                for k in [0, 1] {
                    for side in &rim.sides[2 * k..2 * k + 2] {
                        let place = window.coordinate(k, side);
                        assert!(place.abs() <= 1.0, "{family}: {place}");
                        seen = seen.max(place.abs());
                    }
                }
                seen = seen.max(window.coordinate(2, &rim.z).abs());
            }
            assert_eq!(seen, 1.0, "{family}");
            assert!(window.stretch().iter().all(|s| *s >= 0.34), "{family}");
        }
    }

    #[test]
    fn what_leaves_the_window_is_cut_off() {
        let far = |x: f64| point(Vec3::new(x, 0.0, 0.0));
        let window = Window::around(far(0.0), &exact(1.0));
        let (a, b) = (far(-1e300), far(3e300));
        let [low, high] = window.within([&a, &b], 1.0, &[0, 1, 2]).unwrap();
        let places = [low, high].map(|t| window.place(&between(&a, &b, &t)).x);
        assert_eq!(places, [-1.0, 1.0]);
        let aside = point(Vec3::new(0.0, 2.0, 0.0));
        assert_eq!(window.within([&aside, &aside], 1.0, &[0, 1, 2]), None);
        assert!(window.within([&aside, &aside], 1.0, &[0, 2]).is_some());
    }
}
