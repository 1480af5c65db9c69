//! Where spheres are stored: arrays and slices.

#[cfg(simd)]
use super::block_driver::BlockAnswers;
use super::block_driver::{Block, Volumes};
#[cfg(simd)]
use super::kernels;
#[cfg(not(simd))]
use super::one::Classify;
use crate::cull::{Sphere, Volume};
use crate::frustum::eval::planes::FacePlanes;
use crate::math::{Real, Vec3};
#[cfg(simd)]
use crate::simd::Level;

/// Spheres as four arrays (structure of arrays), a source of a query.
///
/// The shortest array determines the number of spheres; the rest of longer ones is ignored.
///
/// ```
/// use frusta::cull::SphereArrays;
/// use frusta::{Culler, EndRect, Frustum, Pose, Shape};
/// # let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
/// # let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
/// # let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far })?;
/// let (zero, z, radius) = ([0.0; 2], [2.0, 5.0], [0.5, 1.0]);
/// let spheres = SphereArrays { center: [&zero, &zero, &z], radius: &radius };
/// let mut visible = Vec::new();
/// Culler::new(&frustum).over(spheres).visible(&mut visible)?;
/// assert_eq!(visible, [0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SphereArrays<'a, T> {
    /// The x, y and z of each center.
    pub center: [&'a [T]; 3],
    /// The radius of each sphere.
    pub radius: &'a [T],
}

/// Spheres in one of two layouts.
#[derive(Clone, Copy, Debug)]
pub enum Spheres<'a, T> {
    Arrays(SphereArrays<'a, T>),
    Slice(&'a [Sphere<T>]),
}

impl<'a, T> From<SphereArrays<'a, T>> for Spheres<'a, T> {
    fn from(arrays: SphereArrays<'a, T>) -> Self {
        Spheres::Arrays(arrays)
    }
}

impl<'a, T: Copy> From<&SphereArrays<'a, T>> for Spheres<'a, T> {
    fn from(arrays: &SphereArrays<'a, T>) -> Self {
        Spheres::Arrays(*arrays)
    }
}

impl<'a, T> From<&'a [Sphere<T>]> for Spheres<'a, T> {
    fn from(spheres: &'a [Sphere<T>]) -> Self {
        Spheres::Slice(spheres)
    }
}

impl<'a, T> From<&'a Vec<Sphere<T>>> for Spheres<'a, T> {
    fn from(spheres: &'a Vec<Sphere<T>>) -> Self {
        Spheres::Slice(spheres)
    }
}

impl<'a, T, const N: usize> From<&'a [Sphere<T>; N]> for Spheres<'a, T> {
    fn from(spheres: &'a [Sphere<T>; N]) -> Self {
        Spheres::Slice(spheres)
    }
}

impl<T: Real> Spheres<'_, T> {
    pub(super) fn len(&self) -> usize {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => {
                let all = center.iter().map(|a| a.len());
                all.fold(radius.len(), usize::min)
            }
            Spheres::Slice(spheres) => spheres.len(),
        }
    }

    pub(super) fn get(&self, index: usize) -> Option<Sphere<T>> {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => {
                let [x, y, z] = center.map(|a| a.get(index).copied());
                Some(Sphere {
                    center: Vec3::new(x?, y?, z?),
                    radius: *radius.get(index)?,
                })
            }
            Spheres::Slice(spheres) => spheres.get(index).copied(),
        }
    }
}

impl<T: Real> Volumes<T, 4> for Spheres<'_, T> {
    fn len(&self) -> usize {
        self.len()
    }

    fn volume(&self, index: usize) -> Option<Volume> {
        self.get(index).map(Volume::from)
    }

    fn block(&self, _: usize) -> Option<(&Block<T, 4>, T)> {
        None
    }

    #[cfg(simd)]
    fn arrays(&self) -> Option<[&[T]; 4]> {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => {
                Some([center[0], center[1], center[2], radius])
            }
            Spheres::Slice(_) => None,
        }
    }

    fn components(&self, index: usize) -> [T; 4] {
        match self {
            Spheres::Arrays(SphereArrays { center, radius }) => [
                center[0][index],
                center[1][index],
                center[2][index],
                radius[index],
            ],
            Spheres::Slice(spheres) => {
                let Sphere { center, radius } = &spheres[index];
                [center.x, center.y, center.z, *radius]
            }
        }
    }

    #[cfg(simd)]
    fn is_usual([x, y, z, radius]: [T; 4]) -> bool {
        Sphere::new([x, y, z], radius).check().is_ok()
    }

    #[cfg(simd)]
    fn classify_block(
        level: Level,
        planes: &FacePlanes<T>,
        block: &Block<T, 4>,
        largest: Option<T>,
        inside: bool,
    ) -> BlockAnswers {
        T::pick(&kernels::spheres::Spheres)(level, planes, block, largest, inside)
    }

    #[cfg(not(simd))]
    fn classify_one() -> Classify<T, 4> {
        *T::pick(&super::one::Spheres)
    }
}
