//! Frusta to matrices of every convention, against rational arithmetic, other libraries, and back.

use frusta::{
    Camera, ClipSpace, ClipY, Frustum, FrustumError, MatrixLayout, Pose, Projection, Projector,
    Rect, Shape, Vec3, ViewProjection,
};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

const U: f64 = f64::EPSILON / 2.0;
const ROWS: MatrixLayout = MatrixLayout::RowMajorColumnVectors;

type Q = BigRational;

fn q(x: f64) -> Q {
    Q::from_float(x).unwrap()
}

fn spaces() -> Vec<ClipSpace> {
    let up = [ClipSpace::OPENGL, ClipSpace::ZERO_TO_ONE];
    let all = up.into_iter().flat_map(|c| {
        [
            c,
            ClipSpace {
                y: ClipY::Down,
                ..c
            },
        ]
    });
    all.flat_map(|c| [c, c.reversed()]).collect()
}

fn cameras() -> Vec<Camera> {
    let projections = [
        Projection::Perspective {
            fovy: 1.0,
            aspect: 1.7,
        },
        Projection::Perspective {
            fovy: 0.02,
            aspect: 0.6,
        },
        Projection::OffAxis {
            rect: Rect::new(-0.1, 0.4, 0.05, 0.3),
        },
        Projection::Orthographic {
            height: 7.0,
            aspect: 1.3,
        },
        Projection::OrthographicRect {
            rect: Rect::new(-1.0, 3.0, 2.0, 5.0),
        },
    ];
    let places = [
        ([0.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
        ([3.0, -2.0, 7.5], [0.3, 0.1, -0.2]),
        ([1e6, 2e6, 300.0], [1e6 + 1.0, 2e6 + 3.0, 299.0]),
    ];
    let mut all = Vec::new();
    for projection in projections {
        for (eye, target) in places {
            for (near, far) in [(0.1, 100.0), (1.0, f64::INFINITY), (1e-6, 1e6)] {
                let is_parallel = matches!(
                    projection,
                    Projection::Orthographic { .. } | Projection::OrthographicRect { .. }
                );
                if is_parallel && far.is_infinite() {
                    continue;
                }
                all.push(Camera {
                    eye: eye.into(),
                    target: target.into(),
                    up: [0.1, 1.0, 0.2].into(),
                    projection,
                    near,
                    far,
                });
            }
        }
    }
    all
}

/// Exact clip coordinates of a point.
fn clip_coordinates(rows: &[[f64; 4]; 4], p: Vec3<f64>) -> [Q; 4] {
    let p = [p.x, p.y, p.z, 1.0];
    rows.map(|row| (0..4).fold(Q::zero(), |sum, j| sum + q(row[j]) * q(p[j])))
}

/// What rounding each entry once may change in a row's value at a point.
fn rounding(row: &[f64; 4], p: Vec3<f64>) -> f64 {
    let p = [p.x, p.y, p.z, 1.0];
    (0..4).map(|j| U * (row[j] * p[j]).abs()).sum()
}

/// The matrix says of a point what the frustum says: fractions and depth, within the rounding of the
/// entries and of the sides' bounds.
#[test]
fn matrices_project_as_the_frustum_does() {
    let mut seen = 0;
    let mut random = frusta::samples::Random::new(&[14, 5]);
    for camera in cameras() {
        let frustum = camera.frustum().unwrap();
        for clip in spaces() {
            let rows = camera.view_projection(clip).unwrap().to_array(ROWS);
            let y = match clip.y {
                ClipY::Up => (-1.0, 1.0),
                ClipY::Down => (1.0, -1.0),
            };
            let screen = Projector::new(&frustum)
                .onto(Rect::new(-1.0, 1.0, y.0, y.1))
                .unwrap()
                .depth(clip);
            for _ in 0..20 {
                let ray = screen
                    .ray(random.between(-1.0, 1.0), random.between(-1.0, 1.0))
                    .unwrap();
                let p = ray.at(random.unit());
                let image = screen.project(p).unwrap().unwrap();
                let exact = clip_coordinates(&rows, p);
                let w = exact[3].to_f64().unwrap();
                assert!(w > 0.0);
                let distance = p - camera.eye;
                let distance = distance.dot(distance).sqrt();
                for i in 0..3 {
                    let of_matrix = (&exact[i] / &exact[3]).to_f64().unwrap();
                    let off = (of_matrix - image[i]).abs();
                    let entries = (rounding(&rows[i], p) + rounding(&rows[3], p)) / w;
                    let row = rows[i].iter().take(3).map(|e| e.abs()).sum::<f64>();
                    let bound = entries + 60.0 * U * (1.0 + row * distance / w);
                    assert!(off <= bound, "{i}: {off:e} > {bound:e} {camera:?} {clip:?}");
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 10_000, "{seen}");
}

/// Back from the matrix: the same frustum, up to what rounding of the entries costs.
#[test]
fn matrices_give_their_frustum_back() {
    for camera in cameras() {
        let frustum = camera.frustum().unwrap();
        let is_near_the_origin = camera.eye.x.abs() < 10.0;
        for clip in spaces() {
            let matrix = frustum.view_projection(clip).unwrap();
            for layout in [
                ROWS,
                MatrixLayout::ColumnMajorColumnVectors,
                MatrixLayout::RowMajorRowVectors,
                MatrixLayout::ColumnMajorRowVectors,
            ] {
                let read = ViewProjection::new(matrix.to_array(layout), layout);
                assert_eq!(read, matrix);
            }
            let Ok(back) = matrix.frustum(clip) else {
                // Far is lost in an entry, as documented.
                assert!(camera.far / camera.near >= 1e12, "{camera:?} {clip:?}");
                continue;
            };
            if !is_near_the_origin || camera.far / camera.near >= 1e12 {
                continue;
            }
            assert!(
                back.deviation().sides < 1e-12,
                "{:?} {camera:?}",
                back.deviation()
            );
            assert_eq!(
                frustum.shape().far().is_some(),
                back.frustum.shape().far().is_some()
            );
            let [a, b] = [&frustum, &back.frustum].map(|f| f.corners().near);
            for (a, b) in a.into_iter().zip(b) {
                let d = a - b;
                let off = d.dot(d).sqrt();
                assert!(
                    off < 1e-11 * (1.0 + camera.near),
                    "{off:e} {camera:?} {clip:?}"
                );
            }
            // And the same matrix again, up to a factor.
            let again = back.frustum.view_projection(clip).unwrap().to_array(ROWS);
            let rows = matrix.to_array(ROWS);
            for (row, other) in rows.iter().zip(again) {
                let largest = row.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
                let scale = rows[3][0]
                    .abs()
                    .max(rows[3][1].abs())
                    .max(rows[3][2].abs())
                    .max(rows[3][3].abs());
                let other_scale = again[3].iter().fold(0.0, |m: f64, e| m.max(e.abs()));
                for (a, b) in row.iter().zip(other) {
                    let off = (a / scale - b / other_scale).abs();
                    assert!(
                        off < 1e-11 * (1.0 + largest / scale),
                        "{off:e} {camera:?} {clip:?}"
                    );
                }
            }
        }
    }
}

/// A simple camera's entries are the known ones, bit for bit.
#[test]
fn known_entries() {
    let camera = Camera {
        eye: [0.0; 3].into(),
        target: [0.0, 0.0, -1.0].into(),
        up: [0.0, 1.0, 0.0].into(),
        projection: Projection::OffAxis {
            rect: Rect::new(-1.0, 3.0, -1.0, 1.0),
        },
        near: 1.0,
        far: 9.0,
    };
    let rows = |clip| camera.view_projection(clip).unwrap().to_array(ROWS);
    assert_eq!(
        rows(ClipSpace::ZERO_TO_ONE),
        [
            [0.5, 0.0, 0.5, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, -1.125, -1.125],
            [0.0, 0.0, -1.0, 0.0],
        ]
    );
    assert_eq!(rows(ClipSpace::OPENGL)[2], [0.0, 0.0, -1.25, -2.25]);
    assert_eq!(rows(ClipSpace::VULKAN)[1], [0.0, -1.0, 0.0, 0.0]);
    assert_eq!(
        rows(ClipSpace::ZERO_TO_ONE.reversed())[2],
        [0.0, 0.0, 0.125, 1.125]
    );
    let infinite = Camera {
        far: f64::INFINITY,
        ..camera
    };
    let rows = |clip| infinite.view_projection(clip).unwrap().to_array(ROWS);
    assert_eq!(rows(ClipSpace::ZERO_TO_ONE)[2], [0.0, 0.0, -1.0, -1.0]);
    assert_eq!(
        rows(ClipSpace::ZERO_TO_ONE.reversed())[2],
        [0.0, 0.0, 0.0, 1.0]
    );
    assert_eq!(rows(ClipSpace::OPENGL)[2], [0.0, 0.0, -1.0, -2.0]);
}

/// One convention to another and back; and the same as from the frustum.
#[test]
fn conversions_between_conventions() {
    let mut seen = 0;
    for camera in cameras() {
        for from in spaces() {
            let matrix = camera.view_projection(from).unwrap();
            for to in spaces() {
                let converted = matrix.converted(from, to).to_array(ROWS);
                let direct = camera.view_projection(to).unwrap().to_array(ROWS);
                for i in [0, 1, 3] {
                    assert_eq!(converted[i], direct[i]);
                }
                for j in 0..4 {
                    let size = direct[2][j].abs() + direct[3][j].abs();
                    let off = (converted[2][j] - direct[2][j]).abs();
                    assert!(off <= 8.0 * U * size, "{off:e} of {size:e} {from:?} {to:?}");
                }
                seen += 1;
            }
        }
    }
    assert!(seen > 1_000);
}

#[test]
fn single_precision_and_back() {
    let matrix = cameras()[1]
        .view_projection(ClipSpace::ZERO_TO_ONE)
        .unwrap();
    let single = matrix.to_f32();
    assert_eq!(single.to_f64().to_f32(), single);
    let rows = (matrix.to_array(ROWS), single.to_array(ROWS));
    for (a, b) in rows.0.iter().flatten().zip(rows.1.iter().flatten()) {
        assert_eq!(*a as f32, *b);
    }
}

/// Windows, tiles and eyes of a stereo pair have matrices, too: their sides were rounded one by one.
#[test]
fn derived_frusta() {
    let camera = cameras()[1];
    let camera = Camera {
        near: 0.1,
        far: 50.0,
        ..camera
    };
    let frustum = camera.frustum().unwrap();
    let windows = [
        frustum
            .window(Rect::new(0.71, 0.7101, 0.2, 0.2003))
            .unwrap(),
        frustum.tile(6, 1, 7, 3).unwrap(),
        frustum.stereo_eye(0.03, 2.0).unwrap(),
        frustum.stereo_eye(-0.03, f64::INFINITY).unwrap(),
    ];
    for window in windows {
        let matrix = window.view_projection(ClipSpace::ZERO_TO_ONE).unwrap();
        let back = matrix.frustum(ClipSpace::ZERO_TO_ONE).unwrap();
        let corners = |f: &Frustum| f.corners().near;
        for (a, b) in corners(&window).into_iter().zip(corners(&back.frustum)) {
            let d = a - b;
            assert!(d.dot(d).sqrt() < 1e-14 * 100.0, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_shape_with_its_eye_elsewhere() {
    // The eye is at frame z = -2; a sheared prism has none.
    let central = Shape::Finite {
        near: frusta::EndRect::new(0.0, -1.0, 1.0, -2.0, 2.0),
        far: frusta::EndRect::new(2.0, -1.0, 3.0, -4.0, 4.0),
    };
    let frustum = Frustum::new(Pose::IDENTITY, central).unwrap();
    let rows = frustum
        .view_projection(ClipSpace::ZERO_TO_ONE)
        .unwrap()
        .to_array(ROWS);
    assert_eq!(rows[3], [0.0, 0.0, 1.0, 2.0]);
    for (p, x, y, z) in [
        ([-1.0, -2.0, 0.0], -1.0, -1.0, 0.0),
        ([1.0, 2.0, 0.0], 1.0, 1.0, 0.0),
        ([-1.0, -4.0, 2.0], -1.0, -1.0, 1.0),
        ([3.0, 4.0, 2.0], 1.0, 1.0, 1.0),
    ] {
        let [a, b, c, w] = clip_coordinates(&rows, p.into());
        assert_eq!([a, b, c], [x, y, z].map(|v| q(v) * &w));
    }
    let sheared = Shape::Finite {
        near: frusta::EndRect::new(0.0, -1.0, 1.0, -1.0, 1.0),
        far: frusta::EndRect::new(2.0, 3.0, 5.0, -1.0, 1.0),
    };
    let frustum = Frustum::new(Pose::IDENTITY, sheared).unwrap();
    let rows = frustum
        .view_projection(ClipSpace::OPENGL)
        .unwrap()
        .to_array(ROWS);
    let [x, y, z, w] = clip_coordinates(&rows, [5.0, 1.0, 2.0].into());
    assert_eq!([x, y, z, w], [1.0, 1.0, 1.0, 1.0].map(q));
}

#[test]
fn frusta_without_a_matrix() {
    let clip = ClipSpace::ZERO_TO_ONE;
    let rect = |z, x: f64, y: f64| frusta::EndRect::new(z, -x, x, -y, y);
    let error = |shape| {
        Frustum::new(Pose::IDENTITY, shape)
            .unwrap()
            .view_projection(clip)
            .unwrap_err()
    };
    // A wedge; sides that converge behind far; a pyramid; parallel without far.
    let wedge = Shape::Finite {
        near: rect(1.0, 1.0, 1.0),
        far: rect(2.0, 2.0, 1.0),
    };
    assert_eq!(error(wedge), FrustumError::NoEye);
    let narrowing = Shape::Finite {
        near: rect(1.0, 2.0, 2.0),
        far: rect(2.0, 1.0, 1.0),
    };
    assert_eq!(error(narrowing), FrustumError::NoEye);
    let pyramid = Camera {
        near: 0.0,
        projection: Projection::Perspective {
            fovy: 1.0,
            aspect: 1.0,
        },
        ..cameras()[0]
    };
    assert_eq!(
        pyramid.view_projection(clip).unwrap_err(),
        FrustumError::NearAtEye
    );
    let endless = Camera {
        far: f64::INFINITY,
        projection: Projection::Orthographic {
            height: 1.0,
            aspect: 1.0,
        },
        ..cameras()[0]
    };
    assert_eq!(
        endless.view_projection(clip).unwrap_err(),
        FrustumError::NoFarPlane
    );
    for error in [
        FrustumError::NoEye,
        FrustumError::NearAtEye,
        FrustumError::NoFarPlane,
    ] {
        assert!(error.to_string().len() > 20);
    }
    // The entries do not fit: a view 1e-300 wide from 1e300 away.
    let far_away = Camera {
        eye: [1e300, 0.0, 0.0].into(),
        target: [0.0; 3].into(),
        projection: Projection::OrthographicRect {
            rect: Rect::centred(1e-300, 1.0),
        },
        up: [0.0, 0.0, 1.0].into(),
        near: 1.0,
        far: 2.0,
    };
    let moved = Camera {
        eye: [0.0, 1e300, 0.0].into(),
        target: [1.0, 1e300, 0.0].into(),
        ..far_away
    };
    assert!(
        matches!(
            moved.view_projection(clip),
            Err(FrustumError::Overflow { .. })
        ),
        "{:?}",
        moved.view_projection(clip)
    );
    assert!(Q::zero().abs().is_zero());
}

/// glam's matrices, of its own functions.
#[cfg(feature = "glam033")]
#[allow(deprecated, reason = "glam renames them")]
#[test]
fn as_glam_makes_them() {
    use glam033::{DMat4, DVec3};
    let (eye, target, up) = ([3.0, -2.0, 7.5], [0.3, 0.1, -0.2], [0.1, 1.0, 0.05]);
    let camera = Camera {
        eye: eye.into(),
        target: target.into(),
        up: up.into(),
        projection: Projection::Perspective {
            fovy: 0.9,
            aspect: 1.6,
        },
        near: 0.25,
        far: 40.0,
    };
    let view = DMat4::look_at_rh(DVec3::from(eye), DVec3::from(target), DVec3::from(up));
    let endless = Camera {
        far: f64::INFINITY,
        ..camera
    };
    for (camera, clip, projection) in [
        (
            camera,
            ClipSpace::ZERO_TO_ONE,
            DMat4::perspective_rh(0.9, 1.6, 0.25, 40.0),
        ),
        (
            camera,
            ClipSpace::OPENGL,
            DMat4::perspective_rh_gl(0.9, 1.6, 0.25, 40.0),
        ),
        (
            endless,
            ClipSpace::ZERO_TO_ONE,
            DMat4::perspective_infinite_rh(0.9, 1.6, 0.25),
        ),
        (
            endless,
            ClipSpace::ZERO_TO_ONE.reversed(),
            DMat4::perspective_infinite_reverse_rh(0.9, 1.6, 0.25),
        ),
    ] {
        let theirs = projection * view;
        let ours: DMat4 = camera.view_projection(clip).unwrap().into();
        assert!(ours.abs_diff_eq(theirs, 1e-14), "{ours}\n{theirs}");
    }
}
