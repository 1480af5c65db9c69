//! A frustum from the six points of the projection-reduction paper.
//!
//! `Pb` and `Pt` are the centres of the base (far) and the top (near) face,
//! `A1` and `A2` the midpoints of the base's sides on `+x` and `+y`, `A3` and
//! `A4` those of the top's. (The paper only draws them. If they were corners, the
//! two trapezoids would bound a larger solid.)
//!
//! The paper's frame has unit axes along `Pb -> Pt`, `Pb -> A1` and their cross
//! product. Two deviations from it keep more digits:
//!
//! 1. The axes are the differences themselves, times a power of two, not unit
//!    vectors: no root and no division. Frame coordinates are scaled with them,
//!    so the rectangles have the scale of the squared lengths.
//! 2. The `y` axis is the difference `Pb -> A2`, not the cross product, which
//!    would be of degree two.
//!
//! If the differences are representable (small integers, for example), the
//! frustum is exactly the one that the points describe. Otherwise each coordinate
//! of an axis and each half-extent is rounded once.
//!
//! Six points overdetermine a frustum: right angles are checked, up to
//! [`SixPoints::SKEW`] and what rounding of the points explains.

use super::eval::exact_vec::{
    Dyadic, Dyadic3, Rounded, difference, dot, exact, normalised_by_power, unit,
};
use super::{EndRect, Frustum, FrustumError, Shape};
use crate::math::{Pose, Rect, Vec3};

/// A frustum given by six points: the centres of its base and top, and the midpoints of two
/// sides of each (the paper's figure 1).
///
/// ```
/// use frusta::{EndRect, SixPoints, Vec3};
///
/// let points = SixPoints {
///     base_centre: Vec3::new(0.0, 0.0, 0.0),
///     top_centre: Vec3::new(0.0, 0.0, 1.0),
///     base_x: Vec3::new(1.0, 0.0, 0.0),
///     base_y: Vec3::new(0.0, 1.0, 0.0),
///     top_x: Vec3::new(0.5, 0.0, 1.0),
///     top_y: Vec3::new(0.0, 0.5, 1.0),
/// };
/// let corners = points.frustum()?.corners();
/// assert_eq!(corners.near[0], Vec3::new(-0.5, -0.5, 1.0));
/// # Ok::<(), frusta::FrustumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SixPoints {
    /// `Pb`, the centre of the base, which is the far face.
    pub base_centre: Vec3<f64>,
    /// `Pt`, the centre of the top, which is the near face.
    pub top_centre: Vec3<f64>,
    /// `A1`, the midpoint of the base's side on `+x`.
    pub base_x: Vec3<f64>,
    /// `A2`, the midpoint of the base's side on `+y`.
    pub base_y: Vec3<f64>,
    /// `A3`, the midpoint of the top's side on `+x`; `Pt` itself where the top
    /// has no width.
    pub top_x: Vec3<f64>,
    /// `A4`, the midpoint of the top's side on `+y`; `Pt` itself where the top
    /// has no height.
    pub top_y: Vec3<f64>,
}

const PB: &str = "the base's centre Pb";
const PT: &str = "the top's centre Pt";
const A1: &str = "the base's midpoint A1";
const A2: &str = "the base's midpoint A2";
const A3: &str = "the top's midpoint A3";
const A4: &str = "the top's midpoint A4";

/// An edge of the figure, from a centre to the point it is named for.
struct Edge {
    name: &'static str,
    vector: Dyadic3,
    unit: Vec3<f64>,
    /// The largest cosine that rounding of the points alone can give a right angle.
    slack: f64,
}

impl SixPoints {
    /// The largest cosine of an angle that counts as right, beside what rounding of
    /// the points explains: `2^-20`, about a fifth of a second of arc.
    pub const SKEW: f64 = 1.0 / 1_048_576.0;

    /// The frustum of the six points.
    ///
    /// Its frame has the origin `Pb`, `x` along `Pb -> A1`, `y` along `Pb -> A2` and
    /// `z` along `Pb -> Pt`; the base is the far end at `z = 0`, the top the near end.
    ///
    /// # Errors
    /// [`FrustumError::NonFinite`], [`FrustumError::SamePoint`],
    /// [`FrustumError::Skew`], [`FrustumError::WrongSide`],
    /// [`FrustumError::Overflow`] or [`FrustumError::Underflow`], each with the names
    /// of the points.
    pub fn frustum(&self) -> Result<Frustum, FrustumError> {
        self.check_finite()?;
        let required = |(name, to), (from_name, from)| {
            self.edge(name, to, from).ok_or(FrustumError::SamePoint {
                what: [name, from_name],
                at: from,
            })
        };
        let base = (PB, self.base_centre);
        let z = required((PT, self.top_centre), base)?;
        let x = required((A1, self.base_x), base)?;
        let y = required((A2, self.base_y), base)?;
        right_angle(&x, &z)?;
        right_angle(&y, &z)?;
        right_angle(&y, &x)?;
        for (name, to, axis, across) in [(A3, self.top_x, &x, &y), (A4, self.top_y, &y, &x)] {
            let Some(edge) = self.edge(name, to, self.top_centre) else {
                continue;
            };
            right_angle(&edge, &z)?;
            right_angle(&edge, across)?;
            if edge.unit.dot(axis.unit) < 0.0 {
                return Err(FrustumError::WrongSide { what: name });
            }
        }
        let (x, width) = axis(&x)?;
        let (y, height) = axis(&y)?;
        let (z, depth) = axis(&z)?;
        let top = |axis, to| {
            let half = dot(&exact(axis), &difference(to, self.top_centre)).to_f64();
            // Rounding of the axis can make a tiny extent negative.
            half.max(0.0)
        };
        let shape = Shape::Finite {
            near: EndRect {
                z: depth,
                rect: Rect::centred(top(x, self.top_x), top(y, self.top_y)),
            },
            far: EndRect {
                z: 0.0,
                rect: Rect::centred(width, height),
            },
        };
        Frustum::new(Pose::new(self.base_centre, [x, y, z]), shape)
    }

    fn points(&self) -> [(&'static str, Vec3<f64>); 6] {
        [
            (PB, self.base_centre),
            (PT, self.top_centre),
            (A1, self.base_x),
            (A2, self.base_y),
            (A3, self.top_x),
            (A4, self.top_y),
        ]
    }

    fn check_finite(&self) -> Result<(), FrustumError> {
        for (what, point) in self.points() {
            for value in point.to_array() {
                FrustumError::check_finite(what, value)?;
            }
        }
        Ok(())
    }

    /// The edge to a point; `None` if it has no length.
    fn edge(&self, name: &'static str, to: Vec3<f64>, from: Vec3<f64>) -> Option<Edge> {
        let vector = difference(to, from);
        let unit = unit(&vector)?;
        let largest = |v: [f64; 3]| v.into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let length = largest([0, 1, 2].map(|i| vector[i].to_f64()));
        let coordinate = largest(to.to_array()).max(largest(from.to_array()));
        Some(Edge {
            name,
            vector,
            unit,
            // Each of three coordinates of each end is off by at most half an ulp of the
            // largest coordinate.
            slack: 4.0 * f64::EPSILON * (coordinate / length),
        })
    }
}

fn right_angle(a: &Edge, b: &Edge) -> Result<(), FrustumError> {
    let cosine = a.unit.dot(b.unit);
    // The comparison is false, so no error, if the slack is infinite or NaN (lengths out of
    // range).
    if cosine.abs() > SixPoints::SKEW + a.slack + b.slack {
        return Err(FrustumError::Skew {
            what: [a.name, b.name],
            cosine,
        });
    }
    Ok(())
}

/// The edge times a power of two, and its own length in that scale.
fn axis(edge: &Edge) -> Result<(Vec3<f64>, f64), FrustumError> {
    // Never `None`: an edge is not the zero vector.
    let (axis, _, _) = normalised_by_power(&edge.vector).ok_or(FrustumError::DependentAxes)?;
    let extent: Dyadic = dot(&exact(axis), &edge.vector);
    let extent = extent.to_f64();
    if extent.is_infinite() {
        Err(FrustumError::Overflow { what: edge.name })
    } else if extent == 0.0 {
        Err(FrustumError::Underflow { what: edge.name })
    } else {
        Ok((axis, extent))
    }
}
