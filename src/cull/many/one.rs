//! The kernels' work without vector registers, a volume at a time: the same ideas and bounds.
//!
//! The first face that a volume is outside of ends the search.

use crate::frustum::eval::planes::{FacePlane, FacePlanes};
use crate::math::Real;

/// Whether a volume is certainly outside, certainly inside, its class certain: 1 or 0 each.
type Masks = [u64; 3];

const OUTSIDE: Masks = [1, 0, 1];

/// See `kernels/boxes.rs`.
pub(super) fn classify_box<T: Real>(
    planes: &FacePlanes<T>,
    volume: &[T; 6],
    largest: Option<T>,
    inside: bool,
) -> Masks {
    let (largest, is_valid) = match largest {
        Some(largest) => (largest, true),
        None => check(volume),
    };
    let threshold = planes.threshold(largest + largest + largest, is_valid);
    let near = &planes.near;
    let at = |plane: &FacePlane<T>, corner: usize, offset: T| {
        let [(a, i), (b, j), (c, k)] =
            [0, 1, 2].map(|n| (plane.normal[n], plane.corners[corner][n]));
        a * volume[i] + (b * volume[j] + (c * volume[k] + offset))
    };
    let mut faces = Faces::new(threshold);
    let farthest = at(near, 0, near.offset);
    let opposite = at(near, 1, T::ZERO);
    if faces.put_greatest(farthest) || faces.put_greatest(planes.far - opposite) {
        return OUTSIDE;
    }
    for side in &planes.sides {
        if faces.put_greatest(at(side, 0, side.offset)) {
            return OUTSIDE;
        }
    }
    if !inside || !faces.is_within {
        return [0, 0, u64::from(!inside && faces.is_within)];
    }
    faces.put_least(opposite + near.offset);
    faces.put_least(planes.far - at(near, 0, T::ZERO));
    for side in &planes.sides {
        faces.put_least(at(side, 1, side.offset));
    }
    faces.finish()
}

/// The largest magnitude, and whether `min <= max`.
fn check<T: Real>(&[x0, y0, z0, x1, y1, z1]: &[T; 6]) -> (T, bool) {
    let mut largest = T::ZERO;
    for value in [-x0, -y0, -z0, x1, y1, z1] {
        if value > largest {
            largest = value;
        }
    }
    (largest, x0 <= x1 && y0 <= y1 && z0 <= z1)
}

/// See `kernels/spheres.rs`.
pub(super) fn classify_sphere<T: Real>(
    planes: &FacePlanes<T>,
    &[x, y, z, radius]: &[T; 4],
    inside: bool,
) -> Masks {
    let mut most = T::ZERO;
    for value in [x.abs(), y.abs(), z.abs()] {
        if value > most {
            most = value;
        }
    }
    let is_valid = radius >= T::ZERO && x == x && y == y && z == z;
    let threshold = planes.threshold(most + most + most + radius, is_valid);
    let near = &planes.near;
    let along = |plane: &FacePlane<T>, offset: T| {
        let [a, b, c] = plane.normal;
        x * a + (y * b + (z * c + offset))
    };
    let from_zero = along(near, T::ZERO);
    let nearest = from_zero + near.offset;
    let farthest = planes.far - from_zero;
    let sides = planes.sides.iter();
    let sides = sides.map(|side| (along(side, side.offset), radius * side.length));
    let reach = radius * near.length;
    let mut faces = Faces::new(threshold);
    for (center, reach) in [(nearest, reach), (farthest, reach)]
        .into_iter()
        .chain(sides)
    {
        if faces.put_greatest(center + reach) {
            return OUTSIDE;
        }
        faces.put_least(center - reach);
    }
    if inside {
        faces.finish()
    } else {
        [0, 0, u64::from(faces.is_within)]
    }
}

/// What is known of a volume, face by face.
struct Faces<T> {
    threshold: T,
    /// Some of it is certainly on the inner side of each face.
    is_within: bool,
    /// All of it is.
    is_inside: bool,
    /// Some of it is certainly on the outer side of a face.
    is_crossed: bool,
}

impl<T: Real> Faces<T> {
    fn new(threshold: T) -> Self {
        Self {
            threshold,
            is_within: true,
            is_inside: true,
            is_crossed: false,
        }
    }

    /// Takes the greatest value of a face; true if it is certainly negative.
    fn put_greatest(&mut self, value: T) -> bool {
        self.is_within &= value > self.threshold;
        value < -self.threshold
    }

    /// Takes the least value of a face.
    fn put_least(&mut self, value: T) {
        self.is_inside &= value > self.threshold;
        self.is_crossed |= value < -self.threshold;
    }

    fn finish(self) -> Masks {
        let inside = self.is_within && self.is_inside;
        let decided = inside || self.is_within && self.is_crossed;
        [0, u64::from(inside), u64::from(decided)]
    }
}
