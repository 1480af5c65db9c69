//! Wavefront OBJ: `v`, `l` and `f`; everything else is passed over.
//!
//! Not through `tobj`: it keeps an `l` of three or more vertices as a polygon,
//! so that polylines cannot be distinguished from faces, and its errors carry no line.
//!
//! A vertex's first three numbers count (colours and weights do not move it).
//! An index is absolute from 1, also to a vertex that comes later, or negative:
//! back from the last vertex so far. A backslash at a line's end joins the next.

use super::edges::UniqueEdges;
use super::input::Input;
use super::lines::{LineError, Lines};
use super::scene::{Instance, Mesh};
use super::{Contents, EdgeChoice, Format, ReadOptions, Scene, Stream, Take};
use crate::failure::{Failure, quote};
use crate::io::number;
use frusta::{Segment, Vec3};

/// The format.
pub(super) struct Obj;

impl Format for Obj {
    fn name(&self) -> &'static str {
        "obj"
    }

    fn description(&self) -> &'static str {
        "Wavefront OBJ"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["obj"]
    }

    fn is_mesh(&self) -> bool {
        true
    }

    fn open(&self, input: &Input, options: ReadOptions) -> Result<Contents, Failure> {
        // Lines need no set of unique edges, so they can be a stream.
        match options.edges {
            edges @ Some(EdgeChoice::Lines) => {
                Ok(Contents::Stream(Stream::new(input, edges, lines)))
            }
            edges => read(input, edges).map(Contents::Scene),
        }
    }
}

/// Reads a file's edges.
fn read(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
    let fail = |e| input.failure_in_line(e);
    let mut lines = Lines::new(input.open()?);
    let mut reader = Reader::default();
    while let Some((number, line)) = lines.next_joined().map_err(fail)? {
        let read = reader.line(number, line);
        read.map_err(|why| fail((number, why)))?;
    }
    reader.finish(choice).map_err(fail)
}

/// Gives the segments of a file's `l` elements as they come.
///
/// Only the vertices are kept, since any element may name any of them. A file is
/// read twice, so that an element may name one that comes later; a pipe cannot be.
fn lines(input: &Input, take: &mut Take<'_>) -> Result<(), Failure> {
    let fail = |e| input.failure_in_line(e);
    let mut all = Reader::default();
    if !input.is_piped() {
        let mut lines = Lines::new(input.open()?);
        while let Some((number, line)) = lines.next_joined().map_err(fail)? {
            if let Some((Keyword::Vertex, rest)) = statement(line) {
                all.vertex(rest).map_err(|why| fail((number, why)))?;
            }
        }
    }
    let mut reader = Reader::default();
    let mut lines = Lines::new(input.open()?);
    while let Some((number, line)) = lines.next_joined().map_err(fail)? {
        let read = match statement(line) {
            Some((Keyword::Vertex, rest)) if input.is_piped() => {
                reader.count += 1;
                all.vertex(rest)
            }
            Some((Keyword::Vertex, _)) => {
                reader.count += 1;
                Ok(())
            }
            Some((Keyword::Line, rest)) => reader.polyline(number, rest),
            _ => Ok(()),
        };
        read.map_err(|why| fail((number, why)))?;
        for edge in reader.lines.drain(..) {
            let [Some(&start), Some(&end)] = edge.map(|v| all.points.get(v as usize)) else {
                let vertex = u64::from(edge[0].max(edge[1])) + 1;
                let why = format!(
                    "vertex {vertex} of {}{}",
                    all.points.len(),
                    if input.is_piped() {
                        " so far; in a pipe vertices come before the lines"
                    } else {
                        ""
                    }
                );
                return Err(fail((number, why)));
            };
            take(Segment { start, end })?;
        }
    }
    Ok(())
}

/// The statements that are read.
enum Keyword {
    Vertex,
    Line,
    Face,
}

/// A line's statement and what follows its keyword.
fn statement(line: &[u8]) -> Option<(Keyword, &[u8])> {
    let line = line.trim_ascii_start();
    let end = line.iter().position(u8::is_ascii_whitespace);
    let (keyword, rest) = line.split_at(end.unwrap_or(line.len()));
    let keyword = match keyword {
        b"v" => Keyword::Vertex,
        b"l" => Keyword::Line,
        b"f" => Keyword::Face,
        _ => return None,
    };
    Some((keyword, rest))
}

/// A statement's words, without a comment.
fn words(rest: &[u8]) -> Result<impl Iterator<Item = &str>, String> {
    let rest = std::str::from_utf8(rest).map_err(|_| "the line is not UTF-8".to_owned())?;
    Ok(rest
        .split('#')
        .next()
        .unwrap_or("")
        .split_ascii_whitespace())
}

#[derive(Default)]
struct Reader {
    points: Vec<Vec3<f64>>,
    /// Number of vertices so far, kept or not.
    count: u32,
    lines: Vec<[u32; 2]>,
    faces: UniqueEdges,
    /// The greatest vertex asked for and the line that asks, if it comes later.
    ahead: Option<(u32, u64)>,
    /// One statement's vertices; kept for its memory.
    indices: Vec<u32>,
}

impl Reader {
    fn line(&mut self, number: u64, line: &[u8]) -> Result<(), String> {
        match statement(line) {
            Some((Keyword::Vertex, rest)) => self.vertex(rest),
            Some((Keyword::Line, rest)) => self.polyline(number, rest),
            Some((Keyword::Face, rest)) => self.face(number, rest),
            None => Ok(()),
        }
    }

    fn vertex(&mut self, rest: &[u8]) -> Result<(), String> {
        let mut words = words(rest)?;
        let mut point = Vec3::new(0.0, 0.0, 0.0);
        for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
            let Some(word) = words.next() else {
                return Err(format!("v needs three numbers; {name} is missing"));
            };
            point[i] = number::parse_finite(word).map_err(|why| format!("v: {name}: {why}"))?;
        }
        if self.points.len() >= u32::MAX as usize {
            return Err("more than 4294967295 vertices".to_owned());
        }
        self.points.push(point);
        self.count += 1;
        Ok(())
    }

    fn polyline(&mut self, number: u64, rest: &[u8]) -> Result<(), String> {
        self.read_indices(number, "l", 2, words(rest)?)?;
        self.lines
            .extend(self.indices.windows(2).map(|w| [w[0], w[1]]));
        Ok(())
    }

    fn face(&mut self, number: u64, rest: &[u8]) -> Result<(), String> {
        self.read_indices(number, "f", 3, words(rest)?)?;
        let next = self.indices.iter().cycle().skip(1);
        for (&a, &b) in self.indices.iter().zip(next) {
            self.faces.add(a, b);
        }
        Ok(())
    }

    fn read_indices<'a>(
        &mut self,
        number: u64,
        keyword: &str,
        least: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), String> {
        self.indices.clear();
        for word in words {
            let index = self.index(number, word)?;
            self.indices.push(index);
        }
        if self.indices.len() < least {
            return Err(format!(
                "{keyword} needs at least {least} vertices; found {}",
                self.indices.len()
            ));
        }
        Ok(())
    }

    /// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`, from 0.
    fn index(&mut self, number: u64, word: &str) -> Result<u32, String> {
        let vertex = word.split('/').next().unwrap_or("");
        let value: i64 = vertex
            .parse()
            .map_err(|_| format!("{} is not a vertex index", quote(word)))?;
        let count = i64::from(self.count);
        let index = match value {
            1.. => value - 1,
            0 => return Err("vertex index 0; indices start at 1".to_owned()),
            _ => count.saturating_add(value),
        };
        match u32::try_from(index) {
            Ok(i) => {
                if index >= count && self.ahead.is_none_or(|(most, _)| i > most) {
                    self.ahead = Some((i, number));
                }
                Ok(i)
            }
            Err(_) => Err(format!("vertex {value} of {count} so far")),
        }
    }

    fn finish(self, choice: Option<EdgeChoice>) -> Result<Scene, LineError> {
        let count = self.points.len();
        if let Some((most, number)) = self.ahead.filter(|&(most, _)| most as usize >= count) {
            let asked = u64::from(most) + 1;
            return Err((number, format!("vertex {asked} of {count}")));
        }
        let kind = choice.unwrap_or(if self.lines.is_empty() {
            EdgeChoice::Triangles
        } else {
            EdgeChoice::Lines
        });
        let mut edges = if kind.wants_lines() {
            self.lines
        } else {
            Vec::new()
        };
        if kind.wants_faces() {
            edges.extend(self.faces.finish(&self.points));
        }
        let mesh = Mesh {
            points: self.points,
            edges,
        };
        Ok(Scene::new(vec![mesh], vec![Instance::PLAIN], kind))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::corruption;

    /// A file of that text, and its messages without the folder's name.
    fn with_file<T>(
        text: &str,
        read: impl FnOnce(&Input) -> Result<T, Failure>,
    ) -> Result<T, String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.obj");
        std::fs::write(&file, text).unwrap();
        let prefix = format!("{}/", folder.path().display());
        let result = read(&Input::new(&file, None).unwrap());
        result.map_err(|e| e.to_string().replace(&prefix, ""))
    }

    fn segments(text: &str, choice: Option<EdgeChoice>) -> Result<Vec<Segment<f64>>, String> {
        let scene = with_file(text, |input| read(input, choice))?;
        let mut out = Vec::new();
        scene.fill(0, scene.len(), &mut out);
        Ok(out)
    }

    fn streamed(text: &str) -> Result<Vec<Segment<f64>>, String> {
        let mut out = Vec::new();
        with_file(text, |input| {
            lines(input, &mut |segment| {
                out.push(segment);
                Ok(())
            })
        })?;
        Ok(out)
    }

    #[test]
    fn polylines_faces_and_negative_indices() {
        let text = "# a comment\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0x1p-1 1 0 1\n\
                    l 1 2 \\\n 3\nf 1/1/1 2//2 -2/7 -1\nl -1 5\nv 9 9 9\n";
        let lines = segments(text, None).unwrap();
        assert_eq!(lines.len(), 3);
        assert_eq!(lines[1], Segment::new([1.0, 0.0, 0.0], [1.0, 1.0, 0.0]));
        assert_eq!(lines[2], Segment::new([0.5, 1.0, 0.0], [9.0; 3]));
        assert_eq!(
            segments(text, Some(EdgeChoice::Triangles)).unwrap().len(),
            4
        );
        assert_eq!(segments(text, Some(EdgeChoice::All)).unwrap().len(), 7);
        assert_eq!(streamed(text).unwrap(), lines);
        assert_eq!(
            streamed("v 0 0 0\nl 1 -2\n").unwrap_err(),
            "a.obj: line 2: vertex -2 of 1 so far"
        );
        assert_eq!(
            streamed("v 0 0 0\nl 1 3\nv 0 0 0\n").unwrap_err(),
            "a.obj: line 2: vertex 3 of 2"
        );
    }

    #[test]
    fn errors_name_the_line() {
        for (text, message) in [
            (
                "v 1 2\n",
                "a.obj: line 1: v needs three numbers; z is missing",
            ),
            ("\nv 1 2 x\n", "a.obj: line 2: v: z: \"x\" is not a number"),
            ("v 1 2 nan\n", "a.obj: line 1: v: z: NaN; it must be finite"),
            ("v 0 0 0\nl 1 2\n", "a.obj: line 2: vertex 2 of 1"),
            ("v 0 0 0\nl 1 -2\n", "a.obj: line 2: vertex -2 of 1 so far"),
            (
                "v 0 0 0\nl 1 99999999999\n",
                "a.obj: line 2: vertex 99999999999 of 1 so far",
            ),
            (
                "v 0 0 0\nl 0 1\n",
                "a.obj: line 2: vertex index 0; indices start at 1",
            ),
            (
                "f 1 2\n",
                "a.obj: line 1: f needs at least 3 vertices; found 2",
            ),
            ("l a b\n", "a.obj: line 1: \"a\" is not a vertex index"),
            (
                "l 1 \\",
                "a.obj: line 1: l needs at least 2 vertices; found 1",
            ),
        ] {
            assert_eq!(segments(text, None).unwrap_err(), message, "{text:?}");
        }
    }

    #[test]
    fn corrupted_files_are_read_or_refused_and_never_panic() {
        let sample = "# a comment\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\n\
                      v 0x1p-1 1 0 1\nvn 0 0 1\ng a\nl 1 2 \\\n 3\nf 1/1/1 2//2 -2/7 -1\n\
                      usemtl b\nl -1 5 # c\nv 9 9 9\nl 2 3 4 1\nv -1.5e3 12 34.25\n";
        let samples = [sample.to_owned(), sample.replace('\n', "\r\n")];
        let bytes = samples.clone().map(String::into_bytes);
        corruption::check("a.obj", &bytes, 20_000, |input| {
            let scene = read(input, Some(EdgeChoice::All))?;
            let mut out = Vec::new();
            scene.fill(0, scene.len(), &mut out);
            Ok(out)
        });
        // The same as a stream; a pipe's lines may not name vertices to come.
        let samples = samples.map(|s| s.replace("l -1 5 # c", "l -1 4"));
        let samples = samples.map(String::into_bytes);
        corruption::check("a.obj", &samples, 20_000, |input| {
            let mut out = Vec::new();
            lines(input, &mut |segment| {
                out.push(segment);
                Ok(())
            })?;
            Ok(out)
        });
    }
}
