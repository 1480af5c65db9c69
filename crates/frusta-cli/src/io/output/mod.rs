//! Writing clipped segments, by the output file's extension.
//!
//! Workers format their chunk of results ([`Format::format`]), the writer puts
//! the chunks together in order ([`Writer::accept`]).

pub(crate) mod csv;
mod glb;
mod obj;

use crate::draw::clip::{Picture, Traced, Tracer};
use crate::draw::{self, Theme};
use crate::failure::Failure;
use crate::io::atomic_file::{AtomicFile, is_stream};
use crate::io::number::Scalar;
use clap::ValueEnum;
use frusta::{Frustum, Segment, SegmentClip};
use std::path::Path;
use std::sync::Arc;

/// The formatted results of a chunk.
#[derive(Debug, Default)]
pub(crate) struct Formatted {
    /// Text for the file.
    text: Vec<u8>,
    /// GLB: points by class, or a coordinate that is too large.
    points_by_class: Option<Result<[glb::Points; 5], f64>>,
    /// Pictures: the strokes.
    traced: Traced,
}

/// Kinds of output files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// No file.
    #[value(skip)]
    None,
    /// A row a segment
    Csv,
    /// Lines
    Obj,
    /// Lines, glTF binary
    Glb,
    /// A picture, vectors
    Svg,
    /// A picture, pixels
    Png,
}

impl Kind {
    /// The asked kind, or that which a file's name stands for.
    pub(crate) fn of(file: Option<&Path>, asked: Option<Self>) -> Result<Self, Failure> {
        let Some(file) = file else {
            return match asked {
                Some(_) => Err(Failure::new("--to is for an output; give it with -o")),
                None => Ok(Self::None),
            };
        };
        if let Some(kind) = asked {
            return Ok(kind);
        }
        if is_stream(file) {
            let why = "give its format with --to";
            return Err(Failure::in_file(Path::new("standard output"), why));
        }
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or("");
        match extension.to_ascii_lowercase().as_str() {
            "csv" => Ok(Self::Csv),
            "obj" => Ok(Self::Obj),
            "glb" => Ok(Self::Glb),
            "svg" => Ok(Self::Svg),
            "png" => Ok(Self::Png),
            _ => Err(Failure::in_file(
                file,
                "unknown kind of output; expected .csv, .obj, .glb, .svg or .png",
            )),
        }
    }

    /// Whether it is a picture.
    pub(crate) fn is_picture(self) -> bool {
        matches!(self, Self::Svg | Self::Png)
    }
}

/// How results are formatted.
#[derive(Clone, Debug)]
pub(crate) enum Format {
    /// Not at all: statistics only.
    None,
    /// A row a segment.
    Csv,
    /// A line element a part.
    Obj,
    /// A line a part, relative to a centre.
    Glb(glb::Centre),
    /// Drawn.
    Picture(Arc<Tracer>),
}

impl Format {
    /// Formatting for a kind of file; pictures are traced by what `tracer` gives.
    pub(crate) fn new(
        kind: Kind,
        frustum: &Frustum,
        tracer: impl FnOnce() -> Result<Tracer, Failure>,
    ) -> Result<Self, Failure> {
        Ok(match kind {
            Kind::None => Self::None,
            Kind::Csv => Self::Csv,
            Kind::Obj => Self::Obj,
            Kind::Glb => Self::Glb(glb::Centre::of(frustum)),
            Kind::Svg | Kind::Png => Self::Picture(Arc::new(tracer()?)),
        })
    }

    /// Formats the results of the segments from index `first` on.
    pub(crate) fn format<T: Scalar>(
        &self,
        first: u64,
        segments: &[Segment<T>],
        clips: &[SegmentClip<T>],
    ) -> Formatted {
        let mut out = Formatted::default();
        match self {
            Self::None => {}
            Self::Csv => csv::format(first, clips, &mut out.text),
            Self::Obj => obj::format(clips, &mut out.text),
            Self::Glb(centre) => out.points_by_class = Some(glb::format(centre, clips)),
            Self::Picture(tracer) => out.traced = tracer.trace(segments, clips),
        }
        out
    }
}

/// Puts formatted chunks together into a file.
pub(crate) enum Writer {
    /// No file.
    None,
    /// Text, written as it comes.
    Text(AtomicFile),
    /// Points, kept in files of their own until the end.
    Glb(AtomicFile, glb::Model),
    /// A picture, written at the end.
    Picture(AtomicFile, Kind, Picture),
}

impl Writer {
    /// Begins a file; it appears under its name only when it is finished.
    pub(crate) fn create(
        kind: Kind,
        format: &Format,
        file: Option<&Path>,
    ) -> Result<Self, Failure> {
        let Some(file) = file else {
            return Ok(Self::None);
        };
        let mut out = AtomicFile::create(file)?;
        Ok(match format {
            Format::None => Self::None,
            Format::Csv => {
                out.write(csv::HEADER.as_bytes())?;
                Self::Text(out)
            }
            Format::Obj => {
                out.write(obj::HEADER.as_bytes())?;
                Self::Text(out)
            }
            Format::Glb(centre) => Self::Glb(out, glb::Model::new(*centre)?),
            Format::Picture(tracer) => Self::Picture(out, kind, Picture::new(tracer.clone())),
        })
    }

    /// Takes the next chunk.
    pub(crate) fn accept(&mut self, chunk: &Formatted) -> Result<(), Failure> {
        match self {
            Self::None => Ok(()),
            Self::Text(out) => out.write(&chunk.text),
            Self::Glb(_, model) => match &chunk.points_by_class {
                Some(Ok(points)) => model.add(points),
                Some(Err(value)) => Err(Failure::new(format_args!(
                    "GLB has coordinates in single precision, which cannot hold {value:e}"
                ))),
                None => Ok(()),
            },
            Self::Picture(_, _, picture) => {
                picture.add(&chunk.traced);
                Ok(())
            }
        }
    }

    /// Completes the file and gives it its name. The title and the number of
    /// segments by class go into pictures.
    pub(crate) fn finish(self, title: &str, classes: &[u64; 5]) -> Result<(), Failure> {
        match self {
            Self::None => Ok(()),
            Self::Text(out) => out.finish(),
            Self::Glb(mut out, model) => {
                model.write(&mut out, title, Theme::Light.palette())?;
                out.finish()
            }
            Self::Picture(mut out, kind, picture) => {
                let svg = picture.svg(title, classes)?;
                match kind {
                    Kind::Png => out.write(&draw::png(&svg)?)?,
                    _ => out.write(svg.as_bytes())?,
                }
                out.finish()
            }
        }
    }
}
