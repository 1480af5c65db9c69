//! Pictures: of what was clipped, and what all pictures have in common.
//!
//! Every picture is made as SVG; a PNG is that SVG, rasterised.

mod canvas;
mod caption;
mod density;
mod drawing;
mod layer;
mod options;
mod outside;
mod palette;
mod png;
mod projector;
mod save;
mod strokes;
mod text;
mod tone;
mod window;
mod wireframe;

pub(crate) use canvas::{Canvas, Traced};
pub(crate) use drawing::Picture;
pub(crate) use options::{PictureArgs, View};
pub(crate) use palette::{Palette, Theme};
pub(crate) use png::png;
pub(crate) use save::save;
pub(crate) use text::{escaped, wrapped};
