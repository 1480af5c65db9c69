//! The shapes and poses of the families that strain arithmetic. The parameters of each family
//! are those of its description.

use super::family::Family;
use super::placement::Placement;
use super::random::Random;
use super::scene::{
    any_rect, any_shape, finite, infinite, off_axis, orthographic, pyramid, symmetric,
};
use super::solid::Solid;
use crate::frustum::Shape;
use crate::math::{Pose, Rect, Vec3};

/// tan(0.0005 degrees) and tan(0.5e-8 radians).
const NARROW: [f64; 2] = [8.726_646_260_193_79e-6, 5e-9];
/// tan(89.9999995 degrees).
const WIDE: f64 = 114_591_559.026_164_5;

/// Whether a block far from the origin has a shape of size 1e-3 at an origin of 1e15; the others
/// have a shape with coordinates of 1e15. It is not random: the second kind may be flat, and
/// another attempt must not turn it into the first.
fn is_small(block: u64) -> bool {
    block.is_multiple_of(2)
}

/// The frustum of a block in its own frame.
pub(crate) fn shape(family: Family, block: u64, random: &mut Random) -> Shape {
    match family {
        Family::OffAxis => off_axis(random),
        Family::Orthographic => orthographic(random),
        Family::Pyramid => pyramid(random),
        Family::Infinite => infinite(random),
        Family::HalfLattice => lattice(random),
        Family::NearFarRatio
        | Family::FlatDepth
        | Family::NarrowView
        | Family::WideView
        | Family::Aspect => view(family, random),
        Family::FarFromOrigin if is_small(block) => finite(
            -1e-3,
            Rect::centred(1e-3, 1e-3),
            1e-3,
            Rect::centred(2e-3, 3e-3),
        ),
        Family::FarFromOrigin => few_ulps(random, 1e15),
        Family::Subnormal => subnormal(random),
        Family::ProductsUnderflow => scaled(&any_shape(random), 1e-160),
        Family::ProductsOverflow => scaled(&any_shape(random), 1e155),
        Family::Huge => scaled(&any_shape(random), 1e298),
        Family::SingleFar => far_in_f32(random),
        Family::CrossingNearEnds => through_zero(random),
        Family::CrossingClose => {
            // The edge between near and right is the y axis.
            let far = 2.0_f64.powi(60);
            let rect = Rect::new(-far, 0.0, -1.0, 1.0);
            finite(0.0, rect, far, rect)
        }
        Family::Shear => shear(random),
        Family::ApexWidth => apex_width(random),
        Family::EarthCentred => scaled(&any_shape(random), random.power_of_ten(-4, 4)),
        Family::Astronomical => scaled(&any_shape(random), random.power_of_ten(3, 16)),
        Family::BehindApex => match random.below(3) {
            0 => pyramid(random),
            1 => Solid::SYMMETRIC.shape,
            _ => symmetric(
                random.between(0.1, 5.0),
                random.between(6.0, 90.0),
                0.75,
                0.5,
            ),
        },
        Family::MixedScale => mixed_scale(random),
        Family::Thin => thin(random),
        _ => any_shape(random),
    }
}

/// Stiff proportions at ordinary sizes.
fn view(family: Family, random: &mut Random) -> Shape {
    match family {
        Family::NearFarRatio => {
            let near = random.power_of_ten(-30, -3);
            let far = if random.one_in(2) { 1.0 } else { 1000.0 };
            symmetric(near * far, far, random.between(0.1, 2.0), 0.5)
        }
        Family::FlatDepth => {
            let near = random.between(1.0, 100.0) * random.sign();
            let far = if random.one_in(4) {
                near.next_down()
            } else {
                near.next_up()
            };
            finite(near, any_rect(random, 8.0), far, any_rect(random, 8.0))
        }
        Family::NarrowView => {
            let w = random.pick(&NARROW);
            symmetric(1.0, random.between(2.0, 1000.0), w, w)
        }
        Family::WideView => symmetric(
            random.between(0.01, 1.0),
            random.between(2.0, 1000.0),
            WIDE,
            WIDE,
        ),
        Family::Aspect => {
            let (w, h) = random.pick(&[(1e6, 1.0), (1.0, 1e6), (1.0, 1e-6), (1e-6, 1.0)]);
            symmetric(random.between(0.1, 1.0), random.between(2.0, 100.0), w, h)
        }
        _ => any_shape(random),
    }
}

/// Whether the shape's numbers may be rounded to `f32` without losing the family's property.
pub(crate) fn is_ordinary(family: Family) -> bool {
    let fine = matches!(
        family,
        Family::ApexWidth | Family::Thin | Family::Astronomical
    );
    family.has_f32() && !fine
}

/// The pose of a block, if it is not an exact placement.
pub(crate) fn pose(family: Family, block: u64, random: &mut Random) -> Option<Pose> {
    match family {
        Family::FreePose => Some(free_pose(random)),
        Family::Random if random.one_in(2) => Some(free_pose(random)),
        Family::FarFromOrigin if is_small(block) => {
            // Its origin is its only representable point.
            let origin = Vec3::new(1e15, -1e15, 1e15 + 0.125);
            let axes = if random.one_in(2) {
                Pose::IDENTITY.axes
            } else {
                unit_rotation(random)
            };
            Some(Pose::new(origin, axes))
        }
        Family::Shear if random.one_in(2) => {
            let k = random.pick(&[1e6, 1e-6]) * random.sign();
            let [x, y, z] = Pose::IDENTITY.axes;
            let axes = match random.below(3) {
                0 => [x + z * k, y, z],
                1 => [x, y + x * k, z],
                _ => [x, y + z * k, z + x * k * 0.5],
            };
            Some(Pose::new(Vec3::new(0.0, 0.0, 0.0), axes))
        }
        Family::EarthCentred => {
            let direction = unit_rotation(random)[0];
            Some(Pose::new(direction * 6.378e6, unit_rotation(random)))
        }
        Family::Astronomical => {
            let direction = unit_rotation(random)[0];
            Some(Pose::new(direction * 1e18, unit_rotation(random)))
        }
        _ => None,
    }
}

/// The placement of a block that has no pose of its own.
pub(crate) fn placement(family: Family, random: &mut Random) -> Placement {
    let rotates = !matches!(
        family,
        Family::HalfLattice
            | Family::CrossingNearEnds
            | Family::CrossingClose
            | Family::FlatDepth
            | Family::FarFromOrigin
            | Family::SingleFar
    );
    if random.one_in(2) {
        Placement::IDENTITY
    } else if rotates && random.one_in(2) {
        let mut entry = || random.integer(-4, 4) as i8;
        Placement::rotated([1 + entry().abs(), entry(), entry(), entry()])
    } else {
        random.pick(&Placement::signed_permutations())
    }
}

/// A rotation matrix with rounded entries.
fn unit_rotation(random: &mut Random) -> [Vec3<f64>; 3] {
    let mut entry = || random.between(-1.0, 1.0);
    let (w, x, y, z) = (1.5 + entry(), entry(), entry(), entry());
    let s = 2.0 / (w * w + x * x + y * y + z * z);
    [
        Vec3::new(
            1.0 - s * (y * y + z * z),
            s * (x * y + w * z),
            s * (x * z - w * y),
        ),
        Vec3::new(
            s * (x * y - w * z),
            1.0 - s * (x * x + z * z),
            s * (y * z + w * x),
        ),
        Vec3::new(
            s * (x * z + w * y),
            s * (y * z - w * x),
            1.0 - s * (x * x + y * y),
        ),
    ]
}

fn free_pose(random: &mut Random) -> Pose {
    let mut axes = unit_rotation(random);
    if random.one_in(2) {
        // Skew axes of unequal lengths and either handedness.
        let k = random.between(-0.5, 0.5);
        axes = [
            axes[0] + axes[1] * k,
            axes[1] * random.sign(),
            axes[2] * random.between(0.1, 10.0),
        ];
    }
    let size = random.power_of_ten(-2, 3);
    let mut entry = || random.between(-size, size);
    Pose::new(Vec3::new(entry(), entry(), entry()), axes)
}

fn scaled(shape: &Shape, factor: f64) -> Shape {
    let times = |r: Rect| {
        let [left, right, bottom, top] = r.to_array().map(|v| v * factor);
        Rect::new(left, right, bottom, top)
    };
    let mut shape = *shape;
    let (Shape::Finite { near, .. } | Shape::Infinite { near, .. }) = &mut shape;
    near.z *= factor;
    near.rect = times(near.rect);
    if let Shape::Finite { far, .. } = &mut shape {
        far.z *= factor;
        far.rect = times(far.rect);
    }
    shape
}

/// Two rectangles of integers times `unit`, moved by `offset`.
fn integer_pair(random: &mut Random, unit: f64, offset: f64, size: i64) -> Shape {
    let mut pair = || {
        let (a, b) = (random.integer(-size, size), random.integer(-size, size));
        let to = |k: i64| offset + k as f64 * unit;
        (to(a.min(b)), to(a.max(b)))
    };
    let mut rect = || {
        let ((left, right), (bottom, top)) = (pair(), pair());
        Rect::new(left, right, bottom, top)
    };
    let (a, b) = (rect(), rect());
    let (near, far) = pair();
    if random.one_in(2) {
        finite(near, a, far, b)
    } else {
        finite(far, a, near, b)
    }
}

fn lattice(random: &mut Random) -> Shape {
    integer_pair(random, 1.0, 0.0, 6)
}

fn few_ulps(random: &mut Random, offset: f64) -> Shape {
    let unit = offset.next_up() - offset;
    let size = random.pick(&[2, 16, 4096]);
    integer_pair(random, unit, offset, size)
}

fn far_in_f32(random: &mut Random) -> Shape {
    let offset = random.pick(&[1e7_f32, 3e10, 1e15]);
    let unit = f64::from(offset.next_up()) - f64::from(offset);
    let size = random.pick(&[2, 16, 4096]);
    integer_pair(random, unit, f64::from(offset), size)
}

fn subnormal(random: &mut Random) -> Shape {
    let size = random.pick(&[4, 1 << 10, 1 << 40]);
    integer_pair(random, 5e-324, 0.0, size)
}

/// A shape with planes through zero, where values are dense.
fn through_zero(random: &mut Random) -> Shape {
    let far = random.between(1.0, 10.0);
    let (w, h) = (random.between(1.0, 4.0), random.between(1.0, 4.0));
    let near = Rect::new(-w, 0.0, 0.0, h);
    let widened = Rect::new(-2.0 * w, 0.0, 0.0, 3.0 * h);
    finite(
        0.0,
        near,
        far,
        if random.one_in(2) { near } else { widened },
    )
}

fn shear(random: &mut Random) -> Shape {
    let k = random.pick(&[1e6, 1e-6]) * random.sign();
    let rect = any_rect(random, 2.0);
    let mut moved = rect;
    if random.one_in(2) {
        (moved.left, moved.right) = (rect.left + k, rect.right + k);
    } else {
        (moved.bottom, moved.top) = (rect.bottom + k, rect.top + k);
    }
    finite(1.0, rect, random.between(2.0, 10.0), moved)
}

fn apex_width(random: &mut Random) -> Shape {
    let mut width = |at: f64| match random.below(3) {
        0 => (at, at),
        1 => (at, at.next_up()),
        _ => (0.0, 5e-324),
    };
    let ((left, right), (bottom, top)) = (width(0.75), width(-0.375));
    let apex = Rect::new(left, right, bottom, top);
    let base = any_rect(random, 20.0);
    if random.one_in(2) {
        finite(1.0, apex, random.between(2.0, 30.0), base)
    } else {
        finite(random.between(2.0, 30.0), base, 1.0, apex)
    }
}

/// A shape in which every number has its own exponent, from subnormal to 1e300.
fn mixed_scale(random: &mut Random) -> Shape {
    let mut number = || {
        let exponent = random.integer(-1074, 996) as i32;
        // Two steps, since the power itself may be subnormal.
        let half = 2.0_f64.powi(exponent / 2);
        random.between(1.0, 2.0) * random.sign() * half * 2.0_f64.powi(exponent - exponent / 2)
    };
    let mut pair = || {
        let (a, b) = (number(), number());
        (a.min(b), a.max(b))
    };
    let (near, far) = pair();
    let mut rect = || {
        let ((left, right), (bottom, top)) = (pair(), pair());
        Rect::new(left, right, bottom, top)
    };
    finite(near, rect(), far, rect())
}

/// A sheet one ulp thick.
fn thin(random: &mut Random) -> Shape {
    let at = random.between(1.0, 4.0);
    let after = at.next_up();
    let (bottom, top) = (random.between(-4.0, 0.0), random.between(1.0, 4.0));
    let sheet = |left, right| Rect::new(left, right, bottom, top);
    let (near, far) = match random.below(4) {
        // Slanted by one ulp: no value strictly between.
        0 => (sheet(at, at), sheet(after, after.next_up())),
        1 => (sheet(at, after), sheet(after, after.next_up())),
        // Steeply slanted.
        2 => (
            sheet(at, after),
            sheet(3.0 * at, 3.0 * at + 4.0 * (after - at)),
        ),
        _ => (sheet(at, after), sheet(at, after)),
    };
    finite(
        random.between(-2.0, 0.0),
        near,
        random.between(1.0, 3.0),
        far,
    )
}
