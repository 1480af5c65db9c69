//! Representable points inside the frustum near an exact point.
//!
//! A boundary function is linear, so at the points of a small lattice of
//! candidates it is an offset plus one term for each coordinate. The terms are
//! computed once for each candidate coordinate; trying a candidate is three
//! additions a face.

use super::Oracle;
use super::dyadic::Dyadic;
use super::round::{neighbours, round_nearest};
use crate::frustum::FaceSet;
use crate::math::{Real, Vec3};
use num_rational::BigRational;

/// The largest distance of an inward point from the exact one, in ulps per coordinate.
pub(crate) const INWARD_ULPS: u32 = 2;

/// The candidates for a coordinate, those next to the exact value first.
fn nearest_first<T: Real>(exact: &BigRational) -> Vec<T> {
    let ascending = neighbours::<T>(exact, INWARD_ULPS);
    let nearest = round_nearest::<T>(exact);
    let middle = ascending.iter().position(|&v| v == nearest).unwrap_or(0);
    let mut order: Vec<usize> = (0..ascending.len()).collect();
    order.sort_by_key(|&i| i.abs_diff(middle));
    order.into_iter().map(|i| ascending[i]).collect()
}

impl Oracle {
    /// A representable point of the frustum within two ulps per coordinate of the exact
    /// one, if there is one. With `depth`, only points with exactly that `z` count.
    pub(crate) fn inward_point<T: Real>(
        &self,
        exact: &[BigRational; 3],
        depth: Option<T>,
    ) -> Option<Vec3<T>> {
        let mut candidates = exact.each_ref().map(nearest_first::<T>);
        if let Some(depth) = depth {
            candidates[2].retain(|&z| z == depth);
        }
        // Values at (x, 0, 0), and what y and z add to them.
        let terms = self.terms(&candidates);
        for (i, &x) in candidates[0].iter().enumerate() {
            for (j, &y) in candidates[1].iter().enumerate() {
                for (k, &z) in candidates[2].iter().enumerate() {
                    let inside = terms.iter().all(|[tx, ty, tz]| {
                        let value = &(&tx[i] + &ty[j]) + &tz[k];
                        !value.is_negative()
                    });
                    if inside {
                        return Some(Vec3::new(x, y, z));
                    }
                }
            }
        }
        None
    }

    /// For each face and coordinate, what each candidate adds to the boundary
    /// function; the first coordinate's terms include the offset.
    fn terms<T: Real>(&self, candidates: &[Vec<T>; 3]) -> Vec<[Vec<Dyadic>; 3]> {
        let exact = candidates.each_ref().map(|values| {
            let exact = values.iter().filter_map(|v| Dyadic::from_f64(v.to_f64()));
            exact.collect::<Vec<_>>()
        });
        let zero = || Dyadic::zero();
        self.half_spaces
            .iter()
            .map(|h| {
                let term = |k: usize| exact[k].iter().map(|v| &h.normal[k] * v).collect();
                let first = exact[0].iter();
                let first = first.map(|v| h.value_at(&[v.clone(), zero(), zero()]));
                [first.collect(), term(1), term(2)]
            })
            .collect()
    }

    /// The number of ulps by which a point inside could still move outwards, rounded to
    /// nearest: for each face of the set the steps to its plane along the coordinate with
    /// the fewest, and the largest of these. Negative for a point outside. It is a measure
    /// for reports, not a bound.
    pub fn room_in_ulps<T: Real>(&self, faces: FaceSet, point: Vec3<T>) -> f64 {
        let exact = super::exact_point(point.to_f64());
        let ulps = point.to_array().map(|c| {
            let next = Dyadic::from_f64(c.abs().next_up().to_f64());
            let this = Dyadic::from_f64(c.abs().to_f64());
            next.zip(this).map(|(a, b)| &a - &b)
        });
        let mut room = 0.0_f64;
        for h in self.half_spaces.iter().filter(|h| faces.contains(h.face)) {
            let value = h.value_at(&exact);
            let step = h.normal.iter().zip(&ulps);
            // The change by one ulp along the steepest coordinate.
            let step = step.filter_map(|(n, ulp)| ulp.as_ref().map(|u| (n * u).abs()));
            let Some(steepest) = step.max().filter(|s| !s.is_zero()) else {
                continue;
            };
            let (value, steepest, _) = value.aligned(&steepest);
            let steps = round_nearest::<f64>(&BigRational::new_raw(value, steepest));
            if steps > room || steps < 0.0 {
                room = steps;
            }
        }
        room
    }
}
