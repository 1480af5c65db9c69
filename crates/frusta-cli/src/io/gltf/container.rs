//! The document and the binary chunk of a file, text or binary.

use crate::failure::{Failure, shorten};
use crate::io::stl;
use gltf::json;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

/// The JSON of a file.
pub(super) struct Document {
    pub(super) root: json::Root,
    /// The JSON's text, for what `root` holds in too low a precision.
    pub(super) text: Vec<u8>,
}

/// Reads a file, of which there are `size` bytes, if that is known.
pub(super) fn read(
    file: &Path,
    mut reader: impl BufRead,
    size: Option<u64>,
) -> Result<(Document, Option<Vec<u8>>), Failure> {
    let start = reader.fill_buf().map_err(|e| Failure::in_file(file, e))?;
    if start.starts_with(b"glTF") {
        glb(file, &mut reader, size)
    } else if start.trim_ascii_start().starts_with(b"{") {
        let document = document(reader, size).map_err(|e| not_gltf(file, "", &e))?;
        Ok((document, None))
    } else {
        let why = "not glTF: it begins neither with glTF nor with {";
        Err(Failure::in_file(file, why))
    }
}

/// JSON up to this length is parsed from memory, which is faster.
const SHORT: u64 = 1 << 26;

/// Parses JSON. A long one is parsed while it is read: it could be anything, and the first
/// error ends the reading.
fn document(mut reader: impl BufRead, size: Option<u64>) -> Result<Document, json::Error> {
    let mut text = Vec::new();
    if size.is_none_or(|size| size > SHORT) {
        let kept = Kept {
            reader,
            text: &mut text,
        };
        let root = json::deserialize::from_reader(BufReader::new(kept))?;
        return Ok(Document { root, text });
    }
    match reader.read_to_end(&mut text) {
        Ok(_) => Ok(Document {
            root: json::deserialize::from_slice(&text)?,
            text,
        }),
        Err(e) => Err(json::Error::io(e)),
    }
}

/// Keeps what is read.
struct Kept<'a, R> {
    reader: R,
    text: &'a mut Vec<u8>,
}

impl<R: Read> Read for Kept<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.reader.read(buffer)?;
        self.text.extend_from_slice(&buffer[..count]);
        Ok(count)
    }
}

fn not_gltf(file: &Path, chunk: &str, why: &json::Error) -> Failure {
    Failure::in_file(file, format_args!("not glTF: at {chunk}{}", shorten(why)))
}

/// The document and the binary chunk, if there is one, of a GLB file. Errors of the
/// container name the byte.
fn glb(
    file: &Path,
    reader: &mut impl BufRead,
    size: Option<u64>,
) -> Result<(Document, Option<Vec<u8>>), Failure> {
    let fail = |byte: u64, why: String| Failure::at(file, format_args!("byte {byte}"), why);
    let mut header = [0; 12];
    fill_all(reader, &mut header, 0).map_err(|(at, why)| fail(at, why))?;
    let [_, version, total] = words(&header);
    if version != 2 {
        return Err(fail(4, format!("GLB version {version}; expected 2")));
    }
    let total = u64::from(total);
    if let Some(have) = size.filter(|&have| have < total) {
        let why = format!("the header gives {total} bytes; the file has {have}");
        return Err(fail(8, why));
    }
    let length = chunk(reader, 12, total, b"JSON").map_err(|(at, why)| fail(at, why))?;
    let document = document(reader.take(length), Some(length))
        .map_err(|e| not_gltf(file, "the JSON chunk's ", &e))?;
    let at = 20 + length;
    if at + 8 > total {
        return Ok((document, None));
    }
    let length = chunk(reader, at, total, b"BIN\0").map_err(|(at, why)| fail(at, why))?;
    let mut blob = Vec::new();
    let read = reader.take(length).read_to_end(&mut blob);
    let have = read.map_err(|e| fail(at, e.to_string()))? as u64;
    if have < length {
        let why = format!("the BIN chunk gives {length} bytes; {have} are left");
        return Err(fail(at, why));
    }
    Ok((document, Some(blob)))
}

/// The length of the chunk that begins at a byte, which must be of a kind.
fn chunk(
    reader: &mut impl Read,
    at: u64,
    total: u64,
    kind: &[u8; 4],
) -> Result<u64, (u64, String)> {
    let mut header = [0; 8];
    fill_all(reader, &mut header, at)?;
    let [length, found] = words(&header);
    let name = String::from_utf8_lossy(&kind[..3 + usize::from(kind[3] != 0)]);
    if found != u32::from_le_bytes(*kind) {
        return Err((at + 4, format!("expected a {name} chunk")));
    }
    let (length, left) = (u64::from(length), total.saturating_sub(at + 8));
    if length > left {
        let why = format!("the {name} chunk gives {length} bytes; {left} are left");
        return Err((at, why));
    }
    Ok(length)
}

/// Little-endian words.
fn words<const N: usize>(bytes: &[u8]) -> [u32; N] {
    std::array::from_fn(|i| {
        let four = bytes.get(4 * i..).and_then(|rest| rest.first_chunk());
        u32::from_le_bytes(four.copied().unwrap_or_default())
    })
}

/// Fills a header that begins at a byte.
fn fill_all(reader: &mut impl Read, header: &mut [u8], at: u64) -> Result<(), (u64, String)> {
    let have = stl::fill(reader, header).map_err(|why| (at, why))?;
    if have < header.len() {
        // The word that is torn.
        let word = at + have as u64 / 4 * 4;
        return Err((word, "the file ends inside a header".to_owned()));
    }
    Ok(())
}
