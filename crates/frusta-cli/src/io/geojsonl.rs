//! Sequences of GeoJSON texts, one a line or with record separators: each is read as
//! `geojson.rs` reads a document, so that memory is that of the largest text.

use super::geojson::{Walk, not_geojson};
use super::{Contents, Format, Input, Positions, ReadOptions, Stream, Take};
use crate::Failure;
use geojson::GeoJson;
use std::io::Read;

/// The format.
pub(super) struct Geojsonl;

impl Format for Geojsonl {
    fn name(&self) -> &'static str {
        "geojsonl"
    }

    fn description(&self) -> &'static str {
        "A GeoJSON text a line"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["geojsonl", "geojsons", "geojsonseq", "ndjson"]
    }

    fn is_geographic(&self) -> bool {
        true
    }

    fn open(&self, input: &Input, options: ReadOptions) -> Result<Contents, Failure> {
        let read =
            move |input: &Input, take: &mut Take<'_>| sequence(input, options.positions, take);
        Ok(Contents::Stream(Stream::new(input, None, read)))
    }
}

/// Reads a sequence.
fn sequence(input: &Input, positions: Positions, take: &mut Take<'_>) -> Result<(), Failure> {
    let mut walk = Walk::new(positions, take);
    let reader = Separated(input.open()?);
    for json in serde_json::Deserializer::from_reader(reader).into_iter::<GeoJson>() {
        let index = walk.feature;
        let fail = |e| input.failure_at(format_args!("feature {index}"), e);
        let json = json.map_err(|e| fail(not_geojson(&e)))?;
        let walked = walk.json(&json);
        walk.settle(walked, |why| input.failure(why))?;
    }
    Ok(())
}

/// A sequence as RFC 8142 defines it, with a record separator before each text, which
/// becomes white space; a JSON text cannot contain one.
struct Separated<R>(R);

impl<R: Read> Read for Separated<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.0.read(buffer)?;
        for byte in &mut buffer[..count] {
            if *byte == 0x1e {
                *byte = b' ';
            }
        }
        Ok(count)
    }
}
