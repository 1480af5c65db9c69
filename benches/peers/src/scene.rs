//! The frusta, and the matrices and boxes that describe them to the others.

use frusta::{EndRect, Frustum, Pose, Rect, Shape, Vec3};
use frusta_lab::mixes::{self, Form};

/// A symmetric perspective camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Half-widths for each unit of depth, across and up.
    pub slopes: [f64; 2],
    /// Depth of the near and the far face.
    pub depths: [f64; 2],
    /// The sign of its direction along its frame's `z`: 1 or -1.
    pub direction: f64,
    /// Its position and axes.
    pub pose: Pose,
}

impl Camera {
    /// Between `z = 1` and `z = 3`, sides of slope 1: its matrix has small integers only,
    /// so no library is given a rounded one.
    pub const LATTICE: Self = Self {
        slopes: [1.0, 1.0],
        depths: [1.0, 3.0],
        direction: 1.0,
        pose: Pose::IDENTITY,
    };

    /// A wide view as far as 129, so that its matrix is exact in `f32`: its entries
    /// are 1, 2, 65/64 and -129/64.
    pub const WIDE: Self = Self {
        slopes: [1.0, 0.5],
        depths: [1.0, 129.0],
        direction: -1.0,
        pose: Pose::IDENTITY,
    };

    /// The same view, turned by the quaternion (4, 1, 2, 2): axes of whole numbers, 25 long, so
    /// that depths are 25 times as large; its matrix is exact in `f32`, too.
    pub const TURNED: Self = Self {
        depths: [25.0, 3225.0],
        pose: Pose::new(
            Vec3::new(0.0, 0.0, 0.0),
            [
                Vec3::new(9.0, -12.0, 20.0),
                Vec3::new(20.0, 15.0, 0.0),
                Vec3::new(-12.0, 16.0, 15.0),
            ],
        ),
        ..Self::WIDE
    };

    /// The camera of frusta's own benchmarks: 60 degrees high, 16:9, 1 to 100.
    ///
    /// # Panics
    /// The benchmarks' frustum has been changed.
    pub fn of_mixes(pose: Pose) -> Self {
        let shape = Form::Symmetric.shape();
        let (near, far) = (shape.near(), shape.far().expect("has a far face"));
        Self {
            slopes: [near.rect.right / -near.z, near.rect.top / -near.z],
            depths: [-near.z, -far.z],
            direction: -1.0,
            pose,
        }
    }

    /// The frustum itself, exactly: what everybody is held against.
    pub fn frustum(&self) -> Frustum {
        let end = |depth: f64| {
            let [x, y] = self.slopes.map(|slope| slope * depth);
            EndRect::new(self.direction * depth, -x, x, -y, y)
        };
        let [near, far] = self.depths.map(end);
        mixes::frustum(Shape::Finite { near, far }, &self.pose)
    }

    /// World to clip space, rows; depth goes from -1 to 1 (times `w`), as in OpenGL.
    pub fn clip_from_world(&self) -> [[f64; 4]; 4] {
        let [near, far] = self.depths;
        let row = |k: usize, scale: f64| {
            let axis = self.pose.axes[k] * scale;
            let [x, y, z] = axis.to_array();
            [x, y, z, 0.0 - axis.dot(self.pose.origin)]
        };
        let [across, up] = [0, 1].map(|k| row(k, 1.0 / self.slopes[k]));
        let depth = row(2, self.direction);
        let mut z = depth.map(|c| c * ((far + near) / (far - near)));
        z[3] -= 2.0 * far * near / (far - near);
        [across, up, z, depth]
    }

    /// The same, rounded to `f32`.
    pub fn clip_from_world_f32(&self) -> [[f32; 4]; 4] {
        self.clip_from_world().map(|row| row.map(|c| c as f32))
    }

    /// The inward planes `a x + b y + c z + d >= 0` of the left, right, bottom, top, near
    /// and far face, sums and differences of the matrix's rows.
    pub fn planes(&self) -> [[f64; 4]; 6] {
        let [x, y, z, w] = self.clip_from_world();
        let plus = |a: [f64; 4]| std::array::from_fn(|k| w[k] + a[k]);
        let minus = |a: [f64; 4]| std::array::from_fn(|k| w[k] - a[k]);
        [plus(x), minus(x), plus(y), minus(y), plus(z), minus(z)]
    }

    /// The frustum's bounding box, for a camera in its own frame.
    pub fn bounds(&self) -> Block {
        let [near, far] = self.depths.map(|depth| depth * self.direction);
        let [x, y] = self.slopes.map(|slope| slope * self.depths[1]);
        Block {
            min: [-x, -y, near.min(far)],
            max: [x, y, near.max(far)],
        }
    }
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Least coordinates.
    pub min: [f64; 3],
    /// Greatest coordinates.
    pub max: [f64; 3],
}

impl Block {
    /// From -1 to 1.
    pub const CUBE: Self = Self {
        min: [-1.0; 3],
        max: [1.0; 3],
    };

    /// The box of frusta's own benchmarks, its sides rounded to `f32`, so that it is the same
    /// for everybody.
    ///
    /// # Panics
    /// The benchmarks' box is not what it was when this was written.
    pub fn of_mixes() -> Self {
        let shape = Form::Orthographic.shape();
        let (near, far) = (shape.near(), shape.far().expect("has a far face"));
        let Rect {
            left,
            right,
            bottom,
            top,
        } = near.rect;
        let single = |c: f64| f64::from(c as f32);
        Self {
            min: [left, bottom, far.z].map(single),
            max: [right, top, near.z].map(single),
        }
    }

    /// The box as a frustum: orthographic.
    pub fn frustum(&self) -> Frustum {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.min, self.max);
        let end = |z| EndRect::new(z, x0, x1, y0, y1);
        let shape = Shape::Finite {
            near: end(z1),
            far: end(z0),
        };
        mixes::frustum(shape, &Pose::IDENTITY)
    }

    /// The eight corners.
    pub fn corners(&self) -> [Vec3<f64>; 8] {
        std::array::from_fn(|i| {
            let side = |k: usize| [self.min, self.max][i >> k & 1][k];
            Vec3::new(side(0), side(1), side(2))
        })
    }
}
