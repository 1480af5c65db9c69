//! packed_spatial_index: six planes, the corner farthest along each.

use super::{BoxTest, GridBox};
use crate::peer::{Peer, Who};
use crate::scene::Camera;
use packed_spatial_index::{Box3D, ClipSpaceZ, Frustum3D};

/// `Frustum3D`, its planes from the camera's matrix.
pub struct PackedSpatialIndex(Frustum3D);

impl PackedSpatialIndex {
    /// A camera's frustum.
    pub fn new(camera: &Camera) -> Self {
        let matrix = camera.clip_from_world();
        Self(Frustum3D::from_view_projection(
            matrix,
            ClipSpaceZ::NegOneToOne,
        ))
    }
}

impl Peer for PackedSpatialIndex {
    type Case = GridBox;
    type Input = Box3D;
    type Output<'a> = bool;

    fn who(&self) -> Who {
        Who {
            library: "packed_spatial_index",
            function: "overlaps_box",
            scalar: "f64",
            note: "Frustum3D::overlaps_box; conservative by design",
        }
    }

    fn prepare(&self, block: &GridBox) -> Box3D {
        let ([a, b, c], [d, e, f]) = (block.min.map(f64::from), block.max.map(f64::from));
        Box3D::new(a, b, c, d, e, f)
    }

    fn run(&mut self, block: &Box3D) -> bool {
        self.0.overlaps_box(*block)
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        let block = self.prepare(block);
        Some(self.run(&block))
    }
}

impl BoxTest for PackedSpatialIndex {
    fn list_name(&self) -> &'static str {
        "overlaps_box, list"
    }

    #[inline]
    fn sees(&mut self, block: &Self::Input) -> bool {
        self.run(block)
    }
}
