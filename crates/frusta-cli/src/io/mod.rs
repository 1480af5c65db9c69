//! Files: readers of segments and frusta, writers of clipped segments.
//!
//! ```text
//! format         the trait of file formats and the list of them; `open` reads any of them
//! gltf/ obj stl ply/ csv geojson geojsonl     a format each
//! input          a file, the standard input or bytes, opened
//! scene, edges   meshes in memory; lines, number, wgs84: what several formats need
//! frustum_file   frusta from JSON
//! output/        writers, a file a format
//! atomic_file    files that are there whole or not at all
//! ```
//!
//! The readers are public so that they can be fuzzed and used without the command:
//!
//! ```
//! use frusta_cli::io::{Contents, Input, ReadOptions, open};
//!
//! let input = Input::from_bytes("a.obj", b"v 0 0 0\nv 1 0 0\nl 1 2\n", false)?;
//! let Contents::Scene(scene) = open(&input, ReadOptions::default())? else {
//!     panic!("an OBJ file is read as a whole");
//! };
//! assert_eq!(scene.len(), 1);
//! # Ok::<(), frusta_cli::Failure>(())
//! ```

pub(crate) mod atomic_file;
#[cfg(test)]
pub(crate) mod corruption;
mod csv;
mod edges;
mod format;
pub mod frustum_file;
mod geojson;
mod geojsonl;
mod gltf;
mod input;
mod lines;
pub(crate) mod number;
mod obj;
pub(crate) mod output;
mod ply;
mod scene;
mod stl;
pub(crate) mod wgs84;

pub use csv::{Block, Rows};
pub(crate) use format::parser as format_parser;
pub use format::{
    Contents, EdgeChoice, FORMATS, Format, Positions, ReadOptions, Stream, Take, open,
};
pub use input::Input;
pub(crate) use input::MARK;
pub use lines::LineError;
pub(crate) use lines::Lines;
pub use number::Scalar;
pub use scene::{Bounds, Scene};
