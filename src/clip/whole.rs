//! Results that need no construction, and what all constructions share.

use super::result::{Class, Part, PartEnd, SegmentClip};
use crate::frustum::FaceSet;
use crate::math::{Real, Segment, Vec3};

/// No part of the segment. Not the constant [`SegmentClip::OUTSIDE`]: a copy of it would copy its
/// padding, too.
#[inline(always)]
pub(crate) fn outside<T>() -> SegmentClip<T> {
    SegmentClip {
        class: Class::Outside,
        part: None,
    }
}

/// All of the segment, touching no face.
#[inline(always)]
pub(crate) fn inside<T: Real>(segment: &Segment<T>) -> SegmentClip<T> {
    whole(segment, Class::Inside, FaceSet::EMPTY)
}

/// A segment of zero length in the frustum, on these faces.
#[cold]
pub(crate) fn point<T: Real>(segment: &Segment<T>, faces: FaceSet) -> SegmentClip<T> {
    let class = if faces.is_empty() {
        Class::Inside
    } else {
        Class::Touch
    };
    whole(segment, class, faces)
}

#[inline(always)]
fn whole<T: Real>(segment: &Segment<T>, class: Class, faces: FaceSet) -> SegmentClip<T> {
    SegmentClip {
        class,
        part: Some(Part {
            entry: PartEnd::fast(T::ZERO, segment.start, false, faces),
            exit: PartEnd::fast(T::ONE, segment.end, false, faces),
            coplanar: FaceSet::EMPTY,
        }),
    }
}

impl<T: Real> PartEnd<T> {
    /// An end that, if it was clipped, is not known to be in the frustum.
    #[inline(always)]
    pub(crate) fn fast(t: T, point: Vec3<T>, clipped: bool, faces: FaceSet) -> Self {
        Self {
            t,
            point,
            clipped,
            faces,
            inward: !clipped,
        }
    }
}

/// The class of a segment of positive length that meets the frustum: whether it has one point in
/// common with it, whether it lies in a face's plane, whether it was clipped.
///
/// A table, not branches: on a lattice all classes are common.
#[inline(always)]
pub(crate) fn class(touch: bool, coplanar: bool, clipped: bool) -> Class {
    use Class::{Boundary, Cross, Inside, Touch};
    const CLASSES: [Class; 8] = [
        Inside, Cross, Boundary, Boundary, Touch, Touch, Touch, Touch,
    ];
    CLASSES[usize::from(touch) << 2 | usize::from(coplanar) << 1 | usize::from(clipped)]
}
