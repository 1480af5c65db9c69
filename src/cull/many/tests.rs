//! Kernels compared with one volume at a time, at every vector width.

use super::block_driver::{BlockDriver, Request, Volumes};
use super::boxes::Boxes;
use super::output::{Classes, Indices, Sink};
use super::spheres::Spheres;
use super::*;
use crate::clip::Class;
use crate::clip::many::intervals::SegmentIntervals;
use crate::cull::{Aabb, Containment, Culler, Sphere, Volume, VolumeCounts, VolumeError};
use crate::frustum::{Direction, EndRect, Frustum, Shape};
use crate::math::{Pose, Real, Rect, Segment, Vec3};
use crate::samples::{BLOCK, Family};
use crate::simd::levels;
use std::fmt::Debug;

/// The class of each volume by [`Culler::classify`].
pub(in crate::cull) fn one_by_one<V: Copy + Into<Volume>>(
    culler: &Culler,
    volumes: &[V],
) -> Vec<Containment> {
    let class = |v: &V| culler.classify(*v).expect("a valid volume");
    volumes.iter().map(class).collect()
}

/// The indices of the volumes that are not outside.
pub(in crate::cull) fn visible(classes: &[Containment]) -> Vec<u32> {
    (0_u32..)
        .zip(classes)
        .filter_map(|(i, class)| (*class != Containment::Outside).then_some(i))
        .collect()
}

/// Points without a pattern, in and about a frustum from z = 1 to z = 3.
pub(in crate::cull) fn points(count: usize) -> Vec<Vec3<f32>> {
    let mut state = 88_172_645_463_325_252_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1 << 22) as f32 - 2.0
    };
    (0..count)
        .map(|_| Vec3::new(next(), next(), next() + 2.0))
        .collect()
}

/// A frustum from z = 1 to z = 3.
pub(in crate::cull) fn culler_to_3() -> Culler {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    let shape = Shape::Finite { near, far };
    Culler::new(&Frustum::new(Pose::IDENTITY, shape).unwrap())
}

/// Boxes between the ends of a family's segments, which are near faces, edges and corners.
fn boxes<T: Real>(segments: &[Segment<T>]) -> Vec<Aabb<T>> {
    let around = |s: &Segment<T>| Aabb::around([s.start, s.end]);
    let mut all: Vec<_> = segments.iter().filter_map(around).collect();
    // Points, too.
    let points = segments.iter().map(|s| Aabb::new(s.end, s.end));
    all.extend(points.take(9));
    all
}

/// Spheres around one end that reach as far as the other end in one coordinate.
fn spheres<T: Real>(segments: &[Segment<T>]) -> Vec<Sphere<T>> {
    let sphere = |s: &Segment<T>| Sphere::new(s.start, (s.end.z - s.start.z).abs());
    let finite = |s: &Sphere<T>| s.radius.is_finite();
    segments.iter().map(sphere).filter(finite).collect()
}

/// The segments of a scene, repeated from different offsets, so that each appears in every lane
/// of a register.
fn segments<T: Real>(family: Family, block: u64) -> (Frustum, Vec<Segment<T>>) {
    let scene = family.scene(7, block);
    let cases = block * BLOCK..(block + 1) * BLOCK;
    let some: Vec<Segment<T>> = cases.map(|i| family.segment(&scene, 7, i)).collect();
    let many = (0..9).flat_map(|k| &some[k..]).copied().collect();
    (scene.frustum().clone(), many)
}

/// Every output of some volumes is that of single answers, at every vector width.
fn compare<T: Real, const K: usize>(
    culler: &Culler,
    volumes: impl Volumes<T, K>,
    all: &[impl Copy + Debug + Into<Volume>],
) {
    let expected = one_by_one(culler, all);
    let visible = visible(&expected);
    for level in levels() {
        let driver = BlockDriver {
            request: Request {
                culler,
                keeps_invalid: false,
                is_exact: false,
            },
            planes: T::pick(culler.face_planes()),
            volumes: &volumes,
            level,
        };
        let run = |out: &mut dyn Sink| {
            let done = driver.run(0..all.len(), out, &mut VolumeCounts::default());
            done.unwrap();
        };
        let (mut masks, mut list) = (ContainmentMasks::default(), Vec::new());
        let mut classes = vec![Containment::Crossing; all.len()];
        run(&mut masks.prepare(all.len()));
        run(&mut Classes(&mut classes));
        run(&mut Indices::new(&mut list, 0));
        for (i, (class, expected)) in classes.iter().zip(&expected).enumerate() {
            assert_eq!(class, expected, "{:?} {:?}", culler.frustum(), all[i]);
            assert_eq!(masks.get(i), Some(*expected));
        }
        assert_eq!(masks.get(expected.len()), None);
        assert!(masks.visible().eq(visible.iter().map(|&i| i as usize)));
        assert_eq!(list, visible);
    }
}

fn column<T: Copy, V>(volumes: &[V], component: impl Fn(&V) -> T) -> Vec<T> {
    volumes.iter().map(component).collect()
}

/// All layouts of some boxes.
fn with_layouts<T: Real>(boxes: &[Aabb<T>], mut with: impl FnMut(Boxes<'_, T>)) {
    with(Boxes::from(boxes));
    let min = [0, 1, 2].map(|k| column(boxes, |b| b.min[k]));
    let max = [0, 1, 2].map(|k| column(boxes, |b| b.max[k]));
    with(Boxes::from(BoxArrays {
        min: min.each_ref().map(Vec::as_slice),
        max: max.each_ref().map(Vec::as_slice),
    }));
    // A set rejects invalid boxes.
    if let Ok(set) = BoxSet::new(boxes.iter().copied()) {
        with(Boxes::from(&set));
    }
}

#[test]
fn boxes_are_classified_as_they_are_alone() {
    for family in Family::ALL {
        for block in 0..6 {
            let (frustum, segments) = segments::<f64>(*family, block);
            let (culler, all) = (Culler::new(&frustum), boxes(&segments));
            with_layouts(&all, |layout| compare(&culler, layout, &all));
            if family.has_f32() {
                let all = boxes(&self::segments::<f32>(*family, block).1);
                with_layouts(&all, |layout| compare(&culler, layout, &all));
            }
        }
    }
}

#[test]
fn spheres_are_classified_as_they_are_alone() {
    for family in Family::ALL {
        for block in 0..6 {
            let (frustum, segments) = segments::<f64>(*family, block);
            let (culler, all) = (Culler::new(&frustum), spheres(&segments));
            compare(&culler, Spheres::from(&all), &all);
            if family.has_f32() {
                let all = spheres(&self::segments::<f32>(*family, block).1);
                let center = [0, 1, 2].map(|k| column(&all, |s| s.center[k]));
                let arrays = SphereArrays {
                    center: center.each_ref().map(Vec::as_slice),
                    radius: &column(&all, |s| s.radius),
                };
                compare(&culler, Spheres::from(arrays), &all);
            }
        }
    }
}

#[test]
fn any_number_of_boxes() {
    let (frustum, segments) = segments::<f32>(Family::HalfLattice, 1);
    let (culler, all) = (Culler::new(&frustum), boxes(&segments));
    for length in (0..140).chain(500..530).chain([1023, 1024, 1025]) {
        let some = &all[..length.min(all.len())];
        with_layouts(some, |layout| compare(&culler, layout, some));
    }
}

#[test]
fn the_first_invalid_volume_is_returned_and_buffers_are_emptied() {
    let culler = culler_to_3();
    let unit = Aabb::new([0.0_f32; 3], [1.0; 3]);
    let bad = [
        (Aabb::new([0.0, f32::NAN, 0.0], [1.0; 3]), "min.y = NaN"),
        (
            Aabb::new([0.0; 3], [1.0, 1.0, f32::NEG_INFINITY]),
            "max.z = -inf",
        ),
        (
            Aabb::new([f32::INFINITY, 0.0, 0.0], [1.0; 3]),
            "min.x = inf",
        ),
        (
            Aabb::new([0.0, 0.0, 2.0], [1.0; 3]),
            "min.z = 2 is greater than max.z = 1",
        ),
    ];
    for (bad, why) in bad {
        for index in [0, 7, 63, 64, 600, 1099] {
            let mut all = vec![unit; 1100];
            all[index] = bad;
            let min = [0, 1, 2].map(|k| column(&all, |b| b.min[k]));
            let max = [0, 1, 2].map(|k| column(&all, |b| b.max[k]));
            let arrays = BoxArrays {
                min: min.each_ref().map(Vec::as_slice),
                max: max.each_ref().map(Vec::as_slice),
            };
            let (mut masks, mut classes, mut list) = Default::default();
            culler.over(&[unit; 3]).masks(&mut masks).unwrap();
            culler.over(&[unit; 3]).classes(&mut classes).unwrap();
            culler.over(&[unit; 3]).visible(&mut list).unwrap();
            let errors = [
                culler.over(&all).masks(&mut masks),
                culler.over(arrays).masks(&mut masks),
                culler.over(&all).classes(&mut classes),
                culler.over(arrays).classes(&mut classes),
                culler.over(&all).visible(&mut list),
                culler.over(arrays).visible(&mut list),
                BoxSet::new(all.iter().copied()).map(drop),
            ];
            for error in errors.map(Result::unwrap_err) {
                assert_eq!(error.index, index);
                assert!(error.to_string().contains(why), "{error}");
            }
            assert!(masks.is_empty() && masks.outside().is_empty());
            assert!(classes.is_empty() && list.is_empty());
        }
    }
    let mut spheres = vec![Sphere::new([0.0_f64; 3], 1.0); 70];
    spheres[66].radius = -0.5;
    let query = culler.over(&spheres);
    let error = query.classes(&mut Vec::new()).unwrap_err();
    assert_eq!(error.error, VolumeError::NegativeRadius { radius: -0.5 });
    assert_eq!(error.index, 66);
}

/// Most volumes of an everyday scene are decided in registers: a query is no loop over single
/// calls.
#[test]
fn few_are_classified_one_by_one() {
    let frustum = Family::Random.scene(1, 0).frustum().clone();
    let culler = Culler::new(&frustum);
    let mut random = crate::samples::Random::new(&[11]);
    let mut near = || random.between(-20.0, 20.0) as f32;
    let cube = |_| {
        let p = Vec3::new(near(), near(), near());
        Aabb::new(p, p + Vec3::new(1.0, 1.0, 1.0))
    };
    let boxes: Vec<Aabb<f32>> = (0..4096).map(cube).collect();
    let mut counts = VolumeCounts::default();
    let query = culler.over(&boxes).counted(&mut counts);
    query.classes(&mut Vec::new()).unwrap();
    assert_eq!(counts.filter_failures, 0, "beyond the filter in f64");
    assert!(counts.undecided < 16, "{}", counts.undecided);
    // Boxes that touch are undecided.
    let near = frustum.corners().near[0];
    let touching = [Aabb::new(near, near); 40];
    let mut counts = VolumeCounts::default();
    let query = culler.over(&touching).counted(&mut counts);
    query.classes(&mut Vec::new()).unwrap();
    assert_eq!(counts.undecided, 40);
}

/// Boxes of millimetres on the earth, and 1e18 metres away: the answers of `f64`, few of them
/// decided in `f64`.
#[test]
fn relative_boxes_are_classified_as_in_f64() {
    let mut random = crate::samples::Random::new(&[12]);
    for (at, size, anchored) in [(6.378e6, 1e-3, 1.0), (6.378e6, 1e-3, 5.0), (1e18, 1e4, 1e4)] {
        let eye = Vec3::new(0.6 * at, 0.64 * at, -0.48 * at);
        let camera = crate::Camera {
            eye,
            target: eye + Vec3::new(size * 300.0, size * 400.0, size * 20.0),
            up: Vec3::new(0.0, 0.0, 1.0),
            projection: crate::Projection::Perspective {
                fovy: 0.3,
                aspect: 1.5,
            },
            near: size * 10.0,
            far: size * 5000.0,
        };
        let culler = Culler::new(&camera.frustum().unwrap());
        let mut near = |reach: f64| {
            let mut c = || random.between(-reach, reach);
            Vec3::new(c(), c(), c())
        };
        let mut cube = |_| {
            let middle = camera.target + near(size * 400.0);
            let half = near(size);
            let half = Vec3::new(half.x.abs(), half.y.abs(), half.z.abs());
            Aabb::new(middle - half, middle + half)
        };
        let boxes: Vec<Aabb<f64>> = (0..20_000).map(&mut cube).collect();
        let anchor = eye + Vec3::new(anchored, -anchored, anchored);
        let relative = RelativeBoxes::new(anchor, &boxes).unwrap();
        let (mut classes, mut counts) = (Vec::new(), VolumeCounts::default());
        let query = culler.over(&relative).counted(&mut counts);
        query.classes(&mut classes).unwrap();
        let mut seen = [0; 3];
        for (volume, class) in boxes.iter().zip(&classes) {
            assert_eq!(culler.classify(*volume), Ok(*class), "{volume:?}");
            seen[*class as usize] += 1;
        }
        assert!(seen.iter().all(|&n| n > 20), "{seen:?}");
        assert!(counts.undecided < 1000, "{}", counts.undecided);
    }
    let wrong = RelativeBoxes::new([0.0, f64::NAN, 0.0], &[]).unwrap_err();
    assert!(wrong.to_string().contains("anchor"), "{wrong}");
    let empty = Aabb::new([1.0; 3], [0.0; 3]);
    assert!(RelativeBoxes::new([0.0; 3], &[empty]).is_err());
}

/// Found by fuzzing: an infinite frustum had a far face at 2^90, or 2^900 in `f64`.
#[test]
fn an_infinite_frustum_ends_nowhere() {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let shape = Shape::Infinite {
        near,
        slopes: Rect::new(-1.0, 1.0, -1.0, 1.0),
        direction: Direction::PlusZ,
    };
    let culler = Culler::new(&Frustum::new(Pose::IDENTITY, shape).unwrap());
    fn check<T: Real>(culler: &Culler, far: f64) {
        let at = |x: f64, y: f64, z: f64| Vec3::<T>::from_f64(Vec3::new(x, y, z));
        let boxes = [Aabb::new(at(0.0, 0.0, far / 2.0), at(0.0, 0.0, far)); 3];
        let spheres = [Sphere::new(at(0.0, 0.0, far), T::from_f64(far / 8.0)); 3];
        let mut classes = Vec::new();
        culler.over(&boxes).classes(&mut classes).unwrap();
        assert_eq!(classes, [Containment::Inside; 3]);
        culler.over(&spheres).classes(&mut classes).unwrap();
        assert_eq!(classes, [Containment::Inside; 3]);
        let segments = [Segment::new(at(0.0, 0.0, 0.0), at(0.0, 0.0, far)); 3];
        let mut intervals = SegmentIntervals::default();
        culler
            .clip_intervals(&segments[..], &mut intervals)
            .unwrap();
        assert_eq!(intervals.classes(), [Class::Cross; 3]);
    }
    for far in [1e3, 1e27, 1e28, 1e35] {
        check::<f32>(&culler, far);
    }
    for far in [1e3, 1e28, 1e270, 1e272, 1e300] {
        check::<f64>(&culler, far);
    }
}

/// A maximum may lose an infinity when it meets NaN; the first invalid sphere is returned all the
/// same.
#[test]
fn the_first_invalid_sphere_is_returned_when_nan_follows_infinity() {
    let axes = [[1.0, 2.0, 2.0], [2.0, 1.0, -2.0], [2.0, -2.0, 1.0]].map(Vec3::from);
    let pose = Pose {
        origin: Vec3::default(),
        axes,
    };
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    let culler = Culler::new(&Frustum::new(pose, Shape::Finite { near, far }).unwrap());
    let infinite = Sphere::new([f32::INFINITY, 0.0, 2.0], 1.0);
    let nan = Sphere::new([0.0, 0.0, f32::NAN], 1.0);
    for distance in [1, 8, 16] {
        let mut all = vec![Sphere::new([0.0, 0.0, 2.0], 0.5); 20];
        (all[1], all[1 + distance]) = (infinite, nan);
        let error = culler.over(&all).classes(&mut Vec::new()).unwrap_err();
        assert_eq!(error.index, 1, "{distance}");
    }
}

/// A box that was far away for a while leaves no trace in the largest magnitude.
#[test]
fn a_replaced_box_no_longer_counts_for_the_largest_magnitude() {
    let at = |x: f32| Aabb::new([x, 0.1, 1.5], [x + 0.1, 0.2, 1.75]);
    let mut set = BoxSet::new((0..700).map(|i| at(0.01 * i as f32))).unwrap();
    let culler = culler_to_3();
    let undecided = |set: &BoxSet<f32>| {
        let mut counts = VolumeCounts::default();
        let query = culler.over(set).counted(&mut counts);
        query.classes(&mut Vec::new()).unwrap();
        counts.undecided
    };
    let before = undecided(&set);
    let own = set.get(600).unwrap();
    set.set(600, at(1e30)).unwrap();
    assert!(undecided(&set) > 180);
    set.set(600, own).unwrap();
    assert_eq!(undecided(&set), before);
    assert!(before < 5, "{before}");
}
