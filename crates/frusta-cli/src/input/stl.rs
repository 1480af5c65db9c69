//! STL, binary and text: the edges of triangles, each once.
//!
//! Not through `stl_io`: it takes a binary file whose header begins with "solid "
//! for a text, and many do; it ends at a text's first `endsolid`; and its errors
//! have no line. Which kind a file is, its length tells: a binary one has 84
//! bytes and 50 for each triangle. Coordinates of texts are read in double
//! precision. Normals and attributes are passed over.

use super::edges::{PointSet, UniqueEdges};
use super::lines::{LineError, Lines};
use super::opened::{Input, MARK};
use super::scene::{Instance, Mesh};
use super::{EdgeChoice, Scene};
use crate::failure::{Failure, quote};
use crate::number;
use frusta::Vec3;
use std::io::{BufRead, Read};

/// Bytes before the triangles, and of each.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// Reads a file's edges.
pub(super) fn read(input: &Input, choice: Option<EdgeChoice>) -> Result<Scene, Failure> {
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
/// binary one. Of a pipe's length nothing is known; there a beginning without a
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
            self.points.number(a)?,
            self.points.number(b)?,
            self.points.number(c)?,
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
                "the header says {count} triangles, {expected} bytes in all; the file has {size}"
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

    fn read_text(&mut self, lines: &mut Lines<impl BufRead>) -> Result<(), LineError> {
        let mut corners = Vec::with_capacity(3);
        let (mut in_solid, mut in_loop) = (false, false);
        let mut last = 0;
        while let Some((number, line)) = lines.next()? {
            last = number;
            let fail = |why: String| (number, why);
            // A solid's name may be in any encoding.
            let text = String::from_utf8_lossy(line);
            let mut words = text.split_ascii_whitespace();
            let Some(keyword) = words.next() else {
                continue;
            };
            let keyword = keyword.to_ascii_lowercase();
            let expected = match (keyword.as_str(), in_solid, in_loop) {
                ("solid", false, _) => {
                    in_solid = true;
                    continue;
                }
                ("endsolid", true, false) => {
                    in_solid = false;
                    continue;
                }
                ("facet" | "endfacet", true, false) => continue,
                ("outer", true, false) => {
                    in_loop = true;
                    corners.clear();
                    continue;
                }
                ("vertex", true, true) if corners.len() < 3 => {
                    corners.push(point(words).map_err(fail)?);
                    continue;
                }
                ("endloop", true, true) => match *corners {
                    [a, b, c] => {
                        self.add([a, b, c]).map_err(fail)?;
                        in_loop = false;
                        continue;
                    }
                    _ => "a third vertex",
                },
                (_, false, _) => "solid",
                (_, true, false) => "facet, outer loop, endfacet or endsolid",
                _ if corners.len() < 3 => "vertex",
                _ => "endloop",
            };
            return Err(fail(format!(
                "found {}; expected {expected}",
                quote(&keyword)
            )));
        }
        if in_solid {
            return Err((last, "the file ends before endsolid".to_owned()));
        }
        Ok(())
    }
}

/// Three numbers and no more.
fn point<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Vec3<f64>, String> {
    let mut point = Vec3::default();
    for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
        let Some(word) = words.next() else {
            return Err(format!("vertex needs three numbers; {name} is missing"));
        };
        point[i] = number::parse_finite(word).map_err(|why| format!("{name}: {why}"))?;
    }
    match words.next() {
        Some(word) => Err(format!("{} after the three numbers", quote(word))),
        None => Ok(point),
    }
}

/// Reads until the buffer is full or the file ends; how many bytes.
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
    use crate::input::damaged;

    fn segments(input: &Input) -> Result<Vec<frusta::Segment<f64>>, Failure> {
        read(input, Some(EdgeChoice::All)).map(|scene| scene.segments())
    }

    #[test]
    fn damaged_files_are_read_or_refused_and_never_panic() {
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
        damaged::check("a.stl", &[text.into_bytes(), binary], 20_000, segments);
    }
}
