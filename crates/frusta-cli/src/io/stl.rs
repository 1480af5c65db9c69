//! STL, binary and text: the edges of triangles, each once.
//!
//! Not through `stl_io`: it takes a binary file whose header begins with "solid "
//! for a text, and many do; it ends at a text's first `endsolid`; and its errors
//! have no line. The length decides whether a file is binary: a binary one has 84
//! bytes and 50 for each triangle. Coordinates of texts are read as `f64`, and text word by
//! word. Normals and attributes are passed over.

use super::edges::{PointSet, UniqueEdges};
use super::input::{Input, MARK};
use super::lines::{LineError, Lines};
use super::scene::{Instance, Mesh};
use super::{Contents, EdgeChoice, Format, ReadOptions, Scene};
use crate::failure::{Failure, quote};
use crate::io::number;
use frusta::Vec3;
use std::io::{BufRead, Read};
use std::str::SplitAsciiWhitespace;

/// Bytes before the triangles, and of each.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// The format.
pub(super) struct Stl;

impl Format for Stl {
    fn name(&self) -> &'static str {
        "stl"
    }

    fn description(&self) -> &'static str {
        "STL, text or binary"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["stl"]
    }

    fn is_mesh(&self) -> bool {
        true
    }

    /// A binary file may begin with any bytes.
    fn begins_as_text(&self) -> bool {
        false
    }

    fn open(&self, input: &Input, options: ReadOptions) -> Result<Contents, Failure> {
        read(input, options.edges).map(Contents::Scene)
    }
}

/// Reads a file's edges.
fn read(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    let kind = choice.unwrap_or(EdgeChoice::Triangles);
    let mut reader = input.open()?;
    let start = reader.fill_buf().map_err(|e| input.failure(e))?;
    let mut mesh = Triangles::default();
    if kind.wants_faces() {
        if is_text(start, input.size()) {
            let mark = start.starts_with(MARK);
            reader.consume(if mark { MARK.len() } else { 0 });
            let read = mesh.read_text(&mut Lines::new(reader));
            read.map_err(|e| input.failure_in_line(e))?;
        } else {
            mesh.read_binary(&mut reader, input.size())
                .map_err(|(byte, why)| input.failure_at(format_args!("byte {byte}"), why))?;
        }
    }
    let mesh = Mesh {
        edges: mesh.edges.finish_set(),
        points: mesh.points.finish(),
    };
    Ok(Scene::new(vec![mesh], vec![Instance::PLAIN], kind))
}

/// Whether a file is a text: it begins like one, and its length is not that of a
/// binary one. The length of a pipe is unknown; there a beginning without a
/// zero byte must do: binary ones have one in their count below 2^24 triangles, and
/// in attributes beyond.
fn is_text(start: &[u8], size: Option<u64>) -> bool {
    let text = start.strip_prefix(MARK).unwrap_or(start);
    let text = text.trim_ascii_start();
    if !text
        .get(..5)
        .is_some_and(|w| w.eq_ignore_ascii_case(b"solid"))
    {
        return false;
    }
    match (size, count(start)) {
        (Some(size), Some(count)) => size != HEADER as u64 + u64::from(count) * TRIANGLE as u64,
        (Some(_), None) => true,
        (None, _) => !start.contains(&0),
    }
}

/// The number of triangles in a binary file's header.
fn count(start: &[u8]) -> Option<u32> {
    let bytes = start.get(HEADER - 4..)?.first_chunk()?;
    Some(u32::from_le_bytes(*bytes))
}

#[derive(Default)]
struct Triangles {
    points: PointSet,
    edges: UniqueEdges,
}

impl Triangles {
    fn add(&mut self, [a, b, c]: [Vec3<f64>; 3]) -> Result<(), String> {
        let [a, b, c] = [
            self.points.index(a)?,
            self.points.index(b)?,
            self.points.index(c)?,
        ];
        for (from, to) in [(a, b), (b, c), (c, a)] {
            self.edges.add(from, to);
        }
        Ok(())
    }

    /// Errors come with their byte.
    fn read_binary(
        &mut self,
        reader: &mut impl Read,
        size: Option<u64>,
    ) -> Result<(), (u64, String)> {
        let mut header = [0; HEADER];
        let have = fill(reader, &mut header).map_err(|e| (0, e))?;
        let count = match count(&header) {
            Some(count) if have == HEADER => u64::from(count),
            _ => {
                let why = format!("the file ends inside the header of {HEADER} bytes");
                return Err((have as u64, why));
            }
        };
        let expected = HEADER as u64 + count * TRIANGLE as u64;
        if let Some(size) = size.filter(|&size| size != expected) {
            let why = format!(
                "the header gives {count} triangles, {expected} bytes in all; the file has {size}"
            );
            return Err((HEADER as u64 - 4, why));
        }
        let mut bytes = [0; TRIANGLE];
        for i in 0..count {
            let at = HEADER as u64 + i * TRIANGLE as u64;
            let have = fill(reader, &mut bytes).map_err(|e| (at, e))?;
            if have < TRIANGLE {
                let why = format!("the file ends inside triangle {i} of {count}");
                return Err((at + have as u64, why));
            }
            // Twelve bytes of normal, then three corners of three numbers.
            let number = |k: usize| {
                let four = bytes[12 + 4 * k..].first_chunk().copied();
                f64::from(f32::from_le_bytes(four.unwrap_or_default()))
            };
            let corners: [Vec3<f64>; 3] = std::array::from_fn(|v| {
                Vec3::new(number(3 * v), number(3 * v + 1), number(3 * v + 2))
            });
            if !corners.iter().all(|c| c.is_finite()) {
                let why = format!("triangle {i}: a coordinate is infinite or NaN");
                return Err((at, why));
            }
            self.add(corners).map_err(|why| (at, why))?;
        }
        Ok(())
    }

    /// Errors come with their line.
    fn read_text(&mut self, lines: &mut Lines<impl BufRead>) -> Result<(), LineError> {
        let mut text = Text::new(self);
        let mut last = 0;
        while let Some((number, line)) = lines.next()? {
            last = number;
            // A solid's name may be in any encoding.
            let line = String::from_utf8_lossy(line);
            text.line(&line).map_err(|why| (number, why))?;
        }
        match text.state {
            State::Outside => Ok(()),
            _ => Err((last, "the file ends before endsolid".to_owned())),
        }
    }
}

/// A text is read word by word, since a facet may be on one line or on many. Only the names
/// after `solid` and `endsolid` end with their line.
struct Text<'a> {
    triangles: &'a mut Triangles,
    state: State,
    /// The coordinates of the loop.
    coordinates: Vec<f64>,
}

/// What words may come next.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// `solid`.
    Outside,
    /// `facet`, `outer loop`, `endfacet` or `endsolid`.
    Solid,
    /// The same; everything else is the facet's normal.
    Facet,
    /// `loop`, or what follows it: `outer` alone has always been read.
    Outer,
    /// `vertex` or `endloop`.
    Loop,
    /// Coordinates.
    Vertex,
}

impl<'a> Text<'a> {
    fn new(triangles: &'a mut Triangles) -> Self {
        Self {
            triangles,
            state: State::Outside,
            coordinates: Vec::with_capacity(9),
        }
    }

    fn line(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_ascii_whitespace();
        while let Some(word) = words.next() {
            if self.word(word)? {
                pass_over_name(&mut words, self.state);
            }
        }
        Ok(())
    }

    /// Takes the next word; whether a name follows it.
    fn word(&mut self, word: &str) -> Result<bool, String> {
        let is = |keyword: &str| word.eq_ignore_ascii_case(keyword);
        match self.state {
            State::Vertex => self.coordinate(word)?,
            State::Outer if is("loop") => self.state = State::Loop,
            State::Outer | State::Loop => self.in_loop(word)?,
            State::Outside if is("solid") => {
                self.state = State::Solid;
                return Ok(true);
            }
            State::Outside => return Err(unexpected(word, "solid")),
            _ if is("endsolid") => {
                self.state = State::Outside;
                return Ok(true);
            }
            _ if is("facet") => self.state = State::Facet,
            _ if is("endfacet") => self.state = State::Solid,
            _ if is("outer") => {
                self.state = State::Outer;
                self.coordinates.clear();
            }
            State::Facet if ["vertex", "loop", "endloop", "solid"].into_iter().any(is) => {
                return Err(unexpected(word, "outer loop"));
            }
            State::Facet => {}
            State::Solid => {
                return Err(unexpected(word, "facet, outer loop, endfacet or endsolid"));
            }
        }
        Ok(false)
    }

    fn in_loop(&mut self, word: &str) -> Result<(), String> {
        let is = |keyword: &str| word.eq_ignore_ascii_case(keyword);
        let count = self.coordinates.len() / 3;
        self.state = if is("vertex") && count < 3 {
            State::Vertex
        } else if is("endloop") && count == 3 {
            let corner = |v: usize| Vec3::from([0, 1, 2].map(|k| self.coordinates[3 * v + k]));
            self.triangles.add([corner(0), corner(1), corner(2)])?;
            State::Solid
        } else {
            return Err(unexpected(
                word,
                match count {
                    3 => "endloop",
                    _ if is("endloop") => "a third vertex",
                    _ => "vertex",
                },
            ));
        };
        Ok(())
    }

    fn coordinate(&mut self, word: &str) -> Result<(), String> {
        let name = ["x", "y", "z"][self.coordinates.len() % 3];
        let value = number::parse_finite(word).map_err(|why| format!("vertex: {name}: {why}"))?;
        self.coordinates.push(value);
        if self.coordinates.len().is_multiple_of(3) {
            self.state = State::Loop;
        }
        Ok(())
    }
}

fn unexpected(word: &str, expected: &str) -> String {
    format!("found {}; expected {expected}", quote(word))
}

/// Passes over the name after `solid` or `endsolid`: the rest of the line, up to where the
/// next element clearly begins, for a text that is a single line.
fn pass_over_name(words: &mut SplitAsciiWhitespace<'_>, state: State) {
    let begins = |mut rest: SplitAsciiWhitespace<'_>| match rest.next() {
        Some(word) if word.eq_ignore_ascii_case("endsolid") => true,
        Some(word) if word.eq_ignore_ascii_case("facet") => rest
            .next()
            .is_some_and(|w| w.eq_ignore_ascii_case("normal")),
        _ => false,
    };
    // After an `endsolid` the next element is a solid that holds something.
    let holds_something = |rest: &SplitAsciiWhitespace<'_>| {
        let mut rest = rest.clone();
        loop {
            if begins(rest.clone()) {
                return true;
            }
            if rest.next().is_none() {
                return false;
            }
        }
    };
    loop {
        let rest = words.clone();
        let ends = match state {
            State::Outside => rest
                .clone()
                .next()
                .is_some_and(|w| w.eq_ignore_ascii_case("solid") && holds_something(&rest)),
            _ => begins(rest),
        };
        if ends || words.next().is_none() {
            return;
        }
    }
}

/// Reads until the buffer is full or the file ends; returns the number of bytes.
pub(super) fn fill(reader: &mut impl Read, buffer: &mut [u8]) -> Result<usize, String> {
    let mut have = 0;
    while have < buffer.len() {
        match reader.read(&mut buffer[have..]) {
            Ok(0) => break,
            Ok(count) => have += count,
            Err(e) if e.kind() == std::io::ErrorKind::Interrupted => {}
            Err(e) => return Err(e.to_string()),
        }
    }
    Ok(have)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::corruption;

    fn segments(input: &Input) -> Result<Vec<frusta::Segment<f64>>, Failure> {
        read(input, Some(EdgeChoice::All)).map(|scene| scene.segments())
    }

    #[test]
    fn corrupted_files_are_read_or_refused_and_never_panic() {
        let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5 0\n\
                     endloop\nendfacet\n";
        let other = facet.replace('0', "12").to_ascii_uppercase();
        let text = format!("solid a\n{facet}endsolid a\n solid\n{other}{facet}endsolid\n");
        let mut binary = b"solid, or so it says".to_vec();
        binary.resize(80, b' ');
        binary.extend(6_u32.to_le_bytes());
        for i in 0..6_u8 {
            binary.extend([0; 12]);
            for k in 0..9_u8 {
                binary.extend(f32::from((i * 7 + k * k) % 23).to_le_bytes());
            }
            binary.extend([0; 2]);
        }
        corruption::check("a.stl", &[text.into_bytes(), binary], 20_000, segments);
    }
}
