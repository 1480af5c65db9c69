//! The exact tier: classes and sets by exact signs, points by construction.
//!
//! ```text
//! staged    the predicates, in stages: filter, lattice, expansions, integers
//! decide    a span and the predicates give class, sets and where the ends are
//! points    the ends' parameters and coordinates, to the accuracy asked for
//! inward    the representable point next to an end that is in the frustum
//! ```

mod decide;
mod inward;
mod points;
mod staged;

pub(crate) use decide::Decision;
pub(crate) use staged::Staged;

use super::predicates::Span;
use super::{Accuracy, SegmentClip, StageCounts};
use crate::frustum::Frustum;
use crate::math::{NonFinite, Real, Segment};

/// Clips with an algorithm's control flow and exact predicates.
pub(crate) fn clip<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    accuracy: Accuracy,
    counts: &mut StageCounts,
    span: impl FnOnce(&mut Staged<'_>) -> Option<Span>,
) -> Result<SegmentClip<T>, NonFinite> {
    segment.check_finite()?;
    let mut staged = Staged::new(frustum, segment.to_f64());
    let result = match span(&mut staged) {
        None => SegmentClip::OUTSIDE,
        Some(span) => {
            let decision = Decision::new(&mut staged, span);
            points::build(&mut staged, segment, &decision, accuracy)
        }
    };
    staged.add_to(counts);
    Ok(result)
}
