//! What the plain tiers of all clippers share: the check of the input, the
//! boundary values in the frame, and the assembling of a result.
//!
//! Every plain clipper finds two parameters, two face sets and the coplanar
//! set in its own way; what they mean is said once, in [`Found::build`].

use super::result::{Class, Part, PartEnd, SegmentClip};
use crate::frustum::{FaceSet, Frustum, PlainFrustum};
use crate::math::{NonFinite, Real, Segment, Vec3};

/// Runs a plain clipper on a checked segment.
///
/// The clipper sees only segments whose coordinates' magnitudes have a finite
/// sum, so that no difference and no interpolated coordinate overflows.
#[inline(always)]
pub(crate) fn run<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    clip: impl Fn(&PlainFrustum<T>, &Segment<T>) -> SegmentClip<T>,
) -> Result<SegmentClip<T>, NonFinite> {
    let Segment { start: p, end: q } = segment;
    let sum = (p.x.abs() + p.y.abs() + p.z.abs()) + (q.x.abs() + q.y.abs() + q.z.abs());
    if sum.is_finite() {
        return Ok(clip(frustum.plain(), segment));
    }
    run_huge(frustum, segment, clip)
}

/// What is left: an error, or a segment so large that it is clipped at an
/// eighth of its size.
#[cold]
#[inline(never)]
fn run_huge<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    clip: impl Fn(&PlainFrustum<T>, &Segment<T>) -> SegmentClip<T>,
) -> Result<SegmentClip<T>, NonFinite> {
    segment.check_finite()?;
    let (down, up) = (T::from_f64(0.125), T::from_f64(8.0));
    let small = Segment::new(segment.start * down, segment.end * down);
    let mut result = clip(&frustum.plain_scaled(0.125), &small);
    if let Some(part) = &mut result.part {
        for (end, original) in [
            (&mut part.entry, segment.start),
            (&mut part.exit, segment.end),
        ] {
            end.point = if end.clipped {
                nearest_finite(end.point * up)
            } else {
                original
            };
        }
    }
    Ok(result)
}

/// Rounding may carry an interpolated coordinate one step beyond the range.
fn nearest_finite<T: Real>(v: Vec3<T>) -> Vec3<T> {
    let clamp = |c: T| match (c.is_finite(), c > T::ZERO) {
        (true, _) => c,
        (false, true) => c.next_down(),
        (false, false) => c.next_up(),
    };
    Vec3::new(clamp(v.x), clamp(v.y), clamp(v.z))
}

/// The greater one; `acc` if `new` is NaN.
#[inline(always)]
pub(crate) fn max<T: Real>(new: T, acc: T) -> T {
    if new > acc { new } else { acc }
}

/// The lesser one; `acc` if `new` is NaN.
#[inline(always)]
pub(crate) fn min<T: Real>(new: T, acc: T) -> T {
    if new < acc { new } else { acc }
}

/// What a plain clipper has found in a segment that meets the frustum.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<T> {
    /// The parameters, `0 <= t[0] <= t[1] <= 1`.
    pub(crate) t: [T; 2],
    /// Whether the segment goes on beyond them.
    pub(crate) clipped: [bool; 2],
    /// The faces that cross at these parameters.
    pub(crate) faces: [FaceSet; 2],
    /// The faces with two zero values.
    pub(crate) coplanar: FaceSet,
}

impl<T: Real> Found<T> {
    /// The result.
    #[inline(always)]
    pub(crate) fn build(self, segment: &Segment<T>) -> SegmentClip<T> {
        let Segment { start: p, end: q } = *segment;
        let [t0, t1] = self.t;
        if p == q {
            return point(segment, self.coplanar);
        }
        let touch = t0 == t1;
        let d = q - p;
        let first = if self.clipped[0] { p + d * t0 } else { p };
        let last = if self.clipped[1] { p + d * t1 } else { q };
        let both = self.faces[0].union(self.faces[1]);
        let [entry, exit] = if touch { [both, both] } else { self.faces };
        let class = if touch {
            Class::Touch
        } else if !self.coplanar.is_empty() {
            Class::Boundary
        } else if self.clipped[0] | self.clipped[1] {
            Class::Cross
        } else {
            Class::Inside
        };
        SegmentClip {
            class,
            part: Some(Part {
                entry: PartEnd {
                    t: t0,
                    point: first,
                    clipped: self.clipped[0],
                    faces: entry.union(self.coplanar),
                    inward: !self.clipped[0],
                },
                exit: PartEnd {
                    t: t1,
                    point: last,
                    clipped: self.clipped[1],
                    faces: exit.union(self.coplanar),
                    inward: !self.clipped[1],
                },
                coplanar: self.coplanar,
            }),
        }
    }
}

/// All of the segment, touching no face.
#[inline(always)]
pub(crate) fn inside<T: Real>(segment: &Segment<T>) -> SegmentClip<T> {
    whole(segment, Class::Inside, FaceSet::EMPTY)
}

/// A segment of zero length in the frustum, on these faces.
#[cold]
fn point<T: Real>(segment: &Segment<T>, faces: FaceSet) -> SegmentClip<T> {
    let class = if faces.is_empty() {
        Class::Inside
    } else {
        Class::Touch
    };
    whole(segment, class, faces)
}

#[inline(always)]
fn whole<T: Real>(segment: &Segment<T>, class: Class, faces: FaceSet) -> SegmentClip<T> {
    let end = |t, point| PartEnd {
        t,
        point,
        clipped: false,
        faces,
        inward: true,
    };
    SegmentClip {
        class,
        part: Some(Part {
            entry: end(T::ZERO, segment.start),
            exit: end(T::ONE, segment.end),
            coplanar: FaceSet::EMPTY,
        }),
    }
}
