//! The two predicates that decide everything, as the algorithms see them.

use crate::frustum::Face;
use crate::math::End;
use std::cmp::Ordering;

/// Signs of boundary values at a segment's ends, and orders of crossings.
pub(crate) trait Predicates {
    /// The faces there are, in the order of [`Face::ALL`].
    fn faces(&self) -> &'static [Face];

    /// The sign of a face's boundary function at an end; `Greater` is inside.
    fn side(&mut self, face: Face, end: End) -> Ordering;

    /// The order of the parameters at which the segment's line crosses two
    /// faces; for faces of which one end is strictly outside, the other not.
    fn order(&mut self, a: Face, b: Face) -> Ordering;
}

/// What an algorithm finds in a segment that meets the frustum: where it is
/// clipped. Ties between faces may be settled either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Span {
    /// A face at which the segment enters; `None` if its start is in the
    /// frustum.
    pub(crate) enter: Option<Face>,
    /// A face at which it leaves; `None` if its end is in the frustum.
    pub(crate) leave: Option<Face>,
}
