//! The constructors' promises: a right frustum, or an error of its own for each invalid input.

use frusta::{
    Camera, Direction, EndRect, Frustum, FrustumError, Pose, Projection, Rect, Shape, Vec3,
};
use proptest::prelude::*;
use std::f64::consts::PI;

/// A camera at the origin that looks along `-z`, `y` up, 90 degrees, square.
fn plain_camera() -> Camera {
    Camera {
        eye: Vec3::new(0.0, 0.0, 0.0),
        target: Vec3::new(0.0, 0.0, -1.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        projection: Projection::Perspective {
            fovy: PI / 2.0,
            aspect: 1.0,
        },
        near: 1.0,
        far: 2.0,
    }
}

fn with(change: impl FnOnce(&mut Camera)) -> Result<Frustum, FrustumError> {
    let mut camera = plain_camera();
    change(&mut camera);
    camera.frustum()
}

/// Whether two numbers are equal up to `ulps` units in the last place.
fn close(a: f64, b: f64, ulps: f64) -> bool {
    (a - b).abs() <= ulps * f64::EPSILON * b.abs()
}

#[test]
fn camera_frame_is_right_up_forward() {
    let frustum = plain_camera().frustum().unwrap();
    let axes = frustum.pose().axes;
    assert_eq!(
        axes.map(Vec3::to_array),
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]
    );
    let far = frustum.shape().far().unwrap();
    assert_eq!((frustum.shape().near().z, far.z), (1.0, 2.0));
    assert!(close(far.rect.right, 2.0, 2.0) && far.rect.is_symmetric());
}

#[test]
fn camera_over_twelve_decades() {
    let frustum = with(|c| {
        c.near = 1e-6;
        c.far = 1e6;
        c.projection = Projection::Perspective {
            fovy: 1.0,
            aspect: 2.0,
        };
    })
    .unwrap();
    let (near, far) = (frustum.shape().near(), frustum.shape().far().unwrap());
    // tan(1/2), from tables.
    let slope = 0.546_302_489_843_790_5;
    assert_eq!((near.z, far.z), (1e-6, 1e6));
    assert!(close(near.rect.top, slope * 1e-6, 4.0));
    assert!(close(near.rect.right, 2.0 * slope * 1e-6, 4.0));
    assert!(close(far.rect.left, -2.0 * slope * 1e6, 4.0));
}

#[test]
fn camera_at_near_zero_is_a_pyramid() {
    for near in [0.0, -0.0] {
        let frustum = with(|c| c.near = near).unwrap();
        assert_eq!(
            frustum.shape().near(),
            EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0)
        );
        assert!(frustum.shape().near().z.is_sign_positive());
    }
}

#[test]
fn infinite_cameras() {
    let frustum = with(|c| c.far = f64::INFINITY).unwrap();
    let Shape::Infinite {
        slopes, direction, ..
    } = *frustum.shape()
    else {
        panic!("{frustum:?}")
    };
    assert_eq!(direction, Direction::PlusZ);
    assert!(close(slopes.top, 1.0, 2.0));

    let frustum = with(|c| {
        c.far = f64::INFINITY;
        c.projection = Projection::Orthographic {
            height: 2.0,
            aspect: 3.0,
        };
    })
    .unwrap();
    let Shape::Infinite { near, slopes, .. } = *frustum.shape() else {
        panic!("{frustum:?}")
    };
    assert_eq!(near, EndRect::new(1.0, -3.0, 3.0, -1.0, 1.0));
    assert_eq!(slopes, Rect::default());
}

#[test]
fn off_axis_keeps_its_rectangle() {
    let rect = Rect::new(-0.1, 0.3, 0.2, 0.7);
    let frustum = with(|c| {
        c.projection = Projection::OffAxis { rect };
        c.near = 0.5;
        c.far = 2.0;
    })
    .unwrap();
    assert_eq!(frustum.shape().near().rect, rect);
    let far = frustum.shape().far().unwrap().rect;
    assert_eq!(far, Rect::new(-0.4, 1.2, 0.8, 2.8));
}

#[test]
fn every_bad_camera_has_its_own_error() {
    use FrustumError as E;
    type Change = fn(&mut Camera);
    let perspective = |fovy, aspect| Projection::Perspective { fovy, aspect };
    let cases: [(Change, E); 11] = [
        (
            |c| c.target = c.eye,
            E::EyeIsTarget {
                eye: Vec3::default(),
            },
        ),
        (
            |c| c.up = Vec3::new(0.0, 0.0, 1e-300),
            E::UpAlongView {
                up: Vec3::new(0.0, 0.0, 1e-300),
            },
        ),
        (
            |c| c.up = Vec3::default(),
            E::UpAlongView {
                up: Vec3::default(),
            },
        ),
        (|c| c.near = -1.0, E::NearBehindEye { near: -1.0 }),
        (
            |c| c.near = 2.0,
            E::FarNotBeyondNear {
                near: 2.0,
                far: 2.0,
            },
        ),
        (
            |c| c.far = f64::NEG_INFINITY,
            E::FarNotBeyondNear {
                near: 1.0,
                far: f64::NEG_INFINITY,
            },
        ),
        (
            |c| c.eye.y = f64::INFINITY,
            E::NonFinite {
                what: "eye.y",
                value: f64::INFINITY,
            },
        ),
        (
            |c| {
                c.near = 0.0;
                c.projection = Projection::OffAxis {
                    rect: Rect::centred(1.0, 1.0),
                }
            },
            E::OffAxisAtEye,
        ),
        (
            |c| {
                c.projection = Projection::OffAxis {
                    rect: Rect::new(1.0, -1.0, -1.0, 1.0),
                }
            },
            E::Inverted {
                end: "rect",
                what: "left..right",
                low: 1.0,
                high: -1.0,
            },
        ),
        (
            |c| {
                c.projection = Projection::OrthographicRect {
                    rect: Rect::new(-1.0, 1.0, 3.0, 3.0),
                }
            },
            E::Flat {
                what: "bottom..top",
            },
        ),
        (
            |c| {
                c.projection = Projection::Orthographic {
                    height: -1.0,
                    aspect: 1.0,
                }
            },
            E::Height { height: -1.0 },
        ),
    ];
    for (change, expected) in cases {
        assert_eq!(with(change), Err(expected));
    }
    for fovy in [0.0, -1.0, PI, 4.0] {
        let got = with(|c| c.projection = perspective(fovy, 1.0));
        assert_eq!(got, Err(E::FieldOfView { fovy }));
    }
    for aspect in [0.0, -1.0, f64::INFINITY] {
        let got = with(|c| c.projection = perspective(1.0, aspect));
        assert_eq!(got, Err(E::Aspect { aspect }));
    }
    for bad in [
        with(|c| c.far = f64::NAN),
        with(|c| c.near = f64::NAN),
        with(|c| c.projection = perspective(f64::NAN, 1.0)),
    ] {
        assert!(bad.unwrap_err().to_string().contains("NaN"));
    }
}

#[test]
fn out_of_range_products_are_named() {
    let narrow = Projection::Perspective {
        fovy: 1e-200,
        aspect: 1.0,
    };
    let got = with(|c| {
        c.projection = narrow;
        c.near = 1e-200;
    });
    assert!(
        matches!(got, Err(FrustumError::Underflow { .. })),
        "{got:?}"
    );
    let got = with(|c| {
        c.projection = Projection::Perspective {
            fovy: 3.0,
            aspect: 1e300,
        };
        c.far = 1e300;
    });
    assert!(matches!(got, Err(FrustumError::Overflow { .. })), "{got:?}");
}

#[test]
fn camera_axes_are_accurate_for_a_nearly_parallel_up() {
    // The exact cross product is (0, 0, 1) * 2^-52; a rounded one is wrong or zero.
    let frustum = with(|c| {
        c.eye = Vec3::new(1e15, 0.0, 0.0);
        c.target = Vec3::new(1e15 + 1.0, 1.0, 0.0);
        c.up = Vec3::new(1.0, 1.0_f64.next_up(), 0.0);
    })
    .unwrap();
    assert_eq!(frustum.pose().axes[0], Vec3::new(0.0, 0.0, 1.0));
    // Differences beyond the range of f64.
    let frustum = with(|c| {
        c.eye = Vec3::new(0.0, 0.0, f64::MAX);
        c.target = Vec3::new(0.0, 0.0, -f64::MAX);
    })
    .unwrap();
    assert_eq!(frustum.pose().axes[2], Vec3::new(0.0, 0.0, -1.0));
}

#[test]
fn the_canonical_form_is_checked() {
    let shape = Shape::Finite {
        near: EndRect::new(0.0, -1.0, 1.0, -1.0, 1.0),
        far: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    };
    let mut pose = Pose::IDENTITY;
    pose.axes[2] = Vec3::new(1.0, 1.0, 0.0);
    assert_eq!(Frustum::new(pose, shape), Err(FrustumError::DependentAxes));
    pose.axes[1].z = f64::NAN;
    let error = Frustum::new(pose, shape).unwrap_err();
    assert_eq!(
        error.to_string(),
        "pose.axes[1].z is NaN; it must be finite"
    );
}

#[test]
fn a_frustum_equals_itself() {
    // Such slopes are out of the filter's range, and equality once compared their NaN.
    let shape = Shape::Infinite {
        near: EndRect::new(0.0, -1.0, 0.0, -1.0, 0.0),
        slopes: Rect::new(-8.9e305, 0.0, -1.0, 0.0),
        direction: Direction::PlusZ,
    };
    let mut pose = Pose::IDENTITY;
    pose.axes[0] = Vec3::new(7.6e259, 0.0, 0.0);
    let frustum = Frustum::new(pose, shape).unwrap();
    assert_eq!(frustum, frustum.clone());
    pose.axes[0].x = 7.5e259;
    assert_ne!(frustum, Frustum::new(pose, shape).unwrap());
}

/// Any finite or non-finite value.
fn wild() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits),
        -4.0..4.0,
        prop::sample::select(vec![
            0.0,
            -0.0,
            1.0,
            1e15,
            1e-160,
            1e300,
            5e-324,
            f64::MAX,
            f64::INFINITY
        ]),
    ]
}

fn wild_rect() -> impl Strategy<Value = Rect> {
    prop::array::uniform4(wild()).prop_map(|[l, r, b, t]| Rect::new(l, r, b, t))
}

fn wild_vec() -> impl Strategy<Value = Vec3<f64>> {
    prop::array::uniform3(wild()).prop_map(Vec3::from)
}

fn wild_projection() -> impl Strategy<Value = Projection> {
    prop_oneof![
        (wild(), wild()).prop_map(|(fovy, aspect)| Projection::Perspective { fovy, aspect }),
        (wild(), wild()).prop_map(|(height, aspect)| Projection::Orthographic { height, aspect }),
        wild_rect().prop_map(|rect| Projection::OffAxis { rect }),
        wild_rect().prop_map(|rect| Projection::OrthographicRect { rect }),
    ]
}

proptest! {
    #[test]
    fn a_plausible_camera_is_right(eye in prop::array::uniform3(-1e3..1e3), away in prop::array::uniform3(-1.0..1.0),
                                   up in prop::array::uniform3(-1.0..1.0), fovy in 0.001..3.1, aspect in 0.1..10.0,
                                   near_exponent in -9i32..3, decades in 1i32..12, scale in -150i32..150) {
        // All lengths times 10^scale.
        let unit = 10_f64.powi(scale);
        let near = 10_f64.powi(near_exponent) * unit;
        let far = near * 10_f64.powi(decades);
        let eye = Vec3::from(eye) * unit;
        let camera = Camera {
            eye,
            target: eye + Vec3::from(away) * (1e3 * unit),
            up: Vec3::from(up),
            projection: Projection::Perspective { fovy, aspect },
            near,
            far,
        };
        let frustum = camera.frustum().unwrap();
        let [right, top, forward] = frustum.pose().axes;
        // Right-handed if z points to the viewer; up is on the upper side.
        prop_assert!((right.cross(top) + forward).to_array().iter().all(|x| x.abs() < 1e-15));
        prop_assert!(top.dot(camera.up) > 0.0);
        prop_assert!((forward.dot((camera.target - eye) * (1.0 / unit)) / 1e3).powi(2)
            > 0.999_999 * (Vec3::from(away).dot(Vec3::from(away))));
        let (n, f) = (frustum.shape().near(), frustum.shape().far().unwrap());
        prop_assert_eq!((n.z, f.z), (near, far));
        for end in [n, f] {
            let slope = end.rect.top / end.z;
            prop_assert!(close(slope.atan() * 2.0, fovy, 16.0), "{} {}", slope.atan() * 2.0, fovy);
            prop_assert!(close(end.rect.right / end.rect.top, aspect, 8.0));
            prop_assert!(end.rect.is_symmetric());
        }
    }

    #[test]
    fn any_camera_is_right_or_an_error(eye in wild_vec(), target in wild_vec(), up in wild_vec(),
                                      projection in wild_projection(), near in wild(), far in wild()) {
        let camera = Camera { eye, target, up, projection, near, far };
        match camera.frustum() {
            Ok(frustum) => {
                prop_assert!(frustum.shape().validate().is_ok());
                prop_assert_eq!(frustum.pose().origin, eye);
                let [x, y, z] = frustum.pose().axes;
                for (a, b, product) in [(x, x, 1.0), (y, y, 1.0), (z, z, 1.0),
                                        (x, y, 0.0), (y, z, 0.0), (z, x, 0.0)] {
                    prop_assert!((a.dot(b) - product).abs() < 16.0 * f64::EPSILON);
                }
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}

/// The box around a center is the smallest one of its type: rounded outwards, once.
#[test]
fn a_box_around_a_center_is_the_smallest() {
    use frusta::Aabb;
    use num_rational::BigRational;
    let exact = |value: f64| BigRational::from_float(value).unwrap();
    let mut state = 88_172_645_463_325_252_u64;
    let mut next = |bits: u32| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        // Any magnitude in the middle of the range, and values of few bits.
        let exponent = (state % 120) as i32 - 60;
        let mantissa = (state >> 8) as f64 / (1_u64 << 56) as f64 + 1.0;
        let mantissa = (mantissa * f64::from(1_u32 << bits)).floor();
        mantissa * 2.0_f64.powi(exponent)
    };
    let mut rounded = 0;
    for i in 0..20_000 {
        let bits = [3, 12, 30][i % 3];
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        let (c, h) = (sign * next(bits), next(bits));
        let around = Aabb::from_center([c; 3], [h; 3]);
        let (low, high) = (exact(c) - exact(h), exact(c) + exact(h));
        let (min, max) = (around.min.x, around.max.x);
        assert!(exact(min) <= low && exact(max) >= high, "{c} {h}");
        assert!(
            exact(min.next_up()) > low && exact(max.next_down()) < high,
            "{c} {h}"
        );
        let (c, h) = (c as f32, h as f32);
        let around = Aabb::from_center([c; 3], [h; 3]);
        let (c, h) = (exact(c.into()), exact(h.into()));
        let (min, max) = (around.min.y, around.max.y);
        rounded += usize::from(exact(max.into()) != &c + &h);
        assert!(exact(min.into()) <= &c - &h && exact(max.into()) >= &c + &h);
        assert!(exact(min.next_up().into()) > &c - &h && exact(max.next_down().into()) < &c + &h);
    }
    assert!(rounded > 1_000, "{rounded}");
    // Beyond the largest value a side is infinite, so that nothing is lost.
    let infinity = f64::INFINITY;
    let too_large = Aabb::from_center([f64::MAX; 3], [f64::MAX; 3]);
    assert_eq!(too_large, Aabb::new([0.0; 3], [infinity; 3]));
    assert!(too_large.check().is_ok());
    let all = Aabb::from_center([1.0; 3], [infinity; 3]);
    assert_eq!(all, Aabb::UNBOUNDED);
    assert!(Aabb::from_center([f32::NAN; 3], [1.0; 3]).check().is_err());
    assert!(Aabb::from_center([infinity; 3], [1.0; 3]).check().is_err());
    assert!(Aabb::from_center([0.0; 3], [-1.0; 3]).check().is_err());
}
