//! The frusta of the benchmarks' everyday segments, and the 78 singular samples.

pub mod answers;
mod timed;

pub use answers::{assert_answers_agree, assert_exact_agree, wrong_answers};
pub use timed::{call, form_cases, singular};

pub use frusta::samples::Mix;

use frusta::samples::{Placement, Random, Solid, singular_samples};
use frusta::{Direction, EndRect, Frustum, Pose, Real, Rect, Segment, Shape, Vec3};

/// Segments in one mix: more than branch predictors learn by heart. They learn so much of 32,768
/// that are clipped over and over that branches look free.
pub const COUNT: usize = 262_144;

/// The frusta, each with the form that its plain coefficients take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
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
    /// Every form.
    pub const ALL: [Form; 5] = [
        Form::Symmetric,
        Form::OffAxis,
        Form::Orthographic,
        Form::Infinite,
        Form::InfiniteOffAxis,
    ];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        [
            "symmetric",
            "off-axis",
            "orthographic",
            "infinite",
            "infinite-off-axis",
        ][self as usize]
    }

    /// The view that the mixes are made for, in this form.
    pub fn shape(self) -> Shape {
        let view = View::of_mixes();
        match self {
            Form::Symmetric => Mix::shape(),
            Form::OffAxis => view.perspective(ASIDE, view.far),
            Form::Orthographic => view.orthographic(),
            Form::Infinite => view.infinite(AHEAD),
            Form::InfiniteOffAxis => view.infinite(ASIDE),
        }
    }

    /// Nearly the same set of points in the general form: one side is off by
    /// an ulp, and infinity is far away.
    pub fn generalised(self) -> Shape {
        let view = View::of_mixes();
        let mut shape = match self {
            Form::Infinite => view.perspective(AHEAD, 1e9),
            Form::InfiniteOffAxis => view.perspective(ASIDE, 1e9),
            _ => self.shape(),
        };
        if let Shape::Finite { near, .. } = &mut shape {
            near.rect.left = near.rect.left.next_down();
        }
        shape
    }
}

/// Left and right, in half-widths.
type Sides = [f64; 2];

const AHEAD: Sides = [-1.0, 1.0];
const ASIDE: Sides = [-0.9, 1.1];

/// The measures of the mixes' view.
struct View {
    /// Distances.
    near: f64,
    far: f64,
    /// Half-extents for each unit of distance.
    tan_x: f64,
    tan_y: f64,
}

impl View {
    fn of_mixes() -> Self {
        let shape = Mix::shape();
        let (near, far) = (shape.near(), shape.far().expect("has a far face"));
        Self {
            near: -near.z,
            far: -far.z,
            tan_x: near.rect.right / -near.z,
            tan_y: near.rect.top / -near.z,
        }
    }

    /// A rectangle across the view.
    fn across(&self, distance: f64, [left, right]: Sides) -> EndRect {
        let (x, y) = (self.tan_x * distance, self.tan_y * distance);
        EndRect::new(-distance, left * x, right * x, -y, y)
    }

    fn perspective(&self, sides: Sides, far: f64) -> Shape {
        Shape::Finite {
            near: self.across(self.near, sides),
            far: self.across(far, sides),
        }
    }

    fn orthographic(&self) -> Shape {
        let (x, y) = (0.6 * self.tan_x * self.far, 0.6 * self.tan_y * self.far);
        let end = |distance: f64| EndRect::new(-distance, -x, x, -y, y);
        Shape::Finite {
            near: end(self.near),
            far: end(self.far),
        }
    }

    fn infinite(&self, [left, right]: Sides) -> Shape {
        let (x, y) = (self.tan_x, self.tan_y);
        Shape::Infinite {
            near: self.across(self.near, [left, right]),
            slopes: Rect::new(left * x, right * x, -y, y),
            direction: Direction::MinusZ,
        }
    }
}

/// The frustum of a shape at a pose.
pub fn frustum(shape: Shape, pose: &Pose) -> Frustum {
    Frustum::new(*pose, shape).expect("the benchmarks' frusta are valid")
}

/// The 78 singular samples, at a placement: the frustum, and as many segments
/// as in a mix, drawn at random, so that no branch predictor learns their order.
pub fn samples<T: Real>(placement: &Placement) -> (Frustum, Vec<Segment<T>>) {
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
