//! The kernels' work without vector registers: segments one by one.

use super::Block;
use crate::clip::{Accuracy, StageCounts, exact, vw};
use crate::frustum::PlainFrustum;
use crate::math::NonFiniteAt;
use crate::simd::Level;

/// Segments that are clipped at once.
pub(super) const BLOCK: usize = 256;

/// Nothing waits for a register to be full.
pub(super) struct Queues;

impl Queues {
    pub(super) fn new() -> Self {
        Self
    }
}

macro_rules! kernels {
    ($($t:ident $exact:ident $plain:ident;)*) => {$(
        pub(super) fn $exact(
            _: Level,
            mut block: Block<'_, $t>,
            accuracy: Accuracy,
            _: &mut Queues,
            counts: &mut StageCounts,
        ) -> Result<(), NonFiniteAt> {
            let all = 0..block.segments.len();
            block.clip_singly(all, |frustum, segment| {
                exact::vw::clip(frustum, segment, accuracy, counts)
            })
        }

        pub(super) fn $plain(
            _: Level,
            mut block: Block<'_, $t>,
            _: &PlainFrustum<$t>,
            _: &mut Queues,
        ) -> Result<(), NonFiniteAt> {
            let all = 0..block.segments.len();
            block.clip_singly(all, vw::clip_plain)
        }
    )*};
}

kernels! {
    f32 exact_f32 plain_f32;
    f64 exact_f64 plain_f64;
}
