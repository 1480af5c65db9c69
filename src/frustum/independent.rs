//! Exact linear independence of three vectors.
//!
//! A filter first: the determinant and the sum of its terms' magnitudes in floating
//! point. Each of the six terms has at most three products and takes part in at
//! most five sums, so the determinant errs by less than `8 u` times that sum, plus
//! underflow. If the filter does not decide, integers do.

use super::eval::exact_vec::{Rounded, cross, dot, exact};
use crate::math::Vec3;
use std::cmp::Ordering;

/// Whether the determinant of three finite vectors is not zero.
pub(super) fn independent(axes: &[Vec3<f64>; 3]) -> bool {
    certainly_independent(axes) || {
        let [a, b, c] = axes.map(exact);
        dot(&a, &cross(&b, &c)).order() != Ordering::Equal
    }
}

/// True only if the determinant is not zero.
fn certainly_independent(axes: &[Vec3<f64>; 3]) -> bool {
    let largest = |v: Vec3<f64>| v.x.abs().max(v.y.abs()).max(v.z.abs());
    // With coordinates outside of this range, products could overflow or underflow.
    if !axes.iter().all(|&v| (1e-90..1e90).contains(&largest(v))) {
        return false;
    }
    let [a, b, c] = *axes;
    let magnitude = |v: Vec3<f64>| Vec3::new(v.x.abs(), v.y.abs(), v.z.abs());
    let [ma, mb, mc] = axes.map(magnitude);
    let sum = ma.x * (mb.y * mc.z + mb.z * mc.y)
        + ma.y * (mb.z * mc.x + mb.x * mc.z)
        + ma.z * (mb.x * mc.y + mb.y * mc.x);
    // 16 EPSILON = 32 u is four times the bound, which covers the sum's own rounding. 1e-200
    // covers underflow: at most twelve products lose 5e-324 each, times a factor below 1e90.
    a.dot(b.cross(c)).abs() > 16.0 * f64::EPSILON * sum + 1e-200
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn axes(rows: [[f64; 3]; 3]) -> [Vec3<f64>; 3] {
        rows.map(Vec3::from)
    }

    #[test]
    fn extreme_axes() {
        let diagonal = |x: f64| axes([[x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]]);
        for x in [5e-324, 1e-160, 1.0, 1e160, f64::MAX] {
            assert!(independent(&diagonal(x)), "{x}");
            assert!(!independent(&axes([[x, x, 0.0], [x, x, x], [0.0, 0.0, x]])));
        }
        let mixed = axes([[f64::MAX, 0.0, 1.0], [0.0, 5e-324, 1.0], [0.0, 0.0, 1.0]]);
        assert!(independent(&mixed));
    }

    #[test]
    fn one_ulp_counts_and_rounding_does_not() {
        let next = 1.0_f64.next_up();
        let close = axes([[1.0, 1.0, 1.0], [1.0, 1.0, next], [1.0, next, 1.0]]);
        assert!(independent(&close) && !certainly_independent(&close));
        // In `f64`, 0.1 + 0.2 is not 0.3, but 0.1 + 0.1 is 0.2.
        assert!(!independent(&axes([
            [0.1, 0.7, 0.3],
            [0.1, 0.7, 0.3],
            [0.0, 0.0, 1.0]
        ])));
        assert!(!independent(&axes([
            [0.1, 0.7, 0.3],
            [0.2, 1.4, 0.6],
            [0.5, 0.0, 1.0]
        ])));
    }

    proptest! {
        #[test]
        fn the_filter_is_never_wrong(m in prop::array::uniform3(prop::array::uniform2(-9i32..9)),
                                 s in -8i32..8, t in -8i32..8, bump in any::<bool>()) {
            // Two rows and an integer combination of them, plus one unit or not.
            let row = |r: [i32; 3]| Vec3::from(r.map(|x| f64::from(x) * 0.5));
            let a = [m[0][0], m[1][0], m[2][0]];
            let b = [m[0][1], m[1][1], m[2][1]];
            let mut c: [i32; 3] = std::array::from_fn(|i| s * a[i] + t * b[i]);
            c[2] += i32::from(bump);
            let truth = bump && a[0] * b[1] != a[1] * b[0];
            let axes = [row(a), row(b), row(c)];
            prop_assert_eq!(independent(&axes), truth);
            prop_assert!(truth || !certainly_independent(&axes));
        }
    }
}
