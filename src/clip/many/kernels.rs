//! The kernels of both scalar types: functions that are not generic are compiled once, here, and
//! not in every crate that clips.

pub(super) use super::queue::{BLOCK, Queues};

use super::{Block, certified, lanes, plain};
use crate::clip::{Accuracy, StageCounts};
use crate::frustum::{Form, General, PlainFrustum, Symmetric};
use crate::math::{NonFiniteAt, Real};
use crate::simd::at_width;
use fearless_simd::{Level, Simd};

macro_rules! kernels {
    ($($t:ident $exact:ident $plain:ident $registers:ident;)*) => {$(
        pub(super) fn $exact(
            level: Level,
            block: Block<'_, $t>,
            accuracy: Accuracy,
            queues: &mut Queues,
            counts: &mut StageCounts,
        ) -> Result<(), NonFiniteAt> {
            at_width!(level, simd => exact_block(simd, block, accuracy, queues, counts))
        }

        pub(super) fn $plain(
            level: Level,
            block: Block<'_, $t>,
            frustum: &PlainFrustum<$t>,
            queues: &mut Queues,
        ) -> Result<(), NonFiniteAt> {
            at_width!(level, simd => plain::$registers(simd, block, frustum, queues))
        }
    )*};
}

kernels! {
    f32 exact_f32 plain_f32 clip_f32;
    f64 exact_f64 plain_f64 clip_f64;
}

#[inline(always)]
fn exact_block<S: Simd, T: Real>(
    simd: S,
    block: Block<'_, T>,
    accuracy: Accuracy,
    queues: &mut Queues,
    counts: &mut StageCounts,
) -> Result<(), NonFiniteAt> {
    let mut run = certified::Run {
        quad: lanes::Quad(simd),
        block,
        accuracy,
        queues,
        counts,
    };
    match run.block.frustum.filter().form {
        Form::Symmetric => run.clip::<Symmetric<true>>(),
        Form::General | Form::Orthographic => run.clip::<General<true>>(),
        Form::InfiniteSymmetric | Form::Infinite => run.clip::<General<false>>(),
    }
}
