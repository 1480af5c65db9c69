//! Quads: clipped by a box. frusta has no polygons yet, so this job has peers only.
//!
//! The quads are axis-parallel rectangles on the half-integer lattice: what of one is in a box
//! is a rectangle again, and finding it takes comparisons only. So the truth is exact
//! without an oracle.

use crate::peer::{Case, Peer, Who};
use crate::scene::Block;
use euclid::default::{Point3D, Vector3D};
use plane_split::{Clipper, Plane, Polygon};

/// An axis-parallel rectangle: a box without extent along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    /// Least coordinates.
    pub min: [f64; 3],
    /// Greatest coordinates.
    pub max: [f64; 3],
}

/// What a library says of a quad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FoundQuad {
    /// It has nothing inside.
    Nothing,
    /// The bounds of all pieces inside.
    Bounds(Quad),
    /// An error, or a number that is not finite.
    Refused,
}

impl Case for Quad {
    type Answer = FoundQuad;
}

impl Quad {
    /// What of it is in a box, if anything.
    pub fn within(&self, block: &Block) -> Option<Quad> {
        let min = std::array::from_fn(|k| self.min[k].max(block.min[k]));
        let max = std::array::from_fn(|k| self.max[k].min(block.max[k]));
        let common = (0..3).all(|k| min[k] <= max[k]);
        common.then_some(Quad { min, max })
    }

    /// Its corners in order around it.
    fn corners(&self) -> [[f64; 3]; 4] {
        let flat = (0..3).find(|&k| self.min[k] == self.max[k]).unwrap_or(2);
        let (i, j) = ((flat + 1) % 3, (flat + 2) % 3);
        [[false, false], [true, false], [true, true], [false, true]].map(|[u, v]| {
            let mut corner = self.min;
            if u {
                corner[i] = self.max[i];
            }
            if v {
                corner[j] = self.max[j];
            }
            corner
        })
    }
}

/// plane-split's clipper with a box's six planes.
pub struct PlaneSplit(Clipper<()>);

impl PlaneSplit {
    /// The planes of a box.
    pub fn new(block: &Block) -> Self {
        let mut clipper = Clipper::new();
        for k in 0..3 {
            for (sign, side) in [(1.0, block.min[k]), (-1.0, block.max[k])] {
                let mut normal = [0.0; 3];
                normal[k] = sign;
                let normal = Vector3D::from(normal);
                let offset = -sign * side;
                clipper.add(Plane { normal, offset });
            }
        }
        Self(clipper)
    }
}

impl Peer for PlaneSplit {
    type Case = Quad;
    type Input = Option<Polygon<()>>;
    type Output<'a> = &'a [Polygon<()>];

    fn who(&self) -> Who {
        Who {
            library: "plane-split",
            function: "Clipper::clip",
            scalar: "f64",
            note: "drops what only touches, by design",
        }
    }

    fn prepare(&self, quad: &Quad) -> Option<Polygon<()>> {
        Polygon::from_points(quad.corners().map(Point3D::from), ())
    }

    fn run(&mut self, polygon: &Option<Polygon<()>>) -> &[Polygon<()>] {
        match polygon {
            Some(polygon) => self.0.clip(polygon.clone()),
            None => &[],
        }
    }

    fn answer(&mut self, quad: &Quad) -> FoundQuad {
        let Some(polygon) = self.prepare(quad) else {
            return FoundQuad::Refused;
        };
        let pieces = self.run(&Some(polygon));
        let corners = || pieces.iter().flat_map(|p| p.points).map(|p| p.to_array());
        if !corners().flatten().all(f64::is_finite) {
            return FoundQuad::Refused;
        }
        let bounds = corners().map(|p| Quad { min: p, max: p }).reduce(union);
        bounds.map_or(FoundQuad::Nothing, FoundQuad::Bounds)
    }
}

fn union(a: Quad, b: Quad) -> Quad {
    Quad {
        min: std::array::from_fn(|k| a.min[k].min(b.min[k])),
        max: std::array::from_fn(|k| a.max[k].max(b.max[k])),
    }
}
