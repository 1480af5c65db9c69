//! A matrix's eye and depths by double-double values with a bound on their error: the numbers of
//! [`integers`](super::integers) where the bound proves them, in a tenth of the time and without allocation.
//!
//! The formulas are the same. Whatever is not certain, an error included, is left to integers.

use super::{ClipSpace, Eye, Rows};
use crate::exact::ball::{Ball, cross, dot};
use crate::math::Vec3;
use std::cmp::Ordering;

/// Three rows as a system of equations, solved by Cramer's rule.
struct System {
    columns: [[Ball; 3]; 3],
    /// Positive.
    determinant: Ball,
}

fn balls(v: Vec3<f64>) -> [Ball; 3] {
    v.to_array().map(Ball::from)
}

impl System {
    fn new(rows: [Vec3<f64>; 3]) -> Option<Self> {
        let [a, b, c] = rows.map(balls);
        let columns = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
        let determinant = dot(&a, &columns[0]);
        match determinant.sign()? {
            Ordering::Equal => None,
            Ordering::Greater => Some(Self {
                columns,
                determinant,
            }),
            Ordering::Less => Some(Self {
                columns: columns.map(|v| v.map(|x| -x)),
                determinant: -determinant,
            }),
        }
    }

    fn zero(&self, constants: [f64; 3]) -> Option<Vec3<f64>> {
        let c = constants.map(|c| Ball::from(0.0 - c));
        let coordinate = |i: usize| {
            let [x, y, z] = [0, 1, 2].map(|k| self.columns[k][i] * c[k]);
            (x + y + z).over(self.determinant).rounded()
        };
        Some(Vec3::new(coordinate(0)?, coordinate(1)?, coordinate(2)?))
    }
}

/// The point where `row . p + constant` is zero for all three, rounded.
pub(super) fn zero(rows: [Vec3<f64>; 3], constants: [f64; 3]) -> Option<Vec3<f64>> {
    System::new(rows)?.zero(constants)
}

/// The eye of a perspective matrix, and its near and far distances.
pub(super) fn eye(rows: &Rows, clip: ClipSpace, slack: f64) -> Option<Eye> {
    let system = System::new([rows.x, rows.y, rows.w])?;
    if !is_certainly_level(rows, slack) {
        return None;
    }
    let determinant = system.determinant;
    let [c, d, a] = system.columns.map(|column| dot(&column, &balls(rows.z)));
    let [x, y, z, w] = rows.constants.map(Ball::from);
    let at_eye = z * determinant - (c * x + d * y + a * w);
    // Slope and constant of the two bounds of depth.
    let low = Ball::from(0.0 - clip.lowest_depth());
    let above = (a + determinant * low, at_eye);
    // Depth to infinity makes both rows the same, and `a` the determinant: zero, exactly.
    let is_infinite = rows.z == rows.w;
    let excess = if is_infinite {
        Ball::from(0.0)
    } else {
        determinant - a
    };
    let below = (excess, -at_eye);
    let (near, far) = if clip.reversed {
        (below, above)
    } else {
        (above, below)
    };
    let (slope, constant) = near;
    if slope.sign()? != Ordering::Greater || constant.sign()? != Ordering::Less {
        return None;
    }
    let near = (-constant).over(slope).rounded()?;
    let (slope, constant) = far;
    let far = match slope.sign()? {
        Ordering::Less => {
            let far = constant.over(-slope).rounded()?;
            Some(far).filter(|&far| far > near).map(Some)?
        }
        Ordering::Equal => None,
        Ordering::Greater if slope.over(determinant).bound() < 0.5 * slack => None,
        Ordering::Greater => return None,
    };
    let [x, y, _, w] = rows.constants;
    let origin = system.zero([x, y, w])?;
    Some(Eye { origin, near, far })
}

/// Whether near and far planes are certainly parallel to the picture, up to what rounding of the matrix explains.
fn is_certainly_level(rows: &Rows, slack: f64) -> bool {
    let (z, w) = (rows.z, rows.w);
    if z == Vec3::default() {
        return true;
    }
    let largest = |v: Vec3<f64>| v.x.abs().max(v.y.abs()).max(v.z.abs());
    let (largest_z, largest_w) = (largest(z), largest(w));
    if ![largest_z, largest_w]
        .iter()
        .all(|v| (1e-60..1e60).contains(v))
    {
        return false;
    }
    let across = z.cross(w);
    let sine = (across.dot(across) / (z.dot(z) * w.dot(w))).sqrt();
    // This sine is off by 10 u, the one that decides, of two rounded unit vectors, by 40 u.
    sine + 64.0 * (0.5 * f64::EPSILON) < slack * (1.0 + largest_w / largest_z)
}

#[cfg(test)]
mod tests {
    use super::super::{MatrixLayout, ViewProjection, integers};
    use super::*;
    use crate::math::{Pose, Real};
    use crate::samples::Random;

    fn rows<T: Real>(m: [[f64; 4]; 4]) -> Rows {
        let m = m.map(|row| row.map(|e| T::from_f64(e).to_f64()));
        let [x, y, z, w] = m.map(|[a, b, c, _]| Vec3::new(a, b, c));
        let constants = m.map(|row| row[3]);
        Rows {
            x,
            y,
            z,
            w,
            constants,
        }
    }

    /// A turned, moved and scaled view, and a projection of each kind.
    fn matrix(random: &mut Random, kind: usize) -> ([[f64; 4]; 4], ClipSpace) {
        let reach = [1.0, 10.0, 1e4, 1e7][kind / 8 % 4];
        let mut point = |reach: f64| Vec3::from([(); 3].map(|()| random.between(-reach, reach)));
        let (eye, z, up) = (point(reach), point(1.0), point(1.0));
        let x = z.cross(up);
        let y = x.cross(z);
        let unit = |v: Vec3<f64>| v * (1.0 / v.dot(v).sqrt());
        let mut axes = [x, y, z].map(unit);
        if kind.is_multiple_of(16) {
            axes = Pose::IDENTITY.axes;
        }
        if kind % 16 == 1 {
            // Skewed, and of other scales.
            axes = [axes[0] * 3.0 + axes[1], axes[1] * 0.2, axes[2] * 1e3];
        }
        let (near, far) = [(0.1, 100.0), (1e-4, 1e5), (1.0, 1.25), (0.5, 1e7)][kind / 3 % 4];
        let (p, q, is_reversed) = match kind % 8 {
            0 | 1 => (far / (far - near), -near * far / (far - near), false),
            2 | 3 => (-near / (far - near), near * far / (far - near), true),
            4 | 5 => (0.0, near, true),
            6 => (1.0, -near, false),
            _ => (
                (far + near) / (far - near),
                -2.0 * near * far / (far - near),
                false,
            ),
        };
        let clip = match (kind % 8, is_reversed) {
            (7, _) => ClipSpace::OPENGL,
            (_, true) => ClipSpace::ZERO_TO_ONE.reversed(),
            _ => ClipSpace::ZERO_TO_ONE,
        };
        let row = |v: Vec3<f64>| [v.x, v.y, v.z, -v.dot(eye)];
        let [x, y, w] = [axes[0] * 1.2, axes[1] * 1.8, axes[2]].map(row);
        let z = [w[0] * p, w[1] * p, w[2] * p, w[3] * p + q];
        ([x, y, z, w], clip)
    }

    /// A hundred thousand matrices: what is proved is what integers find, bit for bit, and nearly all of
    /// everyday's are.
    #[test]
    fn what_is_proved_is_exact() {
        fn check<T: Real>() -> [[usize; 2]; 8] {
            let mut random = Random::new(&[14, 4]);
            let mut counts = [[0; 2]; 8];
            for kind in 0..50_000 {
                let (m, clip) = matrix(&mut random, kind);
                let rows = rows::<T>(m);
                let slack = 64.0 * T::UNIT_ROUNDOFF;
                let exact = integers::eye(&rows, clip, slack);
                let found = eye(&rows, clip, slack);
                if let Some(found) = found {
                    let bits = |e: Eye| {
                        let [x, y, z] = e.origin.to_array().map(f64::to_bits);
                        (x, y, z, e.near.to_bits(), e.far.map(f64::to_bits))
                    };
                    assert_eq!(Some(bits(found)), exact.clone().ok().map(bits), "{rows:?}");
                }
                counts[kind % 8][usize::from(found.is_some())] += usize::from(exact.is_ok());
            }
            counts
        }
        for counts in [check::<f32>(), check::<f64>()] {
            println!("left to integers, and proved: {counts:?}");
            for (kind, [left, proved]) in counts.into_iter().enumerate() {
                assert!(proved > 20 * left, "{kind}: {left} of {proved}");
            }
        }
    }

    /// The same for parallel projections.
    #[test]
    fn zeros_are_exact() {
        let mut random = Random::new(&[14, 6]);
        let (mut proved, mut left) = (0, 0);
        for kind in 0..20_000 {
            let (m, _) = matrix(&mut random, kind);
            let rows = rows::<f64>(m);
            let [x, y, _, w] = rows.constants;
            let axes = [rows.x, rows.y, rows.w];
            let exact = integers::System::new(axes).and_then(|s| s.zero([x, y, w]));
            match zero(axes, [x, y, w]) {
                Some(found) => {
                    assert_eq!(Ok(found), exact);
                    proved += 1;
                }
                None => left += 1,
            }
        }
        assert!(proved > 100 * left, "{proved} {left}");
    }

    /// Matrices without a frustum are left to integers, which say why.
    #[test]
    fn errors_are_left_to_integers() {
        for bad in [
            [[0.0; 4]; 4],
            [
                [1.0, 0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0, 0.0],
                [0.0; 4],
                [0.0, 0.0, 1.0, 0.0],
            ],
            [
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [1.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ],
        ] {
            let clip = ClipSpace::ZERO_TO_ONE;
            assert!(eye(&rows::<f64>(bad), clip, 1e-14).is_none());
            let matrix = ViewProjection::new(bad, MatrixLayout::RowMajorColumnVectors);
            assert!(matrix.frustum(clip).is_err());
        }
    }
}
