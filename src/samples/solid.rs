//! Frusta with exact features.
//!
//! A grid addresses the points of a frustum: in `at([u, v, w])`, `u` increases from left to
//! right, `v` from bottom to top, `w` from near to far. For `u`, `v`, `w` in {0, 1/2, 1} the
//! 27 grid points are the 8 vertices, the middles of the 12 edges, a middle of each of
//! the 6 faces, and a point inside. The rectangles here are small integers, so all these
//! points, and the quarter points between them, are dyadic and exact in `f32` and `f64`.

use crate::frustum::{Direction, EndRect, Face, FaceSet, Shape};
use crate::math::{Rect, Vec3};
use std::fmt;

/// A frustum in its own frame, with names for its features.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// The solid's name.
    pub name: &'static str,
    /// The shape of the frustum.
    pub shape: Shape,
}

/// A vertex, an edge or a face, given by its middle on the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Feature {
    /// Grid coordinates times two, each 0, 1 or 2.
    halves: [u8; 3],
    /// Whether all corners of that end are one point.
    apex: bool,
}

/// The kind of a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FeatureKind {
    /// A corner of the frustum.
    Vertex,
    /// A line segment between two faces.
    Edge,
    /// A side or an end of the frustum.
    Face,
}

impl FeatureKind {
    /// The kind's name in lower case.
    pub const fn name(self) -> &'static str {
        ["vertex", "edge", "face"][self as usize]
    }
}

/// The faces that bound each grid coordinate: `[at 0, at 1]`.
pub(super) const BOUNDS: [[Face; 2]; 3] = [
    [Face::Left, Face::Right],
    [Face::Bottom, Face::Top],
    [Face::Near, Face::Far],
];

impl Feature {
    /// The kind of the feature.
    pub fn kind(self) -> FeatureKind {
        match self.halves.iter().filter(|&&h| h == 1).count() {
            0 => FeatureKind::Vertex,
            1 => FeatureKind::Edge,
            _ if self.apex => FeatureKind::Vertex,
            _ => FeatureKind::Face,
        }
    }

    /// The faces whose planes contain the feature.
    pub fn faces(self) -> FaceSet {
        let mut faces: FaceSet = (0..3)
            .filter(|&k| self.halves[k] != 1)
            .map(|k| BOUNDS[k][usize::from(self.halves[k] / 2)])
            .collect();
        if self.apex {
            for side in [Face::Left, Face::Right, Face::Bottom, Face::Top] {
                faces.insert(side);
            }
        }
        faces
    }

    /// Whether the feature is the apex of a pyramid.
    pub fn is_apex(self) -> bool {
        self.apex
    }

    /// The grid coordinates of the feature's middle.
    pub fn grid(self) -> [f64; 3] {
        self.halves.map(|h| 0.5 * f64::from(h))
    }
}

/// `vertex-near-right-top`, `edge-far-left`, `face-bottom`, `vertex-apex`.
impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind().name())?;
        if self.apex {
            return f.write_str("-apex");
        }
        for face in self.faces().iter() {
            write!(f, "-{face}")?;
        }
        Ok(())
    }
}

impl Solid {
    /// A symmetric perspective frustum, 90 degrees wide.
    pub const SYMMETRIC: Solid = Solid::finite(
        "symmetric",
        EndRect::new(8.0, -8.0, 8.0, -4.0, 4.0),
        EndRect::new(40.0, -40.0, 40.0, -20.0, 20.0),
    );
    /// An off-axis frustum that extends along `-z`, with one side parallel to the axis.
    pub const OFF_AXIS: Solid = Solid::finite(
        "off-axis",
        EndRect::new(-16.0, -8.0, 24.0, -4.0, 12.0),
        EndRect::new(-48.0, -24.0, 40.0, -12.0, 12.0),
    );
    /// A box.
    pub const ORTHOGRAPHIC: Solid = Solid::finite(
        "orthographic",
        EndRect::new(-4.0, -16.0, 16.0, -8.0, 8.0),
        EndRect::new(12.0, -16.0, 16.0, -8.0, 8.0),
    );
    /// A sheared frustum that narrows with depth.
    pub const SHEARED: Solid = Solid::finite(
        "sheared",
        EndRect::new(0.0, -32.0, 32.0, -32.0, 0.0),
        EndRect::new(16.0, 8.0, 24.0, 32.0, 48.0),
    );
    /// A pyramid with its apex at the near end.
    pub const PYRAMID: Solid = Solid::finite(
        "pyramid",
        EndRect::new(4.0, 4.0, 4.0, -8.0, -8.0),
        EndRect::new(36.0, -12.0, 20.0, -16.0, 16.0),
    );
    /// A pyramid with its apex at the far end.
    pub const SPIRE: Solid = Solid::finite(
        "spire",
        EndRect::new(32.0, -16.0, 16.0, -8.0, 24.0),
        EndRect::new(0.0, 0.0, 0.0, 0.0, 0.0),
    );
    /// An infinite perspective frustum along `+z`.
    pub const INFINITE: Solid = Solid {
        name: "infinite",
        shape: Shape::Infinite {
            near: EndRect::new(8.0, -8.0, 8.0, -4.0, 4.0),
            slopes: Rect::new(-1.0, 1.0, -0.5, 0.5),
            direction: Direction::PlusZ,
        },
    };
    /// An infinite off-axis frustum along `-z`.
    pub const INFINITE_OFF_AXIS: Solid = Solid {
        name: "infinite-off-axis",
        shape: Shape::Infinite {
            near: EndRect::new(-4.0, -4.0, 12.0, 0.0, 8.0),
            slopes: Rect::new(0.0, 2.0, -0.25, 0.25),
            direction: Direction::MinusZ,
        },
    };

    /// All solids.
    pub const ALL: [Solid; 8] = [
        Self::SYMMETRIC,
        Self::OFF_AXIS,
        Self::ORTHOGRAPHIC,
        Self::SHEARED,
        Self::PYRAMID,
        Self::SPIRE,
        Self::INFINITE,
        Self::INFINITE_OFF_AXIS,
    ];

    /// The depth at which the grid ends in an infinite frustum.
    const REACH: f64 = 32.0;

    const fn finite(name: &'static str, near: EndRect, far: EndRect) -> Self {
        let shape = Shape::Finite { near, far };
        Self { name, shape }
    }

    /// The point with these grid coordinates; exact if it is representable.
    pub fn at(&self, [u, v, w]: [f64; 3]) -> Vec3<f64> {
        grid_point(&self.shape, Self::REACH, [u, v, w])
    }

    /// The vertices, edges and faces: 26 if both ends are proper rectangles, 18 for a
    /// pyramid, 17 without a far end.
    pub fn features(&self) -> Vec<Feature> {
        let mut features = Vec::new();
        for w in [0, 1, 2] {
            for v in [0, 1, 2] {
                for u in [0, 1, 2] {
                    let centre = u == 1 && v == 1;
                    let apex = w != 1 && self.is_apex(w == 2);
                    let exists = match w {
                        1 => !centre,
                        2 if self.is_infinite() => false,
                        // All features of an end that is an apex are one.
                        _ => !apex || centre,
                    };
                    if exists {
                        let halves = [u, v, w];
                        features.push(Feature { halves, apex });
                    }
                }
            }
        }
        features
    }

    /// Whether the solid has no far end.
    pub fn is_infinite(&self) -> bool {
        matches!(self.shape, Shape::Infinite { .. })
    }

    /// Whether one end is a point.
    pub fn is_pyramid(&self) -> bool {
        self.is_apex(false) || self.is_apex(true)
    }

    fn is_apex(&self, far: bool) -> bool {
        let end = if far {
            self.shape.far()
        } else {
            Some(self.shape.near())
        };
        end.is_some_and(|e| e.rect.left == e.rect.right && e.rect.bottom == e.rect.top)
    }
}

/// The point with these grid coordinates in the frame of any shape, rounded if it is not
/// representable. The grid of an infinite shape ends at depth `reach`.
pub(crate) fn grid_point(shape: &Shape, reach: f64, [u, v, w]: [f64; 3]) -> Vec3<f64> {
    let near = shape.near();
    let far = match *shape {
        Shape::Finite { far, .. } => far,
        Shape::Infinite {
            slopes, direction, ..
        } => {
            let (n, s) = (near.rect, slopes);
            EndRect::new(
                near.z + direction.sign() * reach,
                n.left + s.left * reach,
                n.right + s.right * reach,
                n.bottom + s.bottom * reach,
                n.top + s.top * reach,
            )
        }
    };
    // Exact at 0 and 1, and no overflow between opposite large values.
    let mix = |a: f64, b: f64, t: f64| a * (1.0 - t) + b * t;
    let (n, f) = (near.rect, far.rect);
    let x = mix(mix(n.left, f.left, w), mix(n.right, f.right, w), u);
    let y = mix(mix(n.bottom, f.bottom, w), mix(n.top, f.top, w), v);
    Vec3::new(x, y, mix(near.z, far.z, w))
}
