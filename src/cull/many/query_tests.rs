//! Every source with every output and every option, compared with one volume at a time.

use super::tests::{culler_to_3, one_by_one, points, visible};
use super::*;
use crate::cull::{Aabb, Containment, Culler, Sphere, VolumeCounts};
use crate::math::{Real, Vec3};

/// More than a piece of a parallel query, and no multiple of a block.
const COUNT: usize = 8_192 + 1_024 + 77;

/// Boxes around points, some of them touching the frustum, in two thirds of all cases.
fn boxes<T: Real>() -> Vec<Aabb<T>> {
    let to = |p: Vec3<f32>| Vec3::<T>::from_f64(p.to_f64());
    let around = |(i, p): (usize, Vec3<f32>)| match i % 97 {
        // Corners at the frustum's corner, and a point in its far face.
        0 => Aabb::new(
            Vec3::from_f64(Vec3::new(3.0, 3.0, 3.0)),
            to(p + Vec3::new(9.0, 9.0, 9.0)),
        ),
        1 => Aabb::new(
            [T::ZERO, T::ZERO, T::from_f64(3.0)],
            [T::ZERO, T::ZERO, T::from_f64(3.0)],
        ),
        _ => Aabb::new(to(p), to(p + Vec3::new(0.3, 0.1, 0.2))),
    };
    points(COUNT).into_iter().enumerate().map(around).collect()
}

fn spheres<T: Real>() -> Vec<Sphere<T>> {
    let around = |(i, p): (usize, Vec3<f32>)| match i % 97 {
        0 => Sphere::new([T::ZERO, T::ZERO, T::from_f64(5.0)], T::from_f64(2.0)),
        _ => Sphere::new(Vec3::from_f64(p.to_f64()), T::from_f64(0.2)),
    };
    points(COUNT).into_iter().enumerate().map(around).collect()
}

/// The three outputs of a query, each with its counts.
type Answers = (
    (Vec<u32>, VolumeCounts),
    (Vec<Containment>, VolumeCounts),
    (ContainmentMasks, VolumeCounts),
);

fn answers<'q, S: VolumeSource>(
    query: impl Fn() -> VolumeQuery<'q, S>,
    option: impl Fn(VolumeQuery<'q, S>) -> VolumeQuery<'q, S>,
) -> Answers {
    // Content from before is replaced.
    let (mut list, mut classes) = (vec![7; 9], vec![Containment::Inside; 2 * COUNT]);
    let mut masks = ContainmentMasks::default();
    option(query()).visible(&mut list).unwrap();
    option(query()).classes(&mut classes).unwrap();
    option(query()).masks(&mut masks).unwrap();
    // Counting changes nothing.
    let mut counts = <[VolumeCounts; 3]>::default();
    let mut counted = (Vec::new(), Vec::new(), ContainmentMasks::default());
    let [for_list, for_classes, for_masks] = &mut counts;
    let count = |query: VolumeQuery<'q, S>,
                 to: &mut VolumeCounts,
                 run: &mut dyn FnMut(VolumeQuery<'_, S>)| {
        run(option(query).counted(to));
    };
    count(query(), for_list, &mut |q| {
        q.visible(&mut counted.0).unwrap()
    });
    count(query(), for_classes, &mut |q| {
        q.classes(&mut counted.1).unwrap()
    });
    count(query(), for_masks, &mut |q| {
        q.masks(&mut counted.2).unwrap()
    });
    assert!(counted == (list.clone(), classes.clone(), masks.clone()));
    let [for_list, for_classes, for_masks] = counts;
    ((list, for_list), (classes, for_classes), (masks, for_masks))
}

/// A source's answers, plain and parallel, are `expected`.
fn check<S: VolumeSource + Copy + Sync>(
    culler: &Culler,
    source: S,
    expected: &[Containment],
    name: &str,
) {
    let plain = answers(|| culler.over(source), |query| query);
    let ((list, for_list), (classes, for_classes), (masks, for_masks)) = &plain;
    assert!(*list == visible(expected), "{name}");
    assert!(classes == expected, "{name}");
    assert_eq!(masks.len(), expected.len(), "{name}");
    let of_masks = (0..expected.len()).filter_map(|i| masks.get(i));
    assert!(of_masks.eq(expected.iter().copied()), "{name}");
    // Volumes that touch are decided one by one; fewer of them where `inside` does not matter.
    assert!(for_list.undecided > 0, "{name}");
    assert!(for_list.undecided <= for_classes.undecided, "{name}");
    assert_eq!(for_classes, for_masks, "{name}");
    #[cfg(feature = "parallel")]
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let parallel = pool
            .build()
            .unwrap()
            .install(|| answers_parallel(culler, source));
        assert!(parallel == plain, "{name}, {threads} threads");
    }
}

#[cfg(feature = "parallel")]
fn answers_parallel<S: VolumeSource + Copy + Sync>(culler: &Culler, source: S) -> Answers {
    answers(|| culler.over(source), VolumeQuery::parallel)
}

fn columns<V, T: Copy, const K: usize>(all: &[V], of: impl Fn(&V) -> [T; K]) -> [Vec<T>; K] {
    std::array::from_fn(|k| all.iter().map(|v| of(v)[k]).collect())
}

/// Every source of volumes in one scalar type.
fn check_sources<T: Real>(culler: &Culler) {
    let boxes = boxes::<T>();
    let expected = one_by_one(culler, &boxes);
    for class in Containment::ALL {
        let count = expected.iter().filter(|&&c| c == class).count();
        assert!(count > COUNT / 500, "{class}: {count}");
    }
    check(culler, &boxes, &expected, "a vector of boxes");
    check(culler, &boxes[..], &expected, "a slice of boxes");
    let array: &[Aabb<T>; COUNT] = boxes.as_slice().try_into().unwrap();
    check(culler, array, &expected, "an array of boxes");
    let set = BoxSet::new(boxes.iter().copied()).unwrap();
    check(culler, &set, &expected, "a set");
    let corners = columns(&boxes, |b| {
        let [[a, b, c], [d, e, f]] = [b.min.to_array(), b.max.to_array()];
        [a, b, c, d, e, f]
    });
    let [a, b, c, d, e, f] = corners.each_ref().map(Vec::as_slice);
    let (min, max) = ([a, b, c], [d, e, f]);
    let arrays = BoxArrays { min, max };
    check(culler, arrays, &expected, "arrays of boxes");
    let by_reference = &arrays;
    check(culler, by_reference, &expected, "arrays by reference");

    let spheres = spheres::<T>();
    let expected = one_by_one(culler, &spheres);
    check(culler, &spheres, &expected, "a vector of spheres");
    check(culler, &spheres[..], &expected, "a slice of spheres");
    let array: &[Sphere<T>; COUNT] = spheres.as_slice().try_into().unwrap();
    check(culler, array, &expected, "an array of spheres");
    let components = columns(&spheres, |s| {
        let [x, y, z] = s.center.to_array();
        [x, y, z, s.radius]
    });
    let [x, y, z, radius] = components.each_ref().map(Vec::as_slice);
    let center = [x, y, z];
    check(
        culler,
        SphereArrays { center, radius },
        &expected,
        "arrays of spheres",
    );
}

#[test]
fn every_source_output_and_option_agrees_with_classify() {
    let culler = culler_to_3();
    check_sources::<f32>(&culler);
    check_sources::<f64>(&culler);
    let boxes = boxes::<f64>();
    let relative = RelativeBoxes::new([0.1, 0.2, 0.3], &boxes).unwrap();
    check(
        &culler,
        &relative,
        &one_by_one(&culler, &boxes),
        "relative boxes",
    );
}

#[test]
fn layouts_are_indexed_and_measured_alike() {
    use super::boxes::Boxes;
    let (low, high) = ([0.0_f32, 1.0, 2.0], [1.0, 2.0, 3.0, 4.0]);
    let arrays = Boxes::from(BoxArrays {
        min: [&low; 3],
        max: [&high; 3],
    });
    assert_eq!(arrays.len(), 3);
    assert_eq!(arrays.get(1), Some(Aabb::new([1.0; 3], [2.0; 3])));
    assert_eq!(arrays.get(3), None);
    let boxes = [Aabb::new([0.0_f32; 3], [1.0; 3])];
    assert_eq!(Boxes::from(&boxes).len(), 1);
}

/// Volumes, some of them invalid, by both policies and in every output.
fn check_invalid<S: VolumeSource + Copy + Sync>(
    culler: &Culler,
    source: S,
    expected: &[Option<Containment>],
) {
    let invalid = expected.iter().filter(|class| class.is_none()).count();
    let first = expected.iter().position(Option::is_none).unwrap();
    let expected: Vec<_> = expected
        .iter()
        .map(|c| c.unwrap_or(Containment::Crossing))
        .collect();
    type Options<'q, S> = fn(VolumeQuery<'q, S>) -> VolumeQuery<'q, S>;
    let options: &[Options<'_, S>] = &[
        |query| query,
        #[cfg(feature = "parallel")]
        |query| query.parallel(),
    ];
    for option in options {
        let query = || option(culler.over(source));
        let (mut list, mut classes) = (vec![7], vec![Containment::Inside]);
        let mut masks = ContainmentMasks::default();
        let errors = [
            query().visible(&mut list),
            query().classes(&mut classes),
            query().masks(&mut masks),
        ];
        assert!(errors.iter().all(|e| e.unwrap_err().index == first));
        assert!(list.is_empty() && classes.is_empty() && masks.is_empty());
        let mut counts = <[VolumeCounts; 3]>::default();
        let [a, b, c] = &mut counts;
        query()
            .keep_invalid()
            .counted(a)
            .visible(&mut list)
            .unwrap();
        query()
            .counted(b)
            .keep_invalid()
            .classes(&mut classes)
            .unwrap();
        query().keep_invalid().counted(c).masks(&mut masks).unwrap();
        assert!(list == visible(&expected));
        assert!(classes == expected);
        assert!((0..expected.len()).all(|i| masks.get(i) == Some(expected[i])));
        assert!(counts.iter().all(|counts| counts.invalid == invalid as u64));
    }
}

#[test]
fn one_bad_volume_in_a_frame_hides_nothing() {
    fn check<T: Real>(culler: &Culler) {
        let (nan, infinity) = (T::from_f64(f64::NAN), T::from_f64(f64::INFINITY));
        let mut boxes = boxes::<T>();
        let mut expected: Vec<_> = one_by_one(culler, &boxes).into_iter().map(Some).collect();
        let [a, b, c, d] = [300, 301, 8_200, COUNT - 1];
        boxes[a].max.y = nan;
        boxes[b].min.x = infinity;
        let valid = boxes[c];
        boxes[c] = Aabb::new(valid.max, valid.min);
        boxes[d] = Aabb::new([infinity, T::ZERO, T::ZERO], [-infinity; 3]);
        for bad in [a, b, c, d] {
            expected[bad] = None;
        }
        check_invalid(culler, &boxes, &expected);
        let corners = columns(&boxes, |b| {
            let [[a, b, c], [d, e, f]] = [b.min.to_array(), b.max.to_array()];
            [a, b, c, d, e, f]
        });
        let [a, b, c, d, e, f] = corners.each_ref().map(Vec::as_slice);
        let (min, max) = ([a, b, c], [d, e, f]);
        check_invalid(culler, BoxArrays { min, max }, &expected);

        let mut spheres = spheres::<T>();
        let mut expected: Vec<_> = one_by_one(culler, &spheres).into_iter().map(Some).collect();
        let [a, b, c] = [2, 300, COUNT - 1];
        spheres[a].radius = -T::ONE;
        spheres[b].center.z = nan;
        spheres[c].radius = infinity;
        for bad in [a, b, c] {
            expected[bad] = None;
        }
        check_invalid(culler, &spheres, &expected);
        let components = columns(&spheres, |s| {
            let [x, y, z] = s.center.to_array();
            [x, y, z, s.radius]
        });
        let [x, y, z, radius] = components.each_ref().map(Vec::as_slice);
        let center = [x, y, z];
        check_invalid(culler, SphereArrays { center, radius }, &expected);
    }
    let culler = culler_to_3();
    check::<f32>(&culler);
    check::<f64>(&culler);
}

#[test]
fn a_failed_query_counts_nothing() {
    let culler = culler_to_3();
    let touching = Aabb::new([3.0; 3], [9.0; 3]);
    let boxes = [touching, Aabb::new([1.0; 3], [0.0; 3])];
    let mut counts = VolumeCounts::default();
    let query = culler.over(&boxes).counted(&mut counts);
    assert_eq!(query.visible(&mut Vec::new()).unwrap_err().index, 1);
    assert_eq!(counts, VolumeCounts::default());
}

/// Content, and answers, of a set that changes are those of a vector that changes with it.
#[test]
fn a_set_changes_as_a_vector_does() {
    fn check<T: Real>(culler: &Culler) {
        let all = boxes::<T>();
        let (mut set, mut boxes) = (BoxSet::default(), Vec::new());
        let mut place = 77;
        for round in 0..5 {
            let more = &all[round * 700..round * 700 + 513];
            set.extend(more.iter().copied()).unwrap();
            boxes.extend_from_slice(more);
            let bad = [all[0], Aabb::new([T::ONE; 3], [T::ZERO; 3])];
            assert_eq!(set.extend(bad).unwrap_err().index, 1);
            for _ in 0..300 {
                place = place * 31 % boxes.len();
                assert_eq!(set.swap_remove(place), boxes.swap_remove(place));
            }
            assert!(set.iter().eq(boxes.iter().copied()));
            assert!(set.iter().rev().eq(boxes.iter().rev().copied()));
            assert_eq!(set.iter().len(), boxes.len());
            let mut classes = Vec::new();
            culler.over(&set).classes(&mut classes).unwrap();
            assert!(classes == one_by_one(culler, &boxes));
        }
        for _ in 0..boxes.len() {
            set.swap_remove(0);
        }
        assert!(set.is_empty() && set.iter().next().is_none());
    }
    let culler = culler_to_3();
    check::<f32>(&culler);
    check::<f64>(&culler);
}
