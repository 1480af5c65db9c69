//! The oracle compared with answers known by hand and with a second definition, and its
//! checks of answers that are known to be wrong.

use super::*;
use crate::clip::{Accuracy, Part, SegmentClip};
use crate::frustum::{Direction, EndRect, Face};
use crate::math::{Pose, Rect};

fn symmetric() -> Frustum {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap()
}

fn set(faces: &[Face]) -> FaceSet {
    faces.iter().copied().collect()
}

fn fraction(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

/// A generator of small integers in -6..=6.
fn small_integers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695);
        ((state >> 33) % 13) as f64 - 6.0
    }
}

#[test]
fn through_a_side_and_the_far_end() {
    let segment = Segment::new([0.0, 0.0, 2.0], [6.0, 3.0, 4.0]);
    // x = 6t meets z = 2 + 2t at t = 1/2, where also z = 3.
    let clip = clip(&symmetric(), &segment).unwrap();
    let part = clip.part.unwrap();
    assert_eq!(clip.class, Class::Cross);
    assert_eq!(part.exit.t, fraction(1, 2));
    assert_eq!(part.exit.faces, set(&[Face::Far, Face::Right]));
    assert!(part.exit.clipped && !part.entry.clipped);
    assert!(part.entry.faces.is_empty() && part.coplanar.is_empty());
    assert_eq!(
        part.exit.point,
        [fraction(3, 1), fraction(3, 2), fraction(3, 1)]
    );
}

#[test]
fn zero_length_is_a_point() {
    let at = |p: [f64; 3]| clip(&symmetric(), &Segment::new(p, p)).unwrap();
    assert_eq!(at([0.0, 0.0, 0.5]).class, Class::Outside);
    assert_eq!(at([0.0, 0.0, 2.0]).class, Class::Inside);
    let touch = at([2.0, 0.0, 2.0]);
    assert_eq!(touch.class, Class::Touch);
    let part = touch.part.unwrap();
    assert_eq!(
        (part.entry.t, part.exit.t),
        (fraction(0, 1), fraction(1, 1))
    );
    assert_eq!(part.entry.faces, Face::Right.into());
    assert_eq!(part.exit.faces, Face::Right.into());
    assert!(part.coplanar.is_empty() && !part.entry.clipped && !part.exit.clipped);
}

#[test]
fn nothing_is_inside_behind_an_apex() {
    let near = EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0);
    let far = EndRect::new(-4.0, -2.0, 2.0, -2.0, 2.0);
    let pyramid = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    let behind = Segment::new([0.0, 0.0, 1.0], [0.1, 0.0, 1.0]);
    assert_eq!(clip(&pyramid, &behind).unwrap().class, Class::Outside);
    let through = Segment::new([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let part = clip(&pyramid, &through).unwrap().part.unwrap();
    let four = set(&[Face::Near, Face::Left, Face::Right, Face::Bottom, Face::Top]);
    assert_eq!(part.entry.faces, four);
}

#[test]
fn an_infinite_frustum_has_no_far_face() {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let shape = Shape::Infinite {
        near,
        slopes: Rect::centred(1.0, 0.0),
        direction: Direction::PlusZ,
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
    let segment = Segment::new([0.0, 1.0, 0.0], [0.0, 1.0, 1e300]);
    let clip = clip(&frustum, &segment).unwrap();
    let part = clip.part.unwrap();
    assert_eq!(clip.class, Class::Boundary);
    assert_eq!(part.coplanar, Face::Top.into());
    assert_eq!(part.entry.faces, set(&[Face::Near, Face::Top]));
    assert!(!part.exit.clipped);
}

#[test]
fn the_whole_range_of_f64_at_once() {
    let near = EndRect::new(5e-324, -1e300, 1e300, -5e-324, 5e-324);
    let far = EndRect::new(1e300, -1e300, 1e300, -1e300, 1e-300);
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    let segment = Segment::new([0.0, 0.0, 0.0], [0.0, 0.0, 1e300]);
    let part = clip(&frustum, &segment).unwrap().part.unwrap();
    assert_eq!(part.entry.faces, Face::Near.into());
    assert_eq!(round_nearest::<f64>(&part.entry.point[2]), 5e-324);
    assert!(!part.exit.clipped && part.exit.faces == Face::Far.into());
}

/// Membership by the definition, in plain fractions.
fn is_in_hull(shape: &Shape, q: &[BigRational; 3]) -> bool {
    let exact = |v: f64| BigRational::from_float(v).unwrap();
    let Shape::Finite { near, far } = shape else {
        panic!("finite shapes only")
    };
    let depth = (&q[2] - exact(near.z)) / (exact(far.z) - exact(near.z));
    if depth < fraction(0, 1) || depth > fraction(1, 1) {
        return false;
    }
    let (n, f) = (
        near.rect.to_array().map(exact),
        far.rect.to_array().map(exact),
    );
    let bound = |i: usize| &n[i] + (&f[i] - &n[i]) * &depth;
    bound(0) <= q[0] && q[0] <= bound(1) && bound(2) <= q[1] && q[1] <= bound(3)
}

#[test]
fn agrees_with_the_definition_along_random_segments() {
    let mut next = small_integers(7);
    let (mut inside, mut tried) = (0, 0);
    while tried < 400 {
        let mut rect = |z: f64| {
            let (a, b, c, d) = (next(), next(), next(), next());
            let [a, b, c, d] = [a, b, c, d].map(|v| 10.0 * v);
            EndRect::new(z, a.min(b), a.max(b), c.min(d), c.max(d))
        };
        let (near, far) = (rect(-30.0), rect(50.0));
        let (near, far) = if tried % 2 == 0 {
            (near, far)
        } else {
            (far, near)
        };
        let mut vector = || Vec3::new(next(), next(), next());
        let pose = Pose::new(vector(), [vector(), vector(), vector()]);
        let [a, b, c] = pose.axes;
        let shape = Shape::Finite { near, far };
        let segment = Segment::new(vector(), vector());
        if a.dot(b.cross(c)) == 0.0 || shape.validate().is_err() {
            continue;
        }
        tried += 1;
        let frustum = Frustum::new(pose, shape).unwrap();
        let clip = clip(&frustum, &segment).unwrap();
        for i in 0..=24 {
            let t = fraction(i, 24);
            let world = [0, 1, 2].map(|k| {
                let exact = |v: f64| BigRational::from_float(v).unwrap();
                let (p, q) = (exact(segment.start[k]), exact(segment.end[k]));
                &p + (q - &p) * &t - exact(pose.origin[k])
            });
            let frame = pose.axes.map(|axis| {
                let products = axis.to_array().into_iter().zip(&world);
                products
                    .map(|(a, w)| BigRational::from_float(a).unwrap() * w)
                    .sum()
            });
            let should = is_in_hull(&shape, &frame);
            let is = clip
                .part
                .as_ref()
                .is_some_and(|p| segment.start == segment.end || (p.entry.t <= t && t <= p.exit.t));
            assert_eq!(is, should, "t = {t}, {segment:?}, {frustum:?}");
            inside += usize::from(should);
        }
    }
    assert!(inside > 500, "only {inside} points were inside");
}

#[test]
fn its_own_answers_pass_its_checks() {
    let mut next = small_integers(99);
    let frustum = symmetric();
    let oracle = Oracle::new(&frustum);
    for _ in 0..2_000 {
        let mut vector = || Vec3::new(next() / 3.0, next() / 7.0, next());
        let segment = Segment::new(vector(), vector());
        for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
            let answer = oracle.answer(&segment, accuracy).unwrap();
            let found = check(&frustum, &segment, accuracy, &answer).unwrap();
            assert_eq!(found, [], "{segment:?} {accuracy:?}");
            let reversed = oracle.answer(&segment.reversed(), accuracy).unwrap();
            assert_eq!(check_swapped(&answer, &reversed), None);
            let again = check_idempotent(&answer, |s| oracle.answer(s, accuracy));
            assert!(accuracy != Accuracy::Inward || again.is_none(), "{again:?}");
        }
    }
}

/// The violations found after a change to a right answer.
fn kinds_after(
    accuracy: Accuracy,
    spoil: impl Fn(&mut SegmentClip<f64>, &mut Part<f64>),
) -> Vec<ViolationKind> {
    // Enters through the left side away from representable points, ends inside.
    let segment = Segment::new([-3.0, 0.1, 2.0], [0.0, 0.0, 2.3]);
    let oracle = Oracle::new(&symmetric());
    let mut answer = oracle.answer(&segment, accuracy).unwrap();
    let mut part = answer.part.unwrap();
    spoil(&mut answer, &mut part);
    answer.part = answer.part.and(Some(part));
    let found = check(&symmetric(), &segment, accuracy, &answer).unwrap();
    found.into_iter().map(|v| v.kind).collect()
}

#[test]
fn each_wrong_answer_is_found() {
    use Accuracy::{Fast, Inward, Nearest};
    use ViolationKind as K;
    type Spoil = fn(&mut SegmentClip<f64>, &mut Part<f64>);
    let cases: [(Accuracy, Spoil, K); 15] = [
        (Fast, |a, _| a.class = Class::Inside, K::Class),
        (Fast, |a, _| a.part = None, K::Class),
        (Fast, |_, p| p.entry.faces = FaceSet::EMPTY, K::Set),
        (Fast, |_, p| p.exit.faces = Face::Far.into(), K::Set),
        (Fast, |_, p| p.coplanar = Face::Top.into(), K::Set),
        (Fast, |_, p| p.entry.clipped = false, K::Set),
        (Fast, |_, p| p.exit.point.y = -0.0, K::UnclippedEnd),
        (Fast, |_, p| p.exit.inward = false, K::UnclippedEnd),
        (Fast, |_, p| p.entry.inward = true, K::InwardFlag),
        (Fast, |_, p| p.entry.t *= 1.0 + 1e-14, K::Parameter),
        (Fast, |_, p| p.entry.point.x *= 1.0 + 1e-14, K::Point),
        (
            Nearest,
            |_, p| p.entry.point.y = p.entry.point.y.next_up(),
            K::Point,
        ),
        (
            Nearest,
            |_, p| p.entry.t = p.entry.t.next_up(),
            K::Parameter,
        ),
        (Inward, |_, p| p.entry.point.x -= 4e-16, K::NotInward),
        (Inward, |_, p| p.entry.point.x += 3e-15, K::Point),
    ];
    for (i, (accuracy, spoil, kind)) in cases.into_iter().enumerate() {
        assert_eq!(kinds_after(accuracy, spoil), [kind], "case {i}");
    }
    let missed = kinds_after(Inward, |_, p| p.entry.inward = false);
    assert!(missed.contains(&K::InwardMissed), "{missed:?}");
    let order = kinds_after(Fast, |_, p| p.entry.t = 2.0);
    assert!(order.contains(&K::Order), "{order:?}");
    assert_eq!(kinds_after(Inward, |_, _| {}), []);
}

#[test]
fn a_near_hit_keeps_its_depth() {
    let segment = Segment::new([0.3, 0.1, 0.0], [0.0, 0.0, 2.3]);
    let oracle = Oracle::new(&symmetric());
    for accuracy in [Accuracy::Fast, Accuracy::Inward] {
        let mut answer = oracle.answer(&segment, accuracy).unwrap();
        let part = answer.part.as_mut().unwrap();
        assert_eq!(part.entry.point.z, 1.0);
        part.entry.point.z = 1.0_f64.next_up();
        let found = check(&symmetric(), &segment, accuracy, &answer).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].kind, ViolationKind::EndDepth);
    }
}

#[test]
fn no_inward_point_if_the_frustum_has_none() {
    // One ulp wide and slanted: between two adjacent values for every z strictly inside.
    let ulp = f64::EPSILON;
    let near = EndRect::new(0.0, 1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(1.0, 1.0 + ulp, 1.0 + 2.0 * ulp, -1.0, 1.0);
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    let oracle = Oracle::new(&frustum);
    let segment = Segment::new([0.5, 0.0, 0.125], [1.5, 0.0, 0.125]);
    let answer = oracle.answer(&segment, Accuracy::Inward).unwrap();
    let part = answer.part.unwrap();
    assert!(!part.entry.inward && !part.exit.inward);
    let found = check(&frustum, &segment, Accuracy::Inward, &answer).unwrap();
    assert_eq!(found, []);
}

#[test]
fn input_that_is_not_finite_is_an_error() {
    let segment = Segment::new([0.0, f64::NAN, 0.0], [0.0, 0.0, 1.0]);
    assert!(clip(&symmetric(), &segment).is_err());
    assert!(!contains(&symmetric(), Vec3::new(f64::INFINITY, 0.0, 2.0)));
    assert!(contains(&symmetric(), Vec3::new(2.0, -2.0, 2.0)));
    assert!(!contains(
        &symmetric(),
        Vec3::new(2.0_f64.next_up(), -2.0, 2.0)
    ));
}

#[test]
fn near_is_four_ulps_and_no_more() {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(3.0, -1.0, 1.0, -1.0, 1.0);
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    let oracle = Oracle::new(&frustum);
    let ulp = f64::EPSILON;
    let is_near = |a: [f64; 3], b: [f64; 3]| {
        let s = Segment::new(a, b);
        assert_eq!(oracle.is_near(&s), oracle.is_near(&s.reversed()));
        oracle.is_near(&s)
    };
    let inside = [0.25, 0.5, 2.0];
    // An end at a face, on either side.
    for (n, expected) in [(0.0, true), (4.0, true), (5.0, false), (-2.0, true)] {
        assert_eq!(is_near([1.0 + n * ulp, 0.5, 2.0], inside), expected, "{n}");
    }
    // At a face's plane, but far from the face.
    assert!(!is_near([1.0, 3.0, 2.0], [2.0, 3.0, 2.0]));
    // Through the middles of faces.
    assert!(!is_near([-4.0, 0.5, 2.0], [4.0, 0.5, 2.0]));
    // Past the edge of right and top, outside.
    let past = |n: f64| is_near([0.5, 1.5 + n * ulp, 2.0], [1.5 + n * ulp, 0.5, 2.0]);
    assert!(past(0.0) && past(2.0) && !past(16.0));
    // Along a face and beyond it at both ends.
    assert!(is_near([1.0 + 3.0 * ulp, -2.0, 2.0], [1.0, 2.0, 2.0]));
    assert!(!is_near(
        [1.0 + 64.0 * ulp, -2.0, 2.0],
        [1.0 + 64.0 * ulp, 2.0, 2.0]
    ));
    assert!(!is_near([f64::NAN, 0.0, 0.0], inside));
    // Zero has the ulp of its point.
    let plane = EndRect::new(0.0, -1.0, 1.0, -1.0, 1.0);
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near: plane, far }).unwrap();
    let oracle = Oracle::new(&frustum);
    let from = |z: f64| oracle.is_near(&Segment::new([0.5, 0.5, z], inside));
    assert!(from(0.0) && from(5e-324) && !from(1e-15));
}
