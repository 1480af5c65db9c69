//! Windows, tiles and stereo eyes of a frustum, and the paper's six points.

use frusta::{
    Camera, EndRect, FarCorners, Frustum, FrustumError, Pose, Projection, Rect, Shape, SixPoints,
    Vec3,
};
use proptest::prelude::*;

/// The ends' rectangles; slopes in place of the missing one.
fn rects(f: &Frustum) -> [Rect; 2] {
    match *f.shape() {
        Shape::Finite { near, far } => [near.rect, far.rect],
        Shape::Infinite { near, slopes, .. } => [near.rect, slopes],
    }
}

fn frustum(far: f64) -> Frustum {
    Camera {
        eye: Vec3::new(1e3, 2.0, -0.3),
        target: Vec3::new(0.7, 0.1, 5.0),
        up: Vec3::new(0.0, 1.0, 0.1),
        projection: Projection::OffAxis {
            rect: Rect::new(-0.1, 0.37, -0.2, 0.09),
        },
        near: 0.3,
        far,
    }
    .frustum()
    .unwrap()
}

#[test]
fn tiles_share_their_borders() {
    for parent in [frustum(1e4), frustum(f64::INFINITY)] {
        let (columns, rows) = (7, 3);
        let tile = |i, j| rects(&parent.tile(i, j, columns, rows).unwrap());
        for end in 0..2 {
            let whole = rects(&parent)[end];
            for i in 0..columns {
                for j in 0..rows {
                    let r = tile(i, j)[end];
                    let right = if i + 1 < columns {
                        tile(i + 1, j)[end].left
                    } else {
                        whole.right
                    };
                    let top = if j + 1 < rows {
                        tile(i, j + 1)[end].bottom
                    } else {
                        whole.top
                    };
                    assert_eq!(
                        (r.right.to_bits(), r.top.to_bits()),
                        (right.to_bits(), top.to_bits())
                    );
                    assert!(r.left < r.right && r.bottom < r.top);
                    if i == 0 {
                        assert_eq!(r.left.to_bits(), whole.left.to_bits());
                    }
                    if j == 0 {
                        assert_eq!(r.bottom.to_bits(), whole.bottom.to_bits());
                    }
                }
            }
        }
        assert_eq!(parent.tile(0, 0, 1, 1).unwrap(), parent);
        for (i, j, c, r) in [(7, 0, 7, 3), (0, 3, 7, 3), (0, 0, 0, 1)] {
            let error = parent.tile(i, j, c, r).unwrap_err();
            assert!(matches!(error, FrustumError::NoSuchTile { .. }), "{error}");
        }
    }
}

#[test]
fn bad_windows_are_named() {
    use FrustumError as E;
    let parent = frustum(10.0);
    let error = |l, r, b, t| parent.window(Rect::new(l, r, b, t)).unwrap_err();
    assert!(matches!(
        error(0.5, 0.25, 0.0, 1.0),
        E::Inverted { end: "window", .. }
    ));
    assert_eq!(
        error(0.5, 0.5, 0.0, 1.0),
        E::Flat {
            what: "left..right"
        }
    );
    assert_eq!(
        error(0.0, 1.0, 0.0, 1e-300),
        E::Flat {
            what: "bottom..top"
        }
    );
    assert!(matches!(
        error(0.0, f64::NAN, 0.0, 1.0),
        E::NonFinite {
            what: "window.right",
            ..
        }
    ));
    assert!(matches!(
        error(-f64::MAX, f64::MAX, 0.0, 1.0),
        E::Overflow { .. }
    ));
    for convergence in [0.0, -0.0, f64::NAN] {
        let error = parent.stereo_eye(1.0, convergence).unwrap_err();
        assert!(matches!(error, E::Convergence { .. }), "{error}");
    }
    assert!(matches!(
        parent.stereo_eye(f64::NAN, 1.0),
        Err(E::NonFinite { what: "offset", .. })
    ));
    assert!(matches!(
        parent.stereo_eye(1e300, 1e-300),
        Err(E::Overflow { .. })
    ));
}

#[test]
fn a_window_may_reach_beyond() {
    let shape = Shape::Finite {
        near: EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0),
        far: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
    };
    let pyramid = Frustum::new(Pose::IDENTITY, shape).unwrap();
    let part = pyramid.window(Rect::new(-0.5, 0.25, 0.5, 2.0)).unwrap();
    assert_eq!(
        rects(&part),
        [Rect::default(), Rect::new(-2.0, -0.5, 0.0, 3.0)]
    );
}

#[test]
fn parallel_eyes_move_without_turning() {
    for parent in [frustum(20.0), frustum(f64::INFINITY)] {
        let eye = parent.stereo_eye(0.0625, f64::INFINITY).unwrap();
        let ([near, far], [n, f]) = (rects(&eye), rects(&parent));
        assert_eq!((near.left, near.right), (n.left + 0.0625, n.right + 0.0625));
        if parent.shape().far().is_some() {
            assert_eq!((far.left, far.right), (f.left + 0.0625, f.right + 0.0625));
        } else {
            assert_eq!(far, f);
        }
    }
}

#[test]
fn finite_and_infinite_eyes_agree() {
    // The same sides, once by far rectangle and once by slopes.
    let near = EndRect::new(-2.0, -2.0, 2.0, -2.0, 2.0);
    let finite = Shape::Finite {
        near,
        far: EndRect::new(-8.0, -8.0, 8.0, -8.0, 8.0),
    };
    let infinite = Shape::Infinite {
        near,
        slopes: Rect::centred(1.0, 1.0),
        direction: frusta::Direction::MinusZ,
    };
    let eye = |shape| {
        let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
        rects(&frustum.stereo_eye(0.5, -4.0).unwrap())
    };
    let ([n, f], [m, s]) = (eye(finite), eye(infinite));
    assert_eq!(n, m);
    assert_eq!(f, Rect::new(-8.5, 7.5, -8.0, 8.0));
    assert_eq!(
        (n.left + 6.0 * s.left, n.right + 6.0 * s.right),
        (f.left, f.right)
    );
}

proptest! {
    #[test]
    fn windows_in_order_do_not_overlap(mut s in prop::array::uniform4(-0.5..1.5), far in 1.0..1e6) {
        s.sort_by(f64::total_cmp);
        let parent = frustum(far);
        let windows = [(s[0], s[1]), (s[1], s[2]), (s[2], s[3])]
            .map(|(a, b)| parent.window(Rect::new(a, b, 0.0, 1.0)));
        if let [Ok(a), Ok(b), Ok(c)] = windows {
            for end in 0..2 {
                let [a, b, c] = [&a, &b, &c].map(|f| rects(f)[end]);
                prop_assert!(a.left <= a.right && b.left <= b.right && c.left <= c.right);
                prop_assert_eq!((a.right, b.right), (b.left, c.left));
                prop_assert_eq!((a.bottom, a.top), (rects(&parent)[end].bottom, rects(&parent)[end].top));
            }
        }
    }

    #[test]
    fn any_part_is_right_or_refused(w in prop::array::uniform4(any::<u64>()), tile in prop::array::uniform4(any::<u32>()),
                                    infinite in any::<bool>()) {
        let parent = frustum(if infinite { f64::INFINITY } else { 1e3 });
        let [a, b, c, d] = w.map(f64::from_bits);
        let [i, j, m, n] = tile;
        for part in [parent.window(Rect::new(a, b, c, d)), parent.tile(i, j, m, n), parent.stereo_eye(a, b)] {
            match part {
                Ok(part) => prop_assert!(part.shape().validate().is_ok() && part.pose() == parent.pose()),
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}

/// Base 6 by 4, top 3 by 2, 5 high, turned by three integer axes of length 3.
fn six_points() -> SixPoints {
    let [x, y, z] = [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]].map(Vec3::from);
    let base = Vec3::new(10.0, 20.0, 30.0);
    let top = base + z * 5.0;
    SixPoints {
        base_centre: base,
        top_centre: top,
        base_x: base + x * 3.0,
        base_y: base + y * 2.0,
        top_x: top + x * 1.5,
        top_y: top + y,
    }
}

#[test]
fn six_points_with_exact_differences_are_exact() {
    let points = six_points();
    let frustum = points.frustum().unwrap();
    let corners = frustum.corners();
    let FarCorners::Points(base) = corners.far else {
        panic!("{corners:?}")
    };
    let (x, y) = (
        points.base_x - points.base_centre,
        points.base_y - points.base_centre,
    );
    assert_eq!(base[2], points.base_centre + x + y);
    assert_eq!(base[0], points.base_centre - x - y);
    let (x, y) = (
        points.top_x - points.top_centre,
        points.top_y - points.top_centre,
    );
    assert_eq!(corners.near[2], points.top_centre + x + y);
    assert_eq!(corners.near[1], points.top_centre + x - y);
    assert!(frustum.tv().is_isosceles() && frustum.tw().is_isosceles());
}

#[test]
fn six_points_may_end_in_a_point() {
    let mut points = six_points();
    points.top_x = points.top_centre;
    points.top_y = points.top_centre;
    let frustum = points.frustum().unwrap();
    assert_eq!(rects(&frustum)[0], Rect::default());
    assert_eq!(frustum.corners().near, [points.top_centre; 4]);
}

#[test]
fn six_points_at_any_scale() {
    for scale in [5e-160, 1e15, 1e153] {
        let exact = six_points();
        let times = |p: Vec3<f64>| p * scale;
        let points = SixPoints {
            base_centre: times(exact.base_centre),
            top_centre: times(exact.top_centre),
            base_x: times(exact.base_x),
            base_y: times(exact.base_y),
            top_x: times(exact.top_x),
            top_y: times(exact.top_y),
        };
        let (got, expected) = (
            points.frustum().unwrap().corners(),
            exact.frustum().unwrap().corners(),
        );
        for (p, e) in got.near.into_iter().zip(expected.near) {
            for i in 0..3 {
                assert!((p[i] / scale - e[i]).abs() < 1e-13, "{scale}: {p} {e}");
            }
        }
    }
    // A metre at 1e15, where a coordinate is a multiple of 1/8.
    let at = |x, y, z| Vec3::new(1e15 + x, 1e15 + y, 1e15 + z);
    let points = SixPoints {
        base_centre: at(0.0, 0.0, 0.0),
        top_centre: at(0.0, 0.0, 1.0),
        base_x: at(0.5, 0.0, 0.0),
        base_y: at(0.0, 0.5, 0.0),
        top_x: at(0.25, 0.0, 1.0),
        top_y: at(0.0, 0.25, 1.0),
    };
    assert_eq!(
        points.frustum().unwrap().corners().near[2],
        at(0.25, 0.25, 1.0)
    );
}

#[test]
fn degenerate_six_points_say_which() {
    let error = |change: &dyn Fn(&mut SixPoints)| {
        let mut points = six_points();
        change(&mut points);
        points.frustum().unwrap_err().to_string()
    };
    for (change, expected) in [
        (
            (&|p: &mut SixPoints| p.top_centre = p.base_centre) as &dyn Fn(&mut SixPoints),
            "the top's centre Pt and the base's centre Pb are both (10, 20, 30)",
        ),
        (
            &|p| p.base_x = p.base_centre,
            "A1 and the base's centre Pb are both",
        ),
        (
            &|p| p.base_y = p.base_centre,
            "A2 and the base's centre Pb are both",
        ),
        (
            &|p| p.base_y = p.base_x,
            "A2 and the base's midpoint A1 meet at cosine 1",
        ),
        (
            &|p| p.base_x = p.base_x + Vec3::new(0.0, 0.0, 0.5),
            "right angle",
        ),
        (
            &|p| p.top_x = p.base_x,
            "the top's midpoint A3 and the top's centre Pt meet",
        ),
        (
            &|p| p.top_x = p.top_centre - (p.top_x - p.top_centre),
            "the top's midpoint A3 lies opposite",
        ),
        (
            &|p| p.top_y = p.top_centre - (p.top_y - p.top_centre),
            "the top's midpoint A4 lies opposite",
        ),
        (&|p| p.top_y.z = f64::NAN, "the top's midpoint A4 is NaN"),
    ] {
        let got = error(change);
        assert!(got.contains(expected), "{got}");
    }
}

proptest! {
    #[test]
    fn any_six_points_are_right_or_refused(v in prop::array::uniform18(prop_oneof![
        any::<u64>().prop_map(f64::from_bits), -2.0..2.0,
        prop::sample::select(vec![0.0, 1.0, -1.0, 1e300, 1e-160, 5e-324, f64::MAX])])) {
        let p: [Vec3<f64>; 6] = std::array::from_fn(|i| Vec3::new(v[3 * i], v[3 * i + 1], v[3 * i + 2]));
        let any = SixPoints { base_centre: p[0], top_centre: p[1], base_x: p[2], base_y: p[3], top_x: p[4], top_y: p[5] };
        // Made of right angles, of any lengths.
        let o = p[0];
        let right = SixPoints {
            base_centre: o,
            top_centre: o + Vec3::new(0.0, 0.0, p[1].z),
            base_x: o + Vec3::new(p[2].x, 0.0, 0.0),
            base_y: o + Vec3::new(0.0, p[3].y, 0.0),
            top_x: o + Vec3::new(p[4].x, 0.0, p[1].z),
            top_y: o + Vec3::new(0.0, p[5].y, p[1].z),
        };
        for points in [any, right] {
            match points.frustum() {
                Ok(frustum) => prop_assert!(frustum.shape().validate().is_ok()),
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}
