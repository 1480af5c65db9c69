//! `Deviation` was rounded to nearest, so that about one small-integer matrix in
//! 40 had a vertex farther off than the number that bounds it. It is rounded up.
//!
//! The exact deviation is computed here from the frustum's public numbers and the
//! matrix, by rational arithmetic: Cramer's rule for each vertex.

use frusta::oracle::round_nearest;
use frusta::samples::Random;
use frusta::{
    ClipSpace, DepthRange, Frustum, MatrixFrustum, MatrixLayout, Real, Shape, Vec3, ViewProjection,
};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

type Exact = BigRational;
/// A linear function of a point: three coefficients and a constant.
type Row = [Exact; 4];

fn exact(value: f64) -> Exact {
    BigRational::from_float(value).unwrap()
}

fn determinant(m: &[[Exact; 3]; 3]) -> Exact {
    (0..3)
        .map(|j| {
            let (a, b) = ((j + 1) % 3, (j + 2) % 3);
            &m[0][j] * (&m[1][a] * &m[2][b] - &m[1][b] * &m[2][a])
        })
        .sum()
}

/// Where three linear functions have these values.
fn solve(rows: [&Row; 3], values: [&Exact; 3]) -> [Exact; 3] {
    let matrix = rows.map(|r| [r[0].clone(), r[1].clone(), r[2].clone()]);
    let whole = determinant(&matrix);
    std::array::from_fn(|j| {
        let mut replaced = matrix.clone();
        for i in 0..3 {
            replaced[i][j] = values[i] - &rows[i][3];
        }
        determinant(&replaced) / &whole
    })
}

fn at(row: &Row, p: &[Exact; 3]) -> Exact {
    (0..3).map(|j| &row[j] * &p[j]).sum::<Exact>() + &row[3]
}

/// The frame coordinates as functions of a point.
fn frame(frustum: &Frustum) -> [Row; 3] {
    let pose = frustum.pose();
    let origin = pose.origin.to_array().map(exact);
    pose.axes.map(|axis: Vec3<f64>| {
        let [a, b, c] = axis.to_array().map(exact);
        let constant = -(&a * &origin[0] + &b * &origin[1] + &c * &origin[2]);
        [a, b, c, constant]
    })
}

const SIGNS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// `a - depth b`.
fn less(a: &Row, depth: &Exact, b: &Row) -> Row {
    std::array::from_fn(|j| &a[j] - depth * &b[j])
}

/// The exact deviations `sides`, `near` and `far`; `None` for infinity.
fn deviation(m: &[[f64; 4]; 4], clip: ClipSpace, found: &MatrixFrustum) -> [Option<Exact>; 3] {
    let [x, y, z, w] = &m.map(|row| row.map(exact));
    let is_parallel = w[..3].iter().all(Zero::is_zero);
    let low = match clip.depth {
        DepthRange::ZeroToOne => 0.0,
        DepthRange::MinusOneToOne => -1.0,
    };
    let depths = if clip.reversed {
        [1.0, low]
    } else {
        [low, 1.0]
    };
    let shape = found.frustum.shape();
    let [fx, fy, fz] = &frame(&found.frustum);
    let mut sides = Some(Exact::zero());
    let mut ends = [Exact::zero(), Exact::zero()];
    for (i, end) in [Some(shape.near()), shape.far()].into_iter().enumerate() {
        let Some(end) = end else { continue };
        for sign in SIGNS {
            let across = if is_parallel { m[3][3] } else { end.z };
            let corner = [sign[0] * across, sign[1] * across, end.z].map(exact);
            let p = solve([fx, fy, fz], corner.each_ref());
            let at_p = [x, y, z, w].map(|row| at(row, &p));
            if at_p[3].is_positive() {
                for k in 0..2 {
                    let off = (&at_p[k] / &at_p[3] - exact(sign[k])).abs();
                    sides = sides.map(|s| s.max(off));
                }
            } else {
                sides = None;
            }
            let plane = less(z, &exact(depths[i]), w);
            let off = if is_parallel {
                // As a fraction of the depth, (1 - low) W.
                at(&plane, &p).abs() / (exact(1.0 - low) * exact(m[3][3]))
            } else {
                // The point of the plane with the same X and Y.
                let on_plane = solve([x, y, &plane], [&at_p[0], &at_p[1], &Exact::zero()]);
                (at(w, &on_plane) - &at_p[3]).abs() / exact(end.z)
            };
            ends[i] = ends[i].clone().max(off);
        }
    }
    if let Shape::Infinite { near, .. } = shape {
        // Along an edge of the clip volume, W = t.
        let plane = less(z, &exact(depths[1]), w);
        for sign in SIGNS {
            let along = |t: f64| {
                let values = [sign[0] * t, sign[1] * t, t].map(exact);
                at(&plane, &solve([x, y, w], values.each_ref()))
            };
            let (start, next) = (along(0.0), along(1.0));
            let slope = &next - &start;
            if (!start.is_zero() && !slope.is_zero()) && start.is_positive() != slope.is_positive()
            {
                let t = -start / slope;
                ends[1] = ends[1].clone().max(exact(near.z) / t);
            }
        }
    }
    let [near, far] = ends;
    [sides, Some(near), Some(far)]
}

/// Whether it is the least `f64` that is not below the exact value.
fn is_rounded_up(reported: f64, exact_value: Option<&Exact>) -> bool {
    match exact_value {
        None => reported == f64::INFINITY,
        Some(value) if value.is_zero() => reported == 0.0,
        Some(value) => exact(reported) >= *value && exact(reported.next_down()) < *value,
    }
}

#[test]
fn the_near_vertex_of_issue_13() {
    let m = [
        [0.0, 1.0, -1.0, 0.0],
        [2.0, 0.0, 1.0, -1.0],
        [1.0, 1.0, 1.0, -2.0],
        [1.0, 1.0, 1.0, -1.0],
    ];
    let matrix = ViewProjection::new(m, MatrixLayout::RowMajorColumnVectors);
    let found = matrix.frustum(ClipSpace::ZERO_TO_ONE).unwrap();
    // |Y / W + 1| at a near vertex is 2^-53 / (1 - 2^-54).
    let ulp = BigRational::new(1.into(), (1_u64 << 53).into());
    let off = &ulp / (Exact::one() - &ulp / exact(2.0));
    let [sides, ..] = deviation(&m, ClipSpace::ZERO_TO_ONE, &found);
    assert_eq!(sides, Some(off));
    assert_eq!(found.deviation().sides, 2.0_f64.powi(-53).next_up());
}

#[test]
fn subnormal_deviations_are_rounded_up() {
    // W >= Z is 2 W >= 3 * 2^-1074: the near distance 1.5 * 2^-1074 is rounded to 2^-1073,
    // which is off by a quarter of it.
    let least = 5e-324;
    let m = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, 3.0 * least],
        [0.0, 0.0, 1.0, 0.0],
    ];
    let matrix = ViewProjection::new(m, MatrixLayout::RowMajorColumnVectors);
    let found = matrix.frustum(ClipSpace::ZERO_TO_ONE.reversed()).unwrap();
    assert_eq!(found.frustum.shape().near().z, 2.0 * least);
    assert_eq!(found.deviation().near, 0.25);
    Counts::default().check(m, ClipSpace::ZERO_TO_ONE.reversed());
}

/// Whether rounding to nearest would have given a number below the truth, for each frustum.
#[derive(Default)]
struct Counts {
    frusta: u32,
    rounded_up: [u32; 3],
}

impl Counts {
    fn check<T: Real>(&mut self, m: [[T; 4]; 4], clip: ClipSpace) {
        let matrix = ViewProjection::new(m, MatrixLayout::RowMajorColumnVectors);
        let Ok(found) = matrix.frustum(clip) else {
            return;
        };
        self.frusta += 1;
        let m = m.map(|row| row.map(T::to_f64));
        let truths = deviation(&m, clip, &found);
        let d = found.deviation();
        for (i, reported) in [d.sides, d.near, d.far].into_iter().enumerate() {
            let truth = truths[i].as_ref();
            assert!(is_rounded_up(reported, truth), "{m:?} {clip:?}: {d:?}");
            let is_higher = |t| round_nearest::<f64>(t) < reported;
            self.rounded_up[i] += u32::from(truth.is_some_and(is_higher));
        }
    }
}

fn space(random: &mut Random) -> ClipSpace {
    random.pick(&[
        ClipSpace::OPENGL,
        ClipSpace::OPENGL.reversed(),
        ClipSpace::ZERO_TO_ONE,
        ClipSpace::ZERO_TO_ONE.reversed(),
    ])
}

fn row(random: &mut Random) -> [f64; 4] {
    [(); 4].map(|()| random.integer(-3, 3) as f64)
}

#[test]
fn small_integers() {
    let mut random = Random::new(&[13]);
    let mut counts = Counts::default();
    for _ in 0..4000 {
        let mut m = [(); 4].map(|()| row(&mut random));
        if random.one_in(2) {
            m[3] = [0.0, 0.0, 0.0, m[3][3]];
        } else {
            // Near and far planes parallel to the picture.
            let slope = 0.5 * random.integer(-4, 4) as f64;
            m[2] = [slope * m[3][0], slope * m[3][1], slope * m[3][2], m[2][3]];
        }
        counts.check(m, space(&mut random));
    }
    assert!(counts.frusta > 800, "{}", counts.frusta);
    let rounded_up = counts.rounded_up;
    assert!(rounded_up.iter().all(|&n| n > 20), "{rounded_up:?}");
}

#[test]
fn planes_tilted_by_the_rounding_of_f32() {
    const LARGE: f64 = 262_144.0;
    let mut random = Random::new(&[14]);
    let mut counts = Counts::default();
    for _ in 0..3000 {
        let [x, y, w, tilt] = [(); 4].map(|()| row(&mut random));
        let slope = random.integer(-3, 3) as f64;
        let z = std::array::from_fn(|j| LARGE * slope * w[j] + tilt[j]);
        let m = [x, y, z, w.map(|e| LARGE * e)].map(|row| row.map(f32::from_f64));
        counts.check(m, space(&mut random));
    }
    assert!(counts.frusta > 100, "{}", counts.frusta);
    let [_, near, far] = counts.rounded_up;
    assert!(near > 20 && far > 20, "{near} {far}");
}
