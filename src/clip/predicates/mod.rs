//! The interface of the two predicates that decide everything.

use crate::frustum::Face;
use crate::math::End;
use std::cmp::Ordering;

/// Signs of boundary values at a segment's ends, and orders of crossings.
pub(crate) trait Predicates {
    /// The frustum's faces, in the order of [`Face::ALL`].
    fn faces(&self) -> &'static [Face];

    /// The sign of a face's boundary function at an end; `Greater` is inside.
    fn side(&mut self, face: Face, end: End) -> Ordering;

    /// The order of the parameters at which the segment's line crosses two
    /// faces. Precondition: exactly one end is strictly outside each of them.
    fn order(&mut self, a: Face, b: Face) -> Ordering;

    /// The face's effect on the segment.
    #[inline]
    fn role(&mut self, face: Face) -> Role {
        let start = self.side(face, End::Start);
        let end = self.side(face, End::End);
        match (start, end) {
            (Ordering::Less, Ordering::Less) => Role::Outside,
            (Ordering::Less, _) => Role::Enter,
            (_, Ordering::Less) => Role::Leave,
            _ => Role::Inside,
        }
    }
}

/// A face's effect on a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// Both ends are strictly outside it, so all of the segment is.
    Outside,
    /// Only the start is: the segment enters here.
    Enter,
    /// Only the end is: the segment leaves here.
    Leave,
    /// Neither end is.
    Inside,
}

/// An algorithm's result for a segment that meets the frustum: where it is
/// clipped. Ties between faces may be decided either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Span {
    /// A face at which the segment enters; `None` if its start is in the
    /// frustum.
    pub(crate) enter: Option<Face>,
    /// A face at which it leaves; `None` if its end is in the frustum.
    pub(crate) leave: Option<Face>,
}

impl Span {
    /// Starts no earlier than the face's crossing.
    #[inline]
    pub(crate) fn enter(&mut self, p: &mut impl Predicates, face: Face) {
        let later = |f| p.order(face, f) == Ordering::Greater;
        if self.enter.is_none_or(later) {
            self.enter = Some(face);
        }
    }

    /// Ends no later than the face's crossing.
    #[inline]
    pub(crate) fn leave(&mut self, p: &mut impl Predicates, face: Face) {
        let earlier = |f| p.order(face, f) == Ordering::Less;
        if self.leave.is_none_or(earlier) {
            self.leave = Some(face);
        }
    }

    /// `None` if the span ends before it starts.
    #[inline]
    pub(crate) fn unless_empty(self, p: &mut impl Predicates) -> Option<Self> {
        match (self.enter, self.leave) {
            (Some(a), Some(b)) if p.order(a, b) == Ordering::Greater => None,
            _ => Some(self),
        }
    }
}

#[cfg(test)]
mod tests;
