//! Projection reduction onto two planes ("V/W").
//!
//! # Source
//! "View Frustum Culling Geometric Algorithm" (视锥体裁剪几何算法研究, in Chinese):
//! the method that reduces clipping by a frustum to clipping twice in a plane,
//! by the frustum's projections on its two symmetry planes: the trapezoids TV
//! (in `x, z`) and TW (in `y, z`).
//!
//! # Idea
//! ```text
//! to the computing frame
//! V: values of near, far, left, right at both ends; a face with two negative ones: outside
//! W: values of bottom, top (near and far are V's);  a face with two negative ones: outside
//! all values positive: inside
//! parameters of the crossed sides of TV and TW; intersect the two intervals
//! the points at the interval's ends, in the input's coordinates
//! ```
//! One half-width serves two opposite sides of a symmetric frustum, and W uses the
//! values that V has computed.
//!
//! # Deviations
//! 1. Points are interpolated in the input's coordinates; the paper transforms
//!    clipped frame points back, which rounds once more for nothing.
//! 2. In plain arithmetic the intervals of V and W are one interval over six
//!    faces, and all six divisions are done, two at a time, with selections
//!    instead of branches: most of the time of a textbook clipper is spent on
//!    mispredicted branches. W is still skipped where V rejects, and coplanar
//!    faces, which are rare, are looked for only where the larger of some
//!    face's two values is zero.
//!
//! # Complexity
//! Constant: 12 values at most; 6 divisions, or none if the segment is rejected or accepted.
//!
//! # Degenerate input
//! Zero values at the ends are touches, which count as hits; two of them are a
//! coplanar face, whose parameter 0/0 is never chosen. A segment of zero length
//! has only equal values, so no face is crossed. In plain arithmetic all this
//! is subject to rounding; in exact arithmetic signs decide.

use super::plain::{self, Found, InFrame, max, min};
use super::result::{Accuracy, Arithmetic, SegmentClip, StageCounts};
use super::whole::{inside, outside};
use super::{SegmentClipper, exact, many};
use crate::frustum::{Face, FaceSet, Frustum, Layout, PlainFrustum};
use crate::math::{NonFinite, NonFiniteAt, Real, Segment};
use crate::simd::Level;

/// Clips by projection on two planes ("V/W").
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VwProjection {
    /// The arithmetic of its decisions.
    pub arithmetic: Arithmetic,
}

impl VwProjection {
    /// Decisions in floating point of the segment's own type.
    #[must_use]
    pub const fn plain() -> Self {
        Self {
            arithmetic: Arithmetic::Plain,
        }
    }

    /// Exact decisions.
    #[must_use]
    pub const fn exact(accuracy: Accuracy) -> Self {
        Self {
            arithmetic: Arithmetic::Exact(accuracy),
        }
    }
}

impl<T: Real> SegmentClipper<T> for VwProjection {
    fn name(&self) -> &'static str {
        "vw"
    }

    #[inline]
    fn clip_segment_counted(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        match self.arithmetic {
            Arithmetic::Plain => clip_plain(frustum, segment),
            Arithmetic::Exact(accuracy) => exact::vw::clip(frustum, segment, accuracy, counts),
        }
    }

    fn clip_segments_counted(
        &self,
        frustum: &Frustum,
        segments: &[Segment<T>],
        clips: &mut Vec<SegmentClip<T>>,
        counts: &mut StageCounts,
    ) -> Result<(), NonFiniteAt> {
        let level = Level::new();
        match self.arithmetic {
            Arithmetic::Plain => many::clip_plain(level, frustum, segments, clips),
            Arithmetic::Exact(accuracy) => {
                let segments = segments.into();
                many::clip_exact(level, frustum, segments, accuracy, clips, counts)
            }
        }
    }
}

/// Clips a segment in plain arithmetic.
#[inline]
pub(super) fn clip_plain<T: Real>(
    frustum: &Frustum,
    segment: &Segment<T>,
) -> Result<SegmentClip<T>, NonFinite> {
    plain::run(frustum, segment, plain::in_frame::<Plain, T>)
}

/// The far face's bit.
const FAR: u8 = 1 << Face::Far as u8;

/// V/W in plain arithmetic, for a frustum's form.
pub(crate) struct Plain;

impl InFrame for Plain {
    #[inline(always)]
    fn clip<T: Real, L: Layout>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T> {
        let zero = T::ZERO;
        let p = f.to_frame(segment.start);
        let q = f.to_frame(segment.end);
        let ([wp, fp], [wq, fq]) = (f.depths::<L>(p.z), f.depths::<L>(q.z));
        // Where there is no far face, its lane repeats the near one: with constants
        // there the compiler would not pair the divisions.
        let (fp, fq) = if L::FAR { (fp, fq) } else { (wp, wq) };
        let [lp, rp] = f.sides::<L>(0, wp, p.x);
        let [lq, rq] = f.sides::<L>(0, wq, q.x);
        let v = min(min(max(wp, wq), max(fp, fq)), min(max(lp, lq), max(rp, rq)));
        if v < zero {
            return outside();
        }
        let [bp, tp] = f.sides::<L>(2, wp, p.y);
        let [bq, tq] = f.sides::<L>(2, wq, q.y);
        let w = min(max(bp, bq), max(tp, tq));
        if w < zero {
            return outside();
        }
        let least_p = min(min(min(wp, fp), min(lp, rp)), min(bp, tp));
        let least_q = min(min(min(wq, fq), min(lq, rq)), min(bq, tq));
        if min(least_p, least_q) > zero {
            return inside(segment);
        }
        let values = [[wp, fp, lp, rp, bp, tp], [wq, fq, lq, rq, bq, tq]];
        let coplanar = if min(v, w) > zero {
            FaceSet::EMPTY
        } else {
            both_zero(&values)
        };
        cross::<T, L>(values, [least_p < zero, least_q < zero], coplanar, segment)
    }
}

/// The faces with two zero values.
#[inline(never)]
fn both_zero<T: Real>([a, b]: &[[T; 6]; 2]) -> FaceSet {
    // No branches: which faces cannot be predicted.
    let on = |i: usize| (a[i] == T::ZERO) & (b[i] == T::ZERO);
    FaceSet::from_bits((0..6).fold(0, |bits, i| bits | u8::from(on(i)) << i))
}

/// For six values at each end: clips where they change sign.
#[inline(always)]
fn cross<T: Real, L: Layout>(
    [a, b]: [[T; 6]; 2],
    clipped: [bool; 2],
    coplanar: FaceSet,
    segment: &Segment<T>,
) -> SegmentClip<T> {
    let two = T::ONE + T::ONE;
    let (mut enter, mut leave) = ([-T::ONE; 6], [two; 6]);
    for i in 0..6 {
        let t = a[i] / (a[i] - b[i]);
        // The parameters of a face that is not crossed change nothing; nor does
        // 0/0.
        enter[i] = max(if a[i] > T::ZERO { -T::ONE } else { t }, -T::ONE);
        leave[i] = min(if b[i] > T::ZERO { two } else { t }, two);
    }
    let (e, l) = (&enter, &leave);
    let t0 = max(
        max(max(e[0], e[1]), max(e[2], e[3])),
        max(max(e[4], e[5]), T::ZERO),
    );
    let t1 = min(
        min(min(l[0], l[1]), min(l[2], l[3])),
        min(min(l[4], l[5]), T::ONE),
    );
    if t0 > t1 {
        return outside();
    }
    let (mut entered, mut left) = (0_u8, 0_u8);
    for i in 0..6 {
        entered |= u8::from(enter[i] >= t0) << i;
        left |= u8::from(leave[i] <= t1) << i;
    }
    let existing = |bits| FaceSet::from_bits(if L::FAR { bits } else { bits & !FAR });
    Found {
        t: [t0, t1],
        clipped,
        faces: [existing(entered), existing(left)],
        coplanar: existing(coplanar.bits()),
    }
    .build(segment)
}
