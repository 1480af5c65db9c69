//! collision: the relation of a box's eight corners with each plane.

use super::{BoxTest, GridBox};
use crate::peer::{Peer, Who};
use crate::scene::Camera;
use cgmath::{Matrix4, Point3, SquareMatrix};
use collision::{Aabb3, Frustum, Relation};

/// Its frustum, from the camera's matrix.
pub struct Collision(Frustum<f32>);

impl Collision {
    /// A camera's frustum; `None` if the crate finds none in the matrix.
    pub fn new(camera: &Camera) -> Option<Self> {
        let rows = camera.clip_from_world_f32();
        let mut matrix = Matrix4::identity();
        for (r, row) in rows.iter().enumerate() {
            for (c, &entry) in row.iter().enumerate() {
                matrix[c][r] = entry;
            }
        }
        Frustum::from_matrix4(matrix).map(Self)
    }

    /// The crate's own frustum.
    pub fn of(frustum: Frustum<f32>) -> Self {
        Self(frustum)
    }
}

impl Peer for Collision {
    type Case = GridBox;
    type Input = Aabb3<f32>;
    type Output<'a> = Relation;

    fn who(&self) -> Who {
        Who {
            library: "collision",
            function: "Frustum::contains",
            scalar: "f32",
            note: "conservative by design",
        }
    }

    fn prepare(&self, block: &GridBox) -> Aabb3<f32> {
        let [min, max] = [block.min, block.max].map(Point3::from);
        Aabb3::new(min, max)
    }

    fn run(&mut self, block: &Aabb3<f32>) -> Relation {
        self.0.contains(block)
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        let block = self.prepare(block);
        Some(self.run(&block) != Relation::Out)
    }
}

impl BoxTest for Collision {
    fn list_name(&self) -> &'static str {
        "Frustum::contains, list"
    }

    #[inline]
    fn sees(&mut self, block: &Self::Input) -> bool {
        self.run(block) != Relation::Out
    }
}
