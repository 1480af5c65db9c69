//! Each stage of the predicates is reached, and decides the cases that it is for.

use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::samples::{Placement, Solid};
use frusta::{Accuracy, Class, EndRect, Frustum, Pose, Segment, Shape, StageCounts};

fn counts(frustum: &Frustum, s: &Segment<f64>, accuracy: Accuracy) -> (Class, StageCounts) {
    let mut counts = StageCounts::default();
    let clip = frustum
        .clip_segment_counted(s, accuracy, &mut counts)
        .unwrap();
    (clip.class, counts)
}

fn symmetric() -> Frustum {
    Placement::IDENTITY.place(&Solid::SYMMETRIC).unwrap()
}

/// A frustum whose slopes are thirds, which no `f64` represents: it has no lattice.
fn thirds() -> Frustum {
    let shape = Shape::Finite {
        near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
        far: EndRect::new(4.0, -2.0, 2.0, -2.0, 2.0),
    };
    Frustum::new(Pose::IDENTITY, shape).unwrap()
}

#[test]
fn the_filter_decides_clear_cases() {
    let s = Segment::new([0.1, 0.2, 10.3], [70.7, 1.1, 20.9]);
    let (class, counts) = counts(&symmetric(), &s, Accuracy::Fast);
    assert_eq!((class, counts), (Class::Cross, StageCounts::default()));
}

/// In an edge and through a vertex, without any error.
#[test]
fn the_lattice_decides_touches() {
    for (s, expected) in [
        (
            Segment::new([8.0, -2.0, 8.0], [40.0, 20.0, 40.0]),
            Class::Boundary,
        ),
        (
            Segment::new([8.0, 0.0, 8.0], [8.0, 8.0, 8.0]),
            Class::Boundary,
        ),
        (
            Segment::new([8.0, 4.0, 8.0], [16.0, 8.0, 8.0]),
            Class::Touch,
        ),
    ] {
        let (class, counts) = counts(&symmetric(), &s, Accuracy::Fast);
        assert_eq!((class, counts.lattice), (expected, 1), "{s:?}");
        let later = [counts.filter_failures, counts.double_doubles];
        assert_eq!(later, [0, 0], "{counts:?}");
        assert_eq!([counts.expansions, counts.integers], [0, 0], "{counts:?}");
    }
}

/// An ulp off a side, which plain arithmetic cannot distinguish.
#[test]
fn double_double_decides_near_misses() {
    // On the side at z = 2.5, x is 1.5.
    for (x, other, expected) in [
        (1.5_f64.next_down(), [0.0, 0.1, 2.0], Class::Inside),
        (1.5_f64.next_up(), [5.0, 0.1, 2.0], Class::Outside),
    ] {
        let s = Segment::new([x, 0.3, 2.5], other);
        let (class, counts) = counts(&thirds(), &s, Accuracy::Fast);
        assert_eq!(class, expected);
        assert_eq!(counts.filter_failures, 1, "{counts:?}");
        assert!(counts.double_doubles > 0, "{counts:?}");
        assert_eq!((counts.expansions, counts.integers), (0, 0), "{counts:?}");
    }
}

/// A point exactly on a side: no approximation proves that.
#[test]
fn expansions_decide_exact_zeros_off_the_lattice() {
    let s = Segment::new([1.5, 0.3, 2.5], [5.0, 0.3, 2.6]);
    let (class, counts) = counts(&thirds(), &s, Accuracy::Fast);
    assert_eq!(class, Class::Touch);
    assert!(counts.expansions > 0, "{counts:?}");
    assert_eq!(
        (counts.filter_failures, counts.integers),
        (1, 0),
        "{counts:?}"
    );
}

/// The same scaled by a power of two, so that products underflow or overflow.
#[test]
fn integers_decide_values_beyond_the_range() {
    for scale in [2.0_f64.powi(-560), 2.0_f64.powi(560)] {
        let end =
            |z: f64, w: f64| EndRect::new(z * scale, -w * scale, w * scale, -w * scale, w * scale);
        let shape = Shape::Finite {
            near: end(1.0, 1.0),
            far: end(4.0, 2.0),
        };
        let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
        let s = Segment::new(
            [1.5 * scale, 0.3 * scale, 2.5 * scale],
            [5.0 * scale, 0.3 * scale, 2.6 * scale],
        );
        let (class, counts) = counts(&frustum, &s, Accuracy::Fast);
        assert_eq!(class, Class::Touch);
        assert!(
            counts.integers > 0 && counts.filter_failures == 1,
            "{counts:?}"
        );
    }
}

/// Rounding needs integers where the exact coordinate is half-way between two
/// `f64`; decisions do not.
#[test]
fn nearest_needs_integers_for_ties() {
    // Crosses x = z at the middle; y there is 1 + 2^-53.
    let s = Segment::new([10.0, 1.0, 20.0], [30.0, 1.0 + f64::EPSILON, 20.0]);
    let (class, fast) = counts(&symmetric(), &s, Accuracy::Fast);
    assert_eq!((class, fast.integers), (Class::Cross, 0));
    let (_, nearest) = counts(&symmetric(), &s, Accuracy::Nearest);
    assert!(nearest.integers > 0, "{nearest:?}");
}

/// Boxes have faces at zero, where no error bound proves a sign.
#[test]
fn a_face_at_zero_needs_no_integers() {
    let unit_box = Shape::Finite {
        near: EndRect::new(0.0, 0.0, 1.0, 0.0, 1.0),
        far: EndRect::new(1.0, 0.0, 1.0, 0.0, 1.0),
    };
    let frustum = Frustum::new(Pose::IDENTITY, unit_box).unwrap();
    for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
        for s in [
            Segment::new([-1.0, 0.3, 0.3], [0.7, 0.26, 0.77]),
            Segment::new([0.3, -1.1, 0.3], [0.77, 2.3, 0.6]),
            Segment::new([0.3, 0.3, -1.1], [0.77, 0.6, 2.3]),
        ] {
            let (class, counts) = counts(&frustum, &s, accuracy);
            assert_eq!((class, counts.integers), (Class::Cross, 0), "{accuracy:?}");
            assert_eq!(counts.filter_failures, 0, "{accuracy:?}");
        }
    }
}

/// All exact clippers use the same predicates; plain arithmetic has no predicates.
#[test]
fn every_exact_clipper_counts_and_no_plain_one() {
    use LiangBarskyVariant::{Textbook, Tuned};
    let fast = Accuracy::Fast;
    let pairs: [[Box<dyn SegmentClipper<f64>>; 2]; 6] = [
        [
            Box::new(VwProjection::exact(fast)),
            Box::new(VwProjection::plain()),
        ],
        [
            Box::new(LiangBarsky::exact(Textbook, fast)),
            Box::new(LiangBarsky::plain(Textbook)),
        ],
        [
            Box::new(LiangBarsky::exact(Tuned, fast)),
            Box::new(LiangBarsky::plain(Tuned)),
        ],
        [
            Box::new(CyrusBeck::exact(fast)),
            Box::new(CyrusBeck::plain()),
        ],
        [
            Box::new(CohenSutherland::exact(fast)),
            Box::new(CohenSutherland::plain()),
        ],
        [
            Box::new(SixPlanes::exact(fast)),
            Box::new(SixPlanes::plain()),
        ],
    ];
    let touch = Segment::new([1.5, 0.3, 2.5], [5.0, 0.3, 2.6]);
    for [exact, plain] in pairs {
        let count = |clipper: &dyn SegmentClipper<f64>| {
            let mut counts = StageCounts::default();
            let clip = clipper.clip_segment_counted(&thirds(), &touch, &mut counts);
            assert_eq!(clip, clipper.clip_segment(&thirds(), &touch));
            counts
        };
        let counts = count(&*exact);
        assert_eq!(counts.filter_failures, 1, "{}", exact.name());
        assert!(counts.expansions > 0, "{}", exact.name());
        assert_eq!(count(&*plain), StageCounts::default(), "{}", plain.name());
    }
}

#[test]
fn counts_add_up() {
    let s = Segment::new([1.5, 0.3, 2.5], [5.0, 0.3, 2.6]);
    let (_, one) = counts(&thirds(), &s, Accuracy::Fast);
    let sum: StageCounts = [one; 3].into_iter().sum();
    assert_eq!(sum, one + one + one);
    assert_eq!(sum.filter_failures, 3);
    assert_eq!(sum.expansions, 3 * one.expansions);
    let mut doubled = one;
    doubled += one;
    assert_eq!(
        (doubled.double_doubles, doubled.integers),
        (2 * one.double_doubles, 2 * one.integers)
    );
}
