//! Volumes whose answers are known by hand, and each query answered by another method, too.

use super::dyadic::Dyadic;
use super::frame::{Frame, Skeleton};
use super::separation::ExactBox;
use super::vector::{Vector, cross, dot, exact, exact_point, plus, times};
use super::*;
use crate::cull::{Aabb, Containment, Obb, Sphere, Volume};
use crate::frustum::{Direction, EndRect, Face};
use crate::math::Rect;
use crate::samples::{BLOCK, Family, hard_box, hard_obb, hard_sphere};

/// 90 degrees wide, from 1 to 3.
fn symmetric() -> Oracle {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    in_world(Shape::Finite { near, far })
}

/// Infinite along -z: x from 0 to 1 - z, y from 0 to 1.
fn infinite() -> Oracle {
    in_world(Shape::Infinite {
        near: EndRect::new(0.0, 0.0, 1.0, 0.0, 1.0),
        slopes: Rect::new(0.0, 1.0, 0.0, 0.0),
        direction: Direction::MinusZ,
    })
}

fn in_world(shape: Shape) -> Oracle {
    Oracle::new(&Frustum::new(Pose::IDENTITY, shape).unwrap())
}

fn faces(faces: &[Face]) -> FaceSet {
    faces.iter().copied().collect()
}

#[test]
fn boxes_that_touch() {
    let oracle = symmetric();
    let check = |min: [f64; 3], max: [f64; 3], containment, intersects| {
        let volume = Aabb::new(min, max).into();
        assert_eq!(oracle.classify(&volume), containment, "{volume:?}");
        assert_eq!(oracle.intersects(&volume), intersects, "{volume:?}");
        let oriented = Volume::from(Obb::from(Aabb::new(min, max)));
        assert_eq!(oracle.classify(&oriented), containment, "{oriented:?}");
        assert_eq!(oracle.intersects(&oriented), intersects, "{oriented:?}");
    };
    use Containment::{Crossing, Inside, Outside};
    // A face on a face, a corner on a vertex, an edge on an edge.
    check([-4.0, -4.0, 3.0], [4.0, 4.0, 4.0], Crossing, true);
    check([3.0, 3.0, 3.0], [4.0, 4.0, 4.0], Crossing, true);
    check([3.0, -0.5, 2.5], [4.0, 0.5, 4.0], Crossing, true);
    // The same, separated by the least possible distance.
    let after = 3.0_f64.next_up();
    check([-4.0, -4.0, after], [4.0, 4.0, 4.0], Outside, false);
    check([after, 3.0, 3.0], [4.0, 4.0, 4.0], Crossing, false);
    check([after, -0.5, 2.5], [4.0, 0.5, 4.0], Crossing, false);
    // Touching from inside, and just crossing.
    check([-1.0, -1.0, 1.0], [1.0, 1.0, 3.0], Inside, true);
    check(
        [-1.0, -1.0, 1.0],
        [1.0, 1.0_f64.next_up(), 3.0],
        Crossing,
        true,
    );
    // The whole frustum, a point of it, none.
    check([-9.0; 3], [9.0; 3], Crossing, true);
    check([2.0; 3], [2.0; 3], Inside, true);
    check(
        [2.0_f64.next_up(), 2.0, 2.0],
        [2.5, 2.0, 2.0],
        Outside,
        false,
    );
}

#[test]
fn faces_are_named() {
    let oracle = symmetric();
    let found = |min: [f64; 3], max: [f64; 3]| oracle.volume_faces(&Aabb::new(min, max).into());
    let empty = FaceSet::EMPTY;
    let corner = faces(&[Face::Near, Face::Left, Face::Bottom]);
    assert_eq!(found([-2.0, -2.0, 0.0], [0.0, 0.0, 2.0]), (empty, corner));
    // All of it beyond one plane, some of it beyond two others.
    let (outside, crossing) = found([4.0, -4.0, 2.0], [5.0, 0.0, 3.5]);
    assert_eq!(outside, faces(&[Face::Right]));
    assert_eq!(crossing, faces(&[Face::Far, Face::Bottom]));
    let sphere =
        |center: [f64; 3], radius: f64| oracle.volume_faces(&Sphere::new(center, radius).into());
    assert_eq!(sphere([0.0, 0.0, 2.0], 1.0), (empty, empty));
    assert_eq!(
        sphere([0.0, 0.0, 2.0], 1.0_f64.next_up()).1,
        faces(&[Face::Near, Face::Far])
    );
    assert_eq!(sphere([0.0, 0.0, 4.0], 1.0), (empty, faces(&[Face::Far])));
    assert_eq!(
        sphere([0.0, 0.0, 4.0], 1.0_f64.next_down()),
        (faces(&[Face::Far]), empty)
    );
}

#[test]
fn flat_and_dependent_boxes() {
    let oracle = symmetric();
    let check = |center: [f64; 3], half_axes: [[f64; 3]; 3], intersects| {
        let volume = Obb::new(center, half_axes).into();
        assert_eq!(oracle.intersects(&volume), intersects, "{volume:?}");
    };
    let zero = [0.0; 3];
    // A square across the vertex (3, 3, 3), on it and off it.
    let square = [[1.0, -1.0, 0.0], [1.0, 1.0, -2.0], zero];
    check([3.0; 3], square, true);
    check([3.0_f64.next_up(), 3.0, 3.0], square, false);
    // The edge between left and bottom, a line across it that meets it, and not.
    check([-2.0, -2.0, 2.0], [[1.0, -1.0, 0.0], zero, zero], true);
    check(
        [-(2.0_f64.next_down()), -2.0, 2.0],
        [[1.0, -1.0, 0.0], zero, zero],
        true,
    );
    check(
        [-(2.0_f64.next_up()), -2.0, 2.0],
        [[1.0, -1.0, 0.0], zero, zero],
        false,
    );
    // A hexagon in a plane, one of whose corners is there: three dependent half axes.
    let hexagon = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    check([5.0, 5.0, 3.0], hexagon, true);
    check([5.0_f64.next_up(), 5.0, 3.0], hexagon, false);
    // One line three times: from 6 down to 3.
    let line = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.5], [0.0, 0.0, 0.5]];
    check([0.0, 0.0, 6.0], line, true);
    check([0.0, 0.0, 6.0_f64.next_up()], line, false);
}

#[test]
fn spheres_at_faces_edges_and_vertices() {
    let oracle = symmetric();
    let check = |oracle: &Oracle, center: [f64; 3], radius: f64| {
        let meets = |r: f64| oracle.intersects(&Sphere::new(center, r).into());
        assert!(meets(radius), "{center:?} {radius}");
        assert!(!meets(radius.next_down()), "{center:?} {radius}");
    };
    check(&oracle, [1.0, 2.0, 7.0], 4.0);
    // Beyond the far end's edge at x = 3 and its vertex at (3, 3, 3).
    check(&oracle, [6.0, 1.0, 7.0], 5.0);
    check(&oracle, [5.0, 6.0, 9.0], 7.0);
    // The edge of an infinite frustum at x = y = 0, and of its near end.
    let oracle = infinite();
    check(&oracle, [-3.0, -4.0, -1e9], 5.0);
    check(&oracle, [-3.0, 0.5, 4.0], 5.0);
    check(&oracle, [-1.0, -2.0, 2.0], 3.0);
    // Axes neither of one length nor at right angles: x, x + 2 y, z / 4 from 0 to 1.
    let axes = [[1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 0.25]];
    let unit = Rect::new(0.0, 1.0, 0.0, 1.0);
    let end = |z| EndRect { z, rect: unit };
    let shape = Shape::Finite {
        near: end(0.0),
        far: end(1.0),
    };
    let pose = Pose::new([0.0; 3].into(), axes.map(Vec3::from));
    let oracle = Oracle::new(&Frustum::new(pose, shape).unwrap());
    // The vertex (1, -1/2, 4), and the edge along z there.
    check(&oracle, [3.0, -3.5, 10.0], 7.0);
    check(&oracle, [5.0, -3.5, 2.0], 5.0);
}

#[test]
fn a_pyramid_ends_at_its_apex() {
    let near = EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0);
    let far = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let oracle = in_world(Shape::Finite { near, far });
    let tip = |z: f64| Aabb::new([-1.0, -1.0, -1.0], [1.0, 1.0, z]).into();
    assert!(oracle.intersects(&tip(0.0)));
    assert_eq!(oracle.classify(&tip(0.0)), Containment::Crossing);
    assert!(!oracle.intersects(&tip(-5e-324)));
    let sphere = |r: f64| oracle.intersects(&Sphere::new([2.0, -3.0, -6.0], r).into());
    assert!(sphere(7.0) && !sphere(7.0_f64.next_down()));
}

#[test]
#[should_panic(expected = "min.y = 1 is greater than max.y = 0; the box is inverted")]
fn an_invalid_volume_panics() {
    symmetric().intersects(&Aabb::new([0.0, 1.0, 0.0], [1.0, 0.0, 1.0]).into());
}

// The same queries by other methods.

/// The solution of three linear equations times their determinant, and the determinant; `None`
/// if it is zero.
fn solve(rows: &[Vector; 3], right: &Vector) -> Option<(Vector, Dyadic)> {
    let [a, b, c] = rows;
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, &columns[0]);
    let x = (0..3).map(|k| times(&columns[k], &right[k]));
    let x = x.reduce(|sum, term| plus(&sum, &term))?;
    (!determinant.is_zero()).then_some((x, determinant))
}

/// All sets of three of these numbers.
fn triples(n: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..n).flat_map(move |i| (0..i).flat_map(move |j| (0..j).map(move |k| [i, j, k])))
}

/// Whether a box and the frustum have a point in common, by linear programming in the box's own
/// coordinates `s, t, w`: each face is a half-space there too, the box itself is a cube
/// whatever its half axes are, and their intersection has a vertex, at which three of the
/// planes meet, if it is not empty.
fn has_common_vertex(oracle: &Oracle, shape: &ExactBox) -> bool {
    let faces = oracle.half_spaces.iter().map(|plane| {
        let gradient = shape.half_axes.each_ref().map(|h| dot(&plane.normal, h));
        (gradient, plane.value_at(&shape.center))
    });
    let one = [1.0, -1.0].into_iter();
    let cube = one.flat_map(|sign| {
        [0, 1, 2].map(|k| {
            let mut gradient = [0.0; 3];
            gradient[k] = sign;
            (gradient.map(exact), exact(1.0))
        })
    });
    let planes: Vec<(Vector, Dyadic)> = faces.chain(cube).collect();
    triples(planes.len()).any(|meeting| {
        let rows = meeting.map(|i| planes[i].0.clone());
        let right = meeting.map(|i| -&planes[i].1);
        solve(&rows, &right).is_some_and(|(x, determinant)| {
            let value = |(gradient, constant): &(Vector, Dyadic)| {
                &dot(gradient, &x) + &(constant * &determinant)
            };
            let signs = planes
                .iter()
                .map(|p| value(p).signum() * determinant.signum());
            signs.into_iter().all(|s| s >= 0)
        })
    })
}

/// Whether a sphere and the frustum have a point in common, by the conditions of optimality:
/// the point of the frustum nearest to `c` is the foot of the perpendicular from `c` to the
/// intersection of some of the planes, at most three of them independent. With
/// the matrix G of their normals' inner products it is `c + sum l_i n_i`, `G l = -f(c)`.
fn has_foot_within(oracle: &Oracle, center: &Vector, square: &Dyadic) -> bool {
    let planes = &oracle.half_spaces;
    let values: Vec<Dyadic> = planes.iter().map(|h| h.value_at(center)).collect();
    let product = |i: usize, j: usize| dot(&planes[i].normal, &planes[j].normal);
    // Indices beyond the planes mean no plane.
    let n = planes.len();
    triples(n + 3).any(|set| {
        let entry = |i: usize, j: usize| match (i < n && j < n, i == j) {
            (true, _) => product(i, j),
            (false, same) => exact(if same { 1.0 } else { 0.0 }),
        };
        let value = |i: usize| values.get(i).cloned().unwrap_or_else(Dyadic::zero);
        let gram = set.map(|i| set.map(|j| entry(i, j)));
        let right = set.map(|i| -&value(i));
        solve(&gram, &right).is_some_and(|(l, determinant)| {
            let at_foot = |j: usize| {
                let products = set.map(|i| if i < n { product(i, j) } else { Dyadic::zero() });
                &(&values[j] * &determinant) + &dot(&l, &products)
            };
            // A Gram determinant is not negative.
            dot(&l, &right) <= square * &determinant && (0..n).all(|j| !at_foot(j).is_negative())
        })
    })
}

/// The faces of a box's answer, by its corners.
fn faces_by_corners(oracle: &Oracle, shape: &ExactBox) -> (FaceSet, FaceSet) {
    let corners = (0..8).map(|i| {
        let half_axes = shape.half_axes.iter().enumerate();
        half_axes.fold(shape.center.clone(), |corner, (k, h)| {
            let sign = exact(if i >> k & 1 == 0 { 1.0 } else { -1.0 });
            plus(&corner, &times(h, &sign))
        })
    });
    let corners: Vec<Vector> = corners.collect();
    let (mut outside, mut crossing) = (FaceSet::EMPTY, FaceSet::EMPTY);
    for plane in &oracle.half_spaces {
        let beyond = corners
            .iter()
            .filter(|c| plane.value_at(c).is_negative())
            .count();
        match beyond {
            0 => {}
            8 => outside.insert(plane.face),
            _ => crossing.insert(plane.face),
        }
    }
    (outside, crossing)
}

fn exact_box(v: &Obb<f64>) -> ExactBox {
    ExactBox {
        center: exact_point(v.center),
        half_axes: v.half_axes.map(exact_point),
    }
}

/// The box between the corners, from its own definition.
fn exact_aabb(v: &Aabb<f64>) -> ExactBox {
    let half = exact(0.5);
    let [a, b] = [v.min, v.max].map(|p| times(&exact_point(p), &half));
    let zero = Dyadic::zero;
    let extent = |k: usize| &b[k] - &a[k];
    ExactBox {
        center: plus(&a, &b),
        half_axes: [
            [extent(0), zero(), zero()],
            [zero(), extent(1), zero()],
            [zero(), zero(), extent(2)],
        ],
    }
}

/// Numbers of volumes that met the frustum, missed it, and missed it though no face's plane
/// separates them.
#[derive(Debug, Default)]
struct Seen {
    met: u32,
    missed: u32,
    missed_by_edges: u32,
}

impl Seen {
    fn check_box(&mut self, oracle: &Oracle, volume: Volume, shape: &ExactBox) {
        let faces = oracle.volume_faces(&volume);
        assert_eq!(
            faces,
            faces_by_corners(oracle, shape),
            "{volume:?} {oracle:?}"
        );
        self.check(oracle, volume, has_common_vertex(oracle, shape));
    }

    fn check_sphere(&mut self, oracle: &Oracle, v: Sphere<f64>) {
        let radius = exact(v.radius);
        let meets = has_foot_within(oracle, &exact_point(v.center), &(&radius * &radius));
        self.check(oracle, v.into(), meets);
    }

    fn check(&mut self, oracle: &Oracle, volume: Volume, meets: bool) {
        assert_eq!(oracle.intersects(&volume), meets, "{volume:?} {oracle:?}");
        match (meets, oracle.classify(&volume)) {
            (true, _) => self.met += 1,
            (false, Containment::Outside) => self.missed += 1,
            (false, _) => self.missed_by_edges += 1,
        }
    }

    fn assert_each(&self, least: u32) {
        let counts = [self.met, self.missed, self.missed_by_edges];
        assert!(counts.into_iter().all(|n| n >= least), "{self:?}");
    }
}

/// Whether a segment between two corners of a box and the frustum have a point in common.
fn meets_an_edge(oracle: &Oracle, v: &Aabb<f64>) -> bool {
    let corner = |i: usize| Vec3::from([0, 1, 2].map(|k| [v.min, v.max][i >> k & 1][k]));
    let mut pairs = (0..8).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.any(|(i, j)| {
        let clip = oracle.clip(&Segment::new(corner(i), corner(j))).unwrap();
        clip.class != Class::Outside
    })
}

#[test]
fn agrees_with_other_methods_on_hard_volumes() {
    let [mut boxes, mut oriented, mut spheres] = [(); 3].map(|()| Seen::default());
    for &family in Family::ALL {
        for block in 0..6 {
            let scene = family.scene(3, block);
            let oracle = Oracle::new(scene.frustum());
            for number in block * BLOCK..block * BLOCK + 8 {
                let v = hard_box(&scene, 3, number);
                boxes.check_box(&oracle, v.into(), &exact_aabb(&v));
                assert!(oracle.intersects(&v.into()) || !meets_an_edge(&oracle, &v));
                let v = hard_obb(&scene, 3, number);
                oriented.check_box(&oracle, v.into(), &exact_box(&v));
                spheres.check_sphere(&oracle, hard_sphere(&scene, 3, number));
            }
        }
    }
    boxes.assert_each(200);
    oriented.assert_each(150);
    spheres.assert_each(150);
}

#[test]
fn corners_are_where_three_faces_meet() {
    for &family in Family::ALL {
        for block in 0..8 {
            let scene = family.scene(4, block);
            let oracle = Oracle::new(scene.frustum());
            let skeleton = Skeleton::new(&Frame::new(&oracle.pose, &oracle.shape));
            let is_infinite = oracle.half_spaces.len() == 5;
            assert_eq!(skeleton.corners.len(), if is_infinite { 4 } else { 8 });
            for (i, corner) in skeleton.corners.iter().enumerate() {
                let meeting = [
                    [Face::Left, Face::Right][i & 1],
                    [Face::Bottom, Face::Top][i >> 1 & 1],
                    [Face::Near, Face::Far][i >> 2],
                ];
                for plane in &oracle.half_spaces {
                    let offset = plane.value_at(&exact_point(Vec3::default()));
                    let value = &dot(&plane.normal, corner) + &(&offset * &skeleton.determinant);
                    let inward = value.signum() * skeleton.determinant.signum();
                    let is_on = meeting.contains(&plane.face);
                    assert!(
                        inward >= 0 && (inward == 0 || !is_on),
                        "{family} {block} {i}"
                    );
                }
            }
        }
    }
}
