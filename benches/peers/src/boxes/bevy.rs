//! bevy: six half spaces, centre and extents.
//!
//! The test itself, `Frustum::intersects_obb_identity`, is in `bevy_camera`, which takes ten
//! minutes to build (195 crates, assets and windows among them). The half spaces are in
//! `bevy_shape` and are used from there; the loop over them is written down here once more, as
//! `bevy_camera` 0.20.1 has it, with its vector types.

use super::{BoxTest, GridBox};
use crate::peer::{Peer, Who};
use crate::scene::Camera;
use bevy_math::{Vec3A, Vec4};
use bevy_shape::{HalfSpace, ViewFrustum};

/// A box in bevy's form.
pub struct CentredBox {
    center: Vec3A,
    half_extents: Vec3A,
}

/// Half spaces and the loop.
pub struct BevyLoop(ViewFrustum);

impl BevyLoop {
    /// A camera's frustum. Its half spaces are given, not taken from a matrix: from any but
    /// bevy's own kind of matrix it would take others.
    pub fn new(camera: &Camera) -> Self {
        let half_space = |plane: [f64; 4]| HalfSpace::new(Vec4::from(plane.map(|c| c as f32)));
        let half_spaces = camera.planes().map(half_space);
        Self(ViewFrustum { half_spaces })
    }
}

impl Peer for BevyLoop {
    type Case = GridBox;
    type Input = CentredBox;
    type Output<'a> = bool;

    fn who(&self) -> Who {
        Who {
            library: "bevy_shape",
            function: "HalfSpace, in bevy_camera's loop",
            scalar: "f32",
            note: "conservative by design, but drops what only touches; its loop restated here",
        }
    }

    fn prepare(&self, block: &GridBox) -> CentredBox {
        let [min, max] = [block.min, block.max].map(Vec3A::from);
        CentredBox {
            center: 0.5 * (max + min),
            half_extents: 0.5 * (max - min),
        }
    }

    fn run(&mut self, block: &CentredBox) -> bool {
        let center = block.center.extend(1.0);
        for half_space in &self.0.half_spaces {
            let relative_radius = block.half_extents.abs().dot(half_space.normal().abs());
            if half_space.normal_d().dot(center) + relative_radius <= 0.0 {
                return false;
            }
        }
        true
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        let block = self.prepare(block);
        Some(self.run(&block))
    }
}

impl BoxTest for BevyLoop {
    fn list_name(&self) -> &'static str {
        "HalfSpace, in bevy_camera's loop, list"
    }

    #[inline]
    fn sees(&mut self, block: &Self::Input) -> bool {
        self.run(block)
    }
}
