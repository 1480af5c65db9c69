//! The exact clipper compared with the oracle, for frusta and segments that are singular by
//! construction: ends on vertices, edges, faces and lattice points, nudged by a few
//! units in the last place, carried to other poses and scales.

use frusta::oracle::Oracle;
use frusta::{
    Accuracy, Direction, EndRect, Frustum, Pose, Real, Rect, Segment, Shape, StageCounts, Vec3,
};
use proptest::prelude::*;

const ACCURACIES: [Accuracy; 3] = [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward];

fn dyadic(range: std::ops::RangeInclusive<i32>, unit: f64) -> impl Strategy<Value = f64> {
    range.prop_map(move |i| f64::from(i) * unit)
}

fn rect() -> impl Strategy<Value = [f64; 4]> {
    let side = || dyadic(0..=12, 0.25);
    prop_oneof![
        (1..=8_i32, 1..=8_i32).prop_map(|(w, h)| {
            let (w, h) = (f64::from(w) * 0.5, f64::from(h) * 0.5);
            [-w, w, -h, h]
        }),
        (dyadic(-8..=8, 0.25), side(), dyadic(-8..=8, 0.25), side()).prop_map(|(l, w, b, h)| [
            l,
            l + w,
            b,
            b + h
        ]),
    ]
}

fn shape() -> impl Strategy<Value = Shape> {
    let z = || dyadic(-16..=16, 0.5);
    let end = |z, [l, r, b, t]: [f64; 4]| EndRect::new(z, l, r, b, t);
    prop_oneof![
        4 => (z(), rect(), z(), rect()).prop_map(move |(n, a, f, b)| Shape::Finite {
            near: end(n, a),
            far: end(f, b),
        }),
        1 => (z(), rect(), z()).prop_map(move |(n, a, f)| Shape::Finite {
            near: end(n, a),
            far: end(f, a),
        }),
        1 => (z(), rect(), rect(), any::<bool>()).prop_map(move |(n, a, s, up)| {
            let [l, r, b, t] = s;
            Shape::Infinite {
                near: end(n, a),
                slopes: Rect::new(l, r, b, t),
                direction: if up { Direction::PlusZ } else { Direction::MinusZ },
            }
        }),
    ]
}

/// The rows of the rotation by an integer quaternion, times its squared length.
fn integer_axes([w, x, y, z]: [i32; 4]) -> [Vec3<f64>; 3] {
    let row = |a: i32, b: i32, c: i32| Vec3::new(a.into(), b.into(), c.into());
    [
        row(
            w * w + x * x - y * y - z * z,
            2 * (x * y - w * z),
            2 * (x * z + w * y),
        ),
        row(
            2 * (x * y + w * z),
            w * w - x * x + y * y - z * z,
            2 * (y * z - w * x),
        ),
        row(
            2 * (x * z - w * y),
            2 * (y * z + w * x),
            w * w - x * x - y * y + z * z,
        ),
    ]
}

fn pose() -> impl Strategy<Value = Pose> {
    let coordinate = || dyadic(-64..=64, 0.25);
    let far = prop_oneof![4 => Just(1.0), 1 => Just(1e6), 1 => Just(1e-150), 1 => Just(1e15)];
    prop_oneof![
        2 => Just(Pose::IDENTITY),
        1 => (prop::array::uniform4(-3..=3_i32), prop::array::uniform3(coordinate()), far)
            .prop_map(|(q, o, s)| Pose::new(
                Vec3::new(o[0] * s, o[1] * s, o[2] * s),
                integer_axes(q),
            )),
        1 => prop::array::uniform4(-1.0..1.0_f64).prop_map(|q| {
            let [a, b, c] = integer_axes([1, 2, -1, 1]);
            let [x, y, z, _] = q;
            Pose::new(
                Vec3::new(x * 7.0, y, z),
                [a * (1.0 / 7.0), b * (1.0 / 7.0), c * (q[3] + 1.1)],
            )
        }),
    ]
}

#[derive(Clone, Copy, Debug)]
struct Spot {
    /// Barycentric-like weights in eighths across near..far, left..right,
    /// bottom..top.
    weights: [i32; 3],
    ulps: [i32; 3],
}

fn spot() -> impl Strategy<Value = Spot> {
    let weight = || prop_oneof![3 => Just(0), 3 => Just(8), 2 => 1..8_i32, 1 => -4..12_i32];
    let ulps = || prop_oneof![4 => Just(0), 1 => -2..=2_i32];
    (
        prop::array::uniform3(weight()),
        prop::array::uniform3(ulps()),
    )
        .prop_map(|(weights, ulps)| Spot { weights, ulps })
}

fn nudge<T: Real>(value: T, ulps: i32) -> T {
    (0..ulps.abs()).fold(
        value,
        |v, _| if ulps < 0 { v.next_down() } else { v.next_up() },
    )
}

/// The spot in the frame, then in the world, rounded.
fn place<T: Real>(frustum: &Frustum, spot: Spot) -> Vec3<T> {
    let [d, x, y] = spot.weights.map(|w| f64::from(w) / 8.0);
    let shape = frustum.shape();
    let near = shape.near();
    let far = shape.far().unwrap_or_else(|| {
        let Shape::Infinite {
            near,
            slopes,
            direction,
        } = *shape
        else {
            return near;
        };
        let [l, r, b, t] = near.rect.to_array();
        let [sl, sr, sb, st] = slopes.to_array();
        EndRect::new(
            near.z + 8.0 * direction.sign(),
            l + 8.0 * sl,
            r + 8.0 * sr,
            b + 8.0 * sb,
            t + 8.0 * st,
        )
    });
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let (n, f) = (near.rect, far.rect);
    let q = Vec3::new(
        mix(mix(n.left, f.left, d), mix(n.right, f.right, d), x),
        mix(mix(n.bottom, f.bottom, d), mix(n.top, f.top, d), y),
        mix(near.z, far.z, d),
    );
    let p = Vec3::<T>::from_f64(frustum.pose().to_world(q));
    let [ux, uy, uz] = spot.ulps;
    Vec3::new(nudge(p.x, ux), nudge(p.y, uy), nudge(p.z, uz))
}

/// A segment between two spots, extended along their line by powers of two.
fn segment<T: Real>(frustum: &Frustum, spots: [Spot; 2], reach: [i32; 2]) -> Segment<T> {
    let [a, b] = spots.map(|spot| place::<T>(frustum, spot));
    let d = b - a;
    let beyond = |p: Vec3<T>, by: i32| p + d * T::from_f64(f64::from(by) * 0.5);
    Segment::new(beyond(a, -reach[0]), beyond(b, reach[1]))
}

fn check<T: Real>(frustum: &Frustum, segment: &Segment<T>) -> Result<(), TestCaseError> {
    if segment.check_finite().is_err() {
        return Ok(());
    }
    let oracle = Oracle::new(frustum);
    let truth = oracle
        .clip(segment)
        .map_err(|e| TestCaseError::fail(e.to_string()))?;
    for accuracy in ACCURACIES {
        let mut counts = StageCounts::default();
        let clip = |s: &Segment<T>, counts: &mut StageCounts| {
            frustum
                .clip_segment_counted(s, accuracy, counts)
                .map_err(|e| TestCaseError::fail(e.to_string()))
        };
        let answer = clip(segment, &mut counts)?;
        let violations = oracle.check(&truth, segment, accuracy, &answer);
        let said: Vec<String> = violations.iter().map(ToString::to_string).collect();
        prop_assert!(
            said.is_empty(),
            "{accuracy:?} {counts:?}\n{frustum:?}\n{segment:?}\n{answer:?}\n{said:#?}"
        );
        let back = clip(&segment.reversed(), &mut counts)?;
        prop_assert_eq!(back.class, answer.class);
        if let (Some(there), Some(here)) = (back.part, answer.part) {
            prop_assert_eq!(there.coplanar, here.coplanar);
            for (a, b) in [(there.entry, here.exit), (there.exit, here.entry)] {
                prop_assert_eq!(
                    a.point,
                    b.point,
                    "{:?} {:?} {:?}",
                    accuracy,
                    frustum,
                    segment
                );
                prop_assert_eq!(a.faces, b.faces);
                prop_assert_eq!((a.clipped, a.inward), (b.clipped, b.inward));
            }
        }
        if accuracy == Accuracy::Inward
            && let Some(part) = answer.part
            && part.entry.inward
            && part.exit.inward
        {
            let again = clip(
                &Segment::new(part.entry.point, part.exit.point),
                &mut counts,
            )?;
            prop_assert_eq!(again.points(), Some([part.entry.point, part.exit.point]));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, max_global_rejects: 100_000, ..ProptestConfig::default() })]

    #[test]
    fn singular_segments_agree_with_the_oracle(
        shape in shape(), pose in pose(), spots in prop::array::uniform2(spot()),
        reach in prop::array::uniform2(prop_oneof![3 => Just(0), 1 => 1..4_i32]),
        power in prop_oneof![6 => Just(0), 1 => -40..40_i32, 1 => -500..450_i32],
    ) {
        let scale = 2.0_f64.powi(power);
        let Ok(frustum) = Frustum::new(pose, shape) else { return Ok(()) };
        let frustum = scaled(&frustum, scale);
        let Some(frustum) = frustum else { return Ok(()) };
        check::<f64>(&frustum, &segment(&frustum, spots, reach))?;
        check::<f32>(&frustum, &segment(&frustum, spots, reach))?;
    }
}

/// The frustum scaled about the world's origin.
fn scaled(frustum: &Frustum, s: f64) -> Option<Frustum> {
    let pose = frustum.pose();
    let end = |e: EndRect| {
        let [l, r, b, t] = e.rect.to_array();
        EndRect::new(e.z * s, l * s, r * s, b * s, t * s)
    };
    let shape = match *frustum.shape() {
        Shape::Finite { near, far } => Shape::Finite {
            near: end(near),
            far: end(far),
        },
        Shape::Infinite {
            near,
            slopes,
            direction,
        } => Shape::Infinite {
            near: end(near),
            slopes,
            direction,
        },
    };
    Frustum::new(Pose::new(pose.origin * s, pose.axes), shape).ok()
}
