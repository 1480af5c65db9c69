//! Segments: clipped by a box, by a window, by a perspective frustum.

mod line_clipping;
mod ours;
mod parry;
mod retrofire;

pub use line_clipping::CohenSutherland2;
pub use ours::{Ours, OursSlices, REFERENCE, REFERENCE_SLICES, contenders, reference};
pub use parry::{ParryBox32, ParryBox64, ParryCall};
pub use retrofire::{Attributed, Prepared, Slice, Transformed, cube_matrix};

use crate::peer::Case;
use frusta::{Real, Segment, Vec3};

/// Segments in one call, where slices are clipped.
const PIECE: usize = 1024;

/// A library's answer to a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Found<T> {
    /// No part is inside.
    Nothing,
    /// The ends of the part that is inside.
    Part([FoundEnd<T>; 2]),
    /// An error, or a number that is not finite.
    Refused,
}

/// One end of the part that is inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundEnd<T> {
    /// Its position.
    pub point: Vec3<T>,
    /// Whether it is the segment's own end, bit for bit.
    pub kept: bool,
    /// Whether it is inside, where the library's answer is in other coordinates than the world's,
    /// in which this is exact.
    pub inside: Option<bool>,
}

impl<T: Real> Case for Segment<T> {
    type Answer = Found<T>;
}

/// An answer that consists of two points in the world.
fn part<T: Real>(segment: &Segment<T>, points: [[T; 3]; 2]) -> Found<T> {
    let ends = [segment.start, segment.end];
    let found = [0, 1].map(|i| {
        let point = Vec3::from(points[i]);
        FoundEnd {
            point,
            kept: point == ends[i],
            inside: None,
        }
    });
    if found.iter().all(|end| end.point.is_finite()) {
        Found::Part(found)
    } else {
        Found::Refused
    }
}
