//! SVG: what the camera sees, projected to the near rectangle.
//!
//! A point's place in the picture is its place between the frustum's sides at
//! its depth. Where left/right and bottom/top converge at the same depth this is
//! the central projection from the apex, and straight lines stay straight;
//! elsewhere (a sheared frustum) parts are drawn as short pieces.
//!
//! Places are rounded to a tenth of a pixel and equal strokes drawn once. Where
//! there are many, what is nearer is darker, and strokes that would add no ink
//! are left out (see `thin.rs`), so that the file stays small enough to open.

use super::thin::{self, DEEPEST, Stroke, Thinned};
use crate::number::Scalar;
use frusta::{Class, Direction, Frustum, Pose, SegmentClip, Shape, Vec3};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Grid steps in a pixel.
const STEPS: f64 = 10.0;
/// Pixels along the picture's longer side.
const LONGER: f64 = 1200.0;
/// The picture is drawn at most this many times longer than wide.
const MOST_OBLONG: f64 = 8.0;
/// Pixels around the picture, and below it for the caption.
const MARGIN: f64 = 28.0;
const CAPTION: f64 = 56.0;
/// Different strokes that are kept in memory, at 8 bytes.
const MOST_IN_MEMORY: usize = 4_000_000;
/// Beyond this many, strokes are shaded by depth and those without ink dropped.
const MANY: usize = 4_000;
/// Shades of depth.
const SHADES: u8 = 6;
/// Depth levels for each doubling of the distance from the apex.
const LEVELS: f64 = 3.0;
/// Beyond this many, marks at clipped ends would hide the picture.
const MOST_MARKS: usize = 400;
/// Pieces of a part that may be curved.
const PIECES: u32 = 24;

/// Colours by class, in the order of [`Class::ALL`].
const COLOURS: [&str; 5] = ["#8a8a8a", "#c2185b", "#2e7d32", "#1d3557", "#d9600f"];

/// From world points to the picture.
#[derive(Clone, Debug)]
pub(crate) struct Projector {
    pose: Pose,
    /// Left, right, bottom, top at the near end, and their change per unit of
    /// `s`, the scaled depth.
    near: [f64; 4],
    change: [f64; 4],
    z: f64,
    s_per_z: f64,
    mirrored: bool,
    pieces: u32,
    /// Pixels.
    width: f64,
    height: f64,
}

impl Projector {
    /// The projection of a frustum.
    pub(crate) fn new(frustum: &Frustum) -> Self {
        let (pose, shape) = (*frustum.pose(), frustum.shape());
        let near = shape.near().rect.to_array();
        let (change, s_per_z) = match shape {
            Shape::Finite { near: n, far } => {
                let far = far.rect.to_array();
                let change = std::array::from_fn(|i| far[i] - near[i]);
                (change, 1.0 / (shape.far().map_or(0.0, |f| f.z) - n.z))
            }
            Shape::Infinite {
                slopes, direction, ..
            } => (slopes.to_array(), direction.sign()),
        };
        let extent = |r: &[f64; 4]| [r[1] - r[0], r[3] - r[2]];
        let ([w, h], [dw, dh]) = (extent(&near), extent(&change));
        let straight = (w * dh - h * dw).abs() <= 1e-9 * (w * dh).abs().max((h * dw).abs());
        let [a, b, c] = pose.axes;
        let (right, up) = if w > 0.0 && h > 0.0 {
            (w, h)
        } else {
            (w + dw, h + dh)
        };
        let ratio = (right / a.dot(a).sqrt()) / (up / b.dot(b).sqrt());
        let ratio = if ratio > 0.0 { ratio } else { 1.0 };
        let ratio = ratio.clamp(1.0 / MOST_OBLONG, MOST_OBLONG);
        let left_handed = a.dot(b.cross(c)) < 0.0;
        Self {
            pose,
            near,
            change,
            z: shape.near().z,
            s_per_z,
            // Seen along +z, a right-handed frame has x to the left.
            mirrored: left_handed != (shape.direction() == Direction::PlusZ),
            pieces: if straight { 1 } else { PIECES },
            width: (LONGER * ratio.min(1.0)).round(),
            height: (LONGER / ratio.max(1.0)).round(),
        }
    }

    /// A point's place on the grid, and its depth level.
    fn place(&self, point: Vec3<f64>) -> ([u16; 2], u8) {
        let q = self.pose.to_frame(point);
        let s = (q.z - self.z) * self.s_per_z;
        let between = |value: f64, low: usize| {
            let bound = |i: usize| self.near[i] + s * self.change[i];
            let at = (value - bound(low)) / (bound(low + 1) - bound(low));
            // At an apex, where the sides meet, any place is right.
            if at.is_nan() { 0.5 } else { at.clamp(0.0, 1.0) }
        };
        let (u, v) = (between(q.x, 0), between(q.y, 2));
        let u = if self.mirrored { 1.0 - u } else { u };
        let place = [(u, self.width), (1.0 - v, self.height)]
            .map(|(at, size)| (at * size * STEPS).round() as u16);
        let wider = s * (self.change[1] - self.change[0]) / (self.near[1] - self.near[0]);
        let level = if wider == 0.0 {
            s * f64::from(DEEPEST)
        } else {
            LEVELS * (1.0 + wider).abs().log2()
        };
        // The conversion clamps, and takes NaN as 0.
        (place, level as u8)
    }
}

/// Projects all parts.
pub(super) fn format<T: Scalar>(
    projector: &Projector,
    clips: &[SegmentClip<T>],
    out: &mut Vec<Stroke>,
) {
    for clip in clips {
        let Some(part) = &clip.part else {
            continue;
        };
        let [a, b] = [part.entry.point.to_f64(), part.exit.point.to_f64()];
        let (mut from, mut level) = projector.place(a);
        for i in 1..=projector.pieces {
            let t = f64::from(i) / f64::from(projector.pieces);
            let (to, next) = projector.place(if i == projector.pieces {
                b
            } else {
                a * (1.0 - t) + b * t
            });
            out.push(Stroke::new(clip.class as usize, level.min(next), from, to));
            (from, level) = (to, next);
        }
        for end in [&part.entry, &part.exit] {
            if end.clipped && clip.class != Class::Touch {
                let (mark, _) = projector.place(end.point.to_f64());
                out.push(Stroke::new(MARK, 0, mark, mark));
            }
        }
    }
}

/// The class that marks at clipped ends go by: nothing is drawn of what is
/// outside.
const MARK: usize = Class::Outside as usize;

/// A picture in the making.
pub(crate) struct Picture {
    width: f64,
    height: f64,
    strokes: Thinned,
    /// Where segments were clipped; `None` once there are too many.
    marks: Option<Vec<Stroke>>,
}

impl Picture {
    /// An empty picture.
    pub(super) fn new(projector: &Projector) -> Self {
        Self {
            width: projector.width,
            height: projector.height,
            strokes: Thinned::new(MOST_IN_MEMORY),
            marks: Some(Vec::new()),
        }
    }

    /// Adds strokes.
    pub(super) fn add(&mut self, strokes: &[Stroke]) {
        let is_mark = |s: &Stroke| s.class() == MARK;
        let drawn: Vec<Stroke> = strokes.iter().copied().filter(|s| !is_mark(s)).collect();
        self.strokes.extend(&drawn);
        if let Some(marks) = &mut self.marks {
            marks.extend(strokes.iter().copied().filter(is_mark));
            if marks.len() > MOST_MARKS {
                self.marks = None;
            }
        }
    }

    /// The file's text.
    pub(super) fn draw(self, title: &str, classes: &[u64; 5]) -> String {
        let (mut strokes, level) = self.strokes.finish();
        let (w, h) = (self.width, self.height);
        let many = strokes.len() > MANY;
        if many {
            // Cells of a pixel; a coarse grid's steps are taken as they are.
            strokes = thin::keep_visible(
                strokes,
                [w as usize, h as usize],
                (STEPS as u16 >> level).max(1),
            );
        }
        let (page_w, page_h) = (w.max(560.0) + 2.0 * MARGIN, h + 2.0 * MARGIN + CAPTION);
        let left = (page_w - w) / 2.0;
        let mut svg = String::new();
        // Writing into memory cannot fail.
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{page_w}\" height=\"{page_h}\" \
             viewBox=\"0 0 {page_w} {page_h}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#f4f3ee\"/>\n\
             <rect x=\"{left}\" y=\"{MARGIN}\" width=\"{w}\" height=\"{h}\" fill=\"#fffefb\"/>\n"
        );
        let thickness = stroke_width(strokes.len());
        let _ = writeln!(
            svg,
            "<g transform=\"translate({left} {MARGIN}) scale({})\" fill=\"none\" \
             stroke-width=\"{}\" stroke-linecap=\"round\">",
            1.0 / STEPS,
            thickness * STEPS
        );
        for ((shade, class), strokes) in groups(&strokes, many) {
            let opacity = 1.0 - 0.8 * f64::from(shade) / f64::from(SHADES);
            draw_group(&mut svg, &strokes, class, opacity, level, thickness);
        }
        for mark in self.marks.iter().flatten() {
            let [[x, y], _] = mark.ends();
            let _ = writeln!(
                svg,
                "<circle cx=\"{x}\" cy=\"{y}\" r=\"38\" fill=\"#fffefb\" stroke=\"{}\" stroke-width=\"14\"/>",
                COLOURS[Class::Cross as usize]
            );
        }
        let _ = write!(
            svg,
            "</g>\n<rect x=\"{left}\" y=\"{MARGIN}\" width=\"{w}\" height=\"{h}\" fill=\"none\" \
             stroke=\"#55534d\" stroke-width=\"1.5\"/>\n"
        );
        draw_caption(&mut svg, title, classes, h + MARGIN);
        svg.push_str("</svg>\n");
        svg
    }
}

/// Pixels: thick enough to see a few strokes, thin enough to part many.
fn stroke_width(strokes: usize) -> f64 {
    match strokes {
        0..=300 => 2.2,
        301..=3_000 => 1.2,
        3_001..=30_000 => 0.7,
        _ => 0.4,
    }
}

/// The strokes by shade and class in the order of drawing: far ones first.
fn groups(strokes: &[Stroke], shaded: bool) -> Vec<((u8, usize), Vec<Stroke>)> {
    let levels = strokes.iter().map(|s| s.depth());
    let nearest = levels.clone().min().unwrap_or(0);
    let range = levels.max().unwrap_or(0) - nearest + 1;
    let mut groups = BTreeMap::<_, Vec<Stroke>>::new();
    for &stroke in strokes {
        let shade = (stroke.depth() - nearest) * SHADES / range;
        let shade = if shaded { shade } else { 0 };
        let group = groups.entry((Reverse(shade), stroke.class()));
        group.or_default().push(stroke);
    }
    let plain = |((Reverse(shade), class), strokes)| ((shade, class), strokes);
    groups.into_iter().map(plain).collect()
}

/// One path for all strokes of a class at a depth.
fn draw_group(
    svg: &mut String,
    strokes: &[Stroke],
    class: usize,
    opacity: f64,
    level: u32,
    thickness: f64,
) {
    let (name, colour) = (Class::ALL[class].name(), COLOURS[class]);
    let _ = write!(svg, "<path class=\"{name}\" stroke=\"{colour}\"");
    if opacity < 1.0 {
        let _ = write!(svg, " stroke-opacity=\"{opacity:.2}\"");
    }
    if class == Class::Touch as usize {
        let width = (thickness * 4.0).max(2.0) * STEPS;
        let _ = write!(svg, " stroke-width=\"{width}\"");
    }
    svg.push_str(" d=\"");
    // A coarse grid's point stands for a square; its middle is drawn.
    let fine = |c: u16| (i32::from(c) << level) + ((1 << level) >> 1);
    for (i, stroke) in strokes.iter().enumerate() {
        let [[x0, y0], [x1, y1]] = stroke.ends().map(|end| end.map(fine));
        let line = if i % 16 == 15 { "\n" } else { "" };
        let _ = write!(svg, "M{x0} {y0}l{} {}{line}", x1 - x0, y1 - y0);
    }
    svg.push_str("\"/>\n");
}

fn draw_caption(svg: &mut String, title: &str, classes: &[u64; 5], bottom: f64) {
    let escaped = title
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;");
    let _ = write!(
        svg,
        "<g font-family=\"sans-serif\" font-size=\"15\" fill=\"#33312c\">\n\
         <text x=\"{MARGIN}\" y=\"{}\">{escaped}</text>\n<text x=\"{MARGIN}\" y=\"{}\">",
        bottom + 30.0,
        bottom + 54.0
    );
    for (i, (class, count)) in Class::ALL.iter().zip(classes).enumerate() {
        let (colour, gap) = (COLOURS[i], if i == 0 { 0 } else { 18 });
        let _ = write!(
            svg,
            "<tspan dx=\"{gap}\" fill=\"{colour}\" font-weight=\"bold\">{class}</tspan> {count}"
        );
    }
    svg.push_str("</text>\n</g>\n");
}
