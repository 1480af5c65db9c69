//! `frusta clip`: the parts of a file's segments that are in a frustum.
//!
//! ```text
//! reader:  ranges of the scene's edges, rows of a CSV file as text, or segments, in chunks
//! workers: edges to world coordinates, or rows to segments; clip; count; format
//! writer:  the formatted chunks, in order
//! ```
//!
//! ```text
//! source     where segments come from
//! engine     the algorithms by name
//! pipeline   reader, workers and writer; run: clipping through it
//! stats      the statistics of a run
//! help       the long help text
//! ```

mod engine;
mod help;
mod pipeline;
mod run;
mod source;
mod stats;

use crate::EXIT_CODES;
use crate::draw::clip::{PictureArgs, Tracer, View};
use crate::failure::Failure;
use crate::io::atomic_file::is_stream;
use crate::io::number::Scalar;
use crate::io::output::{self, Kind, Writer};
use crate::io::{EdgeChoice, Format, Input, Positions, ReadOptions, format_parser};
use crate::terminal::{print, print_error};
use crate::view::ViewArgs;
use clap::{Args, ValueEnum};
use engine::{Accuracy, Algorithm, Arithmetic, Engine};
use frusta::Frustum;
use help::{FORMATS, HELP_END};
use pipeline::start_by;
use run::Run;
use source::Source;
use stats::{Report, Times};
use std::path::PathBuf;
use std::time::Instant;

/// Clip the segments of a file by a view frustum
///
/// Reads line segments from FILE, clips each, and writes the parts, a picture of them, or only
/// statistics. Classes and faces are exact unless --arithmetic plain is asked for.
#[derive(Args, Debug)]
#[command(after_help = HELP_END, after_long_help = format!("{FORMATS}\n{EXIT_CODES}"))]
pub(crate) struct ClipArgs {
    /// What to clip: .glb .gltf .obj .stl .ply .csv .geojson .geojsonl, or - for the standard input
    file: PathBuf,
    /// The file's format [default: by its name]
    #[arg(long, value_name = "FORMAT", value_parser = format_parser())]
    from: Option<&'static dyn Format>,
    /// Write the result: .csv (a row a segment), .obj .glb (lines), .svg .png (a picture), or - for the standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The output's format [default: by its name]
    #[arg(long, value_name = "FORMAT")]
    to: Option<Kind>,
    /// Statistics as JSON on the standard output; with -o -, on the error stream
    #[arg(long)]
    json: bool,
    /// Edges to take from a mesh [default: lines if the file has any, else triangles]
    #[arg(long)]
    edges: Option<EdgeChoice>,
    /// GeoJSON: positions are degrees and metres on WGS 84; coordinates become earth-centred metres
    #[arg(long)]
    ecef: bool,
    /// The algorithm
    #[arg(long, default_value = "vw")]
    algorithm: Algorithm,
    /// The arithmetic of its decisions
    #[arg(long, default_value = "exact")]
    arithmetic: Arithmetic,
    /// With exact arithmetic: how clipped points are computed [default: fast]
    #[arg(long)]
    accuracy: Option<Accuracy>,
    /// The type of the segments' coordinates
    #[arg(long, default_value = "f64")]
    precision: Precision,
    /// Threads that read, clip and format [default: one a core]; the output does not depend on it
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    view: ViewArgs,
}

/// `--precision`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Precision {
    /// Coordinates are rounded to single precision before they are clipped
    F32,
    /// Double precision
    F64,
}

/// Runs the command.
pub(crate) fn run(args: &ClipArgs) -> Result<(), Failure> {
    match args.precision {
        Precision::F32 => run_as::<f32>(args),
        Precision::F64 => run_as::<f64>(args),
    }
}

fn run_as<T: Scalar>(args: &ClipArgs) -> Result<(), Failure> {
    let start = Instant::now();
    let kind = Kind::of(args.output.as_deref(), args.to)?;
    args.check(kind)?;
    let input = Input::new(&args.file, args.from)?;
    let (name, format) = (input.name().display().to_string(), input.format().name());
    let threads = args.threads.map_or_else(crate::cores, usize::from);
    let pool = thread_pool(threads)?;
    let source = pool.install(|| args.source(input))?;
    let view = args.view.view(|| source.bounds())?;
    let accuracy = args.accuracy.unwrap_or(Accuracy::Fast);
    let run = Run {
        engine: Engine::<T>::new(args.algorithm, args.arithmetic, accuracy),
        output: output::Format::new(kind, &view.frustum, || args.tracer(&source, &view.frustum))?,
        threads,
        source: &source,
        frustum: &view.frustum,
    };
    let mut writer = Writer::create(kind, &run.output, args.output.as_deref())?;
    let mut times = Times {
        read: start.elapsed(),
        ..Times::default()
    };
    let counts = pool.install(|| run.clip(&mut writer, &mut times))?;
    let finish = Instant::now();
    let title = format!("{name}   {}", view.flags);
    pool.install(|| writer.finish(&title, &counts.classes))?;
    times.write += finish.elapsed();
    times.total = start.elapsed();
    let (arithmetic, accuracy) = run.engine.arithmetic();
    args.print(&Report {
        file: name,
        format,
        edges: source.edges(),
        algorithm: run.engine.name(),
        arithmetic,
        accuracy,
        precision: T::NAME,
        threads: run.threads,
        flags: &view.flags,
        chosen: view.chosen,
        deviation: view.deviation,
        frustum: &view.frustum,
        output: args.output.as_ref().map(|o| o.display().to_string()),
        counts,
        staged: run.engine.counts(),
        times,
    })
}

impl ClipArgs {
    /// Refuses flags that would have no effect.
    fn check(&self, kind: Kind) -> Result<(), Failure> {
        if self.arithmetic == Arithmetic::Plain && self.accuracy.is_some() {
            return Err(Failure::new("--accuracy is for --arithmetic exact"));
        }
        match self.pictures.given().filter(|_| !kind.is_picture()) {
            Some(flag) => Err(Failure::new(format_args!(
                "{flag} is for pictures; give -o FILE.svg or FILE.png"
            ))),
            None => Ok(()),
        }
    }

    fn source(&self, input: Input) -> Result<Source, Failure> {
        let positions = if self.ecef {
            Positions::Ecef
        } else {
            Positions::AsGiven
        };
        let edges = self.edges;
        Source::open(input, ReadOptions { edges, positions })
    }

    fn tracer(&self, source: &Source, frustum: &Frustum) -> Result<Tracer, Failure> {
        let options = self.pictures.options();
        let scene = match options.view {
            View::Outside if !source.is_piped() => Some(source.bounds()?),
            _ => None,
        };
        Tracer::new(options, frustum, scene.as_ref())
    }

    /// Prints the statistics: on the error stream if the output is the standard output.
    fn print(&self, report: &Report<'_>) -> Result<(), Failure> {
        let text = if self.json {
            format!("{:#}\n", report.to_json())
        } else {
            report.to_table()
        };
        if self.output.as_deref().is_some_and(is_stream) {
            print_error(&text);
            return Ok(());
        }
        print(&text)
    }
}

/// The threads that read a mesh and sum ink.
fn thread_pool(count: usize) -> Result<rayon::ThreadPool, Failure> {
    let start = |thread: rayon::ThreadBuilder| {
        start_by(|runs| {
            std::thread::Builder::new().spawn(move || {
                let _ = runs.send(());
                thread.run();
            })
        })
    };
    let builder = rayon::ThreadPoolBuilder::new().num_threads(count);
    let pool = builder.spawn_handler(start).build();
    pool.map_err(|e| Failure::new(format_args!("threads: {e}")))
}
