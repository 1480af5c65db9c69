//! Inputs that the exact core once got wrong, each named after what was wrong.

use frusta::{
    Accuracy, Arithmetic, Class, Direction, EndRect, Face, FaceSet, Frustum, FrustumError,
    LiangBarsky, LiangBarskyVariant, Pose, Rect, Segment, SegmentClipper, Shape, Vec3,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// An infinite pyramid whose apex is the frame's origin.
fn apex(pose: Pose) -> Result<Frustum, FrustumError> {
    let shape = Shape::Infinite {
        near: EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0),
        slopes: Rect::new(-1.0, 1.0, -1.0, 1.0),
        direction: Direction::PlusZ,
    };
    Frustum::new(pose, shape)
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
    let frustum = apex(Pose::new(Vec3::new(unit, unit, unit), axes))?;
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

/// Hits on a near end at -0 had `z` = -0 in one of two equivalent ways only.
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
        for arithmetic in [Accuracy::Fast, Accuracy::Nearest].map(Arithmetic::Exact) {
            let other = LiangBarsky {
                arithmetic,
                variant: LiangBarskyVariant::Tuned,
            };
            let Arithmetic::Exact(accuracy) = arithmetic else {
                continue;
            };
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

/// A crossing at exactly zero, from coordinates so small that the bound of the
/// error rounds to zero in `f32`, came out as -0.
#[test]
fn nearest_zeros_of_tiny_single_segments_are_positive() -> Outcome {
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
