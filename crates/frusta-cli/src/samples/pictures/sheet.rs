//! All samples, small: two features a row, each with its relations.

use crate::draw::Palette;
use crate::draw::{
    Camera, Canvas, Entries, Font, Frame, Place, Plane, Sizes, all_corners, class_colour,
    draw_legend, draw_planar, draw_spatial,
};
use crate::io::number::short;
use crate::samples::case::Case;
use frusta::Vec3;
use frusta::samples::{FeatureKind, Relation, Solid};

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
const SPATIAL: Place = [242.0, CELL[1] - 2.0 * TEXT];
const PLANAR: Place = [(CELL[0] - SPATIAL[0]) / 2.0, SPATIAL[1]];

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
    let corners = all_corners(solid);
    let common = Views::new(solid, &corners);
    let mut top = HEADER;
    for (name, features) in groups {
        let title = format!("{} {name}", features.len());
        canvas.text([MARGIN, top + 32.0], &title, Font::new(palette, 22.0, true));
        top += TITLE;
        for pair in features.chunks(2) {
            for (left, feature) in [MARGIN, MARGIN + step - GAP + APART].into_iter().zip(pair) {
                for (j, case) in feature.iter().enumerate() {
                    let x = left + j as f64 * (CELL[0] + GAP);
                    // That a near miss misses shows only if all of it does.
                    let whole = (case.sample.relation == Relation::Apart).then(|| {
                        let ends = [case.segment.start, case.segment.end];
                        Views::new(solid, &[&corners[..], &ends].concat())
                    });
                    let views = whole.as_ref().unwrap_or(&common);
                    cell(&mut canvas, views, solid, case, [x, top]);
                }
            }
            top += CELL[1] + GAP;
        }
    }
    canvas.finish()
}

/// Where all cells look from.
struct Views {
    camera: Camera,
    frames: [Frame; 2],
}

impl Views {
    /// So that these points are seen, with some room around them.
    fn new(solid: &Solid, fit: &[Vec3<f64>]) -> Self {
        Self {
            camera: Camera::new(solid, fit, SPATIAL, 30.0),
            frames: Frame::both(solid, fit, PLANAR, 14.0),
        }
    }
}

/// A sample: its name, its pictures, its answer.
fn cell(canvas: &mut Canvas, views: &Views, solid: &Solid, case: &Case, [left, top]: Place) {
    let palette = canvas.palette;
    let name = Font::new(palette, 13.5, true);
    canvas.paper([left, top], CELL);
    canvas.text([left + 8.0, top + 18.0], &case.sample.name(), name);
    canvas.inside([left, top + TEXT], SPATIAL, |canvas| {
        draw_spatial(canvas, &views.camera, &case.subject(solid), Sizes::SMALL);
    });
    for (i, plane) in [Plane::V, Plane::W].into_iter().enumerate() {
        let corner = [left + SPATIAL[0] + i as f64 * PLANAR[0], top + TEXT];
        canvas.inside(corner, PLANAR, |canvas| {
            draw_planar(canvas, views.frames[i], &case.subject(solid), Sizes::SMALL);
            canvas.text([4.0, 14.0], plane.name(), Font::new(palette, 11.0, false));
        });
    }
    let class = case.expected.class;
    let bottom = top + CELL[1] - 8.0;
    let coloured = Font {
        colour: class_colour(palette, class),
        ..Font::new(palette, 13.5, true)
    };
    canvas.text([left + 8.0, bottom], class.name(), coloured);
    if let Some(part) = &case.expected.part {
        let t = match [part.entry.t, part.exit.t].map(short) {
            [a, b] if a == b => format!("t = {a}"),
            [a, b] => format!("t = {a} to {b}"),
        };
        let place = [left + CELL[0] - 8.0, bottom];
        canvas.text_before(place, &t, Font::new(palette, 13.0, false));
    }
}

/// Title and legend.
fn header(canvas: &mut Canvas, solid: &Solid, count: usize) {
    let palette = canvas.palette;
    let title = format!("The {count} samples of the solid {}", solid.name);
    canvas.text([MARGIN, 46.0], &title, Font::new(palette, 28.0, true));
    draw_legend(
        canvas,
        [MARGIN, 84.0],
        16.0,
        Entries {
            feature: true,
            classes: true,
        },
    );
}
