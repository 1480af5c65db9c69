//! Checks a segment's answers against every guarantee at once: the oracle's
//! truth, the swapped segment, the answer's own clip, and all algorithms.
//!
//! Tests and fuzz targets share it, so that a finding and its regression test check the same.

use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::oracle::{Oracle, check_idempotent, check_swapped};
use frusta::{Accuracy, Frustum, Part, PartEnd, Real, Segment, SegmentClip};

/// Every accuracy.
pub const ACCURACIES: [Accuracy; 3] = [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward];

/// Every algorithm in the exact tier.
pub fn exact_clippers<T: Real>(accuracy: Accuracy) -> [Box<dyn SegmentClipper<T>>; 6] {
    [
        Box::new(VwProjection::exact(accuracy)),
        Box::new(LiangBarsky::exact(LiangBarskyVariant::Textbook, accuracy)),
        Box::new(LiangBarsky::exact(LiangBarskyVariant::Tuned, accuracy)),
        Box::new(SixPlanes::exact(accuracy)),
        Box::new(CyrusBeck::exact(accuracy)),
        Box::new(CohenSutherland::exact(accuracy)),
    ]
}

/// An answer as bits, which distinguish the signs of zeros, unlike `==`.
pub fn bits<T: Real>(answer: &SegmentClip<T>) -> Vec<u64> {
    let end = |e: &PartEnd<T>| {
        let [x, y, z] = e.point.to_f64().to_array().map(f64::to_bits);
        let flags =
            u64::from(e.faces.bits()) << 2 | u64::from(e.clipped) << 1 | u64::from(e.inward);
        [e.t.to_f64().to_bits(), x, y, z, flags]
    };
    let part = |p: &Part<T>| {
        [
            &end(&p.entry)[..],
            &end(&p.exit),
            &[p.coplanar.bits().into()],
        ]
        .concat()
    };
    let mut all = vec![answer.class as u64];
    all.extend(answer.part.iter().flat_map(part));
    all
}

/// All faults of the exact answers to a segment, as text.
///
/// A segment that is not finite must be refused, naming what is wrong.
pub fn guarantees<T: Real>(frustum: &Frustum, segment: &Segment<T>) -> Vec<String> {
    let mut found = Vec::new();
    let refusal = segment.check_finite().err();
    let oracle = Oracle::new(frustum);
    let truth = oracle.clip(segment).ok();
    for accuracy in ACCURACIES {
        let clip = |s: &Segment<T>| frustum.clip_segment_with(s, accuracy);
        let answer = match (clip(segment), &truth) {
            (Ok(answer), Some(truth)) => {
                let broken = oracle.check(truth, segment, accuracy, &answer);
                found.extend(broken.iter().map(|v| format!("{accuracy:?}: {v}")));
                answer
            }
            (answer, _) => {
                for clipper in exact_clippers::<T>(accuracy) {
                    let error = clipper.clip_segment(frustum, segment).err();
                    if format!("{error:?}") != format!("{refusal:?}") {
                        found.push(format!("{}: {error:?}, not {refusal:?}", clipper.name()));
                    }
                }
                if format!("{:?}", answer.as_ref().err()) != format!("{refusal:?}") {
                    found.push(format!("{accuracy:?}: {answer:?}, not {refusal:?}"));
                }
                continue;
            }
        };
        match clip(&segment.reversed()) {
            Ok(reversed) => {
                let broken = check_swapped(&answer, &reversed);
                found.extend(broken.iter().map(|v| format!("{accuracy:?}: {v}")));
            }
            Err(refusal) => found.push(format!("reversed: {refusal}")),
        }
        if accuracy == Accuracy::Inward {
            let broken = check_idempotent(&answer, clip);
            found.extend(broken.iter().map(|v| format!("{accuracy:?}: {v}")));
        }
        for clipper in exact_clippers::<T>(accuracy) {
            let same = clipper
                .clip_segment(frustum, segment)
                .is_ok_and(|other| bits(&other) == bits(&answer));
            if !same {
                found.push(format!("{accuracy:?}: {} differs", clipper.name()));
            }
        }
    }
    found
}

/// Panics with the input if an answer to a segment breaks a guarantee.
#[track_caller]
pub fn assert_guarantees<T: Real>(frustum: &Frustum, segment: &Segment<T>) {
    let found = guarantees(frustum, segment);
    assert!(found.is_empty(), "{found:#?}\n{frustum:?}\n{segment:?}");
}
