//! The frustum itself, drawn in a view from outside: ends, sides, and its eye.

use super::Palette;
use super::outside::{Outside, Solid};
use super::projector::{Place, Projector};
use frusta::{Segment, Vec3};
use std::fmt::Write;

/// A frustum on its way into a picture.
pub(super) struct Wireframe<'a> {
    outside: &'a Outside,
    projector: &'a Projector,
    palette: &'a Palette,
    unit: f64,
}

impl<'a> Wireframe<'a> {
    /// A frustum's wireframe; `unit`: the picture's own pixel.
    pub(super) fn new(
        outside: &'a Outside,
        projector: &'a Projector,
        palette: &'a Palette,
        unit: f64,
    ) -> Self {
        Self {
            outside,
            projector,
            palette,
            unit,
        }
    }

    fn places(&self, points: [Vec3<f64>; 4]) -> [Place; 4] {
        points.map(|p| self.projector.place(p))
    }

    /// Near and far face as faint areas.
    pub(super) fn draw_faces(&self, svg: &mut String) {
        let Solid { near, end, .. } = self.outside.solid;
        for (points, opacity) in [(end, 0.05), (near, 0.1)] {
            // Writing into memory cannot fail.
            let _ = writeln!(
                svg,
                "<path fill=\"{}\" fill-opacity=\"{opacity}\" d=\"{}\"/>",
                self.palette.ink,
                ring(self.places(points))
            );
        }
    }

    /// All lines, the eye and the names of the ends.
    pub(super) fn draw_edges(&self, svg: &mut String) {
        let Solid {
            near, end, beyond, ..
        } = self.outside.solid;
        let ink = self.palette.ink;
        self.draw_eye(svg);
        let sides: String = near
            .iter()
            .zip(&end)
            .map(|(a, b)| self.line(*a, *b))
            .collect();
        let (width, dashes) = (1.6 * self.unit, dashes(6.0, 4.0, self.unit));
        let end_dashes = if beyond.is_some() { &dashes } else { "" };
        let _ = writeln!(
            svg,
            "<g class=\"frustum\" stroke=\"{ink}\" stroke-width=\"{width:.1}\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
             <path d=\"{sides}\"/>\n<path{end_dashes} d=\"{}\"/>\n\
             <path stroke-width=\"{:.1}\" d=\"{}\"/>",
            ring(self.places(end)),
            1.4 * width,
            ring(self.places(near))
        );
        if let Some(beyond) = beyond {
            let sides: String = end
                .iter()
                .zip(&beyond)
                .map(|(a, b)| self.line(*a, *b))
                .collect();
            let _ = writeln!(svg, "<path{dashes} d=\"{sides}\"/>");
        }
        svg.push_str("</g>\n");
        self.draw_name(svg, "near", near);
        if beyond.is_none() {
            self.draw_name(svg, "far", end);
        }
    }

    /// The eye and thin lines from it to the near face.
    fn draw_eye(&self, svg: &mut String) {
        let Solid { near, apex, .. } = self.outside.solid;
        let Some(apex) = apex else {
            return;
        };
        let lines: String = near.iter().map(|p| self.line(apex, *p)).collect();
        let ink = self.palette.ink;
        let _ = writeln!(
            svg,
            "<path class=\"eye\" stroke=\"{}\" stroke-width=\"{:.1}\" d=\"{lines}\"/>",
            self.palette.faint, self.unit
        );
        if self.outside.frustum.contains(apex).unwrap_or(false) {
            let [x, y] = self.projector.place(apex);
            let _ = writeln!(
                svg,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\" fill=\"{}\" stroke=\"{ink}\" stroke-width=\"{:.1}\"/>",
                4.5 * self.unit,
                self.palette.paper,
                2.0 * self.unit
            );
        }
    }

    /// A line as a path, as far as it is in view.
    fn line(&self, a: Vec3<f64>, b: Vec3<f64>) -> String {
        let clip = self.outside.frustum.clip_segment(&Segment::new(a, b));
        let Some(part) = clip.ok().and_then(|c| c.part) else {
            return String::new();
        };
        let [[x0, y0], [x1, y1]] =
            [part.entry.point, part.exit.point].map(|p| self.projector.place(p));
        format!("M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}")
    }

    /// An end's name beside its highest corner, away from the end's middle.
    fn draw_name(&self, svg: &mut String, name: &str, points: [Vec3<f64>; 4]) {
        let places = self.places(points);
        let higher = |h: Place, p: Place| if p[1] < h[1] { p } else { h };
        let [x, y] = places.into_iter().fold(places[0], higher).map(f64::from);
        let middle = places.iter().map(|p| f64::from(p[0])).sum::<f64>() / 4.0;
        let size = 14.0 * self.unit;
        let side = if x < middle { -1.0 } else { 1.0 };
        let [w, h] = self.projector.size();
        let x = (x + 1.3 * side * size).clamp(1.5 * size, (w - 1.5 * size).max(1.5 * size));
        let y = (y - 0.5 * size).clamp(1.2 * size, h.max(1.2 * size));
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-family=\"sans-serif\" font-size=\"{size:.1}\" \
             text-anchor=\"middle\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.1}\" \
             stroke-linejoin=\"round\" paint-order=\"stroke\">{name}</text>",
            self.palette.ink,
            self.palette.paper,
            4.0 * self.unit
        );
    }
}

fn ring(places: [Place; 4]) -> String {
    let [a, b, c, d] = places.map(|[x, y]| format!("{x:.1} {y:.1}"));
    format!("M{a}L{b}L{c}L{d}Z")
}

fn dashes(dash: f64, gap: f64, unit: f64) -> String {
    format!(" stroke-dasharray=\"{:.1} {:.1}\"", dash * unit, gap * unit)
}
