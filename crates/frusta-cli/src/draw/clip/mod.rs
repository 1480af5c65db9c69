//! Pictures of what `frusta clip` made of a scene.
//!
//! ```text
//! options    the flags
//! outside    the frustum and its viewer, for the view from outside; window: what the viewer sees
//! projector  from world points to places
//! tracer     segments and clips to strokes, by many workers at a time
//! picture    few strokes as vectors (strokes), many as an image (density, tone)
//! layer      kinds of strokes and their looks
//! wireframe  the frustum itself
//! caption    title and legend
//! ```

mod caption;
mod density;
mod layer;
mod options;
mod outside;
mod picture;
mod projector;
mod strokes;
mod tone;
mod tracer;
mod window;
mod wireframe;

pub(crate) use options::{PictureArgs, View};
pub(crate) use picture::Picture;
pub(crate) use tracer::{Traced, Tracer};
