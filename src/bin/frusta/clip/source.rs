//! Where segments come from: a scene in memory or a file of rows.

use crate::failure::Failure;
use crate::input::csv::{self, Rows};
use crate::input::{self, Bounds, EdgeChoice, Format, Scene};
use crate::number::Scalar;
use frusta::{NonFinite, Segment};
use std::path::{Path, PathBuf};

/// Segments in a chunk: few enough that a chunk's results stay in cache.
const CHUNK: u64 = 4096;

/// A file to clip.
pub(super) struct Source {
    file: PathBuf,
    /// `None` for a file of rows.
    scene: Option<Scene>,
}

/// Consecutive segments.
pub(super) struct Chunk<T> {
    /// The first one's number.
    pub(super) first: u64,
    load: Load<T>,
}

enum Load<T> {
    /// So many of the scene's.
    Edges(u64),
    /// These.
    Rows(Vec<Segment<T>>),
}

impl Source {
    /// Opens a file; a mesh is read as a whole.
    pub(super) fn open(
        file: &Path,
        format: Format,
        edges: Option<EdgeChoice>,
    ) -> Result<Self, Failure> {
        let scene = match format {
            Format::Csv if edges.is_some() => {
                let why = "--edges is for meshes; a CSV file has rows";
                return Err(Failure::in_file(file, why));
            }
            Format::Csv => None,
            _ => Some(input::read_scene(file, format, edges)?),
        };
        Ok(Self {
            file: file.to_owned(),
            scene,
        })
    }

    /// A box around all segments.
    pub(super) fn bounds(&self) -> Result<Bounds, Failure> {
        match &self.scene {
            Some(scene) => Ok(scene.bounds()),
            None => csv::bounds(&self.file),
        }
    }

    /// Which edges are read, of a mesh.
    pub(super) fn edges(&self) -> Option<&'static str> {
        self.scene.as_ref().map(|scene| scene.kind().name())
    }

    /// What the progress is measured by: segments, or bytes of rows.
    pub(super) fn size(&self) -> u64 {
        match &self.scene {
            Some(scene) => scene.len(),
            None => self.file.metadata().map_or(0, |m| m.len()),
        }
    }

    /// A function that gives the next chunk and how far the source is read.
    pub(super) fn chunks<T: Scalar>(
        &self,
    ) -> Result<impl FnMut() -> Result<Option<(Chunk<T>, u64)>, Failure> + Send, Failure> {
        let mut rows = match &self.scene {
            Some(_) => None,
            None => Some(Rows::open(&self.file)?),
        };
        let total = self.scene.as_ref().map_or(0, Scene::len);
        let mut first = 0;
        Ok(move || {
            let (load, count, position) = match &mut rows {
                Some(rows) => {
                    let segments = read_rows(rows)?;
                    let count = segments.len() as u64;
                    (Load::Rows(segments), count, rows.position())
                }
                None => {
                    let count = CHUNK.min(total - first);
                    (Load::Edges(count), count, first + count)
                }
            };
            let chunk = Chunk { first, load };
            first += count;
            Ok((count > 0).then_some((chunk, position)))
        })
    }

    /// Puts a chunk's segments into `out`.
    pub(super) fn load<T: Scalar>(&self, chunk: Chunk<T>, out: &mut Vec<Segment<T>>) {
        match chunk.load {
            Load::Rows(rows) => *out = rows,
            Load::Edges(count) => {
                out.clear();
                if let Some(scene) = &self.scene {
                    scene.fill(chunk.first, count, out);
                }
            }
        }
    }

    /// The failure for a segment that cannot be clipped.
    pub(super) fn failure(&self, index: u64, why: NonFinite) -> Failure {
        let place = match &self.scene {
            Some(scene) => scene.place(index),
            None => format!("segment {index}"),
        };
        Failure::at(&self.file, place, why)
    }
}

fn read_rows<T: Scalar>(rows: &mut Rows) -> Result<Vec<Segment<T>>, Failure> {
    let mut segments = Vec::with_capacity(CHUNK as usize);
    while segments.len() < CHUNK as usize {
        match rows.next()? {
            Some(segment) => segments.push(segment),
            None => break,
        }
    }
    Ok(segments)
}
