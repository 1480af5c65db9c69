//! The volumes of the families.
//!
//! Two convex sets touch if a plane through a common point has one of them on each side.
//! So a touching volume starts from a [`Contact`]: a point of the frustum's surface and
//! the normal of such a plane, between the normals of the faces that meet there. A
//! corner of a box is placed at the point, and the box extends in the direction of the
//! normal. If the normals of two faces have components of opposite signs along a box's
//! edge, a plane between them contains the edge, and the box extends both ways along it:
//! the only plane that separates the two is that of the two edges. The same holds for a
//! box's face on a vertex.
//!
//! With the opposite normal the same volume is inside and touches the surface from
//! there, if it is small enough for the other faces. Finally every number is moved by
//! up to 4 ulp.

use super::random::Random;
use super::scene::Scene;
use super::segments::{Aim, largest, tidied};
use super::solid::BOUNDS;
use crate::cull::{Aabb, Obb, Sphere};
use crate::frustum::{Face, FaceSet, Frustum, Shape};
use crate::math::{Pose, Real, Vec3};

/// An axis-aligned box for a scene, determined by the scene, a seed and an index.
///
/// More than half of these boxes are within 4 ulp of touching the frustum, with a
/// corner, an edge or a face at a vertex, an edge or a face, from outside or from
/// inside; or of touching the plane of a face, beside the face. The others have all sizes
/// from a point to larger than the frustum; some are flat, some contain the whole
/// frustum, some are beyond an edge, so that no face's plane separates them from it. All
/// are valid: finite and not inverted.
///
/// ```
/// use frusta::samples::{BLOCK, Family, hard_box};
/// let index = 1_000_000;
/// let scene = Family::OffAxis.scene(7, index / BLOCK);
/// assert!(hard_box::<f64>(&scene, 7, index).check().is_ok());
/// assert!(hard_box::<f32>(&scene, 7, index).check().is_ok());
/// ```
pub fn hard_box<T: Real>(scene: &Scene, seed: u64, index: u64) -> Aabb<T> {
    let mut random = Random::new(&[seed, index, 3]);
    let mut aim = Aim {
        scene,
        random: &mut random,
    };
    let shape = if aim.random.one_in(16) {
        aim.bounds()
    } else {
        let [x, y, z] = aim.extents::<T>();
        let axes = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        aim.aimed::<T>(axes.map(Vec3::from)).aligned()
    };
    let ends = [shape.min, shape.max].map(|end| aim.moved(Vec3::from_f64(end)));
    // The moved ends may be in the other order.
    Aabb::around(ends).unwrap_or_default()
}

/// An oriented box for a scene, as [`hard_box`] for axis-aligned ones. Its half axes are
/// along the world's or the frustum's axes, rotated, skew, dependent or zero.
///
/// ```
/// use frusta::samples::{BLOCK, Family, hard_obb};
/// let scene = Family::Pyramid.scene(7, 20 / BLOCK);
/// assert!(hard_obb::<f64>(&scene, 7, 20).check().is_ok());
/// ```
pub fn hard_obb<T: Real>(scene: &Scene, seed: u64, index: u64) -> Obb<T> {
    let mut random = Random::new(&[seed, index, 4]);
    let mut aim = Aim {
        scene,
        random: &mut random,
    };
    let shape = if aim.random.one_in(16) {
        Obb::from(aim.bounds())
    } else {
        let half_axes = aim.half_axes::<T>();
        aim.aimed::<T>(half_axes).oriented()
    };
    let mut moved = |v| aim.moved(Vec3::from_f64(v));
    Obb {
        center: moved(shape.center),
        half_axes: shape.half_axes.map(moved),
    }
}

/// A sphere for a scene, as [`hard_box`] for boxes.
///
/// ```
/// use frusta::samples::{BLOCK, Family, hard_sphere};
/// let scene = Family::Infinite.scene(7, 20 / BLOCK);
/// assert!(hard_sphere::<f64>(&scene, 7, 20).check().is_ok());
/// ```
pub fn hard_sphere<T: Real>(scene: &Scene, seed: u64, index: u64) -> Sphere<T> {
    let mut random = Random::new(&[seed, index, 5]);
    let mut aim = Aim {
        scene,
        random: &mut random,
    };
    let (center, radius) = aim.sphere::<T>();
    let center = aim.moved(Vec3::from_f64(center));
    // The radius is moved as a vector, like the other numbers.
    let radius = aim.moved(Vec3::new(T::from_f64(radius), T::ZERO, T::ZERO));
    Sphere {
        center,
        radius: radius.x.abs(),
    }
}

/// A point at which a volume may touch the frustum.
struct Contact {
    at: Vec3<f64>,
    /// The normals of the faces that meet there, outwards.
    normals: Vec<Vec3<f64>>,
}

/// The faces whose planes contain a grid point.
fn faces_at(shape: &Shape, grid: [f64; 3]) -> FaceSet {
    let mut faces = FaceSet::EMPTY;
    for (k, c) in grid.into_iter().enumerate() {
        let end = [0.0, 1.0].into_iter().position(|end| c == end);
        faces.extend(end.map(|end| BOUNDS[k][end]));
    }
    // Both sides meet where an end shrinks to an edge.
    let end = match grid[2] {
        0.0 => Some(shape.near()),
        1.0 => shape.far(),
        _ => None,
    };
    if let Some(end) = end {
        let sides = end.rect.to_array();
        for k in [0, 1] {
            if sides[2 * k] == sides[2 * k + 1] {
                faces.extend(BOUNDS[k]);
            }
        }
    }
    if shape.far().is_none() {
        faces.remove(Face::Far);
    }
    faces
}

/// The outward normal of a face, rounded, of magnitude 1 in its largest coordinate.
fn outward(frustum: &Frustum, face: Face) -> Vec3<f64> {
    let (shape, pose) = (frustum.shape(), frustum.pose());
    let depthward = shape.direction().sign();
    let side = |side: usize| {
        let near = shape.near();
        // How far the bound moves, over what depth.
        let (rise, depth) = match *shape {
            Shape::Finite { far, .. } => {
                let [n, f] = [near, far].map(|end| end.rect.to_array()[side]);
                (f - n, (far.z - near.z).abs())
            }
            Shape::Infinite { slopes, .. } => (slopes.to_array()[side], 1.0),
        };
        let sign = if side.is_multiple_of(2) { -1.0 } else { 1.0 };
        let mut normal = Vec3::new(0.0, 0.0, -rise * depthward);
        normal[side / 2] = depth;
        unit(normal) * sign
    };
    let n = match face {
        Face::Near => Vec3::new(0.0, 0.0, -depthward),
        Face::Far => Vec3::new(0.0, 0.0, depthward),
        Face::Left => side(0),
        Face::Right => side(1),
        Face::Bottom => side(2),
        Face::Top => side(3),
    };
    let [a, b, c] = pose.axes;
    unit(a * n.x + b * n.y + c * n.z)
}

/// The vector with a largest coordinate of magnitude 1; zero stays.
fn unit(v: Vec3<f64>) -> Vec3<f64> {
    let size = largest(v);
    if size > 0.0 {
        Vec3::from(v.to_array().map(|c| c / size))
    } else {
        v
    }
}

/// A box with the point `at` at the position `sides` within the box, each in -1..=1.
struct Aimed {
    at: Vec3<f64>,
    half_axes: [Vec3<f64>; 3],
    sides: [f64; 3],
}

impl Aimed {
    /// The axis-aligned box, for half axes along the coordinates. An end at the point has
    /// the point's coordinate exactly.
    fn aligned(&self) -> Aabb<f64> {
        let end = |sign: f64| {
            let offset = |j: usize| self.half_axes[j][j] * (sign - self.sides[j]);
            self.at + Vec3::new(offset(0), offset(1), offset(2))
        };
        Aabb::new(end(-1.0), end(1.0))
    }

    fn oriented(&self) -> Obb<f64> {
        let sides = self.half_axes.into_iter().zip(self.sides);
        Obb {
            center: sides.fold(self.at, |c, (h, side)| h.times_plus(-side, c)),
            half_axes: self.half_axes,
        }
    }
}

impl Aim<'_> {
    /// The point, unchanged or moved by up to 4 ulp; finite.
    fn moved<T: Real>(&mut self, p: Vec3<T>) -> Vec3<T> {
        let p = self.bumped(p, 4);
        Vec3::from(p.to_array().map(|c| tidied(c, self.random)))
    }

    /// Half a box's extent: zero, some ulps, a part of the frustum's size, or more.
    fn extent<T: Real>(&mut self) -> f64 {
        let size = self.size();
        match self.random.below(8) {
            0 => 0.0,
            1 => {
                let at = largest(self.scene.at([0.5, 0.5, 0.5]));
                at * T::UNIT_ROUNDOFF * self.random.integer(1, 8) as f64
            }
            2 => size * 2.0_f64.powi(self.random.integer(0, 3) as i32),
            3 => size * self.random.unit(),
            _ => size * 0.5_f64.powi(self.random.integer(1, 12) as i32),
        }
    }

    fn extents<T: Real>(&mut self) -> [f64; 3] {
        if self.random.one_in(2) {
            [self.extent::<T>(); 3]
        } else {
            [(); 3].map(|()| self.extent::<T>())
        }
    }

    /// Half axes of an oriented box.
    fn half_axes<T: Real>(&mut self) -> [Vec3<f64>; 3] {
        let mut any = || Vec3::from([(); 3].map(|()| self.random.between(-1.0, 1.0)));
        let (a, b, c) = (any(), any(), any());
        let pose = self.scene.frustum().pose();
        let axes = match self.random.below(6) {
            0 => Pose::IDENTITY.axes,
            // Along the frustum's axes, or perpendicular to two of them.
            1 => pose.axes,
            2 => {
                let [x, y, z] = pose.axes;
                [y.cross(z), z.cross(x), x.cross(y)]
            }
            // Orthogonal axes.
            3 => [a, a.cross(b), a.cross(b).cross(a)],
            // Short numbers, for exact sums.
            4 => [a, b, c].map(|v| Vec3::from(v.to_array().map(|c| (8.0 * c).round()))),
            _ => [a, b, c],
        };
        let extents = self.extents::<T>();
        let mut axes = [0, 1, 2].map(|k| unit(axes[k]) * extents[k]);
        if self.random.one_in(8) {
            // A parallelogram, or a degenerate one.
            axes[2] = self
                .random
                .pick(&[axes[0], axes[1] - axes[0], -axes[1] * 0.5]);
        }
        axes
    }

    /// The bounding box of the frustum: all of its faces touch.
    fn bounds(&mut self) -> Aabb<f64> {
        let corners = self.corners();
        Aabb::around(corners).unwrap_or_default()
    }

    fn corners(&self) -> [Vec3<f64>; 8] {
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
            let bit = |k: u32| f64::from(i >> k & 1);
            self.scene.at([bit(0), bit(1), bit(2)])
        })
    }

    /// A contact at a vertex, an edge or a face; sometimes in the plane of a face, beside it.
    fn contact<T: Real>(&mut self) -> Contact {
        let frustum = self.scene.frustum();
        loop {
            let mut grid = self.grid();
            let faces = faces_at(frustum.shape(), grid);
            if faces.is_empty() {
                continue;
            }
            if faces.len() == 1 && self.random.one_in(3) {
                for (c, ends) in grid.iter_mut().zip(BOUNDS) {
                    if !ends.iter().any(|f| faces.contains(*f)) && self.random.one_in(2) {
                        *c = self.random.pick(&[-0.5, 1.5]);
                    }
                }
            }
            return Contact {
                at: self.at::<T>(grid).to_f64(),
                normals: faces.into_iter().map(|f| outward(frustum, f)).collect(),
            };
        }
    }

    /// A contact with one face alone.
    fn contact_with_face<T: Real>(&mut self) -> Contact {
        loop {
            let contact = self.contact::<T>();
            if contact.normals.len() == 1 {
                return contact;
            }
        }
    }

    /// A random normal between those of a contact; in half of the calls one of them.
    fn between(&mut self, contact: &Contact) -> Vec3<f64> {
        if self.random.one_in(2) {
            return self.random.pick(&contact.normals);
        }
        let normals = contact.normals.iter();
        normals.fold(Vec3::default(), |sum, n| {
            n.times_plus(self.random.unit(), sum)
        })
    }

    /// A box at a random position, in most cases one at which it touches.
    fn aimed<T: Real>(&mut self, mut half_axes: [Vec3<f64>; 3]) -> Aimed {
        let contact = self.contact::<T>();
        let mut at = contact.at;
        let normal = match self.random.below(18) {
            0 | 1 => {
                let (at, sides) = (self.around(), [0.0; 3]);
                return Aimed {
                    at,
                    half_axes,
                    sides,
                };
            }
            // Beyond an edge.
            2 | 3 => {
                let normal = self.across(&contact, &half_axes);
                let gap = self.size() * 0.5_f64.powi(self.random.integer(4, 24) as i32);
                at = unit(normal).times_plus(gap, at);
                normal
            }
            // An edge on an edge.
            4..=7 => self.across(&contact, &half_axes),
            // A face on a vertex.
            8 | 9 => {
                let normal = self.face(&half_axes);
                at = Vec3::<T>::from_f64(self.farthest(normal)).to_f64();
                normal
            }
            // From inside.
            10 | 11 => {
                let less = 0.5_f64.powi(self.random.integer(2, 16) as i32);
                half_axes = half_axes.map(|h| unit(h) * (self.size() * less));
                let contact = self.contact_with_face::<T>();
                at = contact.at;
                -self.between(&contact)
            }
            // A corner.
            _ => self.between(&contact),
        };
        Aimed {
            at,
            half_axes,
            sides: half_axes.map(|h| self.side(normal, h)),
        }
    }

    /// A normal between two of a contact's that is perpendicular to one of the half axes; any
    /// between them if there is none.
    fn across(&mut self, contact: &Contact, half_axes: &[Vec3<f64>; 3]) -> Vec3<f64> {
        let first = self.random.below(3) as usize;
        let normals = &contact.normals;
        for k in 0..3 {
            let along = unit(half_axes[(first + k) % 3]);
            let slopes: Vec<f64> = normals.iter().map(|n| n.dot(along)).collect();
            let down = slopes.iter().position(|s| *s < 0.0);
            let up = slopes.iter().position(|s| *s > 0.0);
            if let Some((a, b)) = down.zip(up) {
                return normals[a] * slopes[b] - normals[b] * slopes[a];
            }
        }
        self.between(contact)
    }

    /// The normal of a box's face, with a random sign.
    fn face(&mut self, half_axes: &[Vec3<f64>; 3]) -> Vec3<f64> {
        let [a, b, c] = half_axes.map(unit);
        let normal = self.random.pick(&[a.cross(b), b.cross(c), c.cross(a)]);
        unit(normal) * self.random.sign()
    }

    /// The corner that is farthest in a direction.
    fn farthest(&self, direction: Vec3<f64>) -> Vec3<f64> {
        let [first, others @ ..] = self.corners();
        let along = |p: Vec3<f64>| direction.dot(p);
        others.into_iter().fold(
            first,
            |best, p| {
                if along(p) > along(best) { p } else { best }
            },
        )
    }

    /// The position of the point along a half axis: on the side opposite to the normal, or at
    /// random between the sides if the two are perpendicular.
    fn side(&mut self, normal: Vec3<f64>, half_axis: Vec3<f64>) -> f64 {
        let slope = unit(normal).dot(unit(half_axis));
        if slope.abs() <= 4.0 * f64::EPSILON {
            self.random.between(-1.0, 1.0)
        } else {
            -slope.signum()
        }
    }

    /// Centre and radius of a sphere.
    fn sphere<T: Real>(&mut self) -> (Vec3<f64>, f64) {
        let mut contact = self.contact::<T>();
        let normal = match self.random.below(16) {
            0 | 1 => return (self.around(), self.extent::<T>()),
            2 => {
                // Around most of the frustum.
                let middle = self.scene.at([0.5, 0.5, 0.5]);
                return (middle, self.size() * self.random.between(0.5, 2.0));
            }
            // A normal of integers with an integer length.
            3..=6 => self.short(&contact),
            // From inside.
            7..=9 => {
                contact = self.contact_with_face::<T>();
                -self.between(&contact)
            }
            _ => self.between(&contact),
        };
        let length = normal.dot(normal).sqrt();
        let size = power_of_two(self.extent::<T>());
        (normal.times_plus(size, contact.at), length * size)
    }

    /// A vector of integers with an integer length that points away from the frustum, if one
    /// is found.
    fn short(&mut self, contact: &Contact) -> Vec3<f64> {
        const SHORT: [[f64; 3]; 5] = [
            [1.0, 0.0, 0.0],
            [0.0, 3.0, 4.0],
            [1.0, 2.0, 2.0],
            [2.0, 3.0, 6.0],
            [1.0, 4.0, 8.0],
        ];
        let corners = self.corners().map(|c| unit(c - contact.at));
        for _ in 0..16 {
            let v = self.random.pick(&SHORT);
            let turn = self.random.below(3) as usize;
            let v = Vec3::from([0, 1, 2].map(|k| v[(k + turn) % 3] * self.random.sign()));
            if corners.iter().all(|c| c.dot(v) <= 0.0) {
                return v;
            }
        }
        self.between(contact)
    }
}

/// The largest power of two that is not above, so that short numbers stay short; zero and
/// subnormals are unchanged.
fn power_of_two(size: f64) -> f64 {
    let power = f64::from_bits(size.to_bits() & f64::INFINITY.to_bits());
    if power > 0.0 { power } else { size }
}
