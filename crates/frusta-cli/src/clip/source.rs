//! Where segments come from: a scene in memory, rows, or a stream.

use super::pipeline::Emit;
use crate::failure::Failure;
use crate::io::{
    Block, Bounds, Contents, EdgeChoice, Input, LineError, ReadOptions, Scalar, Scene, Stream, open,
};
use frusta::{NonFinite, Segment, Vec3};
use std::sync::OnceLock;

/// Segments in a chunk: enough that handing them on costs nothing beside clipping them.
const CHUNK: u64 = 4096;

/// What to clip.
pub(super) struct Source {
    input: Input,
    contents: Contents,
    /// Once they have been asked for: a stream is read for them.
    bounds: OnceLock<Bounds>,
}

/// Consecutive segments.
pub(super) struct Chunk<'a> {
    /// The first one's index.
    pub(super) first: u64,
    /// How far the source has been read, of [`Source::size`].
    pub(super) position: u64,
    load: Load<'a>,
}

enum Load<'a> {
    /// So many of a scene's segments.
    Edges(&'a Scene, u64),
    /// Rows, to be parsed.
    Rows(Block),
    /// These.
    Segments(Vec<Segment<f64>>),
}

impl Source {
    /// Opens a file; a mesh is read as a whole.
    pub(super) fn open(input: Input, options: ReadOptions) -> Result<Self, Failure> {
        Ok(Self {
            contents: open(&input, options)?,
            input,
            bounds: OnceLock::new(),
        })
    }

    /// Whether it can be read only once.
    pub(super) fn is_piped(&self) -> bool {
        !matches!(self.contents, Contents::Scene(_)) && self.input.is_piped()
    }

    /// A box around all segments; rows and streams are read once for it.
    pub(super) fn bounds(&self) -> Result<Bounds, Failure> {
        if let Some(&bounds) = self.bounds.get() {
            return Ok(bounds);
        }
        let bounds = self.find_bounds()?;
        Ok(*self.bounds.get_or_init(|| bounds))
    }

    fn find_bounds(&self) -> Result<Bounds, Failure> {
        if self.is_piped() {
            let why = "it is read once: give the view with --eye and --target, or --frustum";
            return Err(self.input.failure(why));
        }
        let mut bounds = Bounds::EMPTY;
        let mut add = |segment: Segment<f64>| {
            bounds.add(segment.start);
            bounds.add(segment.end);
        };
        match &self.contents {
            Contents::Scene(scene) => return Ok(scene.bounds()),
            Contents::Rows(rows) => {
                let mut segments = Vec::new();
                rows.blocks(|block| {
                    segments.clear();
                    self.parse(&block, &mut segments)?;
                    segments.iter().copied().for_each(&mut add);
                    Ok(())
                })?;
            }
            Contents::Stream(stream) => stream.read(&mut |segment| {
                add(segment);
                Ok(())
            })?,
        }
        Ok(bounds)
    }

    /// Which edges of a mesh are read.
    pub(super) fn edges(&self) -> Option<&'static str> {
        self.contents.edges().map(EdgeChoice::name)
    }

    /// The size for the progress bar: segments, or bytes; `None` for a pipe.
    pub(super) fn size(&self) -> Option<u64> {
        match &self.contents {
            Contents::Scene(scene) => Some(scene.len()),
            Contents::Rows(_) | Contents::Stream(_) => self.input.size(),
        }
    }

    /// Emits all chunks in order.
    pub(super) fn chunks<'a>(&'a self, emit: &mut Emit<'_, Chunk<'a>>) -> Result<(), Failure> {
        let mut first = 0;
        let mut send = |load, count, position| {
            let chunk = Chunk {
                first,
                position,
                load,
            };
            first += count;
            emit(chunk)
        };
        match &self.contents {
            Contents::Scene(scene) => {
                let total = scene.len();
                (0..total).step_by(CHUNK as usize).try_for_each(|start| {
                    let count = CHUNK.min(total - start);
                    send(Load::Edges(scene, count), count, start + count)
                })
            }
            Contents::Rows(rows) => rows.blocks(|block| {
                let count = block.rows();
                send(Load::Rows(block), count, self.input.position())
            }),
            Contents::Stream(stream) => self.collect(stream, send),
        }
    }

    /// Emits a stream's segments in chunks.
    fn collect<'a>(
        &self,
        stream: &Stream,
        mut send: impl FnMut(Load<'a>, u64, u64) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut segments = Vec::new();
        let mut is_empty = true;
        stream.read(&mut |segment| {
            segments.push(segment);
            is_empty = false;
            if segments.len() as u64 == CHUNK {
                let full = std::mem::take(&mut segments);
                send(Load::Segments(full), CHUNK, self.input.position())?;
            }
            Ok(())
        })?;
        if is_empty {
            return Err(self.input.failure("the file has no lines or polygons"));
        }
        let left = segments.len() as u64;
        send(Load::Segments(segments), left, self.input.position())
    }

    /// Puts a chunk's segments into `out`.
    pub(super) fn load<T: Scalar>(
        &self,
        chunk: Chunk<'_>,
        out: &mut Vec<Segment<T>>,
    ) -> Result<(), Failure> {
        out.clear();
        match chunk.load {
            Load::Edges(scene, count) => scene.fill(chunk.first, count, out),
            Load::Rows(block) => self.parse(&block, out)?,
            Load::Segments(segments) => out.extend(segments.iter().map(|s| Segment {
                start: Vec3::from_f64(s.start),
                end: Vec3::from_f64(s.end),
            })),
        }
        Ok(())
    }

    fn parse<T: Scalar>(&self, block: &Block, out: &mut Vec<Segment<T>>) -> Result<(), Failure> {
        let fail = |e: LineError| self.input.failure_in_line(e);
        block.parse(out).map_err(fail)
    }

    /// The failure for a segment that cannot be clipped.
    pub(super) fn failure(&self, index: u64, why: NonFinite) -> Failure {
        let place = match &self.contents {
            Contents::Scene(scene) => scene.place(index),
            Contents::Rows(_) | Contents::Stream(_) => format!("segment {index}"),
        };
        Failure::at(self.input.name(), place, why)
    }
}
