//! Every algorithm's control flow, on integer predicates, compared with an examination of every
//! point that could matter.

use super::{Predicates, Span};
use crate::clip::{cohen_sutherland, cyrus_beck, exact, liang_barsky, six_planes};
use crate::frustum::Face;
use crate::math::End;
use std::cmp::Ordering;

/// Integer boundary values at a segment's two ends.
struct Mock {
    faces: &'static [Face],
    values: [[i128; 6]; 2],
}

impl Mock {
    /// The parameter of a face's crossing, as a fraction with positive
    /// denominator.
    fn crossing(&self, face: Face) -> (i128, i128) {
        let [a, b] = [0, 1].map(|end| self.values[end][face as usize]);
        let sign = (a - b).signum();
        (a * sign, (a - b) * sign)
    }
}

fn order((a, b): (i128, i128), (c, d): (i128, i128)) -> Ordering {
    (a * d).cmp(&(c * b))
}

impl Predicates for Mock {
    fn faces(&self) -> &'static [Face] {
        self.faces
    }
    fn side(&mut self, face: Face, end: End) -> Ordering {
        self.values[end as usize][face as usize].cmp(&0)
    }
    fn order(&mut self, a: Face, b: Face) -> Ordering {
        for face in [a, b] {
            let [p, q] = [0, 1].map(|end| self.values[end][face as usize]);
            assert!(
                (p < 0) != (q < 0),
                "the order of {face} is requested, but it is not crossed"
            );
        }
        order(self.crossing(a), self.crossing(b))
    }
}

/// Entry and exit parameters: the first and the last that is inside every face,
/// of both ends and every crossing.
fn examined(mock: &Mock) -> Option<[(i128, i128); 2]> {
    let mut candidates = vec![(0, 1), (1, 1)];
    for &face in mock.faces {
        let (n, d) = mock.crossing(face);
        if d > 0 && (0..=d).contains(&n) {
            candidates.push((n, d));
        }
    }
    candidates.retain(|&(n, d)| {
        mock.faces.iter().all(|&face| {
            let [a, b] = [0, 1].map(|end| mock.values[end][face as usize]);
            a * (d - n) + b * n >= 0
        })
    });
    candidates.sort_by(|&a, &b| order(a, b));
    Some([*candidates.first()?, *candidates.last()?])
}

type Algorithm = (&'static str, fn(&mut Mock) -> Option<Span>);

const ALGORITHMS: [Algorithm; 6] = [
    ("vw", exact::vw::span),
    ("liang-barsky-textbook", liang_barsky::span_textbook),
    ("liang-barsky-tuned", liang_barsky::span_tuned),
    ("six-planes", six_planes::span),
    ("cyrus-beck", cyrus_beck::span),
    ("cohen-sutherland", cohen_sutherland::span),
];

/// A frustum in integers: left, right, bottom, top at `z = 0` and at `z = D`.
#[derive(Clone, Copy)]
struct Trapezoids {
    near: [i128; 4],
    far: [i128; 4],
    finite: bool,
}

const D: i128 = 4;

impl Trapezoids {
    /// The boundary values, times `D`.
    fn values(&self, [x, y, z]: [i128; 3]) -> [i128; 6] {
        let bound = |i: usize| self.near[i] * D + (self.far[i] - self.near[i]) * z;
        [
            z * D,
            (D - z) * D,
            x * D - bound(0),
            bound(1) - x * D,
            y * D - bound(2),
            bound(3) - y * D,
        ]
    }

    fn mock(&self, p: [i128; 3], q: [i128; 3]) -> Mock {
        Mock {
            faces: if self.finite {
                &Face::ALL
            } else {
                &Face::WITHOUT_FAR
            },
            values: [self.values(p), self.values(q)],
        }
    }
}

/// Runs every algorithm on one segment, and returns its position.
fn check(t: &Trapezoids, p: [i128; 3], q: [i128; 3]) -> Outcome {
    let expected = examined(&t.mock(p, q));
    for (name, span) in ALGORITHMS {
        let mut mock = t.mock(p, q);
        let found = span(&mut mock);
        let at = found.map(|span| {
            [
                span.enter.map_or((0, 1), |face| mock.crossing(face)),
                span.leave.map_or((1, 1), |face| mock.crossing(face)),
            ]
        });
        let same = match (at, expected) {
            (None, None) => true,
            (Some(a), Some(b)) => (0..2).all(|i| order(a[i], b[i]) == Ordering::Equal),
            _ => false,
        };
        assert!(
            same,
            "{name}: {p:?} to {q:?}: {at:?}, expected {expected:?}"
        );
        if let Some(span) = found {
            let outside = |v: [i128; 6]| mock.faces.iter().any(|&f| v[f as usize] < 0);
            assert_eq!(span.enter.is_some(), outside(mock.values[0]), "{name}");
            assert_eq!(span.leave.is_some(), outside(mock.values[1]), "{name}");
        }
    }
    match expected {
        None => Outcome::Misses,
        Some([a, b]) if order(a, b) == Ordering::Equal => Outcome::Touches,
        Some(_) => Outcome::Meets,
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Misses,
    Touches,
    Meets,
}

const SHAPES: [Trapezoids; 5] = [
    // Symmetric.
    Trapezoids {
        near: [-1, 1, -1, 1],
        far: [-3, 3, -2, 2],
        finite: true,
    },
    // Off-axis.
    Trapezoids {
        near: [-1, 2, 0, 1],
        far: [-2, 4, 1, 3],
        finite: true,
    },
    // A box.
    Trapezoids {
        near: [-2, 2, -1, 1],
        far: [-2, 2, -1, 1],
        finite: true,
    },
    // A pyramid.
    Trapezoids {
        near: [0, 0, 0, 0],
        far: [-4, 4, -4, 4],
        finite: true,
    },
    // Infinite.
    Trapezoids {
        near: [-1, 1, -1, 1],
        far: [-3, 3, -3, 3],
        finite: false,
    },
];

#[test]
fn all_control_flows_agree_with_an_examination_of_every_point() {
    let mut state = 1_u64;
    let mut next = || {
        let mut point = [0; 3];
        for c in &mut point {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            *c = i128::from(state >> 33) % 9 - 4;
        }
        point[2] += 2;
        point
    };
    for shape in &SHAPES {
        let mut seen = [0; 3];
        for _ in 0..40_000 {
            let (p, q) = (next(), next());
            if p != q {
                seen[check(shape, p, q) as usize] += 1;
            }
        }
        // The lattice has many of each, or the test would prove little.
        assert!(seen.iter().all(|&n| n > 500), "{seen:?}");
    }
}
