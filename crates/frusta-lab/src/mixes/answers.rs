//! Checks, before anything is timed, that all clippers give the same answers.

use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::{Accuracy, Class, FaceSet, Frustum, Real, Segment, SegmentClip};

/// Class, clipped flags and face sets.
fn decided<T: Real>(clip: &SegmentClip<T>) -> (Class, [bool; 2], [FaceSet; 3]) {
    match clip.part {
        None => (clip.class, [false; 2], [FaceSet::EMPTY; 3]),
        Some(p) => (
            clip.class,
            [p.entry.clipped, p.exit.clipped],
            [p.entry.faces, p.exit.faces, p.coplanar],
        ),
    }
}

/// Parameters and points as bits, and whether they are inward.
fn bits<T: Real>(clip: &SegmentClip<T>) -> Option<[([u64; 4], bool); 2]> {
    clip.part.map(|p| {
        [p.entry, p.exit].map(|e| {
            let [x, y, z] = e.point.to_f64().to_array();
            ([e.t.to_f64(), x, y, z].map(f64::to_bits), e.inward)
        })
    })
}

/// All algorithms with exact decisions.
pub fn exact<T: Real>(accuracy: Accuracy) -> [Box<dyn SegmentClipper<T>>; 6] {
    [
        Box::new(LiangBarsky::exact(LiangBarskyVariant::Textbook, accuracy)),
        Box::new(LiangBarsky::exact(LiangBarskyVariant::Tuned, accuracy)),
        Box::new(VwProjection::exact(accuracy)),
        Box::new(CyrusBeck::exact(accuracy)),
        Box::new(CohenSutherland::exact(accuracy)),
        Box::new(SixPlanes::exact(accuracy)),
    ]
}

/// All algorithms in plain arithmetic.
pub fn plain<T: Real>() -> [Box<dyn SegmentClipper<T>>; 6] {
    [
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Textbook)),
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Tuned)),
        Box::new(VwProjection::plain()),
        Box::new(CyrusBeck::plain()),
        Box::new(CohenSutherland::plain()),
        Box::new(SixPlanes::plain()),
    ]
}

/// How many segments each plain algorithm gets wrong: class, clipped flags or
/// face sets.
pub fn wrong_answers<T: Real>(
    frustum: &Frustum,
    segments: &[Segment<T>],
) -> [(&'static str, usize); 6] {
    let exact = VwProjection::default();
    plain::<T>().map(|clipper| {
        let is_wrong = |s: &&Segment<T>| {
            let found = clipper.clip_segment(frustum, s).expect("finite");
            decided(&found) != decided(&exact.clip_segment(frustum, s).expect("finite"))
        };
        (clipper.name(), segments.iter().filter(is_wrong).count())
    })
}

/// Asserts that the exact clippers that are timed decide alike and, to the same
/// accuracy, give the same bits; of the first segments, all exact clippers.
pub fn assert_exact_agree<T: Real>(frustum: &Frustum, segments: &[Segment<T>]) {
    let tuned = LiangBarsky::exact(LiangBarskyVariant::Tuned, Accuracy::Fast);
    for s in segments {
        let fast = frustum.clip_segment(s).expect("finite");
        let other = tuned.clip_segment(frustum, s).expect("finite");
        assert_eq!(decided(&other), decided(&fast), "{s:?}");
        assert_eq!(bits(&other), bits(&fast), "{s:?}");
        for accuracy in [Accuracy::Nearest, Accuracy::Inward] {
            let other = frustum.clip_segment_with(s, accuracy).expect("finite");
            assert_eq!(decided(&other), decided(&fast), "{accuracy:?} on {s:?}");
        }
    }
    let first = &segments[..segments.len().min(1024)];
    assert_all_exact_agree(frustum, first);
}

fn assert_all_exact_agree<T: Real>(frustum: &Frustum, segments: &[Segment<T>]) {
    for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
        let clippers = exact::<T>(accuracy);
        for s in segments {
            let default = frustum.clip_segment(s).expect("finite");
            let first = clippers[0].clip_segment(frustum, s).expect("finite");
            assert_eq!(decided(&first), decided(&default), "{accuracy:?} on {s:?}");
            if accuracy == Accuracy::Fast {
                assert_eq!(bits(&first), bits(&default), "{s:?}");
            }
            for clipper in &clippers[1..] {
                let found = clipper.clip_segment(frustum, s).expect("finite");
                let name = clipper.name();
                assert_eq!(decided(&found), decided(&first), "{name} on {s:?}");
                assert_eq!(bits(&found), bits(&first), "{name} on {s:?}");
            }
        }
    }
}

/// Asserts that all algorithms, plain, decide as the exact tier does, and that
/// their points are within the tolerance, and that the exact tier agrees with
/// itself; counts the classes.
pub fn assert_answers_agree<T: Real>(frustum: &Frustum, segments: &[Segment<T>]) -> [usize; 5] {
    let clippers = plain::<T>();
    let exact = VwProjection::exact(Accuracy::Nearest);
    assert_exact_agree(frustum, segments);
    let mut classes = [0; 5];
    for s in segments {
        let expected = exact.clip_segment(frustum, s).expect("finite");
        classes[expected.class as usize] += 1;
        for clipper in &clippers {
            let found = clipper.clip_segment(frustum, s).expect("finite");
            let name = clipper.name();
            assert_eq!(decided(&found), decided(&expected), "{name} on {s:?}");
            let (Some(a), Some(b)) = (found.points(), expected.points()) else {
                continue;
            };
            let [p, q] = [s.start, s.end].map(|v| v.to_f64());
            let size = p.dot(p).max(q.dot(q)).sqrt();
            for (a, b) in a.into_iter().zip(b) {
                let error = a.to_f64() - b.to_f64();
                // Rounded boundary values move a crossing along the segment by
                // their error over the sine of the angle with the face.
                let tolerance = 2e5 * T::UNIT_ROUNDOFF * size;
                assert!(error.dot(error).sqrt() <= tolerance, "{name} on {s:?}");
            }
        }
    }
    classes
}
