//! frusta's own clippers.

use super::{Found, PIECE, part};
use crate::peer::{Contestant, Peer, Who, enter};
use frusta::clip::{LiangBarsky, LiangBarskyVariant, SegmentClipper, VwProjection};
use frusta::{Accuracy, Frustum, NonFinite, NonFiniteAt, Real, Segment, SegmentClip};
use std::hint::black_box;
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
            Ok(clip) => found(segment, &clip),
        }
    }
}

/// What a clip says.
fn found<T: Real>(segment: &Segment<T>, clip: &SegmentClip<T>) -> Found<T> {
    match clip.points() {
        None => Found::Nothing,
        Some(points) => part(segment, points.map(|p| p.to_array())),
    }
}

/// The same over slices, into a buffer that keeps its memory.
pub struct OursSlices<T, C> {
    inner: Ours<T, C>,
    clips: Vec<SegmentClip<T>>,
}

impl<T: Real, C: SegmentClipper<T>> OursSlices<T, C> {
    /// 1,024 segments a call.
    pub fn new(frustum: &Frustum, clipper: C, function: &'static str) -> Self {
        Self {
            inner: Ours::new(frustum, clipper, function),
            clips: Vec::with_capacity(PIECE),
        }
    }

    /// A call like any other.
    #[inline(never)]
    fn clip(&mut self, segments: &[Segment<T>]) -> Result<&[SegmentClip<T>], NonFiniteAt> {
        let Ours {
            clipper, frustum, ..
        } = &self.inner;
        clipper.clip_segments(frustum, segments, &mut self.clips)?;
        Ok(&self.clips)
    }
}

impl<T: Real, C: SegmentClipper<T>> Peer for OursSlices<T, C> {
    type Case = Segment<T>;
    type Input = Segment<T>;
    type Output<'a>
        = Result<&'a [SegmentClip<T>], NonFiniteAt>
    where
        Self: 'a;

    fn who(&self) -> Who {
        Who {
            note: "clip_segments of 1,024 segments a call",
            ..self.inner.who()
        }
    }

    fn prepare(&self, segment: &Segment<T>) -> Segment<T> {
        *segment
    }

    fn run(&mut self, segment: &Segment<T>) -> Result<&[SegmentClip<T>], NonFiniteAt> {
        self.clip(std::slice::from_ref(segment))
    }

    fn answer(&mut self, segment: &Segment<T>) -> Found<T> {
        match self.run(segment) {
            Ok([clip]) => found(segment, clip),
            _ => Found::Refused,
        }
    }

    /// Judged as they are timed: a piece a call.
    fn answers(&mut self, segments: &[Segment<T>]) -> Vec<Found<T>> {
        let mut all = Vec::with_capacity(segments.len());
        for piece in segments.chunks(PIECE) {
            match self.clip(piece) {
                Ok(clips) if clips.len() == piece.len() => {
                    all.extend(piece.iter().zip(clips).map(|(s, clip)| found(s, clip)));
                }
                _ => all.extend(piece.iter().map(|_| Found::Refused)),
            }
        }
        all
    }

    fn pass(&mut self, segments: &[Segment<T>]) {
        for piece in segments.chunks(PIECE) {
            let _ = black_box(self.clip(piece));
        }
    }
}

/// The function that all times are compared with: exact-class V/W.
pub const REFERENCE: &str = "V/W, exact class, Fast";

/// The same over slices.
pub const REFERENCE_SLICES: &str = "V/W, exact class, Fast, slices";

/// Exact-class V/W, which all times are compared with.
pub fn reference<T: Real>(frustum: &Frustum) -> Ours<T, VwProjection> {
    Ours::new(frustum, VwProjection::exact(Accuracy::Fast), REFERENCE)
}

/// The clippers of frusta's that take part, each alone and over slices.
pub fn contenders<'a, T: Real>(frustum: &Frustum) -> Vec<Box<dyn Contestant<Segment<T>> + 'a>> {
    let [fast, inward] = [Accuracy::Fast, Accuracy::Inward].map(VwProjection::exact);
    let vw = VwProjection::plain();
    let (tuned, textbook) = (LiangBarskyVariant::Tuned, LiangBarskyVariant::Textbook);
    let [tuned, textbook] = [tuned, textbook].map(LiangBarsky::plain);
    let (tuned_name, tuned_slices) = (
        "Liang-Barsky tuned, plain",
        "Liang-Barsky tuned, plain, slices",
    );
    let (textbook_name, textbook_slices) = (
        "Liang-Barsky textbook, plain",
        "Liang-Barsky textbook, plain, slices",
    );
    vec![
        enter(reference(frustum)),
        enter(Ours::new(frustum, inward, "V/W, exact class, Inward")),
        enter(Ours::new(frustum, vw, "V/W, plain")),
        enter(Ours::new(frustum, tuned, tuned_name)),
        enter(Ours::new(frustum, textbook, textbook_name)),
        enter(OursSlices::new(frustum, fast, REFERENCE_SLICES)),
        enter(OursSlices::new(frustum, vw, "V/W, plain, slices")),
        enter(OursSlices::new(frustum, tuned, tuned_slices)),
        enter(OursSlices::new(frustum, textbook, textbook_slices)),
    ]
}
