//! Drawing what clipping made of segments, by many workers at a time.

use super::density::Density;
use super::layer::Layer;
use super::options::{Options, View};
use super::outside::Outside;
use super::projector::Projector;
use super::strokes::Stroke;
use crate::failure::Failure;
use crate::input::Bounds;
use crate::number::Scalar;
use frusta::{Class, Frustum, Segment, SegmentClip, Vec3};
use std::sync::atomic::{AtomicBool, Ordering};

/// Around the drawing, and the width that is meant, in the picture's units
/// (pixels of a picture of the default width).
const MARGIN: f64 = 28.0;
pub(super) const DEFAULT_WIDTH: f64 = 1200.0;
/// Text stays this large, of its size in a picture of the default width.
const LEAST_UNIT: f64 = 0.5;
/// Marks in a density picture, in the picture's units.
const CUT_RADIUS: f64 = 0.75;
const TOUCH_RADIUS: f64 = 2.6;

/// What all workers draw on.
#[derive(Debug)]
pub(crate) struct Canvas {
    pub(super) options: Options,
    /// The picture's own pixel, in pixels.
    pub(super) unit: f64,
    pub(super) projector: Projector,
    pub(super) outside: Option<Outside>,
    pub(super) density: Density,
    /// Whether there are too many strokes to keep.
    pub(super) crowded: AtomicBool,
}

/// What a worker drew of its chunk.
#[derive(Debug, Default)]
pub(crate) struct Traced {
    /// Empty once there are too many.
    pub(super) strokes: Vec<Stroke>,
    /// Of these the marks; kept as long as they are few.
    pub(super) marks: Vec<Stroke>,
    /// How many there were, kept or not; of these, marks at clipped ends.
    pub(super) count: u64,
    pub(super) cuts: u64,
}

impl Canvas {
    /// A blank canvas. `scene` is a box around everything, if known; only the
    /// view from outside uses it.
    pub(crate) fn new(
        options: Options,
        frustum: &Frustum,
        scene: Option<&Bounds>,
    ) -> Result<Self, Failure> {
        let outside = match options.view {
            View::Camera => None,
            View::Outside => Some(Outside::new(frustum, scene)?),
        };
        let width = f64::from(options.width);
        let unit = (width / DEFAULT_WIDTH).max(LEAST_UNIT);
        let shown = outside.as_ref().map_or(frustum, |o| &o.frustum);
        let projector = Projector::new(shown, width - 2.0 * (MARGIN * unit).round());
        Ok(Self {
            options,
            unit,
            density: Density::new(projector.size().map(|s| s as usize)),
            projector,
            outside,
            crowded: AtomicBool::new(false),
        })
    }

    /// Around the drawing, in whole pixels.
    pub(super) fn margin(&self) -> f64 {
        (MARGIN * self.unit).round()
    }

    /// Draws what became of some segments.
    pub(crate) fn trace<T: Scalar>(
        &self,
        segments: &[Segment<T>],
        clips: &[SegmentClip<T>],
    ) -> Traced {
        let mut pen = Pen {
            canvas: self,
            keep: !self.crowded.load(Ordering::Relaxed),
            traced: Traced::default(),
        };
        match &self.outside {
            None => clips.iter().for_each(|clip| pen.part(clip)),
            Some(outside) => segments
                .iter()
                .zip(clips)
                .for_each(|(segment, clip)| pen.whole(&outside.frustum, segment, clip)),
        }
        pen.traced
    }
}

/// Draws on a canvas.
struct Pen<'a> {
    canvas: &'a Canvas,
    keep: bool,
    traced: Traced,
}

impl Pen<'_> {
    /// The part inside, as the camera sees it.
    fn part<T: Scalar>(&mut self, clip: &SegmentClip<T>) {
        let Some(part) = &clip.part else {
            return;
        };
        let [a, b] = [part.entry.point.to_f64(), part.exit.point.to_f64()];
        if clip.class == Class::Touch {
            self.mark(Layer::Touch, a);
            return;
        }
        self.line(Layer::of(clip.class), a, b);
        for end in [&part.entry, &part.exit] {
            if end.clipped {
                self.mark(Layer::Cut, end.point.to_f64());
            }
        }
    }

    /// All of a segment, as the onlooker sees it.
    fn whole<T: Scalar>(
        &mut self,
        onlooker: &Frustum,
        segment: &Segment<T>,
        clip: &SegmentClip<T>,
    ) {
        let Some(part) = &clip.part else {
            self.piece(onlooker, Layer::Outside, segment);
            return;
        };
        let (entry, exit) = (&part.entry, &part.exit);
        let in_view = |p: Vec3<T>| onlooker.contains(p).unwrap_or(false);
        if clip.class == Class::Touch {
            self.piece(onlooker, Layer::Outside, segment);
            if in_view(entry.point) {
                self.mark(Layer::Touch, entry.point.to_f64());
            }
            return;
        }
        let inside = Segment::new(entry.point, exit.point);
        self.piece(onlooker, Layer::of(clip.class), &inside);
        for (end, beyond) in [(entry, segment.start), (exit, segment.end)] {
            if end.clipped {
                self.piece(onlooker, Layer::Rest, &Segment::new(beyond, end.point));
                if in_view(end.point) {
                    self.mark(Layer::Cut, end.point.to_f64());
                }
            }
        }
    }

    /// What the onlooker sees of a piece.
    fn piece<T: Scalar>(&mut self, onlooker: &Frustum, layer: Layer, piece: &Segment<T>) {
        let seen = onlooker.clip_segment(piece).ok().and_then(|c| c.part);
        if let Some(part) = seen {
            self.line(layer, part.entry.point.to_f64(), part.exit.point.to_f64());
        }
    }

    fn line(&mut self, layer: Layer, a: Vec3<f64>, b: Vec3<f64>) {
        let Self {
            canvas,
            keep,
            traced,
        } = self;
        // Rare layers are seen at any depth.
        let by_depth = layer == Layer::Inside && canvas.outside.is_none();
        canvas.projector.pieces(a, b, |from, to, weight| {
            let weight = if by_depth { weight } else { 1.0 };
            canvas.density.line(layer, from, to, weight);
            traced.count += 1;
            if *keep {
                traced.strokes.push(Stroke { layer, from, to });
            }
        });
    }

    fn mark(&mut self, layer: Layer, point: Vec3<f64>) {
        let place = self.canvas.projector.place(point);
        let (radius, cuts) = match layer {
            Layer::Touch => (TOUCH_RADIUS, 0),
            _ => (CUT_RADIUS, 1),
        };
        let radius = (radius * self.canvas.unit) as f32;
        self.canvas.density.disc(layer, place, radius);
        self.traced.count += 1;
        self.traced.cuts += cuts;
        let mark = Stroke {
            layer,
            from: place,
            to: place,
        };
        if self.keep {
            self.traced.strokes.push(mark);
        }
        self.traced.marks.push(mark);
    }
}
