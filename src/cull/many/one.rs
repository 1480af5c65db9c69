//! The kernels' work without vector registers, a volume at a time: the same ideas and bounds.
//!
//! The first face that a volume is outside of ends the search. The code is as plain as it is so that
//! it is fast in unoptimised builds too, where each call of a small function counts: no closures, no
//! iterators, and one version for each scalar type, as operators of a generic type are calls.

use crate::frustum::eval::planes::{FacePlane, FacePlanes};
use crate::math::{PerReal, Real};

/// Classifies one volume of K components: 1 or 0 for certainly outside, certainly inside, class
/// certain. The threshold may be that of a block of valid volumes; without `inside` only *outside*
/// is decided.
pub(super) type Classify<T, const K: usize> =
    fn(&FacePlanes<T>, &[T; K], Option<T>, bool) -> [u64; 3];

/// The functions for boxes.
pub(super) struct Boxes;

impl PerReal for Boxes {
    type Of<T: Real> = Classify<T, 6>;

    fn single(&self) -> &Classify<f32, 6> {
        &(single::classify_box as _)
    }

    fn double(&self) -> &Classify<f64, 6> {
        &(double::classify_box as _)
    }
}

/// The functions for spheres.
pub(super) struct Spheres;

impl PerReal for Spheres {
    type Of<T: Real> = Classify<T, 4>;

    fn single(&self) -> &Classify<f32, 4> {
        &(single::classify_sphere as _)
    }

    fn double(&self) -> &Classify<f64, 4> {
        &(double::classify_sphere as _)
    }
}

const OUTSIDE: [u64; 3] = [1, 0, 1];

/// Whether all of a volume's least values are certainly positive, and one certainly negative, for
/// a volume that is certainly not outside.
fn within(is_inside: bool, is_crossed: bool) -> [u64; 3] {
    [0, u64::from(is_inside), u64::from(is_inside || is_crossed)]
}

/// `n . p + offset` at a corner of a box.
macro_rules! at {
    ($plane:expr, $b:ident, $corner:literal, $offset:expr) => {{
        let (n, c) = (&$plane.normal, &$plane.corners[$corner]);
        n[0] * $b[c[0]] + (n[1] * $b[c[1]] + (n[2] * $b[c[2]] + $offset))
    }};
}

macro_rules! classify {
    ($module:ident, $t:ident) => {
        mod $module {
            use super::*;

            /// See `kernels/boxes.rs`.
            pub(super) fn classify_box(
                planes: &FacePlanes<$t>,
                b: &[$t; 6],
                threshold: Option<$t>,
                inside: bool,
            ) -> [u64; 3] {
                let threshold = match threshold {
                    Some(threshold) => threshold,
                    None if b[0] <= b[3] && b[1] <= b[4] && b[2] <= b[5] => {
                        // For a <= b, |a + b| + (b - a) is twice the larger of their magnitudes:
                        // which that is cannot be predicted. Rounding, a few u of it, is far
                        // below what the factor has to spare.
                        let size = ((b[0] + b[3]).abs() + (b[3] - b[0]))
                            + ((b[1] + b[4]).abs() + (b[4] - b[1]))
                            + ((b[2] + b[5]).abs() + (b[5] - b[2]));
                        planes.factor * (0.5 * size) + planes.constant
                    }
                    None => $t::INFINITY,
                };
                let near = &planes.near;
                let value = at!(near, b, 0, near.offset);
                if value < -threshold {
                    return OUTSIDE;
                }
                let (mut is_within, mut face) = (value > threshold, 0);
                while face < 4 {
                    let side = &planes.sides[face];
                    let value = at!(side, b, 0, side.offset);
                    if value < -threshold {
                        return OUTSIDE;
                    }
                    is_within &= value > threshold;
                    face += 1;
                }
                let opposite = at!(near, b, 1, 0.0);
                let value = planes.far - opposite;
                if value < -threshold {
                    return OUTSIDE;
                }
                is_within &= value > threshold;
                if !inside || !is_within {
                    return [0, 0, u64::from(is_within)];
                }
                let (value, far) = (opposite + near.offset, planes.far - at!(near, b, 0, 0.0));
                let mut is_inside = value > threshold && far > threshold;
                let mut is_crossed = value < -threshold || far < -threshold;
                face = 0;
                while face < 4 {
                    let side = &planes.sides[face];
                    let value = at!(side, b, 1, side.offset);
                    is_inside &= value > threshold;
                    is_crossed |= value < -threshold;
                    face += 1;
                }
                within(is_inside, is_crossed)
            }

            /// See `kernels/spheres.rs`.
            pub(super) fn classify_sphere(
                planes: &FacePlanes<$t>,
                s: &[$t; 4],
                _: Option<$t>,
                inside: bool,
            ) -> [u64; 3] {
                let [x, y, z, radius] = *s;
                // NaN among them makes the threshold NaN: nothing is then certain.
                let size = 3.0 * (x.abs() + y.abs() + z.abs()) + radius;
                let threshold = if radius >= 0.0 {
                    planes.factor * size + planes.constant
                } else {
                    $t::INFINITY
                };
                let near = &planes.near;
                let n = &near.normal;
                let along = x * n[0] + (y * n[1] + z * n[2]);
                let mut reach = radius * near.length;
                let (mut center, mut face) = (along + near.offset, 0);
                let (mut is_within, mut is_inside, mut is_crossed) = (true, true, false);
                loop {
                    let (greatest, least) = (center + reach, center - reach);
                    if greatest < -threshold {
                        return OUTSIDE;
                    }
                    is_within &= greatest > threshold;
                    is_inside &= least > threshold;
                    is_crossed |= least < -threshold;
                    if face == 5 {
                        break;
                    }
                    if face == 4 {
                        (center, reach) = (planes.far - along, radius * near.length);
                    } else {
                        let side = &planes.sides[face];
                        let n = &side.normal;
                        center = x * n[0] + (y * n[1] + (z * n[2] + side.offset));
                        reach = radius * side.length;
                    }
                    face += 1;
                }
                if !inside || !is_within {
                    return [0, 0, u64::from(is_within)];
                }
                within(is_inside, is_crossed)
            }
        }
    };
}

classify!(single, f32);
classify!(double, f64);
