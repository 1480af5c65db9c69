//! Inputs that once went wrong, verbatim; each test opens with what it was.

#![cfg(feature = "oracle")]

mod check;

use check::assert_guarantees;
use frusta::{Direction, EndRect, Frustum, Pose, Rect, Segment, Shape};

/// Found by the fuzz target `plain`. All of its numbers but slopes are zero:
/// the logarithm of its size, in the search for a lattice, was minus infinity,
/// and taking 25 from the integer made of that overflowed.
#[test]
fn an_infinite_pyramid_from_the_origin_has_no_size() {
    let shape = Shape::Infinite {
        near: EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0),
        slopes: Rect::new(-1.0, 1.0, -0.5, 0.5),
        direction: Direction::PlusZ,
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
    for (start, end) in [
        ([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([-4.0, 0.0, 2.0], [4.0, 0.5, 2.0]),
    ] {
        assert_guarantees(&frustum, &Segment::new(start, end));
    }
}

/// Found by the fuzz target `constructors`: with the near end at minus zero,
/// the vector path gave a hit on it plus zero, the other algorithms minus zero.
#[test]
fn a_near_end_at_minus_zero_is_at_zero() {
    let shape = Shape::Infinite {
        near: EndRect::new(-0.0, -4.0, 0.0, -4.0, -2.0),
        slopes: Rect::new(-0.5, 1.0, -8.0, -8.0),
        direction: Direction::MinusZ,
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
    assert_guarantees(&frustum, &Segment::new([-2.0, -3.0, 0.0], [0.0, 0.0, 0.0]));
}
