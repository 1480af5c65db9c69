//! All samples, small: two features a row, each with its relations.

use super::camera::Camera;
use super::canvas::{Canvas, Pen, Place, Type};
use super::page::class_colour;
use super::planar::{self, Frame, Plane};
use super::spatial;
use super::strand::Sizes;
use crate::number::short;
use crate::picture::Palette;
use crate::samples::case::Case;
use frusta::samples::{FeatureKind, Solid};
use frusta::{Class, Vec3};

const MARGIN: f64 = 24.0;
const CELL: Place = [416.0, 246.0];
const GAP: f64 = 10.0;
/// Between the two features of a row.
const APART: f64 = 22.0;
const HEADER: f64 = 118.0;
/// The height of a group's title.
const TITLE: f64 = 48.0;
/// A line of text above a cell's pictures, and one below.
const TEXT: f64 = 27.0;
const SPATIAL: Place = [268.0, CELL[1] - 2.0 * TEXT];
const PLANAR: Place = [CELL[0] - SPATIAL[0], SPATIAL[1] / 2.0];

/// How much is to be seen around the solid, as a multiple of its size.
const AROUND: f64 = 1.35;

/// The sheet of a solid's samples.
pub(in crate::samples) fn sheet(
    solid: &Solid,
    cases: &[Case],
    palette: &'static Palette,
) -> String {
    let features: Vec<&[Case]> = cases
        .chunk_by(|a, b| a.sample.feature == b.sample.feature)
        .collect();
    let columns = features.iter().map(|f| f.len()).max().unwrap_or(0);
    let step = columns as f64 * (CELL[0] + GAP);
    let groups = [
        (FeatureKind::Vertex, "vertices"),
        (FeatureKind::Edge, "edges"),
        (FeatureKind::Face, "faces"),
    ]
    .map(|(kind, name)| {
        let of_kind = |f: &&&[Case]| f[0].sample.feature.kind() == kind;
        let group: Vec<&[Case]> = features.iter().filter(of_kind).copied().collect();
        (name, group)
    });
    let rows: usize = groups.iter().map(|(_, f)| f.len().div_ceil(2)).sum();
    let height = HEADER + 3.0 * TITLE + rows as f64 * (CELL[1] + GAP) + MARGIN;
    let width = 2.0 * (MARGIN + step - GAP) + APART;
    let mut canvas = Canvas::new([width, height], palette);
    header(&mut canvas, solid, cases.len());
    let views = Views::new(solid);
    let mut top = HEADER;
    for (name, features) in groups {
        let title = format!("{} {name}", features.len());
        canvas.text([MARGIN, top + 32.0], &title, font(palette, 22.0, true));
        top += TITLE;
        for pair in features.chunks(2) {
            for (left, feature) in [MARGIN, MARGIN + step - GAP + APART].into_iter().zip(pair) {
                for (j, case) in feature.iter().enumerate() {
                    let x = left + j as f64 * (CELL[0] + GAP);
                    cell(&mut canvas, &views, solid, case, [x, top]);
                }
            }
            top += CELL[1] + GAP;
        }
    }
    canvas.finish()
}

fn font(palette: &Palette, size: f64, bold: bool) -> Type {
    Type {
        size,
        bold,
        colour: palette.ink,
    }
}

/// Where all cells look from.
struct Views {
    camera: Camera,
    frames: [Frame; 2],
}

impl Views {
    fn new(solid: &Solid) -> Self {
        let corners = spatial::all_corners(solid);
        let mean = |sum: Vec3<f64>| sum * (1.0 / corners.len() as f64);
        let centre = mean(corners.iter().fold(Vec3::default(), |sum, &p| sum + p));
        let around = corners.iter().map(|&p| centre + (p - centre) * AROUND);
        let fit: Vec<_> = around.collect();
        Self {
            camera: Camera::new(solid, &fit, SPATIAL, 2.0),
            frames: Frame::both(solid, &fit, PLANAR, 2.0),
        }
    }
}

/// A sample: its name, its pictures, its answer.
fn cell(canvas: &mut Canvas, views: &Views, solid: &Solid, case: &Case, [left, top]: Place) {
    let palette = canvas.palette;
    let name = font(palette, 13.5, true);
    canvas.paper([left, top], CELL);
    canvas.text([left + 8.0, top + 18.0], &case.sample.name(), name);
    canvas.inside([left, top + TEXT], SPATIAL, |canvas| {
        spatial::draw(canvas, &views.camera, solid, case, Sizes::SMALL);
    });
    for (i, plane) in [Plane::V, Plane::W].into_iter().enumerate() {
        let corner = [left + SPATIAL[0], top + TEXT + i as f64 * PLANAR[1]];
        canvas.inside(corner, PLANAR, |canvas| {
            planar::draw(canvas, views.frames[i], solid, case, Sizes::SMALL);
            canvas.text([4.0, 14.0], plane.name(), font(palette, 11.0, false));
        });
    }
    let class = case.expected.class;
    let bottom = top + CELL[1] - 8.0;
    let coloured = Type {
        colour: class_colour(palette, class),
        ..font(palette, 13.5, true)
    };
    canvas.text([left + 8.0, bottom], class.name(), coloured);
    if let Some(part) = &case.expected.part {
        let t = match [part.entry.t, part.exit.t].map(short) {
            [a, b] if a == b => format!("t = {a}"),
            [a, b] => format!("t = {a} to {b}"),
        };
        let place = [left + CELL[0] - 8.0, bottom];
        canvas.text_before(place, &t, font(palette, 13.0, false));
    }
}

/// Title and legend.
fn header(canvas: &mut Canvas, solid: &Solid, count: usize) {
    let palette = canvas.palette;
    let title = format!("The {count} samples of the solid {}", solid.name);
    canvas.text([MARGIN, 46.0], &title, font(palette, 28.0, true));
    let y = 88.0;
    let small = font(palette, 16.0, false);
    let mut x = MARGIN;
    let mut entry = |canvas: &mut Canvas, text: &str, draw: &dyn Fn(&mut Canvas, f64)| {
        draw(canvas, x);
        canvas.text([x + 44.0, y + 5.0], text, small);
        // The width of a letter, a little more than usual.
        x += 44.0 + 9.6 * text.chars().count() as f64 + 26.0;
    };
    let sizes = Sizes::LARGE;
    let across = |x: f64| ([x, y], [x + 34.0, y]);
    entry(canvas, "the feature", &|canvas, x| {
        let (a, b) = across(x);
        canvas.line(a, b, Pen::new(palette.highlight, 13.0));
        canvas.line(a, b, Pen::new(palette.ink, sizes.thin));
    });
    for class in [Class::Boundary, Class::Inside, Class::Cross] {
        entry(canvas, &format!("part inside: {class}"), &|canvas, x| {
            let (a, b) = across(x);
            let colour = palette.classes[class as usize];
            canvas.line(a, b, Pen::new(colour, sizes.thick));
        });
    }
    entry(canvas, "touch", &|canvas, x| {
        let colour = palette.classes[Class::Touch as usize];
        canvas.disc([x + 17.0, y], 6.5, colour);
    });
    entry(canvas, "cut where it enters", &|canvas, x| {
        canvas.ring([x + 17.0, y], 5.5, Pen::new(palette.cut, 2.2));
    });
    entry(canvas, "cut where it leaves", &|canvas, x| {
        canvas.disc([x + 17.0, y], 6.5, palette.cut);
    });
    entry(canvas, "outside", &|canvas, x| {
        let (a, b) = across(x);
        canvas.line(a, b, Pen::new(palette.ink, sizes.thin).dashed());
    });
    entry(canvas, "hidden edge, or the open end", &|canvas, x| {
        let (a, b) = across(x);
        let pen = Pen::new(palette.classes[0], 0.8 * sizes.thin);
        canvas.line(a, b, pen.dashed());
    });
}
