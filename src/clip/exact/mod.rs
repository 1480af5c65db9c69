//! The exact tier: classes and sets by exact signs, points by construction.
//!
//! ```text
//! staged    the predicates, in stages: lattice, filter, double-double,
//!           expansions, integers
//! decide    class, sets and places of the ends, from a span and the predicates
//! points    the ends' parameters and coordinates, to the requested accuracy
//! vw        V/W with certificates instead, where rounded values prove enough
//! lattice   the same where floating point makes no error at all
//! pair      both ends of a segment side by side
//! inward    the representable point next to an end that is in the frustum
//! ```

mod decide;
mod inward;
pub(crate) mod lattice;
mod pair;
mod points;
mod staged;
pub(crate) mod vw;

pub(crate) use staged::Staged;

use decide::Decision;
use points::build;

use super::predicates::{Predicates, Span};
use super::whole::outside;
use super::{Accuracy, SegmentClip, StageCounts};
use crate::frustum::Frustum;
use crate::math::{End, NonFinite, Real, Segment};
use std::cmp::Ordering;

/// Clips with an algorithm's control flow and exact predicates.
pub(crate) fn clip<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    span: impl FnOnce(&mut Staged<'_>) -> Option<Span>,
) -> Result<SegmentClip<T>, NonFinite> {
    segment.check_finite()?;
    let staged = Staged::new(frustum, segment.to_f64());
    Ok(clip_staged(staged, segment, accuracy, counts, span))
}

/// As [`clip`], with the values of a finite segment known.
fn clip_staged<T: Real>(
    mut staged: Staged<'_>,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    span: impl FnOnce(&mut Staged<'_>) -> Option<Span>,
) -> SegmentClip<T> {
    let decision = if segment.start == segment.end {
        point(&mut staged)
    } else {
        span(&mut staged).map(|span| Decision::new(&mut staged, span))
    };
    let result = match decision {
        None => outside(),
        Some(decision) => build(&mut staged, segment, &decision, accuracy),
    };
    staged.add_to(counts);
    result
}

/// A segment of zero length is its point: every algorithm's control flow
/// assumes that a line is crossed at most once.
fn point(staged: &mut Staged<'_>) -> Option<Decision> {
    let outside = |staged: &mut Staged<'_>, face| staged.side(face, End::Start) == Ordering::Less;
    let faces = staged.faces();
    if faces.iter().any(|&face| outside(staged, face)) {
        return None;
    }
    Some(Decision::point(staged))
}
