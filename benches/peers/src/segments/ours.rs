//! frusta's own clippers.

use super::{Found, part};
use crate::peer::{Contestant, Peer, Who, enter};
use frusta::{
    Accuracy, Frustum, LiangBarsky, LiangBarskyVariant, NonFinite, Real, Segment, SegmentClip,
    SegmentClipper, VwProjection,
};
use std::marker::PhantomData;

/// A clipper of frusta's and the frustum.
pub struct Ours<T, C> {
    clipper: C,
    function: &'static str,
    frustum: Frustum,
    scalar: PhantomData<T>,
}

impl<T: Real, C: SegmentClipper<T>> Ours<T, C> {
    /// One segment a call.
    pub fn new(frustum: &Frustum, clipper: C, function: &'static str) -> Self {
        Self {
            clipper,
            function,
            frustum: frustum.clone(),
            scalar: PhantomData,
        }
    }
}

/// The name of a scalar type.
fn scalar_name<T: Real>() -> &'static str {
    if T::DIGITS == f32::MANTISSA_DIGITS {
        "f32"
    } else {
        "f64"
    }
}

impl<T: Real, C: SegmentClipper<T>> Peer for Ours<T, C> {
    type Case = Segment<T>;
    type Input = Segment<T>;
    type Output<'a>
        = Result<SegmentClip<T>, NonFinite>
    where
        Self: 'a;

    fn who(&self) -> Who {
        Who {
            library: "frusta",
            function: self.function,
            scalar: scalar_name::<T>(),
            note: "",
        }
    }

    fn prepare(&self, segment: &Segment<T>) -> Segment<T> {
        *segment
    }

    fn run(&mut self, segment: &Segment<T>) -> Result<SegmentClip<T>, NonFinite> {
        self.clipper.clip_segment(&self.frustum, segment)
    }

    fn answer(&mut self, segment: &Segment<T>) -> Found<T> {
        match self.run(segment) {
            Err(_) => Found::Refused,
            Ok(clip) => match clip.points() {
                None => Found::Nothing,
                Some(points) => part(segment, points.map(|p| p.to_array())),
            },
        }
    }
}

/// The function that all times are compared with: exact-class V/W.
pub const REFERENCE: &str = "V/W, exact class, Fast";

/// Exact-class V/W, which all times are compared with.
pub fn reference<T: Real>(frustum: &Frustum) -> Ours<T, VwProjection> {
    Ours::new(frustum, VwProjection::exact(Accuracy::Fast), REFERENCE)
}

/// The clippers of frusta's that take part. A kernel over slices would be one more
/// [`Peer`] here, with a `pass` of its own.
pub fn contenders<'a, T: Real>(frustum: &Frustum) -> Vec<Box<dyn Contestant<Segment<T>> + 'a>> {
    let liang_barsky = LiangBarsky::plain;
    let inward = VwProjection::exact(Accuracy::Inward);
    let (textbook, tuned) = (LiangBarskyVariant::Textbook, LiangBarskyVariant::Tuned);
    vec![
        enter(reference(frustum)),
        enter(Ours::new(frustum, inward, "V/W, exact class, Inward")),
        enter(Ours::new(frustum, VwProjection::plain(), "V/W, plain")),
        enter(Ours::new(
            frustum,
            liang_barsky(tuned),
            "Liang-Barsky tuned, plain",
        )),
        enter(Ours::new(
            frustum,
            liang_barsky(textbook),
            "Liang-Barsky textbook, plain",
        )),
    ]
}
