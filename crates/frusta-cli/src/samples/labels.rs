//! The paper's labels in words.

use frusta::samples::{Crossing, FrameSample, Intersections};

/// The number of points in which the segment meets the surface.
pub(super) fn intersections(sample: &FrameSample) -> &'static str {
    match sample.labels.intersections {
        Intersections::None => "none",
        Intersections::One => "one",
        Intersections::Two => "two",
        Intersections::Infinite => "infinitely many",
    }
}

/// How it crosses in the V plane.
pub(super) fn direction(sample: &FrameSample) -> &'static str {
    match sample.labels.direction {
        Crossing::LeftRight => "left-right",
        Crossing::UpDown => "up-down",
    }
}

/// The three labels as a phrase.
pub(super) fn phrase(sample: &FrameSample) -> String {
    let points = match sample.labels.intersections {
        Intersections::One => "one intersection point",
        Intersections::None => "no intersection point",
        Intersections::Two => "two intersection points",
        Intersections::Infinite => "infinitely many intersection points",
    };
    let position = sample.labels.position;
    format!("{points}, {}, {position}", direction(sample))
}
