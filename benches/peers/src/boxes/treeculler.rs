//! treeculler: six planes, then the frustum's corners against the box.

use super::{BoxTest, GridBox};
use crate::peer::{Peer, Who};
use crate::scene::Camera;
use treeculler::{AABB, BVol, Frustum};

/// Its two tests of a box.
pub struct TreeCuller {
    frustum: Frustum<f32>,
    corners: bool,
}

impl TreeCuller {
    /// A camera's frustum; with the corners' test, or the six planes alone.
    pub fn new(camera: &Camera, corners: bool) -> Self {
        let rows = camera.clip_from_world_f32();
        // It wants columns.
        let columns = [0, 1, 2, 3].map(|c| [0, 1, 2, 3].map(|r: usize| rows[r][c]));
        let frustum = Frustum::from_modelview_projection(columns);
        Self { frustum, corners }
    }

    /// What it takes for the far face: `a x + b y + c z + d`.
    pub fn far_plane(&self) -> [f32; 4] {
        let plane = &self.frustum.planes[5];
        [plane.x, plane.y, plane.z, plane.w]
    }
}

impl Peer for TreeCuller {
    type Case = GridBox;
    type Input = AABB<f32>;
    type Output<'a> = bool;

    fn who(&self) -> Who {
        let function = match self.corners {
            true => "BVol::test_against_frustum",
            false => "BVol::test_against_plane, six",
        };
        Who {
            library: "treeculler",
            function,
            scalar: "f32",
            note: "conservative by design",
        }
    }

    fn prepare(&self, block: &GridBox) -> AABB<f32> {
        AABB::new(block.min, block.max)
    }

    fn run(&mut self, block: &AABB<f32>) -> bool {
        if self.corners {
            return block.test_against_frustum(&self.frustum, 0) != u8::MAX;
        }
        let planes = &self.frustum.planes;
        !planes.iter().any(|plane| block.test_against_plane(plane))
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        let block = self.prepare(block);
        Some(self.run(&block))
    }
}

impl BoxTest for TreeCuller {
    fn list_name(&self) -> &'static str {
        match self.corners {
            true => "BVol::test_against_frustum, list",
            false => "BVol::test_against_plane, six, list",
        }
    }

    #[inline]
    fn sees(&mut self, block: &Self::Input) -> bool {
        self.run(block)
    }
}
