//! The fuzz targets of the command's readers; each asserts.
//!
//! The bytes are a file, whole. Whatever they are, they are read, or refused in one short
//! line, as a file and as a pipe, in memory in proportion to their number; libFuzzer itself
//! watches the time.

use crate::meter::in_proportion;
use frusta::Segment;
use frusta_cli::Failure;
use frusta_cli::io::{Contents, EdgeChoice, Input, Positions, ReadOptions, frustum_file, open};
use std::path::Path;

/// The greatest length of a message, in bytes.
const LONGEST_MESSAGE: usize = 400;

/// A message is one line, not too long, that begins with the file's name.
fn check_message(failure: &Failure, name: &str) {
    let message = failure.to_string();
    assert!(message.starts_with(&format!("{name}: ")), "{message}");
    assert!(!message.contains(char::is_control), "{message:?}");
    assert!(message.len() <= LONGEST_MESSAGE, "{message}");
}

/// Counts segments; the readers push them one by one.
#[derive(Default)]
struct Count {
    segments: u64,
    /// Number of segments with a coordinate that is infinite or NaN.
    not_finite: u64,
}

impl Count {
    fn add(&mut self, segment: Segment<f64>) -> Result<(), Failure> {
        self.segments += 1;
        self.not_finite += u64::from(segment.check_finite().is_err());
        Ok(())
    }
}

/// The bytes as a file of that name, or as a pipe; targets use known extensions.
fn input(name: &str, bytes: &[u8], piped: bool) -> Input {
    Input::from_bytes(name, bytes, piped).expect("the extension is known")
}

/// Reads bytes as a file of that name, and as a pipe. A file that is read gives
/// finite segments, no more of them than it has bytes.
fn read(name: &str, bytes: &[u8], options: ReadOptions) {
    for piped in [false, true] {
        let input = input(name, bytes, piped);
        let mut count = Count::default();
        let done = in_proportion(bytes.len(), || read_all(&input, options, &mut count));
        match done {
            Ok(()) => {
                // glTF's nodes may repeat meshes, and move points beyond the range of `f64`,
                // which is found when they are clipped.
                if name != "a.gltf" {
                    assert_eq!(count.not_finite, 0, "{name}");
                    assert!(count.segments <= bytes.len() as u64, "{name}");
                }
            }
            Err(failure) => check_message(&failure, name),
        }
    }
}

/// Opens a file and counts all its segments.
fn read_all(input: &Input, options: ReadOptions, count: &mut Count) -> Result<(), Failure> {
    match open(input, options)? {
        Contents::Stream(stream) => stream.read(&mut |segment| count.add(segment)),
        Contents::Scene(scene) => {
            let mut chunk = Vec::<Segment<f64>>::new();
            for first in (0..scene.len()).step_by(4096) {
                chunk.clear();
                scene.fill(first, 4096, &mut chunk);
                chunk.iter().try_for_each(|&segment| count.add(segment))?;
            }
            assert_eq!(count.segments, scene.len());
            if count.not_finite == 0 {
                let bounds = scene.bounds();
                assert!(!bounds.is_empty() && bounds.low.is_finite() && bounds.high.is_finite());
            }
            Ok(())
        }
        Contents::Rows(rows) => {
            let mut doubles = Vec::<Segment<f64>>::new();
            let mut singles = Vec::<Segment<f32>>::new();
            rows.blocks(|block| {
                doubles.clear();
                singles.clear();
                let fail =
                    |(line, why)| Failure::at(input.name(), format_args!("line {line}"), why);
                // What is too large for `f32` may be an `f64`.
                match (block.parse(&mut doubles), block.parse(&mut singles)) {
                    (Err(e), Ok(())) => panic!("f32, but no f64: {e:?}"),
                    (Err(e), Err(_)) => return Err(fail(e)),
                    (Ok(()), Err(e)) => check_message(&fail(e), "a.csv"),
                    (Ok(()), Ok(())) => assert_eq!(singles.len(), doubles.len()),
                }
                assert_eq!(block.rows(), doubles.len() as u64);
                assert!(singles.iter().all(|s| s.check_finite().is_ok()));
                doubles.iter().try_for_each(|&segment| count.add(segment))
            })
        }
    }
}

/// Reads the edges of a mesh file, all of them or some.
fn read_edges(name: &str, bytes: &[u8]) {
    for edges in [None, Some(EdgeChoice::All)] {
        let options = ReadOptions {
            edges,
            ..ReadOptions::default()
        };
        read(name, bytes, options);
    }
}

/// OBJ, STL and PLY: three readers, each of which recognises its own files.
pub fn read_mesh(bytes: &[u8]) {
    for name in ["a.obj", "a.stl", "a.ply"] {
        read_edges(name, bytes);
    }
    let lines = ReadOptions {
        edges: Some(EdgeChoice::Lines),
        ..ReadOptions::default()
    };
    read("a.obj", bytes, lines);
    // Lines are the same in a scene and in a stream.
    let input = input("a.obj", bytes, false);
    if let Ok(Contents::Scene(scene)) = open(&input, ReadOptions::default())
        && scene.kind() == EdgeChoice::Lines
    {
        let mut streamed = Count::default();
        let done = read_all(&input, lines, &mut streamed);
        assert_eq!(done, Ok(()), "a scene, but no stream");
        assert_eq!(streamed.segments, scene.len());
    }
}

/// glTF, text or binary.
pub fn read_gltf(bytes: &[u8]) {
    read_edges("a.gltf", bytes);
}

/// GeoJSON, a document or a sequence of texts.
pub fn read_geojson(bytes: &[u8]) {
    for positions in [Positions::AsGiven, Positions::Ecef] {
        let options = ReadOptions {
            positions,
            ..ReadOptions::default()
        };
        read("a.geojson", bytes, options);
        read("a.ndjson", bytes, options);
    }
}

/// Rows, in both precisions.
pub fn read_csv(bytes: &[u8]) {
    read("a.csv", bytes, ReadOptions::default());
}

/// Frusta in JSON. A frustum that is read is finite, and clips.
pub fn read_frustum(bytes: &[u8]) {
    let file = Path::new("a.json");
    let read = in_proportion(bytes.len(), || frustum_file::from_text(file, bytes));
    match read {
        Ok((frustum, deviation)) => {
            let pose = frustum.pose();
            assert!(pose.origin.is_finite() && pose.axes.iter().all(|a| a.is_finite()));
            if let Some(d) = deviation {
                assert!(d.sides >= 0.0 && d.near >= 0.0 && d.far >= 0.0, "{d:?}");
            }
            let whole = Segment::new(pose.origin, pose.origin + pose.axes[2]);
            if whole.check_finite().is_ok() {
                assert!(frustum.clip_segment(&whole).is_ok());
            }
        }
        Err(failure) => check_message(&failure, "a.json"),
    }
}
