//! The input, from a seed.

use crate::quads::Quad;
use frusta::samples::Random;
use frusta::{Pose, Real, Segment, Vec3};
use frusta_lab::mixes::{COUNT, Mix};

/// A source of segments.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source {
    /// Ends on half-integer points between these, in halves: most cases are singular.
    HalfLattice([[i64; 2]; 3]),
    /// Ends anywhere from -3 to 3.
    Uniform,
    /// A mix of frusta's own benchmarks, in the world of a pose; all at one `z`, if one is given.
    Mix(Mix, Pose, Option<f64>),
}

impl Source {
    /// Around the cube from -1 to 1.
    pub(crate) const AROUND_CUBE: Self = Self::HalfLattice([[-6, 6]; 3]);
    /// Around its window.
    pub(crate) const AROUND_WINDOW: Self = Self::HalfLattice([[-6, 6], [-6, 6], [0, 0]]);
    /// Around [`Camera::LATTICE`](crate::scene::Camera::LATTICE), behind its apex, too.
    pub(crate) const AROUND_FRUSTUM: Self = Self::HalfLattice([[-8, 8], [-8, 8], [-2, 8]]);

    /// Whether it is a mix.
    pub(crate) const fn is_mix(&self) -> bool {
        matches!(self, Self::Mix(..))
    }

    /// The first segments from it; a mix has at most [`COUNT`].
    pub(crate) fn segments<T: Real>(&self, seed: u64, count: usize) -> Vec<Segment<T>> {
        let single = |p: [f64; 3]| Vec3::from_f64(Vec3::from(p));
        let mut random = Random::new(&[seed, 3]);
        match *self {
            Self::HalfLattice(ranges) => {
                let mut end = || {
                    let half = |[low, high]: [i64; 2]| 0.5 * random.integer(low, high) as f64;
                    single(ranges.map(half))
                };
                (0..count).map(|_| Segment::new(end(), end())).collect()
            }
            Self::Uniform => {
                let mut end = || single([(); 3].map(|()| random.between(-3.0, 3.0)));
                (0..count).map(|_| Segment::new(end(), end())).collect()
            }
            Self::Mix(mix, pose, flat) => {
                let mut all = mix.segments::<T>(count.min(COUNT), &pose);
                if let Some(z) = flat {
                    for s in &mut all {
                        s.start.z = T::from_f64(z);
                        s.end.z = T::from_f64(z);
                    }
                }
                all
            }
        }
    }
}

/// Axis-parallel rectangles with half-integer corners from -3 to 3.
pub fn quads(seed: u64, count: usize) -> Vec<Quad> {
    let mut random = Random::new(&[seed, 4]);
    let mut one = |_| {
        let flat = random.below(3) as usize;
        let mut range = |k: usize| {
            let low = random.integer(-6, 5);
            let high = if k == flat {
                low
            } else {
                random.integer(low + 1, 6)
            };
            [low, high].map(|halves| 0.5 * halves as f64)
        };
        let ranges = [0, 1, 2].map(&mut range);
        Quad {
            min: ranges.map(|[low, _]| low),
            max: ranges.map(|[_, high]| high),
        }
    };
    (0..count).map(&mut one).collect()
}

/// Boxes on the grid.
pub mod boxes {
    use crate::boxes::GridBox;
    use crate::scene::Camera;
    use frusta::samples::Random;

    /// Half-integer points around the lattice's camera.
    pub fn points(_: &Camera, seed: u64, count: usize) -> Vec<GridBox> {
        halves(seed, count, 0)
    }

    /// Half-integer boxes around the lattice's camera, some of no extent along some axes.
    pub fn lattice(_: &Camera, seed: u64, count: usize) -> Vec<GridBox> {
        halves(seed, count, 5)
    }

    fn halves(seed: u64, count: usize, longest: i64) -> Vec<GridBox> {
        let mut random = Random::new(&[seed, 5]);
        let mut one = |_| {
            let mut range = |[low, high]: [i64; 2]| {
                let low = random.integer(low, high);
                let high = low + random.integer(0, longest);
                [low, high].map(|halves| 0.5 * halves as f32)
            };
            let ranges = [[-8, 8], [-8, 8], [-2, 8]].map(&mut range);
            GridBox {
                min: ranges.map(|[low, _]| low),
                max: ranges.map(|[_, high]| high),
            }
        };
        (0..count).map(&mut one).collect()
    }

    /// Half extents up to a fiftieth of the view's depth.
    pub fn small(camera: &Camera, seed: u64, count: usize) -> Vec<GridBox> {
        around(camera, seed, count, 2.5)
    }

    /// Half extents up to half of the view's depth.
    pub fn large(camera: &Camera, seed: u64, count: usize) -> Vec<GridBox> {
        around(camera, seed, count, 64.0)
    }

    /// Boxes around a camera that sees as far as 129, centres even in a space that is half again
    /// as wide.
    fn around(camera: &Camera, seed: u64, count: usize, longest: f64) -> Vec<GridBox> {
        let mut random = Random::new(&[seed, 6]);
        let axes = camera.pose.axes.map(|a| a * (1.0 / a.dot(a).sqrt()));
        let on_grid = |c: f64| ((c / GridBox::STEP).round() * GridBox::STEP) as f32;
        let mut one = |_| {
            let ranges = [[-194.0, 194.0], [-97.0, 97.0], [-150.0, 20.0]];
            let [x, y, z] = ranges.map(|[low, high]| random.between(low, high));
            let centre = (axes[0] * x + axes[1] * y + axes[2] * z).to_array();
            let half = [(); 3].map(|()| random.between(0.0, longest));
            GridBox {
                min: [0, 1, 2].map(|k: usize| on_grid(centre[k] - half[k])),
                max: [0, 1, 2].map(|k: usize| on_grid(centre[k] + half[k])),
            }
        };
        (0..count).map(&mut one).collect()
    }
}
