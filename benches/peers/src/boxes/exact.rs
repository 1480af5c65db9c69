//! The truth about boxes, by separating axes in integers.
//!
//! Two convex polyhedra have no point in common exactly if they are strictly apart along
//! the normal of a face of one of them or a cross product of two of their edges. On a grid all
//! of it is integer arithmetic: with coordinates below 2^32, axes are below 2^67 and projections
//! below 2^101. Boxes of no size are points, edges and rectangles; closed sets, so touching counts.

use super::GridBox;
use crate::scene::Camera;
use frusta::Vec3;

type Point = [i128; 3];

/// A frustum in units of the grid divided by the squared length of its pose's axes, where its
/// corners are whole.
pub struct Truth {
    corners: Vec<Point>,
    axes: Vec<Point>,
    scale: i128,
}

/// Coordinates are less than this many steps.
const LIMIT: f64 = 4_194_304.0;

fn on_grid(c: f64) -> Option<i128> {
    let steps = c / GridBox::STEP;
    (steps.fract() == 0.0 && steps.abs() < LIMIT).then_some(steps as i128)
}

fn on_grid_point(p: Vec3<f64>) -> Option<Point> {
    let [x, y, z] = p.to_array().map(on_grid);
    Some([x?, y?, z?])
}

fn dot(a: Point, b: Point) -> i128 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: Point, b: Point) -> Point {
    [1, 2, 0].map(|k| {
        let (i, j) = (k, (k + 1) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// Least and greatest projection.
fn shadow(points: &[Point], axis: Point) -> (i128, i128) {
    let projections = points.iter().map(|p| dot(*p, axis));
    projections.fold((i128::MAX, i128::MIN), |(low, high), d| {
        (low.min(d), high.max(d))
    })
}

impl Truth {
    /// `None` unless the camera's axes are whole numbers, of one length and at right angles, and
    /// the corners in its frame are on the grid.
    pub fn new(camera: &Camera) -> Option<Self> {
        let whole = |v: Vec3<f64>| on_grid_point(v * GridBox::STEP);
        let [a, b, c] = camera.pose.axes.map(whole);
        let rows = [a?, b?, c?];
        let scale = dot(rows[0], rows[0]);
        let is_rotation =
            (0..3).all(|i| (0..3).all(|j| dot(rows[i], rows[j]) == if i == j { scale } else { 0 }));
        let origin = on_grid_point(camera.pose.origin)?;
        let shape = *camera.frustum().shape();
        let ends = [shape.near(), shape.far()?];
        let around = ends.map(|end| {
            let r = end.rect;
            let corner = |x, y| on_grid_point(Vec3::new(x, y, end.z));
            [
                corner(r.left, r.bottom),
                corner(r.right, r.bottom),
                corner(r.right, r.top),
                corner(r.left, r.top),
            ]
        });
        let frame: Option<Vec<Point>> = around.into_iter().flatten().collect();
        // The transposed rows are the inverse, times the scale.
        let world = |q: Point| {
            std::array::from_fn(|k| {
                origin[k] * scale + (0..3).map(|i| rows[i][k] * q[i]).sum::<i128>()
            })
        };
        let corners: Vec<Point> = frame?.into_iter().map(world).collect();
        is_rotation.then(|| Self::of_corners(corners, scale))
    }

    /// Four around the near face, four around the far one.
    fn of_corners(corners: Vec<Point>, scale: i128) -> Self {
        let edge = |i: usize, j: usize| minus(corners[j], corners[i]);
        // Around the near face, around the far face, from one to the other.
        let edges: Vec<Point> = (0..4)
            .flat_map(|i| {
                let next = (i + 1) % 4;
                [edge(i, next), edge(4 + i, 4 + next), edge(i, 4 + i)]
            })
            .collect();
        let units = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        let mut axes = units.to_vec();
        axes.push(cross(edge(4, 5), edge(5, 6)));
        axes.extend((0..4).map(|i| cross(edge(4 + i, 4 + (i + 1) % 4), edge(i, 4 + i))));
        axes.extend(
            edges
                .iter()
                .flat_map(|e| units.iter().map(|u| cross(*e, *u))),
        );
        Self {
            corners,
            axes,
            scale,
        }
    }

    /// Whether the frustum and a box have a point in common; `None` for a box off the grid.
    pub fn meets(&self, block: &GridBox) -> Option<bool> {
        let mut corners = [[0; 3]; 8];
        for (i, corner) in corners.iter_mut().enumerate() {
            for (k, c) in corner.iter_mut().enumerate() {
                let side = [block.min, block.max][i >> k & 1][k];
                *c = self.scale * on_grid(f64::from(side))?;
            }
        }
        let apart = |axis: &Point| {
            let (low, high) = shadow(&self.corners, *axis);
            let (from, to) = shadow(&corners, *axis);
            high < from || to < low
        };
        Some(!self.axes.iter().any(apart))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::oracle::Oracle;
    use frusta::samples::Random;

    /// Points are boxes of no size, and the oracle knows the truth about points.
    #[test]
    fn points_agree_with_the_oracle() {
        for camera in [Camera::LATTICE, Camera::WIDE, Camera::TURNED] {
            let frustum = camera.frustum();
            let (truth, oracle) = (Truth::new(&camera).expect("grid"), Oracle::new(&frustum));
            let mut random = Random::new(&[5]);
            let mut inside = 0;
            for _ in 0..20_000 {
                let far = camera.depths[1].min(130.0) as i64 + 1;
                let p = [(); 3].map(|()| 0.5 * random.integer(-2 * far, 2 * far) as f32);
                let block = GridBox { min: p, max: p };
                let meets = oracle.contains(Vec3::from(p));
                assert_eq!(truth.meets(&block), Some(meets), "{p:?}");
                inside += usize::from(meets);
            }
            assert!(inside > 500, "{inside}");
        }
    }

    #[test]
    fn boxes_beside_an_edge_are_apart() {
        let truth = Truth::new(&Camera::LATTICE).expect("grid");
        let meets = |min, max| truth.meets(&GridBox { min, max });
        // The edge from (1, 1, 1) to (3, 3, 3), touched from outside, passed, and cut.
        assert_eq!(meets([2.0, 2.0, 0.0], [3.0, 3.0, 2.0]), Some(true));
        assert_eq!(meets([2.5, 2.0, 0.0], [3.0, 3.0, 2.0]), Some(false));
        assert_eq!(meets([1.5, 1.5, 1.0], [3.0, 3.0, 2.0]), Some(true));
        // Outside of no face, but outside: beyond the far right top corner's edges.
        assert_eq!(meets([3.5, -9.0, 2.0], [9.0, 9.0, 9.0]), Some(false));
        // It holds all of the frustum.
        assert_eq!(meets([-9.0; 3], [9.0; 3]), Some(true));
        assert_eq!(meets([0.3; 3], [0.3; 3]), None, "off the grid");
    }
}
