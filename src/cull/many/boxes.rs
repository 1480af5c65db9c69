//! Where boxes are stored: arrays, slices, sets.

#[cfg(simd)]
use super::block_driver::BlockAnswers;
use super::block_driver::{Block, Volumes};
use super::box_set::{BoxSet, Stored};
#[cfg(simd)]
use super::kernels;
#[cfg(not(simd))]
use super::one::Classify;
use crate::cull::{Aabb, Volume};
use crate::frustum::eval::planes::FacePlanes;
use crate::math::{Real, Vec3};
#[cfg(simd)]
use crate::simd::Level;

/// Boxes as six arrays (structure of arrays), a source of a query.
///
/// The shortest array determines the number of boxes; the rest of longer ones is ignored.
///
/// ```
/// use frusta::cull::BoxArrays;
/// use frusta::{Culler, EndRect, Frustum, Pose, Shape};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let (low, high) = ([0.0_f32, 1.0, 8.0], [1.0, 2.0, 9.0]);
/// let boxes = BoxArrays { min: [&low; 3], max: [&high; 3] };
/// let mut visible = Vec::new();
/// Culler::new(&frustum).over(boxes).visible(&mut visible)?;
/// assert_eq!(visible, [0, 1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BoxArrays<'a, T> {
    /// The least x, y and z of each box.
    pub min: [&'a [T]; 3],
    /// The greatest x, y and z of each box.
    pub max: [&'a [T]; 3],
}

/// Boxes in one of three layouts.
#[derive(Clone, Copy, Debug)]
pub enum Boxes<'a, T> {
    Arrays(BoxArrays<'a, T>),
    Slice(&'a [Aabb<T>]),
    Set(Stored<'a, T>),
}

impl<'a, T> From<BoxArrays<'a, T>> for Boxes<'a, T> {
    fn from(arrays: BoxArrays<'a, T>) -> Self {
        Boxes::Arrays(arrays)
    }
}

impl<'a, T: Copy> From<&BoxArrays<'a, T>> for Boxes<'a, T> {
    fn from(arrays: &BoxArrays<'a, T>) -> Self {
        Boxes::Arrays(*arrays)
    }
}

impl<'a, T> From<&'a [Aabb<T>]> for Boxes<'a, T> {
    fn from(boxes: &'a [Aabb<T>]) -> Self {
        Boxes::Slice(boxes)
    }
}

impl<'a, T> From<&'a Vec<Aabb<T>>> for Boxes<'a, T> {
    fn from(boxes: &'a Vec<Aabb<T>>) -> Self {
        Boxes::Slice(boxes)
    }
}

impl<'a, T, const N: usize> From<&'a [Aabb<T>; N]> for Boxes<'a, T> {
    fn from(boxes: &'a [Aabb<T>; N]) -> Self {
        Boxes::Slice(boxes)
    }
}

impl<'a, T> From<&'a BoxSet<T>> for Boxes<'a, T> {
    fn from(set: &'a BoxSet<T>) -> Self {
        Boxes::Set(set.into())
    }
}

impl<T: Real> Boxes<'_, T> {
    pub(super) fn len(&self) -> usize {
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => {
                let all = min.iter().chain(max).map(|a| a.len());
                all.min().unwrap_or(0)
            }
            Boxes::Slice(boxes) => boxes.len(),
            Boxes::Set(set) => set.len(),
        }
    }

    pub(super) fn get(&self, index: usize) -> Option<Aabb<T>> {
        let of = |arrays: &[&[T]; 3]| {
            let [x, y, z] = arrays.map(|a| a.get(index).copied());
            Some(Vec3::new(x?, y?, z?))
        };
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => Some(Aabb {
                min: of(min)?,
                max: of(max)?,
            }),
            Boxes::Slice(boxes) => boxes.get(index).copied(),
            Boxes::Set(set) => set.get(index),
        }
    }
}

/// Whether a box is finite, and not inverted.
#[cfg(simd)]
pub(super) fn is_usual<T: Real>([x0, y0, z0, x1, y1, z1]: [T; 6]) -> bool {
    let all = Aabb::new([x0, y0, z0], [x1, y1, z1]);
    all.min.is_finite() && all.max.is_finite() && all.check().is_ok()
}

impl<T: Real> Volumes<T, 6> for Boxes<'_, T> {
    fn len(&self) -> usize {
        self.len()
    }

    fn volume(&self, index: usize) -> Option<Volume> {
        self.get(index).map(Volume::from)
    }

    fn block(&self, start: usize) -> Option<(&Block<T, 6>, T)> {
        match self {
            Boxes::Set(set) => set.block(start),
            _ => None,
        }
    }

    #[cfg(simd)]
    fn arrays(&self) -> Option<[&[T]; 6]> {
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => {
                Some([min[0], min[1], min[2], max[0], max[1], max[2]])
            }
            _ => None,
        }
    }

    fn components(&self, index: usize) -> [T; 6] {
        match self {
            Boxes::Arrays(BoxArrays { min, max }) => [
                min[0][index],
                min[1][index],
                min[2][index],
                max[0][index],
                max[1][index],
                max[2][index],
            ],
            Boxes::Slice(boxes) => {
                let Aabb { min, max } = &boxes[index];
                [min.x, min.y, min.z, max.x, max.y, max.z]
            }
            Boxes::Set(set) => set.components(index),
        }
    }

    #[cfg(simd)]
    fn is_usual(components: [T; 6]) -> bool {
        is_usual(components)
    }

    #[cfg(simd)]
    fn classify_block(
        level: Level,
        planes: &FacePlanes<T>,
        block: &Block<T, 6>,
        largest: Option<T>,
        inside: bool,
    ) -> BlockAnswers {
        T::pick(&kernels::boxes::Boxes)(level, planes, block, largest, inside)
    }

    #[cfg(not(simd))]
    fn classify_one() -> Classify<T, 6> {
        *T::pick(&super::one::Boxes)
    }
}
