//! Slices of segments through the public interface. That every clip has the bits of the
//! segment alone, at every vector width, is tested in `src/clip/many/tests.rs`.

use frusta::clip::{
    Arithmetic, CohenSutherland, CyrusBeck, IndexError, IndexedEdges, LiangBarsky,
    LiangBarskyVariant, SegmentArrays, SegmentClipper, SegmentIntervals, Segments, SixPlanes,
    VwProjection,
};
use frusta::samples::Family;
use frusta::{
    Accuracy, Axis, Class, Culler, End, Frustum, Segment, SegmentClip, StageCounts, Vec3,
};

/// Every algorithm in every arithmetic.
fn clippers() -> Vec<Box<dyn SegmentClipper<f64>>> {
    let accuracies = [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward];
    let exact = accuracies.map(Arithmetic::Exact);
    let all = [Arithmetic::Plain].into_iter().chain(exact);
    all.flat_map(|arithmetic| {
        let liang_barsky = |variant| LiangBarsky {
            arithmetic,
            variant,
        };
        let clippers: [Box<dyn SegmentClipper<f64>>; 6] = [
            Box::new(VwProjection { arithmetic }),
            Box::new(liang_barsky(LiangBarskyVariant::Textbook)),
            Box::new(liang_barsky(LiangBarskyVariant::Tuned)),
            Box::new(CyrusBeck { arithmetic }),
            Box::new(CohenSutherland { arithmetic }),
            Box::new(SixPlanes { arithmetic }),
        ];
        clippers
    })
    .collect()
}

/// A frustum and some segments of all kinds near it.
fn scene(family: Family, count: u64) -> (Frustum, Vec<Segment<f64>>) {
    let scene = family.scene(5, 0);
    let segments = (0..count).map(|i| family.segment(&scene, 5, i)).collect();
    (scene.frustum().clone(), segments)
}

#[test]
fn every_clipper_clips_slices_of_every_length_as_it_clips_segments() {
    for family in [Family::Random, Family::HalfLattice, Family::Infinite] {
        let (frustum, all) = scene(family, 64);
        for clipper in clippers() {
            let mut clips = vec![SegmentClip::OUTSIDE; 3];
            for length in (0..20).chain([63, 64]) {
                let segments = &all[all.len() - length..];
                let (mut counts, mut alone) = <(StageCounts, StageCounts)>::default();
                let done =
                    clipper.clip_segments_counted(&frustum, segments, &mut clips, &mut counts);
                done.expect("finite");
                let expected: Vec<_> = segments
                    .iter()
                    .map(|s| {
                        clipper
                            .clip_segment_counted(&frustum, s, &mut alone)
                            .expect("finite")
                    })
                    .collect();
                assert_eq!(
                    clips,
                    expected,
                    "{} on {length} of {family}",
                    clipper.name()
                );
                assert_eq!(counts, alone, "{} on {length} of {family}", clipper.name());
            }
        }
    }
}

#[test]
fn a_coordinate_that_is_not_finite_is_an_error_with_its_index_and_there_are_no_clips() {
    let (frustum, all) = scene(Family::Random, 600);
    for clipper in clippers() {
        for (index, later) in [(0, 1), (1, 599), (299, 300), (598, 599)] {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut segments = all.clone();
                segments[later].start.x = f64::NAN;
                segments[index].end.y = value;
                let mut clips = vec![SegmentClip::OUTSIDE; 3];
                let error = clipper
                    .clip_segments(&frustum, &segments, &mut clips)
                    .unwrap_err();
                assert!(clips.is_empty());
                assert_eq!(error.index, index, "{}", clipper.name());
                assert_eq!(
                    (error.found.end, error.found.axis),
                    (Some(End::End), Axis::Y)
                );
                let text = format!(
                    "segment {index}: the segment's end has y = {value}; coordinates must be finite"
                );
                assert_eq!(error.to_string(), text);
            }
        }
    }
}

#[test]
fn magnitudes_at_which_plain_arithmetic_overflows_are_clipped_alone() {
    // Beside small ones, so that lanes differ.
    let (frustum, mut segments) = scene(Family::Random, 64);
    for (i, segment) in segments.iter_mut().enumerate().filter(|(i, _)| i % 3 == 0) {
        segment.end = segment.end * [1e300, 1e305, 1e155][i % 9 / 3];
    }
    let clipper = VwProjection::plain();
    let mut clips = Vec::new();
    clipper
        .clip_segments(&frustum, &segments, &mut clips)
        .expect("finite");
    for (segment, clip) in segments.iter().zip(&clips) {
        assert_eq!(
            *clip,
            clipper.clip_segment(&frustum, segment).expect("finite")
        );
    }
    assert!(clips.iter().any(|clip| clip.class != Class::Outside));
}

#[test]
fn a_frustum_clips_slices_exactly() {
    let (frustum, segments) = scene(Family::Bumps, 64);
    let mut clips = Vec::new();
    for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
        frustum
            .clip_segments(&segments, accuracy, &mut clips)
            .expect("finite");
        for (segment, clip) in segments.iter().zip(&clips) {
            let single = frustum
                .clip_segment_with(segment, accuracy)
                .expect("finite");
            assert_eq!(*clip, single);
        }
    }
}

type Columns = [Vec<f64>; 6];

/// The same segments as arrays of coordinates, and as points that edges share: each point twice,
/// so that indices matter.
fn other_forms(segments: &[Segment<f64>]) -> (Columns, Vec<Vec3<f64>>, Vec<[u32; 2]>) {
    let ends = |s: &Segment<f64>| [s.start, s.end];
    let coordinates = |k: usize| {
        segments
            .iter()
            .map(move |s| ends(s)[k / 3][k % 3])
            .collect()
    };
    let points: Vec<_> = segments.iter().rev().flat_map(ends).collect();
    let last = segments.len() as u32 - 1;
    let edges = (0..=last).map(|i| [2 * (last - i), 2 * (last - i) + 1]);
    (std::array::from_fn(coordinates), points, edges.collect())
}

#[test]
fn arrays_and_indexed_edges_are_clipped_as_slices_are() {
    for count in [1, 255, 256, 257, 700] {
        let (frustum, segments) = scene(Family::HalfLattice, count);
        let (coordinates, points, edges) = other_forms(&segments);
        let [a, b, c, d, e, f] = coordinates.each_ref().map(Vec::as_slice);
        let (start, end) = ([a, b, c], [d, e, f]);
        let edges = IndexedEdges::new(&points, &edges).expect("points exist");
        let forms = [
            Segments::from(&segments),
            Segments::from(SegmentArrays { start, end }),
            Segments::from(edges),
        ];
        let (mut expected, mut clips) = (Vec::new(), Vec::new());
        let (mut intervals, mut once) = <(SegmentIntervals<f64>, SegmentIntervals<f64>)>::default();
        for form in forms {
            assert_eq!((form.len(), form.is_empty()), (segments.len(), false));
            assert_eq!(form.get(0), Some(segments[0]));
            assert_eq!(form.get(segments.len()), None);
            for accuracy in [Accuracy::Fast, Accuracy::Inward] {
                let all = frustum.clip_segments(&segments, accuracy, &mut expected);
                all.expect("finite");
                let all = frustum.clip_segments(form, accuracy, &mut clips);
                all.expect("finite");
                assert_eq!(clips, expected);
            }
            frustum
                .clip_intervals(form, &mut intervals)
                .expect("finite");
            for (i, clip) in expected.iter().enumerate() {
                let (class, t0, t1) = intervals.get(i).expect("one for each");
                let part = clip.part.as_ref();
                let t = part.map_or((1.0, 0.0), |part| (part.entry.t, part.exit.t));
                // `Inward` has other points, and the same class.
                assert_eq!(class, clip.class);
                assert!(part.is_none() == (t0 > t1) && (t0 - t.0).abs() < 1e-9);
                assert!((t1 - t.1).abs() < 1e-9);
            }
            let culler = Culler::new(&frustum);
            culler.clip_intervals(form, &mut once).expect("finite");
            assert_eq!(once.classes(), intervals.classes());
            #[cfg(feature = "parallel")]
            {
                culler.par_clip_intervals(form, &mut once).expect("finite");
                assert_eq!(once.classes(), intervals.classes());
            }
        }
    }
}

#[test]
fn an_edge_at_a_point_that_is_not_finite_is_named() {
    let (frustum, segments) = scene(Family::Random, 600);
    let (_, mut points, edges) = other_forms(&segments);
    points[edges[300][1] as usize].z = f64::NAN;
    let edges = IndexedEdges::new(&points, &edges).expect("points exist");
    let mut clips = vec![SegmentClip::OUTSIDE; 3];
    let error = frustum.clip_segments(edges, Accuracy::Fast, &mut clips);
    let error = error.unwrap_err();
    assert!(clips.is_empty());
    assert_eq!((error.index, error.found.axis), (300, Axis::Z));
    let error = frustum.clip_intervals(edges, &mut SegmentIntervals::default());
    assert_eq!(error.unwrap_err().index, 300);
}

#[test]
fn edges_at_points_that_do_not_exist_are_refused() {
    let points = [Vec3::new(0.0, 0.0, 0.0); 2];
    let error = IndexedEdges::new(&points, &[[0, 1], [1, u32::MAX], [7, 0]]).unwrap_err();
    let expected = IndexError {
        edge: 1,
        point: u32::MAX,
        points: 2,
    };
    assert_eq!(error, expected);
    assert!(
        IndexedEdges::<f64>::new(&[], &[])
            .expect("no edges")
            .is_empty()
    );
    assert_eq!(
        IndexedEdges::<f64>::new(&[], &[[0, 0]]).unwrap_err().edge,
        0
    );
}
