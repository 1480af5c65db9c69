//! Cameras and models at the ends of the number range: the answer is exact, or the constructor
//! gives an error.

use frusta::samples::Random;
use frusta::{
    Camera, Class, ClipSpace, EndRect, Frustum, FrustumError, MatrixLayout, Pose, Projection, Real,
    Rect, Segment, Shape, Vec3, ViewProjection,
};
use frusta_lab::check::assert_guarantees;

/// Checks segments between points on, near and away from the features of a frustum; returns
/// the number of each class.
fn classes<T: Real>(frustum: &Frustum, reach: f64) -> [u32; 5] {
    let shape = frustum.shape();
    let near = shape.near();
    let far = shape.far().unwrap_or_else(|| {
        let Shape::Infinite { slopes, .. } = *shape else {
            return near;
        };
        let grown = |a: f64, b: f64| a + b * reach;
        let (n, s) = (near.rect, slopes);
        EndRect::new(
            near.z + shape.direction().sign() * reach,
            grown(n.left, s.left),
            grown(n.right, s.right),
            grown(n.bottom, s.bottom),
            grown(n.top, s.top),
        )
    });
    let mut random = Random::new(&[1000]);
    let mut point = || {
        let mut weight = || random.pick(&[0.0, 0.0, 0.5, 0.75, 1.0, 1.0, 1.25]);
        let (u, v, w) = (weight(), weight(), weight());
        let mix = |a: f64, b: f64, t: f64| a * (1.0 - t) + b * t;
        let (n, f) = (near.rect, far.rect);
        let frame = Vec3::new(
            mix(mix(n.left, f.left, w), mix(n.right, f.right, w), u),
            mix(mix(n.bottom, f.bottom, w), mix(n.top, f.top, w), v),
            mix(near.z, far.z, w),
        );
        Vec3::<T>::from_f64(frustum.pose().to_world(frame))
    };
    let mut classes = [0; 5];
    for _ in 0..300 {
        let segment = Segment::new(point(), point());
        assert!(segment.check_finite().is_ok(), "{segment:?}");
        assert_guarantees(frustum, &segment);
        let clip = frustum.clip_segment(&segment).unwrap();
        classes[clip.class as usize] += 1;
    }
    classes
}

/// Asserts both classes that need an interior, and one that needs an exterior.
fn assert_varied(classes: [u32; 5]) {
    let [out, _, boundary, inside, cross] = classes;
    assert!(
        out > 10 && cross > 10 && boundary + inside > 3,
        "{classes:?}"
    );
}

fn camera(near: f64, far: f64) -> Camera {
    Camera {
        eye: Vec3::new(1.0, 2.0, 3.0),
        target: Vec3::new(0.0, 0.5, -4.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        projection: Projection::Perspective {
            fovy: 1.0,
            aspect: 1.5,
        },
        near,
        far,
    }
}

#[test]
fn near_1e_minus_6_far_1e6_in_f32_and_f64() {
    let frustum = camera(1e-6, 1e6).frustum().unwrap();
    assert_varied(classes::<f32>(&frustum, 0.0));
    assert_varied(classes::<f64>(&frustum, 0.0));
}

/// glam's `perspective_infinite_reverse_rh`, as columns.
#[test]
fn a_reversed_infinite_matrix_in_f32() {
    let near = 1e-6_f32;
    let columns = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.5, 0.0, 0.0],
        [0.0, 0.0, 0.0, -1.0],
        [0.0, 0.0, near, 0.0],
    ];
    let matrix = ViewProjection::new(columns, MatrixLayout::ColumnMajorColumnVectors);
    let made = matrix.frustum(ClipSpace::ZERO_TO_ONE.reversed()).unwrap();
    assert!(made.frustum.shape().far().is_none());
    assert_eq!(made.frustum.shape().near().z, f64::from(near));
    assert_varied(classes::<f32>(&made.frustum, 1e6));
    assert_varied(classes::<f64>(&made.frustum, 1e6));
}

#[test]
fn off_axis_and_orthographic_cameras() {
    for projection in [
        Projection::OffAxis {
            rect: Rect::new(-1e-7, 3e-7, 1e-7, 2e-7),
        },
        Projection::Orthographic {
            height: 1e-3,
            aspect: 1e6,
        },
        Projection::OrthographicRect {
            rect: Rect::new(-1e6, -1.0, 1e-6, 1.0),
        },
    ] {
        let camera = Camera {
            projection,
            ..camera(1e-6, 1e6)
        };
        let frustum = camera.frustum().unwrap();
        assert_varied(classes::<f64>(&frustum, 0.0));
    }
}

/// A box and a perspective frustum of size `size` at `at`.
fn solids(at: f64, size: f64) -> [Frustum; 2] {
    let end = |z: f64, w: f64| {
        EndRect::new(
            at + z * size,
            at - w * size,
            at + w * size,
            at - size,
            at + size,
        )
    };
    [(1.0, 1.0), (1.0, 3.0)].map(|(near, far)| {
        let shape = Shape::Finite {
            near: end(1.0, near),
            far: end(5.0, far),
        };
        Frustum::new(Pose::IDENTITY, shape).unwrap()
    })
}

#[test]
fn coordinates_of_1e15_with_features_of_a_few_ulp() {
    for frustum in solids(1e15, 1.0) {
        assert_varied(classes::<f64>(&frustum, 0.0));
    }
}

#[test]
fn coordinates_of_1e_minus_160_1e155_and_1e300() {
    for size in [1e-160, 1e155, 1e300] {
        for frustum in solids(0.0, size) {
            assert_varied(classes::<f64>(&frustum, 0.0));
        }
    }
}

#[test]
fn subnormal_coordinates() {
    for frustum in solids(0.0, 2e-322) {
        assert_varied(classes::<f64>(&frustum, 0.0));
    }
}

#[test]
fn a_segment_across_the_whole_range_of_f64() {
    let [frustum, _] = solids(0.0, 1.0);
    let segment = Segment::new([0.0, 0.0, -f64::MAX], [0.0, 0.0, f64::MAX]);
    assert_guarantees(&frustum, &segment);
    let clip = frustum.clip_segment(&segment).unwrap();
    assert_eq!(clip.class, Class::Cross);
    assert_eq!(
        clip.points(),
        Some([[0.0, 0.0, 1.0].into(), [0.0, 0.0, 5.0].into()])
    );
}

/// Numbers out of the range of `f64` are errors, not clamped.
#[test]
fn numbers_out_of_range_have_their_own_errors() {
    let error = |camera: Camera| camera.frustum().unwrap_err();
    assert!(matches!(
        error(camera(1.0, 1.0)),
        FrustumError::FarNotBeyondNear { .. }
    ));
    assert!(matches!(
        error(camera(1.0, f64::NAN)),
        FrustumError::NonFinite { .. }
    ));
    let wide = Projection::Perspective {
        fovy: 3.0,
        aspect: 1e300,
    };
    let huge = Camera {
        projection: wide,
        ..camera(1.0, 1e300)
    };
    assert!(
        matches!(error(huge), FrustumError::Overflow { .. }),
        "{:?}",
        error(huge)
    );
    let looking_nowhere = Camera {
        target: camera(1.0, 2.0).eye,
        ..camera(1.0, 2.0)
    };
    assert!(matches!(
        error(looking_nowhere),
        FrustumError::EyeIsTarget { .. }
    ));
    let flat = Shape::Finite {
        near: EndRect::new(1e15, 0.0, 1.0, 0.0, 1.0),
        // 1e-3 is not representable there.
        far: EndRect::new(1e15 + 1e-3, 0.0, 1.0, 0.0, 1.0),
    };
    let error = Frustum::new(Pose::IDENTITY, flat).unwrap_err();
    assert!(matches!(error, FrustumError::NoDepth { .. }), "{error}");
}
