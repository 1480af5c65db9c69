//! Wavefront OBJ: `v`, `l` and `f`; everything else is passed over.
//!
//! Not through `tobj`: it keeps an `l` of three or more vertices as a polygon,
//! so that polylines cannot be told from faces, and its errors carry no line.
//!
//! A vertex's first three numbers count (colours and weights do not move it).
//! An index is absolute from 1, also to a vertex that comes later, or negative:
//! back from the last vertex so far. A backslash at a line's end joins the next.

use super::edges::UniqueEdges;
use super::scene::{Instance, Mesh};
use super::{EdgeChoice, Scene};
use crate::failure::{Failure, quote};
use crate::number;
use frusta::Vec3;
use std::borrow::Cow;
use std::path::Path;

/// Reads a file's edges.
pub(super) fn read(
    file: &Path,
    bytes: &[u8],
    choice: Option<EdgeChoice>,
) -> Result<Scene, Failure> {
    let mut reader = Reader::default();
    for (number, line) in logical_lines(bytes) {
        reader
            .line(number, &line)
            .map_err(|why| Failure::at(file, format_args!("line {number}"), why))?;
    }
    reader
        .finish(choice)
        .map_err(|(number, why)| Failure::at(file, format_args!("line {number}"), why))
}

#[derive(Default)]
struct Reader {
    points: Vec<Vec3<f64>>,
    lines: Vec<[u32; 2]>,
    faces: UniqueEdges,
    /// The greatest vertex asked for and the line that asks, if it comes later.
    ahead: Option<(u32, usize)>,
    /// One statement's vertices; kept for its memory.
    indices: Vec<u32>,
}

impl Reader {
    fn line(&mut self, number: usize, line: &[u8]) -> Result<(), String> {
        let line = line.trim_ascii_start();
        let end = line.iter().position(u8::is_ascii_whitespace);
        let (keyword, rest) = line.split_at(end.unwrap_or(line.len()));
        if !matches!(keyword, b"v" | b"l" | b"f") {
            return Ok(());
        }
        let rest = std::str::from_utf8(rest).map_err(|_| "the line is not UTF-8".to_owned())?;
        let rest = rest.split('#').next().unwrap_or("");
        let words = rest.split_ascii_whitespace();
        match keyword {
            b"v" => self.vertex(words),
            b"l" => self.polyline(number, words),
            _ => self.face(number, words),
        }
    }

    fn vertex<'a>(&mut self, mut words: impl Iterator<Item = &'a str>) -> Result<(), String> {
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
        Ok(())
    }

    fn polyline<'a>(
        &mut self,
        number: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), String> {
        self.read_indices(number, "l", 2, words)?;
        self.lines
            .extend(self.indices.windows(2).map(|w| [w[0], w[1]]));
        Ok(())
    }

    fn face<'a>(
        &mut self,
        number: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), String> {
        self.read_indices(number, "f", 3, words)?;
        let next = self.indices.iter().cycle().skip(1);
        for (&a, &b) in self.indices.iter().zip(next) {
            self.faces.add(a, b);
        }
        Ok(())
    }

    fn read_indices<'a>(
        &mut self,
        number: usize,
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
    fn index(&mut self, number: usize, word: &str) -> Result<u32, String> {
        let vertex = word.split('/').next().unwrap_or("");
        let value: i64 = vertex
            .parse()
            .map_err(|_| format!("{} is no vertex index", quote(word)))?;
        let count = self.points.len() as i64;
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

    fn finish(self, choice: Option<EdgeChoice>) -> Result<Scene, (usize, String)> {
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
        let instance = Instance {
            mesh: 0,
            node: 0,
            transform: None,
        };
        Ok(Scene::new(vec![mesh], vec![instance], kind))
    }
}

/// The file's lines with their numbers from 1, those that a backslash joins as
/// one, under the first one's number.
fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut physical = bytes.split(|&b| b == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (i, line) = physical.next()?;
        let mut line = Cow::Borrowed(line.trim_ascii_end());
        while line.ends_with(b"\\") {
            let joined = line.to_mut();
            joined.pop();
            joined.push(b' ');
            match physical.next() {
                Some((_, more)) => joined.extend_from_slice(more.trim_ascii_end()),
                None => break,
            }
        }
        Some((i + 1, line))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::Segment;

    fn segments(text: &str, choice: Option<EdgeChoice>) -> Result<Vec<Segment<f64>>, String> {
        let scene = read(Path::new("a.obj"), text.as_bytes(), choice).map_err(|e| e.to_string())?;
        let mut out = Vec::new();
        scene.fill(0, scene.len(), &mut out);
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
    }

    #[test]
    fn errors_name_the_line() {
        for (text, message) in [
            (
                "v 1 2\n",
                "a.obj: line 1: v needs three numbers; z is missing",
            ),
            ("\nv 1 2 x\n", "a.obj: line 2: v: z: \"x\" is no number"),
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
            ("l a b\n", "a.obj: line 1: \"a\" is no vertex index"),
            (
                "l 1 \\",
                "a.obj: line 1: l needs at least 2 vertices; found 1",
            ),
        ] {
            assert_eq!(segments(text, None).unwrap_err(), message, "{text:?}");
        }
    }
}
