//! The frustum from outside: hidden edges dashed, one feature highlighted, and
//! a segment.

use super::Subject;
use super::camera::Camera;
use super::canvas::{Canvas, Pen, Place};
use super::segment::{self, Sizes};
use frusta::samples::{Feature, FeatureKind, Solid};
use frusta::{FaceSet, Vec3};

/// How far open ends are drawn, as a multiple of the rest.
const OPEN: f64 = 1.22;

/// The solid and the segment, as the camera sees them.
pub(crate) fn draw(canvas: &mut Canvas, camera: &Camera, subject: &Subject<'_>, sizes: Sizes) {
    let solid = subject.solid;
    let seen = visible_faces(camera, solid);
    let view = View {
        camera,
        solid,
        seen,
        sizes,
    };
    view.shade(canvas);
    if let Some(feature) = subject.feature {
        view.highlight(canvas, feature);
    }
    let edges = solid.features().into_iter();
    for edge in edges.filter(|f| f.kind() == FeatureKind::Edge) {
        view.edge(canvas, edge);
    }
    let (p, q) = (subject.segment.start, subject.segment.end);
    if let Some([first, last]) = camera.before_eye(p, q) {
        let shown = [first.max(subject.shown[0]), last.min(subject.shown[1])];
        let place = |t: f64| camera.place(p + (q - p) * t);
        segment::draw(canvas, subject.clip, shown, sizes, place);
    }
}

/// The corners of a feature: one, two, or four going round.
pub(crate) fn corners(solid: &Solid, feature: Feature) -> Vec<Vec3<f64>> {
    let grid = feature.grid();
    if feature.is_apex() {
        return vec![solid.at(grid)];
    }
    let free: Vec<usize> = (0..3).filter(|&k| grid[k] == 0.5).collect();
    const AROUND: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let count = [1, 2, 4][free.len().min(2)];
    let corner = |around: &[f64; 2]| {
        let mut at = grid;
        for (&k, &value) in free.iter().zip(around) {
            at[k] = value;
        }
        solid.at(at)
    };
    AROUND[..count].iter().map(corner).collect()
}

/// All corners of the solid, those of an open end where the drawing stops.
pub(crate) fn all_corners(solid: &Solid) -> Vec<Vec3<f64>> {
    let end = if solid.is_infinite() { OPEN } else { 1.0 };
    let mut all = Vec::new();
    for w in [0.0, end] {
        for [u, v] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            all.push(solid.at([u, v, w]));
        }
    }
    all
}

fn faces(solid: &Solid) -> impl Iterator<Item = Feature> {
    let features = solid.features().into_iter();
    features.filter(|f| f.kind() == FeatureKind::Face)
}

/// The faces whose outer side the camera sees.
fn visible_faces(camera: &Camera, solid: &Solid) -> FaceSet {
    let inside = solid.at([0.5, 0.5, 0.5]);
    let outer = |&face: &Feature| {
        let p = corners(solid, face);
        // From the diagonals, since a side of a pyramid's face may have no length.
        let normal = (p[2] - p[0]).cross(p[3] - p[1]);
        let outwards = normal.dot(p[0] - inside).signum();
        camera.sees(p[0], normal * outwards)
    };
    let seen = faces(solid).filter(outer);
    seen.flat_map(|face| face.faces().iter()).collect()
}

/// A solid before a camera.
struct View<'a> {
    camera: &'a Camera,
    solid: &'a Solid,
    /// The faces that the camera sees.
    seen: FaceSet,
    sizes: Sizes,
}

impl View<'_> {
    fn is_hidden(&self, feature: Feature) -> bool {
        feature.faces().intersection(self.seen).is_empty()
    }

    fn places(&self, feature: Feature) -> Vec<Place> {
        let corners = corners(self.solid, feature).into_iter();
        corners.map(|p| self.camera.place(p)).collect()
    }

    /// A faint colour on visible faces, each with its own shade.
    fn shade(&self, canvas: &mut Canvas) {
        for face in faces(self.solid).filter(|&f| !self.is_hidden(f)) {
            let name = face.faces().first().map_or(0, |f| f as u8);
            let opacity = 0.05 + 0.02 * f64::from(name);
            canvas.polygon(&self.places(face), canvas.palette.ink, opacity, 0.0);
        }
    }

    /// The highlighted feature; if it is behind, it shines through.
    fn highlight(&self, canvas: &mut Canvas, feature: Feature) {
        let (at, mark) = (self.places(feature), self.sizes.mark);
        let colour = canvas.palette.highlight;
        match at[..] {
            [point] => canvas.disc(point, 2.4 * mark, colour),
            [a, b] => canvas.line(a, b, Pen::new(colour, 2.8 * mark)),
            _ if self.is_hidden(feature) => canvas.polygon(&at, colour, 0.4, 0.0),
            _ => canvas.polygon(&at, colour, 0.8, 0.0),
        }
    }

    /// An edge, dashed if it is hidden; it goes on in dashes where the solid has no end.
    fn edge(&self, canvas: &mut Canvas, edge: Feature) {
        let ends = self.places(edge);
        let [a, b] = ends[..] else {
            return;
        };
        let faint = Pen::new(canvas.palette.classes[0], 0.8 * self.sizes.thin).dashed();
        let pen = if self.is_hidden(edge) {
            faint
        } else {
            Pen::new(canvas.palette.ink, self.sizes.thin)
        };
        canvas.line(a, b, pen);
        let [u, v, w] = edge.grid();
        if self.solid.is_infinite() && w == 0.5 {
            let on = self.solid.at([u, v, OPEN]);
            canvas.line(b, self.camera.place(on), faint);
        }
    }
}
