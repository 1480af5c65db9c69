//! Where segments come from: a scene in memory, or a stream.

use crate::failure::Failure;
use crate::input::geojson::{self, Positions};
use crate::input::{self, Bounds, EdgeChoice, Format, Input, Scene, csv, obj};
use crate::number::Scalar;
use crate::pipeline::Emit;
use frusta::{NonFinite, Segment, Vec3};
use std::sync::OnceLock;

/// Segments in a chunk: few enough that a chunk's results stay in cache.
const CHUNK: u64 = 4096;

/// What to clip.
pub(super) struct Source {
    input: Input,
    positions: Positions,
    /// `None` for what stays a stream.
    scene: Option<Scene>,
    /// Once it has been asked for: a stream is read for it.
    bounds: OnceLock<Bounds>,
}

/// Consecutive segments.
pub(super) struct Chunk {
    /// The first one's number.
    pub(super) first: u64,
    /// How far the source has been read, of [`Source::size`].
    pub(super) position: u64,
    load: Load,
}

enum Load {
    /// So many of the scene's.
    Edges(u64),
    /// Rows, to be parsed.
    Rows(csv::Block),
    /// These.
    Segments(Vec<Segment<f64>>),
}

impl Source {
    /// Opens a file; a mesh is read as a whole.
    pub(super) fn open(
        input: Input,
        edges: Option<EdgeChoice>,
        positions: Positions,
    ) -> Result<Self, Failure> {
        let fail = |why: &str| Err(Failure::in_file(input.name(), why));
        if positions == Positions::Ecef && !input.format.is_geographic() {
            return fail("--ecef is for GeoJSON: it needs longitudes and latitudes");
        }
        if edges.is_some() && !input.format.is_mesh() {
            return fail("--edges is for meshes");
        }
        let streamed = match input.format {
            Format::Obj => edges == Some(EdgeChoice::Lines),
            format => !format.is_mesh(),
        };
        let scene = match streamed {
            true => None,
            false => Some(input::read_scene(&input, edges)?),
        };
        Ok(Self {
            input,
            positions,
            scene,
            bounds: OnceLock::new(),
        })
    }

    /// Whether it can be read only once.
    pub(super) fn is_piped(&self) -> bool {
        self.scene.is_none() && self.input.is_piped()
    }

    /// A box around all segments; a stream is read once for it.
    pub(super) fn bounds(&self) -> Result<Bounds, Failure> {
        if let Some(&bounds) = self.bounds.get() {
            return Ok(bounds);
        }
        let bounds = self.find_bounds()?;
        Ok(*self.bounds.get_or_init(|| bounds))
    }

    fn find_bounds(&self) -> Result<Bounds, Failure> {
        if let Some(scene) = &self.scene {
            return Ok(scene.bounds());
        }
        if self.is_piped() {
            let why = "it is read once: give the view with --eye and --target, or --frustum";
            return Err(Failure::in_file(self.input.name(), why));
        }
        let mut bounds = Bounds::EMPTY;
        let mut add = |segment: Segment<f64>| {
            bounds.add(segment.start);
            bounds.add(segment.end);
        };
        let mut rows = Vec::new();
        if self.input.format == Format::Csv {
            csv::blocks(&self.input, |block| {
                rows.clear();
                let parsed = block.parse(&mut rows);
                parsed.map_err(|e| self.failure_in_line(e))?;
                rows.iter().copied().for_each(&mut add);
                Ok(())
            })?;
        } else {
            self.stream(&mut |segment| {
                add(segment);
                Ok(())
            })?;
        }
        Ok(bounds)
    }

    /// Which edges are read, of a mesh.
    pub(super) fn edges(&self) -> Option<&'static str> {
        match &self.scene {
            Some(scene) => Some(scene.kind().name()),
            None => (self.input.format == Format::Obj).then(|| EdgeChoice::Lines.name()),
        }
    }

    /// What the progress is measured by: segments, or bytes; `None` for a pipe.
    pub(super) fn size(&self) -> Option<u64> {
        match &self.scene {
            Some(scene) => Some(scene.len()),
            None => self.input.size(),
        }
    }

    /// Emits all chunks in order.
    pub(super) fn chunks(&self, emit: &mut Emit<'_, Chunk>) -> Result<(), Failure> {
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
        if let Some(scene) = &self.scene {
            let total = scene.len();
            return (0..total).step_by(CHUNK as usize).try_for_each(|start| {
                let count = CHUNK.min(total - start);
                send(Load::Edges(count), count, start + count)
            });
        }
        if self.input.format == Format::Csv {
            return csv::blocks(&self.input, |block| {
                let rows = block.rows();
                send(Load::Rows(block), rows, self.input.position())
            });
        }
        let mut segments = Vec::new();
        let mut count = 0_u64;
        self.stream(&mut |segment| {
            segments.push(segment);
            count += 1;
            if segments.len() as u64 == CHUNK {
                let full = std::mem::take(&mut segments);
                send(Load::Segments(full), CHUNK, self.input.position())?;
            }
            Ok(())
        })?;
        if count == 0 {
            return Err(Failure::in_file(
                self.input.name(),
                "the file has no lines or polygons",
            ));
        }
        let left = segments.len() as u64;
        send(Load::Segments(segments), left, self.input.position())
    }

    /// Gives every segment of what is read one by one.
    fn stream(
        &self,
        take: &mut dyn FnMut(Segment<f64>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        match self.input.format {
            Format::Geojson => geojson::document(&self.input, self.positions, take),
            Format::Geojsonl => geojson::sequence(&self.input, self.positions, take),
            _ => obj::lines(&self.input, take),
        }
    }

    /// Puts a chunk's segments into `out`.
    pub(super) fn load<T: Scalar>(
        &self,
        chunk: Chunk,
        out: &mut Vec<Segment<T>>,
    ) -> Result<(), Failure> {
        out.clear();
        match (chunk.load, &self.scene) {
            (Load::Rows(block), _) => block.parse(out).map_err(|e| self.failure_in_line(e))?,
            (Load::Segments(segments), _) => out.extend(segments.iter().map(|s| Segment {
                start: Vec3::from_f64(s.start),
                end: Vec3::from_f64(s.end),
            })),
            (Load::Edges(count), Some(scene)) => scene.fill(chunk.first, count, out),
            (Load::Edges(_), None) => {}
        }
        Ok(())
    }

    fn failure_in_line(&self, (line, why): (u64, String)) -> Failure {
        Failure::at(self.input.name(), format_args!("line {line}"), why)
    }

    /// The failure for a segment that cannot be clipped.
    pub(super) fn failure(&self, index: u64, why: NonFinite) -> Failure {
        let place = match &self.scene {
            Some(scene) => scene.place(index),
            None => format!("segment {index}"),
        };
        Failure::at(self.input.name(), place, why)
    }
}
