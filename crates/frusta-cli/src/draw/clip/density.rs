//! The ink of each pixel: strokes are summed instead of painted over each other.
//!
//! Each stroke adds its coverage of a pixel, times its weight, to a grid of its
//! layer:
//!
//! ```text
//! for each column that the stroke meets along its longer direction:
//!     ink = stroke's length in the column
//!     shared by the two pixels next to the stroke's middle there, by closeness
//! ```
//!
//! which is Wu's line ("An efficient antialiasing technique", 1991) with sums for
//! blending. A grid takes memory by the picture's size only, whatever the number
//! of strokes, and only if its layer has any.
//!
//! What takes time is the memory: a long steep stroke meets another row at every
//! pixel. So pixels lie in squares of four by four, a cache line each, and strokes
//! are added many at a time, band of rows after band, a band being what a core's
//! own cache holds. Bands share nothing, so threads can take one each; and in
//! each pixel ink is added in the input's order, so threads do not show.

use super::layer::Layer;
use super::projector::Place;
use super::strokes::Stroke;
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use std::ops::Range;

/// The sum that stands for the ink of a stroke of full weight across a pixel.
pub(super) const FULL: u64 = 1 << 34;
/// The least weight; ink remains positive when shared and made a sum.
pub(super) const LIGHTEST: f64 = 1.0 / (1 << 26) as f64;
/// Shorter strokes, in pixels, are dots of this much ink: they are there, if
/// small.
const LEAST: f32 = 0.5;
/// Pixels along a square's side, as a power of two, and in a square.
const SIDE: usize = 2;
const SQUARE: usize = 1 << (2 * SIDE);
/// Rows of pixels in a band.
const BAND: usize = 64;

/// Sums of ink by layer and pixel.
#[derive(Debug)]
pub(super) struct Density {
    width: usize,
    height: usize,
    layers: [Option<Box<[Cells]>>; Layer::ALL.len()],
}

/// A square of pixels, row by row.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Cells([f32; SQUARE]);

/// Some rows of a layer.
struct Band<'a> {
    width: i32,
    height: i32,
    /// The rows; the first and the last band have all beyond the border, too.
    rows: Range<i32>,
    /// The first row that there is.
    top: usize,
    /// Squares in a row of them.
    across: usize,
    squares: &'a mut [Cells],
}

/// A pixel's square, and its place there.
#[inline]
fn locate(x: usize, y: usize, across: usize) -> (usize, usize) {
    const WITHIN: usize = (1 << SIDE) - 1;
    let square = (y >> SIDE) * across + (x >> SIDE);
    (square, (y & WITHIN) << SIDE | (x & WITHIN))
}

/// Number of squares that cover a number of pixels.
fn squares(pixels: usize) -> usize {
    pixels.div_ceil(1 << SIDE)
}

impl Density {
    /// Blank grids of a width and height in pixels.
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

    /// A layer's sums, row by row, in [`FULL`]ths; `None` if it has no stroke.
    pub(super) fn sums(&self, layer: Layer) -> Option<impl Iterator<Item = u64>> {
        let cells = self.layers[layer as usize].as_ref()?;
        let across = squares(self.width);
        let pixels = (0..self.height).flat_map(move |y| (0..self.width).map(move |x| (x, y)));
        Some(pixels.map(move |(x, y)| {
            let (square, place) = locate(x, y, across);
            (cells[square].0[place] * FULL as f32) as u64
        }))
    }

    /// Adds strokes; those of a layer with a radius are discs.
    pub(super) fn add(&mut self, strokes: &[Stroke], radius: impl Fn(Layer) -> Option<f32> + Sync) {
        for layer in Layer::ALL {
            let own: Vec<&Stroke> = strokes.iter().filter(|s| s.layer == layer).collect();
            if own.is_empty() {
                continue;
            }
            let (width, height) = (self.width, self.height);
            let across = squares(width);
            let blank = || vec![Cells([0.0; SQUARE]); across * squares(height)].into();
            let all = self.layers[layer as usize].get_or_insert_with(blank);
            let bands = all.par_chunks_mut(across * (BAND >> SIDE)).enumerate();
            bands.for_each(|(i, squares)| {
                let top = i * BAND;
                let is_last = top + BAND >= height;
                let mut band = Band {
                    width: width as i32,
                    height: height as i32,
                    rows: if i == 0 { i32::MIN } else { top as i32 }..if is_last {
                        i32::MAX
                    } else {
                        (top + BAND) as i32
                    },
                    top,
                    across,
                    squares,
                };
                for stroke in &own {
                    match radius(layer) {
                        Some(radius) => band.disc(stroke.from, radius),
                        None => band.stroke(stroke),
                    }
                }
            });
        }
    }
}

impl Band<'_> {
    /// Adds a stroke, a pixel wide; its weight is [`LIGHTEST`] to 1.
    fn stroke(&mut self, stroke: &Stroke) {
        let Stroke {
            from, to, weight, ..
        } = *stroke;
        // With a row to spare, since a stroke is shared by two.
        let reach = |y: f32| y.clamp(-2.0, 1e6) as i32;
        let [low, high] = [from[1].min(to[1]), from[1].max(to[1])].map(reach);
        if high + 2 < self.rows.start || low - 2 >= self.rows.end {
            return;
        }
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = (dx * dx + dy * dy).sqrt();
        if length < 2.0 * LEAST {
            let middle = [from[0] + 0.5 * dx, from[1] + 0.5 * dy];
            self.dot(middle, length.max(LEAST) * weight);
        } else if dx.abs() >= dy.abs() {
            let rows = self.rows.clone();
            let slope = dy / dx;
            // The columns in which the stroke can meet the band's rows, or more.
            let column = |row: i32, more: f32| from[0] + (row as f32 + more - from[1]) / slope;
            let [a, b] = [column(rows.start, -2.0), column(rows.end, 2.0)];
            let columns = if slope == 0.0 {
                i32::MIN..i32::MAX
            } else {
                (a.min(b) - 2.0) as i32..((a.max(b) + 3.0) as i32)
            };
            self.line(from, to, length * weight, columns, |band, x, y, ink| {
                band.add(x, y, ink);
            });
        } else {
            let turned = |[x, y]: Place| [y, x];
            let (from, to) = (turned(from), turned(to));
            let rows = self.rows.clone();
            self.line(from, to, length * weight, rows, |band, y, x, ink| {
                band.add(x, y, ink);
            });
        }
    }

    /// Adds a disc.
    fn disc(&mut self, centre: Place, radius: f32) {
        let reach = radius + 1.0;
        let range = |c: f32| floor(c - reach).0..=floor(c + reach).0;
        for y in range(centre[1]) {
            for x in range(centre[0]) {
                let [dx, dy] = [x as f32 + 0.5 - centre[0], y as f32 + 0.5 - centre[1]];
                let within = radius + 0.5 - (dx * dx + dy * dy).sqrt();
                // What of it lies beyond the border is not drawn.
                if (0..self.width).contains(&x) && (0..self.height).contains(&y) {
                    self.add(x, y, within.clamp(0.0, 1.0));
                }
            }
        }
    }

    /// Adds ink to a pixel of the band; beyond the border to the nearest one, so
    /// that strokes along the border keep their ink.
    #[inline]
    fn add(&mut self, x: i32, y: i32, ink: f32) {
        if !self.rows.contains(&y) {
            return;
        }
        let (x, y) = (x.clamp(0, self.width - 1), y.clamp(0, self.height - 1));
        let (square, place) = locate(x as usize, y as usize - self.top, self.across);
        self.squares[square].0[place] += ink;
    }

    /// Shares ink among the four pixels around a point.
    fn dot(&mut self, [x, y]: Place, ink: f32) {
        let (column, x) = floor(x - 0.5);
        let (row, y) = floor(y - 0.5);
        for (dy, ink) in [(0, ink * (1.0 - y)), (1, ink * y)] {
            for (dx, ink) in [(0, ink * (1.0 - x)), (1, ink * x)] {
                self.add(column + dx, row + dy, ink);
            }
        }
    }

    /// Adds what of a line is in some columns; its first coordinates differ more
    /// than the second. `add` takes column, row and a share of `ink`.
    #[inline]
    fn line(
        &mut self,
        from: Place,
        to: Place,
        ink: f32,
        columns: Range<i32>,
        add: impl Fn(&mut Self, i32, i32, f32),
    ) {
        let ([u0, v0], [u1, v1]) = if from[0] <= to[0] {
            (from, to)
        } else {
            (to, from)
        };
        let slope = (v1 - v0) / (u1 - u0);
        let ink_per_column = ink / (u1 - u0);
        let first = floor(u0).0.max(columns.start);
        let last = floor(u1).0.min(columns.end.saturating_sub(1));
        for u in first..=last {
            let (begin, end) = (u0.max(u as f32), u1.min((u + 1) as f32));
            let middle = 0.5 * (begin + end);
            let (row, beyond) = floor(v0 + slope * (middle - u0) - 0.5);
            let ink = ink_per_column * (end - begin);
            add(self, u, row, ink * (1.0 - beyond));
            add(self, u, row + 1, ink * beyond);
        }
    }
}

/// The greatest whole number that is not greater, and how much is left. Places are
/// at least -1; the conversion then rounds down, without a call for it.
#[inline]
fn floor(value: f32) -> (i32, f32) {
    let whole = (value + 1.0) as i32 - 1;
    (whole, (value - whole as f32).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Density {
        fn line(&mut self, layer: Layer, from: Place, to: Place, weight: f32) {
            let stroke = Stroke {
                layer,
                from,
                to,
                weight,
            };
            self.add(&[stroke], |_| None);
        }

        fn disc(&mut self, layer: Layer, centre: Place, radius: f32) {
            let stroke = Stroke {
                layer,
                from: centre,
                to: centre,
                weight: 1.0,
            };
            self.add(&[stroke], |_| Some(radius));
        }
    }

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
    fn sums_do_not_depend_on_order_or_sense() {
        let strokes = strokes(2_000);
        let mut one = Density::new([200, 100]);
        for &[a, b] in &strokes {
            one.line(Layer::Inside, a, b, 1.0);
        }
        let mut other = Density::new([200, 100]);
        for &[a, b] in strokes.iter().rev() {
            other.line(Layer::Inside, b, a, 1.0);
        }
        // But for the last digits of a sum.
        let both = sums(&one, Layer::Inside);
        let both = both.iter().zip(sums(&other, Layer::Inside));
        assert!(both.clone().any(|(&a, _)| a > 2 * FULL));
        for (&a, b) in both {
            assert!(a.abs_diff(b) <= FULL >> 16, "{a} {b}");
        }
        assert!(one.sums(Layer::Cross).is_none());
    }

    #[test]
    fn bands_and_batches_do_not_show() {
        // As high as four bands; each stroke alone is drawn into a grid that is one.
        let tall = |[x, y]: Place| [x / 4.0, y * 2.5];
        let strokes: Vec<Stroke> = strokes(1_000)
            .into_iter()
            .map(|ends| {
                let [from, to] = ends.map(tall);
                Stroke {
                    layer: Layer::Inside,
                    from,
                    to,
                    weight: 0.7,
                }
            })
            .collect();
        let mut at_once = Density::new([50, 250]);
        at_once.add(&strokes, |_| None);
        let mut one_by_one = Density::new([50, 250]);
        strokes.chunks(1).for_each(|s| one_by_one.add(s, |_| None));
        let sums = sums(&at_once, Layer::Inside);
        assert_eq!(
            sums,
            one_by_one.sums(Layer::Inside).unwrap().collect::<Vec<_>>()
        );
        let ink: u64 = sums.iter().sum();
        let length = |s: &Stroke| (s.to[0] - s.from[0]).hypot(s.to[1] - s.from[1]).max(LEAST);
        let expected = strokes.iter().map(length).sum::<f32>() * 0.7 * FULL as f32;
        assert!(
            (ink as f32 / expected - 1.0).abs() < 1e-4,
            "{ink} {expected}"
        );
    }

    #[test]
    fn the_ink_of_a_stroke_is_its_length() {
        for [a, b] in strokes(500) {
            let mut density = Density::new([200, 100]);
            density.line(Layer::Cross, a, b, 1.0);
            let ink: u64 = sums(&density, Layer::Cross).iter().sum();
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let expected = length.max(LEAST) * FULL as f32;
            assert!((ink as f32 / expected - 1.0).abs() < 1e-5, "{a:?} {b:?}");
        }
    }

    #[test]
    fn short_strokes_and_strokes_along_the_border_leave_ink() {
        let mut density = Density::new([20, 10]);
        let ink = |density: &Density, layer| sums(density, layer).iter().sum::<u64>();
        density.line(Layer::Inside, [5.0, 5.0], [5.0, 5.0], 1.0);
        assert_eq!(ink(&density, Layer::Inside), FULL / 2);
        density.line(Layer::Outside, [20.0, 10.0], [20.0, 10.0], 1.0);
        assert_eq!(ink(&density, Layer::Outside), FULL / 2);
        density.line(Layer::Cross, [20.0, 0.0], [20.0, 10.0], 1.0);
        density.line(Layer::Cross, [0.0, 10.0], [20.0, 10.0], 1.0);
        assert_eq!(ink(&density, Layer::Cross), 30 * FULL);
        density.disc(Layer::Cut, [10.0, 5.0], 2.0);
        assert!((10 * FULL..16 * FULL).contains(&ink(&density, Layer::Cut)));
        density.disc(Layer::Cut, [0.0, 0.0], 2.0);
    }

    #[test]
    fn the_lightest_stroke_is_shared_evenly() {
        let mut density = Density::new([4, 4]);
        density.line(Layer::Inside, [0.0, 2.0], [4.0, 2.0], LIGHTEST as f32);
        let lightest = (FULL as f64 * LIGHTEST) as u64;
        let expected = [0, lightest / 2, lightest / 2, 0].map(|ink| [ink; 4]);
        assert_eq!(sums(&density, Layer::Inside), expected.as_flattened());
    }
}
