//! PLY, text and binary: `edge` elements as lines, `face` and `tristrips` as
//! triangles' (polygons') edges, each once.
//!
//! The `ply-rs-bw` crate reads the header and binary elements, one by one: what a
//! header claims is never allocated. Texts are read here: the crate knows neither
//! `.5` nor `5.`, and ignores surplus words of a line.

mod header;

use super::edges::UniqueEdges;
use super::input::{Input, Reader};
use super::lines::Lines;
use super::scene::{Instance, Mesh};
use super::{Contents, EdgeChoice, Format, ReadOptions, Scene};
use crate::failure::{Failure, quote};
use crate::io::number;
use frusta::Vec3;
use header::Fault;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{
    ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

/// The names of a face's list of vertices.
const LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The format.
pub(super) struct Ply;

impl Format for Ply {
    fn name(&self) -> &'static str {
        "ply"
    }

    fn description(&self) -> &'static str {
        "PLY, text or binary"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["ply"]
    }

    fn is_mesh(&self) -> bool {
        true
    }

    fn open(&self, input: &Input, options: ReadOptions) -> Result<Contents, Failure> {
        read(input, options.edges).map(Contents::Scene)
    }
}

/// Reads a file's edges.
fn read(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    let fail = |(place, why): Fault| input.failure_at(place, why);
    let mut reader = input.open()?;
    let (header, lines) = header::read(&mut reader).map_err(fail)?;
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

/// What follows the header.
enum Payload {
    /// Lines, after this number of lines of the header.
    Text(Lines<Reader>, u64),
    /// Bytes; whether the first is the highest.
    Binary(Reader, bool),
}

impl Payload {
    /// The next element.
    fn next<E: Element>(&mut self, number: usize, def: &ElementDef) -> Result<E, Fault> {
        let place = || format!("{} {number}", def.name);
        match self {
            Self::Text(lines, before) => loop {
                let line = lines
                    .next()
                    .map_err(|(n, why)| (format!("line {}", *before + n), why))?;
                let Some((n, line)) = line else {
                    let why = format!("the file ends before it; the header gives {}", def.count);
                    return Err((place(), why));
                };
                if !line.is_empty() {
                    let at = |why| (format!("line {}, {}", *before + n, place()), why);
                    return element(&String::from_utf8_lossy(line), def).map_err(at);
                }
            },
            Self::Binary(reader, big) => {
                let parser = Parser::new();
                let read = if *big {
                    parser.read_big_endian_element(reader, def)
                } else {
                    parser.read_little_endian_element(reader, def)
                };
                read.map_err(|e| match e.kind() {
                    std::io::ErrorKind::UnexpectedEof => (
                        place(),
                        format!("the file ends inside it; the header gives {}", def.count),
                    ),
                    _ => (place(), e.to_string()),
                })
            }
        }
    }
}

/// A line's element.
fn element<E: Element>(line: &str, def: &ElementDef) -> Result<E, String> {
    let mut words = line.split_ascii_whitespace();
    let mut element = E::new();
    for (name, property) in &def.properties {
        let mut word = || words.next().ok_or("the line ends before it");
        let mut read = || match &property.data_type {
            PropertyType::Scalar(kind) => Ok(element.set_property(name, scalar(word()?, kind)?)),
            PropertyType::List(_, kind) => {
                // In a text the length's type limits nothing.
                let length = word()?;
                let length: u64 = length
                    .parse()
                    .map_err(|_| format!("{} is not a length", quote(length)))?;
                let mut list = Vec::new();
                for _ in 0..length {
                    list.push(scalar(word()?, kind)?);
                }
                Ok(element.set_list(name, &list))
            }
        };
        let result = read().map_err(|why: String| format!("{name}: {why}"))?;
        if result == PropertyAccessResult::UnsupportedType {
            return Err(format!("{name}: the header gives it a wrong type"));
        }
    }
    match words.next() {
        Some(word) => Err(format!(
            "{} after the numbers that the header lists",
            quote(word)
        )),
        None => Ok(element),
    }
}

/// A word as a number of a type.
fn scalar(word: &str, kind: &ScalarType) -> Result<Property, String> {
    let fail = || {
        format!(
            "{} is not of type {}",
            quote(word),
            format!("{kind:?}").to_lowercase()
        )
    };
    Ok(match kind {
        ScalarType::Char => Property::Char(word.parse().map_err(|_| fail())?),
        ScalarType::UChar => Property::UChar(word.parse().map_err(|_| fail())?),
        ScalarType::Short => Property::Short(word.parse().map_err(|_| fail())?),
        ScalarType::UShort => Property::UShort(word.parse().map_err(|_| fail())?),
        ScalarType::Int => Property::Int(word.parse().map_err(|_| fail())?),
        ScalarType::UInt => Property::UInt(word.parse().map_err(|_| fail())?),
        ScalarType::Float => Property::Float(number::parse(word)?),
        ScalarType::Double => Property::Double(number::parse(word)?),
    })
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
                if !LISTS.iter().any(|name| has(name)) {
                    return missing(LISTS[0]);
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
            "x" => real(&value).map(|v| self.point[0] = v),
            "y" => real(&value).map(|v| self.point[1] = v),
            "z" => real(&value).map(|v| self.point[2] = v),
            "vertex1" => integer(&value).map(|v| self.ends[0] = v),
            "vertex2" => integer(&value).map(|v| self.ends[1] = v),
            _ if LISTS.contains(&name) => integers(&value).map(|v| self.list = v),
            _ => return PropertyAccessResult::Ignored,
        };
        match done {
            Some(()) => PropertyAccessResult::Set,
            None => PropertyAccessResult::UnsupportedType,
        }
    }
}

/// An element that is read from a text, too.
trait Element: PropertyAccess {
    /// For a list in a text, as the crate sets one of a binary file.
    fn set_list(&mut self, name: &str, list: &[Property]) -> PropertyAccessResult;
}

impl Element for Row {
    fn set_list(&mut self, name: &str, list: &[Property]) -> PropertyAccessResult {
        if !LISTS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        match list.iter().map(integer).collect() {
            Some(list) => {
                self.list = list;
                PropertyAccessResult::Set
            }
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

impl Element for Skipped {
    fn set_list(&mut self, _: &str, _: &[Property]) -> PropertyAccessResult {
        PropertyAccessResult::Ignored
    }
}

fn real(value: &Property) -> Option<f64> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::corruption;

    fn segments(input: &Input) -> Result<Vec<frusta::Segment<f64>>, Failure> {
        read(input, Some(EdgeChoice::All)).map(|scene| scene.segments())
    }

    fn message(text: &str) -> String {
        let input = Input::from_bytes("a.ply", text.as_bytes(), false).unwrap();
        segments(&input).unwrap_err().to_string()
    }

    #[test]
    fn texts_are_read_word_by_word() {
        let head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n\
                    property list uchar float weights\nproperty double y\nproperty int z\n\
                    element edge 1\nproperty uchar vertex1\nproperty uint vertex2\nend_header\n";
        let body = "\t.5 0  1. +3\n0x1p-3 2 nan 1e9 -1e-2 -4\n0 1\n";
        let text = format!("{head}{body}");
        let found = segments(&Input::from_bytes("a.ply", text.as_bytes(), false).unwrap()).unwrap();
        let expected = frusta::Segment::new([0.5, 1.0, 3.0], [0.125, -0.01, -4.0]);
        assert_eq!(found, [expected]);
        for (old, new, why) in [
            (
                "+3",
                "3 7",
                "line 12, vertex 0: \"7\" after the numbers that the header lists",
            ),
            ("+3", "", "line 12, vertex 0: z: the line ends before it"),
            (
                "+3",
                "3.0",
                "line 12, vertex 0: z: \"3.0\" is not of type int",
            ),
            (".5", "inf", "vertex 0: a coordinate is infinite or NaN"),
            (".5", "1e39", "vertex 0: a coordinate is infinite or NaN"),
            (
                "2 nan",
                "-2 nan",
                "line 13, vertex 1: weights: \"-2\" is not a length",
            ),
            (
                "0 1\n",
                "0 256\n",
                "edge 0: vertex 256 of 2; they count from 0",
            ),
            (
                "0 1\n",
                "256 1\n",
                "line 14, edge 0: vertex1: \"256\" is not of type uchar",
            ),
        ] {
            let text = format!("{head}{}", body.replacen(old, new, 1));
            assert_eq!(message(&text), format!("a.ply: {why}"));
        }
    }

    /// A binary file; whether the first byte is the highest.
    fn binary(big: bool) -> Vec<u8> {
        let format = if big { "big" } else { "little" };
        let mut bytes = format!(
            "ply\nformat binary_{format}_endian 1.0\nelement vertex 4\nproperty float x\n\
             property double y\nproperty short z\nelement face 2\n\
             property list ushort uint vertex_indices\nproperty list char char more\nend_header\n"
        )
        .into_bytes();
        let mut put = |value: &[u8]| {
            let start = bytes.len();
            bytes.extend(value);
            if big {
                bytes[start..].reverse();
            }
        };
        for i in 0..4_u8 {
            put(&f32::from(i).to_le_bytes());
            put(&f64::from(i * i).to_le_bytes());
            put(&i16::from(i % 2).to_le_bytes());
        }
        for face in [&[0_u32, 1, 2][..], &[3, 2, 1, 0]] {
            put(&(face.len() as u16).to_le_bytes());
            for index in face {
                put(&index.to_le_bytes());
            }
            put(&[1]);
            put(&[255]);
        }
        bytes
    }

    #[test]
    fn corrupted_files_are_read_or_refused_and_never_panic() {
        let text = b"ply\r\nformat ascii 1.0\r\ncomment c\r\nobj_info i\r\nold and odd\r\n\
            element vertex 5\r\nproperty float x\r\nproperty double y\r\nproperty int z\r\n\
            property uchar red\r\nelement other 2\r\nproperty list uchar float x\r\n\
            element face 2\r\nproperty uchar flag\r\nproperty list uchar int vertex_indices\r\n\
            element edge 2\r\nproperty int vertex1\r\nproperty short vertex2\r\n\
            element tristrips 1\r\nproperty list int int vertex_index\r\nend_header\r\n\
            0 0 0 255\r\n1.5 0 1 0\r\n1e1 .25 2 1\r\n0 7. 3 2\r\n\r\n9 9 9 9\r\n2 1.5 2.5\r\n\
            0\r\n1 3 0 1 2\r\n0 4 1 2 3 4\r\n0 4\r\n4 3\r\n7 0 1 2 -1 2 3 4\r\n"
            .to_vec();
        assert_eq!(
            segments(&Input::from_bytes("a.ply", &text, false).unwrap())
                .unwrap()
                .len(),
            2 + 7
        );
        let samples = [text, binary(false), binary(true)];
        corruption::check("a.ply", &samples, 30_000, segments);
    }
}
