//! Frusta from matrices: every convention, and conventions that are easily confused.

use frusta::{
    ClipSpace, ClipY, Deviation, Direction, FarCorners, Frustum, FrustumError, MatrixFrustum,
    MatrixLayout, Real, Shape, Vec3, ViewProjection,
};
use proptest::prelude::*;

type Matrix = [[f64; 4]; 4];

const SPACES: [ClipSpace; 4] = [
    ClipSpace::ZERO_TO_ONE,
    ClipSpace::OPENGL,
    ClipSpace {
        reversed: true,
        ..ClipSpace::ZERO_TO_ONE
    },
    ClipSpace {
        reversed: true,
        ..ClipSpace::OPENGL
    },
];

/// The depths that near and far map to.
fn ends(clip: ClipSpace) -> (f64, f64) {
    let low = match clip.depth {
        frusta::DepthRange::ZeroToOne => 0.0,
        frusta::DepthRange::MinusOneToOne => -1.0,
    };
    if clip.reversed {
        (1.0, low)
    } else {
        (low, 1.0)
    }
}

/// Perspective along `-z` with slopes `w`, `h`, shifted by `shift`: `Z = a W +
/// b` with the two depths at `near` and `far`, which may be infinite.
fn perspective(clip: ClipSpace, w: f64, h: f64, shift: f64, near: f64, far: f64) -> Matrix {
    let (at_near, at_far) = ends(clip);
    // a near + b = at_near near, a far + b = at_far far.
    let (a, b) = if far.is_infinite() {
        (at_far, (at_near - at_far) * near)
    } else {
        (
            (at_far * far - at_near * near) / (far - near),
            (at_near - at_far) * near * far / (far - near),
        )
    };
    [
        [1.0 / w, 0.0, shift, 0.0],
        [0.0, 1.0 / h, 0.0, 0.0],
        [0.0, 0.0, -a, b],
        [0.0, 0.0, -1.0, 0.0],
    ]
}

/// Parallel along `-z`, half-extents `w`, `h`.
fn orthographic(clip: ClipSpace, w: f64, h: f64, near: f64, far: f64) -> Matrix {
    let (at_near, at_far) = ends(clip);
    let a = (at_far - at_near) / (far - near);
    [
        [1.0 / w, 0.0, 0.0, 0.0],
        [0.0, 1.0 / h, 0.0, 0.0],
        [0.0, 0.0, -a, at_near - a * near],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn product(a: Matrix, b: Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum::<f64>()))
}

/// World to view: a rotation by a quaternion, about an eye.
fn view(quaternion: [f64; 4], eye: [f64; 3]) -> Matrix {
    let length = quaternion.iter().map(|q| q * q).sum::<f64>().sqrt();
    let [a, b, c, d] = quaternion.map(|q| q / length);
    let turn = [
        [
            1.0 - 2.0 * (c * c + d * d),
            2.0 * (b * c - a * d),
            2.0 * (b * d + a * c),
        ],
        [
            2.0 * (b * c + a * d),
            1.0 - 2.0 * (b * b + d * d),
            2.0 * (c * d - a * b),
        ],
        [
            2.0 * (b * d - a * c),
            2.0 * (c * d + a * b),
            1.0 - 2.0 * (b * b + c * c),
        ],
    ];
    let row = |r: [f64; 3]| {
        [
            r[0],
            r[1],
            r[2],
            -(r[0] * eye[0] + r[1] * eye[1] + r[2] * eye[2]),
        ]
    };
    [
        row(turn[0]),
        row(turn[1]),
        row(turn[2]),
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn frustum(m: Matrix, clip: ClipSpace) -> Result<MatrixFrustum, FrustumError> {
    ViewProjection::new(m, MatrixLayout::RowMajorColumnVectors).frustum(clip)
}

/// The frustum of the matrix with each entry rounded to `f32`.
fn frustum32(m: Matrix, clip: ClipSpace) -> Result<MatrixFrustum, FrustumError> {
    let m = m.map(|row| row.map(f32::from_f64));
    ViewProjection::new(m, MatrixLayout::RowMajorColumnVectors).frustum(clip)
}

/// Distances of near and far for a perspective matrix.
fn depths(f: &Frustum) -> (f64, Option<f64>) {
    (f.shape().near().z, f.shape().far().map(|e| e.z))
}

fn near_to(a: f64, b: f64, relative: f64) -> bool {
    (a - b).abs() <= relative * b.abs()
}

#[test]
fn every_depth_convention() {
    for clip in SPACES {
        let m = perspective(clip, 0.5, 0.25, 0.125, 0.5, 32.0);
        let found = frustum(m, clip).unwrap();
        let (near, far) = depths(&found.frustum);
        assert!(
            near_to(near, 0.5, 1e-14) && near_to(far.unwrap(), 32.0, 1e-12),
            "{clip:?}"
        );
        let d = found.deviation();
        assert!(d.sides == 0.0 && d.near < 1e-15 && d.far < 1e-15, "{d:?}");
        // X = x / w + shift z is +-W where x = (+-1 + shift) w W.
        let corners = found.frustum.corners().near;
        let expected = [
            [-0.21875, -0.125],
            [0.28125, -0.125],
            [0.28125, 0.125],
            [-0.21875, 0.125],
        ];
        for (p, e) in corners.into_iter().zip(expected) {
            assert!(
                (p.x - e[0]).abs() < 1e-14 && (p.y - e[1]).abs() < 1e-14,
                "{p} {e:?}"
            );
            assert!((p.z + 0.5).abs() < 1e-14);
        }
    }
}

#[test]
fn infinite_in_every_convention() {
    for clip in SPACES {
        for near in [1e-6, 0.1, 1e4] {
            let m = perspective(clip, 0.5, 0.25, 0.0, near, f64::INFINITY);
            for found in [frustum(m, clip).unwrap(), frustum32(m, clip).unwrap()] {
                let (got, far) = depths(&found.frustum);
                assert!(near_to(got, near, 1e-7) && far.is_none(), "{clip:?} {got}");
                assert_eq!(found.deviation().far, 0.0);
            }
        }
    }
}

#[test]
fn f32_over_twelve_decades() {
    for clip in SPACES {
        let m = perspective(clip, 1.0, 1.0, 0.0, 1e-6, 1e6);
        let (near, far) = depths(&frustum32(m, clip).unwrap().frustum);
        assert!(near_to(near, 1e-6, 2e-7), "{clip:?}: {near}");
        if clip == ClipSpace::ZERO_TO_ONE.reversed() {
            // Only here does the far distance have an entry of its own.
            assert!(near_to(far.unwrap(), 1e6, 2e-7));
        } else {
            // 1 + 1e-12 is 1 in f32: the matrix has no far plane.
            assert_eq!(far, None, "{clip:?}");
        }
    }
    for clip in SPACES {
        let m = perspective(clip, 1.0, 1.0, 0.0, 1e-6, 1e6);
        let (near, far) = depths(&frustum(m, clip).unwrap().frustum);
        // The far distance affects the last 4 of 16 digits, except reversed from 0 to 1.
        assert!(
            near_to(near, 1e-6, 1e-15) && near_to(far.unwrap(), 1e6, 1e-3),
            "{clip:?}"
        );
    }
}

#[test]
fn orthographic_near_and_far_are_at_their_distances() {
    for clip in SPACES {
        let m = orthographic(clip, 10.0, 5.0, 1.0, 200.0);
        for (found, bound) in [(frustum(m, clip), 1e-13), (frustum32(m, clip), 1e-4)] {
            let found = found.unwrap();
            let corners = found.frustum.corners();
            let FarCorners::Points(far) = corners.far else {
                panic!("{clip:?}")
            };
            for (p, z) in corners
                .near
                .into_iter()
                .zip([-1.0; 4])
                .chain(far.into_iter().zip([-200.0; 4]))
            {
                assert!((p.z - z).abs() < bound, "{clip:?} {p}");
                assert!(near_to(p.x.abs(), 10.0, 1e-6) && near_to(p.y.abs(), 5.0, 1e-6));
            }
            let d = found.deviation();
            assert!(d.sides < 1e-15 && d.near < 1e-15 && d.far < 1e-15, "{d:?}");
        }
    }
}

#[test]
fn a_wrong_convention_is_detected_if_possible() {
    use FrustumError as E;
    let finite = |clip| perspective(clip, 1.0, 1.0, 0.0, 1.0, 100.0);
    let reversed = ClipSpace::ZERO_TO_ONE.reversed();
    let got = frustum(finite(reversed), ClipSpace::ZERO_TO_ONE);
    assert!(matches!(got, Err(E::NoNearPlane { .. })), "{got:?}");
    let got = frustum(finite(ClipSpace::ZERO_TO_ONE), reversed);
    assert!(matches!(got, Err(E::NoNearPlane { .. })), "{got:?}");
    // A -1..1 matrix read as 0..1 has its near plane at about twice the distance, a 0..1
    // matrix read as -1..1 at half of it: a valid frustum, but not the intended one. That
    // is why the convention has no default.
    let (near, _) = depths(
        &frustum(finite(ClipSpace::OPENGL), ClipSpace::ZERO_TO_ONE)
            .unwrap()
            .frustum,
    );
    assert!(near > 1.9);
    let (near, _) = depths(
        &frustum(finite(ClipSpace::ZERO_TO_ONE), ClipSpace::OPENGL)
            .unwrap()
            .frustum,
    );
    assert!(near < 0.51);
}

#[test]
fn each_invalid_matrix_has_its_own_error() {
    use FrustumError as E;
    let clip = ClipSpace::ZERO_TO_ONE;
    let good = perspective(clip, 1.0, 1.0, 0.0, 1.0, 100.0);
    let error = |change: &dyn Fn(&mut Matrix)| {
        let mut m = good;
        change(&mut m);
        frustum(m, clip).unwrap_err()
    };
    assert_eq!(error(&|m| *m = [[0.0; 4]; 4]), E::NegativeW { w: 0.0 });
    assert_eq!(
        error(&|m| m[3] = [0.0, 0.0, 0.0, -2.0]),
        E::NegativeW { w: -2.0 }
    );
    assert_eq!(error(&|m| m[1] = m[0]), E::SingularMatrix);
    assert_eq!(error(&|m| m[2] = [0.0, 0.0, -0.5, 0.0]), E::SingularMatrix);
    assert!(
        error(&|m| m[1][2] = f64::NAN)
            .to_string()
            .starts_with("row 1, column 2 is NaN")
    );
    let negated = error(&|m| *m = m.map(|row| row.map(|e| -e)));
    assert!(matches!(negated, E::NoNearPlane { .. }), "{negated:?}");
    // An oblique clip plane, as for a mirror, in place of the near plane.
    let oblique = error(&|m| m[2] = [0.3, 0.1, -1.0, -1.0]);
    assert!(matches!(oblique, E::TiltedDepth { .. }), "{oblique:?}");
    // The far plane is behind the eye.
    let behind = error(&|m| m[2] = [0.0, 0.0, -0.5, -1.0]);
    assert!(matches!(behind, E::FarBehindEye { .. }), "{behind:?}");
}

/// Rows given for columns, by cameras and parallel views in any place: called so, in every
/// convention.
#[test]
fn a_transposed_matrix_is_called_so() {
    let mut state = 88_172_645_463_325_252_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    for i in 0..400 {
        let clip = SPACES[i % 4];
        let eye = [9.0 * next(), 9.0 * next(), 9.0 * next()];
        let view = view([next(), next(), next(), 0.1 + next().abs()], eye);
        let m = if i % 3 == 0 {
            product(orthographic(clip, 4.0, 3.0, 1.0, 50.0), view)
        } else {
            product(perspective(clip, 0.8, 0.5, 0.0, 0.1, 100.0), view)
        };
        assert!(frustum(m, clip).is_ok());
        let exchanged = std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]));
        let error = frustum(exchanged, clip).unwrap_err();
        assert!(matches!(error, FrustumError::Transposed { .. }), "{error}");
        assert!(error.to_string().starts_with("the matrix looks transposed"));
    }
}

#[test]
fn a_tilted_far_plane_is_reported() {
    // A tilt that f32 rounding could cause: 1e-6 of W, while the far plane depends on
    // 1 - 1.001 of it.
    let clip = ClipSpace::ZERO_TO_ONE;
    let mut m = perspective(clip, 1.0, 1.0, 0.0, 1.0, 1001.0);
    m[2][0] = 1e-6;
    let found = frustum32(m, clip).unwrap();
    let Deviation { sides, near, far } = found.deviation();
    assert!(sides == 0.0 && near_to(near, 1e-6, 1e-2) && near_to(far, 1e-3, 1e-2));
    // In f64 rounding does not explain it.
    let got = frustum(m, clip);
    assert!(matches!(got, Err(FrustumError::TiltedDepth { .. })));
    // If the far plane is at infinity, the tilt moves it to W = 1e6.
    let mut m = perspective(clip, 1.0, 1.0, 0.0, 1.0, f64::INFINITY);
    m[2][0] = 1e-6;
    let found = frustum32(m, clip).unwrap();
    assert!(found.frustum.shape().far().is_none());
    assert!(
        near_to(found.deviation().far, 1e-6, 1e-2),
        "{:?}",
        found.deviation()
    );
}

#[test]
fn the_eye_is_rounded_and_nothing_else() {
    // An eye with coordinates that are not representable: the deviation is half an ulp of
    // it, relative to the near distance.
    let clip = ClipSpace::ZERO_TO_ONE;
    let turn = view([1.0, 2.0, 3.0, 4.0], [1e6 / 3.0, 2e6 / 3.0, -1e6 / 7.0]);
    let m = product(perspective(clip, 1.0, 1.0, 0.0, 1e-3, f64::INFINITY), turn);
    let found = frustum(m, clip).unwrap();
    assert_eq!(found.frustum.pose().axes[0].to_array(), m[0][..3]);
    let sides = found.deviation().sides;
    assert!(sides > 1e-9 && sides < 3.0 * 1.2e-10 / 1e-3, "{sides}");
}

#[test]
fn layouts() {
    let clip = ClipSpace::OPENGL;
    let m = product(
        perspective(clip, 0.5, 0.25, 0.125, 0.5, 32.0),
        view([1.0, -2.0, 0.5, 3.0], [4.0, 5.0, 6.0]),
    );
    let transposed: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]));
    let expected = frustum(m, clip).unwrap();
    for (entries, layout) in [
        (m, MatrixLayout::RowMajorColumnVectors),
        (transposed, MatrixLayout::ColumnMajorColumnVectors),
        (transposed, MatrixLayout::RowMajorRowVectors),
        (m, MatrixLayout::ColumnMajorRowVectors),
    ] {
        let matrix = ViewProjection::new(entries, layout);
        assert_eq!(matrix.to_array(layout), entries);
        assert_eq!(matrix.frustum(clip).unwrap(), expected);
    }
}

#[test]
fn vulkan_swaps_top_and_bottom() {
    let mut m = perspective(ClipSpace::ZERO_TO_ONE, 1.0, 1.0, 0.0, 1.0, 2.0);
    let up = frustum(m, ClipSpace::ZERO_TO_ONE).unwrap();
    m[1] = m[1].map(|e| 0.0 - e);
    assert_eq!(ClipSpace::VULKAN.y, ClipY::Down);
    assert_eq!(frustum(m, ClipSpace::VULKAN).unwrap(), up);
}

/// Clip coordinates of a world point, in plain arithmetic.
fn clip_coordinates(m: &Matrix, p: Vec3<f64>) -> [f64; 4] {
    m.map(|r| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3])
}

fn check_corners(
    m: &Matrix,
    clip: ClipSpace,
    found: &MatrixFrustum,
    noise: f64,
) -> Result<(), TestCaseError> {
    let (at_near, at_far) = ends(clip);
    let corners = found.frustum.corners();
    let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let d = found.deviation();
    for (p, s) in corners.near.into_iter().zip(signs) {
        let [x, y, z, w] = clip_coordinates(m, p);
        prop_assert!((x / w - s[0]).abs() <= d.sides + noise, "{} {:?}", p, d);
        prop_assert!((y / w - s[1]).abs() <= d.sides + noise, "{} {:?}", p, d);
        // Depth moves by at most its range for a relative move of near.
        prop_assert!(
            (z / w - at_near).abs() <= 4.0 * d.near + noise,
            "{} {:?}",
            p,
            d
        );
    }
    if let FarCorners::Points(far) = corners.far {
        for (p, s) in far.into_iter().zip(signs) {
            let [x, y, z, w] = clip_coordinates(m, p);
            prop_assert!((x / w - s[0]).abs() <= d.sides + noise, "{} {:?}", p, d);
            prop_assert!((y / w - s[1]).abs() <= d.sides + noise, "{} {:?}", p, d);
            prop_assert!(
                (z / w - at_far).abs() <= 4.0 * d.far + noise,
                "{} {:?}",
                p,
                d
            );
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn corners_project_to_the_clip_volume(
        space in 0usize..4, w in 0.01..10.0, h in 0.01..10.0, shift in -2.0..2.0,
        near_exponent in -4i32..2, ratio_exponent in 1i32..5,
        quaternion in prop::array::uniform4(-1.0..1.0), eye in prop::array::uniform3(-100.0..100.0),
    ) {
        prop_assume!(quaternion.iter().any(|q: &f64| q.abs() > 0.1));
        let clip = SPACES[space];
        let near = 10_f64.powi(near_exponent);
        let far = near * 10_f64.powi(ratio_exponent);
        let m = product(perspective(clip, w, h, shift, near, far), view(quaternion, eye));
        let found = frustum(m, clip).unwrap();
        // The rounding error of the projected point grows with the eye's distance, up to
        // 100 / near.
        let noise = 1e-12 * (1.0 + 100.0 / near) * (1.0 + 1.0 / w + 1.0 / h);
        check_corners(&m, clip, &found, noise)?;
        prop_assert!(found.deviation().sides < noise && found.deviation().near < noise);
        let (got, _) = depths(&found.frustum);
        prop_assert!(near_to(got, near, noise), "{} {}", got, near);

        // In f32, the frustum fits the rounded matrix as closely.
        let rounded = m.map(|row| row.map(|e| f64::from(e as f32)));
        if let Ok(found) = frustum32(m, clip) {
            check_corners(&rounded, clip, &found, noise)?;
        }
    }

    #[test]
    fn any_matrix_is_right_or_an_error(entries in prop::array::uniform16(prop_oneof![
            any::<u64>().prop_map(f64::from_bits), -2.0..2.0,
            prop::sample::select(vec![0.0, 0.0, 0.0, 1.0, -1.0, 1e300, 1e-160, 5e-324, f64::MAX])]),
        shaped in any::<bool>(), space in 0usize..4) {
        let mut m: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| entries[4 * i + j]));
        if shaped {
            // Depth along W: random rows never have it.
            m[2] = [0.0, 0.0, m[2][2], m[2][3]];
            m[3] = [0.0, 0.0, m[3][2], m[3][3]];
        }
        for found in [frustum(m, SPACES[space]), frustum32(m, SPACES[space])] {
            match found {
                Ok(found) => {
                    prop_assert!(found.frustum.shape().validate().is_ok());
                    let d = found.deviation();
                    prop_assert!(d.sides >= 0.0 && d.near >= 0.0 && d.far >= 0.0, "{:?}", d);
                    if let Shape::Infinite { direction, .. } = *found.frustum.shape() {
                        prop_assert_eq!(direction, Direction::PlusZ);
                    }
                }
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}
