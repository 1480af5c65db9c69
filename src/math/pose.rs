//! Where a frame stands in the world.

use super::Vec3;

/// A frame: an origin and three linearly independent axes.
///
/// The frame coordinates of a point `p` are `axes[k] . (p - origin)`. No unit
/// length, no right angles and no handedness are assumed: integer axes keep a
/// rotated frame exact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// The point whose frame coordinates are zero.
    pub origin: Vec3<f64>,
    /// The rows of the world-to-frame matrix.
    pub axes: [Vec3<f64>; 3],
}

impl Pose {
    /// The frame that is the world.
    pub const IDENTITY: Pose = Pose {
        origin: Vec3::new(0.0, 0.0, 0.0),
        axes: [
            Vec3::new(1.0, 0.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(0.0, 0.0, 1.0),
        ],
    };

    /// From an origin and three axes.
    pub const fn new(origin: Vec3<f64>, axes: [Vec3<f64>; 3]) -> Self {
        Self { origin, axes }
    }

    /// Whether frame coordinates are world coordinates.
    pub fn is_identity(&self) -> bool {
        *self == Self::IDENTITY
    }

    /// Frame coordinates of a point, rounded: for drawing and for plain
    /// arithmetic, never for exact decisions.
    #[inline(always)]
    pub fn to_frame(&self, p: Vec3<f64>) -> Vec3<f64> {
        let c = p - self.origin;
        Vec3::new(
            self.axes[0].dot(c),
            self.axes[1].dot(c),
            self.axes[2].dot(c),
        )
    }

    /// The point whose frame coordinates these are, rounded: the paper's
    /// inverse transform (step 4).
    pub fn to_world(&self, q: Vec3<f64>) -> Vec3<f64> {
        let [a, b, c] = self.axes;
        let det = a.dot(b.cross(c));
        let columns = b.cross(c) * q.x + c.cross(a) * q.y + a.cross(b) * q.z;
        self.origin + Vec3::new(columns.x / det, columns.y / det, columns.z / det)
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}
