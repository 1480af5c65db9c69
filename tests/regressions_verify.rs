//! Cases that `frusta verify` found wrong once, kept as they were found.

#![cfg(feature = "oracle")]

use frusta::oracle::{Oracle, check_idempotent, check_swapped};
use frusta::{
    Accuracy, Direction, EndRect, Frustum, Pose, Rect, Segment, Shape, StageCounts, Vec3,
};

/// Nothing is wrong with any answer for a segment or its reverse.
fn assert_clean(frustum: &Frustum, segment: &Segment<f64>) {
    let oracle = Oracle::new(frustum);
    let truth = oracle.clip(segment).unwrap();
    for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
        let clip = |s: &Segment<f64>| {
            frustum.clip_segment_counted(s, accuracy, &mut StageCounts::default())
        };
        let answer = clip(segment).unwrap();
        let found = oracle.check(&truth, segment, accuracy, &answer);
        assert!(found.is_empty(), "{accuracy:?}: {found:?}");
        let reversed = clip(&segment.reversed()).unwrap();
        assert_eq!(check_swapped(&answer, &reversed), None, "{accuracy:?}");
        if accuracy == Accuracy::Inward {
            assert_eq!(check_idempotent(&answer, clip), None);
        }
    }
}

fn identity(shape: Shape) -> Frustum {
    Frustum::new(Pose::IDENTITY, shape).unwrap()
}

/// A point interpolated to zero had the sign of the end it was computed from, so
/// that swapping the ends changed its bits. Zeros of clipped points are positive.
#[test]
fn zeros_of_clipped_points_do_not_depend_on_the_order_of_the_ends() {
    let infinite = identity(Shape::Infinite {
        near: EndRect::new(8.0, -8.0, 8.0, -4.0, 4.0),
        slopes: Rect::new(-1.0, 1.0, -0.5, 0.5),
        direction: Direction::PlusZ,
    });
    // bumps 22 and swapped 1, seed 1.
    assert_clean(
        &infinite,
        &Segment::new([-16.0, -0.0, -8.0], [0.0, -0.0, 24.0]),
    );
    assert_clean(
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
    );
    let segment = Segment::new([-56.0, -80.0, -0.0], [-24.0, 0.0, 0.0]);
    assert_clean(&turned.unwrap(), &segment);
    // crossing-close 44: crosses two faces in the origin, nearly.
    let thin = identity(Shape::Finite {
        near: EndRect::new(0.0, -(2.0_f64.powi(60)), 0.0, -1.0, 1.0),
        far: EndRect::new(2.0_f64.powi(60), -(2.0_f64.powi(60)), 0.0, -1.0, 1.0),
    });
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
    assert_clean(&thin, &Segment::new(start, end));
}
