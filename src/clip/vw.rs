//! Projection reduction onto two planes ("V/W").
//!
//! Source: the method that reduces clipping by a frustum to clipping twice in a
//! plane, by the frustum's projections on its two symmetry planes.
//!
//! ```text
//! to the computing frame
//! V (x, z): values of near, far, left, right at both ends; apart from the trapezoid TV: outside
//! W (y, z): values of bottom, top; near and far are shared; apart from TW: outside
//! intersect the parameter intervals of V and W
//! ```
//!
//! One half-width serves two opposite sides of a symmetric frustum, and what V
//! has computed is not computed again for W.
use super::SegmentClipper;
use super::plain::{self, Found, max, min};
use super::result::SegmentClip;
use crate::frustum::{
    FaceSet, Form, Frustum, General, Layout, Orthographic, PlainFrustum, Symmetric,
};
use crate::math::{NonFinite, Real, Segment};

/// Clipping by projection on two planes.
#[derive(Clone, Copy, Debug)]
pub struct VwProjection {
    _arithmetic: (),
}

impl VwProjection {
    /// In floating point of the segment's own type.
    #[inline(always)]
    pub const fn plain() -> Self {
        Self { _arithmetic: () }
    }
}

impl<T: Real> SegmentClipper<T> for VwProjection {
    fn name(&self) -> &'static str {
        "vw"
    }

    #[inline]
    fn clip_segment(
        &self,
        frustum: &Frustum,
        segment: &Segment<T>,
    ) -> Result<SegmentClip<T>, NonFinite> {
        plain::run(frustum, segment, clip)
    }
}

#[inline(always)]
fn clip<T: Real>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T> {
    match f.form {
        Form::Symmetric => clip_in::<T, Symmetric<true>>(f, segment),
        Form::General => clip_in::<T, General<true>>(f, segment),
        Form::Orthographic => clip_in::<T, Orthographic>(f, segment),
        Form::InfiniteSymmetric => clip_in::<T, Symmetric<false>>(f, segment),
        Form::Infinite => clip_in::<T, General<false>>(f, segment),
    }
}

#[inline(always)]
fn clip_in<T: Real, L: Layout>(f: &PlainFrustum<T>, segment: &Segment<T>) -> SegmentClip<T> {
    let zero = T::ZERO;
    let p = f.to_frame(segment.start);
    let q = f.to_frame(segment.end);
    let (zp, zq) = (f.sign * p.z, f.sign * q.z);
    let (wp, wq) = (zp - f.near, zq - f.near);
    let (fp, fq) = if L::FAR {
        (f.far - zp, f.far - zq)
    } else {
        (T::ONE, T::ONE)
    };
    let [lp, rp] = L::sides(&f.bounds, &f.slopes, 0, wp, p.x);
    let [lq, rq] = L::sides(&f.bounds, &f.slopes, 0, wq, q.x);
    let m = min(min(max(wp, wq), max(fp, fq)), min(max(lp, lq), max(rp, rq)));
    if m < zero {
        return SegmentClip::OUTSIDE;
    }
    let [bp, tp] = L::sides(&f.bounds, &f.slopes, 2, wp, p.y);
    let [bq, tq] = L::sides(&f.bounds, &f.slopes, 2, wq, q.y);
    if min(max(bp, bq), max(tp, tq)) < zero {
        return SegmentClip::OUTSIDE;
    }
    let a = [wp, fp, lp, rp, bp, tp];
    let b = [wq, fq, lq, rq, bq, tq];
    let least_a = min(min(min(wp, fp), min(lp, rp)), min(bp, tp));
    let least_b = min(min(min(wq, fq), min(lq, rq)), min(bq, tq));
    if min(least_a, least_b) > zero {
        return plain::inside(segment);
    }
    cross(a, b, [least_a < zero, least_b < zero], segment)
}

#[inline(always)]
fn cross<T: Real>(
    a: [T; 6],
    b: [T; 6],
    clipped: [bool; 2],
    segment: &Segment<T>,
) -> SegmentClip<T> {
    let mut t = [T::ZERO; 6];
    for i in 0..6 {
        t[i] = a[i] / (a[i] - b[i]);
    }
    let mut e = [T::ZERO; 6];
    let mut l = [T::ZERO; 6];
    for i in 0..6 {
        e[i] = if a[i] > T::ZERO { -T::ONE } else { t[i] };
        l[i] = if b[i] > T::ZERO {
            T::ONE + T::ONE
        } else {
            t[i]
        };
    }
    let t0 = max(
        max(max(e[0], e[1]), max(e[2], e[3])),
        max(max(e[4], e[5]), T::ZERO),
    );
    let t1 = min(
        min(min(l[0], l[1]), min(l[2], l[3])),
        min(min(l[4], l[5]), T::ONE),
    );
    if t0 > t1 {
        return SegmentClip::OUTSIDE;
    }
    let (mut enter, mut leave, mut coplanar) = (0u8, 0u8, 0u8);
    for i in 0..6 {
        enter |= u8::from(e[i] >= t0) << i;
        leave |= u8::from(l[i] <= t1) << i;
        coplanar |= u8::from((a[i] == T::ZERO) & (b[i] == T::ZERO)) << i;
    }
    Found {
        t: [t0, t1],
        clipped,
        faces: [FaceSet::from_bits(enter), FaceSet::from_bits(leave)],
        coplanar: FaceSet::from_bits(coplanar),
    }
    .build(segment)
}
