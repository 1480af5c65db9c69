//! World points to the window and back, against rational arithmetic.

use frusta::samples::{BLOCK, Family};
use frusta::{
    Accuracy, Camera, Class, ClipSpace, EndRect, Frustum, FrustumError, NonFinite, Pose,
    Projection, Projector, Real, Rect, Segment, Shape, Vec3,
};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

const SEED: u64 = 14;
const U: f64 = f64::EPSILON / 2.0;
const WINDOW: Rect = Rect::new(0.0, 1920.0, 1080.0, 0.0);

type Q = BigRational;

fn q(x: f64) -> Q {
    Q::from_float(x).unwrap()
}

/// A point's exact distances from opposite sides, up to a factor for each pair: left, right,
/// bottom, top, near, far (1 without far), by the definition of a frustum alone.
fn distances(frustum: &Frustum, p: Vec3<f64>) -> [[Q; 2]; 3] {
    let pose = frustum.pose();
    let [x, y, z] = pose.axes.map(|axis| {
        let terms = (0..3).map(|j| q(axis[j]) * (q(p[j]) - q(pose.origin[j])));
        terms.fold(Q::zero(), |sum, t| sum + t)
    });
    let near = frustum.shape().near();
    let sigma = q(frustum.shape().direction().sign());
    let n = &sigma * (&z - q(near.z));
    let bounds = |i: usize| -> Q {
        let at = near.rect.to_array()[i];
        match frustum.shape() {
            Shape::Finite { near: e, far } => {
                let depth = &sigma * (q(far.z) - q(e.z));
                q(at) + (q(far.rect.to_array()[i]) - q(at)) * &n / depth
            }
            Shape::Infinite { slopes, .. } => q(at) + q(slopes.to_array()[i]) * &n,
        }
    };
    let f = match frustum.shape().far() {
        Some(far) => &sigma * (q(far.z) - &z),
        None => q(1.0),
    };
    [
        [&x - bounds(0), bounds(1) - &x],
        [&y - bounds(2), bounds(3) - &y],
        [n, f],
    ]
}

fn to_f64(q: &Q) -> f64 {
    q.to_f64().unwrap()
}

/// The exact image in [`WINDOW`], without depth; `None` if the point is not in front of the eye.
fn exact_image(distances: &[[Q; 2]; 3]) -> Option<[Q; 2]> {
    let at = |[a, b]: &[Q; 2], low: f64, high: f64| {
        let sum = a + b;
        sum.is_positive().then(|| (a * q(high) + b * q(low)) / sum)
    };
    Some([
        at(&distances[0], WINDOW.left, WINDOW.right)?,
        at(&distances[1], WINDOW.bottom, WINDOW.top)?,
    ])
}

/// The scale of an axis in the stated bound, and the stated bound itself as a fraction of the window.
fn stated_bound(frustum: &Frustum, p: Vec3<f64>, axis: usize, width: f64) -> f64 {
    let shape = frustum.shape();
    let near = shape.near();
    let (n, i) = (near.rect.to_array(), 2 * axis);
    let slope = |i: usize| match shape {
        Shape::Finite { far, .. } => (far.rect.to_array()[i] - n[i]) / (far.z - near.z),
        Shape::Infinite { slopes, .. } => slopes.to_array()[i],
    };
    let m = slope(i).abs().max(slope(i + 1).abs());
    let pose = frustum.pose();
    let size: f64 = (0..3).map(|j| (p[j] - pose.origin[j]).abs()).sum();
    let largest = |v: Vec3<f64>| v.to_array().map(f64::abs).into_iter().fold(0.0, f64::max);
    let s = n[i].abs().max(n[i + 1].abs())
        + m * near.z.abs()
        + (largest(pose.axes[axis]) + m * largest(pose.axes[2])) * size;
    (10.0 * s / width + 5.0) * U
}

/// Whether a point outside of the frustum is in the eye's plane, up to rounding.
fn is_at_the_eye(frustum: &Frustum, p: Vec3<f64>, distances: &[[Q; 2]; 3]) -> bool {
    let is_outside = distances.iter().flatten().any(|d| d.is_negative());
    is_outside
        && (0..2).any(|axis| {
            let [a, b] = &distances[axis];
            let width = to_f64(&(a + b).abs());
            stated_bound(frustum, p, axis, width) > 0.1
        })
}

fn projector(frustum: &Frustum) -> Projector {
    Projector::new(frustum).onto(WINDOW).unwrap()
}

/// Cases of all families.
fn cases<T: Real>(blocks: u64, mut see: impl FnMut(&Frustum, &Projector, Segment<T>)) {
    for &family in Family::ALL {
        for block in 0..blocks {
            let scene = family.scene(SEED, block);
            let projector = projector(scene.frustum());
            for index in block * BLOCK..(block + 1) * BLOCK {
                let segment = family.segment::<T>(&scene, SEED, index);
                see(scene.frustum(), &projector, segment);
            }
        }
    }
}

/// Every family's points, most of them within 4 ulp of a face, an edge or a vertex: signs exact,
/// coordinates within the stated bound.
#[test]
fn images_are_within_the_bound_and_on_the_right_side() {
    let (mut inside, mut on_a_side, mut behind, mut largest) = (0, 0, 0, 0.0_f64);
    cases::<f64>(6, |frustum, projector, segment| {
        for p in [segment.start, segment.end] {
            let distances = distances(frustum, p);
            let image = projector.project(p).unwrap();
            let Some(exact) = exact_image(&distances) else {
                assert!(
                    image.is_none() || is_at_the_eye(frustum, p, &distances),
                    "{p:?} {frustum:?}"
                );
                behind += 1;
                continue;
            };
            let Some(image) = image else {
                assert!(
                    is_at_the_eye(frustum, p, &distances),
                    "{p:?} {frustum:?} {exact:?}"
                );
                continue;
            };
            for (axis, [low, high]) in distances.iter().enumerate().take(2) {
                let (from, to, length) = [(0.0, 1920.0, 1920.0), (1080.0, 0.0, 1080.0)][axis];
                let (a, b) = (low.is_negative(), high.is_negative());
                let x = image[axis];
                let window = f64::min(from, to)..=f64::max(from, to);
                if !a && !b {
                    assert!(window.contains(&x), "{x} of {p:?} {frustum:?}");
                    inside += 1;
                }
                if low.is_zero() || high.is_zero() {
                    assert_eq!(
                        x,
                        if low.is_zero() { from } else { to },
                        "{p:?} {frustum:?}"
                    );
                    on_a_side += 1;
                }
                let width = to_f64(&(low + high));
                let off = to_f64(&(q(x) - &exact[axis]).abs()) / length;
                // Window widths from the middle.
                let away = (to_f64(&exact[axis]) / length - 0.5).abs();
                let bound = stated_bound(frustum, p, axis, width) * (1.0 + 2.0 * away);
                assert!(off <= bound, "{off:e} > {bound:e}: {p:?} {frustum:?}");
                largest = largest.max(off / bound);
            }
        }
    });
    assert!(
        inside > 3_000 && on_a_side > 400 && behind > 400,
        "{inside} {on_a_side} {behind}"
    );
    // The bound is not idle.
    assert!(largest > 0.02, "{largest}");
}

/// A camera's frustum with edges of a million points.
fn camera(near: f64, far: f64) -> Camera {
    Camera {
        eye: [3.0, -2.0, 7.5].into(),
        target: [0.3, 0.1, -0.2].into(),
        up: [0.1, 1.0, 0.05].into(),
        projection: Projection::Perspective {
            fovy: 0.9,
            aspect: 1.6,
        },
        near,
        far,
    }
}

struct Ends {
    clipped: u64,
    whole: u64,
    /// Ends of `Fast` parts outside of the window, and the largest distance as a part of the bound.
    outside: u64,
    largest: f64,
}

/// Clips and projects; by how much an end may leave the window is the caller's.
fn project_ends<T: Real>(
    frustum: &Frustum,
    segments: &[Segment<T>],
    accuracy: Accuracy,
    ends: &mut Ends,
) {
    let projector = projector(frustum).depth(ClipSpace::ZERO_TO_ONE.reversed());
    let mut clips = Vec::new();
    frustum
        .clip_segments(segments, accuracy, &mut clips)
        .unwrap();
    for (clip, segment) in clips.iter().zip(segments) {
        let Some(part) = clip.part else { continue };
        for end in [part.entry, part.exit] {
            if accuracy == Accuracy::Inward && !end.inward {
                continue;
            }
            let image = projector.project(end.point).unwrap();
            let image = image.expect("a point of the frustum").to_f64();
            if accuracy == Accuracy::Inward {
                let is_in = (0.0..=1920.0).contains(&image.x)
                    && (0.0..=1080.0).contains(&image.y)
                    && (0.0..=1.0).contains(&image.z);
                assert!(is_in, "{image:?} of {end:?}, {segment:?}, {frustum:?}");
            } else {
                check_fast_end(
                    frustum,
                    segment.to_f64(),
                    end.point.to_f64(),
                    image,
                    T::UNIT_ROUNDOFF,
                    ends,
                );
            }
            if end.clipped {
                ends.clipped += 1;
            } else {
                ends.whole += 1;
            }
        }
    }
}

/// A `Fast` point is within 8 u M of the exact one in each coordinate, M the segment's largest one.
fn check_fast_end(
    frustum: &Frustum,
    segment: Segment<f64>,
    p: Vec3<f64>,
    image: Vec3<f64>,
    u: f64,
    ends: &mut Ends,
) {
    let largest = |v: Vec3<f64>| v.to_array().map(f64::abs).into_iter().fold(0.0, f64::max);
    let step = 8.0 * u * largest(segment.start).max(largest(segment.end));
    let pose = frustum.pose();
    let length = |v: Vec3<f64>| v.to_array().map(f64::abs).into_iter().sum::<f64>();
    let exact = distances(frustum, p);
    for (axis, length_of_window) in [(0, 1920.0), (1, 1080.0)] {
        let width = to_f64(&(&exact[axis][0] + &exact[axis][1]));
        let shape = frustum.shape();
        let slope = (0..2)
            .map(|k| match shape {
                Shape::Finite { near, far } => {
                    let i = 2 * axis + k;
                    (far.rect.to_array()[i] - near.rect.to_array()[i]) / (far.z - near.z)
                }
                Shape::Infinite { slopes, .. } => slopes.to_array()[2 * axis + k],
            })
            .fold(0.0, |m: f64, s| m.max(s.abs()));
        let normal = length(pose.axes[axis]) + slope * length(pose.axes[2]);
        let bound = step * normal / width + stated_bound(frustum, p, axis, width) + 2.0 * u;
        let x = image[axis] / length_of_window;
        let outside = (-x).max(x - 1.0);
        assert!(
            outside <= bound,
            "{outside:e} > {bound:e} {p:?} {frustum:?}"
        );
        if outside > 0.0 {
            ends.outside += 1;
            ends.largest = ends.largest.max(outside / bound);
        }
    }
}

fn edges<T: Real>(count: usize) -> Vec<Segment<T>> {
    let mut random = frusta::samples::Random::new(&[SEED]);
    let mut point = || {
        Vec3::from(std::array::from_fn(|_| {
            T::from_f64(random.between(-9.0, 9.0))
        }))
    };
    (0..count).map(|_| Segment::new(point(), point())).collect()
}

#[test]
fn a_million_inward_ends_stay_in_the_window() {
    let mut ends = Ends {
        clipped: 0,
        whole: 0,
        outside: 0,
        largest: 0.0,
    };
    for (near, far) in [(0.5, 12.0), (0.01, f64::INFINITY), (2.0, 8.0)] {
        let frustum = camera(near, far).frustum().unwrap();
        project_ends(
            &frustum,
            &edges::<f64>(400_000),
            Accuracy::Inward,
            &mut ends,
        );
        project_ends(
            &frustum,
            &edges::<f32>(400_000),
            Accuracy::Inward,
            &mut ends,
        );
    }
    assert!(ends.clipped > 1_000_000, "{} {}", ends.clipped, ends.whole);
}

#[test]
fn fast_ends_leave_the_window_by_no_more_than_the_bound() {
    let mut ends = Ends {
        clipped: 0,
        whole: 0,
        outside: 0,
        largest: 0.0,
    };
    for (near, far) in [(0.5, 12.0), (0.01, f64::INFINITY)] {
        let frustum = camera(near, far).frustum().unwrap();
        project_ends(&frustum, &edges::<f64>(10_000), Accuracy::Fast, &mut ends);
        project_ends(&frustum, &edges::<f32>(10_000), Accuracy::Fast, &mut ends);
    }
    assert!(
        ends.clipped > 10_000 && ends.outside > 1_000,
        "{} {}",
        ends.clipped,
        ends.outside
    );
    assert!(ends.largest > 0.01, "{}", ends.largest);
}

/// Hard cases of every family, most of them singular.
#[test]
fn inward_ends_of_hard_cases_stay_in_the_window() {
    let mut seen = 0;
    fn see<T: Real>(frustum: &Frustum, projector: &Projector, segment: Segment<T>, seen: &mut u64) {
        let clip = frustum
            .clip_segment_with(&segment, Accuracy::Inward)
            .unwrap();
        let Some(part) = clip.part else { return };
        for end in [part.entry, part.exit] {
            if !end.inward {
                continue;
            }
            // At an apex there is no place; its depth is 0.
            let Some(image) = projector.project(end.point).unwrap() else {
                continue;
            };
            let [x, y, z] = image.to_f64().to_array();
            let is_in = (0.0..=1920.0).contains(&x)
                && (0.0..=1080.0).contains(&y)
                && (0.0..=1.0).contains(&z);
            assert!(is_in, "{image:?} {end:?} {frustum:?}");
            *seen += 1;
        }
    }
    cases::<f64>(12, |f, p, s| see(f, p, s, &mut seen));
    cases::<f32>(12, |f, p, s| see(f, p, s, &mut seen));
    assert!(seen > 10_000, "{seen}");
}

/// Depth by its definition, from the exact distances of near, far and the point from the eye.
#[test]
fn depths_are_those_of_the_conventions() {
    let mut random = frusta::samples::Random::new(&[SEED, 1]);
    let mut seen = 0;
    for _ in 0..200 {
        let near = random.power_of_ten(-3, 1);
        let far = if random.one_in(3) {
            f64::INFINITY
        } else {
            near * random.between(1.1, 1e5)
        };
        let camera = camera(near, far);
        let frustum = camera.frustum().unwrap();
        let [base, reversed, gl] = [
            ClipSpace::ZERO_TO_ONE,
            ClipSpace::ZERO_TO_ONE.reversed(),
            ClipSpace::OPENGL,
        ]
        .map(|clip| Projector::new(&frustum).depth(clip));
        for _ in 0..20 {
            let depth = near * random.power_of_ten(0, 4) * random.between(0.5, 1.0);
            let p = base.ray(random.unit(), random.unit()).unwrap();
            let start = p.origin - camera.eye;
            let p = camera.eye + start * (depth / near);
            let exact = distances(&frustum, p);
            let w = &exact[2][0] + q(near);
            let (n, w64) = (q(near), to_f64(&w));
            let (zero_to_one, rev) = if far.is_finite() {
                let (f, d) = (q(far), q(far) - q(near));
                (&exact[2][0] * &f / (&w * &d), &exact[2][1] * &n / (&w * &d))
            } else {
                (&exact[2][0] / &w, &n / &w)
            };
            let factor = if far.is_finite() {
                far / (far - near)
            } else {
                1.0
            };
            let far_z = if far.is_finite() { far } else { 0.0 };
            let s = near + far_z + 2.0 * w64 * 3.0;
            let bound = 10.0 * U * s * near * factor / (w64 * w64) + 5.0 * U;
            let z = |projector: &Projector| projector.project(p).unwrap().unwrap().z;
            let off = [
                z(&base) - to_f64(&zero_to_one),
                z(&reversed) - to_f64(&rev),
                0.5 * (z(&gl) + 1.0) - to_f64(&zero_to_one),
            ];
            assert!(
                off.iter().all(|o| o.abs() <= bound),
                "{off:?} {bound:e} at {w64} of {near}..{far}"
            );
            // Far away the reversed depth keeps its digits.
            if far.is_infinite() {
                let relative = (z(&reversed) / to_f64(&rev) - 1.0).abs();
                assert!(relative < 40.0 * U, "{relative:e}");
            }
            seen += 1;
        }
    }
    assert_eq!(seen, 4_000);
}

#[test]
fn back_and_forth() {
    let mut random = frusta::samples::Random::new(&[SEED, 2]);
    let mut seen = 0;
    for far in [30.0, f64::INFINITY] {
        for projection in [
            Projection::Perspective {
                fovy: 1.1,
                aspect: 1.5,
            },
            Projection::Orthographic {
                height: 5.0,
                aspect: 1.5,
            },
            Projection::OffAxis {
                rect: Rect::new(-0.2, 0.9, 0.1, 0.5),
            },
        ] {
            let camera = Camera {
                projection,
                ..camera(0.5, far)
            };
            let frustum = camera.frustum().unwrap();
            for clip in [ClipSpace::ZERO_TO_ONE, ClipSpace::OPENGL.reversed()] {
                let screen = projector(&frustum).depth(clip);
                for _ in 0..500 {
                    let (x, y) = (
                        random.between(-100.0, 2020.0),
                        random.between(-50.0, 1130.0),
                    );
                    let ray = screen.ray(x, y).unwrap();
                    for t in [0.0, 0.3, 1.0, 7.0] {
                        let image = screen.project(ray.at(t)).unwrap().unwrap();
                        let off = (image.x - x).abs().max((image.y - y).abs());
                        assert!(off < 1e-10, "{off:e} {x} {y} {camera:?}");
                        let back = screen.point(image.x, image.y, image.z);
                        if let Projection::Orthographic { .. } = projection
                            && far.is_infinite()
                        {
                            continue;
                        }
                        let back = back.unwrap();
                        let d = back - ray.at(t);
                        let off = d.dot(d).sqrt();
                        assert!(off < 1e-9, "{off:e} {image:?} {camera:?}");
                        seen += 1;
                    }
                }
            }
        }
    }
    assert_eq!(seen, 5 * 2 * 500 * 4);
}

fn square(z: f64, half: f64) -> EndRect {
    EndRect::new(z, -half, half, -half, half)
}

/// Mirrored, transposed and scaled by powers of two the images are the same, bit for bit.
#[test]
fn symmetries_are_exact() {
    let shape = |k: f64| Shape::Finite {
        near: EndRect::new(1.0 * k, -0.3 * k, 0.7 * k, -0.1 * k, 0.4 * k),
        far: EndRect::new(3.3 * k, -1.3 * k, 2.7 * k, -0.5 * k, 1.9 * k),
    };
    let unit = Rect::new(-1.0, 1.0, -1.0, 1.0);
    let project = |pose: Pose, shape: Shape, p: Vec3<f64>| {
        let frustum = Frustum::new(pose, shape).unwrap();
        Projector::new(&frustum)
            .onto(unit)
            .unwrap()
            .project(p)
            .unwrap()
            .unwrap()
    };
    let mut random = frusta::samples::Random::new(&[SEED, 3]);
    let mut pose = Pose::new(
        [0.3, -0.2, 0.1].into(),
        [
            [0.8, 0.1, 0.3].into(),
            [-0.2, 0.9, 0.1].into(),
            [-0.3, -0.1, 0.7].into(),
        ],
    );
    for _ in 0..2_000 {
        let p = Vec3::new(
            random.between(-2.0, 2.0),
            random.between(-2.0, 2.0),
            random.between(2.5, 6.0),
        );
        let image = project(pose, shape(1.0), p);
        // Scaled.
        let scaled = Pose::new(pose.origin * 1024.0, pose.axes);
        assert_eq!(project(scaled, shape(1024.0), p * 1024.0), image);
        // Mirrored in x: left and right exchanged, and the axis turned round.
        let Shape::Finite { near, far } = shape(1.0) else {
            unreachable!()
        };
        let flip =
            |e: EndRect| EndRect::new(e.z, -e.rect.right, -e.rect.left, e.rect.bottom, e.rect.top);
        let mirrored = Shape::Finite {
            near: flip(near),
            far: flip(far),
        };
        let axes = [-pose.axes[0], pose.axes[1], pose.axes[2]];
        let other = project(Pose::new(pose.origin, axes), mirrored, p);
        assert_eq!(other, Vec3::new(-image.x, image.y, image.z));
        // x and y exchanged.
        let swap =
            |e: EndRect| EndRect::new(e.z, e.rect.bottom, e.rect.top, e.rect.left, e.rect.right);
        let swapped = Shape::Finite {
            near: swap(near),
            far: swap(far),
        };
        let axes = [pose.axes[1], pose.axes[0], pose.axes[2]];
        let other = project(Pose::new(pose.origin, axes), swapped, p);
        assert_eq!(other, Vec3::new(image.y, image.x, image.z));
        pose.origin.x = random.between(-0.5, 0.5);
    }
}

/// Numbers out of the filter's range: exact values, quotients rounded once.
#[test]
fn numbers_of_any_size() {
    for k in [1e-300, 1e-200, 1e160, 1e300] {
        let shape = Shape::Finite {
            near: square(1.0 * k, 0.1 * k),
            far: square(4.0 * k, 0.4 * k),
        };
        let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
        let screen = projector(&frustum);
        let mut random = frusta::samples::Random::new(&[SEED, 4]);
        for _ in 0..300 {
            let at = |r: &mut frusta::samples::Random| r.between(-0.5, 0.5) * k;
            let p = Vec3::new(
                at(&mut random),
                at(&mut random),
                random.between(0.8, 4.2) * k,
            );
            let exact = exact_image(&distances(&frustum, p)).unwrap();
            let image = screen.project(p).unwrap().unwrap();
            for (axis, length) in [(0, 1920.0), (1, 1080.0)] {
                let off = to_f64(&(q(image[axis]) - &exact[axis]).abs());
                assert!(off <= 30.0 * U * length, "{off:e} {p:?}");
            }
        }
        // A vertex, and the next number beyond it.
        let vertex = Vec3::new(0.4 * k, 0.4 * k, 4.0 * k);
        assert_eq!(
            screen.project(vertex).unwrap(),
            Some(Vec3::new(1920.0, 0.0, 1.0))
        );
        let beyond = Vec3::new((0.4 * k).next_up(), 0.4 * k, 4.0 * k);
        assert!(screen.project(beyond).unwrap().unwrap().x >= 1920.0);
    }
}

#[test]
fn what_cannot_be_projected() {
    let frustum = camera(1.0, 10.0).frustum().unwrap();
    let screen = Projector::new(&frustum).pixels(100, 50);
    assert_eq!(screen.frustum(), &frustum);
    // Behind the eye.
    let eye = camera(1.0, 10.0).eye;
    for behind in [1e-9, 0.1, 5.0] {
        let p = eye + Vec3::new(0.0, 0.0, behind);
        assert_eq!(screen.project(p).unwrap(), None);
    }
    let found: NonFinite = screen.project([0.0, f64::NAN, 0.0]).unwrap_err();
    assert!(found.to_string().contains('y'), "{found}");

    let mut images = vec![None; 3];
    let points = [[0.0_f32; 3], [0.0, 0.0, f32::INFINITY]];
    let error = screen.project_points(&points, &mut images).unwrap_err();
    assert!(error.to_string().starts_with("point 1: "), "{error}");
    assert!(images.is_empty());

    for x in [f64::NAN, f64::INFINITY] {
        assert_eq!(screen.ray(x, 0.0), None);
        assert_eq!(screen.point(0.0, x, 0.5), None);
        assert_eq!(screen.point(0.0, 0.0, x), None);
    }
    let infinite = Projector::new(&camera(1.0, f64::INFINITY).frustum().unwrap());
    assert_eq!(infinite.point(0.5, 0.5, 1.0), None);
    assert_eq!(infinite.point(0.5, 0.5, 1.5), None);
    assert!(infinite.point(0.5, 0.5, 0.999).is_some());

    let onto = |rect| Projector::new(&frustum).onto(rect).unwrap_err();
    assert!(matches!(
        onto(Rect::new(0.0, f64::NAN, 0.0, 1.0)),
        FrustumError::NonFinite { .. }
    ));
    assert!(matches!(
        onto(Rect::new(2.0, 2.0, 0.0, 1.0)),
        FrustumError::Flat { .. }
    ));
    assert!(matches!(
        onto(Rect::new(-1e308, 1e308, 0.0, 1.0)),
        FrustumError::Overflow { .. }
    ));
}

/// Slices, single calls and both types agree: the image of an `f32` point is that of the same `f64`
/// point, rounded.
#[test]
fn slices_and_types_agree() {
    let frustum = camera(0.5, f64::INFINITY).frustum().unwrap();
    let screen = Projector::new(&frustum).pixels(1920, 1080);
    let points: Vec<Vec3<f32>> = edges::<f32>(2_000).iter().map(|s| s.start).collect();
    let mut images = Vec::new();
    screen.project_points(&points, &mut images).unwrap();
    assert_eq!(images.len(), points.len());
    assert!(images.iter().filter(|i| i.is_some()).count() > 500);
    let behind = images.iter().filter(|i| i.is_none()).count();
    assert!(behind > 50, "{behind}");
    for (&p, &image) in points.iter().zip(&images) {
        assert_eq!(screen.project(p).unwrap(), image);
        let double = screen.project(p.to_f64()).unwrap();
        assert_eq!(
            image,
            double.map(|d| Vec3::from(d.to_array().map(|x| x as f32)))
        );
        let in_window = image.is_some_and(|i| {
            (0.0..=1920.0).contains(&i.x) && (0.0..=1080.0).contains(&i.y) && i.z >= 0.0
        });
        let class = frustum.clip_segment(&Segment::new(p, p)).unwrap().class;
        assert_eq!(in_window, class != Class::Outside, "{p:?}");
    }
}

#[test]
fn a_rectangle_of_the_window_is_seen_through_its_frustum() {
    let frustum = camera(0.1, 100.0).frustum().unwrap();
    let screen = Projector::new(&frustum).pixels(1200, 800);
    assert_eq!(screen.window([0.0, 0.0], [1200.0, 800.0]).unwrap(), frustum);
    let corners = [[150.0, 100.0], [450.0, 700.0]];
    let band = screen.window(corners[0], corners[1]).unwrap();
    for [a, b] in [[1, 0], [0, 1]].map(|order| order.map(|k: usize| corners[k])) {
        assert_eq!(screen.window(a, b).unwrap(), band);
        assert_eq!(screen.window([a[0], b[1]], [b[0], a[1]]).unwrap(), band);
    }
    assert_eq!(
        band,
        frustum
            .window(Rect::new(0.125, 0.375, 0.125, 0.875))
            .unwrap()
    );
    // Side by side, they share a side.
    let below = screen.window([150.0, 700.0], [450.0, 701.5]).unwrap();
    assert_eq!(
        below.shape().near().rect.top,
        band.shape().near().rect.bottom
    );
    // What is seen in the rectangle is in its frustum, and nothing else.
    for (x, y) in [
        (151.0, 101.0),
        (449.0, 699.0),
        (149.0, 101.0),
        (300.0, 701.0),
        (300.0, 99.0),
    ] {
        let is_in = (150.0..=450.0).contains(&x) && (100.0..=700.0).contains(&y);
        let at = screen.ray(x, y).unwrap().at(0.25);
        assert_eq!(band.contains(at).unwrap(), is_in, "{x} {y}");
    }

    let flat = screen.window([5.0, 5.0], [5.0, 9.0]).unwrap_err();
    assert_eq!(
        flat,
        FrustumError::Flat {
            what: "left..right"
        }
    );
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for corners in [[[bad, 5.0], [7.0, 9.0]], [[5.0, 7.0], [9.0, bad]]] {
            let error = screen.window(corners[0], corners[1]).unwrap_err();
            assert!(matches!(error, FrustumError::NonFinite { .. }), "{error}");
        }
    }
}
