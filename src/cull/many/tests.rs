//! Batches against one volume at a time, at every vector width.

use super::*;
use crate::clip::Class;
use crate::cull::{Aabb, Sphere, VolumeError};
use crate::frustum::Frustum;
use crate::frustum::eval::planes::FacePlanes;
use crate::frustum::{Direction, EndRect, Shape};
use crate::math::{Pose, Rect};
use crate::math::{Segment, Vec3};
use crate::samples::{BLOCK, Family};
use crate::simd::levels;

/// Boxes between the ends of a family's segments, which are near faces, edges and corners.
fn boxes<T: Real>(segments: &[Segment<T>]) -> Vec<Aabb<T>> {
    let around = |s: &Segment<T>| Aabb::around([s.start, s.end]);
    let mut all: Vec<_> = segments.iter().filter_map(around).collect();
    // Points, too.
    let points = segments.iter().map(|s| Aabb::new(s.end, s.end));
    all.extend(points.take(9));
    all
}

/// SphereSeparation about one end that reach as far as the other in one coordinate.
fn spheres<T: Real>(segments: &[Segment<T>]) -> Vec<Sphere<T>> {
    let ball = |s: &Segment<T>| Sphere::new(s.start, (s.end.z - s.start.z).abs());
    let finite = |s: &Sphere<T>| s.radius.is_finite();
    segments.iter().map(ball).filter(finite).collect()
}

/// The segments of a scene, repeated from different places, so that every place in a register
/// is taken by all.
fn segments<T: Real>(family: Family, block: u64) -> (Frustum, Vec<Segment<T>>) {
    let scene = family.scene(7, block);
    let cases = block * BLOCK..(block + 1) * BLOCK;
    let some: Vec<Segment<T>> = cases.map(|i| family.segment(&scene, 7, i)).collect();
    let many = (0..9).flat_map(|k| &some[k..]).copied().collect();
    (scene.frustum().clone(), many)
}

/// All three kinds of output of a lot are what single answers are, at every width.
macro_rules! comparison {
    ($name:ident, $t:ident, $lot:ident, $kernel:ident, $item:ident, $rows:ident) => {
        fn $name(culler: &Culler, lot: $lot<'_, $t>, volumes: &[$item<$t>]) {
            let single = |v: &$item<$t>| culler.classify(*v).expect("a volume");
            let expected: Vec<Containment> = volumes.iter().map(single).collect();
            let seen = |(i, c): (usize, &Containment)| (*c != Containment::Outside).then_some(i);
            let visible: Vec<usize> = expected.iter().enumerate().filter_map(seen).collect();
            for level in levels() {
                let mut counts = VolumeCounts::default();
                let (mut masks, mut classes, mut list) =
                    (ContainmentMasks::default(), Vec::new(), Vec::new());
                let rows = culler.rows().$rows();
                fn drive<'a>(
                    culler: &'a Culler,
                    rows: &'a FacePlanes<$t>,
                    lot: &'a $lot<'a, $t>,
                    counts: &'a mut VolumeCounts,
                ) -> BlockDriver<'a, $t, $lot<'a, $t>> {
                    BlockDriver {
                        culler,
                        rows,
                        lot,
                        counts,
                    }
                }
                let to_masks = drive(culler, rows, &lot, &mut counts);
                block_driver::$kernel(level, to_masks, &mut masks.prepare(volumes.len())).unwrap();
                let to_classes = drive(culler, rows, &lot, &mut counts);
                classes.resize(volumes.len(), Containment::Crossing);
                block_driver::$kernel(level, to_classes, &mut Classes(&mut classes)).unwrap();
                list.clear();
                let numbers = &mut Numbers::new(&mut list, 0);
                block_driver::$kernel(level, drive(culler, rows, &lot, &mut counts), numbers)
                    .unwrap();
                assert_eq!(classes.len(), expected.len());
                for (i, (class, expected)) in classes.iter().zip(&expected).enumerate() {
                    assert_eq!(class, expected, "{:?} {:?}", culler.frustum(), volumes[i]);
                    assert_eq!(masks.get(i), Some(*expected));
                }
                assert_eq!(masks.get(expected.len()), None);
                assert!(masks.visible().eq(visible.iter().copied()));
                let list = list.iter().map(|&i: &u32| i as usize);
                assert!(list.eq(visible.iter().copied()));
            }
        }
    };
}

comparison!(box_singles_agree, f32, Boxes, singles, Aabb, single);
comparison!(box_doubles_agree, f64, Boxes, doubles, Aabb, double);
comparison!(ball_singles_agree, f32, Spheres, singles, Sphere, single);
comparison!(ball_doubles_agree, f64, Spheres, doubles, Sphere, double);

fn column<T: Copy, V>(volumes: &[V], number: impl Fn(&V) -> T) -> Vec<T> {
    volumes.iter().map(number).collect()
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
    // What is none is not let in.
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
            with_layouts(&all, |lot| box_doubles_agree(&culler, lot, &all));
            if family.has_f32() {
                let all = boxes(&self::segments::<f32>(*family, block).1);
                with_layouts(&all, |lot| box_singles_agree(&culler, lot, &all));
            }
        }
    }
}

#[test]
fn balls_are_classified_as_they_are_alone() {
    for family in Family::ALL {
        for block in 0..6 {
            let (frustum, segments) = segments::<f64>(*family, block);
            let (culler, all) = (Culler::new(&frustum), spheres(&segments));
            ball_doubles_agree(&culler, Spheres::from(&all), &all);
            if family.has_f32() {
                let all = spheres(&self::segments::<f32>(*family, block).1);
                let center = [0, 1, 2].map(|k| column(&all, |s| s.center[k]));
                let arrays = SphereArrays {
                    center: center.each_ref().map(Vec::as_slice),
                    radius: &column(&all, |s| s.radius),
                };
                ball_singles_agree(&culler, arrays.into(), &all);
            }
        }
    }
}

/// A frustum from z = 1 to z = 3.
fn culler() -> Culler {
    Culler::new(&Family::Random.scene(1, 0).frustum().clone())
}

#[test]
fn any_number_of_boxes() {
    let (frustum, segments) = segments::<f32>(Family::HalfLattice, 1);
    let (culler, all) = (Culler::new(&frustum), boxes(&segments));
    for length in (0..140).chain(500..530).chain([1023, 1024, 1025]) {
        let some = &all[..length.min(all.len())];
        with_layouts(some, |lot| box_singles_agree(&culler, lot, some));
    }
}

#[test]
fn what_is_no_volume_is_named_and_nothing_is_left() {
    let unit = Aabb::new([0.0_f32; 3], [1.0; 3]);
    let bad = [
        (Aabb::new([0.0, f32::NAN, 0.0], [1.0; 3]), "min.y = NaN"),
        (
            Aabb::new([0.0; 3], [1.0, 1.0, f32::INFINITY]),
            "max.z = inf",
        ),
        (
            Aabb::new([f32::NEG_INFINITY, 0.0, 0.0], [1.0; 3]),
            "min.x = -inf",
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
            with_layouts(&all, |lot| {
                let (mut masks, mut classes, mut list) = Default::default();
                culler()
                    .classify_boxes(&[unit; 3][..], &mut classes)
                    .unwrap();
                let errors = [
                    culler().mask_boxes(lot, &mut masks).unwrap_err(),
                    culler().classify_boxes(lot, &mut classes).unwrap_err(),
                    culler().visible_boxes(lot, &mut list).unwrap_err(),
                ];
                for error in errors {
                    assert_eq!(error.index, index);
                    assert!(error.to_string().contains(why), "{error}");
                }
                assert!(masks.is_empty() && masks.outside().is_empty());
                assert!(classes.is_empty() && list.is_empty());
            });
        }
    }
    let mut balls = vec![Sphere::new([0.0_f64; 3], 1.0); 70];
    balls[66].radius = -0.5;
    let error = culler()
        .classify_spheres(&balls, &mut Vec::new())
        .unwrap_err();
    assert_eq!(error.error, VolumeError::NegativeRadius { radius: -0.5 });
    assert_eq!(error.index, 66);
}

/// Most of an everyday scene is settled in registers: a batch is no loop over single calls.
#[test]
fn few_are_asked_for_one_by_one() {
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
    culler
        .classes(&Boxes::from(&boxes), &mut Vec::new(), &mut counts)
        .unwrap();
    assert_eq!(counts.filter_failures, 0, "beyond the filter in f64");
    assert!(counts.unsettled < 16, "{}", counts.unsettled);
    // And what touches is asked for.
    let near = frustum.corners().near[0];
    let touching = [Aabb::new(near, near); 40];
    let mut counts = VolumeCounts::default();
    culler
        .classes(&Boxes::from(&touching[..]), &mut Vec::new(), &mut counts)
        .unwrap();
    assert_eq!(counts.unsettled, 40);
}

/// Millimetres on the earth, in a frustum of a hundredth of a radian, and 1e18 metres away: the
/// doubles' answers, few of them from the doubles.
#[test]
fn relative_boxes_are_classified_as_their_doubles() {
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
        culler.classify_relative_counted(&relative, &mut classes, &mut counts);
        let mut seen = [0; 3];
        for (volume, class) in boxes.iter().zip(&classes) {
            assert_eq!(culler.classify(*volume), Ok(*class), "{volume:?}");
            seen[*class as usize] += 1;
        }
        assert!(seen.iter().all(|&n| n > 20), "{seen:?}");
        assert!(counts.unsettled < 1000, "{}", counts.unsettled);
    }
    let wrong = RelativeBoxes::new([0.0, f64::NAN, 0.0], &[]).unwrap_err();
    assert!(wrong.to_string().contains("anchor"), "{wrong}");
    let empty = Aabb::new([1.0; 3], [0.0; 3]);
    assert!(RelativeBoxes::new([0.0; 3], &[empty]).is_err());
}

/// Found by fuzzing: where there is no far face one stood at 2^90, or 2^900 for doubles.
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
        culler.classify_boxes(&boxes[..], &mut classes).unwrap();
        assert_eq!(classes, [Containment::Inside; 3]);
        culler.classify_spheres(&spheres[..], &mut classes).unwrap();
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

/// A maximum forgets an infinity when it meets NaN; the first ball that is none is told all the
/// same.
#[test]
fn the_first_ball_that_is_none_is_told_when_nan_follows_infinity() {
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
    for apart in [1, 8, 16] {
        let mut all = vec![Sphere::new([0.0, 0.0, 2.0], 0.5); 20];
        (all[1], all[1 + apart]) = (infinite, nan);
        let error = culler.classify_spheres(&all, &mut Vec::new()).unwrap_err();
        assert_eq!(error.index, 1, "{apart}");
    }
}

/// A box that was far away for a while leaves nothing behind.
#[test]
fn a_set_forgets_how_far_away_a_box_was() {
    let at = |x: f32| Aabb::new([x, 0.1, 1.5], [x + 0.1, 0.2, 1.75]);
    let mut set = BoxSet::new((0..700).map(|i| at(0.01 * i as f32))).unwrap();
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    let shape = Shape::Finite { near, far };
    let culler = Culler::new(&Frustum::new(Pose::IDENTITY, shape).unwrap());
    let unsettled = |set: &BoxSet<f32>| {
        let mut counts = VolumeCounts::default();
        culler
            .classify_boxes_counted(set, &mut Vec::new(), &mut counts)
            .unwrap();
        counts.unsettled
    };
    let before = unsettled(&set);
    let own = set.get(600).unwrap();
    set.set(600, at(1e30)).unwrap();
    assert!(unsettled(&set) > 180);
    set.set(600, own).unwrap();
    assert_eq!(unsettled(&set), before);
    assert!(before < 5, "{before}");
}
