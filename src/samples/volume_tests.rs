//! The volumes have the intended positions relative to their frusta.

use super::*;
use crate::cull::{Aabb, Containment, Obb, Sphere, Volume};
use crate::math::{Real, Vec3};
use crate::oracle::Oracle;
use std::collections::BTreeMap;

/// A coordinate moved by some ulps; a zero by those of `scale`.
fn stepped<T: Real>(c: T, ulps: i32, scale: T) -> T {
    if c == T::ZERO {
        return T::from_f64(scale.to_f64() * 2.0 * T::UNIT_ROUNDOFF * f64::from(ulps));
    }
    let step = |c: T, _| if ulps > 0 { c.next_up() } else { c.next_down() };
    (0..ulps.abs()).fold(c, step)
}

fn moved<T: Real>(v: Vec3<T>, ulps: [i32; 3]) -> Vec3<T> {
    let scale = segments::largest(v);
    Vec3::from([0, 1, 2].map(|k| stepped(v[k], ulps[k], scale)))
}

/// All eight combinations of moving each coordinate by `ulps` up or down.
fn ways(ulps: i32) -> impl Iterator<Item = [i32; 3]> {
    (0..8).map(move |i| [0, 1, 2].map(|k| if i >> k & 1 == 0 { ulps } else { -ulps }))
}

/// A volume and its neighbours, whose numbers differ by at most the given ulps.
trait Hard: Copy + Into<Volume> {
    fn make(scene: &Scene, index: u64) -> Self;
    fn neighbours(self, ulps: i32) -> Vec<Self>;
}

impl<T: Real> Hard for Aabb<T> {
    fn make(scene: &Scene, index: u64) -> Self {
        hard_box(scene, 1, index)
    }

    /// The smallest, if there is one, and the largest.
    fn neighbours(self, ulps: i32) -> Vec<Self> {
        let by = |n: i32| Aabb::new(moved(self.min, [-n; 3]), moved(self.max, [n; 3]));
        let all = [by(-ulps), by(ulps)].into_iter();
        all.filter(|b| b.check().is_ok()).collect()
    }
}

impl<T: Real> Hard for Obb<T> {
    fn make(scene: &Scene, index: u64) -> Self {
        hard_obb(scene, 1, index)
    }

    fn neighbours(self, ulps: i32) -> Vec<Self> {
        let by = |n: [i32; 3]| Obb {
            center: moved(self.center, n),
            ..self
        };
        ways(ulps).map(by).collect()
    }
}

impl<T: Real> Hard for Sphere<T> {
    fn make(scene: &Scene, index: u64) -> Self {
        hard_sphere(scene, 1, index)
    }

    fn neighbours(self, ulps: i32) -> Vec<Self> {
        let by = |n: [i32; 3]| Sphere {
            center: moved(self.center, n),
            ..self
        };
        ways(ulps).map(by).collect()
    }
}

/// Some cases of eight blocks of a family, with the oracle.
fn cases<V: Hard>(family: Family, of_block: u64, mut each: impl FnMut(&Oracle, V)) {
    for block in 0..8 {
        let scene = family.scene(1, block);
        let oracle = Oracle::new(scene.frustum());
        for index in block * BLOCK..block * BLOCK + of_block {
            each(&oracle, V::make(&scene, index));
        }
    }
}

fn share_near<V: Hard>(family: Family) -> f64 {
    let (mut near, mut all) = (0, 0);
    cases(family, 32, |oracle, volume: V| {
        let answer = |v: V| {
            let v = v.into();
            (oracle.volume_faces(&v), oracle.intersects(&v))
        };
        let own = answer(volume);
        let mut neighbours = volume.neighbours(4).into_iter();
        near += u32::from(neighbours.any(|v| answer(v) != own));
        all += 1;
    });
    f64::from(near) / f64::from(all)
}

#[test]
fn half_of_the_volumes_would_have_another_answer_4_ulps_away() {
    fn check<T: Real>(family: Family) {
        let boxes = share_near::<Aabb<T>>(family);
        let oriented = share_near::<Obb<T>>(family);
        let spheres = share_near::<Sphere<T>>(family);
        for share in [boxes, oriented, spheres] {
            assert!(share >= 0.5, "{family}: {boxes}, {oriented}, {spheres}");
        }
    }
    for &family in Family::ALL {
        check::<f64>(family);
        if family.has_f32() {
            check::<f32>(family);
        }
    }
}

/// The plane that separates a box from a frustum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Between {
    /// The plane of a face of the frustum.
    Plane,
    /// The plane of a face of the box.
    BoxFace,
    /// Only a plane along an edge of each.
    Edges,
    /// They have a point in common.
    Nothing,
}

fn between(oracle: &Oracle, v: Aabb<f64>) -> Between {
    if !oracle.volume_faces(&v.into()).0.is_empty() {
        return Between::Plane;
    }
    if oracle.intersects(&v.into()) {
        return Between::Nothing;
    }
    // The whole range of f64, except in one coordinate.
    let layer = |k: usize| {
        let far = 0.25 * f64::MAX;
        let mut layer = Aabb::new([-far; 3], [far; 3]);
        (layer.min[k], layer.max[k]) = (v.min[k], v.max[k]);
        layer
    };
    if (0..3).any(|k| !oracle.intersects(&layer(k).into())) {
        Between::BoxFace
    } else {
        Between::Edges
    }
}

/// Numbers of boxes of all families, by the separating planes of the box 4 ulp smaller and
/// of the box 4 ulp larger.
fn changes() -> BTreeMap<[Between; 2], u32> {
    let mut found = BTreeMap::new();
    for &family in Family::ALL {
        cases(family, 16, |oracle, v: Aabb<f64>| {
            if let [smaller, larger] = v.neighbours(4)[..] {
                let change = [smaller, larger].map(|v| between(oracle, v));
                *found.entry(change).or_default() += 1;
            }
        });
    }
    found
}

#[test]
fn boxes_touch_or_miss_by_every_kind_of_plane() {
    use Between::{BoxFace, Edges, Nothing, Plane};
    let found = changes();
    for (change, least) in [
        // Touching from outside.
        ([Plane, Nothing], 1000),
        ([BoxFace, Nothing], 250),
        ([Edges, Nothing], 80),
        // Touching the plane of a face, but not the frustum.
        ([Plane, BoxFace], 5),
        ([Plane, Edges], 5),
        // Separated by the same kind in both cases, or by none.
        ([Plane, Plane], 500),
        ([BoxFace, BoxFace], 100),
        ([Edges, Edges], 40),
        ([Nothing, Nothing], 800),
    ] {
        let count = found.get(&change).copied().unwrap_or(0);
        assert!(count >= least, "{change:?}: {count} of {found:?}");
    }
}

/// Numbers of volumes for which a volume 4 ulp away has another answer, by query: outside,
/// inside, and a point in common though no plane's answer changes.
fn answers<V: Hard>(family: Family) -> [u32; 3] {
    let mut counts = [0; 3];
    cases(family, 16, |oracle, volume: V| {
        let all: Vec<Volume> = volume.neighbours(4).into_iter().map(V::into).collect();
        let differ = |answer: &dyn Fn(&Volume) -> bool| {
            let yes = all.iter().filter(|v| answer(v)).count();
            yes > 0 && yes < all.len()
        };
        let outside = differ(&|v| oracle.classify(v) == Containment::Outside);
        let inside = differ(&|v| oracle.classify(v) == Containment::Inside);
        let by_edges = !outside && differ(&|v| oracle.intersects(v));
        for (count, is) in counts.iter_mut().zip([outside, inside, by_edges]) {
            *count += u32::from(is);
        }
    });
    counts
}

#[test]
fn every_question_is_close_in_every_kind_of_volume() {
    let mut all = [[0; 3]; 3];
    for &family in Family::ALL {
        let counts = [
            answers::<Aabb<f64>>(family),
            answers::<Obb<f64>>(family),
            answers::<Sphere<f64>>(family),
        ];
        for (sum, counts) in all.iter_mut().zip(counts) {
            assert!(counts[0] > 0, "{family}: {counts:?}");
            for (sum, count) in sum.iter_mut().zip(counts) {
                *sum += count;
            }
        }
    }
    let least = [[1000, 200, 300]; 3];
    for (counts, least) in all.iter().flatten().zip(least.iter().flatten()) {
        assert!(counts >= least, "{all:?}");
    }
}

#[test]
fn boxes_of_all_sizes() {
    let (mut points, mut flat, mut holding) = (0, 0, 0);
    for &family in Family::ALL {
        let scene = family.scene(1, 0);
        let grid = |i: u32| [0, 1, 2].map(|k| f64::from(i >> k & 1));
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| scene.at(grid(i)));
        for index in 0..BLOCK {
            let Aabb { min, max } = hard_box::<f64>(&scene, 1, index);
            let zeros = (0..3).filter(|&k| min[k] == max[k]).count();
            points += u32::from(zeros == 3);
            flat += u32::from(zeros == 1);
            let holds = |p: Vec3<f64>| (0..3).all(|k| min[k] <= p[k] && p[k] <= max[k]);
            holding += u32::from(corners.into_iter().all(holds));
        }
    }
    assert!(points > 20 && flat > 100 && holding > 50);
}

#[test]
fn volumes_are_valid_and_reproducible() {
    fn check<T: Real>(scene: &Scene, index: u64) {
        let (a, b) = (
            hard_box::<T>(scene, 5, index),
            hard_obb::<T>(scene, 5, index),
        );
        let c = hard_sphere::<T>(scene, 5, index);
        assert_eq!((a.check(), b.check(), c.check()), (Ok(()), Ok(()), Ok(())));
        assert_eq!(a, hard_box(scene, 5, index));
        assert_eq!(b, hard_obb(scene, 5, index));
        assert_eq!(c, hard_sphere(scene, 5, index));
        assert_ne!(
            (a, b, c),
            (
                hard_box(scene, 6, index),
                hard_obb(scene, 6, index),
                hard_sphere(scene, 6, index),
            )
        );
    }
    for &family in Family::ALL {
        for block in 0..20 {
            let scene = family.scene(5, block);
            for index in block * BLOCK..block * BLOCK + 16 {
                check::<f64>(&scene, index);
                check::<f32>(&scene, index);
            }
        }
    }
}
