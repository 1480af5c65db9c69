//! `frusta samples map`: the answers of two arithmetics for inputs that differ by ulps.
//!
//! After the pictures of Kettner, Mehlhorn, Pion, Schirra, Yap, "Classroom examples
//! of robustness problems in geometric computations" (2008): one cell is one
//! representable input, its colour the answer.

use crate::draw::svg::Svg;
use crate::draw::{self, Palette, Theme};
use crate::failure::Failure;
use crate::terminal::print;
use clap::{Args, ValueEnum};
use frusta::clip::{SegmentClipper, VwProjection};
use frusta::{Accuracy, Class, EndRect, Frustum, Pose, Segment, SegmentClip, Shape, Vec3};
use std::path::PathBuf;

/// A map of answers near a feature, by plain and by exact arithmetic, an ulp a cell
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct MapArgs {
    /// The feature
    place: Place,
    /// The picture: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The picture's colours
    #[arg(long, default_value = "light")]
    theme: Theme,
}

/// The feature that the segments pass by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Place {
    /// Segments that end near the middle of the right face
    Face,
    /// Segments that pass by the edge of right and far
    Edge,
    /// Segments that pass by the vertex of right, top and far
    Vertex,
}

/// Cells in a row and in a column.
const CELLS: i32 = 96;
/// A cell's width, and the page's margins.
const CELL: i32 = 4;
const MARGIN: i32 = 24;
const HEAD: i32 = 40;
const FOOT: i32 = 64;

/// Runs the command.
pub(super) fn run(args: &MapArgs) -> Result<(), Failure> {
    let frustum = args
        .place
        .frustum()
        .map_err(|e| Failure::new(e.to_string()))?;
    let maps = [
        ("plain arithmetic", VwProjection::plain()),
        ("exact decisions", VwProjection::exact(Accuracy::Fast)),
    ];
    let maps = maps.map(|(title, clipper)| (title, Map::new(&frustum, args.place, &clipper)));
    let wrong = maps[0].1.differences(&maps[1].1);
    let svg = draw(&maps, args.place, wrong, args.theme.palette());
    draw::save(&args.output, &svg)?;
    print(&format!(
        "{} inputs, {wrong} of them answered wrongly by plain arithmetic, in {}\n",
        CELLS * CELLS,
        args.output.display()
    ))
}

/// The half-width at the far end.
const WIDE: f64 = 3.671_875;
/// Where that is.
const FAR: f64 = 7.0;

/// Where the moved ends are: near the world's origin, where `f64`s are dense, as models are; the
/// camera is away from it.
const TARGET: Vec3<f64> = Vec3::new(0.3, 0.2, 0.4);

impl Place {
    /// The segment in the frame, up to rounding; its second point is moved.
    fn segment(self) -> [[f64; 3]; 2] {
        match self {
            Place::Face => {
                let z = 4.3;
                let on = 0.046_875 + (WIDE - 0.046_875) / FAR * z;
                [[0.1, 0.2, 3.1], [on, 0.3, z]]
            }
            // Across the corner of x and z, over to the other side of far.
            Place::Edge => [[WIDE - 1.3, 0.1, FAR + 1.7], [WIDE + 1.3, 0.4, FAR - 1.7]],
            Place::Vertex => [
                [WIDE - 1.3, WIDE - 0.7, FAR + 1.7],
                [WIDE + 1.3, WIDE + 0.7, FAR - 1.7],
            ],
        }
    }

    /// A camera turned about y.
    fn pose(self) -> Pose {
        let axes = [[0.6, 0.0, -0.8], [0.0, 1.0, 0.0], [0.8, 0.0, 0.6]];
        let mut pose = Pose::new(Vec3::default(), axes.map(Vec3::from));
        let [_, moved] = self.segment();
        pose.origin = TARGET - pose.to_world(moved.into());
        pose
    }

    /// Opposite sides mirror each other; their slope, 3.625 over 7, is not an `f64`.
    fn frustum(self) -> Result<Frustum, frusta::FrustumError> {
        let rect = |z, w: f64| EndRect::new(z, -w, w, -w, w);
        let (near, far) = (rect(0.0, 0.046_875), rect(FAR, WIDE));
        Frustum::new(self.pose(), Shape::Finite { near, far })
    }

    /// The segment of a cell: one end moved by `x` and `z` ulps along the world's x and z.
    fn moved(self, x: i32, z: i32) -> Segment<f64> {
        let [fixed, moved] = self.segment().map(|p| self.pose().to_world(p.into()));
        let ulps = |v: f64, n: i32| v + f64::from(n) * (v.next_up() - v);
        Segment::new(
            fixed,
            Vec3::new(ulps(moved.x, x), moved.y, ulps(moved.z, z)),
        )
    }

    fn title(self) -> &'static str {
        match self {
            Place::Face => "segments from the inside that end near the right face",
            Place::Edge => "segments that pass by the edge of right and far",
            Place::Vertex => "segments that pass by the vertex of right, top and far",
        }
    }
}

/// What an answer looks like.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    Class(Class),
    /// Inside, and an end is on a face.
    EndsOn,
}

impl Answer {
    fn of(clip: &SegmentClip<f64>) -> Self {
        let on = |end: frusta::PartEnd<f64>| !end.clipped && !end.faces.is_empty();
        match clip.part {
            Some(part) if clip.class == Class::Inside && (on(part.entry) || on(part.exit)) => {
                Answer::EndsOn
            }
            _ => Answer::Class(clip.class),
        }
    }

    fn colour(self, palette: &Palette) -> &'static str {
        match self {
            Answer::Class(class) => palette.classes[class as usize],
            Answer::EndsOn => palette.highlight,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Answer::Class(class) => class.name(),
            Answer::EndsOn => "inside, ends on the face",
        }
    }
}

/// The answers, row by row, x across and z up.
struct Map(Vec<[Answer; CELLS as usize]>);

impl Map {
    fn new(frustum: &Frustum, place: Place, clipper: &VwProjection) -> Self {
        let half = CELLS / 2;
        let answer = |column: usize, row: i32| {
            let segment = place.moved(column as i32 - half, half - 1 - row);
            match clipper.clip_segment(frustum, &segment) {
                Ok(clip) => Answer::of(&clip),
                Err(_) => Answer::Class(Class::Outside),
            }
        };
        let row = |row| std::array::from_fn(|column| answer(column, row));
        Map((0..CELLS).map(row).collect())
    }

    fn differences(&self, other: &Self) -> usize {
        let cells = self.0.iter().flatten().zip(other.0.iter().flatten());
        cells.filter(|(a, b)| a != b).count()
    }

    /// Cells of one colour in a row are one rectangle.
    fn draw(&self, svg: &mut Svg, left: i32, palette: &Palette) {
        for (y, row) in self.0.iter().enumerate() {
            let mut x = 0;
            for run in row.chunk_by(|a, b| a == b) {
                let width = run.len() as i32;
                let corner = [left + x * CELL, HEAD + y as i32 * CELL];
                let colour = run[0].colour(palette);
                area(svg, corner, [width * CELL, CELL], colour);
                x += width;
            }
        }
    }
}

fn area(svg: &mut Svg, corner: [i32; 2], size: [i32; 2], colour: &str) {
    let rect = svg.element("rect").rectangle(corner, size);
    rect.attribute("fill", colour).empty();
}

fn label(svg: &mut Svg, [x, y]: [i32; 2], text: &str) {
    let element = svg.element("text").attribute("x", x);
    element.attribute("y", y).text(text);
}

fn draw(maps: &[(&str, Map); 2], place: Place, wrong: usize, palette: &Palette) -> String {
    let side = CELLS * CELL;
    let (width, height) = (2 * side + 3 * MARGIN, HEAD + side + FOOT);
    let mut svg = Svg::in_one_line();
    svg.document()
        .attribute("width", width)
        .attribute("height", height)
        .attribute("font-family", "sans-serif")
        .attribute("font-size", 13)
        .attribute("fill", palette.ink)
        .attribute("shape-rendering", "crispEdges")
        .open();
    let page = svg.element("rect").attribute("width", "100%");
    page.attribute("height", "100%")
        .attribute("fill", palette.page)
        .empty();
    for (i, (title, map)) in (0..).zip(maps) {
        let left = MARGIN + i * (side + MARGIN);
        label(&mut svg, [left, HEAD - 12], title);
        map.draw(&mut svg, left, palette);
    }
    let mut x = MARGIN;
    let all = maps.iter().flat_map(|(_, map)| map.0.iter().flatten());
    let mut shown: Vec<Answer> = Vec::new();
    for &answer in all {
        if !shown.contains(&answer) {
            shown.push(answer);
        }
    }
    let top = HEAD + side + 14;
    for answer in shown {
        area(&mut svg, [x, top], [14, 14], answer.colour(palette));
        label(&mut svg, [x + 20, top + 12], answer.name());
        x += 44 + 8 * answer.name().len() as i32;
    }
    let summary = format!(
        "{}: a cell an ulp; {wrong} of {} wrong",
        place.title(),
        CELLS * CELLS
    );
    label(&mut svg, [MARGIN, HEAD + side + 52], &summary);
    svg.close("svg");
    svg.finish() + "\n"
}

const EXAMPLES: &str = "\
A cell is a segment: the next one to the right has an end one ulp farther along x, the next one
above one ulp farther along z. Exact decisions draw the line where it is; plain arithmetic rounds,
and gives neighbouring inputs different answers at random.

Examples
  frusta samples map face -o face.png
  frusta samples map edge -o edge.svg --theme dark

Exit codes:
  0  done
  2  wrong usage, or the picture could not be written";

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::oracle::Oracle;

    #[test]
    fn the_exact_maps_are_what_the_oracle_says() {
        for place in [Place::Face, Place::Edge, Place::Vertex] {
            let frustum = place.frustum().unwrap();
            let oracle = Oracle::new(&frustum);
            let map = Map::new(&frustum, place, &VwProjection::exact(Accuracy::Fast));
            let half = CELLS / 2;
            for (row, answers) in (0..).zip(&map.0) {
                for (column, answer) in (0..).zip(answers) {
                    let segment = place.moved(column - half, half - 1 - row);
                    let truth = oracle.clip(&segment).unwrap();
                    let class = match answer {
                        Answer::Class(class) => *class,
                        Answer::EndsOn => Class::Inside,
                    };
                    assert_eq!(class, truth.class, "{place:?} {column} {row}");
                }
            }
        }
    }
}
