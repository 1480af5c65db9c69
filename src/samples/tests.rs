//! The samples are as many and as exact as promised.

use super::*;
use std::collections::BTreeSet;

#[test]
fn as_many_as_the_features() {
    for solid in Solid::ALL {
        let features = match (solid.is_infinite(), solid.is_pyramid()) {
            (true, _) => 17,
            (_, true) => 18,
            _ => 26,
        };
        assert_eq!(solid.features().len(), features, "{}", solid.name);
        assert_eq!(singular_samples(&solid).len(), 3 * features);
        assert_eq!(near_misses(&solid).len(), features);
    }
    assert_eq!(singular_samples(&Solid::SYMMETRIC).len(), 78);
}

#[test]
fn names_are_stable_and_unique() {
    let samples = singular_samples(&Solid::SYMMETRIC);
    let names: BTreeSet<_> = samples.iter().map(FrameSample::name).collect();
    assert_eq!(names.len(), 78);
    for name in [
        "vertex-near-right-top/touching",
        "edge-near-top/crossing",
        "edge-left-bottom/contained",
        "face-far/touching",
    ] {
        assert!(names.contains(name), "{name} is not among {names:?}");
    }
    let pyramid = singular_samples(&Solid::PYRAMID);
    assert!(pyramid.iter().any(|s| s.name() == "vertex-apex/crossing"));
}

#[test]
fn every_label_of_the_paper_occurs() {
    let mut samples = singular_samples(&Solid::SYMMETRIC);
    samples.extend(near_misses(&Solid::SYMMETRIC));
    assert_eq!(samples.len(), 104);
    let labels = |f: fn(&Labels) -> u8| {
        let all: BTreeSet<_> = samples.iter().map(|s| f(&s.labels)).collect();
        all.len()
    };
    assert_eq!(labels(|l| l.intersections as u8), 4);
    assert_eq!(labels(|l| l.direction as u8), 2);
    assert_eq!(labels(|l| l.position as u8), 4);
}

#[test]
fn forty_eight_different_permutations() {
    let all = Placement::signed_permutations();
    let images: BTreeSet<_> = all
        .iter()
        .map(|p| p.point([1.0, 2.0, 3.0].into()).to_array().map(|c| c as i32))
        .collect();
    assert_eq!((all.len(), images.len()), (48, 48));
    assert_eq!(all[0], Placement::IDENTITY);
}

#[test]
fn placed_samples_are_exact_in_single_precision() {
    let placement = Placement::rotated([1, -2, 2, 4])
        .moved_to([7.0, -3.0, 5.0].into())
        .scaled(-9);
    for solid in Solid::ALL {
        for sample in singular_samples(&solid) {
            for segment in [sample.segment, placement.segment(&sample.segment)] {
                for c in [segment.start, segment.end].map(|p| p.to_array()).concat() {
                    assert_eq!(f64::from(c as f32), c, "{}", sample.name());
                }
            }
        }
    }
}

/// What construction says, and what rational arithmetic says.
#[cfg(feature = "oracle")]
mod against_the_oracle {
    use super::*;
    use crate::oracle::Oracle;
    use num_rational::BigRational;

    fn placements() -> Vec<Placement> {
        let mut all = Placement::signed_permutations();
        for q in [[1, 2, 2, 4], [3, -1, 2, 5], [0, 1, 1, 0], [8, 7, -6, 5]] {
            let rotated = Placement::rotated(q);
            all.push(rotated);
            all.push(rotated.moved_to([11.0, -6.0, 3.0].into()).scaled(20));
        }
        all.push(Placement::IDENTITY.scaled(-1000));
        all.push(Placement::IDENTITY.scaled(900));
        all
    }

    #[test]
    fn every_sample_in_every_placement() {
        let mut tried = 0;
        for solid in Solid::ALL {
            let mut samples = singular_samples(&solid);
            samples.extend(near_misses(&solid));
            for placement in placements() {
                let frustum = placement.place(&solid).unwrap();
                let oracle = Oracle::new(&frustum);
                for sample in &samples {
                    let segment = placement.segment(&sample.segment);
                    let truth = oracle.clip(&segment).unwrap();
                    let name = format!("{} {} {placement:?}", solid.name, sample.name());
                    assert_eq!(truth.class, sample.expected.class, "{name}");
                    let part = truth.part.map(|p| ExpectedPart {
                        t: [p.entry.t, p.exit.t].map(|t| {
                            let near = crate::oracle::round_nearest::<f64>(&t);
                            assert_eq!(BigRational::from_float(near), Some(t), "{name}");
                            near
                        }),
                        clipped: [p.entry.clipped, p.exit.clipped],
                        faces: [p.entry.faces, p.exit.faces],
                        coplanar: p.coplanar,
                    });
                    assert_eq!(part, sample.expected.part, "{name}");
                    tried += 1;
                }
            }
        }
        assert_eq!(tried, (4 * 104 + 2 * 72 + 2 * 68) * placements().len());
    }
}
