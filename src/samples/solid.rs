//! Frusta with exactly known features.
//!
//! A frustum is addressed by a grid: `at(u, v, w)` goes from left to right with
//! `u`, from bottom to top with `v`, from near to far with `w`. With each of the
//! three in {0, 1/2, 1} the 27 grid points are the 8 vertices, the middles of
//! the 12 edges, a middle of each of the 6 faces, and a point inside. The rect
//! pairs here are small integers, so all these points, and the quarter points
//! between them, are dyadic and exact in `f32` and `f64`.

use crate::frustum::{Direction, EndRect, Face, FaceSet, Shape};
use crate::math::{Rect, Vec3};
use std::fmt;

/// A frustum in its own frame, with names for its features.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// What it is called.
    pub name: &'static str,
    /// The frustum.
    pub shape: Shape,
}

/// A vertex, an edge or a face: where on the grid its middle is, in halves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Feature {
    /// Grid coordinates times two, each 0, 1 or 2.
    halves: [u8; 3],
    /// All corners of that end are one point.
    apex: bool,
}

/// The number of dimensions of a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FeatureKind {
    /// A corner.
    Vertex,
    /// A line between two faces.
    Edge,
    /// A side or an end.
    Face,
}

impl FeatureKind {
    /// The kind's name in lower case.
    pub const fn name(self) -> &'static str {
        ["vertex", "edge", "face"][self as usize]
    }
}

/// Which face bounds which grid coordinate: `[at 0, at 1]`.
pub(super) const BOUNDS: [[Face; 2]; 3] = [
    [Face::Left, Face::Right],
    [Face::Bottom, Face::Top],
    [Face::Near, Face::Far],
];

impl Feature {
    /// A vertex, an edge or a face.
    pub fn kind(self) -> FeatureKind {
        match self.halves.iter().filter(|&&h| h == 1).count() {
            0 => FeatureKind::Vertex,
            1 => FeatureKind::Edge,
            _ if self.apex => FeatureKind::Vertex,
            _ => FeatureKind::Face,
        }
    }

    /// The faces whose planes contain it.
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

    /// Whether all corners of an end meet here.
    pub fn is_apex(self) -> bool {
        self.apex
    }

    /// The grid coordinates of its middle.
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
    /// An off-axis one that looks along `-z`, with one side parallel to the axis.
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
    /// One that narrows with depth and is sheared.
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
    /// An infinite off-axis one along `-z`.
    pub const INFINITE_OFF_AXIS: Solid = Solid {
        name: "infinite-off-axis",
        shape: Shape::Infinite {
            near: EndRect::new(-4.0, -4.0, 12.0, 0.0, 8.0),
            slopes: Rect::new(0.0, 2.0, -0.25, 0.25),
            direction: Direction::MinusZ,
        },
    };

    /// All of the above.
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

    /// How far the grid goes in an infinite frustum.
    const REACH: f64 = 32.0;

    const fn finite(name: &'static str, near: EndRect, far: EndRect) -> Self {
        let shape = Shape::Finite { near, far };
        Self { name, shape }
    }

    /// The point at grid coordinates; exact while the numbers are short.
    pub fn at(&self, [u, v, w]: [f64; 3]) -> Vec3<f64> {
        grid_point(&self.shape, Self::REACH, [u, v, w])
    }

    /// Its vertices, edges and faces: 26 with two proper rectangles, 18 for a
    /// pyramid, 17 if there is no far end.
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
                        // Of all that meets in an apex, name it once.
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

    /// Whether there is no far end.
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

/// The point at grid coordinates of any shape, in its frame; rounded where the
/// numbers are long. An infinite shape counts as ending at depth `reach`.
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
