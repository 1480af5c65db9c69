//! File formats: what each knows of itself, and the list of them.

use super::csv::Csv;
use super::geojson::Geojson;
use super::geojsonl::Geojsonl;
use super::gltf::Gltf;
use super::obj::Obj;
use super::ply::Ply;
use super::stl::Stl;
use super::{Input, Rows, Scene};
use crate::Failure;
use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use frusta::Segment;
use std::fmt;
use std::path::Path;

/// All formats. A new one has a file of its own and a line here.
pub const FORMATS: [&dyn Format; 7] = [&Gltf, &Obj, &Stl, &Ply, &Csv, &Geojson, &Geojsonl];

/// A file format that can be read.
pub trait Format: Sync {
    /// The name on the command line.
    fn name(&self) -> &'static str;

    /// A few words for the help text.
    fn description(&self) -> &'static str;

    /// The extensions of file names, in lower case and without a dot; the usual one first.
    fn extensions(&self) -> &'static [&'static str];

    /// Whether there are meshes in it, of which edges are chosen.
    fn is_mesh(&self) -> bool {
        false
    }

    /// Whether positions are longitudes and latitudes.
    fn is_geographic(&self) -> bool {
        false
    }

    /// Whether a file is a text, or begins like one: a byte order mark is passed over, and UTF-16
    /// is refused.
    fn begins_as_text(&self) -> bool {
        true
    }

    /// Opens a file: a mesh is read as a whole, anything else when it is asked for.
    ///
    /// # Errors
    /// The file cannot be read or is malformed.
    fn open(&self, input: &Input, options: ReadOptions) -> Result<Contents, Failure>;
}

impl fmt::Debug for dyn Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl dyn Format {
    /// The format that a file's extension stands for.
    ///
    /// # Errors
    /// No format has the extension.
    pub fn of(file: &Path) -> Result<&'static Self, Failure> {
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or("");
        let extension = extension.to_ascii_lowercase();
        let found = FORMATS
            .into_iter()
            .find(|format| format.extensions().contains(&extension.as_str()));
        found.ok_or_else(|| {
            let known = FORMATS.iter().flat_map(|format| format.extensions());
            let known: Vec<String> = known.map(|extension| format!(".{extension}")).collect();
            let known = known.join(" ");
            let why = format!("unknown kind of file; expected {known}, or --from FORMAT");
            Failure::in_file(file, why)
        })
    }
}

/// Reads a format's name on the command line.
pub(crate) fn parser() -> impl TypedValueParser<Value = &'static dyn Format> {
    let values = FORMATS.map(|format| {
        let extensions: String = format
            .extensions()
            .iter()
            .map(|e| format!(" .{e}"))
            .collect();
        PossibleValue::new(format.name()).help(format!("{}:{extensions}", format.description()))
    });
    PossibleValuesParser::new(values).try_map(|name| {
        let found = FORMATS.into_iter().find(|format| format.name() == name);
        found.ok_or("unknown format")
    })
}

/// Which edges of a mesh file to clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum EdgeChoice {
    /// The file's lines: glTF modes 1 to 3, OBJ `l`, PLY `edge`
    Lines,
    /// Each edge of each mesh's triangles (OBJ, PLY: polygons) once
    Triangles,
    /// Both: a mesh's lines, then its triangle edges
    All,
}

impl EdgeChoice {
    pub(super) fn wants_lines(self) -> bool {
        self != Self::Triangles
    }

    pub(super) fn wants_faces(self) -> bool {
        self != Self::Lines
    }

    /// The choice's name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lines => "lines",
            Self::Triangles => "triangles",
            Self::All => "all",
        }
    }
}

/// How the positions of a geographic file become coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Positions {
    /// Longitude, latitude and height are x, y and z.
    #[default]
    AsGiven,
    /// Degrees and metres on WGS 84 become earth-centred metres; segments are straight between
    /// them.
    Ecef,
}

/// What to read of a file.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReadOptions {
    /// For meshes. By default the lines, if the file has any, else the triangles.
    pub edges: Option<EdgeChoice>,
    /// For geographic files.
    pub positions: Positions,
}

/// Takes the segments of a stream one by one; its failure ends the reading.
pub type Take<'a> = dyn FnMut(Segment<f64>) -> Result<(), Failure> + 'a;

/// Segments that are read one by one, each time from the beginning.
pub struct Stream {
    input: Input,
    edges: Option<EdgeChoice>,
    read: Box<ReadSegments>,
}

type ReadSegments = dyn Fn(&Input, &mut Take<'_>) -> Result<(), Failure> + Send + Sync;

impl Stream {
    pub(super) fn new(
        input: &Input,
        edges: Option<EdgeChoice>,
        read: impl Fn(&Input, &mut Take<'_>) -> Result<(), Failure> + Send + Sync + 'static,
    ) -> Self {
        Self {
            input: input.clone(),
            edges,
            read: Box::new(read),
        }
    }

    /// Reads all segments.
    ///
    /// # Errors
    /// The file cannot be read or is malformed, or `take` failed.
    pub fn read(&self, take: &mut Take<'_>) -> Result<(), Failure> {
        (self.read)(&self.input, take)
    }
}

/// A file, opened.
pub enum Contents {
    /// Meshes, in memory.
    Scene(Scene),
    /// Rows of a table, as blocks of text that can be parsed by several threads.
    Rows(Rows),
    /// Segments one by one.
    Stream(Stream),
}

impl Contents {
    /// Which edges are read, if the file has meshes.
    #[must_use]
    pub fn edges(&self) -> Option<EdgeChoice> {
        match self {
            Self::Scene(scene) => Some(scene.kind()),
            Self::Rows(_) => None,
            Self::Stream(stream) => stream.edges,
        }
    }
}

/// Opens a file by its format.
///
/// # Errors
/// An option does not apply to the format, or the file cannot be read, is malformed or is a mesh
/// without edges.
pub fn open(input: &Input, options: ReadOptions) -> Result<Contents, Failure> {
    let format = input.format();
    if options.positions == Positions::Ecef && !format.is_geographic() {
        return Err(input.failure("--ecef is for GeoJSON: it needs longitudes and latitudes"));
    }
    if options.edges.is_some() && !format.is_mesh() {
        return Err(input.failure("--edges is for meshes"));
    }
    let contents = format.open(input, options)?;
    match &contents {
        Contents::Scene(scene) if scene.is_empty() => Err(input.failure(match scene.kind() {
            EdgeChoice::Lines => "the file has no lines (see --edges)",
            EdgeChoice::Triangles => "the file has no triangles (see --edges)",
            EdgeChoice::All => "the file has neither lines nor triangles",
        })),
        _ => Ok(contents),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_extensions_are_unique_and_found() {
        for (i, format) in FORMATS.iter().enumerate() {
            for other in &FORMATS[..i] {
                assert_ne!(format.name(), other.name());
                let shared = |e| other.extensions().contains(e);
                assert!(
                    !format.extensions().iter().any(shared),
                    "{format:?} {other:?}"
                );
            }
            for extension in format.extensions() {
                let file = format!("a.{}", extension.to_ascii_uppercase());
                let found = <dyn Format>::of(Path::new(&file)).unwrap();
                assert_eq!(found.name(), format.name());
            }
        }
        assert!(<dyn Format>::of(Path::new("a.step")).is_err());
        assert!(<dyn Format>::of(Path::new("obj")).is_err());
    }
}
