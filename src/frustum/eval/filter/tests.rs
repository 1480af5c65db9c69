use super::*;
use crate::exact::Number;
use crate::exact::dyadic::Dyadic;
use crate::frustum::eval::boundary::boundary;
use crate::math::Rect;
use crate::{Direction, EndRect, FrustumError};

fn perspective() -> Result<Frustum, FrustumError> {
    Frustum::new(
        Pose::IDENTITY,
        Shape::Finite {
            near: EndRect::new(2.0, -1.0, 1.0, -1.0, 1.0),
            far: EndRect::new(10.0, -5.0, 5.0, -5.0, 5.0),
        },
    )
}

#[test]
fn a_dyadic_frustum_has_a_lattice() -> Result<(), FrustumError> {
    let frustum = perspective()?;
    let filter = frustum.filter();
    let on = |v: [f64; 3]| {
        let p = Vec3::from(v);
        let values = filter.values(p);
        filter.on_lattice(&Segment::new(p, p), &values, &values)
    };
    assert!(on([0.5, 0.25, 3.125]) && on([40.0, -13.0, 0.0]));
    assert!(!on([0.1, 0.25, 3.125]) && !on([1e9, 0.0, 0.0]) && !on([f64::NAN, 0.0, 0.0]));
    Ok(())
}

#[test]
fn values_are_within_the_threshold() -> Result<(), FrustumError> {
    let frusta = [
        perspective()?,
        Frustum::new(
            Pose::new(
                Vec3::new(1e6, 0.1, -3.3),
                [
                    Vec3::new(0.36, 0.48, -0.8),
                    Vec3::new(-0.8, 0.6, 0.0),
                    Vec3::new(0.48, 0.64, 0.6),
                ],
            ),
            Shape::Infinite {
                near: EndRect::new(-0.1, -0.07, 0.03, -0.05, 0.05),
                slopes: Rect::new(-0.7, 0.3, -0.5, 0.5),
                direction: Direction::MinusZ,
            },
        )?,
    ];
    let mut state = 1_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 * exp2(-53) * 20.0 - 10.0
    };
    for frustum in &frusta {
        let filter = frustum.filter();
        for _ in 0..2000 {
            let p = frustum.pose().origin + Vec3::new(next(), next(), next());
            let values = filter.values(p);
            for face in Face::ALL {
                let exact: Dyadic =
                    boundary(frustum, face, p).unwrap_or_else(|never| match never {});
                let t = filter.threshold(face, values.size);
                let g = values.of(face as usize);
                if g.abs() > t {
                    let sign = g.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
                    assert_eq!(exact.sign(), sign, "{face} at {p}");
                }
            }
        }
    }
    Ok(())
}

/// There is no lattice if the rounded slopes are not exact, however few bits they have.
#[test]
fn a_lattice_needs_exact_slopes() -> Result<(), FrustumError> {
    for (depth, far_left) in [
        // 1/3 is not representable.
        (3.0, -2.0),
        // The slope rounds to 1 over the depth; the rounding error is in the low part.
        (1.0, 2.0_f64.powi(-70)),
        // Or the low part underflows, too.
        (1024.0, 5e-324),
    ] {
        let shape = Shape::Finite {
            near: EndRect::new(0.0, -1.0, 2.0, -1.0, 1.0),
            far: EndRect::new(depth, far_left, 2.0, -1.0, 1.0),
        };
        let frustum = Frustum::new(Pose::IDENTITY, shape)?;
        assert_eq!(frustum.filter().lattice, None, "{far_left}");
    }
    Ok(())
}

/// There is none if the filter itself does not apply.
#[test]
fn a_lattice_needs_the_range_of_the_filter() -> Result<(), FrustumError> {
    for (scale, some) in [
        (1.0, true),
        (exp2(390), true),
        (exp2(410), false),
        (exp2(-410), false),
    ] {
        let shape = Shape::Finite {
            near: EndRect::new(0.0, -scale, scale, -scale, scale),
            far: EndRect::new(scale, -scale, scale, -scale, scale),
        };
        let filter = Filter::new(&Pose::IDENTITY, &shape);
        assert_eq!(
            (filter.limit > 0.0, filter.lattice.is_some()),
            (some, some),
            "{scale:e}"
        );
    }
    Ok(())
}

/// Seeded numbers of all magnitudes.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) % n
    }

    /// Either sign, all bits of the mantissa, magnitude near 2^exponent.
    fn of_size(&mut self, exponent: i32) -> f64 {
        let mantissa = (self.below(1 << 26) << 26 | self.below(1 << 26)) as f64 * exp2(-52);
        let sign = if self.below(2) == 0 { 1.0 } else { -1.0 };
        sign * (1.0 + mantissa) * exp2(exponent)
    }

    fn exponent(&mut self, range: i32) -> i32 {
        self.below(2 * range.unsigned_abs() as u64 + 1) as i32 - range
    }

    /// Zero in half of the calls.
    fn maybe(&mut self, exponent: i32) -> f64 {
        if self.below(2) == 0 {
            0.0
        } else {
            self.of_size(exponent)
        }
    }

    fn rect(&mut self, exponent: i32) -> Rect {
        let mut side = |_| self.maybe(exponent);
        let [a, b, c, d] = [0, 1, 2, 3].map(&mut side);
        Rect::new(a.min(b), a.max(b), c.min(d), c.max(d))
    }

    /// A shape in which each group of numbers has a magnitude of its own.
    fn shape(&mut self, range: i32) -> Shape {
        let (e, f, z) = (
            self.exponent(range),
            self.exponent(range),
            self.exponent(range),
        );
        let (near_z, rect, other) = (self.maybe(z), self.rect(e), self.rect(f));
        let near = EndRect { z: near_z, rect };
        if self.below(2) == 0 {
            let direction = if self.below(2) == 0 {
                Direction::PlusZ
            } else {
                Direction::MinusZ
            };
            Shape::Infinite {
                near,
                slopes: other,
                direction,
            }
        } else {
            let other = if self.below(3) == 0 { rect } else { other };
            let depth = self.exponent(range);
            Shape::Finite {
                near,
                far: EndRect {
                    z: near_z + self.of_size(depth),
                    rect: other,
                },
            }
        }
    }

    fn pose(&mut self, range: i32) -> Pose {
        if self.below(4) == 0 {
            return Pose::IDENTITY;
        }
        let dense = self.below(2) == 0;
        let turn = self.below(3) as usize;
        let o = self.exponent(range);
        let origin = Vec3::new(self.maybe(o), self.maybe(o), self.maybe(o));
        let axes = [0, 1, 2].map(|k| {
            let e = self.exponent(range.min(250));
            let axis: [f64; 3] = std::array::from_fn(|j| {
                if dense || (k + turn) % 3 == j {
                    self.of_size(e)
                } else {
                    0.0
                }
            });
            Vec3::from(axis)
        });
        Pose::new(origin, axes)
    }

    /// A point on a face, up to rounding.
    fn point_near_face(&mut self, frustum: &Frustum, face: Face, range: i32) -> Option<Vec3<f64>> {
        let shape = frustum.shape();
        let near = shape.near();
        let sigma = shape.direction().sign();
        let size = self.exponent(range);
        let depth = match shape.far() {
            Some(far) if self.below(2) == 0 => (far.z - near.z).abs() * self.of_size(-1).abs(),
            _ => self.of_size(size).abs(),
        };
        let bound = |side: usize, w: f64| {
            let filter = frustum.filter();
            filter.at_near[side] + filter.slope[side] * w
        };
        let w = match face {
            Face::Near => 0.0,
            Face::Far => (shape.far()?.z - near.z).abs(),
            _ => depth,
        };
        let mut target = [
            bound(usize::from(face == Face::Right), w),
            bound(2 + usize::from(face == Face::Top), w),
            near.z + sigma * w,
        ];
        // An arbitrary position along the face.
        match face {
            Face::Bottom | Face::Top => target[0] = self.of_size(size),
            Face::Left | Face::Right => target[1] = self.of_size(size),
            Face::Near | Face::Far => target = [self.of_size(size), self.of_size(size), target[2]],
        }
        let mut p = solve(frustum.pose(), target);
        if self.below(2) == 0 {
            // Moved by between an ulp and the filter's threshold.
            let relative = -self.exponent(9) - 44;
            p.x += p.x * self.of_size(relative);
        }
        p.is_finite().then_some(p)
    }
}

/// A point with about these frame coordinates.
fn solve(pose: &Pose, [x, y, z]: [f64; 3]) -> Vec3<f64> {
    if pose.is_identity() {
        return Vec3::new(x, y, z);
    }
    // Axes of about unit length, so that the determinant stays in range.
    let scale = |a: Vec3<f64>| a.x.abs().max(a.y.abs()).max(a.z.abs());
    let [a, b, c] = pose.axes.map(|a| a * (1.0 / scale(a)));
    let [x, y, z] = [
        x / scale(pose.axes[0]),
        y / scale(pose.axes[1]),
        z / scale(pose.axes[2]),
    ];
    let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
    pose.origin + (bc * x + ca * y + ab * z) * (1.0 / a.dot(bc))
}

/// The number of certain signs next to a face, by the filter and by double-double; all of
/// them must be right.
fn check_next_to(frustum: &Frustum, face: Face, p: Vec3<f64>) -> [u32; 2] {
    let filter = frustum.filter();
    let values = filter.values(p);
    let signs = [
        filter.sign(face, &values),
        filter.precise_sign(face, p, &values),
    ];
    if signs == [None, None] {
        return [0, 0];
    }
    let exact: Dyadic = boundary(frustum, face, p).unwrap_or_else(|never| match never {});
    signs.map(|sign| match sign {
        None => 0,
        Some(sign) => {
            assert_eq!(
                sign,
                exact.sign(),
                "{signs:?}, {face} at {p:?}: {frustum:?}"
            );
            1
        }
    })
}

/// Certain signs of the filter and of double-double are right, whatever the magnitudes of a
/// frustum's numbers, next to its faces and at the ends of the number range.
#[test]
fn certain_signs_are_right() {
    let mut n = Numbers(1);
    let mut certain = [0, 0];
    for round in 0..60_000 {
        let range = [3, 40, 440, 900][round % 4];
        let (pose, shape) = (n.pose(range), n.shape(range));
        let Ok(frustum) = Frustum::new(pose, shape) else {
            continue;
        };
        for &face in frustum.faces() {
            if let Some(p) = n.point_near_face(&frustum, face, range) {
                let [filtered, precise] = check_next_to(&frustum, face, p);
                certain = [certain[0] + filtered, certain[1] + precise];
            }
        }
    }
    assert!(certain[0] > 20_000 && certain[1] > 20_000, "{certain:?}");
}

/// A frustum without a size of its own, at points so close that its values are subnormal.
#[test]
fn values_that_underflow_are_not_certain() -> Result<(), FrustumError> {
    let mut n = Numbers(2);
    for _ in 0..5000 {
        let shape = Shape::Infinite {
            near: EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0),
            slopes: Rect::new(-n.of_size(0).abs(), n.of_size(0).abs(), -1.0, 1.0),
            direction: Direction::PlusZ,
        };
        let axes = [0, 1, 2].map(|_| Vec3::new(n.of_size(-190), n.of_size(-190), n.of_size(-190)));
        let frustum = Frustum::new(Pose::new(Vec3::default(), axes), shape)?;
        // In world coordinates of about 2^-840.
        let along = Vec3::new(n.of_size(-840), n.of_size(-840), n.of_size(-840));
        for &face in frustum.faces() {
            let axis = match face {
                Face::Near => axes[2],
                Face::Left => axes[0] + axes[2] * frustum.filter().slope[0].abs(),
                _ => continue,
            };
            // Onto the plane, up to rounding.
            let p = along - axis * (axis.dot(along) / axis.dot(axis));
            check_next_to(&frustum, face, p);
        }
    }
    Ok(())
}
