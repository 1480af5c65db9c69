//! A matrix's eye and depths by integers: exact, and each number rounded once; or what is wrong with it.

use super::{ClipSpace, Eye, Rows};
use crate::frustum::FrustumError;
use crate::frustum::eval::exact_vec::{Dyadic, Dyadic3, Rounded, cross, dot, exact, unit};
use crate::math::Vec3;
use std::cmp::Ordering;

/// The eye of a perspective matrix, and its near and far distances.
pub(super) fn eye(rows: &Rows, clip: ClipSpace, slack: f64) -> Result<Eye, FrustumError> {
    let system = System::new([rows.x, rows.y, rows.w])?;
    check_tilt(rows, slack)?;
    let depth = Depth::new(rows, &system, clip);
    let near = depth.near_distance()?;
    let far = depth.far_distance(near, slack)?;
    let [x, y, _, w] = rows.constants;
    let origin = system.zero([x, y, w])?;
    Ok(Eye { origin, near, far })
}

/// Three rows as a system of equations, solved by Cramer's rule.
pub(super) struct System {
    /// Columns of the adjugate; the determinant is made positive.
    columns: [Dyadic3; 3],
    determinant: Dyadic,
}

impl System {
    pub(super) fn new(rows: [Vec3<f64>; 3]) -> Result<Self, FrustumError> {
        let [a, b, c] = rows.map(exact);
        let columns = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
        let determinant = dot(&a, &columns[0]);
        match determinant.order() {
            Ordering::Equal => Err(FrustumError::SingularMatrix),
            Ordering::Greater => Ok(Self {
                columns,
                determinant,
            }),
            Ordering::Less => Ok(Self {
                columns: columns.map(|v| v.map(|x| -&x)),
                determinant: -&determinant,
            }),
        }
    }

    /// The point where `row . p + constant` is zero for all three, rounded.
    pub(super) fn zero(&self, constants: [f64; 3]) -> Result<Vec3<f64>, FrustumError> {
        let c = constants.map(|c| Dyadic::from(0.0 - c));
        let p = Vec3::from(std::array::from_fn(|i| {
            let term = |k: usize| &self.columns[k][i] * &c[k];
            (&(&term(0) + &term(1)) + &term(2)).ratio(&self.determinant)
        }));
        if p.is_finite() {
            Ok(p)
        } else {
            Err(FrustumError::Overflow { what: "the origin" })
        }
    }

    /// The coefficients of a vector in terms of the three rows, times the determinant.
    fn coefficients(&self, v: Vec3<f64>) -> Dyadic3 {
        let v = exact(v);
        std::array::from_fn(|k| dot(&self.columns[k], &v))
    }
}

/// A bound on depth, `z Z + w W >= 0`.
///
/// Along the middle of the view, where `X = Y = 0`, it is a function of `W`
/// alone: `slope * W + constant >= 0` (both times the determinant).
pub(super) struct DepthBound {
    pub(super) z: f64,
    pub(super) w: f64,
    pub(super) slope: Dyadic,
    pub(super) constant: Dyadic,
}

/// `Z` in terms of `X, Y, W`, all times the determinant, which is positive.
pub(super) struct Depth {
    /// `|c| + |d|`: the tilt.
    pub(super) tilt: Dyadic,
    pub(super) determinant: Dyadic,
    pub(super) near: DepthBound,
    pub(super) far: DepthBound,
}

impl Depth {
    pub(super) fn new(rows: &Rows, system: &System, clip: ClipSpace) -> Self {
        let [c, d, a] = system.coefficients(rows.z);
        let [x, y, z, w] = rows.constants.map(Dyadic::from);
        let determinant = system.determinant.clone();
        let plane = &(&(&c * &x) + &(&d * &y)) + &(&a * &w);
        let at_eye = &(&z * &determinant) - &plane;
        let low = clip.lowest_depth();
        let bound = |z: f64, w: f64| DepthBound {
            z,
            w,
            slope: &(&a * &z.into()) + &(&determinant * &w.into()),
            constant: &at_eye * &z.into(),
        };
        let above = bound(1.0, 0.0 - low);
        let below = bound(-1.0, 1.0);
        let (near, far) = if clip.reversed {
            (below, above)
        } else {
            (above, below)
        };
        Self {
            tilt: &c.abs() + &d.abs(),
            determinant,
            near,
            far,
        }
    }

    fn near_distance(&self) -> Result<f64, FrustumError> {
        let near = &self.near;
        let distance = (-&near.constant).ratio(&near.slope);
        if near.slope.order() != Ordering::Greater || near.constant.order() == Ordering::Greater {
            return Err(FrustumError::NoNearPlane { w: distance });
        }
        if near.constant.order() == Ordering::Equal {
            // Depth does not vary.
            return Err(FrustumError::SingularMatrix);
        }
        if distance == 0.0 {
            return Err(FrustumError::Underflow {
                what: "the near distance",
            });
        }
        if distance.is_infinite() {
            return Err(FrustumError::Overflow {
                what: "the near distance",
            });
        }
        Ok(distance)
    }

    /// The far distance; `None` for an infinite frustum.
    fn far_distance(&self, near: f64, slack: f64) -> Result<Option<f64>, FrustumError> {
        let far = &self.far;
        if far.slope.order() != Ordering::Less {
            // The plane is at infinity, or beyond it.
            let beyond = far.slope.ratio(&self.determinant);
            if beyond > slack {
                let w = far.constant.ratio(&-&far.slope);
                return Err(FrustumError::FarBehindEye { w });
            }
            return Ok(None);
        }
        let distance = far.constant.ratio(&-&far.slope);
        if distance.is_infinite() {
            return Err(FrustumError::Overflow {
                what: "the far distance",
            });
        }
        if distance <= near {
            return Err(FrustumError::FarNotBeyondNear {
                near,
                far: distance,
            });
        }
        Ok(Some(distance))
    }
}

/// Near and far planes are combinations of the rows `Z` and `W`: parallel to
/// the picture if these two are.
fn check_tilt(rows: &Rows, slack: f64) -> Result<(), FrustumError> {
    let (Some(z), Some(w)) = (unit(&exact(rows.z)), unit(&exact(rows.w))) else {
        // `Z` is zero, for depth reversed to infinity; `W` is not.
        return Ok(());
    };
    let sine = z.cross(w);
    let sine = sine.dot(sine).sqrt();
    // The rounding error of `W` is part of a short `Z`, too. If the lengths differ by a
    // factor beyond the range of `f64`, the quotient is infinite.
    let largest = |v: Vec3<f64>| v.x.abs().max(v.y.abs()).max(v.z.abs());
    if sine > slack * (1.0 + largest(rows.w) / largest(rows.z)) {
        Err(FrustumError::TiltedDepth { sine })
    } else {
        Ok(())
    }
}
