//! Poses: frames in the world.

use super::Vec3;

/// A frame in the world: an origin and three linearly independent axes.
///
/// The frame coordinates of a point `p` are `axes[k] . (p - origin)`. The axes may have
/// any length, angle and handedness: integer axes keep a rotated frame exact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// The point whose frame coordinates are zero.
    pub origin: Vec3<f64>,
    /// The rows of the world-to-frame matrix.
    pub axes: [Vec3<f64>; 3],
}

impl Pose {
    /// The pose whose frame coordinates are world coordinates.
    pub const IDENTITY: Pose = Pose {
        origin: Vec3::new(0.0, 0.0, 0.0),
        axes: [
            Vec3::new(1.0, 0.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(0.0, 0.0, 1.0),
        ],
    };

    /// Creates a pose from an origin and three axes.
    #[must_use]
    pub const fn new(origin: Vec3<f64>, axes: [Vec3<f64>; 3]) -> Self {
        Self { origin, axes }
    }

    /// Whether frame coordinates are world coordinates.
    pub fn is_identity(&self) -> bool {
        *self == Self::IDENTITY
    }

    /// The frame coordinates of a point, rounded. They serve drawing and plain
    /// arithmetic; no exact decision uses them.
    #[must_use]
    #[inline(always)]
    pub fn to_frame(&self, p: Vec3<f64>) -> Vec3<f64> {
        let c = p - self.origin;
        Vec3::new(
            self.axes[0].dot(c),
            self.axes[1].dot(c),
            self.axes[2].dot(c),
        )
    }

    /// The fast path of [`Pose::to_world`]: Cramer's rule, for axes of moderate
    /// length and not too far from right angles. Each product errs by a few `u`
    /// of `|a| |b| |c|` at most, and the determinant is at least a quarter of it.
    fn offset_by_cramer(&self, q: Vec3<f64>) -> Option<Vec3<f64>> {
        let [a, b, c] = self.axes;
        let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
        let determinant = a.dot(bc);
        let squares = [a.dot(a), b.dot(b), c.dot(c)];
        let volume = squares[0] * squares[1] * squares[2];
        let size = q.x.abs().max(q.y.abs()).max(q.z.abs());
        // Within these bounds nothing overflows, and a product that underflows is less than
        // 1e-20 of the result.
        let moderate =
            squares.iter().all(|s| (1e-40..1e40).contains(s)) && (1e-200..1e100).contains(&size);
        (moderate && 16.0 * determinant * determinant >= volume).then(|| {
            let v = bc * q.x + ca * q.y + ab * q.z;
            Vec3::new(v.x / determinant, v.y / determinant, v.z / determinant)
        })
    }

    /// The point with the given frame coordinates, rounded: the paper's inverse
    /// transform (step 4).
    ///
    /// Error: the offset from the origin is exact for axes that differ from
    /// the given ones by at most about `100 u` of each one's length, whatever
    /// their lengths; for axes at right angles that is about `100 u` of the
    /// offset's length. One more rounding adds the origin. A coordinate beyond
    /// the range of `f64` is infinite. Axes that are dependent in this sense
    /// give a point far away; the result is NaN only if an input is NaN or infinite.
    ///
    /// ```
    /// use frusta::{Pose, Vec3};
    /// let mut pose = Pose::IDENTITY;
    /// pose.origin = Vec3::new(1.0, 0.0, 0.0);
    /// pose.axes[2] = Vec3::new(0.0, 0.0, 4.0);
    /// let q = pose.to_frame(Vec3::new(3.0, 2.0, 1.0));
    /// assert_eq!(q, Vec3::new(2.0, 2.0, 4.0));
    /// assert_eq!(pose.to_world(q), Vec3::new(3.0, 2.0, 1.0));
    /// ```
    #[must_use]
    pub fn to_world(&self, q: Vec3<f64>) -> Vec3<f64> {
        if let Some(offset) = self.offset_by_cramer(q) {
            return self.origin + offset;
        }
        // Powers of two bring each axis near length 1 and the right-hand side
        // to at most 1, so that nothing overflows on the way.
        let shifts = self
            .axes
            .map(|a| -exponent(a.x.abs().max(a.y.abs()).max(a.z.abs())));
        let rows: [[f64; 3]; 3] =
            std::array::from_fn(|i| self.axes[i].to_array().map(|x| libm::ldexp(x, shifts[i])));
        let q = q.to_array();
        let scale = (0..3)
            .filter(|&i| q[i] != 0.0)
            .map(|i| exponent(q[i]) + shifts[i])
            .max();
        let Some(scale) = scale else {
            return self.origin;
        };
        let right: [f64; 3] = std::array::from_fn(|i| libm::ldexp(q[i], shifts[i] - scale));
        let [x, y, z] = solve(rows, right).map(|x| libm::ldexp(x, scale));
        self.origin + Vec3::new(x, y, z)
    }
}

/// The least `e` with `|x| < 2^e`; 0 for zero, infinity and NaN.
fn exponent(x: f64) -> i32 {
    if x == 0.0 || !x.is_finite() {
        0
    } else {
        libm::ilogb(x) + 1
    }
}

/// Solves three equations with coefficients of magnitude at most 1 by
/// elimination with complete pivoting.
fn solve(mut a: [[f64; 3]; 3], mut b: [f64; 3]) -> [f64; 3] {
    let mut order = [0, 1, 2];
    for k in 0..3 {
        let (mut row, mut column) = (k, k);
        for i in k..3 {
            for j in k..3 {
                if a[i][j].abs() > a[row][column].abs() {
                    (row, column) = (i, j);
                }
            }
        }
        a.swap(k, row);
        b.swap(k, row);
        for r in &mut a {
            r.swap(k, column);
        }
        order.swap(k, column);
        // A smaller pivot means dependent axes; this one keeps everything finite: each
        // unknown is at most its own quotient plus the unknowns after it.
        if a[k][k].abs() < 1e-200 {
            a[k][k] = 1e-200_f64.copysign(a[k][k]);
        }
        let pivot = a[k];
        for i in k + 1..3 {
            let factor = a[i][k] / pivot[k];
            for (entry, p) in a[i].iter_mut().zip(pivot).skip(k + 1) {
                *entry -= factor * p;
            }
            b[i] -= factor * b[k];
        }
    }
    let z = b[2] / a[2][2];
    let y = (b[1] - a[1][2] * z) / a[1][1];
    let x = (b[0] - a[0][1] * y - a[0][2] * z) / a[0][0];
    let mut result = [0.0; 3];
    for (value, place) in [x, y, z].into_iter().zip(order) {
        result[place] = value;
    }
    result
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Orthogonal axes from a quaternion, as long as its squared length.
    fn turned([a, b, c, d]: [f64; 4]) -> [Vec3<f64>; 3] {
        [
            [
                a * a + b * b - c * c - d * d,
                2.0 * (b * c - a * d),
                2.0 * (b * d + a * c),
            ],
            [
                2.0 * (b * c + a * d),
                a * a - b * b + c * c - d * d,
                2.0 * (c * d - a * b),
            ],
            [
                2.0 * (b * d - a * c),
                2.0 * (c * d + a * b),
                a * a - b * b - c * c + d * d,
            ],
        ]
        .map(Vec3::from)
    }

    proptest! {
        #[test]
        fn there_and_back(quaternion in prop::array::uniform4(-9i32..9), p in prop::array::uniform3(-100.0..100.0),
                          exponents in prop::array::uniform3(prop_oneof![-2i32..3, -900i32..900])) {
            prop_assume!(quaternion != [0; 4]);
            let mut pose = Pose::new(Vec3::default(), turned(quaternion.map(f64::from)));
            for (axis, e) in pose.axes.iter_mut().zip(exponents) {
                *axis = *axis * libm::ldexp(1.0, e);
            }
            let p = Vec3::from(p);
            let back = pose.to_world(pose.to_frame(p));
            for i in 0..3 {
                prop_assert!((back[i] - p[i]).abs() < 1e-13 * 100.0, "{} {}", p, back);
            }
        }

        #[test]
        fn nearly_dependent_axes_keep_the_residual(
            a in prop::array::uniform3(-1.0..1.0), b in prop::array::uniform3(-1.0..1.0),
            mix in prop::array::uniform2(-1.0..1.0), e in 10i32..45, q in prop::array::uniform3(-1.0..1.0),
        ) {
            // The third axis is almost in the plane of the others. The promise is a residual
            // like that of axes some ulps off, which Cramer's rule alone does not keep.
            let (a, b) = (Vec3::from(a), Vec3::from(b));
            let c = a * mix[0] + b * mix[1] + a.cross(b) * libm::ldexp(1.0, -e);
            prop_assume!([a, b, c].iter().all(|v| v.dot(*v) > 1e-2));
            let pose = Pose::new(Vec3::default(), [a, b, c]);
            let q = Vec3::from(q);
            let p = pose.to_world(q);
            let back = pose.to_frame(p);
            let size = p.dot(p).sqrt();
            for i in 0..3 {
                prop_assert!((back[i] - q[i]).abs() <= 100.0 * 1.2e-16 * (2.0 * size + 1.0), "{} {}", back, q);
            }
        }

        #[test]
        fn never_nan(axes in prop::array::uniform9(any::<u64>()), q in prop::array::uniform3(any::<u64>())) {
            let a = axes.map(f64::from_bits);
            let q = Vec3::from(q.map(f64::from_bits));
            let row = |i: usize| Vec3::new(a[i], a[i + 1], a[i + 2]);
            let pose = Pose::new(Vec3::default(), [row(0), row(3), row(6)]);
            prop_assume!(q.is_finite() && a.iter().all(|x| x.is_finite()));
            let p = pose.to_world(q);
            prop_assert!(!(p.x.is_nan() || p.y.is_nan() || p.z.is_nan()));
        }
    }

    #[test]
    fn dependent_axes_give_no_nan() {
        let ones = Vec3::new(1.0, 1.0, 1.0);
        for axes in [
            [ones; 3],
            [Vec3::default(); 3],
            [ones, -ones, Vec3::default()],
        ] {
            let p = Pose::new(ones, axes).to_world(Vec3::new(1e300, -1e300, 5e-324));
            assert!(!(p.x.is_nan() || p.y.is_nan() || p.z.is_nan()), "{p}");
        }
    }
}
