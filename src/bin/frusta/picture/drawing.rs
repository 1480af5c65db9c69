//! A picture of segments and what clipping made of them.
//!
//! ```text
//! workers: project each piece; add its ink to the density; hand on the stroke
//! writer:  collects strokes in order, until there are more than MOST_STROKES
//! end:     few strokes become vectors, many the density as an embedded image;
//!          frame, wireframe and caption are vectors in any case
//! ```
//!
//! So that memory has a bound, and the file does not depend on threads.

use super::caption::{self, Area, Entry, Sample};
use super::density::Density;
use super::layer::Layer;
use super::options::{Options, View};
use super::outside::Outside;
use super::projector::Projector;
use super::strokes::{self, STEPS, Stroke};
use super::{Palette, Theme, tone, wireframe};
use crate::failure::Failure;
use crate::input::Bounds;
use crate::number::Scalar;
use frusta::{Class, Frustum, Segment, SegmentClip, Vec3};
use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// More are drawn as density.
const MOST_STROKES: u64 = 20_000;
/// Around the drawing, and the least width of the page, in the picture's units
/// (pixels of a picture of the default width).
const MARGIN: f64 = 28.0;
const LEAST_WIDTH: f64 = 560.0;
const DEFAULT_WIDTH: f64 = 1200.0;
/// Text stays this large, of its size in a picture of the default width.
const LEAST_UNIT: f64 = 0.5;
/// Marks in a density picture, in the picture's units.
const CUT_RADIUS: f64 = 0.75;
const TOUCH_RADIUS: f64 = 2.6;

/// What all workers draw on.
#[derive(Debug)]
pub(crate) struct Canvas {
    options: Options,
    /// The picture's own pixel, in pixels.
    unit: f64,
    projector: Projector,
    outside: Option<Outside>,
    density: Density,
    /// Whether there are too many strokes to keep.
    crowded: AtomicBool,
}

/// What a worker drew of its chunk.
#[derive(Debug, Default)]
pub(crate) struct Traced {
    /// Empty once there are too many.
    strokes: Vec<Stroke>,
    /// How many there were, kept or not; of these, marks at clipped ends.
    count: u64,
    cuts: u64,
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
        let projector = Projector::new(shown, width - 2.0 * margin(unit));
        Ok(Self {
            options,
            unit,
            density: Density::new(projector.size().map(|s| s as usize)),
            projector,
            outside,
            crowded: AtomicBool::new(false),
        })
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

fn margin(unit: f64) -> f64 {
    (MARGIN * unit).round()
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
        if self.keep {
            self.traced.strokes.push(Stroke {
                layer,
                from: place,
                to: place,
            });
        }
    }
}

/// A picture in the making.
pub(crate) struct Picture {
    canvas: Arc<Canvas>,
    strokes: Vec<Stroke>,
    count: u64,
    cuts: u64,
}

impl Picture {
    /// A picture of what will be drawn on a canvas.
    pub(crate) fn new(canvas: Arc<Canvas>) -> Self {
        Self {
            canvas,
            strokes: Vec::new(),
            count: 0,
            cuts: 0,
        }
    }

    /// Adds the next chunk's strokes.
    pub(crate) fn add(&mut self, traced: &Traced) {
        self.count += traced.count;
        self.cuts += traced.cuts;
        if self.is_crowded() {
            self.canvas.crowded.store(true, Ordering::Relaxed);
            self.strokes = Vec::new();
        } else {
            self.strokes.extend_from_slice(&traced.strokes);
        }
    }

    fn is_crowded(&self) -> bool {
        self.count > MOST_STROKES
    }

    /// The picture as SVG. `classes`: the number of segments by class.
    pub(crate) fn svg(&self, title: &str, classes: &[u64; 5]) -> Result<String, Failure> {
        let Canvas {
            options,
            unit,
            projector,
            ..
        } = &*self.canvas;
        let palette = options.theme.palette();
        let ([w, h], margin) = (projector.size(), margin(*unit));
        let least = (LEAST_WIDTH / DEFAULT_WIDTH * f64::from(options.width)).round();
        let page_w = (w + 2.0 * margin).max(least);
        let left = ((page_w - w) / 2.0).round();
        let mut text = String::new();
        let area = Area {
            left: margin,
            top: margin + h,
            room: page_w - 2.0 * margin,
            unit: *unit,
        };
        let entries = self.legend(classes, palette);
        let bottom = caption::draw(&mut text, title, &entries, palette, area);
        let page_h = (bottom + 0.5 * margin).ceil();
        let mut svg = String::new();
        // Writing into memory cannot fail.
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{page_w}\" height=\"{page_h}\" \
             viewBox=\"0 0 {page_w} {page_h}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n\
             <rect x=\"{left}\" y=\"{margin}\" width=\"{w}\" height=\"{h}\" fill=\"{}\"/>\n",
            palette.page, palette.paper
        );
        let _ = writeln!(
            svg,
            "<g transform=\"translate({left} {margin})\" fill=\"none\">"
        );
        self.draw(&mut svg, palette)?;
        let _ = writeln!(
            svg,
            "</g>\n<rect x=\"{left}\" y=\"{margin}\" width=\"{w}\" height=\"{h}\" fill=\"none\" \
             stroke=\"{}\" stroke-width=\"{:.1}\"/>",
            palette.ink,
            1.5 * unit
        );
        svg.push_str(&text);
        svg.push_str("</svg>\n");
        Ok(svg)
    }

    /// Everything within the frame.
    fn draw(&self, svg: &mut String, palette: &Palette) -> Result<(), Failure> {
        let canvas = &*self.canvas;
        let wires = canvas.outside.as_ref().map(|outside| {
            wireframe::Wireframe::new(outside, &canvas.projector, palette, canvas.unit)
        });
        if self.is_crowded() {
            let [w, h] = canvas.projector.size();
            let _ = writeln!(
                svg,
                "<image width=\"{w}\" height=\"{h}\" href=\"{}\"/>",
                tone::image(&canvas.density, palette)?
            );
        }
        if let Some(wires) = &wires {
            wires.draw_faces(svg);
        }
        if !self.is_crowded() {
            let _ = writeln!(
                svg,
                "<g transform=\"scale({})\" stroke-linecap=\"round\" stroke-linejoin=\"round\">",
                1.0 / STEPS
            );
            strokes::draw(svg, &self.strokes, palette, canvas.unit);
            svg.push_str("</g>\n");
        }
        if let Some(wires) = &wires {
            wires.draw_edges(svg);
        }
        Ok(())
    }

    /// What is to be said of each layer.
    fn legend(&self, classes: &[u64; 5], palette: &Palette) -> Vec<Entry> {
        let from_outside = self.canvas.outside.is_some();
        let unit = self.canvas.unit;
        let line =
            |layer: Layer| Sample::Line(strokes::attributes(layer.style(palette), 1.8 * unit));
        let mut entries = Vec::new();
        for (class, count) in Class::ALL.into_iter().zip(classes) {
            let layer = Layer::of(class);
            let style = layer.style(palette);
            let sample = match layer {
                Layer::Touch => {
                    Sample::Circle(format!("r=\"{:.1}\" fill=\"{}\"", 4.0 * unit, style.colour))
                }
                Layer::Outside if !from_outside => Sample::Nothing,
                _ => line(layer),
            };
            entries.push(Entry {
                sample,
                name: (layer.name(), style.colour),
                text: count.to_string(),
            });
        }
        if from_outside && self.cuts > 0 {
            entries.push(Entry {
                sample: line(Layer::Rest),
                name: ("", ""),
                text: "cut away".to_owned(),
            });
        }
        if self.cuts > 0 {
            entries.push(Entry {
                sample: Sample::Circle(format!(
                    "r=\"{:.1}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.1}\"",
                    4.0 * unit,
                    palette.paper,
                    palette.cut,
                    1.5 * unit
                )),
                name: ("cut points", palette.cut),
                text: self.cuts.to_string(),
            });
        }
        if self.is_crowded() {
            entries.push(self.density_note(palette));
        }
        entries
    }

    fn density_note(&self, palette: &Palette) -> Entry {
        let stronger = match self.canvas.options.theme {
            Theme::Light => "darker",
            Theme::Dark => "brighter",
        };
        Entry {
            sample: Sample::Ramp(tone::samples(Layer::Inside, palette, 12)),
            name: ("", ""),
            text: match self.canvas.outside {
                None => format!("density: {stronger} = more edges, or nearer"),
                Some(_) => format!("density: {stronger} = more edges"),
            },
        }
    }
}
