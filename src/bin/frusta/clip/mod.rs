//! `frusta clip`: the part of each of a file's segments that is in a frustum.
//!
//! ```text
//! reader:  numbers of the scene's edges, or rows of a CSV file, in chunks
//! workers: edges to world coordinates; clip; count; format
//! writer:  the formatted chunks, in order
//! ```

mod run;
mod source;

use crate::EXIT_CODES;
use crate::engine::{Accuracy, Algorithm, Arithmetic, Engine};
use crate::failure::Failure;
use crate::input::geojson::Positions;
use crate::input::{self, EdgeChoice, Input};
use crate::number::Scalar;
use crate::output::{self, Kind, Writer};
use crate::picture::{Canvas, PictureArgs, View};
use crate::stats::{Report, Times};
use crate::terminal::{print, say};
use crate::view::ViewArgs;
use crate::whole_file::is_stream;
use clap::{Args, ValueEnum};
use frusta::Frustum;
use run::Run;
use source::Source;
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
    #[arg(long, value_name = "FORMAT")]
    from: Option<input::Format>,
    /// Write the result: .csv (a row a segment), .obj .glb (lines), .svg .png (a picture), or - for the standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The output's format [default: by its name]
    #[arg(long, value_name = "FORMAT")]
    to: Option<Kind>,
    /// Statistics as JSON on the standard output
    #[arg(long)]
    json: bool,
    /// Edges to take from a mesh [default: lines if the file has any, else triangles]
    #[arg(long)]
    edges: Option<EdgeChoice>,
    /// GeoJSON: take positions as degrees and metres on WGS 84; coordinates are earth-centred metres
    #[arg(long)]
    ecef: bool,
    /// The algorithm
    #[arg(long, default_value = "vw")]
    algorithm: Algorithm,
    /// What its decisions are computed with
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
    /// Single: coordinates are rounded to it before they are clipped
    F32,
    /// Double
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
    let (name, format) = (input.name().display().to_string(), input.format.name());
    let threads = args.threads.map_or_else(crate::cores, usize::from);
    let source = threads_of(threads)?.install(|| args.source(input))?;
    let view = args.view.view(|| source.bounds())?;
    let accuracy = args.accuracy.unwrap_or(Accuracy::Fast);
    let run = Run {
        engine: Engine::<T>::new(args.algorithm, args.arithmetic, accuracy),
        output: output::Format::new(kind, &view.frustum, || args.canvas(&source, &view.frustum))?,
        threads,
        source: &source,
        frustum: &view.frustum,
    };
    let mut writer = Writer::create(kind, &run.output, args.output.as_deref())?;
    let mut times = Times {
        read: start.elapsed(),
        ..Times::default()
    };
    let counts = run.clip(&mut writer, &mut times)?;
    let finish = Instant::now();
    let title = format!("{name}   {}", view.flags);
    writer.finish(&title, &counts.classes)?;
    times.write += finish.elapsed();
    times.total = start.elapsed();
    let (arithmetic, accuracy) = run.engine.arithmetic();
    args.tell(&Report {
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
        Source::open(input, self.edges, positions)
    }

    fn canvas(&self, source: &Source, frustum: &Frustum) -> Result<Canvas, Failure> {
        let options = self.pictures.options();
        let scene = match options.view {
            View::Outside if !source.is_piped() => Some(source.bounds()?),
            _ => None,
        };
        Canvas::new(options, frustum, scene.as_ref())
    }

    /// The statistics; on the error stream where the output takes the other.
    fn tell(&self, report: &Report<'_>) -> Result<(), Failure> {
        let text = if self.json {
            format!("{:#}\n", report.to_json())
        } else {
            report.to_table()
        };
        if self.output.as_deref().is_some_and(is_stream) {
            say(&text);
            return Ok(());
        }
        print(&text)
    }
}

/// The threads that read a mesh.
fn threads_of(count: usize) -> Result<rayon::ThreadPool, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    pool.map_err(|e| Failure::new(format_args!("threads: {e}")))
}

/// The end of `-h`.
const HELP_END: &str = "More with --help: formats, examples, exit codes.";

/// The end of `--help`, but for the exit codes.
const FORMATS: &str = "\
Input
  .glb .gltf  The default scene's line (mode 1 to 3) or triangle (mode 4 to 6) primitives through
              all node transforms, composed in double precision. Sparse accessors, quantized
              positions, data URIs and buffer files work; skins and morph targets are not applied.
  .obj        v, l and f. A polygon counts as its outline.
  .csv        x0,y0,z0,x1,y1,z1, decimal or hexadecimal (0x1.8p-3); read as a stream. With a header
              the columns are found by name among others. Lines that begin with # are comments.
  With --edges triangles each edge of a mesh comes once, wherever its vertices are split.
  A coordinate that is infinite or NaN is an error.

Output, whole or not at all
  .csv  index,class,t0,t1,x0,y0,z0,x1,y1,z1,enter,leave,coplanar; a row a segment, in the input's
        order. class: outside, touch, boundary, inside or cross; t0..t1: the part's parameters;
        enter, leave, coplanar: faces joined by + (near far left right bottom top) whose planes
        contain the entry point, the exit point, the whole segment. Numbers read back to the same
        bits. For outside the fields after class are empty.
  .obj  two vertices and a line element for each part; a vertex and a point element for a touch.
  .svg .png  a picture; a PNG is the SVG, rasterised. --picture camera: what the camera sees, from
        the near rectangle's side, hidden lines included. --picture outside: the frustum and the
        scene around it from the frustum's right, behind and above, in parallel projection; a
        frustum much deeper than the scene is drawn open, as far as the scene goes. Up to 20,000
        strokes are drawn one by one. More are summed up by pixel: a place's tone is its rank
        among all others (histogram equalisation), clipped edges and cut points lie on top.

Statistics (a table, or --json), among others
  filter_failure_share  of the segments, how many had a sign that the floating-point filter left
        open, whichever later stage settled it, double-double included. stages has their number,
        and how many signs and values each later stage gave. Null for --arithmetic plain.
  not_inward  clipped points that are not proven inside: all, but for --accuracy inward.
  view.deviation  of a frustum from a matrix: by how much its vertices miss the matrix's exact clip
        volume; sides in X / W and Y / W, near and far as fractions of their distances.

Frustum files (--frustum); any number may be a text with a hexadecimal float
  {\"origin\":[0,0,0], \"axes\":[[1,0,0],[0,1,0],[0,0,1]],
   \"near\":{\"z\":-1,\"left\":-1,\"right\":1,\"bottom\":-1,\"top\":1}, \"far\":{...}}
  the same with \"slopes\":{\"left\":-1,\"right\":1,\"bottom\":-1,\"top\":1}, \"direction\":1 instead of
   \"far\": no far face; the sides' bounds change by the slopes for each unit of depth
  {\"eye\":[0,0,5], \"target\":[0,0,0], \"up\":[0,1,0], \"fovy_deg\":45 or \"ortho_height\":2,
   \"aspect\":1.5, \"near\":0.1, \"far\":100 or \"inf\"}
  {\"matrix\":[16 numbers], \"layout\":\"column-major\" or \"row-major\", \"depth\":\"0..1\" or \"-1..1\",
   \"reversed\":false, \"y\":\"up\" or \"down\", \"precision\":\"f64\" or \"f32\"}: view and projection,
   for column vectors; the last three keys may be left out

Examples
  frusta clip part.glb
      which edges a default camera takes in; prints the flags that give the same camera again
  frusta clip part.glb --up 0,-1,0 -o view.svg
      a picture, for a model whose y points downwards
  frusta clip part.glb --picture outside --theme dark -o frustum.png
      which edges the camera takes in, seen from outside
  frusta clip edges.csv --eye 0,0,5 --target 0,0,0 --near 1 --far inf -o clipped.csv
      every row's part in an infinite frustum
  frusta clip edges.csv --frustum view.json --accuracy inward --json
      statistics, with clipped points that are never outside, where any representable point near
      is inside; the rest are counted (not_inward)
";
