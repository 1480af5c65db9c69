//! The 78 singular samples, and 26 near misses.
//!
//! Source: "View Frustum Culling Geometric Algorithm" (视锥体裁剪几何算法研究, in Chinese)
//! tests with 78 groups of segments "including the singular states of
//! the line with the frustum's vertices, edges and faces", classified by the
//! number of intersection points, the direction of crossing and the position
//! while the segment slides along its line. It does not list them. The derivation
//! here is our own: 8 vertices + 12 edges + 6 faces = 26 features, times three
//! relations:
//!
//! - *touching*: the segment and the frustum have one point in common, in the
//!   feature's relative interior;
//! - *crossing*: the segment passes through such a point into the interior and
//!   is clipped there;
//! - *contained*: it ends in the vertex and is otherwise inside; it lies in the
//!   relative interior of the edge or face.
//!
//! A *near miss* lies on the feature's carrier line or plane, apart from the
//! frustum. A pyramid has 18 features and so 54 samples; an infinite frustum 17
//! and 51.
//!
//! The expected answers follow from the construction, with a reason for each sample; none
//! is computed by clipping.

use super::solid::{Feature, FeatureKind, Solid};
use crate::clip::Class;
use crate::frustum::FaceSet;
use crate::math::{Segment, Vec3};
use std::fmt;

/// The position of a sample's segment relative to its feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Relation {
    /// On the feature's carrier line or plane, but disjoint from the frustum: a near miss.
    Apart,
    /// One point in common with the frustum, on the feature.
    Touching,
    /// Through the feature into the interior.
    Crossing,
    /// In the feature, or from the vertex inwards.
    Contained,
}

impl Relation {
    /// The relation's name in lower case.
    pub const fn name(self) -> &'static str {
        ["apart", "touching", "crossing", "contained"][self as usize]
    }
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The paper's first label: the number of points in which the segment meets the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Intersections {
    /// No point.
    None,
    /// One point.
    One,
    /// Two points.
    Two,
    /// A positive length.
    Infinite,
}

/// The paper's second label: the direction of crossing, projected on the V plane
/// (frame `x` and `z`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Crossing {
    /// A slope of magnitude at most 1. (That 1 belongs here is our rule.)
    LeftRight,
    /// A steeper one.
    UpDown,
}

/// The paper's labels of a sample; its third, the position, is the relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Labels {
    /// Number of points in which the segment meets the surface.
    pub intersections: Intersections,
    /// The direction of crossing.
    pub direction: Crossing,
    /// Apart, touching, crossing or contained.
    pub position: Relation,
}

/// A sample in the frustum's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameSample {
    /// The feature of the frustum.
    pub feature: Feature,
    /// The position of the segment relative to the feature.
    pub relation: Relation,
    /// The paper's labels.
    pub labels: Labels,
    /// The input, exact in `f32` too.
    pub segment: Segment<f64>,
    /// The exact answer.
    pub expected: Expected,
    /// The reason for the answer.
    pub reason: &'static str,
}

impl FrameSample {
    /// The stable name, such as `edge-near-top/crossing`.
    pub fn name(&self) -> String {
        format!("{}/{}", self.feature, self.relation)
    }
}

/// The exact answer to a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The position of the segment relative to the frustum.
    pub class: Class,
    /// The part inside; `None` exactly if the class is `Outside`.
    pub part: Option<ExpectedPart>,
}

/// The part of a sample's segment that is in the frustum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedPart {
    /// The exact parameters, both dyadic.
    pub t: [f64; 2],
    /// Whether entry and exit were clipped.
    pub clipped: [bool; 2],
    /// The entry set and the exit set.
    pub faces: [FaceSet; 2],
    /// The faces whose planes contain the whole segment.
    pub coplanar: FaceSet,
}

const OUTSIDE: Expected = Expected {
    class: Class::Outside,
    part: None,
};

/// The singular samples of a solid: three for each feature, 78 in all if both
/// ends are proper rectangles.
pub fn singular_samples(solid: &Solid) -> Vec<FrameSample> {
    let builder = |feature| Builder { solid, feature };
    let features = solid.features().into_iter().map(builder);
    features
        .flat_map(|b| [b.touching(), b.crossing(), b.contained()])
        .collect()
}

/// The near misses of a solid: one for each feature.
pub fn near_misses(solid: &Solid) -> Vec<FrameSample> {
    let features = solid.features().into_iter();
    features
        .map(|feature| Builder { solid, feature }.apart())
        .collect()
}

struct Builder<'a> {
    solid: &'a Solid,
    feature: Feature,
}

impl Builder<'_> {
    fn touching(&self) -> FrameSample {
        let (p, faces) = (self.middle(), self.feature.faces());
        let touch = |t: f64, clipped| Expected {
            class: Class::Touch,
            part: Some(ExpectedPart {
                t: [t, t],
                clipped,
                faces: [faces, faces],
                coplanar: FaceSet::EMPTY,
            }),
        };
        let (segment, expected, reason) = match self.feature.kind() {
            FeatureKind::Vertex => {
                let d = self.passing();
                (
                    Segment::new(p - d * 3.0, p + d),
                    touch(0.75, [true, true]),
                    "neither way along the line leads from the vertex into the \
                     frustum, so the vertex is all they have in common",
                )
            }
            FeatureKind::Edge => {
                let d = self.passing();
                (
                    Segment::new(p - d, p + d * 3.0),
                    touch(0.25, [true, true]),
                    "each way along the line leaves the frustum through one of the \
                     edge's two faces, so the edge's point is all they have in common",
                )
            }
            FeatureKind::Face => (
                Segment::new(p - (self.inside() - p), p),
                touch(1.0, [true, false]),
                "the segment comes from outside and ends in the face",
            ),
        };
        self.sample(
            Relation::Touching,
            Intersections::One,
            segment,
            expected,
            reason,
        )
    }

    fn crossing(&self) -> FrameSample {
        let (p, faces) = (self.middle(), self.feature.faces());
        let cross = |t, clipped, exit| Expected {
            class: Class::Cross,
            part: Some(ExpectedPart {
                t,
                clipped,
                faces: [faces, exit],
                coplanar: FaceSet::EMPTY,
            }),
        };
        if let Some((q, exit)) = self.opposite() {
            let d = (q - p) * 0.5;
            return self.sample(
                Relation::Crossing,
                Intersections::Two,
                Segment::new(p - d, q + d),
                cross([0.25, 0.75], [true, true], exit),
                "no face contains both the feature and the one opposite, so the line \
                 is inside between them; the segment goes on by half that length",
            );
        }
        let q = self.inside();
        self.sample(
            Relation::Crossing,
            Intersections::One,
            Segment::new(p - (q - p), q),
            cross([0.5, 1.0], [true, false], FaceSet::EMPTY),
            "the segment ends inside, and its middle is in the feature",
        )
    }

    fn contained(&self) -> FrameSample {
        let (p, faces) = (self.middle(), self.feature.faces());
        let part = |exit, coplanar| {
            Some(ExpectedPart {
                t: [0.0, 1.0],
                clipped: [false, false],
                faces: [faces, exit],
                coplanar,
            })
        };
        let boundary = Expected {
            class: Class::Boundary,
            part: part(faces, faces),
        };
        let [a, b] = self.stretch();
        let (count, segment, expected, reason) = match self.feature.kind() {
            FeatureKind::Vertex => (
                Intersections::One,
                Segment::new(p, self.inside()),
                Expected {
                    class: Class::Inside,
                    part: part(FaceSet::EMPTY, FaceSet::EMPTY),
                },
                "from the vertex to a point inside; nothing is clipped",
            ),
            FeatureKind::Edge => (
                Intersections::Infinite,
                Segment::new(p - (b - a) * 0.25, p + (b - a) * 0.25),
                boundary,
                "the middle half of the edge",
            ),
            FeatureKind::Face => (
                Intersections::Infinite,
                Segment::new((p + a) * 0.5, (p + b) * 0.5),
                boundary,
                "between points half way from the face's middle to two of its corners",
            ),
        };
        self.sample(Relation::Contained, count, segment, expected, reason)
    }

    fn apart(&self) -> FrameSample {
        let p = self.middle();
        let [a, b] = self.stretch();
        let (segment, reason) = match self.feature.kind() {
            FeatureKind::Vertex => {
                let d = self.passing();
                (
                    Segment::new(p + d, p + d * 2.0),
                    "the line meets the frustum in the vertex alone, and the segment \
                     stops before it",
                )
            }
            FeatureKind::Edge => (
                // The near end: the other may be at infinity.
                Segment::new(a - (b - a) * 0.25, a - (b - a) * 0.75),
                "the edge's line meets the frustum in the edge alone, and the segment \
                 starts beyond its end",
            ),
            FeatureKind::Face => {
                let rim = self.solid.at(self.rim());
                (
                    Segment::new(rim + (rim - p) * 0.5, rim + (rim - p)),
                    "the face's plane meets the frustum in the face alone, and the \
                     segment starts beyond its rim",
                )
            }
        };
        self.sample(
            Relation::Apart,
            Intersections::None,
            segment,
            OUTSIDE,
            reason,
        )
    }

    fn sample(
        &self,
        relation: Relation,
        intersections: Intersections,
        segment: Segment<f64>,
        expected: Expected,
        reason: &'static str,
    ) -> FrameSample {
        let d = segment.end - segment.start;
        let direction = if d.z.abs() <= d.x.abs() {
            Crossing::LeftRight
        } else {
            Crossing::UpDown
        };
        FrameSample {
            feature: self.feature,
            relation,
            labels: Labels {
                intersections,
                direction,
                position: relation,
            },
            segment,
            expected,
            reason,
        }
    }

    fn middle(&self) -> Vec3<f64> {
        self.solid.at(self.feature.grid())
    }

    fn inside(&self) -> Vec3<f64> {
        self.solid.at([0.5, 0.5, 0.5])
    }

    /// The grid coordinates with one of them replaced.
    fn moved(&self, k: usize, to: f64) -> [f64; 3] {
        let mut grid = self.feature.grid();
        grid[k] = to;
        grid
    }

    /// A direction for which the line through a vertex or an edge has no other point in common
    /// with the frustum, and lies in no face's plane.
    fn passing(&self) -> Vec3<f64> {
        let (p, grid) = (self.middle(), self.feature.grid());
        if self.feature.is_apex() {
            // To a point as far beyond the right face as half the width there.
            let left = self.solid.at([0.0, 0.5, 0.5]);
            let right = self.solid.at([1.0, 0.5, 0.5]);
            return right - p + (right - left) * 0.5;
        }
        let fixed: Vec<usize> = (0..3).filter(|&k| grid[k] != 0.5).collect();
        match fixed[..] {
            // Along two of the three edges and against the third.
            [i, j, k] => {
                let along = |m: usize| self.solid.at(self.moved(m, 1.0 - grid[m])) - p;
                (along(i) + along(j) - along(k)) * 0.5
            }
            // Along one of the two faces and against the other.
            [i, j] => self.solid.at(self.moved(i, 0.5)) - self.solid.at(self.moved(j, 0.5)),
            _ => p - self.inside(),
        }
    }

    /// The point at which a segment through the feature leaves, and the faces there;
    /// `None` if it ends inside.
    fn opposite(&self) -> Option<(Vec3<f64>, FaceSet)> {
        let (kind, solid) = (self.feature.kind(), self.solid);
        let grid = self.feature.grid().map(|c| 1.0 - c);
        let proper = !solid.is_pyramid() && !solid.is_infinite();
        let exists = match kind {
            // In a pyramid a corner of the base and the apex share two faces.
            FeatureKind::Vertex => proper || self.feature.is_apex(),
            FeatureKind::Edge => false,
            FeatureKind::Face => !solid.is_infinite() || grid[2] == 0.5,
        };
        let opposite = solid.features().into_iter().find(|f| f.grid() == grid);
        opposite
            .filter(|_| exists)
            .map(|f| (solid.at(grid), f.faces()))
    }

    /// The ends of an edge, or two opposite corners of a face.
    fn stretch(&self) -> [Vec3<f64>; 2] {
        let grid = self.feature.grid();
        let corner = |end: f64| grid.map(|c| if c == 0.5 { end } else { c });
        [self.solid.at(corner(0.0)), self.solid.at(corner(1.0))]
    }

    /// The middle of one of a face's edges, sideways.
    fn rim(&self) -> [f64; 3] {
        let k = usize::from(self.feature.grid()[0] != 0.5);
        self.moved(k, 1.0)
    }
}
