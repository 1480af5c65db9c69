//! The segments of the families.
//!
//! Most aim at a random feature: a grid point of the frustum with each grid
//! coordinate 0, 1 or strictly between, so that 26 of 27 choices are a vertex, a
//! point of an edge or a point of a face; then every coordinate is moved by up
//! to 4 ulp.

use super::family::Family;
use super::random::Random;
use super::scene::Scene;
use super::singular::{FrameSample, near_misses, singular_samples};
use super::solid::{FeatureKind, Solid};
use crate::math::{Real, Segment, Vec3};
use std::sync::OnceLock;

/// The segment of a case.
pub(crate) fn segment<T: Real>(family: Family, scene: &Scene, seed: u64, index: u64) -> Segment<T> {
    let mut random = Random::new(&[family as u64, seed, index, 2]);
    let mut aim = Aim {
        scene,
        random: &mut random,
    };
    let segment = match family {
        Family::Bumps | Family::Swapped | Family::Permuted | Family::Rotated | Family::Scaled => {
            aim.sample(family)
        }
        Family::Collinear => aim.collinear(),
        Family::CrossingEqual => aim.through_exactly(),
        Family::HalfLattice => aim.lattice(),
        Family::Points => {
            let p = aim.feature();
            Segment::new(p, p)
        }
        Family::NearFace => aim.near_face(),
        Family::NearlyParallel => aim.nearly_parallel(),
        Family::CrossingNearEnds => aim.near_ends(),
        Family::CrossingClose => aim.close(),
        Family::FarEnds => aim.far_end(3, 12),
        Family::UlpLong => aim.ulp_long(),
        Family::Diagonals => aim.diagonal(),
        Family::BehindApex => aim.behind(),
        Family::Subnormal | Family::Thin if aim.random.one_in(2) => aim.through_by_ulps(),
        _ => aim.mixed(),
    };
    let mut tidy = |p: Vec3<T>| Vec3::from(p.to_array().map(|c| tidied(c, &mut random)));
    Segment::new(tidy(segment.start), tidy(segment.end))
}

/// A finite coordinate. Some zeros are negative, because unclipped ends must keep their bits,
/// and the sign of a zero must not depend on the order of the ends.
pub(super) fn tidied<T: Real>(c: T, random: &mut Random) -> T {
    if c == T::ZERO && random.one_in(4) {
        -T::ZERO
    } else if c.is_finite() {
        c
    } else {
        T::ONE
    }
}

/// The samples and near misses of each solid, computed once.
fn samples(solid: usize) -> &'static [FrameSample] {
    static ALL: OnceLock<Vec<Vec<FrameSample>>> = OnceLock::new();
    let all = ALL.get_or_init(|| {
        let of = |solid: &Solid| {
            let mut samples = singular_samples(solid);
            samples.extend(near_misses(solid));
            samples
        };
        Solid::ALL.iter().map(of).collect()
    });
    &all[solid]
}

/// Moves a value by some ulps; half of the zeros by ulps of `scale` instead of
/// subnormals.
fn bump<T: Real>(value: T, ulps: i64, scale: T, random: &mut Random) -> T {
    if value == T::ZERO && random.one_in(2) {
        let step = scale.to_f64() * 2.0 * T::UNIT_ROUNDOFF;
        return T::from_f64(step * ulps as f64);
    }
    (0..ulps.abs()).fold(
        value,
        |v, _| {
            if ulps > 0 { v.next_up() } else { v.next_down() }
        },
    )
}

/// The largest magnitude of a coordinate.
pub(super) fn largest<T: Real>(p: Vec3<T>) -> T {
    let magnitudes = p.to_array().into_iter().map(Real::abs);
    magnitudes.fold(T::ZERO, |a, b| if b > a { b } else { a })
}

fn bump_point<T: Real>(p: Vec3<T>, most: i64, random: &mut Random) -> Vec3<T> {
    let scale = largest(p);
    Vec3::from(p.to_array().map(|c| {
        let ulps = random.integer(-most, most);
        bump(c, ulps, scale, random)
    }))
}

pub(super) struct Aim<'a> {
    pub(super) scene: &'a Scene,
    pub(super) random: &'a mut Random,
}

impl Aim<'_> {
    /// Grid coordinates of a random feature.
    pub(super) fn grid(&mut self) -> [f64; 3] {
        [(); 3].map(|()| match self.random.below(3) {
            0 => 0.0,
            1 => 1.0,
            // Halves are exact more often than other values.
            _ if self.random.one_in(2) => 0.5,
            _ => self.random.unit(),
        })
    }

    pub(super) fn at<T: Real>(&self, grid: [f64; 3]) -> Vec3<T> {
        Vec3::from_f64(self.scene.at(grid))
    }

    /// A point within 4 ulp of a feature, or of its nearest representable point.
    fn feature<T: Real>(&mut self) -> Vec3<T> {
        let p = self.grid();
        let p = self.at(p);
        self.bumped(p, 4)
    }

    pub(super) fn bumped<T: Real>(&mut self, p: Vec3<T>, most: i64) -> Vec3<T> {
        if self.random.one_in(3) {
            p
        } else {
            bump_point(p, most, self.random)
        }
    }

    /// A point in or around the frustum.
    pub(super) fn around<T: Real>(&mut self) -> Vec3<T> {
        let grid = [(); 3].map(|()| self.random.between(-1.0, 2.0));
        self.at(grid)
    }

    /// The frustum's size: the largest difference in a coordinate along a diagonal.
    pub(super) fn size(&self) -> f64 {
        let d = self.scene.at([1.0, 1.0, 1.0]) - self.scene.at([0.0, 0.0, 0.0]);
        largest(d)
    }

    /// A random direction, of a length up to the frustum's size.
    fn direction(&mut self) -> Vec3<f64> {
        let size = self.size() * 0.5_f64.powi(self.random.integer(0, 8) as i32);
        Vec3::from([(); 3].map(|()| self.random.between(-1.0, 1.0) * size))
    }

    fn mixed<T: Real>(&mut self) -> Segment<T> {
        let x = self.feature::<T>();
        match self.random.below(10) {
            0 => Segment::new(x, self.around()),
            1 => Segment::new(self.around(), x),
            2 | 3 => self.through(x),
            // Along a face or an edge, or from one to another.
            4 | 5 => Segment::new(x, self.feature()),
            6 => self.extended(x),
            7 => Segment::new(x, self.at([0.5, 0.5, 0.5])),
            8 if self.random.one_in(4) => Segment::new(x, x),
            _ => Segment::new(self.around(), self.around()),
        }
    }

    /// A line through a point, rounded.
    fn through<T: Real>(&mut self, x: Vec3<T>) -> Segment<T> {
        let d = if self.random.one_in(2) {
            self.direction()
        } else {
            self.around::<f64>() - x.to_f64()
        };
        let [back, forth] = [(); 2].map(|()| self.random.pick(&[0.25, 0.5, 1.0, 2.0]));
        let end = |t: f64| Vec3::from_f64(x.to_f64() + d * t);
        Segment::new(end(-back), end(forth))
    }

    /// A segment through a feature, a few ulps long.
    fn through_by_ulps<T: Real>(&mut self) -> Segment<T> {
        let x = self.grid();
        let x = self.at(x);
        let most = self.random.pick(&[1, 4, 40]);
        let start = bump_point(x, most, self.random);
        Segment::new(start, bump_point(x, most, self.random))
    }

    /// A segment on the line through a point and another feature, beyond both or beside them.
    fn extended<T: Real>(&mut self, x: Vec3<T>) -> Segment<T> {
        let (x, y) = (x.to_f64(), self.feature::<T>().to_f64());
        let mut end = |p: Vec3<f64>, d: Vec3<f64>| {
            let by = self.random.pick(&[-1.5, -0.5, 0.0, 0.5, 1.0, 2.0]);
            Vec3::from_f64(p + d * by)
        };
        Segment::new(end(x, x - y), end(y, y - x))
    }

    /// A sample of the scene's solid.
    fn pick(&mut self) -> Segment<f64> {
        let samples = samples(self.scene.solid().unwrap_or(0));
        let i = self.random.below(samples.len() as u64) as usize;
        samples[i].segment
    }

    fn place<T: Real>(&self, s: &Segment<f64>) -> Segment<T> {
        let end = |p| Vec3::from_f64(self.scene.world(p));
        Segment::new(end(s.start), end(s.end))
    }

    fn sample<T: Real>(&mut self, family: Family) -> Segment<T> {
        let sample = self.pick();
        let placed = self.place::<T>(&sample);
        let (most, every) = match family {
            Family::Bumps => (self.random.integer(0, 4), 1),
            _ => (1, 2),
        };
        let moved = if self.random.one_in(every) {
            let start = bump_point(placed.start, most, self.random);
            Segment::new(start, bump_point(placed.end, most, self.random))
        } else {
            placed
        };
        if family == Family::Swapped {
            moved.reversed()
        } else {
            moved
        }
    }

    fn collinear<T: Real>(&mut self) -> Segment<T> {
        let s = self.pick();
        let d = s.end - s.start;
        // Eighths keep the numbers short, so the ends stay on the line.
        let mut end = |p: Vec3<f64>| p + d * (self.random.integer(-12, 12) as f64 * 0.125);
        let moved = Segment::new(end(s.start), end(s.end));
        self.place(&moved)
    }

    /// A segment exactly through a vertex or the middle of an edge.
    fn through_exactly<T: Real>(&mut self) -> Segment<T> {
        let solid = Solid::ALL[self.scene.solid().unwrap_or(0)];
        let mut features = solid.features();
        features.retain(|f| f.kind() != FeatureKind::Face);
        let grid = features[self.random.below(features.len() as u64) as usize].grid();
        let x = solid.at(grid);
        let d = Vec3::from([(); 3].map(|()| self.random.integer(-8, 8) as f64));
        let mut by = || 2.0_f64.powi(self.random.integer(-1, 3) as i32);
        let line = Segment::new(x - d * by(), x + d * by());
        self.place(&line)
    }

    fn lattice<T: Real>(&mut self) -> Segment<T> {
        let mut end = || {
            if self.random.one_in(2) {
                // A grid point, moved to the lattice.
                let grid = self.grid();
                let p: Vec3<f64> = self.at(grid);
                return Vec3::from(p.to_array().map(|c| (2.0 * c).round() * 0.5));
            }
            Vec3::from([(); 3].map(|()| self.random.integer(-16, 16) as f64 * 0.5))
        };
        let (start, end) = (end(), end());
        Segment::new(Vec3::from_f64(start), Vec3::from_f64(end))
    }

    /// Grid coordinates of two points of the same face.
    fn on_one_face(&mut self) -> [[f64; 3]; 2] {
        let k = self.random.below(3) as usize;
        let side = self.random.below(2) as f64;
        [(); 2].map(|()| {
            let mut grid = [(); 3].map(|()| self.random.between(-0.25, 1.25));
            grid[k] = side;
            grid
        })
    }

    fn near_face<T: Real>(&mut self) -> Segment<T> {
        let [a, b] = self.on_one_face().map(|grid| self.at::<T>(grid));
        let a = bump_point(a, 2, self.random);
        Segment::new(a, bump_point(b, 2, self.random))
    }

    fn nearly_parallel<T: Real>(&mut self) -> Segment<T> {
        let [a, b] = self.on_one_face().map(|grid| self.at::<T>(grid));
        let k = self.random.below(3) as usize;
        let mut end = b;
        end[k] = bump(b[k], self.random.integer(-1, 1), b[k].abs(), self.random);
        Segment::new(a, end)
    }

    fn near_ends<T: Real>(&mut self) -> Segment<T> {
        let segment = if self.random.one_in(3) {
            // Values are dense at planes through zero, so any parameter is possible.
            let inside = self.at::<T>([0.5, 0.5, 0.5]);
            let mut start = self.at::<T>([0.25, 0.75, 0.5]);
            let k = self.random.below(3) as usize;
            let tiny = self.random.between(0.0, 4.0) * T::UNIT_ROUNDOFF;
            let by = tiny * inside[k].to_f64() * self.random.sign();
            start[k] = T::from_f64(by * 0.5_f64.powi(self.random.integer(0, 60) as i32));
            Segment::new(start, inside)
        } else {
            let grid = self.grid();
            let x = self.at::<T>(grid);
            let x = bump_point(x, 1, self.random);
            let far = 2.0_f64.powi(self.random.integer(0, 40) as i32);
            Segment::new(x, Vec3::from_f64(x.to_f64() + self.direction() * far))
        };
        if self.random.one_in(2) {
            segment.reversed()
        } else {
            segment
        }
    }

    /// A segment that crosses two planes through zero at `p / (p + r)` and `q / (q + s)`
    /// with `p s - q r = 1`, all of about 51 bits. The difference of the parameters is
    /// `1 / ((p + r)(q + s))`.
    fn close<T: Real>(&mut self) -> Segment<T> {
        let [mut p, mut q, mut r, mut s] = [1_u64, 0, 0, 1];
        // Shears keep the determinant. The sums stay within a factor of two of
        // each other and grow at most threefold a step, so below 2^53.
        let mut lower = false;
        while p + r < 1 << 50 || q + s < 1 << 50 {
            let k = if q == 0 { 1 } else { 1 + self.random.below(2) };
            if lower {
                (r, s) = (r + k * p, s + k * q);
            } else {
                (p, q) = (p + k * r, q + k * s);
            }
            lower = !lower;
        }
        let [p, q, r, s] = [p, q, r, s].map(|v| v as f64);
        let [sx, sz] = [(); 2].map(|()| {
            let size = 0.5_f64.powi(self.random.integer(0, 60) as i32);
            size * self.random.sign()
        });
        let y = self.random.pick(&[0.0, 0.5, 1.0, -1.0]);
        let line = Segment::new([-p * sx, y, -q * sz], [r * sx, y, s * sz]);
        self.place(&line)
    }

    fn far_end<T: Real>(&mut self, least: i64, most: i64) -> Segment<T> {
        let x = self.feature::<T>();
        let far = self.random.power_of_ten(least, most);
        let d = if self.random.one_in(2) {
            self.direction()
        } else {
            // Along an edge, a face or a diagonal.
            self.feature::<f64>() - x.to_f64()
        };
        let end = Vec3::from_f64(x.to_f64() + d * far);
        let start = if self.random.one_in(2) {
            Vec3::from_f64(x.to_f64() - d)
        } else {
            x
        };
        if self.random.one_in(2) {
            Segment::new(start, end)
        } else {
            Segment::new(end, start)
        }
    }

    fn ulp_long<T: Real>(&mut self) -> Segment<T> {
        let x = self.feature::<T>();
        let mut end = x;
        let first = self.random.below(3) as usize;
        for k in 0..3 {
            if k == first || self.random.one_in(2) {
                let up = self.random.one_in(2);
                end[k] = if up { x[k].next_up() } else { x[k].next_down() };
            }
        }
        Segment::new(x, end)
    }

    fn diagonal<T: Real>(&mut self) -> Segment<T> {
        let a = [(); 3].map(|()| self.random.below(2) as f64);
        let mut b = a.map(|c| 1.0 - c);
        if self.random.one_in(4) {
            // The diagonal of a face.
            let k = self.random.below(3) as usize;
            b[k] = a[k];
        }
        let [a, b] = [a, b].map(|grid| self.scene.at(grid));
        let by = self.random.pick(&[0.0, 0.0, 0.25, 1.0, -0.25]);
        let d = (b - a) * by;
        let ends = [a - d, b + d].map(Vec3::from_f64);
        let [start, end] = ends.map(|p| self.bumped(p, 1));
        Segment::new(start, end)
    }

    fn behind<T: Real>(&mut self) -> Segment<T> {
        let line = self.grid();
        let mut point = |w: f64| {
            // Half of the segments are on one line through the apex.
            let [u, v, _] = if self.random.one_in(2) {
                line
            } else {
                self.grid()
            };
            let p = self.at([u, v, w]);
            self.bumped(p, 2)
        };
        let (start, end) = (point(-1.0), point(-0.25));
        match self.random.below(4) {
            0 => Segment::new(start, end),
            1 => Segment::new(end, self.feature()),
            _ => Segment::new(start, self.feature()),
        }
    }
}
