//! A picture of segments and their clips.
//!
//! ```text
//! workers: project each piece; hand on the strokes
//! writer:  collects strokes in order; once there are more than MOST_STROKES, adds
//!          their ink to the density instead
//! end:     few strokes become vectors, many the density as an embedded image;
//!          few marks, frame, wireframe and caption are vectors in any case
//! ```
//!
//! So that memory has a bound, and the file does not depend on threads.

use super::caption::{self, Area, Entry, Sample};
use super::density::Density;
use super::layer::Layer;
use super::strokes::{self, STEPS, Stroke};
use super::tone;
use super::tracer::{DEFAULT_WIDTH, Traced, Tracer};
use super::wireframe::Wireframe;
use crate::draw::svg::Svg;
use crate::draw::{Palette, Theme};
use crate::failure::Failure;
use frusta::Class;
use std::sync::Arc;

/// More are drawn as density.
const MOST_STROKES: u64 = 20_000;
/// Strokes that are added to the density at a time.
const BATCH: usize = 1 << 16;
/// More marks on a density would hide it.
const MOST_MARKS: usize = 400;
/// Marks on a density, in the picture's units.
const CUT_RADIUS: f64 = 0.75;
const TOUCH_RADIUS: f64 = 2.6;
/// The least width of the page, in the picture's units.
const LEAST_WIDTH: f64 = 560.0;

/// A picture in the making.
pub(crate) struct Picture {
    tracer: Arc<Tracer>,
    /// Once there are too many, those that are not in the density yet.
    strokes: Vec<Stroke>,
    density: Density,
    /// `None` once there are too many.
    marks: Option<Vec<Stroke>>,
    count: u64,
    cuts: u64,
}

impl Picture {
    /// A picture of what will be drawn on a canvas.
    pub(crate) fn new(tracer: Arc<Tracer>) -> Self {
        Self {
            density: Density::new(tracer.projector.size().map(|s| s as usize)),
            tracer,
            strokes: Vec::new(),
            marks: Some(Vec::new()),
            count: 0,
            cuts: 0,
        }
    }

    /// Adds the next chunk's strokes.
    pub(crate) fn add(&mut self, traced: &Traced) {
        let is_mark = |s: &&Stroke| matches!(s.layer, Layer::Cut | Layer::Touch);
        let marks = || traced.strokes.iter().filter(is_mark);
        self.count += traced.strokes.len() as u64;
        self.cuts += marks().filter(|s| s.layer == Layer::Cut).count() as u64;
        let room = |kept: &Vec<Stroke>| kept.len() + marks().count() <= MOST_MARKS;
        self.marks = self.marks.take().filter(room);
        if let Some(kept) = &mut self.marks {
            kept.extend(marks());
        }
        self.strokes.extend_from_slice(&traced.strokes);
        if self.is_crowded() && self.strokes.len() >= BATCH {
            self.ink();
        }
    }

    /// Moves the strokes to the density.
    fn ink(&mut self) {
        let unit = self.tracer.unit;
        self.density.add(&self.strokes, |layer| match layer {
            Layer::Touch => Some((TOUCH_RADIUS * unit) as f32),
            Layer::Cut => Some((CUT_RADIUS * unit) as f32),
            _ => None,
        });
        self.strokes.clear();
    }

    fn is_crowded(&self) -> bool {
        self.count > MOST_STROKES
    }

    /// The picture as SVG. `classes`: the number of segments by class.
    pub(crate) fn svg(mut self, title: &str, classes: &[u64; 5]) -> Result<String, Failure> {
        if self.is_crowded() {
            self.ink();
        }
        let Tracer {
            options,
            unit,
            projector,
            ..
        } = &*self.tracer;
        let palette = options.theme.palette();
        let ([w, h], margin) = (projector.size(), self.tracer.margin());
        let least = (LEAST_WIDTH / DEFAULT_WIDTH * f64::from(options.width)).round();
        let page_w = (w + 2.0 * margin).max(least);
        let left = ((page_w - w) / 2.0).round();
        let mut text = Svg::new();
        let area = Area {
            left: margin,
            top: margin + h,
            room: page_w - 2.0 * margin,
            unit: *unit,
        };
        let entries = self.legend(classes, palette);
        let bottom = caption::draw(&mut text, title, &entries, palette, area);
        let page_h = (bottom + 0.5 * margin).ceil();
        let mut svg = Svg::new();
        let page = svg.document();
        page.attribute("width", page_w)
            .attribute("height", page_h)
            .attribute("viewBox", format_args!("0 0 {page_w} {page_h}"))
            .open();
        let page = svg.element("rect").attribute("width", "100%");
        page.attribute("height", "100%")
            .attribute("fill", palette.page)
            .empty();
        let corner = [left, margin];
        let paper = svg.element("rect").rectangle(corner, [w, h]);
        paper.attribute("fill", palette.paper).empty();
        let moved = format!("translate({left} {margin})");
        let drawing = svg.element("g").attribute("transform", moved);
        drawing.attribute("fill", "none").open();
        self.draw(&mut svg, palette)?;
        svg.close("g");
        let frame = svg.element("rect").rectangle(corner, [w, h]);
        frame
            .attribute("fill", "none")
            .attribute("stroke", palette.ink)
            .attribute("stroke-width", format_args!("{:.1}", 1.5 * unit))
            .empty();
        svg.append(&text);
        svg.close("svg");
        Ok(svg.finish())
    }

    /// Everything within the frame.
    fn draw(&self, svg: &mut Svg, palette: &Palette) -> Result<(), Failure> {
        let tracer = &*self.tracer;
        let wires = tracer
            .outside
            .as_ref()
            .map(|outside| Wireframe::new(outside, &tracer.projector, palette, tracer.unit));
        if self.is_crowded() {
            let [w, h] = tracer.projector.size();
            let image = svg.element("image").attribute("width", w);
            image
                .attribute("height", h)
                .attribute("href", tone::image(&self.density, palette)?)
                .empty();
        }
        if let Some(wires) = &wires {
            wires.draw_faces(svg);
        }
        let vectors = if self.is_crowded() {
            self.marks.as_deref().unwrap_or_default()
        } else {
            &self.strokes
        };
        let scaled = format!("scale({})", 1.0 / STEPS);
        let group = svg.element("g").attribute("transform", scaled);
        group
            .attribute("stroke-linecap", "round")
            .attribute("stroke-linejoin", "round")
            .open();
        strokes::draw(svg, vectors, palette, tracer.unit);
        svg.close("g");
        if let Some(wires) = &wires {
            wires.draw_edges(svg);
        }
        Ok(())
    }

    /// The legend.
    fn legend(&self, classes: &[u64; 5], palette: &Palette) -> Vec<Entry> {
        let from_outside = self.tracer.outside.is_some();
        let unit = self.tracer.unit;
        let line = |layer: Layer| Sample::Line(layer.style(palette), 1.8 * unit);
        let mut entries = Vec::new();
        for (class, count) in Class::ALL.into_iter().zip(classes) {
            let layer = Layer::of(class);
            let style = layer.style(palette);
            let sample = match layer {
                Layer::Touch => Sample::Circle {
                    radius: 4.0 * unit,
                    fill: style.colour,
                    outline: None,
                },
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
                sample: Sample::Circle {
                    radius: 4.0 * unit,
                    fill: palette.paper,
                    outline: Some((palette.cut, 1.5 * unit)),
                },
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
        let stronger = match self.tracer.options.theme {
            Theme::Light => "darker",
            Theme::Dark => "brighter",
        };
        Entry {
            sample: Sample::Ramp(tone::samples(Layer::Inside, palette, 12)),
            name: ("", ""),
            text: match self.tracer.outside {
                None => format!("density: {stronger} = more edges, or nearer"),
                Some(_) => format!("density: {stronger} = more edges"),
            },
        }
    }
}
