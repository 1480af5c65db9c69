//! Bounds that are not finite boxes: empty ones, infinite ones, invalid ones; oriented ones; and exact answers of queries.
//! Each in every form of a query.

use frusta::cull::{
    BoxArrays, BoxSet, ContainmentMasks, RelativeBoxes, SphereArrays, VolumeQuery, VolumeSource,
};
use frusta::oracle::Oracle;
use frusta::samples::{BLOCK, Family, Random, hard_box, hard_obb, hard_sphere};
use frusta::{
    Aabb, Camera, Containment, Culler, EndRect, FaceSet, Frustum, Obb, Pose, Projection, Real,
    Shape, Sphere, Vec3, Volume, VolumeCounts, VolumeError,
};

const INF: f64 = f64::INFINITY;
const COUNT: usize = 100_000;

fn culler() -> Culler {
    let projection = Projection::Perspective {
        fovy: 1.0,
        aspect: 1.5,
    };
    let (eye, target, up) = ([3.0, -2.0, 9.0], [0.5, 0.0, 0.0], [0.1, 1.0, 0.0]);
    let camera = Camera::new(eye, target, up, projection, 0.1, 40.0);
    Culler::new(&camera.frustum().unwrap())
}

/// Boxes around the frustum.
fn boxes<T: Real>() -> Vec<Aabb<T>> {
    let mut random = Random::new(&[14]);
    let mut point =
        |reach: f64| Vec3::from([(); 3].map(|()| T::from_f64(random.between(-reach, reach))));
    let around = |_| {
        let (center, half) = (point(30.0), point(1.0));
        Aabb::around([center - half, center + half]).unwrap()
    };
    (0..COUNT).map(around).collect()
}

/// All outputs of a query, with its counts; the index of the error where it fails.
fn ask<'q, S: VolumeSource>(
    query: impl Fn() -> VolumeQuery<'q, S>,
) -> Result<(Vec<Containment>, VolumeCounts), usize> {
    let (mut list, mut classes) = (vec![7; 3], vec![Containment::Inside; 3]);
    let (mut masks, mut counts) = (ContainmentMasks::default(), VolumeCounts::default());
    let done = [
        query().visible(&mut list),
        query().masks(&mut masks),
        query().classes(&mut classes),
    ];
    if let Err(error) = done[0] {
        // NaN in an error is not equal to itself.
        let indices = done.map(|done| done.map_err(|error| error.index));
        assert_eq!(indices, [Err(error.index); 3]);
        assert!(list.is_empty() && masks.is_empty() && classes.is_empty());
        return Err(error.index);
    }
    assert_eq!(done, [Ok(()); 3]);
    let visible = |(i, c): (usize, &Containment)| (*c != Containment::Outside).then_some(i as u32);
    assert!(
        list.iter()
            .copied()
            .eq(classes.iter().enumerate().filter_map(visible))
    );
    assert!((0..classes.len()).all(|i| masks.get(i) == Some(classes[i])));
    let mut again = Vec::new();
    query().counted(&mut counts).classes(&mut again).unwrap();
    assert!(again == classes);
    Ok((classes, counts))
}

/// A query in all its forms gives these classes, where `None` is invalid.
fn check<S: VolumeSource + Copy + Sync>(
    culler: &Culler,
    source: S,
    expected: &[Option<Containment>],
    is_exact: bool,
) {
    let plain = || {
        let query = culler.over(source);
        if is_exact { query.exact() } else { query }
    };
    let first_invalid = expected.iter().position(Option::is_none);
    let invalid = expected.iter().filter(|class| class.is_none()).count() as u64;
    let kept: Vec<_> = expected
        .iter()
        .map(|c| c.unwrap_or(Containment::Crossing))
        .collect();
    let check_one = |strict: Result<(Vec<Containment>, _), usize>, lenient: Result<_, usize>| {
        match first_invalid {
            Some(index) => assert_eq!(strict.map(|_| ()), Err(index)),
            None => assert!(strict.unwrap().0 == kept),
        }
        let (classes, counts): (Vec<_>, VolumeCounts) = lenient.unwrap();
        assert!(classes == kept);
        assert_eq!(counts.invalid, invalid);
    };
    check_one(ask(plain), ask(|| plain().keep_invalid()));
    #[cfg(feature = "parallel")]
    check_one(
        ask(|| plain().parallel()),
        ask(|| plain().parallel().keep_invalid()),
    );
}

/// The classes of volumes one by one.
fn one_by_one<V: Copy + Into<Volume>>(
    culler: &Culler,
    all: &[V],
    is_exact: bool,
) -> Vec<Option<Containment>> {
    let classify = |v: &V| {
        if is_exact {
            culler.classify_exact(*v).ok()
        } else {
            culler.classify(*v).ok()
        }
    };
    all.iter().map(classify).collect()
}

fn columns<V, T: Copy, const K: usize>(all: &[V], of: impl Fn(&V) -> [T; K]) -> [Vec<T>; K] {
    std::array::from_fn(|k| all.iter().map(|v| of(v)[k]).collect())
}

/// Boxes in every layout, by planes and exactly.
fn check_boxes<T: Real>(culler: &Culler, boxes: &Vec<Aabb<T>>) {
    let corners = columns(boxes, |b| {
        let [[a, b, c], [d, e, f]] = [b.min.to_array(), b.max.to_array()];
        [a, b, c, d, e, f]
    });
    let [a, b, c, d, e, f] = corners.each_ref().map(Vec::as_slice);
    let (min, max) = ([a, b, c], [d, e, f]);
    let valid: Vec<_> = boxes
        .iter()
        .copied()
        .filter(|b| b.check().is_ok())
        .collect();
    let set = BoxSet::new(boxes.iter().copied());
    let first_invalid = boxes.iter().position(|b| b.check().is_err());
    assert_eq!(set.err().map(|error| error.index), first_invalid);
    let set = BoxSet::new(valid.iter().copied()).unwrap();
    let doubles: Vec<_> = valid.iter().map(|b| b.to_f64()).collect();
    let relative = RelativeBoxes::new([1.0, 2.0, 3.0], &doubles).unwrap();
    for is_exact in [false, true] {
        let expected = one_by_one(culler, boxes, is_exact);
        check(culler, boxes, &expected, is_exact);
        check(culler, &boxes[..], &expected, is_exact);
        check(culler, BoxArrays { min, max }, &expected, is_exact);
        let expected = one_by_one(culler, &valid, is_exact);
        check(culler, &set, &expected, is_exact);
        check(culler, &relative, &expected, is_exact);
    }
}

#[test]
fn one_of_each_kind_among_a_hundred_thousand() {
    fn check<T: Real>() {
        let culler = culler();
        let mut boxes = boxes::<T>();
        let everyday = one_by_one(&culler, &boxes, false);
        let (inf, zero) = (T::INFINITY, T::ZERO);
        let bad = [(70_001, T::from_f64(f64::NAN)), (70_000, inf)];
        for (index, value) in bad {
            boxes[index].min.y = value;
        }
        let whole = boxes[80_000];
        boxes[80_000] = Aabb::new(whole.max, whole.min);
        boxes[5] = Aabb::EMPTY;
        boxes[6] = Aabb::UNBOUNDED;
        // A half space that has the frustum's eye, and a column behind the eye.
        boxes[7] = Aabb::new([-inf, -inf, -inf], [inf, inf, T::from_f64(20.0)]);
        boxes[99_999] = Aabb::new([-T::ONE, -T::ONE, T::from_f64(20.0)], [zero, zero, inf]);
        let classes = one_by_one(&culler, &boxes, false);
        for (i, (class, before)) in classes.iter().zip(&everyday).enumerate() {
            let expected = match i {
                70_000 | 70_001 | 80_000 => None,
                5 | 99_999 => Some(Containment::Outside),
                6 | 7 => Some(Containment::Crossing),
                _ => *before,
            };
            assert_eq!(*class, expected, "{i}");
        }
        check_boxes(&culler, &boxes);
    }
    check::<f32>();
    check::<f64>();
}

/// Spheres and oriented boxes: NaN, infinite and negative ones are invalid.
#[test]
fn one_invalid_sphere_or_oriented_box_among_a_hundred_thousand() {
    let culler = culler();
    let boxes = boxes::<f64>();
    let half = |b: &Aabb<f64>| (b.max - b.min) * 0.5;
    let mut spheres: Vec<_> = boxes
        .iter()
        .map(|b| Sphere::new(b.min, half(b).x))
        .collect();
    spheres[70_000].radius = -1.0;
    spheres[70_001].radius = INF;
    spheres[99_999].center.y = f64::NAN;
    let components = columns(&spheres, |s| [s.center.x, s.center.y, s.center.z, s.radius]);
    let [x, y, z, radius] = components.each_ref().map(Vec::as_slice);
    let center = [x, y, z];
    let turned = |b: &Aabb<f64>| {
        let h = half(b);
        let axes = [[h.x, h.y, 0.0], [-h.y, h.x, 0.0], [0.0, 0.0, h.z]];
        Obb::new((b.min + b.max) * 0.5, axes)
    };
    let mut oriented: Vec<_> = boxes.iter().map(turned).collect();
    oriented[70_000].center.z = f64::NAN;
    oriented[70_001].half_axes[2].x = -INF;
    let singles: Vec<Obb<f32>> = (oriented.iter())
        .map(|b| Obb::new(Vec3::from_f64(b.center), b.half_axes.map(Vec3::from_f64)))
        .collect();
    for is_exact in [false, true] {
        let expected = one_by_one(&culler, &spheres, is_exact);
        assert_eq!(expected.iter().filter(|c| c.is_none()).count(), 3);
        check(&culler, &spheres, &expected, is_exact);
        check(
            &culler,
            SphereArrays { center, radius },
            &expected,
            is_exact,
        );
        let expected = one_by_one(&culler, &oriented, is_exact);
        assert_eq!(expected.iter().filter(|c| c.is_none()).count(), 2);
        check(&culler, &oriented, &expected, is_exact);
        let expected = one_by_one(&culler, &singles, is_exact);
        check(&culler, &singles[..], &expected, is_exact);
    }
}

/// A box with some of its sides moved to infinity.
fn opened<T: Real>(v: Aabb<T>, sides: u64) -> Aabb<T> {
    let mut all = [v.min.to_array(), v.max.to_array()];
    let infinite = [-T::INFINITY, T::INFINITY];
    for k in 0..6 {
        if sides >> k & 1 != 0 {
            all[k / 3][k % 3] = infinite[k / 3];
        }
    }
    Aabb::new(all[0], all[1])
}

/// Hard cases of all families with every choice of infinite sides, compared with rational arithmetic, in which such a
/// side is a number beyond all others.
#[test]
fn boxes_without_bounds_are_classified_exactly() {
    let (mut seen, mut separate) = ([0; 3], 0);
    for &family in Family::ALL {
        for block in 0..2 {
            let scene = family.scene(14, block);
            let oracle = Oracle::new(scene.frustum());
            let culler = Culler::new(scene.frustum());
            let all: FaceSet = scene.frustum().faces().iter().copied().collect();
            for i in 0..96 {
                let v = opened(
                    hard_box::<f64>(&scene, 14, block * BLOCK + i),
                    i * 37 % 63 + 1,
                );
                let said = || format!("{v:?} {:?}", scene.frustum());
                let class = culler.classify(v).unwrap();
                assert_eq!(class, oracle.classify(&v.into()), "{}", said());
                let mut counts = VolumeCounts::default();
                let exact = culler.classify_exact_counted(v, &mut counts).unwrap();
                let meets = oracle.intersects(&v.into());
                assert_eq!(exact != Containment::Outside, meets, "{}", said());
                assert!(!meets || exact == class, "{}", said());
                separate += counts.false_accepts;
                let masked = culler.classify_masked(v, all, &mut None).unwrap();
                assert_eq!(masked.containment, class, "{}", said());
                seen[class as usize] += 1;
            }
        }
    }
    println!("outside, crossing, inside: {seen:?}; beyond an edge: {separate}");
    assert!(
        seen[0] > 500 && seen[1] > 500 && separate > 20,
        "{seen:?} {separate}"
    );
}

#[test]
fn the_empty_box_is_nowhere() {
    for &family in Family::ALL {
        let scene = family.scene(14, 0);
        let (culler, oracle) = (Culler::new(scene.frustum()), Oracle::new(scene.frustum()));
        let empty = Aabb::<f64>::EMPTY;
        assert_eq!(culler.classify(empty), Ok(Containment::Outside));
        assert_eq!(culler.classify_exact(empty), Ok(Containment::Outside));
        assert_eq!(
            culler.classify(Aabb::<f32>::EMPTY),
            Ok(Containment::Outside)
        );
        assert_eq!(oracle.classify(&empty.into()), Containment::Outside);
        assert!(!oracle.intersects(&empty.into()));
        for faces in [
            FaceSet::EMPTY,
            culler.frustum().faces().iter().copied().collect(),
        ] {
            let answer = culler.classify_masked(empty, faces, &mut None).unwrap();
            assert_eq!(answer.containment, Containment::Outside);
        }
        // All of space is nowhere outside, and in no frustum.
        let all = Aabb::<f64>::UNBOUNDED;
        assert_eq!(culler.classify_exact(all), Ok(Containment::Crossing));
    }
    let some = Aabb::new([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
    assert_eq!(Aabb::EMPTY.union(some), some);
    assert_eq!(some.union(Aabb::EMPTY), some);
    assert_eq!(Aabb::UNBOUNDED.union(some), Aabb::UNBOUNDED);
    assert!(Aabb::<f32>::EMPTY.union(Aabb::EMPTY).is_empty() && !some.is_empty());
}

/// Only the empty box itself may have `min` above `max`, and infinities only where a side is absent.
#[test]
fn other_boxes_are_invalid() {
    for axis in 0..3 {
        let mut v = Aabb::new([0.0; 3], [1.0; 3]);
        (v.min[axis], v.max[axis]) = (INF, -INF);
        assert!(matches!(
            v.check(),
            Err(VolumeError::NonFinite { value: INF, .. })
        ));
        v.min[axis] = 0.0;
        assert!(matches!(v.check(), Err(VolumeError::NonFinite { value, .. }) if value == -INF));
        v.max[axis] = INF;
        assert_eq!(v.check(), Ok(()));
        v.min[axis] = INF;
        assert!(v.check().is_err());
        v.min[axis] = f64::NAN;
        assert!(matches!(v.check(), Err(VolumeError::NonFinite { value, .. }) if value.is_nan()));
        v.min[axis] = -INF;
        assert_eq!(v.check(), Ok(()));
    }
}

/// Scaled by powers of two, mirrored and transposed, the classes are the same.
#[test]
fn symmetries_of_boxes_without_bounds() {
    let square = |z: f64, half: f64| EndRect::new(z, -half, half, -half, half);
    let culler = |pose: Pose, k: f64| {
        let (near, far) = (square(k, k), square(3.0 * k, 3.0 * k));
        Culler::new(&Frustum::new(pose, Shape::Finite { near, far }).unwrap())
    };
    let axes = [[0.5, 0.25, 0.0], [-0.25, 0.5, 0.0], [0.0, 0.125, 1.0]].map(Vec3::from);
    let pose = Pose::new([0.5, -0.25, 0.125].into(), axes);
    let mirrored = Pose::new(
        Vec3::new(-0.5, -0.25, 0.125),
        axes.map(|a| Vec3::new(-a.x, a.y, a.z)),
    );
    let swap = |v: Vec3<f64>| Vec3::new(v.y, v.x, v.z);
    let swapped = Pose::new(swap(pose.origin), axes.map(swap));
    let cullers = [
        culler(pose, 1.0),
        culler(mirrored, 1.0),
        culler(swapped, 1.0),
    ];
    let scaled = culler(Pose::new(pose.origin * 64.0, axes), 64.0);
    let mut random = Random::new(&[14, 2]);
    let mut seen = [0; 3];
    for i in 0..4_000 {
        let mut point = || Vec3::from([(); 3].map(|()| random.between(-8.0, 8.0).round() / 2.0));
        let v = opened(Aabb::around([point(), point()]).unwrap(), i % 63 + 1);
        let images = [
            v,
            Aabb::new([-v.max.x, v.min.y, v.min.z], [-v.min.x, v.max.y, v.max.z]),
            Aabb::new(swap(v.min), swap(v.max)),
        ];
        let classes = [
            |culler: &Culler, v: Aabb<f64>| culler.classify(v),
            |culler: &Culler, v: Aabb<f64>| culler.classify_exact(v),
        ];
        for classify in classes {
            let class = classify(&cullers[0], v).unwrap();
            for (culler, image) in cullers.iter().zip(images) {
                assert_eq!(classify(culler, image), Ok(class), "{v:?}");
            }
            assert_eq!(
                classify(&scaled, Aabb::new(v.min * 64.0, v.max * 64.0)),
                Ok(class)
            );
            seen[class as usize] += 1;
        }
    }
    assert!(seen[0] > 500 && seen[1] > 500, "{seen:?}");
}

/// Many unusual boxes in a block: the others are still decided together.
#[test]
fn unusual_boxes_leave_the_others_of_a_block_to_the_kernel() {
    let culler = culler();
    let mut boxes = boxes::<f32>();
    boxes.truncate(2_560);
    let count = |boxes: &[Aabb<f32>]| {
        let (_, counts) = ask(|| culler.over(boxes).keep_invalid()).unwrap();
        let set = BoxSet::new(boxes.iter().copied().filter(|b| b.check().is_ok())).unwrap();
        let (_, of_set) = ask(|| culler.over(&set)).unwrap();
        assert!(of_set.undecided <= counts.undecided);
        counts.undecided
    };
    let before = count(&boxes);
    for (i, v) in boxes.iter_mut().enumerate().step_by(64) {
        *v = match i / 64 % 4 {
            0 => Aabb::EMPTY,
            1 => Aabb::UNBOUNDED,
            2 => opened(*v, 8),
            _ => Aabb::new(v.max, [f32::NAN; 3]),
        };
    }
    let unusual = boxes.len().div_ceil(64) as u64;
    let after = count(&boxes);
    assert!(
        after >= unusual && after <= before + unusual,
        "{before} {after}"
    );
    check_boxes(&culler, &boxes);
}

/// Exact answers of queries over hard volumes are those of [`Culler::classify_exact`], and of the oracle.
#[test]
fn queries_are_exact_where_asked() {
    let mut separate = [0; 3];
    for &family in Family::ALL {
        let scene = family.scene(14, 1);
        let (culler, oracle) = (Culler::new(scene.frustum()), Oracle::new(scene.frustum()));
        let indices = BLOCK..BLOCK + 40;
        let boxes: Vec<Aabb<f64>> = indices.clone().map(|i| hard_box(&scene, 14, i)).collect();
        let oriented: Vec<Obb<f64>> = indices.clone().map(|i| hard_obb(&scene, 14, i)).collect();
        let spheres: Vec<Sphere<f64>> = indices.map(|i| hard_sphere(&scene, 14, i)).collect();
        check_boxes(&culler, &boxes);
        let expected = one_by_one(&culler, &oriented, true);
        check(&culler, &oriented, &expected, true);
        let expected = one_by_one(&culler, &spheres, true);
        check(&culler, &spheres, &expected, true);
        let mut check_truth = |kind: usize, volumes: Vec<Volume>, classes: Vec<Containment>| {
            for (volume, class) in volumes.iter().zip(classes) {
                let meets = oracle.intersects(volume);
                assert_eq!(class != Containment::Outside, meets, "{volume:?}");
                let by_planes = oracle.classify(volume);
                separate[kind] += usize::from(!meets && by_planes == Containment::Crossing);
            }
        };
        let (classes, _) = ask(|| culler.over(&boxes).exact()).unwrap();
        check_truth(0, boxes.iter().map(|v| (*v).into()).collect(), classes);
        let (classes, _) = ask(|| culler.over(&oriented).exact()).unwrap();
        check_truth(1, oriented.iter().map(|v| (*v).into()).collect(), classes);
        let (classes, _) = ask(|| culler.over(&spheres).exact()).unwrap();
        check_truth(2, spheres.iter().map(|v| (*v).into()).collect(), classes);
    }
    assert!(separate.iter().all(|&count| count > 20), "{separate:?}");
}

/// The image of a box under an affine transformation: exact where numbers are short, else within the
/// stated bound, by rational arithmetic.
#[test]
fn images_of_boxes() {
    let q = |x: f64| num_rational::BigRational::from_float(x).unwrap();
    let mut random = Random::new(&[14, 3]);
    for round in 0..500 {
        let is_coarse = round % 2 == 0;
        let mut point = || {
            let number = |()| {
                let x = random.between(-100.0, 100.0);
                if is_coarse { x.round() } else { x }
            };
            Vec3::from([(); 3].map(number))
        };
        let local = Aabb::around([point(), point()]).unwrap();
        let columns = [(); 4].map(|()| point());
        let placed = Obb::from_affine(local, columns);
        let single = Obb::from_affine(
            Aabb::new(Vec3::<f32>::from_f64(local.min), Vec3::from_f64(local.max)),
            columns.map(Vec3::<f32>::from_f64),
        );
        // Its eight corners, from the local ones.
        for k in 0..8 {
            let pick = |axis: usize| [local.min, local.max][k >> axis & 1][axis];
            for j in 0..3 {
                let products = [0, 1, 2].map(|i| q(columns[i][j]) * q(pick(i)));
                let exact = products.iter().fold(q(columns[3][j]), |sum, p| sum + p);
                let signs = [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { q(-1.0) } else { q(1.0) });
                let corner = |center: f64, axes: [f64; 3]| {
                    let parts = signs.iter().zip(axes).map(|(s, a)| s * q(a));
                    parts.fold(q(center), |sum, part| sum + part)
                };
                let found = corner(placed.center[j], placed.half_axes.map(|a| a[j]));
                // Four stored numbers, of at most 6 u of 30,100 each.
                let error = num_traits::Signed::abs(&(&found - &exact));
                assert!(error <= q(4.0 * 6.0 * 30_100.0 * f64::EPSILON / 2.0));
                assert!(!is_coarse || found == exact);
                if is_coarse {
                    let axes = single.half_axes.map(|a| f64::from(a[j]));
                    assert_eq!(corner(single.center[j].into(), axes), exact);
                }
            }
        }
    }
    assert!(
        Obb::from_affine(Aabb::<f64>::EMPTY, [[1.0; 3]; 4])
            .check()
            .is_err()
    );
}
