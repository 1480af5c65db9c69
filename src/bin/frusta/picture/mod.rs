//! What all pictures have in common: colours, and PNG from SVG.
//!
//! Every picture is made as SVG; a PNG is that SVG, rasterised.

mod palette;
mod png;

pub(crate) use palette::{Palette, Theme};
pub(crate) use png::png;
