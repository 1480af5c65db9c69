//! Reading what is to be clipped.
//!
//! A mesh file becomes a [`Scene`], read once and instanced on the fly; rows,
//! GeoJSON and, if asked for, OBJ lines stay a stream.

pub(crate) mod csv;
#[cfg(any(test, fuzzing))]
pub(crate) mod damaged;
mod edges;
pub(crate) mod geojson;
mod gltf;
mod gltf_data;
mod lines;
pub(crate) mod obj;
mod opened;
mod ply;
mod ply_header;
mod scene;
mod stl;
pub(crate) mod wgs84;

pub(crate) use lines::Lines;
pub(crate) use opened::{Input, MARK};
pub(crate) use scene::{Bounds, Scene};

use crate::failure::Failure;
use clap::ValueEnum;
use std::path::Path;

/// Which edges of a mesh file to clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum EdgeChoice {
    /// The file's lines: glTF modes 1 to 3, OBJ `l`, PLY `edge`
    Lines,
    /// Each edge of each mesh's triangles (OBJ, PLY: polygons) once
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

/// The file formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// glTF 2.0, text or binary: .gltf .glb
    Gltf,
    /// Wavefront OBJ: .obj
    Obj,
    /// STL, text or binary: .stl
    Stl,
    /// PLY, text or binary: .ply
    Ply,
    /// Rows x0,y0,z0,x1,y1,z1: .csv
    Csv,
    /// GeoJSON: .geojson .json
    Geojson,
    /// A GeoJSON text a line: .geojsonl .geojsons .ndjson
    Geojsonl,
}

impl Format {
    /// The format that a file's name stands for.
    pub(crate) fn of(file: &Path) -> Result<Self, Failure> {
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or("");
        match extension.to_ascii_lowercase().as_str() {
            "glb" | "gltf" => Ok(Self::Gltf),
            "obj" => Ok(Self::Obj),
            "stl" => Ok(Self::Stl),
            "ply" => Ok(Self::Ply),
            "csv" => Ok(Self::Csv),
            "geojson" | "json" => Ok(Self::Geojson),
            "geojsonl" | "geojsons" | "geojsonseq" | "ndjson" => Ok(Self::Geojsonl),
            _ => Err(Failure::in_file(
                file,
                "unknown kind of file; expected .glb, .gltf, .obj, .stl, .ply, .csv, .geojson or \
                 .geojsonl, or give its format with --from",
            )),
        }
    }

    /// The format's name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Gltf => "gltf",
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Csv => "csv",
            Self::Geojson => "geojson",
            Self::Geojsonl => "geojsonl",
        }
    }

    /// Whether there are meshes in it.
    pub(crate) fn is_mesh(self) -> bool {
        matches!(self, Self::Gltf | Self::Obj | Self::Stl | Self::Ply)
    }

    /// Whether there are longitudes and latitudes in it.
    pub(crate) fn is_geographic(self) -> bool {
        matches!(self, Self::Geojson | Self::Geojsonl)
    }
}

/// Reads a mesh file.
pub(crate) fn read_scene(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    let scene = match input.format {
        Format::Obj => obj::read(input, choice)?,
        Format::Stl => stl::read(input, choice)?,
        Format::Ply => ply::read(input, choice)?,
        Format::Gltf => gltf::read(input, choice)?,
        Format::Csv | Format::Geojson | Format::Geojsonl => {
            return Err(input.failure("not a mesh"));
        }
    };
    if scene.len() == 0 {
        let what = match scene.kind() {
            EdgeChoice::Lines => "no lines (see --edges)",
            EdgeChoice::Triangles => "no triangles (see --edges)",
            EdgeChoice::All => "neither lines nor triangles",
        };
        return Err(input.failure(format_args!("the file has {what}")));
    }
    Ok(scene)
}
