//! Every library is used as it is meant: on easy cases all give the same answer, and it is true.

use frusta::samples::Random;
use frusta::{Real, Segment, Vec3};
use frusta_lab::turns::Spread;
use frusta_peers::boxes::GridBox;
use frusta_peers::contest::{Contest, Effort, Field, Quads, Segments, all, cullings, segments};
use frusta_peers::facts;
use frusta_peers::quads::{FoundQuad, Quad};
use frusta_peers::scene::Block;
use frusta_peers::segments::{Found, REFERENCE};
use frusta_peers::tally::{Judge, Tally};

const NONE: Tally = Tally {
    cases: 0,
    phantom: 0,
    missed: 0,
    outside: 0,
    misplaced: 0,
    refused: 0,
    max_error: 0.0,
};

/// A point well inside of a contest's frustum, or well outside: about the middle of its corners.
fn easy_point(random: &mut Random, contest: &Segments, grown: f64) -> Vec3<f64> {
    let frustum = contest.frustum();
    let corners = frustum.corners();
    let frusta::FarCorners::Points(far) = corners.far else {
        unreachable!("all contests have a far face")
    };
    let all: Vec<Vec3<f64>> = corners.near.into_iter().chain(far).collect();
    let middle = all.iter().fold(Vec3::from([0.0; 3]), |sum, p| sum + *p) * 0.125;
    // A convex combination of the corners, then grown about the middle.
    let weights: Vec<f64> = all.iter().map(|_| random.between(0.2, 1.0)).collect();
    let sum: f64 = weights.iter().sum();
    let inside = all
        .iter()
        .zip(&weights)
        .fold(Vec3::from([0.0; 3]), |p, (corner, w)| {
            p + *corner * (w / sum)
        });
    middle + (inside - middle) * grown
}

/// Flat where the contest is flat.
fn flattened(contest: &Segments, s: Segment<f64>) -> Segment<f64> {
    let mut s = s;
    if contest.job() == "segment-window" {
        let z = contest.frustum().shape().near().z - 0.5;
        s.start.z = z;
        s.end.z = z;
    }
    s
}

fn single(s: &Segment<f64>) -> Segment<f32> {
    Segment::new(Vec3::from_f64(s.start), Vec3::from_f64(s.end))
}

/// Those that are only timed answer another question.
fn is_judged(note: &str) -> bool {
    !note.contains("times only")
}

#[test]
fn all_agree_on_easy_segments() {
    for contest in segments() {
        let judge = contest.judge();
        let mut random = Random::new(&[11]);
        let (mut in_f64, mut in_f32) = (contest.in_f64(), contest.in_f32());
        let mut kinds = [0; 3];
        for i in 0..300 {
            let (a, b) = [(0.9, 0.9), (0.9, 60.0), (60.0, 60.0)][i % 3];
            let start = easy_point(&mut random, &contest, a);
            let end = easy_point(&mut random, &contest, b);
            let s = flattened(&contest, Segment::new(start, end));
            let mut truth = judge.truth(&s);
            for peer in in_f64.iter_mut().filter(|p| is_judged(p.who().note)) {
                let tally = judge.judge(&s, &mut truth, &peer.ask(&s));
                check(&peer.who(), &tally, &s, &contest);
            }
            let s = single(&s);
            let mut truth = judge.truth(&s);
            for peer in in_f32.iter_mut().filter(|p| is_judged(p.who().note)) {
                let tally = judge.judge(&s, &mut truth, &peer.ask(&s));
                check(&peer.who(), &tally, &s.to_f64(), &contest);
            }
            let found = in_f64[0].ask(&flattened(&contest, Segment::new(start, end)));
            kinds[match found {
                Found::Nothing => 0,
                Found::Part(ends) if ends[0].kept && ends[1].kept => 1,
                _ => 2,
            }] += 1;
        }
        assert!(kinds.iter().all(|n| *n > 5), "{kinds:?} {contest:?}");
    }
}

/// Asserts that frusta's answers over slices are those of each segment; returns how many clippers
/// were compared.
fn assert_same<T: Real>(mut field: Field<Segment<T>>, all: &[Segment<T>]) -> usize {
    let names: Vec<_> = field.iter().map(|p| p.who()).collect();
    let mut count = 0;
    for (i, who) in names
        .iter()
        .enumerate()
        .filter(|(_, w)| w.library == "frusta")
    {
        let Some(alone) = who.function.strip_suffix(", slices") else {
            continue;
        };
        let twin = names.iter().position(|w| w.function == alone).expect("one");
        let sliced = field[i].ask_all(all);
        assert_eq!(sliced.len(), all.len());
        for (segment, found) in all.iter().zip(&sliced) {
            let own = field[twin].ask(segment);
            assert_eq!(*found, own, "{who:?} on {segment:?}");
        }
        count += 1;
    }
    count
}

#[test]
fn slices_answer_as_single_segments_do() {
    for contest in segments() {
        let mut random = Random::new(&[12]);
        let mut case = |i: usize| {
            let [a, b] = [[0.9, 0.9], [0.9, 60.0], [60.0, 60.0], [1.2, 1.2]][i % 4];
            let [a, b] = [a, b].map(|grown| easy_point(&mut random, &contest, grown));
            // Half-integers meet faces, edges and corners.
            let near = |p: Vec3<f64>| Vec3::from(p.to_array().map(|c| (c * 2.0).round() / 2.0));
            let [a, b] = if i % 8 < 4 { [a, b].map(near) } else { [a, b] };
            flattened(&contest, Segment::new(a, b))
        };
        let in_f64: Vec<_> = (0..1500).map(&mut case).collect();
        let in_f32: Vec<_> = in_f64.iter().map(single).collect();
        assert_eq!(assert_same(contest.in_f64(), &in_f64), 4);
        let kinds = assert_same(contest.in_f32(), &in_f32);
        assert_eq!(kinds, if contest.in_f32().is_empty() { 0 } else { 4 });
    }
}

fn check(who: &frusta_peers::peer::Who, tally: &Tally, segment: &Segment<f64>, contest: &Segments) {
    // Its phantom hits are far from every singular case.
    let allowed = who.function == "Aabb::clip_segment";
    let wrong = tally.wrong() - if allowed { tally.phantom } else { 0 };
    assert_eq!(wrong, 0, "{who:?} on {segment:?} of {contest:?}");
    // A matrix or a box that is not the frustum would be off by more than any rounding.
    let error = tally.max_error;
    assert!(
        error < 2000.0,
        "{error} {who:?} on {segment:?} of {contest:?}"
    );
}

#[test]
fn exact_tiers_are_right_and_the_reference_is_first() {
    let effort = Effort {
        lattice: 3000,
        mix: 500,
        timed: 2000,
        rounds: 1,
        ..Effort::QUICK
    };
    for contest in all().iter().filter(|c| c.job().starts_with("segment")) {
        let outcomes = contest.run(&effort, &|_| ());
        assert_eq!(outcomes[0].who.function, REFERENCE);
        assert_eq!(outcomes[0].time.ratios[0], Some(Spread::new(vec![1.0])));
        let exact = outcomes.iter().filter(|o| o.who.function.contains("exact"));
        for outcome in exact {
            let tally = outcome.tally.expect("judged");
            assert!(tally.cases >= 500);
            assert_eq!(tally.wrong(), 0, "{:?}", outcome.who);
            if outcome.who.function.contains("Inward") {
                assert_eq!(tally.outside, 0, "{:?} {tally:?}", outcome.who);
            }
        }
    }
}

/// The known failures are counted as what they are.
#[test]
fn known_failures_are_counted() {
    let all = segments();
    let contest = all.iter().find(|c| c.job() == "segment-box").expect("one");
    let judge = contest.judge();
    let tally = |single_precision: bool, function: &str, ends: [[f64; 3]; 2]| {
        let s = Segment::new(ends[0], ends[1]);
        if single_precision {
            let s = single(&s);
            let mut field = contest.in_f32();
            let peer = field.iter_mut().find(|p| p.who().function == function);
            let answer = peer.expect("takes part").ask(&s);
            judge.judge(&s, &mut judge.truth(&s), &answer)
        } else {
            let mut field = contest.in_f64();
            let peer = field.iter_mut().find(|p| p.who().function == function);
            let answer = peer.expect("takes part").ask(&s);
            judge.judge(&s, &mut judge.truth(&s), &answer)
        }
    };
    let short = [[-10.0, 0.0, 0.0], [-5.0, 0.0, 0.0]];
    let phantom = Tally {
        cases: 1,
        phantom: 1,
        ..NONE
    };
    assert_eq!(tally(false, "Aabb::clip_segment", short), phantom);
    let clamped = "clip_line_parameters, clamped";
    assert_eq!(tally(false, clamped, short), Tally { cases: 1, ..NONE });
    let from_face = [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let misplaced = Tally {
        cases: 1,
        misplaced: 1,
        outside: 1,
        ..NONE
    };
    assert_eq!(tally(true, "view_frustum::clip", from_face), misplaced);
    assert_eq!(
        tally(true, REFERENCE, from_face),
        Tally { cases: 1, ..NONE }
    );
}

#[test]
fn all_agree_on_easy_boxes() {
    for contest in cullings() {
        let camera = contest.camera();
        let half = if contest.job() == "cull-point" {
            0.0
        } else {
            0.25
        };
        // Across, up and ahead, in the camera's own frame.
        for (at, meets) in [
            ([0.0, 0.0, 2.0], true),
            ([0.5, -0.5, 2.0], true),
            ([9.0, 0.0, 2.0], false),
            ([0.0, -9.0, 2.0], false),
            ([0.0, 9.0, 2.0], false),
            ([-9.0, 0.0, 2.0], false),
            ([0.0, 0.0, 200.0], false),
            ([0.0, 0.0, -2.0], false),
            ([0.0, 0.0, 0.25], false),
        ] {
            let [x, y, depth] = at;
            let axes = camera.pose.axes.map(|a| a * (1.0 / a.dot(a).sqrt()));
            let centre = axes[0] * x + axes[1] * y + axes[2] * (depth * camera.direction);
            let side = |offset: f64| centre.to_array().map(|c| (c + offset) as f32);
            let case = GridBox {
                min: side(-half),
                max: side(half),
            };
            for peer in &mut contest.field() {
                assert_eq!(peer.ask(&case), Some(meets), "{:?} on {at:?}", peer.who());
            }
        }
    }
}

#[test]
fn easy_quads_are_cut_rightly() {
    let mut field = Quads.field();
    for (min, max) in [
        ([-0.5, -0.5, 0.25], [0.5, 0.5, 0.25]),
        ([-3.0, -0.5, 0.25], [3.0, 0.5, 0.25]),
        ([0.5, -3.0, -3.0], [0.5, 3.0, 3.0]),
        ([-0.5, 0.75, 0.5], [2.0, 0.75, 9.0]),
        ([2.0, -3.0, -3.0], [2.0, 3.0, 3.0]),
    ] {
        let quad = Quad { min, max };
        let found = match field[0].ask(&quad) {
            FoundQuad::Bounds(bounds) => Some(bounds),
            FoundQuad::Nothing => None,
            FoundQuad::Refused => unreachable!("{quad:?}"),
        };
        assert_eq!(found, quad.within(&Block::CUBE));
    }
}

#[test]
fn hostile_inputs_end_as_documented() {
    let facts = facts::ask(std::path::Path::new(env!("CARGO_BIN_EXE_frusta-peers")));
    let result = |library: &str, part: &str| {
        let is_it = |f: &&facts::Fact| f.library == library && f.input.contains(part);
        let fact = facts.iter().find(is_it).expect("told");
        (fact.result.clone(), fact.ours.clone())
    };
    assert_eq!(result("line-clipping", "NaN").0, "no answer within 2 s");
    let (theirs, ours) = result("parry3d-f64", "(-5,0,0)");
    assert_eq!(theirs, "inside from (-1.0, 0.0, 0.0) to (-5.0, 0.0, 0.0)");
    assert_eq!(ours, "nothing inside");
    assert!(result("treeculler", "near 1e-6").0.contains("seen = true"));
    assert_eq!(result("collision", "orthographic").0, "Relation::Out");
    for fact in &facts {
        assert!(
            !fact.version.is_empty() && !fact.result.is_empty(),
            "{fact:?}"
        );
        let failed = ["not asked", "not heard", "not waited", "ended by"];
        assert!(
            !failed.iter().any(|f| fact.result.starts_with(f)),
            "{fact:?}"
        );
    }
}
