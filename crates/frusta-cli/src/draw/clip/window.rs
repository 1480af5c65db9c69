//! What a viewer at infinite distance sees: a box along their own axes.

use frusta::{EndRect, Frustum, FrustumError, Pose, Shape};

/// Around everything, of the window's size.
const PADDING: f64 = 0.05;
/// Width over height of the picture.
const RATIOS: [f64; 2] = [1.0, 2.0];
/// The greatest depth of the viewer's own frustum.
const DEEPEST: f64 = 1e307;

/// The viewer's window, along right, up and forward.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    low: [f64; 3],
    high: [f64; 3],
}

impl Window {
    /// The least window with all points in it.
    pub(super) fn around(points: impl Iterator<Item = [f64; 3]>) -> Self {
        let empty = Self {
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
        };
        points.fold(empty, |all, p| all.and(Self { low: p, high: p }))
    }

    /// The least window with both in it.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i].min(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].max(other.high[i])),
        }
    }

    /// The intersection with another window; at least a point of that.
    pub(super) fn cut(self, other: &Self) -> Self {
        let into = |v: [f64; 3]| std::array::from_fn(|i| v[i].clamp(other.low[i], other.high[i]));
        Self {
            low: into(self.low),
            high: into(self.high),
        }
    }

    /// A window of the same middle, `factor` times as large.
    pub(super) fn scaled(self, factor: f64) -> Self {
        let half = |i: usize| 0.5 * factor * (self.high[i] - self.low[i]);
        let middle = |i: usize| 0.5 * self.low[i] + 0.5 * self.high[i];
        Self {
            low: std::array::from_fn(|i| middle(i) - half(i)),
            high: std::array::from_fn(|i| middle(i) + half(i)),
        }
    }

    /// A square window of the same middle, its sides `factor` times the larger
    /// of width and height.
    pub(super) fn square(self, factor: f64) -> Self {
        let larger = (self.high[0] - self.low[0]).max(self.high[1] - self.low[1]);
        let half = 0.5 * factor * larger;
        let middle = |i: usize| 0.5 * self.low[i] + 0.5 * self.high[i];
        Self {
            low: std::array::from_fn(|i| middle(i) - half),
            high: std::array::from_fn(|i| middle(i) + half),
        }
    }

    /// Whether its width and height are another's at most.
    pub(super) fn within(&self, other: &Self) -> bool {
        (0..2).all(|i| self.high[i] - self.low[i] <= other.high[i] - other.low[i])
    }

    /// How far it reaches before or behind the origin.
    pub(super) fn depth(&self) -> f64 {
        self.low[2].abs().max(self.high[2].abs())
    }

    /// The frustum through this window, with some air around and not too oblong;
    /// deep enough for a scene of unknown extent.
    pub(super) fn frustum(&self, pose: Pose, depth: f64) -> Result<Frustum, FrustumError> {
        let size = [0, 1].map(|i| self.high[i] - self.low[i]);
        let larger = size[0].max(size[1]);
        let height = size[1].max(size[0] / RATIOS[1]).max(larger * 1e-3);
        let width = size[0].max(height * RATIOS[0]);
        let half = [width, height].map(|s| s * (0.5 + PADDING));
        let [x, y] = [0, 1].map(|i| 0.5 * self.low[i] + 0.5 * self.high[i]);
        let z = (2.0 * depth).max(1e4 * larger).min(DEEPEST);
        let end = |z: f64| EndRect::new(z, x - half[0], x + half[0], y - half[1], y + half[1]);
        let shape = Shape::Finite {
            near: end(-z),
            far: end(z),
        };
        Frustum::new(pose, shape)
    }
}
