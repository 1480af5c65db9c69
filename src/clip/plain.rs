//! The plain tiers' common parts: the check of the input, the
//! choice of the frustum's form, and the construction of a result.
//!
//! Every plain clipper finds two parameters, two face sets and the coplanar
//! set in its own way; [`Found::build`] makes the result of them.
//!
//! The sets hold the faces whose computed parameter equals the chosen one,
//! and at an end that is not clipped those with a boundary value of zero.

use super::result::{Part, PartEnd, SegmentClip};
use super::whole;
use crate::frustum::{
    Face, FaceSet, Form, Frustum, General, Layout, Orthographic, PlainFrustum, Symmetric,
};
use crate::math::{NonFinite, Real, Segment, Vec3};

/// A plain clipper of checked segments.
pub(crate) type PlainClip<T> = fn(&PlainFrustum<T>, &Segment<T>) -> SegmentClip<T>;

/// Checks a segment and runs a plain clipper on it.
///
/// The clipper sees only segments whose coordinates' magnitudes have a finite
/// sum, so that no difference and no interpolated coordinate overflows.
#[inline(always)]
pub(crate) fn run<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    clip: PlainClip<T>,
) -> Result<SegmentClip<T>, NonFinite> {
    let Segment { start: p, end: q } = segment;
    let sum = (p.x.abs() + p.y.abs() + p.z.abs()) + (q.x.abs() + q.y.abs() + q.z.abs());
    if sum.is_finite() {
        return Ok(clip(frustum.plain(), segment));
    }
    run_huge(frustum, segment, clip)
}

/// The other cases: an error, or a segment so large that it is clipped at an
/// eighth of its size.
#[cold]
#[inline(never)]
fn run_huge<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
    clip: PlainClip<T>,
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

/// The findings of a plain clipper about a segment that meets the frustum.
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
    /// All of a segment.
    pub(crate) const WHOLE: Self = Self {
        t: [T::ZERO, T::ONE],
        clipped: [false; 2],
        faces: [FaceSet::EMPTY; 2],
        coplanar: FaceSet::EMPTY,
    };

    /// The segment enters through a face at `t`.
    #[inline(always)]
    pub(crate) fn enter(&mut self, face: Face, t: T) {
        if t > self.t[0] {
            self.t[0] = t;
            self.clipped[0] = true;
            self.faces[0] = FaceSet::EMPTY;
        }
        if t >= self.t[0] {
            self.faces[0].insert(face);
        }
    }

    /// The segment leaves through a face at `t`.
    #[inline(always)]
    pub(crate) fn leave(&mut self, face: Face, t: T) {
        if t < self.t[1] {
            self.t[1] = t;
            self.clipped[1] = true;
            self.faces[1] = FaceSet::EMPTY;
        }
        if t <= self.t[1] {
            self.faces[1].insert(face);
        }
    }

    /// Adds a face by its values at both ends, and divides only if their
    /// signs differ. False if both ends are outside.
    #[inline(always)]
    pub(crate) fn face_by_signs(&mut self, face: Face, a: T, b: T) -> bool {
        let zero = T::ZERO;
        if a < zero {
            if b < zero {
                return false;
            }
            self.enter(face, a / (a - b));
        } else if b < zero {
            self.leave(face, a / (a - b));
        }
        if (a == zero) | (b == zero) {
            self.zeros(face, a, b);
        }
        true
    }

    /// Adds a face that has a zero value at an end.
    #[cold]
    fn zeros(&mut self, face: Face, a: T, b: T) {
        let zero = T::ZERO;
        if a == zero && b == zero {
            self.coplanar.insert(face);
        } else if a == zero {
            self.enter(face, zero);
        } else {
            self.leave(face, T::ONE);
        }
    }
    /// The result.
    #[inline(always)]
    pub(crate) fn build(self, segment: &Segment<T>) -> SegmentClip<T> {
        let Segment { start: p, end: q } = *segment;
        let [t0, t1] = self.t;
        let clipped = self.clipped[0] | self.clipped[1];
        if !clipped && p == q {
            return whole::point(segment, self.coplanar);
        }
        let touch = t0 == t1;
        // Both points are always computed: choosing afterwards costs less than
        // a mispredicted branch.
        let d = q - p;
        let first = choose(self.clipped[0], d.times_plus(t0, p), p);
        let last = choose(self.clipped[1], d.times_plus(t1, p), q);
        let both = self.faces[0].union(self.faces[1]);
        let [entry, exit] = if touch { [both, both] } else { self.faces };
        let end = |i: usize, point, faces: FaceSet| {
            PartEnd::fast(
                self.t[i],
                point,
                self.clipped[i],
                faces.union(self.coplanar),
            )
        };
        SegmentClip {
            class: whole::class(touch, !self.coplanar.is_empty(), clipped),
            part: Some(Part {
                entry: end(0, first, entry),
                exit: end(1, last, exit),
                coplanar: self.coplanar,
            }),
        }
    }
}

#[inline(always)]
fn choose<T: Real>(condition: bool, a: Vec3<T>, b: Vec3<T>) -> Vec3<T> {
    Vec3::new(
        if condition { a.x } else { b.x },
        if condition { a.y } else { b.y },
        if condition { a.z } else { b.z },
    )
}

/// A plain algorithm over frame coordinates.
pub(crate) trait InFrame {
    /// Clips.
    fn clip<T: Real, L: Layout>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T>;
}

/// Runs an algorithm in the form of the frustum.
#[inline(always)]
pub(crate) fn in_frame<A: InFrame, T: Real>(
    f: &PlainFrustum<T>,
    segment: &Segment<T>,
) -> SegmentClip<T> {
    match f.form {
        Form::Symmetric => A::clip::<T, Symmetric<true>>(f, segment),
        Form::General => A::clip::<T, General<true>>(f, segment),
        Form::Orthographic => A::clip::<T, Orthographic>(f, segment),
        Form::InfiniteSymmetric => A::clip::<T, Symmetric<false>>(f, segment),
        Form::Infinite => A::clip::<T, General<false>>(f, segment),
    }
}
