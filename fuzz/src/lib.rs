//! What the fuzz targets do with their bytes; each asserts.
//!
//! Bytes are read as decisions (which solid, which features, how many ulp), not
//! as numbers: random doubles are never singular. A byte string that runs out
//! decides everything else with zeros, so every input is a case.

mod build;
mod case;
#[path = "../../tests/check/mod.rs"]
mod check;

use arbitrary::Unstructured;
use case::Case;
use frusta::{
    CohenSutherland, CyrusBeck, Frustum, LiangBarsky, LiangBarskyVariant, Real, Segment,
    SegmentClipper, SixPlanes, VwProjection,
};

/// Exact answers about a structured case: all guarantees, in `f64` and `f32`.
pub fn clip(data: &[u8]) {
    let Ok(Some(case)) = Case::new(&mut Unstructured::new(data)) else {
        return;
    };
    check::assert_guarantees(&case.frustum, &case.segment);
    check::assert_guarantees(&case.frustum, &case.in_singles());
}

/// Plain answers about any numbers: finite, in order, never a panic.
pub fn plain(data: &[u8]) {
    let Ok(Some(case)) = Case::wild(&mut Unstructured::new(data)) else {
        return;
    };
    check_plain(&case.frustum, &case.segment);
    check_plain(&case.frustum, &case.in_singles());
}

/// Constructors given any numbers; what they make must be usable.
pub fn constructors(data: &[u8]) {
    let mut u = Unstructured::new(data);
    let Ok(Some(frustum)) = build::any(&mut u) else {
        return;
    };
    let [a, b] = [[0.0; 3], [1.0; 3]].map(frusta::Vec3::from);
    let middle = build::middle(&frustum);
    for segment in [
        Segment::new(a, b),
        Segment::new(middle, a),
        Segment::new(middle, middle),
    ] {
        if segment.check_finite().is_ok() {
            check::assert_guarantees(&frustum, &segment);
            check_plain(&frustum, &segment);
        }
    }
}

fn check_plain<T: Real>(frustum: &Frustum, segment: &Segment<T>) {
    let clippers: [Box<dyn SegmentClipper<T>>; 6] = [
        Box::new(VwProjection::plain()),
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Textbook)),
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Tuned)),
        Box::new(SixPlanes::plain()),
        Box::new(CyrusBeck::plain()),
        Box::new(CohenSutherland::plain()),
    ];
    let finite = segment.check_finite().is_ok();
    for clipper in clippers {
        let name = clipper.name();
        let said = || format!("{name}\n{frustum:?}\n{segment:?}");
        let answer = clipper.clip_segment(frustum, segment);
        assert_eq!(answer.is_ok(), finite, "{}", said());
        let Some(part) = answer.ok().and_then(|a| a.part) else {
            continue;
        };
        let (entry, exit) = (part.entry, part.exit);
        let ordered = T::ZERO <= entry.t && entry.t <= exit.t && exit.t <= T::ONE;
        assert!(ordered, "{part:?}\n{}", said());
        for (end, own) in [(entry, segment.start), (exit, segment.end)] {
            assert!(end.point.is_finite(), "{part:?}\n{}", said());
            assert!(end.clipped || end.point == own, "{part:?}\n{}", said());
        }
    }
}
