//! Wavefront OBJ: a line element for each part, a point element for a part
//! that is a single point.
//!
//! Each element follows its vertices and counts back to them, so that parts are
//! written as they come.

use crate::io::number::{self, Scalar};
use frusta::{Class, SegmentClip};

/// The first line.
pub(super) const HEADER: &str = "# parts of segments inside a view frustum\n";

/// Appends the vertices and elements of all parts.
pub(super) fn format<T: Scalar>(clips: &[SegmentClip<T>], out: &mut Vec<u8>) {
    for clip in clips {
        let Some(points) = clip.points() else {
            continue;
        };
        let (count, element) = if clip.class == Class::Touch || points[0] == points[1] {
            (1, "p -1\n")
        } else {
            (2, "l -2 -1\n")
        };
        for point in &points[..count] {
            out.push(b'v');
            for value in point.to_array() {
                out.push(b' ');
                number::write(value, out);
            }
            out.push(b'\n');
        }
        out.extend_from_slice(element.as_bytes());
    }
}
