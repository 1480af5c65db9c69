//! Clipping a source through the pipeline.

use super::engine::Engine;
use super::pipeline::{self, Emit};
use super::source::{Chunk, Source};
use super::stats::{Counts, Times};
use crate::failure::Failure;
use crate::io::number::Scalar;
use crate::io::output::{self, Formatted, Writer};
use crate::terminal::progress_bar;
use frusta::{Frustum, Segment, SegmentClip};
use std::time::{Duration, Instant};

/// Segments clipped at once: few enough that their clips stay in cache until they are formatted.
const BLOCK: usize = 512;

/// What to do.
pub(super) struct Run<'a, T> {
    pub(super) engine: Engine<T>,
    pub(super) output: output::Format,
    pub(super) threads: usize,
    pub(super) source: &'a Source,
    pub(super) frustum: &'a Frustum,
}

/// A chunk, clipped and formatted.
#[derive(Default)]
struct Done {
    formatted: Vec<Formatted>,
    counts: Counts,
    read: Duration,
    clip: Duration,
    write: Duration,
    position: u64,
}

impl<'a, T: Scalar> Run<'a, T> {
    /// Clips everything; adds to the times.
    pub(super) fn clip(&self, writer: &mut Writer, times: &mut Times) -> Result<Counts, Failure> {
        let bar = progress_bar(self.source.size());
        let mut counts = Counts::default();
        let timed = |emit: &mut Emit<'_, (Chunk<'a>, Duration)>| {
            let mut start = Instant::now();
            self.source.chunks(&mut |chunk| {
                let read = start.elapsed();
                let sent = emit((chunk, read));
                // Waiting for a worker is not reading.
                start = Instant::now();
                sent
            })
        };
        let result = pipeline::run(
            self.threads,
            timed,
            || self.worker(),
            |done: Done| {
                let start = Instant::now();
                done.formatted
                    .iter()
                    .try_for_each(|part| writer.accept(part))?;
                counts.merge(&done.counts);
                times.read += done.read;
                times.clip += done.clip;
                times.write += done.write + start.elapsed();
                bar.set_position(done.position);
                Ok(())
            },
        );
        bar.finish_and_clear();
        result.map(|()| counts)
    }

    /// A worker with buffers of its own, which it uses again for each chunk.
    fn worker(&self) -> impl FnMut((Chunk<'a>, Duration)) -> Result<Done, Failure> {
        let mut segments: Vec<Segment<T>> = Vec::new();
        let mut clips: Vec<SegmentClip<T>> = Vec::new();
        move |(chunk, read)| {
            let start = Instant::now();
            let (mut first, position) = (chunk.first, chunk.position);
            self.source.load(chunk, &mut segments)?;
            let mut done = Done {
                position,
                read: read + start.elapsed(),
                ..Done::default()
            };
            for block in segments.chunks(BLOCK) {
                let start = Instant::now();
                let stages = &mut done.counts.stages;
                let clipped = self.engine.clip(self.frustum, block, &mut clips, stages);
                clipped.map_err(|at| self.source.failure(first + at.index as u64, at.found))?;
                clips.iter().for_each(|clip| done.counts.add(clip));
                let clipped = Instant::now();
                done.formatted
                    .push(self.output.format(first, block, &clips));
                done.clip += clipped - start;
                done.write += clipped.elapsed();
                first += block.len() as u64;
            }
            Ok(done)
        }
    }
}
