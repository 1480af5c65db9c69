//! parry: a segment by an axis-aligned box.

use super::{Found, part};
use crate::peer::{Peer, Who};
use crate::scene::Block;
use frusta::Segment;

/// What of parry is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParryCall {
    /// `Aabb::clip_segment`: what its name says.
    ClipSegment,
    /// `Aabb::clip_line_parameters`, and the part of it in `0..=1` taken by the caller: what a
    /// program does that knows of `clip_segment`'s phantom hits.
    LineClamped,
    /// `Aabb::clip_segment` by the bounding box of a frustum: for the time only.
    BoundingBox,
}

impl ParryCall {
    const fn function(self) -> &'static str {
        match self {
            Self::ClipSegment => "Aabb::clip_segment",
            Self::LineClamped => "clip_line_parameters, clamped",
            Self::BoundingBox => "clip_segment, bounding box",
        }
    }

    const fn note(self) -> &'static str {
        match self {
            Self::ClipSegment => "",
            Self::LineClamped => {
                "Aabb::clip_line_parameters; the caller keeps what of the line is in 0..=1"
            }
            Self::BoundingBox => {
                "Aabb::clip_segment by the frustum's bounding box: another question, times only"
            }
        }
    }
}

macro_rules! parry {
    ($name:ident, $t:ident, $lib:ident, $library:literal) => {
        #[doc = concat!("A box of `", $library, "`.")]
        pub struct $name {
            block: $lib::bounding_volume::Aabb,
            call: ParryCall,
        }

        impl $name {
            /// The box; its sides are rounded to the library's scalar.
            pub fn new(block: &Block, call: ParryCall) -> Self {
                let corner = |c: [f64; 3]| $lib::math::Vector::from(c.map(|c| c as $t));
                let block = $lib::bounding_volume::Aabb::new(corner(block.min), corner(block.max));
                Self { block, call }
            }
        }

        impl Peer for $name {
            type Case = Segment<$t>;
            type Input = [$lib::math::Vector; 2];
            type Output<'a> = Option<$lib::shape::Segment>;

            fn who(&self) -> Who {
                Who {
                    library: $library,
                    function: self.call.function(),
                    scalar: stringify!($t),
                    note: self.call.note(),
                }
            }

            fn prepare(&self, segment: &Segment<$t>) -> Self::Input {
                [segment.start, segment.end].map(|p| p.to_array().into())
            }

            fn run(&mut self, &[p, q]: &Self::Input) -> Self::Output<'_> {
                if self.call != ParryCall::LineClamped {
                    return self.block.clip_segment(p, q);
                }
                let d = q - p;
                let (t0, t1) = self.block.clip_line_parameters(p, d)?;
                let missed = t0 > 1.0 || t1 < 0.0;
                (!missed).then(|| {
                    let start = if t0 > 0.0 { p + d * t0 } else { p };
                    let end = if t1 < 1.0 { p + d * t1 } else { q };
                    $lib::shape::Segment::new(start, end)
                })
            }

            fn answer(&mut self, segment: &Segment<$t>) -> Found<$t> {
                let input = self.prepare(segment);
                match self.run(&input) {
                    None => Found::Nothing,
                    Some(s) => part(segment, [s.a, s.b].map(|p| p.into())),
                }
            }
        }
    };
}

parry!(ParryBox32, f32, parry3d, "parry3d");
parry!(ParryBox64, f64, parry3d_f64, "parry3d-f64");
