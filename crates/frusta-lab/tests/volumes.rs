//! Volumes of every family of hard cases, compared with the oracle; metamorphic tests; invalid
//! volumes.
use frusta::oracle::Oracle;
use frusta::samples::{BLOCK, Family, Scene, hard_box, hard_obb, hard_sphere};
use frusta::{
    Aabb, Containment, Corners, Culler, Direction, EndRect, Face, FaceSet, FarCorners, Frustum,
    Obb, Pose, Rect, Shape, Sphere, Vec3, Volume, VolumeCounts, VolumeError,
};
use frusta_lab::{VolumeKind, VolumeTally, verify_volumes};

#[test]
fn every_family_is_classified_as_integers_do() {
    let mut sum = VolumeTally::default();
    let mut exact = 0;
    for &family in Family::ALL {
        for row in verify_volumes(family, 2 * BLOCK + 9, 3, 2, &|_| {}) {
            assert!(row.tally.is_clean(), "{row}");
            let is_box = matches!(row.kind, VolumeKind::Box | VolumeKind::BoxF32);
            exact += if is_box {
                row.tally.counts.false_accepts
            } else {
                0
            };
            sum += row.tally;
        }
    }
    // Nothing of this is vacuous: every class, every stage, false accepts.
    assert!(sum.classes.iter().all(|&n| n > 1000), "{sum:?}");
    let c = sum.counts;
    for stage in [
        c.filter_failures,
        c.double_doubles,
        c.expansions,
        c.integers,
        exact,
    ] {
        assert!(stage > 100, "{sum:?}");
    }
}

/// The culler of a frustum's shape in another pose.
fn mapped(frustum: &Frustum, pose: Pose) -> Culler {
    Culler::new(&Frustum::new(pose, *frustum.shape()).expect("a frustum"))
}

/// Scaling by a power of two and mirroring in a coordinate change no answer.
#[test]
fn scaling_and_mirroring_change_nothing() {
    for family in [
        Family::OffAxis,
        Family::Rotated,
        Family::HalfLattice,
        Family::Orthographic,
    ] {
        for block in 0..4 {
            let scene = family.scene(5, block);
            let frustum = scene.frustum();
            let culler = Culler::new(frustum);
            let pose = frustum.pose();
            let flip = |v: Vec3<f64>| Vec3::new(-v.x, v.y, v.z);
            let mirrored = mapped(frustum, Pose::new(flip(pose.origin), pose.axes.map(flip)));
            let k = 1024.0;
            let axes = pose.axes.map(|a| a * (1.0 / k));
            let scaled = mapped(frustum, Pose::new(pose.origin * k, axes));
            for index in block * BLOCK..(block + 1) * BLOCK {
                let v = hard_box::<f64>(&scene, 5, index);
                let expected = culler.classify_exact(v);
                let flipped = Aabb::new([-v.max.x, v.min.y, v.min.z], [-v.min.x, v.max.y, v.max.z]);
                assert_eq!(
                    mirrored.classify_exact(flipped),
                    expected,
                    "{family}: {v:?}"
                );
                let large = Aabb::new(v.min * k, v.max * k);
                assert_eq!(scaled.classify_exact(large), expected, "{family}: {v:?}");
                let v = hard_sphere::<f64>(&scene, 5, index);
                let large = Sphere::new(v.center * k, v.radius * k);
                assert_eq!(scaled.classify(large), culler.classify(v));
                assert_eq!(scaled.classify_exact(large), culler.classify_exact(v));
                let flipped = Sphere::new(flip(v.center), v.radius);
                assert_eq!(mirrored.classify(flipped), culler.classify(v));
                assert_eq!(mirrored.classify_exact(flipped), culler.classify_exact(v));
                let v = hard_obb::<f64>(&scene, 5, index);
                let expected = culler.classify_exact(v);
                let large = Obb::new(v.center * k, v.half_axes.map(|h| h * k));
                assert_eq!(scaled.classify_exact(large), expected, "{family}: {v:?}");
                let flipped = Obb::new(flip(v.center), v.half_axes.map(flip));
                assert_eq!(
                    mirrored.classify_exact(flipped),
                    expected,
                    "{family}: {v:?}"
                );
                let [a, b, c] = v.half_axes;
                let renamed = Obb::new(v.center, [c, -a, b]);
                assert_eq!(culler.classify_exact(renamed), expected, "{family}: {v:?}");
            }
        }
    }
}

/// Answers decided in `f64` and in integers, both ways, for every kind of volume.
#[test]
fn the_exact_test_reaches_every_stage() {
    let kinds: [fn(&Scene, u64) -> Volume; 3] = [
        |scene, n| hard_box::<f64>(scene, 9, n).into(),
        |scene, n| hard_obb::<f64>(scene, 9, n).into(),
        |scene, n| hard_sphere::<f64>(scene, 9, n).into(),
    ];
    for (kind, volume) in kinds.iter().enumerate() {
        let mut found = [[0; 2]; 2];
        for &family in Family::ALL {
            for block in 0..3 {
                let scene = family.scene(9, block);
                let culler = Culler::new(scene.frustum());
                for index in block * BLOCK..(block + 1) * BLOCK {
                    let volume = volume(&scene, index);
                    let (mut by_planes, mut all) = <[VolumeCounts; 2]>::default().into();
                    let _ = culler.classify_counted(volume, &mut by_planes);
                    let _ = culler.classify_exact_counted(volume, &mut all);
                    if all.exact_tests == 1 {
                        let by_integers = all.filter_failures > by_planes.filter_failures;
                        found[usize::from(by_integers)][all.false_accepts as usize] += 1;
                    }
                }
            }
        }
        assert!(
            found.as_flattened().iter().all(|&n| n > 50),
            "{kind}: {found:?}"
        );
    }
}

/// An axis-aligned box is an oriented box, and a sphere or a box of zero size is a point.
#[test]
fn the_same_set_has_the_same_exact_answer() {
    for &family in Family::ALL {
        let scene = family.scene(4, 1);
        let culler = Culler::new(scene.frustum());
        for index in 0..BLOCK {
            let v = hard_box::<f64>(&scene, 4, index);
            let oriented = Obb::from(v);
            let Obb {
                center: c,
                half_axes: [x, y, z],
            } = oriented;
            let half = Vec3::new(x.x, y.y, z.z);
            if (c - half, c + half) == (v.min, v.max)
                && c + half - c == half
                && c - (c - half) == half
            {
                let expected = culler.classify_exact(v);
                assert_eq!(culler.classify_exact(oriented), expected, "{family}: {v:?}");
            }
            let at = hard_sphere::<f64>(&scene, 4, index).center;
            let expected = culler.classify_exact(at);
            assert_eq!(culler.classify_exact(Sphere::new(at, 0.0)), expected);
            assert_eq!(culler.classify_exact(Obb::new(at, [[0.0; 3]; 3])), expected);
        }
    }
}

/// Masks and hints of a hierarchy change no answer.
#[test]
fn masks_and_hints_change_nothing() {
    for &family in Family::ALL {
        let scene = family.scene(6, 0);
        let culler = Culler::new(scene.frustum());
        let all: FaceSet = scene.frustum().faces().iter().copied().collect();
        let mut hints = [None, Some(Face::Near), Some(Face::Top), Some(Face::Far)];
        for index in 0..BLOCK {
            let parent = hard_box::<f64>(&scene, 6, index);
            let volumes: [Volume; 3] = [
                parent.into(),
                hard_obb::<f64>(&scene, 6, index).into(),
                hard_sphere::<f64>(&scene, 6, index).into(),
            ];
            for volume in volumes {
                let expected = culler.classify(volume).unwrap();
                for hint in &mut hints {
                    let masked = culler.classify_masked(volume, all, hint).unwrap();
                    assert_eq!(masked.containment, expected, "{family}: {volume:?}");
                    let is_open = expected == Containment::Crossing;
                    assert_eq!(masked.faces.is_empty(), expected == Containment::Inside);
                    assert!(!is_open || !masked.faces.is_empty());
                }
            }
            // A part of the box, by the faces that the box crosses.
            let masked = culler.classify_masked(parent, all, &mut None).unwrap();
            let part = Aabb::new(
                parent.min,
                Vec3::new(parent.max.x, parent.min.y, parent.max.z),
            );
            let within = culler
                .classify_masked(part, masked.faces, &mut None)
                .unwrap();
            assert_eq!(
                Ok(within.containment),
                culler.classify(part),
                "{family}: {part:?}"
            );
        }
    }
}

/// Boxes as oriented boxes, and points as boxes, spheres and oriented boxes.
#[test]
fn kinds_agree() {
    for family in [Family::HalfLattice, Family::Infinite, Family::ApexWidth] {
        let scene = family.scene(8, 1);
        let culler = Culler::new(scene.frustum());
        for index in BLOCK..2 * BLOCK {
            let v = hard_box::<f32>(&scene, 8, index);
            let wide = v.to_f64();
            let half = (wide.max - wide.min) * 0.5;
            let zero = Vec3::new(0.0, 0.0, 0.0);
            let axes = [
                Vec3::new(half.x, 0.0, 0.0),
                Vec3::new(0.0, -half.y, 0.0),
                Vec3::new(0.0, 0.0, half.z),
            ];
            let center = (wide.min + wide.max) * 0.5;
            // Where that is exact.
            if center - half == wide.min && center + half == wide.max {
                let turned = Obb::new(center, axes);
                assert_eq!(culler.classify(turned), culler.classify(v), "{v:?}");
            }
            let p = wide.min;
            let as_box = culler.classify(p);
            assert_eq!(culler.classify(Sphere::new(p, 0.0)), as_box);
            assert_eq!(culler.classify(Obb::new(p, [zero; 3])), as_box);
            let is_inside = scene.frustum().contains(p).unwrap();
            assert_eq!(as_box == Ok(Containment::Inside), is_inside);
        }
    }
}

#[test]
fn invalid_volumes_are_rejected() {
    let near = frusta::EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = frusta::EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    let culler = Culler::new(&frustum);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut components = [0.0, 0.0, 2.0, 1.0, 1.0, 2.5];
        for i in 0..6 {
            let good = std::mem::replace(&mut components[i], bad);
            let [a, b, c, d, e, f] = components;
            let volume = Aabb::new([a, b, c], [d, e, f]);
            let name = ["min.x", "min.y", "min.z", "max.x", "max.y", "max.z"][i];
            // No bound on a side is none that is wrong.
            if bad == [f64::NEG_INFINITY, f64::INFINITY][i / 3] {
                assert!(culler.classify(volume).is_ok());
                components[i] = good;
                continue;
            }
            for error in [
                culler.classify(volume).unwrap_err(),
                culler.classify_exact(volume).unwrap_err(),
                culler
                    .classify_masked(volume, FaceSet::EMPTY, &mut None)
                    .unwrap_err(),
            ] {
                assert!(matches!(error, VolumeError::NonFinite { what, .. } if what == name));
            }
            let sphere = Sphere::new([a, b, c], d);
            assert_eq!(culler.classify(sphere).is_err(), i < 4);
            let turned = Obb::new([a, b, c], [[d, e, f], [0.0; 3], [f, e, d]]);
            assert!(culler.classify(turned).is_err());
            components[i] = good;
        }
    }
    let inverted = culler
        .classify(Aabb::new([0.0, 0.0, 2.0], [1.0, 1.0, 1.5]))
        .unwrap_err();
    let text = inverted.to_string();
    assert_eq!(
        text,
        "min.z = 2 is greater than max.z = 1.5; the box is inverted"
    );
    let negative = culler
        .classify(Sphere::new([0.0_f32; 3], -1.0))
        .unwrap_err();
    assert_eq!(negative.to_string(), "radius = -1; it must not be negative");
    // The largest and the least values are valid.
    let all = Aabb::new([-f64::MAX; 3], [f64::MAX; 3]);
    assert_eq!(culler.classify_exact(all), Ok(Containment::Crossing));
    let tiny = Aabb::new([0.0, 0.0, 2.0], [5e-324, 5e-324, 2.0]);
    assert_eq!(culler.classify_exact(tiny), Ok(Containment::Inside));
    let huge = Sphere::new([0.0; 3], f64::MAX);
    assert_eq!(culler.classify(huge), Ok(Containment::Crossing));
}

/// Wherever the box is, and however little it is inverted.
#[test]
fn a_box_inverted_in_one_coordinate_is_rejected() {
    let near = frusta::EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let far = frusta::EndRect::new(3.0, -3.0, 3.0, -3.0, 3.0);
    let frustum = Frustum::new(Pose::IDENTITY, Shape::Finite { near, far }).unwrap();
    let culler = Culler::new(&frustum);
    let all: FaceSet = frustum.faces().iter().copied().collect();
    for middle in [
        [0.0, 0.0, 2.0],
        [1.0, 1.0, 1.0],
        [9.0, 0.0, 2.0],
        [5e-324; 3],
    ] {
        for axis in 0..3 {
            for less in [0.25, f64::EPSILON * middle[axis], 5e-324] {
                let (min, mut max) = (middle, middle.map(|v| v + 0.125));
                max[axis] = min[axis] - less;
                if max[axis] == min[axis] {
                    continue;
                }
                let volume = Aabb::new(min, max);
                for error in [
                    culler.classify(volume).unwrap_err(),
                    culler.classify_exact(volume).unwrap_err(),
                    culler.classify_masked(volume, all, &mut None).unwrap_err(),
                ] {
                    let found = match error {
                        VolumeError::Inverted { axis, .. } => axis as usize,
                        _ => 3,
                    };
                    assert_eq!(found, axis, "{volume:?}");
                }
            }
        }
    }
}

/// Values without a pattern, always the same, in -1..1.
fn values() -> impl FnMut() -> f64 {
    let mut state = 88_172_645_463_325_252_u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Compares the exact answer with the oracle's; whether it is a false accept of `classify`.
fn check_exact(culler: &Culler, oracle: &Oracle, volume: Volume) -> bool {
    let found = culler.classify_exact(volume).expect("a volume");
    let meets = oracle.intersects(&volume);
    let case = (found, volume, culler.frustum());
    assert_eq!(found != Containment::Outside, meets, "{case:?}");
    !meets && culler.classify(volume) != Ok(Containment::Outside)
}

/// Spheres no larger than the rounding errors of their centers, which are on edges and vertices.
#[test]
fn spheres_as_small_as_rounding_errors() {
    let mut next = values();
    let mut separate = 0;
    for family in [Family::Random, Family::OffAxis, Family::FreePose] {
        for block in 0..40 {
            let scene = family.scene(8, block);
            let (culler, oracle) = (Culler::new(scene.frustum()), Oracle::new(scene.frustum()));
            let Corners { near, far } = scene.frustum().corners();
            let FarCorners::Points(far) = far else {
                continue;
            };
            for i in 0..4 {
                for [a, b] in [[near[i], far[i]], [near[i], near[(i + 1) % 4]]] {
                    for step in 0..24 {
                        let along = match step {
                            0 | 1 => f64::from(step),
                            _ => 0.5 + 0.5 * next(),
                        };
                        let middle = a + (b - a) * along;
                        let size = middle.x.abs() + middle.y.abs() + middle.z.abs();
                        for k in -8..4 {
                            let radius = size * (1.0 + next() * 0.5) * 2.0_f64.powi(k - 53);
                            let sphere = Sphere::new(middle, radius).into();
                            separate += u32::from(check_exact(&culler, &oracle, sphere));
                        }
                    }
                }
            }
        }
    }
    assert!(separate > 100, "{separate}");
}

/// Boxes with an edge along a ray of an infinite frustum, or nearly so: whether the ray descends
/// along the normal of such a box's face depends on rounding.
#[test]
fn boxes_along_a_ray() {
    let mut next = values();
    let near = EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0);
    let shape = Shape::Infinite {
        near,
        slopes: Rect::new(-1.0, 1.0, -1.0, 1.0),
        direction: Direction::PlusZ,
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape).expect("a frustum");
    let (culler, oracle) = (Culler::new(&frustum), Oracle::new(&frustum));
    let mut separate = 0;
    for _ in 0..20_000 {
        let length = 1.0 + next();
        let nudge = |n: f64| length * (1.0 + f64::EPSILON * (2.0 * n).round());
        let along = [nudge(next()), nudge(next()), length];
        let mut vector = |scale: f64| [scale * next(), scale * next(), scale * next()];
        let half_axes = [along, vector(0.3), vector(0.3)];
        // Around the edge that continues from x = y = 1.
        let [x, y, z] = vector(1.0);
        let center = [4.0 + 0.3 * x, 4.0 + 0.3 * y, 3.7 + 0.3 * z];
        let volume = Obb::new(center, half_axes).into();
        separate += u32::from(check_exact(&culler, &oracle, volume));
    }
    assert!(separate > 500, "{separate}");
}
