//! Inputs that once gave wrong answers, verbatim, each with its cause.

use frusta::clip::{LiangBarsky, LiangBarskyVariant, SegmentClipper};
use frusta::{
    Accuracy, Class, Direction, EndRect, Face, FaceSet, Frustum, Pose, Rect, Segment, Shape, Vec3,
};
use frusta_lab::check::assert_guarantees;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Found by the fuzz target `plain`. All numbers except the slopes are zero: the logarithm
/// of the size, in the search for a lattice, was minus infinity, and subtracting 25 from
/// it as an integer overflowed.
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

/// Found by the fuzz target `constructors`: with the near end at -0, a hit on it had the `z`
/// +0 in the vector path and -0 in the other algorithms.
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

/// Products of two exact values underflowed, so that all crossings were ties.
#[test]
fn no_ties_on_a_tiny_lattice() -> Outcome {
    let (unit, axis) = (2.0_f64.powi(-450), 2.0_f64.powi(-130));
    let axes = [
        Vec3::new(axis, 0.0, 0.0),
        Vec3::new(0.0, axis, 0.0),
        Vec3::new(0.0, 0.0, axis),
    ];
    let frustum = Frustum::new(
        Pose::new(Vec3::new(unit, unit, unit), axes),
        Shape::Infinite {
            near: EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0),
            slopes: Rect::new(-1.0, 1.0, -1.0, 1.0),
            direction: Direction::PlusZ,
        },
    )?;
    let segment = Segment::new(
        [-2.0 * unit, -unit, 2.0 * unit],
        [3.0 * unit, 4.0 * unit, 2.0 * unit],
    );
    for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
        let other = LiangBarsky::exact(LiangBarskyVariant::Tuned, accuracy);
        for clip in [
            frustum.clip_segment_with(&segment, accuracy)?,
            other.clip_segment(&frustum, &segment)?,
        ] {
            assert_eq!(clip.class, Class::Cross);
            let part = clip.part.ok_or("no part")?;
            let sets = [part.entry.faces, part.exit.faces];
            assert_eq!(sets, [Face::Left, Face::Top].map(FaceSet::from));
        }
    }
    Ok(())
}

/// Hits on a near end at -0 had `z` = -0 in only one of two equivalent computations.
#[test]
fn zeros_on_a_near_end_at_minus_zero_are_positive() -> Outcome {
    let shape = Shape::Finite {
        near: EndRect::new(-0.0, -1.0, 1.0, -1.0, 1.0),
        far: EndRect::new(4.0, -2.0, 2.0, -2.0, 2.0),
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape)?;
    for segment in [
        Segment::<f64>::new([-3.0, 0.0, 0.0], [3.0, 0.5, 0.0]),
        Segment::new([-3.1, 0.0, 0.0], [3.0, 0.5, 0.0]),
        Segment::new([0.5, 0.0, -1.0], [0.25, 0.5, 5.0]),
        Segment::new([0.5, 0.0, -1.1], [0.25, 0.5, 5.0]),
    ] {
        for accuracy in [Accuracy::Fast, Accuracy::Nearest] {
            let other = LiangBarsky::exact(LiangBarskyVariant::Tuned, accuracy);
            for clip in [
                frustum.clip_segment_with(&segment, accuracy)?,
                other.clip_segment(&frustum, &segment)?,
            ] {
                let z = clip.part.ok_or("no part")?.entry.point.z;
                assert_eq!(z.to_bits(), 0, "{segment:?} {accuracy:?}");
            }
        }
    }
    Ok(())
}

/// A crossing at exactly zero had a coordinate of -0, if the coordinates were so small that
/// the error bound rounds to zero in `f32`.
#[test]
fn nearest_zeros_of_tiny_f32_segments_are_positive() -> Outcome {
    let shape = Shape::Finite {
        near: EndRect::new(1.0, -4.0, 4.0, -4.0, 4.0),
        far: EndRect::new(3.0, -4.0, 4.0, -4.0, 4.0),
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape)?;
    let tiny = 2.0_f32.powi(-70);
    let segment = Segment::new([-tiny, 0.0, 0.0], [tiny, 0.0, 2.0]);
    let clip = frustum.clip_segment_with(&segment, Accuracy::Nearest)?;
    let part = clip.part.ok_or("no part")?;
    assert_eq!(part.entry.point.x.to_bits(), 0);
    Ok(())
}

/// Found by `frusta verify`. A point interpolated to zero had the sign of the end from which it was
/// computed, so swapping the ends changed its bits. Zeros of clipped points are positive.
#[test]
fn zeros_of_clipped_points_do_not_depend_on_the_order_of_the_ends() {
    let infinite = Frustum::new(
        Pose::IDENTITY,
        Shape::Infinite {
            near: EndRect::new(8.0, -8.0, 8.0, -4.0, 4.0),
            slopes: Rect::new(-1.0, 1.0, -0.5, 0.5),
            direction: Direction::PlusZ,
        },
    )
    .unwrap();
    // bumps 22 and swapped 1, seed 1.
    assert_guarantees(
        &infinite,
        &Segment::new([-16.0, -0.0, -8.0], [0.0, -0.0, 24.0]),
    );
    assert_guarantees(
        &infinite,
        &Segment::new([-64.0, -0.0, -40.0], [32.0, -0.0, 24.0]),
    );
    // permuted 142: axes y, -z, -x.
    let axes = [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]].map(Vec3::from);
    let turned = Frustum::new(
        Pose::new(Vec3::new(0.0, 0.0, 0.0), axes),
        Shape::Finite {
            near: EndRect::new(8.0, -8.0, 8.0, -4.0, 4.0),
            far: EndRect::new(40.0, -40.0, 40.0, -20.0, 20.0),
        },
    )
    .unwrap();
    let segment = Segment::new([-56.0, -80.0, -0.0], [-24.0, 0.0, 0.0]);
    assert_guarantees(&turned, &segment);
    // crossing-close 44: crosses two faces in the origin, nearly.
    let thin = Frustum::new(
        Pose::IDENTITY,
        Shape::Finite {
            near: EndRect::new(0.0, -(2.0_f64.powi(60)), 0.0, -1.0, 1.0),
            far: EndRect::new(2.0_f64.powi(60), -(2.0_f64.powi(60)), 0.0, -1.0, 1.0),
        },
    )
    .unwrap();
    let hex = |text| frusta::math::hex::parse_f64(text).unwrap();
    let start = [
        hex("-0x1.e53e17937297p+3"),
        -0.0,
        hex("-0x1.81168906a7538p+15"),
    ];
    let end = [
        hex("0x1.4a0b4b2ef578p+5"),
        -0.0,
        hex("0x1.05ec3608baa0ep+17"),
    ];
    assert_guarantees(&thin, &Segment::new(start, end));
}
