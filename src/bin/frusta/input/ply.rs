//! PLY, text and binary: `edge` elements as lines, `face` and `tristrips` as
//! triangles' (polygons') edges, each once.
//!
//! The `ply-rs-bw` crate reads header and elements. The header is cut out here
//! first, within a length, and elements are read one by one: what a header
//! claims is never allocated.

use super::edges::UniqueEdges;
use super::lines::{LONGEST, Lines};
use super::opened::{Input, Reader};
use super::scene::{Instance, Mesh};
use super::{EdgeChoice, Scene};
use crate::failure::{Failure, quote};
use frusta::Vec3;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult,
};
use std::io::{BufRead, Read};

/// What an error is about and the reason.
type Fault = (String, String);

/// Reads a file's edges.
pub(super) fn read(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    let fail = |(place, why): Fault| input.failure_at(place, why);
    let mut reader = input.open()?;
    let (header, lines) = header(&mut reader).map_err(fail)?;
    let has = |name: &str| header.elements.get(name).is_some_and(|e| e.count > 0);
    let kind = choice.unwrap_or(if has("edge") {
        EdgeChoice::Lines
    } else {
        EdgeChoice::Triangles
    });
    let mut content = Content {
        kind,
        ..Content::default()
    };
    let mut payload = match header.encoding {
        Encoding::Ascii => Payload::Text(Lines::new(reader), lines),
        Encoding::BinaryBigEndian => Payload::Binary(reader, true),
        Encoding::BinaryLittleEndian => Payload::Binary(reader, false),
    };
    for element in header.elements.values() {
        content.element(&mut payload, element).map_err(fail)?;
    }
    content.finish().map_err(fail)
}

/// The header and the number of its lines.
fn header(reader: &mut Reader) -> Result<(Header, u64), Fault> {
    let (mut text, mut lines) = (Vec::new(), 0);
    loop {
        lines += 1;
        let place = || format!("line {lines}");
        let start = text.len();
        let room = (LONGEST - start.min(LONGEST)) as u64 + 1;
        let read = reader.by_ref().take(room).read_until(b'\n', &mut text);
        let count = read.map_err(|e| (place(), e.to_string()))?;
        let line = text[start..].trim_ascii();
        if lines == 1 && line != b"ply" {
            return Err((place(), "not PLY: the first line must be ply".to_owned()));
        }
        if line == b"end_header" {
            break;
        }
        if count == 0 || text.len() > LONGEST {
            return Err((place(), "the header has no end_header".to_owned()));
        }
    }
    let text = cleaned(&text);
    let parsed = Parser::<Skipped>::new().read_ply_header(&mut &text[..]);
    let header = parsed.map_err(|e| {
        // The crate's own messages are a parser's; the line says more.
        let number = e.line().unwrap_or(1);
        let line = text.split(|&b| b == b'\n').nth(number - 1);
        let line = String::from_utf8_lossy(line.unwrap_or_default());
        let why = format!("{} makes no sense in the header", quote(&line));
        (format!("line {number}"), why)
    })?;
    Ok((header, lines))
}

/// A header with line feeds alone, as the crate wants it, and with a comment for
/// each line that is none of the format's: old writers forgot that word.
fn cleaned(text: &[u8]) -> Vec<u8> {
    let known = ["ply", "format", "element", "property", "end_header"].map(str::as_bytes);
    let mut out = Vec::with_capacity(text.len());
    for line in text.trim_ascii_end().split(|&b| b == b'\n') {
        let word = line.trim_ascii().split(u8::is_ascii_whitespace).next();
        if word.is_some_and(|word| known.contains(&word)) {
            out.extend(line.trim_ascii());
        } else {
            out.extend(b"comment");
        }
        out.push(b'\n');
    }
    out
}

/// What follows the header.
enum Payload {
    /// Lines, after so many of the header.
    Text(Lines<Reader>, u64),
    /// Bytes; whether the first is the highest.
    Binary(Reader, bool),
}

impl Payload {
    /// The next element.
    fn next<E: PropertyAccess>(&mut self, number: usize, def: &ElementDef) -> Result<E, Fault> {
        let parser = Parser::<E>::new();
        let place = || format!("{} {number}", def.name);
        match self {
            Self::Text(lines, before) => loop {
                let line = lines
                    .next()
                    .map_err(|(n, why)| (format!("line {}", *before + n), why))?;
                let Some((n, line)) = line else {
                    let why = format!("the file ends before it; the header says {}", def.count);
                    return Err((place(), why));
                };
                if line.is_empty() {
                    continue;
                }
                let at = || format!("line {}, {}", *before + n, place());
                let text = std::str::from_utf8(line).map_err(|_| (at(), "not UTF-8".to_owned()))?;
                return parser.read_ascii_element(text, def).map_err(|_| {
                    let why = format!("{} are not its numbers in the header's order", quote(text));
                    (at(), why)
                });
            },
            Self::Binary(reader, big) => {
                let read = if *big {
                    parser.read_big_endian_element(reader, def)
                } else {
                    parser.read_little_endian_element(reader, def)
                };
                read.map_err(|e| match e.kind() {
                    std::io::ErrorKind::UnexpectedEof => (
                        place(),
                        format!("the file ends inside it; the header says {}", def.count),
                    ),
                    _ => (place(), e.to_string()),
                })
            }
        }
    }
}

/// The edges and points so far.
struct Content {
    kind: EdgeChoice,
    points: Vec<Vec3<f64>>,
    lines: Vec<[u32; 2]>,
    faces: UniqueEdges,
    /// The greatest vertex that is asked for, and by what.
    greatest: Option<(u32, String)>,
}

impl Default for Content {
    fn default() -> Self {
        Self {
            kind: EdgeChoice::All,
            points: Vec::new(),
            lines: Vec::new(),
            faces: UniqueEdges::default(),
            greatest: None,
        }
    }
}

impl Content {
    fn element(&mut self, payload: &mut Payload, def: &ElementDef) -> Result<(), Fault> {
        let has = |name: &str| def.properties.get(name).is_some();
        let missing = |what: &str| Err((def.name.clone(), format!("it has no property {what}")));
        match def.name.as_str() {
            // Nothing to read, however many there are.
            _ if def.properties.is_empty() => return Ok(()),
            "vertex" => {
                if let Some(name) = ["x", "y", "z"].into_iter().find(|name| !has(name)) {
                    return missing(name);
                }
            }
            "edge" if self.kind.wants_lines() => {
                if let Some(name) = ["vertex1", "vertex2"].into_iter().find(|name| !has(name)) {
                    return missing(name);
                }
            }
            "face" | "tristrips" if self.kind.wants_faces() => {
                if !has("vertex_indices") && !has("vertex_index") {
                    return missing("vertex_indices");
                }
            }
            _ => {
                for number in 0..def.count {
                    payload.next::<Skipped>(number, def)?;
                }
                return Ok(());
            }
        }
        for number in 0..def.count {
            let row: Row = payload.next(number, def)?;
            let added = self.add(&def.name, number, &row);
            added.map_err(|why| (format!("{} {number}", def.name), why))?;
        }
        Ok(())
    }

    fn add(&mut self, name: &str, number: usize, row: &Row) -> Result<(), String> {
        match name {
            "vertex" => {
                let point = Vec3::from(row.point);
                if !point.is_finite() {
                    return Err("a coordinate is infinite or NaN".to_owned());
                }
                if self.points.len() >= u32::MAX as usize {
                    return Err("more than 4294967295 vertices".to_owned());
                }
                self.points.push(point);
            }
            "edge" => {
                let ends = self.vertices(&row.ends, name, number)?;
                self.lines.push([ends[0], ends[1]]);
            }
            "face" => {
                let corners = self.vertices(&row.list, name, number)?;
                if corners.len() < 3 {
                    return Err(format!(
                        "it has {} vertices; at least 3 make one",
                        corners.len()
                    ));
                }
                for (i, &a) in corners.iter().enumerate() {
                    self.faces.add(a, corners[(i + 1) % corners.len()]);
                }
            }
            // Triangle strips; -1 ends one.
            _ => {
                for strip in row.list.split(|&v| v == -1) {
                    let strip = self.vertices(strip, name, number)?;
                    for t in strip.windows(3) {
                        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                            self.faces.add(a, b);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn vertices(&mut self, indices: &[i64], name: &str, number: usize) -> Result<Vec<u32>, String> {
        let mut out = Vec::with_capacity(indices.len());
        for &index in indices {
            let index = u32::try_from(index).map_err(|_| format!("vertex {index}"))?;
            if self.greatest.as_ref().is_none_or(|(most, _)| index > *most) {
                self.greatest = Some((index, format!("{name} {number}")));
            }
            out.push(index);
        }
        Ok(out)
    }

    fn finish(self) -> Result<Scene, Fault> {
        let count = self.points.len();
        match self.greatest {
            Some((index, place)) if index as usize >= count => {
                return Err((
                    place,
                    format!("vertex {index} of {count}; they count from 0"),
                ));
            }
            _ => {}
        }
        let mut edges = self.lines;
        edges.extend(self.faces.finish(&self.points));
        let mesh = Mesh {
            points: self.points,
            edges,
        };
        Ok(Scene::new(vec![mesh], vec![Instance::PLAIN], self.kind))
    }
}

/// An element that matters.
struct Row {
    point: [f64; 3],
    ends: [i64; 2],
    list: Vec<i64>,
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self {
            point: [f64::NAN; 3],
            ends: [-1; 2],
            list: Vec::new(),
        }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let done = match name {
            "x" => number(&value).map(|v| self.point[0] = v),
            "y" => number(&value).map(|v| self.point[1] = v),
            "z" => number(&value).map(|v| self.point[2] = v),
            "vertex1" => integer(&value).map(|v| self.ends[0] = v),
            "vertex2" => integer(&value).map(|v| self.ends[1] = v),
            "vertex_indices" | "vertex_index" => integers(&value).map(|v| self.list = v),
            _ => return PropertyAccessResult::Ignored,
        };
        match done {
            Some(()) => PropertyAccessResult::Set,
            None => PropertyAccessResult::UnsupportedType,
        }
    }
}

/// An element that is passed over.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

fn number(value: &Property) -> Option<f64> {
    match *value {
        Property::Float(v) => Some(f64::from(v)),
        Property::Double(v) => Some(v),
        _ => integer(value).map(|v| v as f64),
    }
}

fn integer(value: &Property) -> Option<i64> {
    match *value {
        Property::Char(v) => Some(v.into()),
        Property::UChar(v) => Some(v.into()),
        Property::Short(v) => Some(v.into()),
        Property::UShort(v) => Some(v.into()),
        Property::Int(v) => Some(v.into()),
        Property::UInt(v) => Some(v.into()),
        _ => None,
    }
}

fn integers(value: &Property) -> Option<Vec<i64>> {
    fn wide<T: Copy + Into<i64>>(list: &[T]) -> Vec<i64> {
        list.iter().map(|&v| v.into()).collect()
    }
    match value {
        Property::ListChar(v) => Some(wide(v)),
        Property::ListUChar(v) => Some(wide(v)),
        Property::ListShort(v) => Some(wide(v)),
        Property::ListUShort(v) => Some(wide(v)),
        Property::ListInt(v) => Some(wide(v)),
        Property::ListUInt(v) => Some(wide(v)),
        _ => None,
    }
}
