//! The segments and frusta that are timed: realistic mixes, from fixed seeds.

pub(crate) mod answers;
mod timed;

pub(crate) use answers::{assert_answers_agree, assert_exact_agree, wrong_answers};
pub(crate) use timed::{call, form_cases, singular};

use frusta::samples::{Placement, Random, Solid, singular_samples};
use frusta::{Direction, EndRect, Frustum, Pose, Real, Rect, Segment, Shape, Vec3};

/// Segments in one mix: more than branch predictors learn by heart. Of 32768
/// that are clipped over and over they learn so much that branches look free.
pub(crate) const COUNT: usize = 262_144;

/// A vector of this length in a random direction.
fn direction(random: &mut Random, length: f64) -> Vec3<f64> {
    loop {
        let mut c = || random.between(-1.0, 1.0);
        let v = Vec3::new(c(), c(), c());
        let square = v.dot(v);
        if (0.01..=1.0).contains(&square) {
            return v * (length / square.sqrt());
        }
    }
}

/// The depth range of every frustum here.
const NEAR: f64 = 1.0;
const FAR: f64 = 100.0;
/// Half-extents for each unit of distance: 60 degrees high, 16:9.
const TAN_Y: f64 = 0.577_350_269_189_625_8;
const TAN_X: f64 = TAN_Y * 16.0 / 9.0;

/// The frusta, each with the form that its plain coefficients take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Perspective; opposite sides mirror each other.
    Symmetric,
    /// Perspective, looking aside.
    OffAxis,
    /// A box.
    Orthographic,
    /// Symmetric perspective without a far face.
    Infinite,
    /// Off-axis perspective without a far face.
    InfiniteOffAxis,
}

impl Form {
    pub(crate) const ALL: [Form; 5] = [
        Form::Symmetric,
        Form::OffAxis,
        Form::Orthographic,
        Form::Infinite,
        Form::InfiniteOffAxis,
    ];

    pub(crate) const fn name(self) -> &'static str {
        [
            "symmetric",
            "off-axis",
            "orthographic",
            "infinite",
            "infinite-off-axis",
        ][self as usize]
    }

    /// The camera looks along `-z`.
    pub(crate) fn shape(self) -> Shape {
        match self {
            Form::Symmetric => perspective(-1.0, 1.0, FAR),
            Form::OffAxis => perspective(-0.9, 1.1, FAR),
            Form::Orthographic => {
                let (x, y) = (0.6 * TAN_X * FAR, 0.6 * TAN_Y * FAR);
                Shape::Finite {
                    near: EndRect::new(-NEAR, -x, x, -y, y),
                    far: EndRect::new(-FAR, -x, x, -y, y),
                }
            }
            Form::Infinite => infinite(-1.0, 1.0),
            Form::InfiniteOffAxis => infinite(-0.9, 1.1),
        }
    }

    /// Nearly the same set of points in the general form: one side is off by
    /// an ulp, and infinity is far away.
    pub(crate) fn generalised(self) -> Shape {
        let mut shape = match self {
            Form::Infinite => perspective(-1.0, 1.0, 1e9),
            Form::InfiniteOffAxis => perspective(-0.9, 1.1, 1e9),
            _ => self.shape(),
        };
        if let Shape::Finite { near, .. } = &mut shape {
            near.rect.left = near.rect.left.next_down();
        }
        shape
    }
}

/// A rectangle across the view, `left..right` in half-widths.
fn across(distance: f64, left: f64, right: f64) -> EndRect {
    let (x, y) = (TAN_X * distance, TAN_Y * distance);
    EndRect::new(-distance, left * x, right * x, -y, y)
}

fn perspective(left: f64, right: f64, far: f64) -> Shape {
    Shape::Finite {
        near: across(NEAR, left, right),
        far: across(far, left, right),
    }
}

fn infinite(left: f64, right: f64) -> Shape {
    Shape::Infinite {
        near: across(NEAR, left, right),
        slopes: Rect::new(left * TAN_X, right * TAN_X, -TAN_Y, TAN_Y),
        direction: Direction::MinusZ,
    }
}

/// The poses: the world's own frame, and a camera somewhere.
pub(crate) fn poses() -> [(&'static str, Pose); 2] {
    [("frame", Pose::IDENTITY), ("world", rotated())]
}

/// A camera somewhere, turned about all three axes.
fn rotated() -> Pose {
    // The rotation of the quaternion (0.8, 0.36, 0.32, 0.36), of length 1.
    let (w, x, y, z) = (0.8_f64, 0.36_f64, 0.32_f64, 0.36_f64);
    let axes = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + w * z),
            2.0 * (x * z - w * y),
        ],
        [
            2.0 * (x * y - w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z + w * x),
        ],
        [
            2.0 * (x * z + w * y),
            2.0 * (y * z - w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ];
    Pose::new(Vec3::new(12.5, -3.75, 41.0), axes.map(Vec3::from))
}

/// What kind of segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mix {
    /// A scene all around the camera: short edges, most of them elsewhere.
    MostlyOut,
    /// About a third each: outside, inside, clipped.
    Mixed,
    /// An object in view: short edges, a few of them over the border.
    MostlyIn,
    /// Construction lines and grids: both ends far outside.
    LongCrossing,
}

impl Mix {
    pub(crate) const ALL: [Mix; 4] = [Mix::MostlyOut, Mix::Mixed, Mix::MostlyIn, Mix::LongCrossing];

    pub(crate) const fn name(self) -> &'static str {
        ["mostly-out", "mixed", "mostly-in", "long-crossing"][self as usize]
    }

    /// The segments, carried from the frame to the world of the pose.
    pub(crate) fn segments<T: Real>(self, pose: &Pose) -> Vec<Segment<T>> {
        self.first(COUNT, pose)
    }

    /// The first so many of them.
    pub(crate) fn first<T: Real>(self, count: usize, pose: &Pose) -> Vec<Segment<T>> {
        let mut random = Random::new(&[self as u64]);
        let to_world = |v| Vec3::from_f64(pose.to_world(v));
        (0..count)
            .map(|_| {
                let s = segment(&mut random, self);
                Segment::new(to_world(s.start), to_world(s.end))
            })
            .collect()
    }
}

/// A point of the frustum grown about its middle, even in depth.
fn near_point(random: &mut Random, grown: f64) -> Vec3<f64> {
    let middle = 0.5 * (NEAR + FAR);
    let depth = middle + grown * (random.between(NEAR, FAR) - middle);
    let (x, y) = (TAN_X * depth * grown, TAN_Y * depth * grown);
    Vec3::new(random.between(-x, x), random.between(-y, y), -depth)
}

/// One segment of a mix, in the frame.
fn segment(random: &mut Random, mix: Mix) -> Segment<f64> {
    let (p, length) = match mix {
        Mix::MostlyOut => {
            let all = 1.5 * FAR;
            let p = Vec3::new(
                random.between(-all, all),
                random.between(-all, all),
                random.between(-all, all),
            );
            (p, random.between(1.0, 40.0))
        }
        Mix::Mixed => (near_point(random, 1.25), random.between(1.0, 60.0)),
        Mix::MostlyIn => (near_point(random, 0.98), random.between(0.5, 8.0)),
        Mix::LongCrossing => {
            let p = near_point(random, 1.05);
            let d = direction(random, 1.0);
            let (back, forth) = (random.between(200.0, 900.0), random.between(200.0, 900.0));
            return Segment::new(p - d * back, p + d * forth);
        }
    };
    Segment::new(p, p + direction(random, length))
}

/// The frustum of a shape at a pose.
pub(crate) fn frustum(shape: Shape, pose: &Pose) -> Frustum {
    Frustum::new(*pose, shape).expect("the benchmarks' frusta are valid")
}

/// The 78 singular samples, at a placement: the frustum, and as many segments
/// as in a mix, drawn at random, so that no branch predictor learns their order.
pub(crate) fn samples<T: Real>(placement: &Placement) -> (Frustum, Vec<Segment<T>>) {
    let solid = Solid::SYMMETRIC;
    let all: Vec<Segment<T>> = singular_samples(&solid)
        .iter()
        .map(|sample| {
            let s = placement.segment(&sample.segment);
            Segment::new(Vec3::from_f64(s.start), Vec3::from_f64(s.end))
        })
        .collect();
    assert_eq!(all.len(), 78);
    let mut random = Random::new(&[78]);
    let drawn = (0..COUNT).map(|_| random.pick(&all)).collect();
    let frustum = placement
        .place(&solid)
        .expect("the samples' frusta are valid");
    (frustum, drawn)
}
