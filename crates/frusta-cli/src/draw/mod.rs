//! Drawings of one frustum and one segment, in the frustum's frame.
//!
//! ```text
//! canvas     strokes, shapes and text as SVG
//! camera     from the frustum's frame to the picture
//! spatial    the frustum from outside
//! planar     a trapezoid, TV or TW
//! legend     what the strokes and marks mean
//! strand     the segment, in three pieces, in either picture
//! ```

mod camera;
mod canvas;
mod legend;
mod planar;
mod spatial;
mod strand;

pub(crate) use camera::Camera;
pub(crate) use canvas::{Canvas, Pen, Place, Type};
pub(crate) use legend::{Entries, draw as draw_legend};
pub(crate) use planar::{Frame, Plane, draw as draw_planar};
pub(crate) use spatial::{all_corners, draw as draw_spatial};
pub(crate) use strand::{Sizes, class_colour, draw as draw_strand};

use frusta::samples::{Feature, Solid};
use frusta::{Segment, SegmentClip};

/// What a drawing shows.
#[derive(Clone, Copy)]
pub(crate) struct Subject<'a> {
    pub(crate) solid: &'a Solid,
    /// What is highlighted.
    pub(crate) feature: Option<Feature>,
    pub(crate) segment: Segment<f64>,
    /// What of it is inside.
    pub(crate) clip: &'a SegmentClip<f64>,
    /// The parameters of what is drawn of it: where it goes on beyond the picture, it
    /// has no head.
    pub(crate) shown: [f64; 2],
}
