//! Clipping and culling allocate nothing, except where big integers are needed.

use frusta_lab::mixes;

use frusta::clip::SegmentClipper;
use frusta::cull::{BoxSet, ContainmentMasks, RelativeBoxes, VolumeSource};
use frusta::samples::{BLOCK, Family, Placement, Random, Solid, singular_samples};
use frusta::{
    Aabb, Accuracy, Camera, ClipSpace, Culler, Frustum, Pose, Projection, Real, Segment, Sphere,
    StageCounts, Vec3, VolumeCounts,
};
use mixes::answers::{exact, plain};
use mixes::{Form, Mix, frustum};

const ACCURACIES: [Accuracy; 3] = [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward];

/// Of the benchmarks' segments. (Of all, clipped to each accuracy 63 million
/// times, four need big integers to round a coordinate almost half way.)
const SOME: usize = 4096;

/// Allocations while a segment is clipped, and what it needed.
fn clip<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
) -> (u64, StageCounts) {
    let mut counts = StageCounts::default();
    let info = allocation_counter::measure(|| {
        let clipped = frustum.clip_segment_counted(segment, accuracy, &mut counts);
        assert!(clipped.is_ok());
    });
    (info.count_total, counts)
}

/// How many segments were clipped without and with allocations.
#[derive(Debug, Default)]
struct Tally {
    without: u64,
    with: u64,
}

impl Tally {
    fn add<T: Real>(&mut self, frustum: &Frustum, segment: &Segment<T>) {
        for accuracy in ACCURACIES {
            let (allocations, counts) = clip(frustum, segment, accuracy);
            if allocations == 0 {
                self.without += 1;
            } else {
                assert!(
                    counts.integers > 0,
                    "{accuracy:?}\n{frustum:?}\n{segment:?}"
                );
                self.with += 1;
            }
        }
    }
}

#[test]
fn the_counter_counts() {
    let info = allocation_counter::measure(|| drop(std::hint::black_box(vec![1, 2, 3])));
    assert_eq!(info.count_total, 1);
}

/// Asserts that clippers allocate nothing, for segments and for slices.
#[track_caller]
fn assert_none<T: Real>(
    clippers: &[Box<dyn SegmentClipper<T>>],
    frustum: &Frustum,
    segments: &[Segment<T>],
) {
    for clipper in clippers {
        for segment in segments {
            let info = allocation_counter::measure(|| {
                assert!(clipper.clip_segment(frustum, segment).is_ok());
            });
            assert_eq!(info.count_total, 0, "{} on {segment:?}", clipper.name());
        }
        // In a buffer that was used before.
        let mut clips = Vec::with_capacity(segments.len());
        let info = allocation_counter::measure(|| {
            assert!(clipper.clip_segments(frustum, segments, &mut clips).is_ok());
        });
        assert_eq!(info.count_total, 0, "{} on a slice", clipper.name());
    }
}

/// The 78 at a placement, each once.
fn samples<T: Real>(placement: &Placement) -> (Frustum, Vec<Segment<T>>) {
    let solid = Solid::SYMMETRIC;
    let placed = |s: Segment<f64>| {
        let s = placement.segment(&s);
        Segment::new(Vec3::from_f64(s.start), Vec3::from_f64(s.end))
    };
    let all = singular_samples(&solid);
    let segments = all.iter().map(|sample| placed(sample.segment)).collect();
    (placement.place(&solid).unwrap(), segments)
}

#[test]
fn realistic_mixes_allocate_nothing() {
    let mut tally = Tally::default();
    for (_, pose) in Mix::poses() {
        for form in Form::ALL {
            let frustum = frustum(form.shape(), &pose);
            for mix in Mix::ALL {
                for segment in mix.segments::<f64>(SOME, &pose) {
                    tally.add(&frustum, &segment);
                }
                for segment in mix.segments::<f32>(SOME, &pose) {
                    tally.add(&frustum, &segment);
                }
            }
        }
    }
    assert!(tally.without > 500_000, "{tally:?}");
    assert_eq!(tally.with, 0, "{tally:?}");
}

/// Every algorithm, plain and with exact decisions.
#[test]
fn no_algorithm_allocates_on_realistic_mixes() {
    fn mix<T: Real>(form: Form, pose: &Pose, mix: Mix) {
        let (frustum, segments) = (frustum(form.shape(), pose), mix.segments::<T>(SOME, pose));
        assert_none(&plain(), &frustum, &segments);
        assert_none(&exact(Accuracy::Fast), &frustum, &segments);
    }
    for (_, pose) in Mix::poses() {
        for form in Form::ALL {
            for which in Mix::ALL {
                mix::<f64>(form, &pose, which);
                mix::<f32>(form, &pose, which);
            }
        }
    }
}

/// Touching and running along faces costs no allocation where the coordinates
/// are a designer's.
#[test]
fn the_singular_samples_allocate_nothing() {
    fn at<T: Real>(placement: &Placement) {
        let (frustum, segments) = samples::<T>(placement);
        assert_none(&plain(), &frustum, &segments);
        assert_none(&exact(Accuracy::Fast), &frustum, &segments);
        let mut tally = Tally::default();
        for segment in &segments {
            tally.add(&frustum, segment);
            let (_, counts) = clip(&frustum, segment, Accuracy::Fast);
            assert_eq!(counts.integers, 0, "{segment:?}");
        }
        assert_eq!(tally.with, 0, "{tally:?}");
    }
    for placement in [Placement::IDENTITY, Placement::rotated([1, 2, 2, 4])] {
        at::<f64>(&placement);
        at::<f32>(&placement);
    }
}

/// Plain arithmetic needs no integers, whatever the input.
#[test]
fn no_plain_algorithm_allocates_in_any_family() {
    fn block<T: Real>(family: Family, block: u64) {
        let scene = family.scene(5, block);
        let cases = block * BLOCK..(block + 1) * BLOCK;
        let segments: Vec<_> = cases
            .map(|index| family.segment::<T>(&scene, 5, index))
            .collect();
        assert_none(&plain(), scene.frustum(), &segments);
    }
    for &family in Family::ALL {
        for number in 0..2 {
            block::<f64>(family, number);
            if family.has_f32() {
                block::<f32>(family, number);
            }
        }
    }
}

#[test]
fn only_big_integers_allocate_in_any_family() {
    let mut tally = Tally::default();
    for &family in Family::ALL {
        for block in 0..2 {
            let scene = family.scene(5, block);
            for index in block * BLOCK..(block + 1) * BLOCK {
                tally.add(scene.frustum(), &family.segment::<f64>(&scene, 5, index));
            }
        }
    }
    assert!(tally.without > tally.with, "{tally:?}");
    // Some families exist to need integers.
    assert!(tally.with > 100, "{tally:?}");
}

/// A frustum and a culler of each shadow's matrix, each frame, without a byte: perspective, reversed to infinity, parallel.
#[test]
fn frusta_from_matrices_and_cullers_allocate_nothing() {
    let projections = [
        Projection::Perspective {
            fovy: 1.0,
            aspect: 1.5,
        },
        Projection::Orthographic {
            height: 30.0,
            aspect: 1.0,
        },
    ];
    let mut random = Random::new(&[14]);
    let mut point = |reach: f64| Vec3::from([(); 3].map(|()| random.between(-reach, reach)));
    for i in 0..500 {
        let (eye, ahead) = (point(100.0), point(1.0));
        let (clip, far) = match i % 4 {
            0 => (ClipSpace::ZERO_TO_ONE.reversed(), f64::INFINITY),
            _ => (ClipSpace::ZERO_TO_ONE, 80.0),
        };
        let projection = projections[usize::from(i % 4 > 1)];
        let camera = Camera::new(eye, eye + ahead, [0.0, 1.0, 0.0], projection, 0.1, far);
        let matrix = camera.view_projection(clip).unwrap().to_f32();
        let boxes: Vec<Aabb<f32>> = (0..300)
            .map(|_| Aabb::from_center(Vec3::<f32>::from_f64(point(120.0)), [1.0; 3]))
            .collect();
        let mut visible = Vec::with_capacity(boxes.len());
        let info = allocation_counter::measure(|| {
            let found = matrix.frustum(clip).unwrap();
            Culler::new(&found.frustum)
                .over(&boxes)
                .visible(&mut visible)
                .unwrap();
        });
        assert_eq!(info.count_total, 0, "{camera:?}");
    }
}

/// Queries over many volumes, from every kind of source, write to buffers that were used before.
#[test]
fn queries_over_many_volumes_allocate_nothing() {
    fn assert_query<S: VolumeSource + Copy>(culler: &Culler, source: S, count: usize) {
        let mut indices = Vec::with_capacity(count);
        let (mut classes, mut masks) = (Vec::new(), ContainmentMasks::default());
        let mut counts = VolumeCounts::default();
        let mut pass = || {
            let query = culler.over(source).counted(&mut counts);
            assert!(query.visible(&mut indices).is_ok());
            assert!(culler.over(source).classes(&mut classes).is_ok());
            assert!(culler.over(source).masks(&mut masks).is_ok());
        };
        pass();
        assert_eq!(allocation_counter::measure(pass).count_total, 0);
        assert_eq!(classes.len(), count);
        assert_eq!(counts.integers, 0);
    }
    fn each_source<T: Real>(culler: &Culler, segments: &[Segment<T>]) {
        let around = |s: &Segment<T>| Aabb::around([s.start, s.end]);
        let boxes: Vec<Aabb<T>> = segments.iter().filter_map(around).collect();
        let sphere = |s: &Segment<T>| Sphere::new(s.start, T::from_f64(0.125));
        let spheres: Vec<Sphere<T>> = segments.iter().map(sphere).collect();
        let set = BoxSet::new(boxes.iter().copied()).unwrap();
        assert_query(culler, &boxes, boxes.len());
        assert_query(culler, &set, boxes.len());
        assert_query(culler, &spheres, spheres.len());
        let wide: Vec<Aabb<f64>> = boxes.iter().map(|b| b.to_f64()).collect();
        let anchor = wide[0].min;
        let relative = RelativeBoxes::new(anchor, &wide).unwrap();
        assert_query(culler, &relative, wide.len());
    }
    let pose = Pose::IDENTITY;
    let culler = Culler::new(&frustum(Form::Symmetric.shape(), &pose));
    for mix in Mix::ALL {
        each_source::<f64>(&culler, &mix.segments(SOME, &pose));
        each_source::<f32>(&culler, &mix.segments(SOME, &pose));
    }
}
