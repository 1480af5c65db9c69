//! From where a segment is clipped to its class and face sets.
//!
//! Closed sets throughout; touching counts as a hit.

use crate::clip::Class;
use crate::clip::predicates::{Predicates, Span};
use crate::frustum::{Face, FaceSet};
use crate::math::End;
use std::cmp::Ordering;

/// Where an end of the visible part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum At {
    /// At one of the segment's own ends.
    End(End),
    /// Where the segment crosses a face: the first one, in the order of [`Face::ALL`], of those
    /// that it crosses there. So swapping the ends gives the same face.
    Crossing(Face),
}

/// The decisions about a segment that meets the frustum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Decision {
    pub(crate) class: Class,
    pub(crate) at: [At; 2],
    pub(crate) clipped: [bool; 2],
    pub(crate) faces: [FaceSet; 2],
    pub(crate) coplanar: FaceSet,
}

/// The signs at one end.
#[derive(Clone, Copy)]
struct EndSigns {
    outside: FaceSet,
    on: FaceSet,
}

impl EndSigns {
    #[inline(always)]
    fn new(p: &mut impl Predicates, end: End) -> Self {
        let (mut outside, mut on) = (0, 0);
        for &face in p.faces() {
            let sign = p.side(face, end);
            outside |= u8::from(sign == Ordering::Less) << face as u8;
            on |= u8::from(sign == Ordering::Equal) << face as u8;
        }
        EndSigns {
            outside: FaceSet::from_bits(outside),
            on: FaceSet::from_bits(on),
        }
    }
}

impl Decision {
    /// For a segment of positive length; [`Decision::point`] is for the others.
    #[inline]
    pub(crate) fn new(p: &mut impl Predicates, span: Span) -> Self {
        let start = EndSigns::new(p, End::Start);
        let end = EndSigns::new(p, End::End);
        let coplanar = start.on.intersection(end.on);
        let (enter, leave) = (span.enter, span.leave);
        if enter.is_some_and(|face| end.on.contains(face)) {
            return Decision::touch_at(End::End, end.on, coplanar);
        }
        if leave.is_some_and(|face| start.on.contains(face)) {
            return Decision::touch_at(End::Start, start.on, coplanar);
        }
        if let (Some(a), Some(b)) = (enter, leave)
            && p.order(a, b) == Ordering::Equal
        {
            let crossed = ties(p, start.outside.union(end.outside), a);
            return Decision::crossing_touch(crossed, a, coplanar);
        }
        let entered = enter.map(|face| (ties(p, start.outside, face), face));
        let left = leave.map(|face| (ties(p, end.outside, face), face));
        let at = |found: Option<(FaceSet, Face)>, end| match found {
            Some((crossed, face)) => At::Crossing(crossed.first().unwrap_or(face)),
            None => At::End(end),
        };
        let faces = |found: Option<(FaceSet, Face)>, on: FaceSet| match found {
            Some((crossed, _)) => crossed.union(coplanar),
            None => on,
        };
        let clipped = [enter.is_some(), leave.is_some()];
        Decision {
            class: if !coplanar.is_empty() {
                Class::Boundary
            } else if clipped == [false, false] {
                Class::Inside
            } else {
                Class::Cross
            },
            at: [at(entered, End::Start), at(left, End::End)],
            clipped,
            faces: [faces(entered, start.on), faces(left, end.on)],
            coplanar,
        }
    }

    /// For a segment of zero length in the frustum.
    pub(crate) fn point(p: &mut impl Predicates) -> Self {
        let on = EndSigns::new(p, End::Start).on;
        Decision {
            class: if on.is_empty() {
                Class::Inside
            } else {
                Class::Touch
            },
            at: [At::End(End::Start), At::End(End::End)],
            clipped: [false, false],
            faces: [on, on],
            coplanar: FaceSet::EMPTY,
        }
    }

    fn touch_at(end: End, on: FaceSet, coplanar: FaceSet) -> Self {
        Decision {
            class: Class::Touch,
            at: [At::End(end), At::End(end)],
            clipped: [end == End::End, end == End::Start],
            faces: [on, on],
            coplanar,
        }
    }

    fn crossing_touch(crossed: FaceSet, face: Face, coplanar: FaceSet) -> Self {
        let at = At::Crossing(crossed.first().unwrap_or(face));
        let faces = crossed.union(coplanar);
        Decision {
            class: Class::Touch,
            at: [at, at],
            clipped: [true, true],
            faces: [faces, faces],
            coplanar,
        }
    }
}

/// The candidates that the segment crosses where it crosses `face`.
#[inline(always)]
fn ties(p: &mut impl Predicates, candidates: FaceSet, face: Face) -> FaceSet {
    if candidates.len() == 1 {
        return candidates;
    }
    candidates
        .iter()
        .filter(|&other| other == face || p.order(other, face) == Ordering::Equal)
        .collect()
}
