//! Whether a point is in a frustum, compared with the oracle.

use frusta::oracle::Oracle;
use frusta::samples::{Family, Random};
use frusta::{Accuracy, Axis, End, Frustum, NonFinite, Real, Segment, Vec3};

/// How many points were compared, so that a test that compares too few fails.
#[derive(Debug, Default)]
struct Seen {
    inside: u32,
    outside: u32,
}

/// A segment's ends, the ends of its part, and points some ulps off.
fn check<T: Real>(frustum: &Frustum, segment: &Segment<T>, random: &mut Random, seen: &mut Seen) {
    let oracle = Oracle::new(frustum);
    let clip = frustum
        .clip_segment_with(segment, Accuracy::Inward)
        .unwrap();
    let mut points = vec![segment.start, segment.end];
    if let Some(part) = clip.part {
        for end in [part.entry, part.exit] {
            assert_eq!(frustum.contains(end.point), Ok(end.inward));
            points.push(end.point);
        }
    }
    for point in points {
        for _ in 0..4 {
            let p = Vec3::from(point.to_array().map(|c| off(c, random.integer(-2, 2))));
            if !p.is_finite() {
                continue;
            }
            let expected = oracle.contains(p);
            assert_eq!(frustum.contains(p), Ok(expected), "{p:?} {frustum:?}");
            if expected {
                seen.inside += 1;
            } else {
                seen.outside += 1;
            }
        }
    }
}

fn off<T: Real>(value: T, ulps: i64) -> T {
    (0..ulps.abs()).fold(
        value,
        |v, _| {
            if ulps < 0 { v.next_down() } else { v.next_up() }
        },
    )
}

#[test]
fn contains_agrees_with_the_oracle_next_to_every_feature() {
    let mut random = Random::new(&[31]);
    let (mut seen_f64, mut seen_f32) = (Seen::default(), Seen::default());
    for family in Family::ALL {
        for index in 0..200 {
            let (frustum, segment) = family.case(5, index);
            check(&frustum, &segment, &mut random, &mut seen_f64);
            if let Some((frustum, segment)) = family.case_f32(5, index) {
                check(&frustum, &segment, &mut random, &mut seen_f32);
            }
        }
    }
    for seen in [seen_f64, seen_f32] {
        assert!(seen.inside > 10_000 && seen.outside > 10_000, "{seen:?}");
    }
}

#[test]
fn the_error_names_a_coordinate_that_is_not_finite() {
    let (frustum, _) = Family::ALL[0].case(1, 0);
    let error = frustum
        .contains([0.0, f64::INFINITY, f64::NAN])
        .unwrap_err();
    let expected = NonFinite {
        end: None,
        axis: Axis::Y,
        value: f64::INFINITY,
    };
    assert_eq!(error, expected);
    assert_eq!(
        error.to_string(),
        "the point has y = inf; coordinates must be finite"
    );
    let segment = Segment::new([0.0; 3], [0.0, 0.0, f64::NEG_INFINITY]);
    let error = frustum.clip_segment(&segment).unwrap_err();
    assert_eq!(error.end, Some(End::End));
    assert_eq!(
        error.to_string(),
        "the segment's end has z = -inf; coordinates must be finite"
    );
}
