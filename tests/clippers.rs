//! All clippers, through the one trait.

use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::samples::Random;
use frusta::{
    Accuracy, Class, Direction, EndRect, FaceSet, Frustum, Pose, Real, Rect, Segment, SegmentClip,
    Shape, Vec3,
};

type Clipper<T> = Box<dyn SegmentClipper<T>>;

fn plain<T: Real>() -> [Clipper<T>; 6] {
    [
        Box::new(VwProjection::plain()),
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Textbook)),
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Tuned)),
        Box::new(CyrusBeck::plain()),
        Box::new(CohenSutherland::plain()),
        Box::new(SixPlanes::plain()),
    ]
}

fn exact<T: Real>(accuracy: Accuracy) -> [Clipper<T>; 6] {
    [
        Box::new(VwProjection::exact(accuracy)),
        Box::new(LiangBarsky::exact(LiangBarskyVariant::Textbook, accuracy)),
        Box::new(LiangBarsky::exact(LiangBarskyVariant::Tuned, accuracy)),
        Box::new(CyrusBeck::exact(accuracy)),
        Box::new(CohenSutherland::exact(accuracy)),
        Box::new(SixPlanes::exact(accuracy)),
    ]
}

/// A point of the half-integer lattice around the shapes below.
fn lattice<T: Real>(random: &mut Random) -> Vec3<T> {
    let mut c = || T::from_f64(random.integer(-8, 8) as f64 / 2.0);
    Vec3::new(c(), c(), c())
}

/// Shapes whose plain coefficients are exact, as are the plain
/// boundary values of lattice points.
fn dyadic_shapes() -> Vec<Shape> {
    let finite = |near, far| Shape::Finite { near, far };
    vec![
        finite(
            EndRect::new(-1.0, -1.0, 1.0, -0.5, 0.5),
            EndRect::new(3.0, -3.0, 3.0, -2.5, 2.5),
        ),
        finite(
            EndRect::new(2.0, -1.0, 2.0, 0.0, 1.0),
            EndRect::new(-2.0, -2.0, 4.0, -2.0, 3.0),
        ),
        finite(
            EndRect::new(1.0, -2.0, 2.0, -1.5, 1.5),
            EndRect::new(-3.0, -2.0, 2.0, -1.5, 1.5),
        ),
        finite(
            EndRect::new(3.0, 0.0, 0.0, 0.0, 0.0),
            EndRect::new(-1.0, -4.0, 4.0, -2.0, 2.0),
        ),
        Shape::Infinite {
            near: EndRect::new(0.0, -1.0, 1.0, -1.0, 1.0),
            slopes: Rect::new(-0.5, 0.5, -0.25, 0.25),
            direction: Direction::PlusZ,
        },
        Shape::Infinite {
            near: EndRect::new(1.0, -1.0, 0.5, -1.0, 1.0),
            slopes: Rect::new(-0.5, 0.25, -1.0, 0.5),
            direction: Direction::MinusZ,
        },
    ]
}

/// The integer quaternion (1, 2, 2, 4) as axes of squared length 625, and an
/// origin.
fn turned() -> Pose {
    let axes = [[-15.0, 0.0, 20.0], [16.0, -15.0, 12.0], [12.0, 20.0, 9.0]].map(Vec3::from);
    Pose::new(Vec3::new(0.5, -1.0, 2.0), axes)
}

/// A frustum at a turned pose, and the map from points of the shape to points of the world: both
/// exact.
fn turn(shape: Shape) -> (Frustum, impl Fn(Vec3<f64>) -> Vec3<f64>) {
    let scaled = |e: EndRect| {
        let [left, right, bottom, top] = e.rect.to_array().map(|c| 625.0 * c);
        EndRect::new(625.0 * e.z, left, right, bottom, top)
    };
    let shape = match shape {
        Shape::Finite { near, far } => Shape::Finite {
            near: scaled(near),
            far: scaled(far),
        },
        Shape::Infinite {
            near,
            slopes,
            direction,
        } => Shape::Infinite {
            near: scaled(near),
            slopes,
            direction,
        },
    };
    let Pose { origin, axes } = turned();
    let to_world = move |p: Vec3<f64>| origin + axes[0] * p.x + axes[1] * p.y + axes[2] * p.z;
    (Frustum::new(turned(), shape).unwrap(), to_world)
}

fn same<T: Real>(a: &SegmentClip<T>, b: &SegmentClip<T>, what: &str) {
    assert_eq!(format!("{a:?}"), format!("{b:?}"), "{what}");
}

fn sets<T: Real>(clip: &SegmentClip<T>) -> (Class, [bool; 2], [FaceSet; 3]) {
    match clip.part {
        None => (clip.class, [false; 2], [FaceSet::EMPTY; 3]),
        Some(p) => (
            clip.class,
            [p.entry.clipped, p.exit.clipped],
            [p.entry.faces, p.exit.faces, p.coplanar],
        ),
    }
}

fn exact_tiers_agree<T: Real>(frustum: &Frustum, place: impl Fn(Vec3<f64>) -> Vec3<f64>) {
    let mut random = Random::new(&[7]);
    let mut classes = [0; 5];
    for i in 0..1500 {
        let mut point = || Vec3::<T>::from_f64(place(lattice(&mut random)));
        let s = Segment::new(point(), point());
        let accuracy = [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward][i % 3];
        let expected = frustum.clip_segment_with(&s, accuracy).unwrap();
        classes[expected.class as usize] += 1;
        for clipper in exact::<T>(accuracy) {
            let found = clipper.clip_segment(frustum, &s).unwrap();
            same(&found, &expected, &format!("{} on {s:?}", clipper.name()));
        }
    }
    assert!(classes.iter().all(|&n| n > 0), "{classes:?}");
}

#[test]
fn exact_tiers_of_all_algorithms_give_the_same_bits() {
    for shape in dyadic_shapes() {
        let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
        exact_tiers_agree::<f64>(&frustum, |p| p);
        exact_tiers_agree::<f32>(&frustum, |p| p);
    }
}

#[test]
fn exact_tiers_of_all_algorithms_give_the_same_bits_in_a_turned_frame() {
    for shape in dyadic_shapes() {
        let (frustum, place) = turn(shape);
        exact_tiers_agree::<f64>(&frustum, &place);
        exact_tiers_agree::<f32>(&frustum, &place);
    }
}

/// Where every boundary value is exact, equal quotients round alike: then the
/// parametric algorithms are right even in plain arithmetic.
fn plain_is_right_on_the_lattice<T: Real>() {
    let mut random = Random::new(&[3]);
    for shape in dyadic_shapes() {
        let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
        let mut classes = [0; 5];
        for _ in 0..20_000 {
            let s = Segment::<T>::new(lattice(&mut random), lattice(&mut random));
            let expected = frustum.clip_segment(&s).unwrap();
            classes[expected.class as usize] += 1;
            for clipper in &plain::<T>()[..4] {
                let found = clipper.clip_segment(&frustum, &s).unwrap();
                let name = clipper.name();
                assert_eq!(sets(&found), sets(&expected), "{name} on {s:?}");
                let ends = |c: &SegmentClip<T>| c.points().map(|ends| ends.map(Vec3::to_f64));
                if let (Some(a), Some(b)) = (ends(&found), ends(&expected)) {
                    for (a, b) in a.into_iter().zip(b) {
                        let d = a - b;
                        assert!(
                            d.dot(d).sqrt() < 100.0 * T::UNIT_ROUNDOFF,
                            "{name} on {s:?}"
                        );
                    }
                }
            }
        }
        assert!(classes.iter().all(|&n| n > 10), "{classes:?}");
    }
}

#[test]
fn plain_parametric_clippers_are_right_where_their_values_are_exact() {
    plain_is_right_on_the_lattice::<f32>();
    plain_is_right_on_the_lattice::<f64>();
}

#[test]
fn six_planes_errs_on_edges_as_described() {
    let shape = Shape::Finite {
        near: EndRect::new(-1.0, -0.1, 0.1, -0.1, 0.1),
        far: EndRect::new(-7.0, -0.7, 0.7, -0.7, 0.7),
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
    let (mut missed, mut wrong) = (0, 0);
    for i in 1..1000 {
        // Through a point of an edge, from outside to the middle.
        let z = -1.0 - f64::from(i) * 0.006;
        let edge = Vec3::new(0.1 * -z, 0.1 * -z, z);
        let inner = Vec3::new(0.0, 0.01, -4.0);
        let s = Segment::new(edge + (edge - inner) * 0.5, edge - (edge - inner) * 1.5);
        let exact = frustum.clip_segment(&s).unwrap().class;
        let planes = SixPlanes::plain().clip_segment(&frustum, &s).unwrap().class;
        let sound = CyrusBeck::plain().clip_segment(&frustum, &s).unwrap().class;
        assert_eq!((exact, sound), (Class::Cross, Class::Cross), "{s:?}");
        missed += usize::from(planes == Class::Outside);
        wrong += usize::from(planes != exact);
    }
    assert!(wrong > 50, "wrong {wrong} times, missed {missed} times");
}

const EXTREMES: [f64; 12] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    5e-324,
    -1e-310,
    1e-160,
    3.0e7,
    -1e155,
    1e300,
    f64::MAX,
    -f64::MAX,
];

fn extreme_frusta() -> Vec<Frustum> {
    let end = EndRect::new;
    let max = f64::MAX;
    let shapes = [
        (
            end(-1.0, -1.0, 1.0, -1.0, 1.0),
            end(-2.0, -2.0, 2.0, -2.0, 2.0),
        ),
        (
            end(0.0, 0.0, 0.0, 0.0, 0.0),
            end(5e-324, -max, max, -max, max),
        ),
        (
            end(-max, -max, max, -1.0, 1.0),
            end(max, max, max, -1.0, 1.0),
        ),
        (
            end(1.0, -1e-300, 1e-300, 0.0, 1e300),
            end(1.0f64.next_up(), 1.0, 1.0, 0.0, 0.0),
        ),
        (
            end(1e-320, -1e-320, 0.0, 0.0, 1e-320),
            end(0.0, 0.0, 0.0, 0.0, 0.0),
        ),
    ];
    let scaled = Pose::new(
        Vec3::new(1e300, -1e300, 0.0),
        [[1e200, 0.0, 1.0], [0.0, 1e-200, 0.0], [-1e300, 0.0, 1e300]].map(Vec3::from),
    );
    let mut frusta = Vec::new();
    for (near, far) in shapes {
        for pose in [Pose::IDENTITY, turned(), scaled] {
            frusta.push(Frustum::new(pose, Shape::Finite { near, far }).unwrap());
        }
    }
    frusta.push(
        Frustum::new(
            Pose::IDENTITY,
            Shape::Infinite {
                near: end(0.0, -max, 0.0, 0.0, 0.0),
                slopes: Rect::new(-max, max, 0.0, 5e-324),
                direction: Direction::MinusZ,
            },
        )
        .unwrap(),
    );
    frusta
}

fn extremes_give_finite_results<T: Real>() {
    let extreme = |random: &mut Random| loop {
        let v = T::from_f64(random.pick(&EXTREMES));
        if v.is_finite() {
            return v;
        }
    };
    let mut random = Random::new(&[11]);
    for frustum in extreme_frusta() {
        for _ in 0..2000 {
            let mut point = || {
                Vec3::new(
                    extreme(&mut random),
                    extreme(&mut random),
                    extreme(&mut random),
                )
            };
            let s = Segment::new(point(), point());
            for clipper in plain::<T>() {
                let name = clipper.name();
                let clip = clipper.clip_segment(&frustum, &s).unwrap();
                let Some(part) = clip.part else {
                    assert_eq!(clip.class, Class::Outside, "{name} on {s:?}");
                    continue;
                };
                let (entry, exit) = (part.entry, part.exit);
                let ok = T::ZERO <= entry.t && entry.t <= exit.t && exit.t <= T::ONE;
                assert!(ok, "{name} on {s:?}: {part:?}");
                for (end, original) in [(entry, s.start), (exit, s.end)] {
                    assert!(end.point.is_finite(), "{name} on {s:?}: {part:?}");
                    assert!(end.clipped || end.point == original, "{name} on {s:?}");
                }
            }
        }
    }
}

#[test]
fn plain_results_are_finite_on_any_finite_input() {
    extremes_give_finite_results::<f64>();
    extremes_give_finite_results::<f32>();
}

#[test]
fn a_coordinate_that_is_not_finite_is_an_error_that_names_it() {
    let frustum = Frustum::new(Pose::IDENTITY, dyadic_shapes()[0]).unwrap();
    let all = || plain::<f64>().into_iter().chain(exact(Accuracy::Fast));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for at in 0..6 {
            // Far outside, so that a clipper that checks later would return `Outside`.
            let mut c = [100.0; 6];
            c[at] = bad;
            let s = Segment::new([c[0], c[1], c[2]], [c[3], c[4], c[5]]);
            let expected = s.check_finite().unwrap_err();
            for clipper in all() {
                let error = clipper.clip_segment(&frustum, &s).unwrap_err();
                assert_eq!(
                    format!("{error:?}"),
                    format!("{expected:?}"),
                    "{}",
                    clipper.name()
                );
            }
        }
    }
}

#[test]
fn a_huge_segment_is_clipped_at_the_right_points() {
    let frustum = Frustum::new(Pose::IDENTITY, dyadic_shapes()[2]).unwrap();
    let s = Segment::new([0.0, 0.0, f64::MAX], [0.0, 0.0, -f64::MAX]);
    for clipper in plain::<f64>() {
        let part = clipper.clip_segment(&frustum, &s).unwrap().part.unwrap();
        assert_eq!(
            (part.entry.t, part.exit.t),
            (0.5, 0.5),
            "{}",
            clipper.name()
        );
        assert!(part.entry.clipped && part.exit.clipped);
        assert_eq!(part.entry.point, Vec3::new(0.0, 0.0, 0.0));
    }
}

#[test]
fn default_clippers_are_exact() {
    let exact = frusta::clip::Arithmetic::Exact(Accuracy::Fast);
    assert_eq!(VwProjection::default().arithmetic, exact);
    assert_eq!(LiangBarsky::default().arithmetic, exact);
    assert_eq!(LiangBarsky::default().variant, LiangBarskyVariant::Tuned);
    assert_eq!(SixPlanes::default().arithmetic, exact);
    assert_eq!(CyrusBeck::default().arithmetic, exact);
    assert_eq!(CohenSutherland::default().arithmetic, exact);
}
