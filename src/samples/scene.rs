//! The frusta of the families, with their features for aiming.

use super::family::Family;
use super::placement::Placement;
use super::random::Random;
use super::solid::{Solid, grid_point};
use super::stiff;
use crate::frustum::{Direction, EndRect, Frustum, Shape};
use crate::math::{Pose, Real, Rect, Vec3};

/// The frustum of a block of cases, with its features for aiming.
#[derive(Clone, Debug)]
pub struct Scene {
    frustum: Frustum,
    /// The shape before it is placed.
    shape: Shape,
    placed: Placed,
    /// The index of the solid, if the frustum is the image of one.
    solid: Option<usize>,
    /// The depth at which the grid ends in an infinite frustum.
    reach: f64,
}

/// The position of the frame in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Placed {
    /// An exact placement; the shape is scaled with the axes.
    Exactly(Placement),
    /// A pose, with the rounded columns of the inverse of its matrix.
    By { pose: Pose, columns: [Vec3<f64>; 3] },
}

impl Scene {
    pub(crate) fn new(family: Family, seed: u64, block: u64) -> Self {
        // A few kinds of random shape may be degenerate; try again.
        (0..16)
            .find_map(|attempt| Self::attempt(family, seed, block, attempt))
            .unwrap_or_else(Self::fallback)
    }

    pub(crate) fn attempt(family: Family, seed: u64, block: u64, attempt: u64) -> Option<Self> {
        let mut random = Random::new(&[family as u64, seed, block, attempt, 1]);
        let random = &mut random;
        if let Some((solid, placement)) = sampled(family, random) {
            let mut scene = Self::placed(Solid::ALL[solid].shape, placement)?;
            scene.solid = Some(solid);
            return Some(scene);
        }
        let mut shape = stiff::shape(family, block, random);
        if stiff::is_ordinary(family) && random.one_in(2) {
            // Points of f32 can then lie exactly on its faces.
            shape = shape_in_f32(&shape);
        }
        match stiff::pose(family, block, random) {
            Some(pose) => Self::posed(shape, pose),
            None => Self::placed(shape, stiff::placement(family, random)),
        }
    }

    fn placed(shape: Shape, placement: Placement) -> Option<Self> {
        let frustum = placement.frustum(&shape).ok()?;
        Some(Self {
            frustum,
            shape,
            placed: Placed::Exactly(placement),
            solid: None,
            reach: reach(&shape),
        })
    }

    fn posed(shape: Shape, pose: Pose) -> Option<Self> {
        let frustum = Frustum::new(pose, shape).ok()?;
        let [a, b, c] = pose.axes;
        let det = a.dot(b.cross(c));
        let columns = [b.cross(c), c.cross(a), a.cross(b)].map(|v| v * (1.0 / det));
        columns.iter().all(|c| c.is_finite()).then_some(Self {
            frustum,
            shape,
            placed: Placed::By { pose, columns },
            solid: None,
            reach: reach(&shape),
        })
    }

    fn fallback() -> Self {
        let shape = Solid::SYMMETRIC.shape;
        Self::placed(shape, Placement::IDENTITY)
            .unwrap_or_else(|| unreachable!("the symmetric solid is a valid frustum"))
    }

    /// The frustum.
    pub fn frustum(&self) -> &Frustum {
        &self.frustum
    }

    /// The index in [`Solid::ALL`] of the solid, if the frustum is the image of one.
    pub(crate) fn solid(&self) -> Option<usize> {
        self.solid
    }

    /// The point with these frame coordinates (before placement), rounded if it is not
    /// representable.
    pub(crate) fn world(&self, c: Vec3<f64>) -> Vec3<f64> {
        match self.placed {
            Placed::Exactly(placement) => placement.point(c),
            Placed::By { pose, columns } => {
                let [x, y, z] = columns;
                pose.origin + (x * c.x + y * c.y + z * c.z)
            }
        }
    }

    /// The point with these grid coordinates: see [`Solid`].
    pub(crate) fn at(&self, grid: [f64; 3]) -> Vec3<f64> {
        self.world(grid_point(&self.shape, self.reach, grid))
    }
}

/// The depth at which the grid ends in an infinite frustum: a few times the near end's width,
/// or its depth if it is a point, so that the grid has the frustum's own scale.
fn reach(shape: &Shape) -> f64 {
    let EndRect { z, rect: near } = shape.near();
    let width = (near.right - near.left).max(near.top - near.bottom);
    let sizes = [width, z.abs(), 1.0];
    4.0 * sizes.into_iter().find(|&s| s > 0.0).unwrap_or(1.0)
}

/// The shape with every number rounded to `f32`.
fn shape_in_f32(shape: &Shape) -> Shape {
    let to_f32 = |v: f64| f64::from(f32::from_f64(v));
    let rect = |r: Rect| {
        let [left, right, bottom, top] = r.to_array().map(to_f32);
        Rect::new(left, right, bottom, top)
    };
    let end = |e: EndRect| EndRect {
        z: to_f32(e.z),
        rect: rect(e.rect),
    };
    match *shape {
        Shape::Finite { near, far } => Shape::Finite {
            near: end(near),
            far: end(far),
        },
        Shape::Infinite {
            near,
            slopes,
            direction,
        } => Shape::Infinite {
            near: end(near),
            slopes: rect(slopes),
            direction,
        },
    }
}

/// The solid and the placement of a block of a sample-based family.
fn sampled(family: Family, random: &mut Random) -> Option<(usize, Placement)> {
    let permuted = |random: &mut Random| random.pick(&Placement::signed_permutations());
    let rotated = |random: &mut Random| {
        let mut entry = || random.integer(-5, 5) as i8;
        // The first entry is never zero.
        Placement::rotated([1 + entry().abs(), entry(), entry(), entry()])
    };
    let moved = |random: &mut Random, placement: Placement| {
        let mut entry = || random.integer(-40, 40) as f64;
        placement.moved_to(Vec3::new(entry(), entry(), entry()))
    };
    let placement = match family {
        Family::Bumps | Family::Swapped | Family::Collinear => match random.below(4) {
            0 => permuted(random),
            _ => Placement::IDENTITY,
        },
        Family::Permuted => permuted(random),
        Family::Rotated | Family::CrossingEqual => {
            let placement = rotated(random);
            match random.below(3) {
                0 => placement,
                1 => moved(random, placement),
                _ => permuted(random),
            }
        }
        Family::Scaled => {
            let placement = match random.below(3) {
                0 => rotated(random),
                _ => permuted(random),
            };
            let placement = moved(random, placement);
            placement.scaled(random.integer(-60, 60) as i16)
        }
        _ => return None,
    };
    let solid = random.below(Solid::ALL.len() as u64) as usize;
    Some((solid, placement))
}

// Ordinary shapes.

/// A shape of any ordinary kind.
pub(crate) fn any_shape(random: &mut Random) -> Shape {
    match random.below(6) {
        0 => perspective(random),
        1 | 2 => off_axis(random),
        3 => orthographic(random),
        4 => pyramid(random),
        _ => infinite(random),
    }
}

/// A rectangle with corners up to `size` from the axis.
pub(crate) fn any_rect(random: &mut Random, size: f64) -> Rect {
    let mut pair = || {
        let (a, b) = (random.between(-size, size), random.between(-size, size));
        (a.min(b), a.max(b))
    };
    let ((left, right), (bottom, top)) = (pair(), pair());
    Rect::new(left, right, bottom, top)
}

/// Two depths, in either order and on either side of zero.
fn depths(random: &mut Random) -> (f64, f64) {
    let (a, b) = (random.between(0.1, 10.0), random.between(0.5, 90.0));
    let sign = random.sign();
    if random.one_in(3) {
        (sign * a, -sign * b)
    } else {
        (sign * a, sign * (a + b))
    }
}

pub(crate) fn finite(near: f64, near_rect: Rect, far: f64, far_rect: Rect) -> Shape {
    let end = |z, rect| EndRect { z, rect };
    Shape::Finite {
        near: end(near, near_rect),
        far: end(far, far_rect),
    }
}

/// A symmetric perspective shape with its apex at the origin.
fn perspective(random: &mut Random) -> Shape {
    let (w, h) = (random.between(0.1, 2.0), random.between(0.1, 2.0));
    let (near, far) = (random.between(0.1, 5.0), random.between(6.0, 90.0));
    let sign = random.sign();
    symmetric(sign * near, sign * far, w, h)
}

/// A shape with half-extents proportional to depth.
pub(crate) fn symmetric(near: f64, far: f64, w: f64, h: f64) -> Shape {
    let rect = |z: f64| Rect::centred(z.abs() * w, z.abs() * h);
    finite(near, rect(near), far, rect(far))
}

pub(crate) fn off_axis(random: &mut Random) -> Shape {
    let (near, far) = depths(random);
    let (a, b) = (any_rect(random, 8.0), any_rect(random, 40.0));
    finite(near, a, far, b)
}

pub(crate) fn orthographic(random: &mut Random) -> Shape {
    let (near, far) = depths(random);
    let rect = any_rect(random, 20.0);
    finite(near, rect, far, rect)
}

pub(crate) fn pyramid(random: &mut Random) -> Shape {
    let (near, far) = depths(random);
    let (mut a, mut b) = (any_rect(random, 8.0), any_rect(random, 40.0));
    match random.below(3) {
        // An apex.
        0 => a = Rect::new(a.left, a.left, a.top, a.top),
        // An edge.
        1 => a.right = a.left,
        // An edge at each end: a tetrahedron.
        _ => {
            a.right = a.left;
            b.top = b.bottom;
        }
    }
    if random.one_in(2) {
        finite(near, a, far, b)
    } else {
        finite(near, b, far, a)
    }
}

pub(crate) fn infinite(random: &mut Random) -> Shape {
    let (near, _) = depths(random);
    let mut rect = any_rect(random, 8.0);
    let mut slopes = any_rect(random, 2.0);
    match random.below(4) {
        // From a point.
        0 => rect = Rect::new(rect.left, rect.left, rect.top, rect.top),
        // Parallel sides.
        1 => slopes.right = slopes.left,
        2 => slopes = Rect::default(),
        _ => {}
    }
    Shape::Infinite {
        near: EndRect { z: near, rect },
        slopes,
        direction: if random.one_in(2) {
            Direction::PlusZ
        } else {
            Direction::MinusZ
        },
    }
}
