//! CSV: one row a segment, in the order of the input.

use crate::io::number::{self, Scalar};
use frusta::{Part, SegmentClip};
use std::io::Write;

/// The columns.
pub(crate) const HEADER: &str = "index,class,t0,t1,x0,y0,z0,x1,y1,z1,enter,leave,coplanar\n";

/// Appends the rows of the segments from index `first` on.
///
/// Numbers are the shortest decimals that read back to the same bits; a segment
/// that is outside has nothing after its class.
pub(crate) fn format<T: Scalar>(first: u64, clips: &[SegmentClip<T>], out: &mut Vec<u8>) {
    for (index, clip) in (first..).zip(clips) {
        // Writing into memory cannot fail.
        let _ = write!(out, "{index},{}", clip.class.name());
        match &clip.part {
            Some(part) => write_part(part, out),
            None => out.extend_from_slice(b",,,,,,,,,,,"),
        }
        out.push(b'\n');
    }
}

fn write_part<T: Scalar>(part: &Part<T>, out: &mut Vec<u8>) {
    let (entry, exit) = (&part.entry, &part.exit);
    let [a, b] = [entry.point.to_array(), exit.point.to_array()];
    for value in [entry.t, exit.t].into_iter().chain(a).chain(b) {
        out.push(b',');
        number::write(value, out);
    }
    for set in [entry.faces, exit.faces, part.coplanar] {
        out.push(b',');
        for (i, face) in set.iter().enumerate() {
            if i > 0 {
                out.push(b'+');
            }
            out.extend_from_slice(face.name().as_bytes());
        }
    }
}
