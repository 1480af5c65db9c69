//! What the fuzz targets do with their bytes; each asserts.
//!
//! Bytes are read as decisions (which solid, which features, how many ulp), not
//! as numbers: random doubles are never singular. A byte string that runs out
//! decides everything else with zeros, so every input is a case.

mod build;
mod case;
mod meter;
mod projection;
pub mod readers;
mod slices;
mod volumes;

use arbitrary::Unstructured;
use case::Case;
use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::{Frustum, Real, Segment};
use frusta_lab::{CaseLine, CaseSegment, check};

/// Exact answers about a structured case: all guarantees, in `f64` and `f32`, and
/// from slices the bits of single calls.
pub fn clip(data: &[u8]) {
    let Ok(Some(case)) = Case::new(&mut Unstructured::new(data)) else {
        return;
    };
    check::assert_guarantees(&case.frustum, &case.segment);
    check::assert_guarantees(&case.frustum, &case.in_singles());
    slices::check(&case.frustum, &case.segment);
    slices::check(&case.frustum, &case.in_singles());
    projection::check(&case.frustum, &case.segment);
    projection::check(&case.frustum, &case.in_singles());
}

/// Volumes and batches: exact answers are the oracle's, and those of batches what each volume
/// or segment gets alone.
pub fn volumes(data: &[u8]) {
    if let Ok(Some(case)) = Case::wild(&mut Unstructured::new(data)) {
        volumes::check(&case.frustum, &case.segment);
    }
}

/// Plain answers about any numbers: finite, in order, never a panic; slices as in
/// [`clip`].
pub fn plain(data: &[u8]) {
    let Ok(Some(case)) = Case::wild(&mut Unstructured::new(data)) else {
        return;
    };
    check_plain(&case.frustum, &case.segment);
    check_plain(&case.frustum, &case.in_singles());
    slices::check(&case.frustum, &case.segment);
    slices::check(&case.frustum, &case.in_singles());
    projection::check(&case.frustum, &case.segment);
    projection::check(&case.frustum, &case.in_singles());
}

/// A case as a line: what is written comes back with the same bits, and any text
/// is read or refused in one short line, with the place.
pub fn case_line(data: &[u8]) {
    if let Ok(Some(case)) = Case::wild(&mut Unstructured::new(data)) {
        same_when_read(CaseLine::new(&case.frustum, &case.segment));
        same_when_read(CaseLine::new(&case.frustum, &case.in_singles()));
    }
    let text = String::from_utf8_lossy(data);
    match text.parse::<CaseLine>() {
        Ok(case) => same_when_read(case),
        Err(refusal) => {
            let (message, column) = (refusal.to_string(), refusal.column());
            assert!(
                (1..=text.chars().count() + 1).contains(&column),
                "{message}"
            );
            assert!(
                message.chars().count() < 400 && message.lines().count() == 1,
                "{message}"
            );
        }
    }
}

/// The text has every bit of a case, and says when two differ in a zero's sign. Only
/// finite segments are cases.
fn same_when_read(case: CaseLine) {
    let line = case.to_string();
    let finite = match case.segment {
        CaseSegment::Single(segment) => segment.check_finite().is_ok(),
        CaseSegment::Double(segment) => segment.check_finite().is_ok(),
    };
    let back = line.parse::<CaseLine>();
    assert_eq!(back.is_ok(), finite, "{line}: {back:?}");
    if let Ok(back) = back {
        assert!(back == case && back.to_string() == line, "{line}\n{back}");
    }
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
            projection::check(&frustum, &segment);
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
