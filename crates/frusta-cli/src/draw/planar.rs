//! A trapezoid, TV or TW, with the projections of a feature and a segment.
//! Depth grows to the right, the other coordinate upwards.

use super::Subject;
use super::canvas::{Canvas, Pen, Place};
use super::segment::{self, Sizes};
use super::spatial::{all_corners, corners};
use frusta::samples::Solid;
use frusta::{Segment, Vec3};

/// Which of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Plane {
    /// Frame x over z: TV.
    V,
    /// Frame y over z: TW.
    W,
}

impl Plane {
    /// Its trapezoid's name.
    pub(crate) fn name(self) -> &'static str {
        ["TV", "TW"][self as usize]
    }

    /// Which coordinate it keeps beside z.
    pub(crate) fn across(self) -> &'static str {
        ["x", "y"][self as usize]
    }
}

/// From the frame to a picture of a plane.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    plane: Plane,
    sign: f64,
    scale: f64,
    /// The plane's coordinates in the middle of the picture.
    middle: Place,
    offset: Place,
}

impl Frame {
    /// Frames of one scale for both planes, so that these points fill pictures
    /// of this size, except for a margin.
    pub(crate) fn both(solid: &Solid, fit: &[Vec3<f64>], size: Place, margin: f64) -> [Self; 2] {
        let mut scale = f64::INFINITY;
        let frames = [Plane::V, Plane::W].map(|plane| {
            let mut frame = Self {
                plane,
                sign: solid.shape.direction().sign(),
                scale: 1.0,
                middle: [0.0; 2],
                offset: [size[0] / 2.0, size[1] / 2.0],
            };
            for (k, room) in size.into_iter().enumerate() {
                let all = || fit.iter().map(|&p| frame.coordinates(p)[k]);
                let low = all().fold(f64::INFINITY, f64::min);
                let high = all().fold(-f64::INFINITY, f64::max);
                scale = scale.min((room - 2.0 * margin) / (high - low));
                frame.middle[k] = 0.5 * (low + high);
            }
            frame
        });
        frames.map(|frame| Self { scale, ..frame })
    }

    fn coordinates(&self, p: Vec3<f64>) -> Place {
        let across = if self.plane == Plane::V { p.x } else { p.y };
        [self.sign * p.z, -across]
    }

    /// Where a point is in the picture.
    pub(crate) fn place(&self, p: Vec3<f64>) -> Place {
        let at = self.coordinates(p);
        let place = |k: usize| self.offset[k] + (at[k] - self.middle[k]) * self.scale;
        [place(0), place(1)]
    }
}

/// The trapezoid and the projections.
pub(crate) fn draw(canvas: &mut Canvas, frame: Frame, subject: &Subject<'_>, sizes: Sizes) {
    let solid = subject.solid;
    let palette = canvas.palette;
    let outline = outline(frame, solid);
    canvas.polygon(&outline, palette.ink, 0.07, 0.0);
    let feature = subject.feature.map(|feature| corners(solid, feature));
    let feature = feature.into_iter().flatten();
    let feature: Vec<Place> = feature.map(|p| frame.place(p)).collect();
    match feature[..] {
        [] => {}
        [point] => canvas.disc(point, 2.2 * sizes.mark, palette.highlight),
        // An edge may be seen from its end.
        [a, b] if a == b => canvas.disc(a, 2.2 * sizes.mark, palette.highlight),
        _ => canvas.polygon(&feature, palette.highlight, 0.8, 2.2 * sizes.mark),
    }
    for i in 0..4 {
        let open = solid.is_infinite() && i == 1;
        let (a, b) = (outline[i], outline[(i + 1) % 4]);
        if !open {
            canvas.line(a, b, Pen::new(palette.ink, sizes.thin));
        }
    }
    let Segment { start: p, end: q } = subject.segment;
    let place = |t: f64| frame.place(p + (q - p) * t);
    segment::draw(canvas, subject.clip, subject.shown, sizes, place);
}

/// Low near, low far, high far, high near.
fn outline(frame: Frame, solid: &Solid) -> [Place; 4] {
    let all = all_corners(solid);
    [0, 4, 6, 2].map(|i| frame.place(all[i]))
}
