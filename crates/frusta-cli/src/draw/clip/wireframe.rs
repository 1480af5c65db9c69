//! The frustum itself, drawn in a view from outside: ends, sides, and its eye.

use super::outside::{Outside, Solid};
use super::projector::{Place, Projector};
use crate::draw::Palette;
use crate::draw::svg::Svg;
use frusta::{Segment, Vec3};

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
    pub(super) fn draw_faces(&self, svg: &mut Svg) {
        let Solid { near, end, .. } = self.outside.solid;
        for (points, opacity) in [(end, 0.05), (near, 0.1)] {
            let path = svg.element("path").attribute("fill", self.palette.ink);
            path.attribute("fill-opacity", opacity)
                .attribute("d", ring(self.places(points)))
                .empty();
        }
    }

    /// All lines, the eye and the names of the ends.
    pub(super) fn draw_edges(&self, svg: &mut Svg) {
        let Solid {
            near, end, beyond, ..
        } = self.outside.solid;
        self.draw_eye(svg);
        let width = 1.6 * self.unit;
        let dashes = format!("{:.1} {:.1}", 6.0 * self.unit, 4.0 * self.unit);
        let end_dashes = beyond.is_some().then_some(&dashes);
        svg.element("g")
            .attribute("class", "frustum")
            .attribute("stroke", self.palette.ink)
            .attribute("stroke-width", format_args!("{width:.1}"))
            .attribute("stroke-linejoin", "round")
            .attribute("stroke-linecap", "round")
            .open();
        let sides = svg.element("path");
        sides.attribute("d", self.lines(&near, &end)).empty();
        let far = svg
            .element("path")
            .attribute_if("stroke-dasharray", end_dashes);
        far.attribute("d", ring(self.places(end))).empty();
        let wide = format!("{:.1}", 1.4 * width);
        let face = svg.element("path").attribute("stroke-width", wide);
        face.attribute("d", ring(self.places(near))).empty();
        if let Some(beyond) = beyond {
            let open = svg.element("path").attribute("stroke-dasharray", &dashes);
            open.attribute("d", self.lines(&end, &beyond)).empty();
        }
        svg.close("g");
        self.draw_name(svg, "near", near);
        if beyond.is_none() {
            self.draw_name(svg, "far", end);
        }
    }

    /// The eye and thin lines from it to the near face.
    fn draw_eye(&self, svg: &mut Svg) {
        let Solid { near, apex, .. } = self.outside.solid;
        let Some(apex) = apex else {
            return;
        };
        svg.element("path")
            .attribute("class", "eye")
            .attribute("stroke", self.palette.faint)
            .attribute("stroke-width", format_args!("{:.1}", self.unit))
            .attribute("d", self.lines(&[apex; 4], &near))
            .empty();
        if self.outside.frustum.contains(apex).unwrap_or(false) {
            let [x, y] = self.projector.place(apex);
            svg.element("circle")
                .attribute("cx", format_args!("{x:.1}"))
                .attribute("cy", format_args!("{y:.1}"))
                .attribute("r", format_args!("{:.1}", 4.5 * self.unit))
                .attribute("fill", self.palette.paper)
                .attribute("stroke", self.palette.ink)
                .attribute("stroke-width", format_args!("{:.1}", 2.0 * self.unit))
                .empty();
        }
    }

    /// Lines between points as a path.
    fn lines(&self, from: &[Vec3<f64>; 4], to: &[Vec3<f64>; 4]) -> String {
        from.iter()
            .zip(to)
            .map(|(a, b)| self.line(*a, *b))
            .collect()
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
    fn draw_name(&self, svg: &mut Svg, name: &str, points: [Vec3<f64>; 4]) {
        let places = self.places(points);
        let higher = |h: Place, p: Place| if p[1] < h[1] { p } else { h };
        let [x, y] = places.into_iter().fold(places[0], higher).map(f64::from);
        let middle = places.iter().map(|p| f64::from(p[0])).sum::<f64>() / 4.0;
        let size = 14.0 * self.unit;
        let side = if x < middle { -1.0 } else { 1.0 };
        let [w, h] = self.projector.size();
        let x = (x + 1.3 * side * size).clamp(1.5 * size, (w - 1.5 * size).max(1.5 * size));
        let y = (y - 0.5 * size).clamp(1.2 * size, h.max(1.2 * size));
        svg.element("text")
            .attribute("x", format_args!("{x:.1}"))
            .attribute("y", format_args!("{y:.1}"))
            .attribute("font-family", "sans-serif")
            .attribute("font-size", format_args!("{size:.1}"))
            .attribute("text-anchor", "middle")
            .attribute("fill", self.palette.ink)
            .attribute("stroke", self.palette.paper)
            .attribute("stroke-width", format_args!("{:.1}", 4.0 * self.unit))
            .attribute("stroke-linejoin", "round")
            .attribute("paint-order", "stroke")
            .text(name);
    }
}

fn ring(places: [Place; 4]) -> String {
    let [a, b, c, d] = places.map(|[x, y]| format!("{x:.1} {y:.1}"));
    format!("M{a}L{b}L{c}L{d}Z")
}
