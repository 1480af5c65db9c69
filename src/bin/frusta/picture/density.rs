//! How much ink each pixel gets: strokes summed up instead of painted over each
//! other.
//!
//! Each stroke adds its coverage of a pixel, in [`FULL`]ths, to a grid of its
//! layer, times its weight:
//!
//! ```text
//! for each column that the stroke meets along its longer direction:
//!     ink = stroke's length in the column
//!     shared by the two pixels next to the stroke's middle there, by closeness
//! ```
//!
//! which is Wu's line ("An efficient antialiasing technique", 1991) with sums
//! of integers for blending: they commute, so that any number of threads gives
//! the same picture. A grid takes memory by the picture's size only, whatever
//! the number of strokes, and only if its layer has any.

use super::layer::Layer;
use super::projector::Place;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// The ink of a stroke of full weight right across a pixel.
pub(super) const FULL: u64 = 1 << 34;
/// The least weight, which leaves enough digits to share ink.
pub(super) const LIGHTEST: f64 = 1.0 / (1 << 26) as f64;
/// Where sums end: 2^28 strokes of full weight.
const MOST: u64 = 1 << 62;
/// Shorter strokes, in pixels, are dots of this much ink: they are there, if
/// small.
const LEAST: f32 = 0.5;

/// Sums of ink by layer and pixel.
#[derive(Debug)]
pub(super) struct Density {
    width: usize,
    height: usize,
    layers: [OnceLock<Box<[AtomicU64]>>; Layer::ALL.len()],
}

/// One layer's sums, row by row.
struct Grid<'a> {
    width: i32,
    height: i32,
    cells: &'a [AtomicU64],
}

impl Density {
    /// Blank grids of so many pixels.
    pub(super) fn new([width, height]: [usize; 2]) -> Self {
        Self {
            width,
            height,
            layers: Default::default(),
        }
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// A layer's sums, row by row; `None` if it has no stroke.
    pub(super) fn sums(&self, layer: Layer) -> Option<impl Iterator<Item = u64>> {
        let cells = self.layers[layer as usize].get()?;
        let sum = |cell: &AtomicU64| cell.load(Ordering::Relaxed).min(MOST);
        Some(cells.iter().map(sum))
    }

    fn grid(&self, layer: Layer) -> Grid<'_> {
        let blank = || {
            let cells = 0..self.width * self.height;
            cells.map(|_| AtomicU64::new(0)).collect()
        };
        Grid {
            width: self.width as i32,
            height: self.height as i32,
            cells: self.layers[layer as usize].get_or_init(blank),
        }
    }

    /// Adds a stroke, a pixel wide; its weight is [`LIGHTEST`] to 1.
    pub(super) fn line(&self, layer: Layer, from: Place, to: Place, weight: f32) {
        let grid = self.grid(layer);
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = (dx * dx + dy * dy).sqrt();
        let full = FULL as f32 * weight;
        if length < 2.0 * LEAST {
            let middle = [from[0] + 0.5 * dx, from[1] + 0.5 * dy];
            grid.dot(middle, (length.max(LEAST) * full) as u64);
        } else if dx.abs() >= dy.abs() {
            grid.line(from, to, length * full, |grid, x, y, ink| {
                grid.add(x, y, ink)
            });
        } else {
            let turned = |[x, y]: Place| [y, x];
            let (from, to) = (turned(from), turned(to));
            grid.line(from, to, length * full, |grid, y, x, ink| {
                grid.add(x, y, ink)
            });
        }
    }

    /// Adds a disc.
    pub(super) fn disc(&self, layer: Layer, centre: Place, radius: f32) {
        let grid = self.grid(layer);
        let reach = radius + 1.0;
        let range = |c: f32| (c - reach).floor() as i32..=(c + reach).floor() as i32;
        for y in range(centre[1]) {
            for x in range(centre[0]) {
                let [dx, dy] = [x as f32 + 0.5 - centre[0], y as f32 + 0.5 - centre[1]];
                let within = radius + 0.5 - (dx * dx + dy * dy).sqrt();
                // What of it lies beyond the border is not drawn.
                if (0..grid.width).contains(&x) && (0..grid.height).contains(&y) {
                    grid.add(x, y, (within.clamp(0.0, 1.0) * FULL as f32) as u64);
                }
            }
        }
    }
}

impl Grid<'_> {
    /// Adds ink to a pixel; beyond the border to the nearest one, so that
    /// strokes along the border keep their ink.
    #[inline]
    fn add(&self, x: i32, y: i32, ink: u64) {
        if ink == 0 {
            return;
        }
        let (x, y) = (x.clamp(0, self.width - 1), y.clamp(0, self.height - 1));
        let cell = &self.cells[y as usize * self.width as usize + x as usize];
        // A sum beyond the limit stays: who finds one takes back what it added,
        // and readers see the limit, in whatever order it came to that.
        if cell.fetch_add(ink, Ordering::Relaxed) > MOST {
            cell.fetch_sub(ink, Ordering::Relaxed);
        }
    }

    /// Shares ink among the four pixels around a point.
    fn dot(&self, [x, y]: Place, ink: u64) {
        let (x, y) = (x - 0.5, y - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let share = |ink: u64, part: f32| {
            let second = (ink as f32 * part).round() as u64;
            [ink - second.min(ink), second.min(ink)]
        };
        for (dy, ink) in (0..).zip(share(ink, y - row)) {
            for (dx, ink) in (0..).zip(share(ink, x - column)) {
                self.add(column as i32 + dx, row as i32 + dy, ink);
            }
        }
    }

    /// Adds a line whose first coordinates differ more than the second. `add`
    /// takes column, row and a share of `ink`.
    #[inline]
    fn line(&self, from: Place, to: Place, ink: f32, add: impl Fn(&Self, i32, i32, u64)) {
        let ([u0, v0], [u1, v1]) = if from[0] <= to[0] {
            (from, to)
        } else {
            (to, from)
        };
        let slope = (v1 - v0) / (u1 - u0);
        let ink_per_column = ink / (u1 - u0);
        let column = |u: i32, begin: f32, end: f32| {
            let middle = 0.5 * (begin + end);
            let v = v0 + slope * (middle - u0) - 0.5;
            let row = v.floor();
            let ink = (ink_per_column * (end - begin)).round() as u64;
            let second = (ink as f32 * (v - row)).round() as u64;
            add(self, u, row as i32, ink - second.min(ink));
            add(self, u, row as i32 + 1, second.min(ink));
        };
        let (first, last) = (u0.floor() as i32, u1.floor() as i32);
        if first == last {
            column(first, u0, u1);
            return;
        }
        column(first, u0, (first + 1) as f32);
        for u in first + 1..last {
            column(u, u as f32, (u + 1) as f32);
        }
        column(last, last as f32, u1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strokes(count: usize) -> Vec<[Place; 2]> {
        let mut state = 1_u64;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 40) as f32 / (1 << 24) as f32
        };
        let mut place = || [next() * 200.0, next() * 100.0];
        (0..count).map(|_| [place(), place()]).collect()
    }

    fn sums(density: &Density, layer: Layer) -> Vec<u64> {
        density.sums(layer).map_or_else(Vec::new, Iterator::collect)
    }

    #[test]
    fn sums_do_not_depend_on_order_or_threads() {
        let strokes = strokes(2_000);
        let one = Density::new([200, 100]);
        for &[a, b] in &strokes {
            one.line(Layer::Inside, a, b, 1.0);
        }
        let many = Density::new([200, 100]);
        std::thread::scope(|scope| {
            for part in strokes.rchunks(300) {
                let many = &many;
                scope.spawn(move || {
                    for &[a, b] in part.iter().rev() {
                        many.line(Layer::Inside, b, a, 1.0);
                    }
                });
            }
        });
        assert_eq!(sums(&one, Layer::Inside), sums(&many, Layer::Inside));
        assert!(one.sums(Layer::Cross).is_none());
    }

    #[test]
    fn the_ink_of_a_stroke_is_its_length() {
        for [a, b] in strokes(500) {
            let density = Density::new([200, 100]);
            density.line(Layer::Cross, a, b, 1.0);
            let ink: u64 = sums(&density, Layer::Cross).iter().sum();
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let expected = length.max(LEAST) * FULL as f32;
            assert!((ink as f32 / expected - 1.0).abs() < 1e-5, "{a:?} {b:?}");
        }
    }

    #[test]
    fn short_strokes_and_strokes_along_the_border_leave_ink() {
        let density = Density::new([20, 10]);
        let ink = |layer| sums(&density, layer).iter().sum::<u64>();
        density.line(Layer::Inside, [5.0, 5.0], [5.0, 5.0], 1.0);
        assert_eq!(ink(Layer::Inside), FULL / 2);
        density.line(Layer::Outside, [20.0, 10.0], [20.0, 10.0], 1.0);
        assert_eq!(ink(Layer::Outside), FULL / 2);
        density.line(Layer::Cross, [20.0, 0.0], [20.0, 10.0], 1.0);
        density.line(Layer::Cross, [0.0, 10.0], [20.0, 10.0], 1.0);
        assert_eq!(ink(Layer::Cross), 30 * FULL);
        density.disc(Layer::Cut, [10.0, 5.0], 2.0);
        assert!((10 * FULL..16 * FULL).contains(&ink(Layer::Cut)));
        density.disc(Layer::Cut, [0.0, 0.0], 2.0);
    }

    #[test]
    fn the_lightest_stroke_is_shared_evenly() {
        let density = Density::new([4, 4]);
        density.line(Layer::Inside, [0.0, 2.0], [4.0, 2.0], LIGHTEST as f32);
        let lightest = (FULL as f64 * LIGHTEST) as u64;
        let expected = [0, lightest / 2, lightest / 2, 0].map(|ink| [ink; 4]);
        assert_eq!(sums(&density, Layer::Inside), expected.as_flattened());
    }

    #[test]
    fn a_sum_ends_at_its_limit() {
        let density = Density::new([1, 1]);
        let grid = density.grid(Layer::Inside);
        for _ in 0..5 {
            grid.add(0, 0, MOST - 1);
        }
        assert_eq!(sums(&density, Layer::Inside), [MOST]);
    }
}
