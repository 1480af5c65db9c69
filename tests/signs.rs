//! Segments that need a term of an error bound: each has a wrong answer if one term of a sign
//! test is omitted (see `scripts/mutants`).

use frusta::samples::Random;
use frusta::{Direction, EndRect, Face, FaceSet, Frustum, Pose, Rect, Segment, Shape, Vec3};
use frusta_lab::check::assert_guarantees;

/// Segments through or near the edge of near and left that cross near at a small angle: its
/// crossing is the less certain one.
#[test]
fn a_near_end_far_out() {
    let mut random = Random::new(&[1]);
    let far = 2.0_f64.powi(30);
    let shape = Shape::Finite {
        near: EndRect::new(far, -1e6, 1e6, -1.0, 1.0),
        far: EndRect::new(2.0 * far, -1e6, 1e6, -1.0, 1.0),
    };
    for _ in 0..3000 {
        let angle = random.between(0.1, 1.5);
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        let axes = [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]].map(Vec3::from);
        let frustum = Frustum::new(Pose::new(Vec3::default(), axes), shape).unwrap();
        let world = |x: f64, y: f64, z: f64| [x, c * y - s * z, s * y + c * z];
        let [dx, dz] = [2e3, 0.002].map(|d| d * random.between(1.0, 2.0));
        let off = random.between(-0.3, 0.3);
        let y = random.between(-0.1, 0.1);
        let segment = Segment::new(
            world(-1e6 - dx + off, y, far - dz),
            world(-1e6 + dx + off, y, far + dz),
        );
        assert_guarantees(&frustum, &segment);
    }
}

/// Near and far are an ulp apart, and the parameters of their crossings are closer than that.
#[test]
fn ends_an_ulp_apart() {
    let mut random = Random::new(&[2]);
    for _ in 0..500 {
        let z = random.between(1.0, 2.0);
        let shape = Shape::Finite {
            near: EndRect::new(z, -1e9, 1e9, -1e9, 1e9),
            far: EndRect::new(z.next_up(), -1e9, 1e9, -1e9, 1e9),
        };
        let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
        let mut end = |z: f64| [0, 1, 2].map(|k| random.between(1.0, 1e3) * [1.0, 1.0, z][k]);
        let segment = Segment::new(end(-1.0), end(1.0));
        assert_guarantees(&frustum, &segment);
    }
}

/// Differences of the ends overflow.
#[test]
fn segments_as_long_as_the_range_of_f64() {
    let mut random = Random::new(&[3]);
    let shape = Shape::Finite {
        near: EndRect::new(1.0, -1.0, 1.0, -1.0, 1.0),
        far: EndRect::new(4.0, -2.0, 2.0, -2.0, 2.0),
    };
    let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
    for i in 0..500 {
        // Approximately opposite ends of a line through the frustum.
        let scale = [1.0, 0.9, 0.5, 0.2][i % 4] * f64::MAX;
        let v = [0, 1, 2].map(|_| scale * random.between(-1.0, 1.0));
        let near = |x: f64| -x * (1.0 + 1e-16 * random.between(-0.5, 0.5));
        let segment = Segment::new(v, v.map(near));
        assert_guarantees(&frustum, &segment);
    }
}

/// Products of two values are subnormal: through the edges of an apex.
#[test]
fn an_apex_below_the_range_of_products() {
    let mut random = Random::new(&[4]);
    for exponent in [-565, -566, -567, -569] {
        let unit = 2.0_f64.powi(exponent);
        for _ in 0..500 {
            let mut slope = || random.integer(1, 9) as f64 * 0.25;
            let slopes = Rect::new(-slope(), slope(), -slope(), slope());
            let shape = Shape::Infinite {
                near: EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0),
                slopes,
                direction: Direction::PlusZ,
            };
            let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
            let edge = Vec3::new(slopes.left, slopes.bottom, 1.0);
            let at = edge * (unit * 4.0 * random.integer(1, 1 << 38) as f64);
            let along = [0, 1, 2].map(|_| unit * random.integer(-1 << 38, 1 << 38) as f64);
            let along = Vec3::from(along);
            let [before, behind] = [0, 1].map(|_| random.integer(1, 9) as f64);
            let segment = Segment::new(at - along * before, at + along * behind);
            assert_guarantees(&frustum, &segment);
        }
    }
}

/// Two sides are crossed at exactly the same point. Double-double arithmetic computes it with
/// errors, large ones at the far start, where one side is much closer than the other.
#[test]
fn a_tie_seen_from_far_away() {
    let mut random = Random::new(&[5]);
    let small = 2.0_f64.powi(-20);
    for i in 0..600 {
        // Few bits, so that the second axis is exact.
        let mut short = || (random.between(0.5, 1.0) as f32).into();
        let (a, c): (f64, f64) = (short(), short());
        let b = random.between(0.5, 1.0);
        // The second is `small` times the first wherever world x = z, by other
        // roundings of the same size.
        let mut axes = [
            Vec3::new(a, b, c),
            Vec3::new(c * small + 1.0, b * small, a * small - 1.0),
            Vec3::new(0.0, 1.0, 0.0),
        ];
        let mut rect = Rect::new(3.0, 8.0, 3.0 * small, 8.0);
        if i % 2 == 0 {
            axes.swap(0, 1);
            rect = Rect::new(rect.bottom, rect.top, rect.left, rect.right);
        }
        let shape = Shape::Finite {
            near: EndRect { z: -1e15, rect },
            far: EndRect { z: 1e15, rect },
        };
        let frustum = Frustum::new(Pose::new(Vec3::default(), axes), shape).unwrap();
        let point = |x: f64, p: f64| [p, (x - (a + c) * p) / b, p];
        let far = random.between(0.5, 1.0) * 2.0_f64.powi(40);
        let end = point(3.0 + random.between(0.1, 0.2), random.between(-1.0, 1.0));
        let segment = Segment::new(point(2.0, far), end);
        let part = frustum.clip_segment(&segment).unwrap().part.unwrap();
        let both = FaceSet::from(Face::Left).union(FaceSet::from(Face::Bottom));
        assert_eq!(part.entry.faces, both);
        assert_guarantees(&frustum, &segment);
    }
}
