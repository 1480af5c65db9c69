//! Strokes on a grid, each kept once, and few enough for a viewer.

use std::cmp::Reverse;

/// Bits of a grid coordinate: grids up to 16383 steps.
const BITS: u32 = 14;
const MASK: u64 = (1 << BITS) - 1;
/// Bits of a depth level.
const DEPTH_BITS: u32 = 5;
/// The greatest depth level.
pub(super) const DEEPEST: u8 = (1 << DEPTH_BITS) - 1;

/// A straight stroke between two grid points, of a class, at a depth level.
///
/// Packed, ends in order, so that equal strokes are equal numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Stroke(u64);

impl Stroke {
    /// From two grid points, `0..=16383` a coordinate; `class` below 8, `depth`
    /// up to [`DEEPEST`].
    pub(super) fn new(class: usize, depth: u8, a: [u16; 2], b: [u16; 2]) -> Self {
        let point = |[x, y]: [u16; 2]| ((u64::from(x) & MASK) << BITS) | (u64::from(y) & MASK);
        let (a, b) = (point(a), point(b));
        let head = (class as u64) << DEPTH_BITS | u64::from(depth.min(DEEPEST));
        Self(head << (4 * BITS) | a.min(b) << (2 * BITS) | a.max(b))
    }

    /// The class's number.
    pub(super) fn class(self) -> usize {
        (self.0 >> (4 * BITS + DEPTH_BITS)) as usize
    }

    /// The depth level.
    pub(super) fn depth(self) -> u8 {
        (self.0 >> (4 * BITS)) as u8 & DEEPEST
    }

    /// `[x, y]` of both ends.
    pub(super) fn ends(self) -> [[u16; 2]; 2] {
        [[3, 2], [1, 0]].map(|end| end.map(|i| (self.0 >> (i * BITS) & MASK) as u16))
    }

    /// The stroke on a grid of half as many steps.
    fn halved(self) -> Self {
        // Each coordinate moves down by a bit; what crosses a border is masked.
        let keep = (MASK >> 1) * (1 | 1 << BITS | 1 << (2 * BITS) | 1 << (3 * BITS));
        let head = self.0 >> (4 * BITS) << (4 * BITS);
        let ends = self.0 ^ head;
        let halved = ends >> 1 & keep;
        // Halving can turn the order of the ends when their x become equal.
        let point = (1 << (2 * BITS)) - 1;
        let (a, b) = (halved >> (2 * BITS), halved & point);
        Self(head | a.min(b) << (2 * BITS) | a.max(b))
    }
}

/// A set of strokes that never grows beyond a limit: when it would, the grid
/// becomes coarser by half, and what falls together counts once.
///
/// The result depends only on what was added, not on the order: at each grid
/// the number of different strokes only grows, so the last grid is the finest
/// one on which they number at most the limit.
#[derive(Debug)]
pub(crate) struct Thinned {
    strokes: Vec<Stroke>,
    limit: usize,
    level: u32,
}

impl Thinned {
    /// An empty set.
    pub(super) fn new(limit: usize) -> Self {
        Self {
            strokes: Vec::new(),
            limit,
            level: 0,
        }
    }

    /// Adds strokes of the finest grid.
    pub(super) fn extend(&mut self, strokes: &[Stroke]) {
        let level = self.level;
        let coarse = |&s: &Stroke| (0..level).fold(s, |s, _| s.halved());
        self.strokes.extend(strokes.iter().map(coarse));
        // Sorting late, not for every chunk.
        if self.strokes.len() > 4 * self.limit + (1 << 18) {
            self.compact();
        }
    }

    /// The strokes in order, and how many times the grid was halved.
    pub(super) fn finish(mut self) -> (Vec<Stroke>, u32) {
        self.compact();
        (self.strokes, self.level)
    }

    fn compact(&mut self) {
        self.strokes.sort_unstable();
        self.strokes.dedup();
        while self.strokes.len() > self.limit && self.level + 1 < BITS {
            self.level += 1;
            for stroke in &mut self.strokes {
                *stroke = stroke.halved();
            }
            self.strokes.sort_unstable();
            self.strokes.dedup();
        }
    }
}

/// Keeps the strokes that add to a picture of `width` by `height` cells of
/// `cell` grid steps: near ones before far ones and long ones before short
/// ones, each if a quarter of the cells on its way are still blank.
pub(super) fn keep_visible(
    mut strokes: Vec<Stroke>,
    [width, height]: [usize; 2],
    cell: u16,
) -> Vec<Stroke> {
    let length = |s: &Stroke| {
        let [[x0, y0], [x1, y1]] = s.ends();
        x0.abs_diff(x1).max(y0.abs_diff(y1))
    };
    strokes.sort_unstable_by_key(|s| (s.depth(), Reverse(length(s)), *s));
    let mut inked = vec![false; (width + 1) * (height + 1)];
    let mut way = Vec::new();
    strokes.retain(|stroke| {
        let [[x0, y0], [x1, y1]] = stroke.ends().map(|end| end.map(|c| f64::from(c / cell)));
        let steps = (x1 - x0).abs().max((y1 - y0).abs());
        way.clear();
        let mut blank = 0;
        for i in 0..=steps as u32 {
            let t = f64::from(i) / steps.max(1.0);
            let at = |a: f64, b: f64, most: usize| ((a + (b - a) * t).round() as usize).min(most);
            let index = at(y0, y1, height) * (width + 1) + at(x0, x1, width);
            blank += usize::from(!inked[index]);
            way.push(index);
        }
        let keep = 4 * blank >= way.len();
        if keep {
            way.iter().for_each(|&index| inked[index] = true);
        }
        keep
    });
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(count: usize) -> Vec<Stroke> {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 50) as u16
        };
        (0..count)
            .map(|_| Stroke::new(3, 7, [next(), next()], [next(), next()]))
            .collect()
    }

    #[test]
    fn a_stroke_keeps_its_ends_and_forgets_its_sense() {
        let stroke = Stroke::new(4, 31, [16383, 2], [3, 16000]);
        assert_eq!(stroke.ends(), [[3, 16000], [16383, 2]]);
        assert_eq!((stroke.class(), stroke.depth()), (4, 31));
        assert_eq!(stroke, Stroke::new(4, 31, [3, 16000], [16383, 2]));
        assert_eq!(stroke.halved().ends(), [[1, 8000], [8191, 1]]);
        assert_eq!((stroke.halved().class(), stroke.halved().depth()), (4, 31));
        let turned = Stroke::new(1, 0, [2, 9], [3, 4]).halved();
        assert_eq!(turned.ends(), [[1, 2], [1, 4]]);
    }

    #[test]
    fn thinning_keeps_to_the_limit_and_forgets_the_order() {
        let strokes = random(600_000);
        let thin = |chunk: usize, reverse: bool| {
            let mut set = Thinned::new(5_000);
            let mut pieces: Vec<&[Stroke]> = strokes.chunks(chunk).collect();
            if reverse {
                pieces.reverse();
            }
            pieces.into_iter().for_each(|piece| set.extend(piece));
            set.finish()
        };
        let (kept, level) = thin(8192, false);
        assert!(kept.len() <= 5_000 && kept.len() > 100, "{}", kept.len());
        assert!(level > 0);
        assert_eq!((kept.clone(), level), thin(1000, true));
        assert_eq!((kept, level), thin(600_000, false));
    }

    #[test]
    fn what_lies_behind_ink_is_dropped_and_what_shows_is_kept() {
        let line = |depth, y| Stroke::new(3, depth, [100, y], [900, y]);
        let dot = Stroke::new(3, 9, [500, 103], [500, 103]);
        let kept = keep_visible(
            vec![line(5, 100), dot, line(2, 101), line(5, 300)],
            [100, 100],
            10,
        );
        assert_eq!(kept, [line(2, 101), line(5, 300)]);
    }
}
