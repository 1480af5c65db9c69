//! Intervals against segments clipped alone, to the bit, at every vector width.

use super::super::segments::SegmentArrays;
use super::*;
use crate::clip::Class;
use crate::frustum::eval::half_space::HalfSpaces;
use crate::frustum::{Direction, EndRect, Shape};
use crate::math::{Pose, Rect, Segment};
use crate::samples::{BLOCK as CASES, Family};
use crate::simd::levels;

/// A frustum and its half spaces.
struct Prepared {
    frustum: Frustum,
    planes: FacePlanesPair,
}

impl Prepared {
    fn new(frustum: &Frustum) -> Self {
        Self {
            frustum: frustum.clone(),
            planes: FacePlanesPair::new(&HalfSpaces::new(frustum)),
        }
    }

    fn clip<T: Real>(
        &self,
        level: Level,
        segments: &Segments<'_, T>,
        intervals: &mut SegmentIntervals<T>,
    ) -> Result<(), NonFiniteAt> {
        clip(level, &self.frustum, &self.planes, segments, intervals)
    }
}

fn columns<T: Real>(segments: &[Segment<T>]) -> [Vec<T>; 6] {
    let column = |of: fn(&Segment<T>) -> T| segments.iter().map(of).collect();
    [
        column(|s| s.start.x),
        column(|s| s.start.y),
        column(|s| s.start.z),
        column(|s| s.end.x),
        column(|s| s.end.y),
        column(|s| s.end.z),
    ]
}

fn arrays<T>([a, b, c, d, e, f]: &[Vec<T>; 6]) -> SegmentArrays<'_, T> {
    SegmentArrays {
        start: [a, b, c],
        end: [d, e, f],
    }
}

fn expected<T: Real>(frustum: &Frustum, segment: &Segment<T>) -> (Class, T, T) {
    let clip = frustum.clip_segment(segment).expect("finite");
    let part = clip.part.as_ref();
    let (t0, t1) = part.map_or((T::ONE, T::ZERO), |part| (part.entry.t, part.exit.t));
    (clip.class, t0, t1)
}

/// Both ways of storing segments give what each gives alone. Returns how many were uncertain.
fn compare<T: Real>(level: Level, prepared: &Prepared, segments: &[Segment<T>]) -> usize {
    let mut intervals = SegmentIntervals::default();
    let columns = columns(segments);
    for batch in [Segments::from(arrays(&columns)), Segments::from(segments)] {
        assert_eq!(batch.len(), segments.len());
        let done = prepared.clip(level, &batch, &mut intervals);
        assert_eq!(done, Ok(()));
        assert_eq!(intervals.len(), segments.len());
        for (segment, found) in segments.iter().zip(intervals.iter()) {
            let expected = expected(&prepared.frustum, segment);
            // Texts distinguish the signs of zeros.
            assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{segment:?}");
        }
    }
    intervals.uncertain()
}

fn compare_families<T: Real>() {
    let families = if cfg!(miri) {
        vec![Family::Random, Family::HalfLattice]
    } else {
        Family::ALL.to_vec()
    };
    for family in families {
        for block in 0..if cfg!(miri) { 1 } else { 12 } {
            let scene = family.scene(7, block);
            let prepared = Prepared::new(scene.frustum());
            let each = if cfg!(miri) { 5 } else { CASES };
            let cases = block * CASES..block * CASES + each;
            let segments: Vec<Segment<T>> = cases.map(|i| family.segment(&scene, 7, i)).collect();
            // Some blocks and a bit, so that a segment takes every lane.
            let many: Vec<_> = (0..9).flat_map(|k| &segments[k % 5..]).copied().collect();
            for level in levels() {
                compare(level, &prepared, &many[block as usize % 5..]);
            }
        }
    }
}

#[test]
fn families_in_f32_give_what_each_gives_alone() {
    compare_families::<f32>();
}

#[test]
fn families_in_f64_give_what_each_gives_alone() {
    compare_families::<f64>();
}

/// Registers of sixteen give what those of eight do, at every width.
#[cfg(simd)]
#[test]
fn sixteen_at_a_time_give_the_same() {
    for family in if cfg!(miri) {
        vec![Family::Random]
    } else {
        Family::ALL.to_vec()
    } {
        let scene = family.scene(7, 0);
        let prepared = Prepared::new(scene.frustum());
        let segments = (0..3 * CASES).map(|i| family.segment(&scene, 7, i));
        let segments: Vec<Segment<f32>> = segments.collect();
        let (mut eight, mut sixteen) = (SegmentIntervals::default(), SegmentIntervals::default());
        for segments in [&segments[..], &segments[5..700.min(segments.len())]] {
            let batch = Segments::from(segments);
            prepared.clip(Level::new(), &batch, &mut eight).unwrap();
            for level in levels() {
                let prepared = super::Prepared {
                    frustum: &prepared.frustum,
                    planes: prepared.planes.single(),
                    planes_f64: prepared.planes.double(),
                };
                let out = sixteen.prepare(segments.len());
                run::clip_f32_by_sixteen(level, prepared, &batch, out).unwrap();
                assert!(eight == sixteen, "{family:?}, {level:?}");
            }
        }
    }
}

/// Pseudo-random values in -1..1, always the same.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 88_172_645_463_325_252_u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn frustum() -> Frustum {
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = EndRect::new(5.0, -4.0, 6.0, -3.0, 4.0);
    Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap()
}

/// Segments in no special position are settled in registers, except a few.
#[cfg(simd)]
#[test]
fn hardly_any_segment_of_a_scene_is_uncertain() {
    let mut next = noise();
    let prepared = Prepared::new(&frustum());
    let mut point = |scale: f64| [scale * next(), scale * next(), 2.0 + scale * next()];
    let mut segment = || {
        let (p, d) = (point(6.0), point(2.0));
        let q = [p[0] + d[0], p[1] + d[1], p[2] + d[2] - 2.0];
        Segment::new(p.map(|v| v as f32), q.map(|v| v as f32))
    };
    let segments: Vec<Segment<f32>> = (0..20_000).map(|_| segment()).collect();
    for level in levels() {
        let uncertain = compare(level, &prepared, &segments);
        assert!((1..40).contains(&uncertain), "{uncertain}");
    }
    let class = |class| {
        let all = segments.iter().map(|s| expected(&prepared.frustum, s).0);
        all.filter(|c| *c == class).count()
    };
    for class in [Class::Outside, Class::Inside, Class::Cross].map(class) {
        assert!(class > 500, "{class}");
    }
}

#[test]
fn the_first_segment_that_is_not_finite_is_the_error() {
    let prepared = Prepared::new(&frustum());
    let mut intervals = SegmentIntervals::default();
    for at in [0, 1, 7, 255, 256, 700] {
        let mut segments = vec![Segment::new([0.0_f32, 0.0, 2.0], [0.5, 9.0, 2.0]); 701];
        segments[at].end.y = f32::NAN;
        segments[700].start.z = f32::INFINITY;
        let columns = columns(&segments);
        for batch in [Segments::from(arrays(&columns)), Segments::from(&segments)] {
            let found = prepared.clip(Level::new(), &batch, &mut intervals);
            let found = found.unwrap_err();
            let expected = segments[at].check_finite().unwrap_err();
            let expected = NonFiniteAt {
                index: at,
                found: expected,
            };
            // Texts: NaN differs from itself.
            assert_eq!(format!("{found:?}"), format!("{expected:?}"));
            assert!(intervals.is_empty());
        }
    }
    let none = Segments::from(&[] as &[Segment<f64>]);
    let done = prepared.clip(Level::new(), &none, &mut SegmentIntervals::default());
    assert_eq!(done, Ok(()));
}

/// Sizes near the largest and the smallest values.
#[test]
fn extreme_sizes_are_as_alone() {
    let mut next = noise();
    let prepared = Prepared::new(&frustum());
    for exponent in [-149, -126, -60, 30, 90, 119, 121, 127] {
        let scale = f64::from(exponent).exp2();
        let mut point = || [next() * scale, next() * scale, next() * scale].map(|v| v as f32);
        let segments: Vec<_> = (0..600).map(|_| Segment::new(point(), point())).collect();
        let wide: Vec<Segment<f64>> = segments.iter().map(|s| s.to_f64()).collect();
        for level in levels() {
            compare(level, &prepared, &segments);
            compare(level, &prepared, &wide);
        }
    }
}

/// A parameter half-way between two `f32`: its interval in `f64` contains both.
#[cfg(simd)]
#[test]
fn a_parameter_between_two_f32_is_found_precisely() {
    let end = |z| EndRect::new(z, -1.0, 1e9, -1e9, 1e9);
    let (near, far) = (end(1.0), end(1e9));
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    let size = 16_777_216.0_f32;
    // (2^24 + 3) / 2^25
    let segment = Segment::new([-size - 4.0, 0.0, 1e6], [size - 4.0, 0.0, 1e6]);
    for level in levels() {
        let uncertain = compare(level, &Prepared::new(&frustum), &[segment; 3]);
        assert_eq!(uncertain, 3);
    }
    let (_, t0, _) = expected(&frustum, &segment);
    assert_eq!(t0, 0.5 + 2.0 * f32::EPSILON / 2.0);
}

/// Up to the largest values, and down to the smallest.
#[test]
fn every_magnitude_gives_what_each_gives_alone() {
    fn check<T: Real>(exponents: std::ops::Range<i32>) {
        let prepared = Prepared::new(&frustum());
        let mut next = noise();
        for exponent in exponents.step_by(3) {
            let mut coordinate = || {
                let near = 3.0 * next();
                match next() > 0.0 {
                    true => near * 2.0_f64.powi(exponent),
                    false => near,
                }
            };
            let mut point = || [coordinate(), coordinate(), coordinate()].map(T::from_f64);
            let segments: Vec<_> = (0..64).map(|_| Segment::new(point(), point())).collect();
            for level in levels() {
                compare(level, &prepared, &segments);
            }
        }
    }
    check::<f32>(if cfg!(miri) { 120..126 } else { -126..126 });
    check::<f64>(if cfg!(miri) { 900..903 } else { -1022..1022 });
}

/// A segment along a face does not cross it, and nothing crosses a missing far face.
#[test]
fn segments_along_faces_are_settled() {
    let rect = Rect {
        left: -1.0,
        right: 1.0,
        bottom: -1.0,
        top: 1.0,
    };
    let (near, far) = (EndRect { z: 1.0, rect }, EndRect { z: 3.0, rect });
    let infinite = Shape::Infinite {
        near,
        direction: Direction::PlusZ,
        slopes: rect,
    };
    for shape in [Shape::Finite { near, far }, infinite] {
        let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
        let prepared = Prepared::new(&frustum);
        let mut next = noise();
        let mut segment = |k: usize| {
            let start = [2.0 * next(), 2.0 * next(), 2.0 + 2.0 * next()];
            let mut end = start;
            end[k % 3] += 3.0 * next();
            Segment::new(start.map(|v| v as f32), end.map(|v| v as f32))
        };
        let segments: Vec<Segment<f32>> = (0..6_000).map(&mut segment).collect();
        let wide: Vec<Segment<f64>> = segments.iter().map(|s| s.to_f64()).collect();
        for level in levels() {
            let uncertain = compare(level, &prepared, &segments);
            assert!(uncertain < 12, "{uncertain}");
            assert_eq!(compare(level, &prepared, &wide), 0);
        }
    }
}
