//! Slices made of a case's segment and of variants of it, compared with single calls.

use crate::check::bits;
use frusta::clip::{Arithmetic, SegmentClipper, VwProjection};
use frusta::{
    Accuracy, Frustum, NonFinite, NonFiniteAt, Real, Segment, SegmentClip, StageCounts, Vec3,
};

/// Longer than a block, and not a multiple of any vector width.
const LONG: usize = 300;

/// V/W in every arithmetic, on slices of lengths that the case chooses.
pub(crate) fn check<T: Real>(frustum: &Frustum, segment: &Segment<T>) {
    let variants = variants(segment);
    let chosen = chosen(segment);
    let exact = [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward].map(VwProjection::exact);
    for clipper in [VwProjection::plain()].into_iter().chain(exact) {
        let expected = Expected::new(clipper, frustum, variants);
        let length = 1 + chosen % 9;
        expected.compare(length, |_| 0);
        expected.compare(length, |i| (i + chosen) % 8);
        // With the other accuracies most of the time is spent on segments one by one.
        let in_lanes = matches!(
            clipper.arithmetic,
            Arithmetic::Plain | Arithmetic::Exact(Accuracy::Fast)
        );
        if in_lanes && chosen.is_multiple_of(31) {
            expected.compare(LONG, |i| i % 8);
        }
    }
}

/// An arbitrary number, the same for the same segment.
fn chosen<T: Real>(segment: &Segment<T>) -> usize {
    let Segment { start, end } = segment.to_f64();
    let coordinates = [start, end].into_iter().flat_map(Vec3::to_array);
    let mixed = coordinates.fold(0_u64, |mixed, v| {
        (mixed ^ v.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
    });
    (mixed >> 40) as usize
}

/// The segment, its reverse, parts of it, longer ones, beside it, a point: inside,
/// outside and crossing ones next to each other, as far as one segment allows.
fn variants<T: Real>(segment: &Segment<T>) -> [Segment<T>; 8] {
    let Segment { start, end } = segment.to_f64();
    let d = end - start;
    let along = |t: f64| start + d * t;
    let aside = Vec3::new(-d.y, d.x, d.z * 0.5);
    let all = [
        (start, end),
        (end, start),
        (start, along(0.5)),
        (along(0.25), along(0.5)),
        (along(-1.0), along(2.0)),
        (along(1.5), along(3.0)),
        (start + aside, end + aside),
        (end, end),
    ];
    all.map(|(a, b)| Segment::new(Vec3::<T>::from_f64(a), Vec3::<T>::from_f64(b)))
}

/// A segment, its answer as bits and what that took.
struct Single<T> {
    segment: Segment<T>,
    answer: Result<Vec<u64>, NonFinite>,
    counts: StageCounts,
}

/// A clipper and its answers to the variants, one by one.
struct Expected<'a, T> {
    clipper: VwProjection,
    frustum: &'a Frustum,
    singles: [Single<T>; 8],
}

impl<'a, T: Real> Expected<'a, T> {
    fn new(clipper: VwProjection, frustum: &'a Frustum, variants: [Segment<T>; 8]) -> Self {
        let singles = variants.map(|segment| {
            let mut counts = StageCounts::default();
            let clip = clipper.clip_segment_counted(frustum, &segment, &mut counts);
            Single {
                segment,
                answer: clip.map(|clip| bits(&clip)),
                counts,
            }
        });
        Self {
            clipper,
            frustum,
            singles,
        }
    }

    /// The slice whose element i is the variant `which(i)`.
    fn compare(&self, length: usize, which: impl Fn(usize) -> usize) {
        let order: Vec<&Single<T>> = (0..length).map(|i| &self.singles[which(i)]).collect();
        let segments: Vec<_> = order.iter().map(|single| single.segment).collect();
        let context = || format!("{:?}\n{:?}\n{segments:?}", self.clipper, self.frustum);
        let (mut clips, mut counts) = (vec![SegmentClip::OUTSIDE], StageCounts::default());
        let done =
            self.clipper
                .clip_segments_counted(self.frustum, &segments, &mut clips, &mut counts);
        let error = order.iter().enumerate().find_map(|(index, single)| {
            let found = single.answer.as_ref().err()?.clone();
            Some(NonFiniteAt { index, found })
        });
        if let Some(error) = error {
            assert_eq!(
                format!("{done:?}"),
                format!("{:?}", Err::<(), _>(error)),
                "{}",
                context()
            );
            assert!(clips.is_empty(), "{}", context());
            return;
        }
        assert!(
            done.is_ok() && clips.len() == length,
            "{done:?}\n{}",
            context()
        );
        for (i, (clip, single)) in clips.iter().zip(&order).enumerate() {
            assert!(
                single.answer == Ok(bits(clip)),
                "{i}: {clip:?}\n{}",
                context()
            );
        }
        let expected: StageCounts = order.iter().map(|single| single.counts).sum();
        assert_eq!(counts, expected, "{}", context());
    }
}
