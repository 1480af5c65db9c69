//! Large worlds: boxes in `f64`, asked about in `f32` relative to a place near them.
//!
//! # Idea
//! A double near the surface of the earth has nanometres, a single half a metre. Relative to
//! an anchor, the eye or the middle of a tile, singles have more than enough. So numbers
//! are converted once, `p - anchor` rounded to `f32`, and kernels read half of the bytes. What
//! they leave open is asked of the doubles, so the answers are those of the doubles.
//!
//! # The error bound
//! With u = 2^-24, a converted number is off by `1.01 u |p - anchor|`: the difference has an
//! error of 2^-53 of it, the conversion of u. A half space's offset at the anchor, `n . anchor
//! + d`, is formed exactly and rounded once. So a value is off by 1.01 u S more than in
//! [`super::boxes`]: 6.02 S + 4.01 |d|, still below the threshold's 8 of each. Below the normal
//! singles a conversion is off by 2^-150, far below what the threshold has for underflow. What
//! is beyond the range of `f32` is infinite there, and so not settled in registers.

use super::block_driver::{self, Block, Words};
use super::box_set::{BoxBlocks, BoxSet};
use super::boxes::Boxes;
use crate::cull::{Aabb, Culler, Volume, VolumeErrorAt};
use crate::frustum::eval::planes::FacePlanes;
use crate::math::{NonFinite, Vec3};
use fearless_simd::prelude::*;
#[cfg(feature = "parallel")]
use std::ops::Range;

/// Boxes in `f64`, with their places relative to an anchor in `f32`.
///
/// ```
/// use frusta::{Aabb, Camera, Culler, Projection, batch::RelativeBoxes};
/// // A screw on a table, somewhere on the earth.
/// let eye = [4_200_000.0, 170_000.0, 4_780_000.25];
/// let screw = [4_200_000.5, 170_000.0, 4_780_000.25];
/// let camera = Camera {
///     eye: eye.into(),
///     target: screw.into(),
///     up: [0.0, 0.0, 1.0].into(),
///     projection: Projection::Perspective { fovy: 0.01, aspect: 1.0 },
///     near: 0.1,
///     far: 10.0,
/// };
/// let around = |c: [f64; 3]| Aabb::new(c.map(|c| c - 0.001), c.map(|c| c + 0.001));
/// let beside = [screw[0], screw[1] + 0.01, screw[2]];
/// let boxes = RelativeBoxes::new(eye, &[around(screw), around(beside)])?;
/// let mut visible = Vec::new();
/// Culler::new(&camera.frustum()?).visible_relative(&boxes, &mut visible);
/// assert_eq!(visible, [0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RelativeBoxes {
    anchor: Vec3<f64>,
    near: BoxSet<f32>,
    exact: Vec<Aabb<f64>>,
}

/// What cannot be converted.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RelativeError {
    /// The anchor is infinite or NaN.
    Anchor(NonFinite),
    /// A box is none.
    Box(VolumeErrorAt),
}

impl std::fmt::Display for RelativeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Anchor(error) => write!(f, "the anchor: {error}"),
            Self::Box(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RelativeError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Anchor(error) => Some(error),
            Self::Box(error) => error.source(),
        }
    }
}

/// Rounded to nearest; infinite beyond the range.
fn relative(p: Vec3<f64>, anchor: Vec3<f64>) -> [f32; 3] {
    Vec3::<f32>::from_f64(p - anchor).to_array()
}

impl RelativeBoxes {
    /// Converts boxes.
    ///
    /// # Errors
    /// An anchor that is not finite; the first box that is none, as [`Aabb::check`].
    pub fn new(anchor: impl Into<Vec3<f64>>, boxes: &[Aabb<f64>]) -> Result<Self, RelativeError> {
        let mut all = Self {
            anchor: Vec3::default(),
            near: BoxSet::default(),
            exact: boxes.to_vec(),
        };
        for (index, volume) in boxes.iter().enumerate() {
            let check = volume.check();
            check.map_err(|error| RelativeError::Box(VolumeErrorAt { index, error }))?;
        }
        all.move_to(anchor)?;
        Ok(all)
    }

    /// Converts all boxes again, relative to another anchor.
    ///
    /// # Errors
    /// An anchor that is not finite; nothing is changed then.
    pub fn move_to(&mut self, anchor: impl Into<Vec3<f64>>) -> Result<(), RelativeError> {
        let anchor = anchor.into();
        NonFinite::check(None, anchor).map_err(RelativeError::Anchor)?;
        self.anchor = anchor;
        self.near.clear();
        for volume in &self.exact {
            let [min, max] = [volume.min, volume.max].map(|p| relative(p, anchor));
            self.near.append(Aabb::new(min, max));
        }
        Ok(())
    }

    /// What places are relative to.
    #[must_use]
    pub fn anchor(&self) -> Vec3<f64> {
        self.anchor
    }

    /// The boxes.
    #[must_use]
    pub fn boxes(&self) -> &[Aabb<f64>] {
        &self.exact
    }
}

impl RelativeBoxes {
    /// With a frustum's half spaces relative to the anchor.
    pub(super) fn seen_by(&self, culler: &Culler) -> Seen<'_> {
        Seen {
            boxes: self,
            rows: FacePlanes::relative_to(culler.half_spaces(), self.anchor),
        }
    }
}

/// Boxes, and half spaces relative to their anchor.
pub(super) struct Seen<'a> {
    boxes: &'a RelativeBoxes,
    rows: FacePlanes<f32>,
}

impl Seen<'_> {
    pub(super) fn lot(&self) -> Volumes<'_> {
        Volumes {
            rows: &self.rows,
            near: BoxBlocks::from(&self.boxes.near),
            exact: &self.boxes.exact,
        }
    }
}

/// Some of the boxes.
#[derive(Clone, Copy)]
pub(super) struct Volumes<'a> {
    pub(super) rows: &'a FacePlanes<f32>,
    near: BoxBlocks<'a, f32>,
    exact: &'a [Aabb<f64>],
}

#[cfg(feature = "parallel")]
impl Volumes<'_> {
    /// Some of these.
    pub(super) fn part(&self, range: Range<usize>) -> Self {
        Self {
            rows: self.rows,
            near: self.near.part(range.clone()),
            exact: &self.exact[range],
        }
    }
}

impl block_driver::Volumes<f32, 6> for Volumes<'_> {
    fn len(&self) -> usize {
        self.exact.len()
    }

    fn volume(&self, index: usize) -> Option<Volume> {
        self.exact.get(index).copied().map(Volume::from)
    }

    #[inline(always)]
    fn block(&self, start: usize) -> Option<(&Block<f32, 6>, f32)> {
        self.near.block(start)
    }

    fn arrays(&self) -> Option<[&[f32]; 6]> {
        None
    }

    /// All are in blocks.
    #[inline(always)]
    fn numbers(&self, _: usize) -> [f32; 6] {
        [f32::NAN; 6]
    }

    #[inline(always)]
    fn words<S, V, const N: usize, const INSIDE: bool>(
        simd: S,
        rows: &FacePlanes<f32>,
        block: &Block<f32, 6>,
        largest: Option<f32>,
    ) -> Words
    where
        S: Simd,
        V: SimdFloat<S, Element = f32, Array = [f32; N]>,
    {
        Boxes::<f32>::words::<S, V, N, INSIDE>(simd, rows, block, largest)
    }
}
