//! What the fuzz targets of the command's readers do with their bytes; each
//! asserts.
//!
//! The readers are part of the command and not of the library, so their files are
//! compiled here by path, in a crate whose root stands for the command's. The
//! bytes are a file, whole. Whatever it is, it is read or refused in one short
//! line, as a file and as a pipe, in memory that is in proportion to it; libFuzzer
//! itself minds the time.

#![cfg(fuzzing)]
#![allow(
    dead_code,
    unused_imports,
    reason = "the command uses more of these files"
)]

#[path = "../../../src/bin/frusta/failure.rs"]
mod failure;
#[path = "../../../src/bin/frusta/frustum_file.rs"]
mod frustum_file;
#[path = "../../../src/bin/frusta/input/mod.rs"]
mod input;
mod meter;
#[path = "../../../src/bin/frusta/number.rs"]
mod number;
#[path = "../../../src/bin/frusta/view.rs"]
mod view;

use failure::Failure;
use frusta::Segment;
use input::damaged::check_message;
use input::geojson::{self, Positions};
use input::{EdgeChoice, Input, csv, obj, read_scene};
use meter::in_proportion;
use std::path::Path;

/// What counts segments; the readers push them one by one.
#[derive(Default)]
struct Count {
    segments: u64,
    /// How many have a coordinate that is infinite or NaN.
    not_finite: u64,
}

impl Count {
    fn add(&mut self, segment: Segment<f64>) -> Result<(), Failure> {
        self.segments += 1;
        self.not_finite += u64::from(segment.check_finite().is_err());
        Ok(())
    }
}

/// Reads bytes as a file of that name, and as a pipe. A file that is read gives
/// finite segments, no more than it has bytes.
fn read(name: &str, bytes: &[u8], reader: impl Fn(&Input, &mut Count) -> Result<(), Failure>) {
    for piped in [false, true] {
        let input = Input::of_bytes(name, bytes, piped);
        let mut count = Count::default();
        let done = in_proportion(bytes.len(), || reader(&input, &mut count));
        match done {
            Ok(()) => {
                assert_eq!(count.not_finite, 0, "{name}");
                assert!(count.segments <= bytes.len() as u64, "{name}");
            }
            Err(failure) => check_message(&failure, name),
        }
    }
}

/// Reads a mesh file's edges, all of them or some.
fn mesh(input: &Input, choice: Option<EdgeChoice>, count: &mut Count) -> Result<(), Failure> {
    let scene = read_scene(input, choice)?;
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

/// OBJ, STL and PLY: three readers, each of which knows its own files.
pub fn read_mesh(bytes: &[u8]) {
    for name in ["a.obj", "a.stl", "a.ply"] {
        for choice in [None, Some(EdgeChoice::All)] {
            read(name, bytes, |input, count| mesh(input, choice, count));
        }
    }
    read("a.obj", bytes, |input, count| {
        obj::lines(input, &mut |segment| count.add(segment))
    });
    let lines = Some(EdgeChoice::Lines);
    let input = Input::of_bytes("a.obj", bytes, false);
    let (mut whole, mut streamed) = (Count::default(), Count::default());
    if mesh(&input, lines, &mut whole).is_ok() {
        let done = obj::lines(&input, &mut |segment| streamed.add(segment));
        assert_eq!(done, Ok(()), "a scene, but no stream");
        assert_eq!(streamed.segments, whole.segments);
    }
}

/// glTF, text or binary. Nodes may repeat meshes and carry their points beyond all
/// numbers, which is found out when they are clipped.
pub fn read_gltf(bytes: &[u8]) {
    for choice in [None, Some(EdgeChoice::All)] {
        read("a.gltf", bytes, |input, _| {
            mesh(input, choice, &mut Count::default())
        });
    }
}

/// GeoJSON, a document or a sequence of texts.
pub fn read_geojson(bytes: &[u8]) {
    for positions in [Positions::AsGiven, Positions::Ecef] {
        read("a.geojson", bytes, |input, count| {
            geojson::document(input, positions, &mut |segment| count.add(segment))
        });
        read("a.ndjson", bytes, |input, count| {
            geojson::sequence(input, positions, &mut |segment| count.add(segment))
        });
    }
}

/// Rows, in both precisions.
pub fn read_csv(bytes: &[u8]) {
    read("a.csv", bytes, |input, count| {
        let mut doubles = Vec::<Segment<f64>>::new();
        let mut singles = Vec::<Segment<f32>>::new();
        csv::blocks(input, |block| {
            doubles.clear();
            singles.clear();
            let fail = |(line, why)| Failure::at(input.name(), format_args!("line {line}"), why);
            // What is too large for a single may be a double.
            match (block.parse(&mut doubles), block.parse(&mut singles)) {
                (Err(e), Ok(())) => panic!("singles, but no doubles: {e:?}"),
                (Err(e), Err(_)) => return Err(fail(e)),
                (Ok(()), Err(e)) => check_message(&fail(e), "a.csv"),
                (Ok(()), Ok(())) => assert_eq!(singles.len(), doubles.len()),
            }
            assert_eq!(block.rows(), doubles.len() as u64);
            assert!(singles.iter().all(|s| s.check_finite().is_ok()));
            doubles.iter().try_for_each(|&segment| count.add(segment))
        })
    });
}

/// A frustum's JSON. What comes of it is finite, and clips.
pub fn read_frustum(bytes: &[u8]) {
    let file = Path::new("a.json");
    let found = in_proportion(bytes.len(), || frustum_file::from_text(file, bytes));
    match found {
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
