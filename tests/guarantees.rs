//! Tests of the guarantees G1 to G8 by name, with the singular samples and every
//! family of cases, in `f64` and `f32`. (G7 is measured, not promised.)
//!
//! Every test counts the cases it has checked, so that none can pass without any.

use frusta::oracle::{
    Oracle, OracleClip, ViolationKind, check_idempotent, check_swapped, round_nearest,
};
use frusta::samples::{BLOCK, Family, Placement, Solid, singular_samples};
use frusta::{Accuracy, Class, Face, FaceSet, Frustum, PartEnd, Real, Segment, SegmentClip, Vec3};
use frusta_lab::check::{ACCURACIES, bits, exact_clippers};

const SEED: u64 = 78;
/// Cases of each family and scalar type: two frusta.
const CASES: u64 = 2 * BLOCK;

/// A case with its exact answer.
struct Case<'a, T> {
    frustum: &'a Frustum,
    oracle: &'a Oracle,
    truth: OracleClip,
    segment: Segment<T>,
}

impl<T: Real> Case<'_, T> {
    fn clip(&self, accuracy: Accuracy) -> SegmentClip<T> {
        let clipped = self.frustum.clip_segment_with(&self.segment, accuracy);
        clipped.expect("the families' segments are finite")
    }

    /// The two ends of the answer, each with the exact end.
    fn ends(&self, answer: &SegmentClip<T>) -> Vec<(PartEnd<T>, frusta::oracle::OracleEnd)> {
        let (Some(part), Some(exact)) = (answer.part, &self.truth.part) else {
            return Vec::new();
        };
        vec![
            (part.entry, exact.entry.clone()),
            (part.exit, exact.exit.clone()),
        ]
    }

    /// Asserts that there is no violation of these kinds.
    fn assert_none(&self, accuracy: Accuracy, kinds: &[ViolationKind]) {
        let answer = self.clip(accuracy);
        let mut found = self
            .oracle
            .check(&self.truth, &self.segment, accuracy, &answer);
        found.retain(|v| kinds.contains(&v.kind));
        assert!(
            found.is_empty(),
            "{accuracy:?}: {found:#?}\n{}",
            self.input()
        );
    }

    fn input(&self) -> String {
        format!("{:?}\n{:?}", self.frustum, self.segment)
    }
}

fn each_of<T: Real>(family: Family, see: &mut impl FnMut(&Case<'_, T>)) {
    for block in 0..CASES / BLOCK {
        let scene = family.scene(SEED, block);
        let oracle = Oracle::new(scene.frustum());
        for index in block * BLOCK..(block + 1) * BLOCK {
            let segment = family.segment::<T>(&scene, SEED, index);
            let truth = oracle
                .clip(&segment)
                .expect("the families' segments are finite");
            see(&Case {
                frustum: scene.frustum(),
                oracle: &oracle,
                truth,
                segment,
            });
        }
    }
}

/// A visitor of all cases in both scalar types.
trait Visit {
    fn see<T: Real>(&mut self, case: &Case<'_, T>);
}

fn every_case(visit: &mut impl Visit) {
    for &family in Family::ALL {
        each_of::<f64>(family, &mut |case| visit.see(case));
        if family.has_f32() {
            each_of::<f32>(family, &mut |case| visit.see(case));
        }
    }
}

#[derive(Default)]
struct Topology {
    classes: [u32; 5],
}

impl Visit for Topology {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        self.classes[case.truth.class as usize] += 1;
        for accuracy in ACCURACIES {
            case.assert_none(accuracy, &[ViolationKind::Class, ViolationKind::Set]);
        }
    }
}

#[test]
fn g1_class_and_sets_are_exact() {
    let mut topology = Topology::default();
    every_case(&mut topology);
    let enough = topology.classes.iter().all(|&n| n > 300);
    assert!(enough, "{:?} of {:?}", topology.classes, Class::ALL);
}

/// Compares with answers known from the construction, without the oracle.
#[test]
fn g1_holds_for_the_singular_samples_in_48_orientations_and_rotated() {
    let mut placements = Placement::signed_permutations();
    placements.push(Placement::rotated([1, 2, 2, 4]));
    placements.push(Placement::rotated([3, -1, 2, 0]).moved_to(Vec3::new(5.0, -9.0, 2.0)));
    placements.push(Placement::rotated([1, 1, -1, 2]).scaled(-300));
    let mut seen = 0;
    for solid in Solid::ALL {
        for placement in &placements {
            let frustum = placement.place(&solid).unwrap();
            for sample in singular_samples(&solid) {
                let segment = placement.segment(&sample.segment);
                let answer = frustum.clip_segment(&segment).unwrap();
                let expected = sample
                    .expected
                    .part
                    .map(|p| (p.faces, p.clipped, p.coplanar));
                let found = answer.part.map(|p| {
                    let ends = [p.entry, p.exit];
                    (ends.map(|e| e.faces), ends.map(|e| e.clipped), p.coplanar)
                });
                assert_eq!(answer.class, sample.expected.class, "{}", sample.name());
                assert_eq!(found, expected, "{} {}", solid.name, sample.name());
                seen += 1;
            }
        }
    }
    // Four solids of 26 features, two of 18 and two of 17, in three relations.
    assert_eq!(seen, placements.len() * 3 * (4 * 26 + 2 * 18 + 2 * 17));
}

#[derive(Default)]
struct Unclipped {
    ends: u32,
}

impl Visit for Unclipped {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        for accuracy in ACCURACIES {
            let Some(part) = case.clip(accuracy).part else {
                continue;
            };
            let Segment { start, end } = case.segment;
            for (is, t, own) in [(part.entry, T::ZERO, start), (part.exit, T::ONE, end)] {
                if is.clipped {
                    continue;
                }
                let raw = |v: Vec3<T>| v.to_f64().to_array().map(f64::to_bits);
                assert_eq!((is.t, raw(is.point)), (t, raw(own)), "{}", case.input());
                assert!(is.inward, "{}", case.input());
                self.ends += 1;
            }
        }
    }
}

#[test]
fn g2_unclipped_ends_come_back_bit_for_bit() {
    let mut unclipped = Unclipped::default();
    every_case(&mut unclipped);
    assert!(unclipped.ends > 5_000, "{}", unclipped.ends);
}

#[derive(Default)]
struct Depths {
    ends: u32,
}

impl Visit for Depths {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        if !case.frustum.pose().is_identity() {
            return;
        }
        for accuracy in [Accuracy::Fast, Accuracy::Nearest] {
            for (end, _) in case.ends(&case.clip(accuracy)) {
                let shape = case.frustum.shape();
                let far = shape.far().filter(|_| end.faces.contains(Face::Far));
                let near = Some(shape.near()).filter(|_| end.faces.contains(Face::Near));
                if let Some(rect) = near.or(far).filter(|_| end.clipped) {
                    assert_eq!(end.point.z, T::from_f64(rect.z), "{}", case.input());
                    self.ends += 1;
                }
            }
        }
    }
}

#[test]
fn g2_in_the_identity_pose_near_and_far_hits_have_that_z() {
    let mut depths = Depths::default();
    every_case(&mut depths);
    assert!(depths.ends > 100, "{}", depths.ends);
}

/// Counts of clipped ends with one accuracy.
struct Points {
    accuracy: Accuracy,
    clipped: u32,
    inward: u32,
}

impl Points {
    fn count(accuracy: Accuracy) -> Self {
        let mut points = Points {
            accuracy,
            clipped: 0,
            inward: 0,
        };
        every_case(&mut points);
        assert!(points.clipped > 5_000, "{}", points.clipped);
        points
    }
}

impl Visit for Points {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        use ViolationKind as V;
        let kinds = [
            V::Point,
            V::Parameter,
            V::Order,
            V::InwardMissed,
            V::InwardFlag,
        ];
        case.assert_none(self.accuracy, &kinds);
        for (end, exact) in case.ends(&case.clip(self.accuracy)) {
            if !end.clipped {
                continue;
            }
            self.clipped += 1;
            self.inward += u32::from(end.inward);
            if self.accuracy == Accuracy::Nearest {
                // Tested again, without the oracle's check.
                let nearest = exact.point.each_ref().map(round_nearest::<T>);
                assert_eq!(end.point.to_array(), nearest, "{}", case.input());
                assert_eq!(end.t, round_nearest::<T>(&exact.t), "{}", case.input());
            }
        }
    }
}

#[test]
fn g3_fast_points_are_within_8_u_and_a_subnormal_and_parameters_within_4_u() {
    assert_eq!(Points::count(Accuracy::Fast).inward, 0);
}

#[test]
fn g3_nearest_is_correctly_rounded() {
    assert_eq!(Points::count(Accuracy::Nearest).inward, 0);
}

#[test]
fn g3_inward_points_are_within_two_ulp_or_flagged() {
    let points = Points::count(Accuracy::Inward);
    assert!(
        points.inward > points.clipped / 2,
        "{} of {}",
        points.inward,
        points.clipped
    );
    assert!(
        points.inward < points.clipped,
        "no case without an inward point"
    );
}

#[derive(Default)]
struct Containment {
    inward: u32,
    nearest_outside: u32,
}

impl Visit for Containment {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        for (end, _) in case.ends(&case.clip(Accuracy::Inward)) {
            if end.inward {
                assert!(case.oracle.contains(end.point), "{}", case.input());
                self.inward += 1;
            }
        }
        for (end, _) in case.ends(&case.clip(Accuracy::Nearest)) {
            self.nearest_outside += u32::from(!case.oracle.contains(end.point));
        }
    }
}

/// A `Nearest` point is outside by at most half an ulp, because it is correctly rounded
/// (G3); that it often is outside shows that `Inward` is needed.
#[test]
fn g4_inward_points_are_in_the_frustum() {
    let mut containment = Containment::default();
    every_case(&mut containment);
    assert!(containment.inward > 5_000, "{}", containment.inward);
    assert!(
        containment.nearest_outside > 500,
        "{}",
        containment.nearest_outside
    );
}

#[derive(Default)]
struct Symmetry {
    parts: u32,
}

impl Visit for Symmetry {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        for accuracy in ACCURACIES {
            let answer = case.clip(accuracy);
            let reversed = case.segment.reversed();
            let reversed = case.frustum.clip_segment_with(&reversed, accuracy).unwrap();
            let broken = check_swapped(&answer, &reversed);
            assert!(
                broken.is_none(),
                "{accuracy:?}: {broken:?}\n{}",
                case.input()
            );
            self.parts += u32::from(answer.part.is_some());
        }
    }
}

#[test]
fn g5_swapping_the_ends_swaps_the_result() {
    let mut symmetry = Symmetry::default();
    every_case(&mut symmetry);
    assert!(symmetry.parts > 5_000, "{}", symmetry.parts);
}

#[derive(Default)]
struct Idempotence {
    clipped_twice: u32,
}

impl Visit for Idempotence {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        let answer = case.clip(Accuracy::Inward);
        let mut again = 0;
        let broken = check_idempotent(&answer, |segment| {
            again += 1;
            case.frustum.clip_segment_with(segment, Accuracy::Inward)
        });
        assert!(broken.is_none(), "{broken:?}\n{}", case.input());
        let clipped = answer
            .part
            .is_some_and(|p| p.entry.clipped || p.exit.clipped);
        self.clipped_twice += u32::from(clipped) * again;
    }
}

#[test]
fn g6_inward_results_clip_to_themselves() {
    let mut idempotence = Idempotence::default();
    every_case(&mut idempotence);
    assert!(
        idempotence.clipped_twice > 2_000,
        "{}",
        idempotence.clipped_twice
    );
}

#[derive(Default)]
struct Algorithms {
    answers: u32,
}

impl Visit for Algorithms {
    fn see<T: Real>(&mut self, case: &Case<'_, T>) {
        for accuracy in ACCURACIES {
            let expected = bits(&case.clip(accuracy));
            for clipper in exact_clippers::<T>(accuracy) {
                let answer = clipper.clip_segment(case.frustum, &case.segment).unwrap();
                let (name, input) = (clipper.name(), case.input());
                assert_eq!(bits(&answer), expected, "{name} {accuracy:?}\n{input}");
                self.answers += 1;
            }
        }
    }
}

/// One algorithm decides two lanes at a time, the others use scalar predicates: the bits are
/// the same with SIMD and without.
#[test]
fn g8_all_exact_algorithms_give_the_same_bits() {
    let mut algorithms = Algorithms::default();
    every_case(&mut algorithms);
    assert!(algorithms.answers > 100_000, "{}", algorithms.answers);
}

/// No state is kept from one segment to the next, and threads share none.
#[test]
fn g8_the_order_of_segments_and_the_number_of_threads_change_no_bit() {
    for &family in Family::ALL {
        let scene = family.scene(SEED, 0);
        let segments: Vec<_> = (0..BLOCK)
            .map(|index| family.segment::<f64>(&scene, SEED, index))
            .collect();
        let clip = |s: &Segment<f64>| bits(&scene.frustum().clip_segment(s).unwrap());
        let forth: Vec<_> = segments.iter().map(clip).collect();
        let mut back: Vec<_> = segments.iter().rev().map(clip).collect();
        back.reverse();
        assert_eq!(forth, back, "{family}");
        let half = segments.len() / 2;
        let threads: Vec<_> = std::thread::scope(|scope| {
            let workers: Vec<_> = segments
                .chunks(half)
                .map(|chunk| scope.spawn(|| chunk.iter().map(clip).collect::<Vec<_>>()))
                .collect();
            workers
                .into_iter()
                .flat_map(|w| w.join().unwrap())
                .collect()
        });
        assert_eq!(forth, threads, "{family}");
    }
}

/// The comparison of these tests distinguishes the signs of zeros, and faces.
#[test]
fn g8_bits_distinguish_answers() {
    let frustum = Placement::IDENTITY.place(&Solid::SYMMETRIC).unwrap();
    let at = |x: f64| frustum.clip_segment(&Segment::new([x, 0.0, 9.0], [0.0, 0.0, 10.0]));
    let (plus, minus) = (at(0.0).unwrap(), at(-0.0).unwrap());
    assert_eq!(plus, minus);
    assert_ne!(bits(&plus), bits(&minus));
    let mut other = plus;
    other.part.as_mut().unwrap().exit.faces = FaceSet::from(Face::Top);
    assert_ne!(bits(&plus), bits(&other));
}
