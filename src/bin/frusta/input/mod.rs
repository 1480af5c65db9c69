//! Reading what is to be clipped.
//!
//! A mesh file becomes a [`Scene`], read once and instanced on the fly; a CSV
//! file stays a stream of rows.

pub(crate) mod csv;
mod edges;
mod gltf;
mod gltf_data;
mod obj;
mod scene;

pub(crate) use scene::{Bounds, Scene};

use crate::failure::Failure;
use std::path::Path;

/// Which edges of a mesh file to clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum EdgeChoice {
    /// The file's lines: glTF modes 1 to 3, OBJ `l`
    Lines,
    /// Each edge of each mesh's triangles (OBJ: polygons) once
    Triangles,
    /// Both: a mesh's lines, then its triangle edges
    All,
}

impl EdgeChoice {
    fn wants_lines(self) -> bool {
        self != Self::Triangles
    }

    fn wants_faces(self) -> bool {
        self != Self::Lines
    }

    /// The choice's name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Lines => "lines",
            Self::Triangles => "triangles",
            Self::All => "all",
        }
    }
}

/// The file formats, told by the name's extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// glTF 2.0, text or binary.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// Rows of six coordinates.
    Csv,
}

impl Format {
    /// The format that a file's name stands for.
    pub(crate) fn of(file: &Path) -> Result<Self, Failure> {
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or("");
        match extension.to_ascii_lowercase().as_str() {
            "glb" | "gltf" => Ok(Self::Gltf),
            "obj" => Ok(Self::Obj),
            "csv" => Ok(Self::Csv),
            _ => Err(Failure::in_file(
                file,
                "unknown kind of file; expected .glb, .gltf, .obj or .csv",
            )),
        }
    }

    /// The format's name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Gltf => "gltf",
            Self::Obj => "obj",
            Self::Csv => "csv",
        }
    }
}

/// Reads a mesh file; `format` is not [`Format::Csv`].
pub(crate) fn read_scene(
    file: &Path,
    format: Format,
    choice: Option<EdgeChoice>,
) -> Result<Scene, Failure> {
    let bytes = std::fs::read(file).map_err(|e| Failure::in_file(file, e))?;
    let scene = match format {
        Format::Obj => obj::read(file, &bytes, choice)?,
        Format::Gltf | Format::Csv => gltf::read(file, &bytes, choice)?,
    };
    if scene.len() == 0 {
        let what = match scene.kind() {
            EdgeChoice::Lines => "no lines (see --edges)",
            EdgeChoice::Triangles => "no triangles (see --edges)",
            EdgeChoice::All => "neither lines nor triangles",
        };
        return Err(Failure::in_file(file, format_args!("the file has {what}")));
    }
    Ok(scene)
}
