//! Large worlds: boxes in `f64`, read in `f32` relative to an anchor near them.
//!
//! # Idea
//! Near the surface of the earth neighbouring values are a nanometre apart in `f64`, half a
//! metre in `f32`. Relative to an anchor, such as the eye or the middle of a tile, `f32` is
//! more than fine enough. So coordinates are converted once, `p - anchor` rounded to `f32`, and
//! the kernel reads half of the bytes. What it leaves open is decided by the `f64` boxes, so all
//! answers are theirs.
//!
//! # Error bound
//! With u = 2^-24, a converted coordinate is off by `1.01 u |p - anchor|`: the difference has a
//! relative error of 2^-53, the conversion of u. A half space's offset at the anchor,
//! `n . anchor + d`, is formed exactly and rounded once. So a value is off by 1.01 u S more than
//! in `kernels/boxes.rs`: 6.02 S + 4.01 |d|, still below the threshold of 8 S + 8 |d|. Below the
//! normal range of `f32` a conversion is off by 2^-150, far below what the threshold adds for
//! underflow. Coordinates beyond the range of `f32` become infinite, and the kernel decides
//! nothing about them.

#[cfg(simd)]
use super::block_driver::BlockAnswers;
use super::block_driver::{Block, Volumes};
use super::box_set::{BoxSet, Stored};
#[cfg(simd)]
use super::boxes::is_usual;
#[cfg(simd)]
use super::kernels;
#[cfg(not(simd))]
use super::one::Classify;
use crate::cull::{Aabb, Culler, Volume, VolumeErrorAt};
use crate::frustum::eval::planes::FacePlanes;
#[cfg(not(simd))]
use crate::math::PerReal;
use crate::math::{NonFinite, Vec3};
#[cfg(simd)]
use crate::simd::Level;

/// Boxes in `f64` that queries read in `f32`, relative to an anchor: the answers of `f64` in the
/// time of `f32`.
///
/// ```
/// use frusta::cull::RelativeBoxes;
/// use frusta::{Aabb, Camera, Culler, Projection};
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
/// Culler::new(&camera.frustum()?).over(&boxes).visible(&mut visible)?;
/// assert_eq!(visible, [0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RelativeBoxes {
    anchor: Vec3<f64>,
    near: BoxSet<f32>,
    exact: Vec<Aabb<f64>>,
}

/// Why boxes cannot be converted.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RelativeError {
    /// The anchor is infinite or NaN.
    Anchor(NonFinite),
    /// A box is invalid.
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

/// `p - anchor`, rounded to nearest; infinite beyond the range.
fn relative(p: Vec3<f64>, anchor: Vec3<f64>) -> [f32; 3] {
    Vec3::<f32>::from_f64(p - anchor).to_array()
}

impl RelativeBoxes {
    /// Converts boxes.
    ///
    /// # Errors
    /// An anchor that is not finite; the first box that fails [`Aabb::check`].
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
    /// An anchor that is not finite; nothing is then changed.
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

    /// The point that `f32` coordinates are relative to.
    #[must_use]
    pub fn anchor(&self) -> Vec3<f64> {
        self.anchor
    }

    /// The boxes, as they were given.
    #[must_use]
    pub fn boxes(&self) -> &[Aabb<f64>] {
        &self.exact
    }
}

impl RelativeBoxes {
    /// Binds the boxes to a frustum, with its half spaces relative to the anchor.
    pub(super) fn seen_by(&self, culler: &Culler) -> RelativeQuery<'_> {
        RelativeQuery {
            planes: FacePlanes::relative_to(culler.half_spaces(), self.anchor),
            near: Stored::from(&self.near),
            exact: &self.exact,
        }
    }
}

/// Relative boxes, and half spaces relative to their anchor.
pub struct RelativeQuery<'a> {
    pub(super) planes: FacePlanes<f32>,
    near: Stored<'a, f32>,
    exact: &'a [Aabb<f64>],
}

impl Volumes<f32, 6> for RelativeQuery<'_> {
    fn len(&self) -> usize {
        self.exact.len()
    }

    fn volume(&self, index: usize) -> Option<Volume> {
        self.exact.get(index).copied().map(Volume::from)
    }

    fn block(&self, start: usize) -> Option<(&Block<f32, 6>, f32)> {
        self.near.block(start)
    }

    #[cfg(simd)]
    fn arrays(&self) -> Option<[&[f32]; 6]> {
        None
    }

    fn components(&self, index: usize) -> [f32; 6] {
        self.near.components(index)
    }

    #[cfg(simd)]
    fn is_usual(components: [f32; 6]) -> bool {
        is_usual(components)
    }

    #[cfg(simd)]
    fn classify_block(
        level: Level,
        planes: &FacePlanes<f32>,
        block: &Block<f32, 6>,
        largest: Option<f32>,
        inside: bool,
    ) -> BlockAnswers {
        kernels::boxes::classify_f32(level, planes, block, largest, inside)
    }

    #[cfg(not(simd))]
    fn classify_one() -> Classify<f32, 6> {
        *super::one::Boxes.single()
    }
}
