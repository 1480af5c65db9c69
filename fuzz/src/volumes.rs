//! Volumes made from a case's segment, compared with integers; and queries over many volumes
//! compared with one at a time.

use frusta::clip::{SegmentArrays, SegmentIntervals, Segments};
use frusta::cull::{BoxArrays, BoxSet, ContainmentMasks, RelativeBoxes, VolumeSource};
use frusta::oracle::Oracle;
use frusta::{
    Aabb, Class, Containment, Culler, Frustum, Obb, Real, Segment, Sphere, Vec3, Volume,
    VolumeErrorAt,
};

/// Everything about a frustum and the volumes that a segment suggests.
pub(crate) fn check(frustum: &Frustum, segment: &Segment<f64>) {
    let culler = Culler::new(frustum);
    let oracle = Oracle::new(frustum);
    let boxes = boxes(segment);
    for volume in boxes
        .iter()
        .map(|b| Volume::from(*b))
        .chain(others(segment))
    {
        check_volume(&culler, &oracle, volume);
    }
    check_boxes(&culler, &boxes);
    check_boxes(&culler, &self::boxes(&in_f32(segment)));
    check_relative(&culler, segment.start, &boxes);
    check_segments(&culler, segment);
    check_segments(&culler, &in_f32(segment));
}

fn in_f32(segment: &Segment<f64>) -> Segment<f32> {
    let [a, b] = [segment.start, segment.end].map(Vec3::<f32>::from_f64);
    Segment::new(a, b)
}

/// The segment's bounding box, its ends, and at times a box that may be invalid.
fn boxes<T: Real>(segment: &Segment<T>) -> Vec<Aabb<T>> {
    let Segment { start, end } = *segment;
    let mut all = vec![Aabb::new(start, start), Aabb::new(end, end)];
    all.extend(Aabb::around([start, end]));
    match segment.start.x.to_f64().to_bits() % 8 {
        1 => all.push(Aabb::new(start, end)),
        2 => {
            let infinity = T::from_f64(f64::INFINITY);
            all.extend([Aabb::EMPTY, Aabb::UNBOUNDED]);
            all.push(Aabb::new(start, [infinity, end.y, infinity]));
            all.push(Aabb::new(
                [-infinity, start.y, start.z],
                [end.x, end.y, infinity],
            ));
        }
        _ => {}
    }
    all
}

/// Spheres around one end that reach as far as a coordinate of the other, and boxes along it.
fn others(segment: &Segment<f64>) -> Vec<Volume> {
    let d = segment.end - segment.start;
    let mut all: Vec<Volume> = [d.x, d.y, d.z]
        .map(|r| Sphere::new(segment.start, r.abs()).into())
        .into();
    let half = Vec3::new(d.y, d.z, d.x) * 0.5;
    let axes = [d * 0.25, Vec3::new(-d.y, d.x, 0.0), half];
    all.push(Obb::new(segment.end, axes).into());
    all
}

fn check_volume(culler: &Culler, oracle: &Oracle, volume: Volume) {
    let found = culler.classify(volume);
    assert_eq!(found.is_ok(), volume.check().is_ok(), "{volume:?}");
    if let Ok(found) = found {
        let frustum = culler.frustum();
        assert_eq!(found, oracle.classify(&volume), "{volume:?}\n{frustum:?}");
        let exact = culler.classify_exact(volume).expect("a valid volume");
        let meets = oracle.intersects(&volume);
        assert_eq!(
            exact != Containment::Outside,
            meets,
            "{volume:?}\n{frustum:?}"
        );
        assert!(!meets || exact == found, "{volume:?}\n{frustum:?}");
    }
}

/// Long enough for every lane of a register, and at times for more than a block.
fn repeated<V: Clone>(some: &[V]) -> Vec<V> {
    let length = if some.len() % 2 == 0 {
        530
    } else {
        9 + some.len()
    };
    some.iter().cycle().take(length).cloned().collect()
}

fn check_boxes<T: Real>(culler: &Culler, some: &[Aabb<T>]) {
    let boxes = repeated(some);
    let expected: Result<Vec<Containment>, VolumeErrorAt> = (boxes.iter().enumerate())
        .map(|(index, b)| {
            culler
                .classify(*b)
                .map_err(|error| VolumeErrorAt { index, error })
        })
        .collect();
    let column = |of: fn(&Aabb<T>) -> T| -> Vec<T> { boxes.iter().map(of).collect() };
    let low = [
        column(|b| b.min.x),
        column(|b| b.min.y),
        column(|b| b.min.z),
    ];
    let high = [
        column(|b| b.max.x),
        column(|b| b.max.y),
        column(|b| b.max.z),
    ];
    let arrays = BoxArrays {
        min: low.each_ref().map(Vec::as_slice),
        max: high.each_ref().map(Vec::as_slice),
    };
    let set = BoxSet::new(boxes.iter().copied());
    assert_eq!(set.is_ok(), expected.is_ok());
    check_source(culler, arrays, &expected);
    check_source(culler, &boxes, &expected);
    if let Ok(set) = &set {
        check_source(culler, set, &expected);
    }
}

fn check_source<S: VolumeSource + Copy>(
    culler: &Culler,
    source: S,
    expected: &Result<Vec<Containment>, VolumeErrorAt>,
) {
    let (mut masks, mut list, mut classes) = (ContainmentMasks::default(), vec![], vec![]);
    let done = [
        culler.over(source).masks(&mut masks),
        culler.over(source).visible(&mut list),
        culler.over(source).classes(&mut classes),
    ];
    match expected {
        Err(error) => {
            let indices = done.map(|done| done.map_err(|e| e.index));
            assert_eq!(indices, [Err(error.index); 3]);
            assert!(masks.is_empty() && list.is_empty() && classes.is_empty());
        }
        Ok(expected) => {
            assert!(done.iter().all(Result::is_ok), "{done:?}");
            assert_eq!(&classes, expected, "{:?}", culler.frustum());
            let of_masks = (0..expected.len()).map(|i| masks.get(i));
            assert!(of_masks.eq(expected.iter().map(|c| Some(*c))));
            assert!(masks.visible().eq(list.iter().map(|&i| i as usize)));
        }
    }
}

/// In `f32` relative to an anchor, which changes no answer.
fn check_relative(culler: &Culler, anchor: Vec3<f64>, boxes: &[Aabb<f64>]) {
    if let Ok(relative) = RelativeBoxes::new(anchor, &repeated(boxes)) {
        let expected = relative.boxes().iter().map(|b| culler.classify(*b));
        let expected = expected.collect::<Result<_, _>>();
        let expected = expected.map_err(|error| VolumeErrorAt { index: 0, error });
        check_source(culler, &relative, &expected);
    }
}

/// Intervals compared with single clips, to the bit.
fn check_segments<T: Real>(culler: &Culler, segment: &Segment<T>) {
    let Segment { start, end } = *segment;
    let segments = [*segment, Segment::new(end, start), Segment::new(end, end)];
    let segments = repeated(&segments);
    let column = |of: fn(&Segment<T>) -> T| -> Vec<T> { segments.iter().map(of).collect() };
    let starts = [
        column(|s| s.start.x),
        column(|s| s.start.y),
        column(|s| s.start.z),
    ];
    let ends = [
        column(|s| s.end.x),
        column(|s| s.end.y),
        column(|s| s.end.z),
    ];
    let arrays = SegmentArrays {
        start: starts.each_ref().map(Vec::as_slice),
        end: ends.each_ref().map(Vec::as_slice),
    };
    let mut intervals = SegmentIntervals::default();
    for layout in [Segments::from(arrays), Segments::from(&segments)] {
        let done = culler.clip_intervals(layout, &mut intervals);
        let first = segments.iter().position(|s| s.check_finite().is_err());
        assert_eq!(done.as_ref().err().map(|e| e.index), first);
        assert_eq!(
            intervals.len(),
            if first.is_some() { 0 } else { segments.len() }
        );
        for (segment, found) in segments.iter().zip(intervals.iter()) {
            let clip = culler.frustum().clip_segment(segment).expect("finite");
            let part = clip.part.map(|p| (clip.class, p.entry.t, p.exit.t));
            let expected = part.unwrap_or((Class::Outside, T::ONE, T::ZERO));
            let case = (segment, culler.frustum());
            assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{case:?}");
        }
    }
}
