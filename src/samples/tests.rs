//! Numbers and exactness of the samples.

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
fn placed_samples_are_exact_in_f32() {
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

/// The answers by construction, compared with rational arithmetic.
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

    /// A family is useful only if its answers are of several kinds.
    #[test]
    fn families_reach_what_they_are_for() {
        for &family in Family::ALL {
            let (mut classes, mut surface, mut cases) = (BTreeSet::new(), 0, 0);
            for block in 0..24 {
                let scene = family.scene(1, block);
                let oracle = Oracle::new(scene.frustum());
                for index in block * BLOCK..block * BLOCK + 8 {
                    let segment = family.segment::<f64>(&scene, 1, index);
                    let truth = oracle.clip(&segment).unwrap();
                    classes.insert(truth.class);
                    let part = truth.part.as_ref();
                    surface += usize::from(part.is_some_and(|p| !p.entry.faces.is_empty()));
                    cases += 1;
                }
            }
            assert!(classes.len() >= 3, "{family}: {classes:?}");
            assert!(
                surface * 8 > cases,
                "{family}: {surface} of {cases} on the surface"
            );
        }
    }

    /// The share of cases within 4 ulp of a feature.
    fn share_near<T: crate::math::Real>(family: Family) -> f64 {
        let (mut near, mut cases) = (0, 0);
        for block in 0..40 {
            let scene = family.scene(1, block);
            let oracle = Oracle::new(scene.frustum());
            for index in block * BLOCK..block * BLOCK + 32 {
                let segment = family.segment::<T>(&scene, 1, index);
                near += u32::from(oracle.is_near(&segment));
                cases += 1;
            }
        }
        f64::from(near) / f64::from(cases)
    }

    #[test]
    fn half_of_the_cases_are_near_a_feature() {
        for &family in Family::ALL {
            let share = share_near::<f64>(family);
            assert!(share >= 0.5, "{family}: {share}");
            if family.has_f32() {
                let share = share_near::<f32>(family);
                assert!(share >= 0.5, "{family} in f32: {share}");
            }
        }
    }

    #[test]
    fn close_crossings_are_closer_than_promised() {
        let bound = BigRational::new(1.into(), num_bigint::BigInt::from(1) << 100);
        let mut crossed = 0;
        for index in 0..640 {
            let (frustum, segment) = Family::CrossingClose.case(9, index);
            let truth = Oracle::new(&frustum).clip(&segment).unwrap();
            if let Some(part) = truth.part.filter(|p| p.entry.clipped && p.exit.clipped) {
                assert!(part.exit.t - part.entry.t < bound);
                crossed += 1;
            }
        }
        assert!(crossed > 50, "{crossed}");
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

#[test]
fn family_names_are_unique_and_parse() {
    let names: BTreeSet<_> = Family::ALL.iter().map(|f| f.name()).collect();
    assert_eq!(names.len(), Family::ALL.len());
    for &family in Family::ALL {
        assert_eq!(family.name().parse(), Ok(family));
    }
    assert!("no-such".parse::<Family>().is_err());
}

#[test]
fn cases_are_finite_and_reproducible() {
    for &family in Family::ALL {
        for index in 0..300 {
            let (frustum, segment) = family.case(5, index);
            assert!(segment.check_finite().is_ok(), "{family} {index}");
            let (again, same) = family.case(5, index);
            assert_eq!(segment, same, "{family} {index}");
            assert_eq!(frustum.pose(), again.pose(), "{family} {index}");
            assert_eq!(frustum.shape(), again.shape(), "{family} {index}");
            if let Some((_, single)) = family.case_f32(5, index) {
                assert!(single.check_finite().is_ok(), "{family} {index}");
            }
        }
    }
}

#[test]
fn seeds_make_a_difference() {
    for &family in Family::ALL {
        let differ = (0..64).filter(|&i| family.case(1, i).1 != family.case(2, i).1);
        assert!(differ.count() > 32, "{family}");
    }
}

#[test]
fn no_family_falls_back_on_another_shape() {
    for &family in Family::ALL {
        let made = (0..400).filter(|&b| scene::Scene::attempt(family, 3, b, 0).is_some());
        // Tiny integer rectangles may be flat; the next attempt is then used.
        let made = made.count();
        assert!(made > 250, "{family}: {made} of 400");
    }
}

/// The smallest and the largest of the cases' largest coordinates.
fn extent<T: crate::math::Real>(family: Family) -> [f64; 2] {
    let mut found = [f64::INFINITY, 0.0_f64];
    for block in 0..100 {
        let scene = family.scene(11, block);
        for index in block * BLOCK..block * BLOCK + 16 {
            let segment = family.segment::<T>(&scene, 11, index);
            let ends = [segment.start, segment.end].map(|p| p.to_f64().to_array());
            let most = ends
                .concat()
                .into_iter()
                .fold(0.0, |a: f64, b| a.max(b.abs()));
            found = [found[0].min(most), found[1].max(most)];
        }
    }
    found
}

#[test]
fn coordinates_are_as_large_as_claimed() {
    for (family, low, high) in [
        (Family::FarFromOrigin, 0.999e15, 1.001e15),
        (Family::SingleFar, 0.99e7, 1.01e15),
        (Family::EarthCentred, 0.5 * 6.378e6, 2.0 * 6.378e6),
        (Family::Astronomical, 1e17, 1e19),
        (Family::Subnormal, 5e-324, f64::MIN_POSITIVE),
        (Family::ProductsUnderflow, 1e-162, 1e-155),
        (Family::ProductsOverflow, 1e153, 1e160),
        (Family::Huge, 1e296, 1e305),
    ] {
        let [least, most] = extent::<f64>(family);
        assert!(least >= low && most <= high, "{family}: {least:e} {most:e}");
        if family.has_f32() {
            let [least, most] = extent::<f32>(family);
            assert!(least >= low && most <= high, "{family}: {least:e} {most:e}");
        }
    }
}

/// The shares must not depend on which shapes are flat and replaced.
#[test]
fn far_away_there_are_two_kinds_in_equal_shares() {
    let mut small = 0;
    for block in 0..400 {
        let scene = Family::FarFromOrigin.scene(11, block);
        let (origin, near) = (
            scene.frustum().pose().origin,
            scene.frustum().shape().near(),
        );
        let at_origin = origin.x.abs() > 0.99e15;
        assert_eq!(at_origin, near.z.abs() < 1e-2, "{block}");
        assert!(at_origin || near.z.abs() > 0.99e15, "{block}");
        small += usize::from(at_origin);
    }
    assert_eq!(small, 200);
}

#[test]
fn f32_is_strained_at_each_distance() {
    let mut blocks = [0; 3];
    for block in 0..400 {
        let scene = Family::SingleFar.scene(11, block);
        let z = scene.frustum().shape().near().z.abs();
        let at = [1e7, 3e10, 1e15].map(|far: f64| (z / far - 1.0).abs() < 1e-3);
        assert_eq!(at.iter().filter(|&&is| is).count(), 1, "{z:e}");
        at.iter()
            .zip(&mut blocks)
            .for_each(|(&is, n)| *n += usize::from(is));
    }
    assert!(blocks.iter().all(|&n| n > 90), "{blocks:?}");
}
