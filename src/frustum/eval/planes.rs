//! A frustum's face planes in the scalar type of many volumes or segments.
//!
//! They are those of [`crate::frustum::eval::half_space`], scaled so that the largest component
//! of a normal is between 1/2 and 1, rounded to `T`. So one threshold serves all faces: with u
//! the unit roundoff of `T`, a value is off by less than `8 u S + 8 u |d|`, plus what underflow
//! does (see `cull/many/boxes.rs` and `cull/many/spheres.rs`).

use crate::exact::float::exp2;
use crate::frustum::eval::half_space::HalfSpace;
use crate::math::{PerReal, Real, Vec3};

/// A half space `normal . p + offset >= 0`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FacePlane<T> {
    pub(crate) normal: [T; 3],
    /// Which of a box's six components, the least coordinates and then the greatest, are the
    /// coordinates of the corner farthest along the normal; and those of the opposite corner.
    pub(crate) corners: [[usize; 3]; 2],
    pub(crate) offset: T,
    /// The normal's length.
    pub(crate) length: T,
}

/// The face planes of a frustum.
#[derive(Clone, Debug)]
pub(crate) struct FacePlanes<T> {
    /// The near face, and the far one's offset: its normal is the negative of the near
    /// one's. Infinite where there is no far face.
    pub(crate) near: FacePlane<T>,
    pub(crate) far: T,
    pub(crate) sides: [FacePlane<T>; 4],
    /// 8 u: bounds rounding errors relative to sizes.
    pub(crate) factor: T,
    /// The part of the threshold that does not depend on sizes; infinite where no value is
    /// certain.
    pub(crate) constant: T,
}

/// The farthest and the opposite corner, by whether the normal points towards larger coordinates.
fn corners(up: [bool; 3]) -> [[usize; 3]; 2] {
    let farthest = [0, 1, 2].map(|axis| axis + 3 * usize::from(up[axis]));
    [farthest, farthest.map(|k| (k + 3) % 6)]
}

/// Bounds for underflow and for offsets: what underflow does to a value is far below the first,
/// and while offsets are below the second no sum overflows before a size does.
const fn range<T: Real>() -> (f64, f64) {
    if T::DIGITS == 24 {
        (exp2(-100), exp2(90))
    } else {
        (exp2(-900), exp2(900))
    }
}

impl<T: Real> FacePlanes<T> {
    /// The error bound of values at a size; infinite for a block with an invalid volume.
    #[inline(always)]
    pub(crate) fn threshold(&self, size: T, is_valid: bool) -> T {
        let more = if is_valid { 0.0 } else { f64::INFINITY };
        self.factor * size + (self.constant + T::from_f64(more))
    }

    /// The normal and the offset of a face, by its index.
    #[inline(always)]
    pub(crate) fn face(&self, face: usize) -> ([T; 3], T) {
        let FacePlane { normal, offset, .. } = self.near;
        match face {
            0 => (normal, offset),
            1 => (normal.map(|n| -n), self.far),
            _ => {
                let side = &self.sides[(face - 2) & 3];
                (side.normal, side.offset)
            }
        }
    }

    /// From the faces in the order of [`crate::Frustum::faces`]: five or six.
    pub(crate) fn new(faces: &[HalfSpace]) -> Self {
        Self::with_offsets(faces, |h| h.rounded()[3])
    }

    /// For coordinates relative to an anchor.
    pub(crate) fn relative_to(faces: &[HalfSpace], anchor: Vec3<f64>) -> Self {
        Self::with_offsets(faces, |h| h.value_rounded(anchor))
    }

    fn with_offsets(faces: &[HalfSpace], offset: impl Fn(&HalfSpace) -> f64) -> Self {
        let plane = |h: &HalfSpace| {
            let [a, b, c, _] = h.rounded().map(T::from_f64);
            let d = T::from_f64(offset(h));
            FacePlane {
                normal: [a, b, c],
                corners: corners([0, 1, 2].map(|axis| h.points_up(axis))),
                offset: d,
                length: T::from_f64(h.length()),
            }
        };
        let nothing = FacePlane {
            normal: [T::ZERO; 3],
            corners: corners([false; 3]),
            offset: T::ZERO,
            length: T::ZERO,
        };
        let offsets = faces.iter().map(|h| offset(h).abs());
        let largest = offsets.fold(0.0, f64::max);
        let u = T::UNIT_ROUNDOFF;
        let (underflow, largest_offset) = range::<T>();
        let (ends, sides) = faces.split_at(faces.len().saturating_sub(4));
        let mut side_planes = [nothing; 4];
        side_planes
            .iter_mut()
            .zip(sides)
            .for_each(|(to, h)| *to = plane(h));
        let constant = if largest < largest_offset && sides.len() == 4 {
            // Rounded up: the sum of two positive numbers is not less than half of it.
            T::from_f64(8.0 * u * largest + underflow).next_up()
        } else {
            T::from_f64(f64::INFINITY)
        };
        Self {
            near: ends.first().map_or(nothing, plane),
            far: ends
                .get(1)
                .map_or(T::from_f64(f64::INFINITY), |h| plane(h).offset),
            sides: side_planes,
            factor: T::from_f64(8.0 * u),
            constant,
        }
    }
}

/// The face planes in both scalar types.
#[derive(Clone, Debug)]
pub(crate) struct FacePlanesPair {
    single: FacePlanes<f32>,
    double: FacePlanes<f64>,
}

impl FacePlanesPair {
    pub(crate) fn new(faces: &[HalfSpace]) -> Self {
        Self {
            single: FacePlanes::new(faces),
            double: FacePlanes::new(faces),
        }
    }
}

impl PerReal for FacePlanesPair {
    type Of<T: Real> = FacePlanes<T>;

    fn single(&self) -> &FacePlanes<f32> {
        &self.single
    }

    fn double(&self) -> &FacePlanes<f64> {
        &self.double
    }
}
