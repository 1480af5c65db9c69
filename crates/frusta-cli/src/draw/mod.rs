//! Pictures. Every picture is made as SVG; a PNG is that SVG, rasterised.
//!
//! ```text
//! svg        the writer of SVG: all pictures are written by it
//! palette    colours; text: lines of text; png, save: files
//! canvas     strokes, shapes and text, drawn one by one
//! clip/      what `frusta clip` made of a scene
//! ```
//!
//! One frustum and one segment, in the frustum's frame:
//!
//! ```text
//! camera     from the frustum's frame to the picture
//! spatial    the frustum from outside
//! planar     a trapezoid, TV or TW
//! legend     what the strokes and marks mean
//! segment    the segment, in three pieces, in either picture
//! ```

mod camera;
mod canvas;
pub(crate) mod clip;
mod legend;
mod palette;
mod planar;
mod png;
mod save;
mod segment;
mod spatial;
pub(crate) mod svg;
mod text;

pub(crate) use camera::Camera;
pub(crate) use canvas::{Canvas, Font, Pen, Place};
pub(crate) use legend::{Entries, draw as draw_legend};
pub(crate) use palette::{Palette, Theme};
pub(crate) use planar::{Frame, Plane, draw as draw_planar};
pub(crate) use png::png;
pub(crate) use save::save;
pub(crate) use segment::{Sizes, class_colour, draw as draw_segment};
pub(crate) use spatial::{all_corners, draw as draw_spatial};
pub(crate) use text::wrapped;

use frusta::samples::{Feature, Solid};
use frusta::{Segment, SegmentClip};

/// The frustum and the segment of a drawing.
#[derive(Clone, Copy)]
pub(crate) struct Subject<'a> {
    pub(crate) solid: &'a Solid,
    /// What is highlighted.
    pub(crate) feature: Option<Feature>,
    pub(crate) segment: Segment<f64>,
    /// The part of the segment that is inside.
    pub(crate) clip: &'a SegmentClip<f64>,
    /// The parameters that are drawn. A segment that goes on beyond the picture has no arrowhead.
    pub(crate) shown: [f64; 2],
}
