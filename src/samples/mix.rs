//! Everyday segments, in seeded mixes: segments as in programs that draw or query the
//! contents of a view.
//!
//! Almost none of them is singular. The cost of clipping them depends on the shares that are
//! outside, inside and cut, and on their order, which is random, so that no branch predictor
//! learns it.

use super::Random;
use crate::frustum::{EndRect, Shape};
use crate::math::{Pose, Real, Segment, Vec3};
use std::fmt;

/// The depth range of the view.
const NEAR: f64 = 1.0;
const FAR: f64 = 100.0;
/// Half-extents per unit of distance: 60 degrees high, 16:9.
const TAN_Y: f64 = 0.577_350_269_189_625_8;
const TAN_X: f64 = TAN_Y * 16.0 / 9.0;

/// A mix of everyday segments, by the shares that are outside, inside and cut.
///
/// ```
/// use frusta::samples::Mix;
/// use frusta::{Class, Frustum};
/// for (_, pose) in Mix::poses() {
///     let frustum = Frustum::new(pose, Mix::shape())?;
///     let segments = Mix::Mixed.segments::<f64>(3_000, &pose);
///     let is_outside = |s| frustum.clip_segment(s).map(|clip| clip.class == Class::Outside);
///     let outside = segments.iter().filter(|s| is_outside(s) == Ok(true)).count();
///     assert!((900..1_100).contains(&outside));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Mix {
    /// Nearly all are outside.
    MostlyOut,
    /// About a third each: outside, inside, cut.
    Mixed,
    /// Most are inside.
    MostlyIn,
    /// Most are cut at both ends.
    LongCrossing,
}

impl Mix {
    /// All mixes, in the order of tables.
    pub const ALL: [Mix; 4] = [Mix::MostlyOut, Mix::Mixed, Mix::MostlyIn, Mix::LongCrossing];

    /// The mix's name, in lower case with hyphens.
    pub const fn name(self) -> &'static str {
        ["mostly-out", "mixed", "mostly-in", "long-crossing"][self as usize]
    }

    /// A description of the mix, in one sentence.
    pub const fn describe(self) -> &'static str {
        [
            "A scene all around the camera: short edges, most of them elsewhere.",
            "Edges of every length in and around the view.",
            "An object in view: short edges, a few of them over the border.",
            "Construction lines and grids: both ends far outside.",
        ][self as usize]
    }

    /// The view of all mixes: symmetric perspective along `-z`, from 1 to 100, 60 degrees
    /// high, 16:9.
    pub fn shape() -> Shape {
        let end = |distance: f64| {
            let (x, y) = (TAN_X * distance, TAN_Y * distance);
            EndRect::new(-distance, -x, x, -y, y)
        };
        Shape::Finite {
            near: end(NEAR),
            far: end(FAR),
        }
    }

    /// Two poses of the view, by name: `frame` is the identity, `world` has another origin
    /// and is rotated about all three axes.
    pub fn poses() -> [(&'static str, Pose); 2] {
        [("frame", Pose::IDENTITY), ("world", turned())]
    }

    /// The first `count` segments, carried from the view's frame to the world by a pose. They
    /// are the same on every machine.
    pub fn segments<T: Real>(self, count: usize, pose: &Pose) -> Vec<Segment<T>> {
        // The seed is the variant's index, so the order of the variants must not change.
        let mut random = Random::new(&[self as u64]);
        let to_world = |v| Vec3::from_f64(pose.to_world(v));
        let mut one = || {
            let s = self.segment(&mut random);
            Segment::new(to_world(s.start), to_world(s.end))
        };
        (0..count).map(|_| one()).collect()
    }

    /// One segment, in the frame.
    fn segment(self, random: &mut Random) -> Segment<f64> {
        let (p, length) = match self {
            Mix::MostlyOut => {
                let all = 1.5 * FAR;
                let p = Vec3::new(
                    random.between(-all, all),
                    random.between(-all, all),
                    random.between(-all, all),
                );
                (p, random.between(1.0, 40.0))
            }
            Mix::Mixed => (near_point(random, 1.25), random.between(1.0, 60.0)),
            Mix::MostlyIn => (near_point(random, 0.98), random.between(0.5, 8.0)),
            Mix::LongCrossing => {
                let p = near_point(random, 1.05);
                let d = direction(random, 1.0);
                let (back, forth) = (random.between(200.0, 900.0), random.between(200.0, 900.0));
                return Segment::new(p - d * back, p + d * forth);
            }
        };
        Segment::new(p, p + direction(random, length))
    }
}

impl fmt::Display for Mix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A pose rotated about all three axes.
fn turned() -> Pose {
    // The rotation of the quaternion (0.8, 0.36, 0.32, 0.36). Its squared length is 1.0016, so
    // the axes are orthonormal only to about three digits.
    let (w, x, y, z) = (0.8_f64, 0.36_f64, 0.32_f64, 0.36_f64);
    let axes = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + w * z),
            2.0 * (x * z - w * y),
        ],
        [
            2.0 * (x * y - w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z + w * x),
        ],
        [
            2.0 * (x * z + w * y),
            2.0 * (y * z - w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ];
    Pose::new(Vec3::new(12.5, -3.75, 41.0), axes.map(Vec3::from))
}

/// A vector of this length in a random direction.
fn direction(random: &mut Random, length: f64) -> Vec3<f64> {
    loop {
        let mut c = || random.between(-1.0, 1.0);
        let v = Vec3::new(c(), c(), c());
        let square = v.dot(v);
        if (0.01..=1.0).contains(&square) {
            return v * (length / square.sqrt());
        }
    }
}

/// A point of the frustum grown about its middle, even in depth.
fn near_point(random: &mut Random, grown: f64) -> Vec3<f64> {
    let middle = 0.5 * (NEAR + FAR);
    let depth = middle + grown * (random.between(NEAR, FAR) - middle);
    let (x, y) = (TAN_X * depth * grown, TAN_Y * depth * grown);
    Vec3::new(random.between(-x, x), random.between(-y, y), -depth)
}
