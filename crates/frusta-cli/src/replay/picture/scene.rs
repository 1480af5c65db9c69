//! A case, ready for drawing: the frustum as a solid of moderate size,
//! what of the segment is near it, the truth about that, the places of all answers.

use super::exact::{Exact, Point, Rim, Window, between, exact, in_frame, point, rims};
use crate::replay::answers::{Answer, Replay};
use frusta::oracle::{OracleEnd, round_nearest};
use frusta::samples::Solid;
use frusta::{EndRect, FaceSet, Part, PartEnd, Rect, Segment, SegmentClip, Shape, Vec3};
use num_traits::{One, Zero};

/// How far beyond the frustum is drawn, of its size.
const MARGIN: f64 = 2.2;

/// The depth that a solid without a far end is drawn to.
const REACH: f64 = 32.0;

/// A case in the frustum's frame.
pub(super) struct Scene {
    /// The segment's ends.
    pub(super) ends: [Point; 2],
    pub(super) rims: [Rim; 2],
    /// Where the frustum is seen.
    pub(super) window: Window,
    /// The frustum there.
    pub(super) solid: Solid,
    /// The length in the solid of a length of 1 in the window.
    size: f64,
}

impl Scene {
    pub(super) fn new(replay: &Replay) -> Self {
        let frustum = &replay.case.frustum;
        let Segment { start, end } = replay.segment;
        let ends = [start, end].map(|p| in_frame(frustum.pose(), &point(p)));
        let part = replay.truth.part.as_ref();
        // Far ends of a segment are cut off rather than shown.
        let shown: Vec<Point> = part.map_or_else(Vec::new, |part| {
            let ends = [&part.entry, &part.exit].into_iter();
            let clipped = ends.filter(|e| e.clipped);
            clipped
                .map(|e| in_frame(frustum.pose(), &e.point))
                .collect()
        });
        let rims = rims(frustum, &shown);
        let window = Window::of_frustum(&rims);
        let depth = window.coordinate(2, &rims[1].z) - window.coordinate(2, &rims[0].z);
        let infinite = frustum.shape().far().is_none();
        let size = if infinite { REACH / depth.abs() } else { 1.0 };
        let solid = solid(&rims, &window, size, frustum.shape());
        Self {
            ends,
            rims,
            window,
            solid,
            size,
        }
    }

    /// Where a point is beside the solid.
    pub(super) fn place(&self, p: &Point) -> Vec3<f64> {
        self.window.place(p) * self.size
    }

    /// The parameters of the part of a line that is near the frustum.
    pub(super) fn near(&self, a: &Point, b: &Point) -> Option<[Exact; 2]> {
        self.window.within([a, b], MARGIN, &[0, 1, 2])
    }

    /// What of the segment is near the frustum, and the truth about that; `None` if
    /// nothing is.
    pub(super) fn near_piece(&self, replay: &Replay) -> Option<NearPiece> {
        let [a, b] = &self.ends;
        let range = self.near(a, b)?;
        let segment = range.each_ref().map(|t| self.place(&between(a, b, t)));
        Some(NearPiece {
            segment: Segment::new(segment[0], segment[1]),
            clip: truth_within(replay, &range),
            shown: shown(&range),
        })
    }
}

/// A piece of the segment, to be drawn.
pub(super) struct NearPiece {
    pub(super) segment: Segment<f64>,
    /// By the piece's own parameter.
    pub(super) clip: SegmentClip<f64>,
    pub(super) shown: [f64; 2],
}

/// A piece that ends before the segment does has no head: it is shown up to a hair
/// before its end.
pub(super) fn shown([_, high]: &[Exact; 2]) -> [f64; 2] {
    if high.is_one() {
        [0.0, 1.0]
    } else {
        [0.0, 1.0_f64.next_down()]
    }
}

/// The truth by the parameter of a piece of the segment.
pub(super) fn truth_within(replay: &Replay, [low, high]: &[Exact; 2]) -> SegmentClip<f64> {
    let class = replay.truth.class;
    let length = high - low;
    let at = |t: &Exact| -> f64 {
        if length.is_zero() {
            0.0
        } else {
            round_nearest(&((t - low) / &length))
        }
    };
    let end = |e: &OracleEnd| PartEnd {
        t: at(&e.t).clamp(0.0, 1.0),
        point: Vec3::default(),
        clipped: e.clipped && e.t >= *low && e.t <= *high,
        faces: e.faces,
        inward: false,
    };
    let part = replay.truth.part.as_ref();
    let part = part.filter(|p| p.exit.t >= *low && p.entry.t <= *high);
    SegmentClip {
        class,
        part: part.map(|p| Part {
            entry: end(&p.entry),
            exit: end(&p.exit),
            coplanar: FaceSet::EMPTY,
        }),
    }
}

/// The points of an answer, in the frame: where it enters and leaves.
pub(super) fn points(replay: &Replay, answer: &Answer) -> Option<[Point; 2]> {
    let part = answer.verdict.clip.as_ref()?.part?;
    let pose = replay.case.frustum.pose();
    Some([part.entry, part.exit].map(|e| in_frame(pose, &point(e.point))))
}

/// The frustum in its window, as a solid that has a name for drawings only.
fn solid(rims: &[Rim; 2], window: &Window, size: f64, shape: &Shape) -> Solid {
    let end = |rim: &Rim| {
        let side = |k: usize| window.coordinate(k / 2, &rim.sides[k]) * size;
        let z = window.coordinate(2, &rim.z) * size;
        EndRect::new(z, side(0), side(1), side(2), side(3))
    };
    let [near, far] = [end(&rims[0]), end(&rims[1])];
    let shape = match *shape {
        Shape::Finite { .. } => Shape::Finite { near, far },
        Shape::Infinite { direction, .. } => {
            let (n, f) = (near.rect, far.rect);
            let slope = |n: f64, f: f64| (f - n) / REACH;
            Shape::Infinite {
                near,
                slopes: Rect::new(
                    slope(n.left, f.left),
                    slope(n.right, f.right),
                    slope(n.bottom, f.bottom),
                    slope(n.top, f.top),
                ),
                direction,
            }
        }
    };
    Solid {
        name: "replayed",
        shape,
    }
}

/// The unit in the last place, in `f64`, of a point's largest coordinate.
pub(super) fn step_at(p: &Point) -> Exact {
    let near = p.each_ref().map(round_nearest::<f64>);
    let largest = near.iter().fold(0.0_f64, |a, c| a.max(c.abs()));
    // A frame's coordinates may be beyond the range of `f64`.
    let above = largest.next_up().min(f64::MAX);
    exact(above) - exact(above.next_down())
}
