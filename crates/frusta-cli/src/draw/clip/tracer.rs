//! The strokes that show clipped segments; many workers trace at a time.

use super::layer::Layer;
use super::options::{Options, View};
use super::outside::Outside;
use super::projector::Projector;
use super::strokes::Stroke;
use crate::failure::Failure;
use crate::io::Bounds;
use crate::io::number::Scalar;
use frusta::{Class, Frustum, Segment, SegmentClip, Vec3};

/// Around the drawing, and the width that is meant, in the picture's units
/// (pixels of a picture of the default width).
const MARGIN: f64 = 28.0;
pub(super) const DEFAULT_WIDTH: f64 = 1200.0;
/// Text stays this large, of its size in a picture of the default width.
const LEAST_UNIT: f64 = 0.5;

/// Turns segments and their clips into strokes.
#[derive(Debug)]
pub(crate) struct Tracer {
    pub(super) options: Options,
    /// The picture's own pixel, in pixels.
    pub(super) unit: f64,
    pub(super) projector: Projector,
    pub(super) outside: Option<Outside>,
}

/// The strokes of a chunk.
#[derive(Debug, Default)]
pub(crate) struct Traced {
    pub(super) strokes: Vec<Stroke>,
}

impl Tracer {
    /// A tracer for a view of a frustum. `scene` is a box around everything, if known; only the
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
            projector,
            outside,
        })
    }

    /// Around the drawing, in whole pixels.
    pub(super) fn margin(&self) -> f64 {
        (MARGIN * self.unit).round()
    }

    /// The strokes of some segments.
    pub(crate) fn trace<T: Scalar>(
        &self,
        segments: &[Segment<T>],
        clips: &[SegmentClip<T>],
    ) -> Traced {
        let mut pen = Pen {
            tracer: self,
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

/// Collects strokes.
struct Pen<'a> {
    tracer: &'a Tracer,
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

    /// All of a segment, as the viewer sees it.
    fn whole<T: Scalar>(&mut self, viewer: &Frustum, segment: &Segment<T>, clip: &SegmentClip<T>) {
        let Some(part) = &clip.part else {
            self.piece(viewer, Layer::Outside, segment);
            return;
        };
        let (entry, exit) = (&part.entry, &part.exit);
        let in_view = |p: Vec3<T>| viewer.contains(p).unwrap_or(false);
        if clip.class == Class::Touch {
            self.piece(viewer, Layer::Outside, segment);
            if in_view(entry.point) {
                self.mark(Layer::Touch, entry.point.to_f64());
            }
            return;
        }
        let inside = Segment::new(entry.point, exit.point);
        self.piece(viewer, Layer::of(clip.class), &inside);
        for (end, beyond) in [(entry, segment.start), (exit, segment.end)] {
            if end.clipped {
                self.piece(viewer, Layer::Rest, &Segment::new(beyond, end.point));
                if in_view(end.point) {
                    self.mark(Layer::Cut, end.point.to_f64());
                }
            }
        }
    }

    /// The part of a piece that the viewer sees.
    fn piece<T: Scalar>(&mut self, viewer: &Frustum, layer: Layer, piece: &Segment<T>) {
        let seen = viewer.clip_segment(piece).ok().and_then(|c| c.part);
        if let Some(part) = seen {
            self.line(layer, part.entry.point.to_f64(), part.exit.point.to_f64());
        }
    }

    fn line(&mut self, layer: Layer, a: Vec3<f64>, b: Vec3<f64>) {
        // Rare layers are seen at any depth.
        let by_depth = layer == Layer::Inside && self.tracer.outside.is_none();
        let strokes = &mut self.traced.strokes;
        self.tracer.projector.pieces(a, b, |from, to, weight| {
            strokes.push(Stroke {
                layer,
                from,
                to,
                weight: if by_depth { weight } else { 1.0 },
            });
        });
    }

    fn mark(&mut self, layer: Layer, point: Vec3<f64>) {
        let place = self.tracer.projector.place(point);
        self.traced.strokes.push(Stroke {
            layer,
            from: place,
            to: place,
            weight: 1.0,
        });
    }
}
