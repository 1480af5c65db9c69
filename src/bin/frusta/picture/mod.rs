//! What all pictures have in common: colours, PNG from SVG, and the file.
//!
//! Every picture is made as SVG; a PNG is that SVG, rasterised.

mod palette;
mod png;
mod save;

pub(crate) use palette::{Palette, Theme};
pub(crate) use png::png;
pub(crate) use save::save;
