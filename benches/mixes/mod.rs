//! The segments and frusta that are timed: realistic mixes, from fixed seeds.

mod answers;

pub(crate) use answers::assert_answers_agree;

use frusta::{Direction, EndRect, Frustum, Pose, Real, Rect, Segment, Shape, Vec3};

/// Segments in one mix: more than branch predictors learn by heart.
pub(crate) const COUNT: usize = 4096;

/// A small generator of numbers (SplitMix64), so that no crate's update changes
/// what is timed.
struct Rng(u64);

impl Rng {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.next() >> 11) as f64 / (1u64 << 53) as f64;
        low + unit * (high - low)
    }

    /// A vector of this length in a random direction.
    fn direction(&mut self, length: f64) -> Vec3<f64> {
        loop {
            let v = Vec3::new(
                self.between(-1.0, 1.0),
                self.between(-1.0, 1.0),
                self.between(-1.0, 1.0),
            );
            let square = v.dot(v);
            if (0.01..=1.0).contains(&square) {
                return v * (length / square.sqrt());
            }
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
        let mut rng = Rng(0x5eed_0000 + self as u64);
        let to_world = |v| Vec3::from_f64(pose.to_world(v));
        (0..COUNT)
            .map(|_| {
                let s = segment(&mut rng, self);
                Segment::new(to_world(s.start), to_world(s.end))
            })
            .collect()
    }
}

/// A point of the frustum grown about its middle, even in depth.
fn near_point(rng: &mut Rng, grown: f64) -> Vec3<f64> {
    let middle = 0.5 * (NEAR + FAR);
    let depth = middle + grown * (rng.between(NEAR, FAR) - middle);
    let (x, y) = (TAN_X * depth * grown, TAN_Y * depth * grown);
    Vec3::new(rng.between(-x, x), rng.between(-y, y), -depth)
}

/// One segment of a mix, in the frame.
fn segment(rng: &mut Rng, mix: Mix) -> Segment<f64> {
    let (p, length) = match mix {
        Mix::MostlyOut => {
            let all = 1.5 * FAR;
            let p = Vec3::new(
                rng.between(-all, all),
                rng.between(-all, all),
                rng.between(-all, all),
            );
            (p, rng.between(1.0, 40.0))
        }
        Mix::Mixed => (near_point(rng, 1.25), rng.between(1.0, 60.0)),
        Mix::MostlyIn => (near_point(rng, 0.98), rng.between(0.5, 8.0)),
        Mix::LongCrossing => {
            let p = near_point(rng, 1.05);
            let d = rng.direction(1.0);
            let (back, forth) = (rng.between(200.0, 900.0), rng.between(200.0, 900.0));
            return Segment::new(p - d * back, p + d * forth);
        }
    };
    Segment::new(p, p + rng.direction(length))
}

/// The frustum of a shape at a pose.
pub(crate) fn frustum(shape: Shape, pose: &Pose) -> Frustum {
    Frustum::new(*pose, shape).expect("the benchmarks' frusta are valid")
}
