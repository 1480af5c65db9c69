//! Wavefront OBJ: a line element for each part, a point element for a part
//! that is a single point.

use super::Formatted;
use crate::failure::Failure;
use crate::number::{self, Scalar};
use frusta::{Class, SegmentClip};
use std::io::Write;

/// The first line.
pub(super) const HEADER: &str = "# parts of segments inside a view frustum\n";

/// Appends the vertices of all parts.
pub(super) fn format<T: Scalar>(clips: &[SegmentClip<T>], out: &mut Formatted) {
    for clip in clips {
        let Some(points) = clip.points() else {
            continue;
        };
        let single = clip.class == Class::Touch || points[0] == points[1];
        for point in &points[..if single { 1 } else { 2 }] {
            out.text.push(b'v');
            for value in point.to_array() {
                out.text.push(b' ');
                number::write(value, &mut out.text);
            }
            out.text.push(b'\n');
        }
        if single {
            out.points.push(out.parts);
        }
        out.parts += 1;
    }
}

/// Which vertices belong together. Only single points are kept by number: all
/// other parts are the next two vertices.
#[derive(Debug, Default)]
pub(crate) struct Elements {
    parts: u64,
    points: Vec<u64>,
}

impl Elements {
    /// Adds a chunk's parts.
    pub(super) fn add(&mut self, parts: u32, points: &[u32]) {
        self.points
            .extend(points.iter().map(|&p| self.parts + u64::from(p)));
        self.parts += u64::from(parts);
    }

    /// Writes all elements, in pieces.
    pub(super) fn write(
        &self,
        mut write: impl FnMut(&[u8]) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut text = Vec::new();
        let mut points = self.points.iter().peekable();
        let mut vertex = 1_u64;
        for part in 0..self.parts {
            // Writing into memory cannot fail.
            if points.next_if_eq(&&part).is_some() {
                let _ = writeln!(text, "p {vertex}");
                vertex += 1;
            } else {
                let _ = writeln!(text, "l {vertex} {}", vertex + 1);
                vertex += 2;
            }
            if text.len() >= 1 << 16 {
                write(&text)?;
                text.clear();
            }
        }
        write(&text)
    }
}
