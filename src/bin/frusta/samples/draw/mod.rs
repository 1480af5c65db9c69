//! Pictures of samples.
//!
//! ```text
//! canvas     strokes, shapes and text as SVG
//! camera     from the solid's frame to the picture
//! spatial    the frustum from outside
//! planar     a trapezoid, TV or TW
//! legend     what the strokes and marks mean
//! strand     the segment, in three pieces, in either picture
//! page       one sample, large
//! sheet      all samples, small
//! ```

mod camera;
mod canvas;
mod legend;
mod page;
mod planar;
mod sheet;
mod spatial;
mod strand;

pub(super) use page::page;
pub(super) use sheet::sheet;
