//! Conversions to and from the types of other libraries, each with its feature.

#![allow(unused_imports, reason = "each feature uses its own part")]

use frusta::{
    Accuracy, Class, ClipSpace, Direction, EndRect, Face, FaceSet, Frustum, MatrixLayout, Pose,
    Rect, Segment, SegmentClip, Shape, StageCounts, Vec3, ViewProjection,
};

#[cfg(feature = "glam")]
mod glam {
    use super::*;
    use ::glam::camera::{lh::proj as lh, rh::proj as rh};
    use ::glam::{DMat4, DVec3, Mat4, Vec3 as V, Vec3A};

    #[test]
    fn vectors() {
        let v = V::new(1.0, 2.0, 3.0);
        assert_eq!(V::from(Vec3::from(v)), v);
        assert_eq!(Vec3A::from(Vec3::from(Vec3A::from(v))), Vec3A::from(v));
        let d = DVec3::new(0.1, 0.2, 0.3);
        assert_eq!(DVec3::from(Vec3::from(d)), d);
        assert_eq!(Segment::new(d, d).start, Vec3::new(0.1, 0.2, 0.3));
    }

    /// Distances of the near and far vertices along `-z`, and the top's height.
    fn measure(matrix: impl Into<ViewProjection<f32>>, clip: ClipSpace) -> [f64; 3] {
        let found = matrix.into().frustum(clip).unwrap();
        let corners = found.frustum.corners();
        let far = match corners.far {
            frusta::FarCorners::Points(p) => -p[0].z,
            frusta::FarCorners::Directions(_) => f64::INFINITY,
        };
        [-corners.near[0].z, far, corners.near[2].y]
    }

    #[track_caller]
    fn check(got: [f64; 3], expected: [f64; 3]) {
        for (g, e) in got.into_iter().zip(expected) {
            assert!(
                g == e || (g - e).abs() < 1e-5 * e.abs(),
                "{got:?} {expected:?}"
            );
        }
    }

    #[test]
    fn its_own_projections() {
        use std::f32::consts::FRAC_PI_2 as RIGHT;
        let zero_one = ClipSpace::ZERO_TO_ONE;
        check(
            measure(rh::directx::perspective(RIGHT, 1.0, 0.5, 20.0), zero_one),
            [0.5, 20.0, 0.5],
        );
        check(
            measure(
                rh::opengl::perspective(RIGHT, 1.0, 0.5, 20.0),
                ClipSpace::OPENGL,
            ),
            [0.5, 20.0, 0.5],
        );
        check(
            measure(
                rh::directx::perspective_infinite(RIGHT, 1.0, 1e-6),
                zero_one,
            ),
            [1e-6, f64::INFINITY, 1e-6],
        );
        check(
            measure(
                rh::directx::perspective_infinite_reverse(RIGHT, 1.0, 1e-6),
                zero_one.reversed(),
            ),
            [1e-6, f64::INFINITY, 1e-6],
        );
        check(
            measure(
                rh::directx::orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 200.0),
                zero_one,
            ),
            [1.0, 200.0, 3.0],
        );
        // Reversed orthographic depth as in bevy: near and far swapped.
        check(
            measure(
                rh::directx::orthographic(-4.0, 4.0, -3.0, 3.0, 200.0, 1.0),
                zero_one.reversed(),
            ),
            [1.0, 200.0, 3.0],
        );
        // Its Vulkan matrices flip y; the top is still the top.
        check(
            measure(
                rh::vulkan::perspective_infinite_reverse(RIGHT, 1.0, 0.25),
                ClipSpace::VULKAN.reversed(),
            ),
            [0.25, f64::INFINITY, 0.25],
        );
        let left_handed = lh::directx::perspective(RIGHT, 1.0, 0.5, 20.0);
        check(measure(left_handed, zero_one), [-0.5, -20.0, 0.5]);
    }

    #[test]
    fn matrices_convert_back() {
        let m = DMat4::from_cols_array(&std::array::from_fn(|i| i as f64));
        let ours = ViewProjection::from(m);
        assert_eq!(
            ours.to_array(MatrixLayout::RowMajorColumnVectors)[0],
            [0.0, 4.0, 8.0, 12.0]
        );
        assert_eq!(DMat4::from(ours), m);
        let m = Mat4::from_cols_array(&std::array::from_fn(|i| i as f32));
        assert_eq!(Mat4::from(ViewProjection::from(m)), m);
    }
}

#[cfg(feature = "nalgebra")]
#[test]
fn nalgebra() {
    use ::nalgebra::{Matrix4, Point3, Vector3};
    let p = Point3::new(1.0_f32, 2.0, 3.0);
    assert_eq!(Point3::from(Vec3::from(p)), p);
    let v = Vector3::new(1.0_f64, 2.0, 3.0);
    assert_eq!(Vec3::from(v), Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(Vector3::from(Vec3::from(v)), v);
    let m = Matrix4::from_fn(|i, j| (4 * i + j) as f64);
    let ours = ViewProjection::from(m);
    assert_eq!(
        ours.to_array(MatrixLayout::RowMajorColumnVectors)[1],
        [4.0, 5.0, 6.0, 7.0]
    );
    assert_eq!(Matrix4::from(ours), m);
}

#[cfg(feature = "mint")]
#[test]
fn mint() {
    use ::mint::{ColumnMatrix4, Point3, RowMatrix4, Vector3};
    let p = Point3::from([1.0_f32, 2.0, 3.0]);
    assert_eq!(Vec3::from(p), Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(Point3::from(Vec3::from(p)), p);
    let v = Vector3::from([1.0_f64, 2.0, 3.0]);
    assert_eq!(Vector3::from(Vec3::from(v)), v);
    let rows: [[f64; 4]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| (4 * i + j) as f64));
    let ours = ViewProjection::from(RowMatrix4::from(rows));
    assert_eq!(ours.to_array(MatrixLayout::RowMajorColumnVectors), rows);
    assert_eq!(RowMatrix4::from(ours), RowMatrix4::from(rows));
    assert_eq!(ViewProjection::from(ColumnMatrix4::from(ours)), ours);
    assert_eq!(ColumnMatrix4::from(ours).x.y, 4.0);
}

#[cfg(feature = "bytemuck")]
#[test]
fn bytemuck() {
    use ::bytemuck::{Zeroable, cast_slice, cast_slice_mut, checked};
    use frusta::{Aabb, Obb, Sphere};

    // Six numbers a box, as an engine might store them, and back.
    let numbers = [
        0.0_f32, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0,
    ];
    let boxes: &[Aabb<f32>] = cast_slice(&numbers);
    assert_eq!(boxes[1], Aabb::new([6.0, 7.0, 8.0], [9.0, 10.0, 11.0]));
    assert_eq!(cast_slice::<_, f32>(boxes), numbers);
    let spheres: &[Sphere<f32>] = cast_slice(&numbers);
    assert_eq!(spheres[2], Sphere::new([8.0, 9.0, 10.0], 11.0));
    let segments: &[Segment<f32>] = cast_slice(&numbers);
    assert_eq!(segments[0], Segment::new([0.0, 1.0, 2.0], [3.0, 4.0, 5.0]));
    let oriented: &[Obb<f32>] = cast_slice(&numbers);
    assert_eq!(oriented[0].center, Vec3::new(0.0, 1.0, 2.0));
    assert_eq!(oriented[0].half_axes[2], Vec3::new(9.0, 10.0, 11.0));
    let mut points = [[0.5_f64, 1.5, 2.5]; 2];
    cast_slice_mut::<_, Vec3<f64>>(&mut points)[1].y = 7.0;
    assert_eq!(points[1], [0.5, 7.0, 2.5]);
    assert_eq!(Obb::<f64>::zeroed(), Obb::default());
    // Half a box is none.
    assert!(checked::try_cast_slice::<f32, Aabb<f32>>(&numbers[..9]).is_err());
}

#[cfg(feature = "approx")]
#[test]
fn approx() {
    use ::approx::{assert_relative_eq, assert_relative_ne, assert_ulps_eq};
    let (a, b) = (
        Vec3::new(1.0, 2.0, 3.0),
        Vec3::new(1.0, 2.0, 3.0_f64.next_up()),
    );
    assert_relative_eq!(a, b);
    assert_ulps_eq!(Segment::new(a, b), Segment::new(b, a));
    assert_relative_ne!(a, b, epsilon = 0.0, max_relative = 1e-17);
    assert_relative_ne!(a, Vec3::new(1.0, 2.1, 3.0));
    assert_relative_ne!(Segment::new(a, a), Segment::new(a, -a));
}

#[cfg(feature = "serde")]
mod serde {
    use super::*;
    use proptest::prelude::*;

    const FINITE: &str = concat!(
        r#"{"origin":[0.0,0.0,0.0],"axes":[[1.0,0.0,0.0],[0.0,1.0,0.0],[0.0,0.0,1.0]],"#,
        r#""near":{"z":1.0,"left":-1.0,"right":1.0,"bottom":-1.0,"top":1.0},"#,
        r#""far":{"z":3.0,"left":-3.0,"right":3.0,"bottom":-3.0,"top":3.0}}"#
    );
    const INFINITE: &str = concat!(
        r#"{"origin":[0.0,0.0,0.0],"axes":[[1.0,0.0,0.0],[0.0,1.0,0.0],[0.0,0.0,1.0]],"#,
        r#""near":{"z":-1.0,"left":-1.0,"right":1.0,"bottom":-1.0,"top":1.0},"#,
        r#""slopes":{"left":-1.0,"right":1.0,"bottom":-0.5,"top":0.5},"direction":-1}"#
    );

    #[test]
    fn the_format() {
        for text in [FINITE, INFINITE] {
            let frustum: Frustum = serde_json::from_str(text).unwrap();
            assert_eq!(serde_json::to_string(&frustum).unwrap(), text);
        }
        let frustum: Frustum = serde_json::from_str(INFINITE).unwrap();
        assert_eq!(frustum.shape().direction(), Direction::MinusZ);
        // Integers are read as numbers.
        let frustum: Frustum = serde_json::from_str(&FINITE.replace(".0", "")).unwrap();
        assert_eq!(serde_json::to_string(&frustum).unwrap(), FINITE);
        // So is a direction with a decimal point.
        let frustum: Frustum = serde_json::from_str(&INFINITE.replace(":-1}", ":-1.0}")).unwrap();
        assert_eq!(serde_json::to_string(&frustum).unwrap(), INFINITE);
    }

    #[test]
    fn other_fields_are_errors_at_every_depth() {
        for (text, near, with) in [
            (FINITE, r#""near":{"#, r#""near":{"rihgt":1,"#),
            (FINITE, r#""far":{"#, r#""far":{"depth":1,"#),
            (INFINITE, r#""slopes":{"#, r#""slopes":{"z":1,"#),
        ] {
            let changed = text.replace(near, with);
            assert_ne!(changed, text);
            let error = serde_json::from_str::<Frustum>(&changed).unwrap_err();
            let error = error.to_string();
            assert!(error.contains("unknown field `"), "{error}");
            assert!(
                error.contains("`left`, `right`, `bottom`, `top`"),
                "{error}"
            );
        }
    }

    #[test]
    fn reading_validates() {
        for (change, message) in [
            (
                (r#""z":3.0"#, r#""z":1.0"#),
                "near and far are both at z = 1",
            ),
            (("[0.0,1.0,0.0]", "[2.0,0.0,2.0]"), "linearly dependent"),
            ((r#""right":3.0"#, r#""right":-4.0"#), "must not exceed"),
            (("\"far\"", "\"fär\""), "unknown field"),
            ((r#""z":1.0,"#, ""), "missing field `z`"),
            ((r#"}}"#, r#"},"direction":1}"#), "either `far` or both"),
        ] {
            let error =
                serde_json::from_str::<Frustum>(&FINITE.replace(change.0, change.1)).unwrap_err();
            assert!(error.to_string().contains(message), "{error}");
        }
        for wrong in [":2}", ":0}", ":-1.5}", ":1e300}"] {
            let text = INFINITE.replace(":-1}", wrong);
            let error = serde_json::from_str::<Frustum>(&text).unwrap_err();
            assert!(error.to_string().contains("it must be 1 or -1"), "{error}");
        }
    }

    #[test]
    fn results_read_back_and_have_the_names_of_csv() {
        let frustum: Frustum = serde_json::from_str(FINITE).unwrap();
        let segment = Segment::new([0.0, 0.0, 2.0], [4.0, 4.0, 2.0]);
        let clip = frustum.clip_segment(&segment).unwrap();
        let text = serde_json::to_string(&clip).unwrap();
        assert_eq!(
            text,
            concat!(
                r#"{"class":"cross","part":{"entry":{"t":0.0,"point":[0.0,0.0,2.0],"#,
                r#""clipped":false,"faces":[],"inward":true},"exit":{"t":0.5,"#,
                r#""point":[2.0,2.0,2.0],"clipped":true,"faces":["right","top"],"#,
                r#""inward":false},"coplanar":[]}}"#
            )
        );
        assert_eq!(
            serde_json::from_str::<SegmentClip<f64>>(&text).unwrap(),
            clip
        );
        let outside: SegmentClip<f32> =
            serde_json::from_str(r#"{"class":"outside","part":null}"#).unwrap();
        assert_eq!(outside, SegmentClip::OUTSIDE);
        for class in Class::ALL {
            let name = serde_json::to_value(class).unwrap();
            assert_eq!(name, class.name());
            assert_eq!(serde_json::from_value::<Class>(name).unwrap(), class);
        }
        for face in Face::ALL {
            assert_eq!(serde_json::to_value(face).unwrap(), face.name());
        }
        for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
            let name = format!("{accuracy:?}").to_lowercase();
            assert_eq!(serde_json::to_value(accuracy).unwrap(), name);
        }
        for bits in 0..64 {
            let set = FaceSet::from_bits(bits);
            let names = serde_json::to_value(set).unwrap();
            assert_eq!(serde_json::from_value::<FaceSet>(names).unwrap(), set);
        }
        let error = serde_json::from_str::<FaceSet>(r#"["near","side"]"#).unwrap_err();
        assert!(
            error.to_string().contains("unknown variant `side`"),
            "{error}"
        );
    }

    #[test]
    fn counts_read_back_if_a_stage_is_missing() {
        let counts: StageCounts = serde_json::from_str(r#"{"filter_failures":3}"#).unwrap();
        assert_eq!(
            serde_json::to_string(&counts).unwrap(),
            r#"{"lattice":0,"filter_failures":3,"double_doubles":0,"expansions":0,"integers":0}"#
        );
    }

    proptest! {
        #[test]
        fn nothing_is_lost(v in prop::array::uniform12(any::<f64>()), infinite in any::<bool>()) {
            let order = |a: f64, b: f64| (a.min(b), a.max(b));
            let ((l, r), (b, t)) = (order(v[0], v[1]), order(v[2], v[3]));
            let rect = Rect::new(l, r, b, t);
            let near = EndRect { z: v[4], rect };
            let shape = if infinite {
                Shape::Infinite { near, slopes: rect, direction: Direction::PlusZ }
            } else {
                Shape::Finite { near, far: EndRect { z: v[5], rect } }
            };
            let mut pose = Pose::IDENTITY;
            pose.origin = Vec3::new(v[6], v[7], v[8]);
            pose.axes[0] = Vec3::new(v[9], v[10], v[11]);
            if let Ok(frustum) = Frustum::new(pose, shape) {
                let text = serde_json::to_string(&frustum).unwrap();
                prop_assert_eq!(serde_json::from_str::<Frustum>(&text).unwrap(), frustum);
            }
        }
    }
}

/// Every version of glam that has a feature: both ways, bit for bit.
macro_rules! glam_versions {
    ($($feature:literal $glam:ident;)*) => {$(
        #[cfg(feature = $feature)]
        #[test]
        fn $glam() {
            use ::$glam::{DMat4, DVec3, Mat4, Vec3 as V, Vec3A};
            let v = V::new(1.0, -0.0, 3.5);
            assert_eq!(Vec3::from(v), Vec3::new(1.0, -0.0, 3.5));
            assert_eq!(V::from(Vec3::from(v)), v);
            assert_eq!(Vec3A::from(Vec3::from(Vec3A::from(v))), Vec3A::from(v));
            let d = DVec3::new(0.1, 0.2, 0.3);
            assert_eq!(DVec3::from(Vec3::from(d)), d);
            let columns: [f32; 16] = std::array::from_fn(|i| i as f32);
            let matrix = Mat4::from_cols_array(&columns);
            let layout = MatrixLayout::ColumnMajorColumnVectors;
            assert_eq!(ViewProjection::from(matrix), ViewProjection::from_flat(columns, layout));
            assert_eq!(Mat4::from(ViewProjection::from(matrix)), matrix);
            let matrix = DMat4::from_cols_array(&columns.map(f64::from));
            assert_eq!(DMat4::from(ViewProjection::from(matrix)), matrix);
        }
    )*};
}

glam_versions! {
    "glam027" glam027;
    "glam030" glam030;
    "glam033" glam033;
}
