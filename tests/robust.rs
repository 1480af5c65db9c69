//! The side predicate compared with another implementation, the crate `robust`, in its
//! range; and examples for which `robust` alone is not enough.

use frusta::samples::Random;
use frusta::{Class, EndRect, Face, FaceSet, Frustum, Pose, Segment, Shape, Vec3};
use robust::{Coord, orient2d};

fn coord([z, x]: [f64; 2]) -> Coord<f64> {
    Coord { x: z, y: x }
}

/// Positive inside: the orientation of a point relative to a side of a trapezoid that
/// goes from `near` to `far`, each `[z, bound]`, with the interior below if
/// `below`.
fn side(near: [f64; 2], far: [f64; 2], point: [f64; 2], below: bool) -> f64 {
    let turn = orient2d(coord(near), coord(far), coord(point));
    // To the left of a line towards larger z is above.
    if below == (far[0] > near[0]) {
        -turn
    } else {
        turn
    }
}

/// The faces that contain a point, by `robust`; `None` if it is outside of a face.
fn faces_by_robust(near: EndRect, far: EndRect, p: Vec3<f64>) -> Option<FaceSet> {
    let (n, f) = (near.rect, far.rect);
    let sigma = (far.z - near.z).signum();
    let values = [
        (Face::Near, sigma * (p.z - near.z)),
        (Face::Far, sigma * (far.z - p.z)),
        (
            Face::Left,
            side([near.z, n.left], [far.z, f.left], [p.z, p.x], false),
        ),
        (
            Face::Right,
            side([near.z, n.right], [far.z, f.right], [p.z, p.x], true),
        ),
        (
            Face::Bottom,
            side([near.z, n.bottom], [far.z, f.bottom], [p.z, p.y], false),
        ),
        (
            Face::Top,
            side([near.z, n.top], [far.z, f.top], [p.z, p.y], true),
        ),
    ];
    let inside = values.iter().all(|&(_, v)| v >= 0.0);
    inside.then(|| {
        values
            .iter()
            .filter(|(_, v)| *v == 0.0)
            .map(|(face, _)| *face)
            .collect()
    })
}

#[test]
fn points_in_mid_range_are_where_robust_says() {
    let mut random = Random::new(&[26]);
    let (mut on, mut outside, mut inside) = (0, 0, 0);
    for _ in 0..20_000 {
        let rect = |random: &mut Random, z: f64| {
            let mut c = || random.between(0.1, 3.0);
            EndRect::new(z, -c(), c(), -c(), c())
        };
        let near = rect(&mut random, 0.3);
        let z = random.sign() * random.between(1.0, 9.0);
        let far = rect(&mut random, z);
        let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
        // Rounding puts it within about an ulp of a side, and sometimes exactly on it.
        let any = random.unit();
        let w = random.pick(&[0.0, 0.25, 0.5, any, 1.0]);
        let mix = |a: f64, b: f64| a * (1.0 - w) + b * w;
        let p = Vec3::new(
            mix(near.rect.right, far.rect.right),
            mix(near.rect.bottom, far.rect.bottom),
            mix(near.z, far.z),
        );
        let clip = frustum.clip_segment(&Segment::new(p, p)).unwrap();
        let found = clip.part.map(|part| part.entry.faces);
        assert_eq!(found, faces_by_robust(near, far, p), "{frustum:?}\n{p:?}");
        match clip.class {
            Class::Outside => outside += 1,
            Class::Touch => on += 1,
            _ => inside += 1,
        }
    }
    assert!(
        on > 1_000 && outside > 1_000 && inside > 100,
        "{on} {outside} {inside}"
    );
}

/// From `right = size` at `z = 0` down to 0 at `z = size`.
fn wedge(size: f64) -> Frustum {
    let shape = Shape::Finite {
        near: EndRect::new(0.0, -size, size, -size, size),
        far: EndRect::new(size, -size, 0.0, -size, size),
    };
    Frustum::new(Pose::IDENTITY, shape).unwrap()
}

fn class_of_point(frustum: &Frustum, p: [f64; 3]) -> Class {
    frustum.clip_segment(&Segment::new(p, p)).unwrap().class
}

/// Asserts that points inside, on and outside the wedge of this size have the right classes.
#[track_caller]
fn assert_wedge_is_decided(s: f64) {
    let frustum = wedge(s);
    assert_eq!(class_of_point(&frustum, [0.0, 0.0, 0.5 * s]), Class::Inside);
    assert_eq!(
        class_of_point(&frustum, [0.5 * s, 0.0, 0.5 * s]),
        Class::Touch
    );
    assert_eq!(class_of_point(&frustum, [s, 0.0, s]), Class::Outside);
}

/// Products underflow: a point clearly inside the side is "on" it.
#[test]
fn robust_is_wrong_at_1e_minus_200_and_this_crate_is_not() {
    let s = 1e-200;
    let (a, b) = (coord([0.0, s]), coord([s, 0.0]));
    assert_eq!(orient2d(a, b, coord([0.0, 0.0])), 0.0);
    assert_eq!(orient2d(a, b, coord([s, s])), 0.0);
    assert_wedge_is_decided(s);
}

/// Products overflow: no sign at all.
#[test]
fn robust_has_no_answer_at_1e200_and_this_crate_has() {
    let s = 1e200;
    let (a, b) = (coord([0.0, s]), coord([s, 0.0]));
    assert!(orient2d(a, b, coord([0.5 * s, 0.5 * s])).is_nan());
    assert_wedge_is_decided(s);
}
