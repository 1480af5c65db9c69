//! The separating axis test as it is usually written, in plain arithmetic: what the exact test is
//! compared with.

use frusta::{Aabb, Corners, FarCorners, Frustum, Vec3};

/// The axes of a finite frustum.
pub(crate) struct SeparatingAxes {
    corners: [Vec3<f64>; 8],
    axes: Vec<Vec3<f64>>,
    /// The range of the corners' values along each axis.
    slabs: Vec<[f64; 2]>,
}

fn range(axis: Vec3<f64>, points: &[Vec3<f64>; 8]) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for p in points {
        let at = axis.dot(*p);
        range = [range[0].min(at), range[1].max(at)];
    }
    range
}

impl SeparatingAxes {
    /// The faces' normals, the world's axes, and the edges' cross products with these: they are the
    /// same for all axis-aligned boxes.
    pub(crate) fn new(frustum: &Frustum) -> Self {
        let Corners { near, far } = frustum.corners();
        let FarCorners::Points(far) = far else {
            panic!("the frustum is infinite");
        };
        let corners = std::array::from_fn(|i| if i < 4 { near[i] } else { far[i - 4] });
        let world = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::from);
        let mut edges = vec![near[1] - near[0], near[3] - near[0]];
        edges.extend((0..4).map(|i| far[i] - near[i]));
        let faces = frustum.planes().map(|(_, plane)| plane.normal);
        // Near and far share a normal.
        let mut axes: Vec<_> = faces.skip(1).chain(world).collect();
        axes.extend(edges.iter().flat_map(|e| world.map(|w| e.cross(w))));
        let slabs = axes.iter().map(|axis| range(*axis, &corners)).collect();
        Self {
            corners,
            axes,
            slabs,
        }
    }

    /// Compares all corners along each axis, until one separates.
    pub(crate) fn meets(&self, volume: &Aabb<f32>) -> bool {
        let ends = [volume.min.to_f64(), volume.max.to_f64()];
        let of = |bits: usize, axis: usize| ends[bits >> axis & 1][axis];
        let corners = std::array::from_fn(|i| Vec3::new(of(i, 0), of(i, 1), of(i, 2)));
        self.axes.iter().all(|axis| {
            let ([a, b], [c, d]) = (range(*axis, &self.corners), range(*axis, &corners));
            a <= d && c <= b
        })
    }

    /// Compares middle and half extents with the slabs along each axis, until one separates.
    pub(crate) fn meets_slabs(&self, volume: &Aabb<f32>) -> bool {
        let (min, max) = (volume.min.to_f64(), volume.max.to_f64());
        let (center, half) = ((min + max) * 0.5, (max - min) * 0.5);
        let mut all = self.axes.iter().zip(&self.slabs);
        all.all(|(axis, [a, b])| {
            let middle = axis.dot(center);
            let reach = axis.x.abs() * half.x + axis.y.abs() * half.y + axis.z.abs() * half.z;
            *a <= middle + reach && middle - reach <= *b
        })
    }
}
