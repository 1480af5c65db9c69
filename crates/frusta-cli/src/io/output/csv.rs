//! CSV: one row a segment, in the order of the input.

use crate::io::number::{self, Scalar};
use frusta::{Part, SegmentClip, Vec3};
use std::ops::Range;

/// The columns.
pub(crate) const HEADER: &str = "index,class,t0,t1,x0,y0,z0,x1,y1,z1,enter,leave,coplanar\n";

/// Appends the rows of the segments from index `first` on.
///
/// Numbers are the shortest decimals that read back to the same bits; a segment
/// that is outside has nothing after its class.
pub(crate) fn format<T: Scalar>(first: u64, clips: &[SegmentClip<T>], out: &mut Vec<u8>) {
    let mut last = None;
    for (index, clip) in (first..).zip(clips) {
        number::write_integer(index, out);
        out.push(b',');
        out.extend_from_slice(clip.class.name().as_bytes());
        match &clip.part {
            Some(part) => last = Some(write_part(part, last, out)),
            None => out.extend_from_slice(b",,,,,,,,,,,"),
        }
        out.push(b'\n');
    }
}

/// A point's bits and where in the text its coordinates are: the next segment of a line begins
/// there, and copying is faster than converting.
type Written = ([u64; 3], Range<usize>);

/// Appends a part's columns; returns where its exit point is.
fn write_part<T: Scalar>(part: &Part<T>, last: Option<Written>, out: &mut Vec<u8>) -> Written {
    let (entry, exit) = (&part.entry, &part.exit);
    for t in [entry.t, exit.t] {
        out.push(b',');
        number::write(t, out);
    }
    match last {
        Some((point, text)) if point == bits(entry.point) => out.extend_from_within(text),
        _ => drop(write_point(entry.point, out)),
    }
    let text = write_point(exit.point, out);
    for set in [entry.faces, exit.faces, part.coplanar] {
        out.push(b',');
        for (i, face) in set.iter().enumerate() {
            if i > 0 {
                out.push(b'+');
            }
            out.extend_from_slice(face.name().as_bytes());
        }
    }
    (bits(exit.point), text)
}

fn bits<T: Scalar>(point: Vec3<T>) -> [u64; 3] {
    point.to_array().map(|value| value.to_f64().to_bits())
}

/// Appends a point's columns; returns where they are.
fn write_point<T: Scalar>(point: Vec3<T>, out: &mut Vec<u8>) -> Range<usize> {
    let start = out.len();
    for value in point.to_array() {
        out.push(b',');
        number::write(value, out);
    }
    start..out.len()
}
