//! frusta on points: boxes are not built yet.

use super::GridBox;
use crate::peer::{Peer, Who};
use frusta::{Frustum, NonFinite, Vec3};

/// `Frustum::contains`, for boxes of no size.
pub struct OursPoint(Frustum);

impl OursPoint {
    /// The frustum itself.
    pub fn new(frustum: &Frustum) -> Self {
        Self(frustum.clone())
    }
}

impl Peer for OursPoint {
    type Case = GridBox;
    type Input = Vec3<f32>;
    type Output<'a> = Result<bool, NonFinite>;

    fn who(&self) -> Who {
        Who {
            library: "frusta",
            function: "Frustum::contains",
            scalar: "f32",
            note: "a point; exact",
        }
    }

    fn prepare(&self, block: &GridBox) -> Vec3<f32> {
        block.min.into()
    }

    fn run(&mut self, point: &Vec3<f32>) -> Result<bool, NonFinite> {
        self.0.contains(*point)
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        let point = self.prepare(block);
        self.run(&point).ok()
    }
}
