//! From the solid's frame to the picture, in perspective.

use super::canvas::Place;
use frusta::Vec3;
use frusta::samples::Solid;

/// A camera outside of a solid, beside and above it, before its near end, so
/// that depth grows to the right.
pub(crate) struct Camera {
    eye: Vec3<f64>,
    right: Vec3<f64>,
    up: Vec3<f64>,
    forward: Vec3<f64>,
    /// Nothing nearer is drawn.
    nearest: f64,
    scale: f64,
    middle: Place,
    offset: Place,
}

impl Camera {
    /// Placed so that these points fill a picture of this size, except for a
    /// margin.
    pub(crate) fn new(solid: &Solid, fit: &[Vec3<f64>], size: Place, margin: f64) -> Self {
        let along = solid.shape.direction().sign();
        let towards = unit(Vec3::new(-0.78 * along, 0.5, -0.42 * along));
        let centre =
            (fit.iter().fold(Vec3::default(), |sum, &p| sum + p)) * (1.0 / fit.len() as f64);
        let reach = fit.iter().map(|&p| length(p - centre)).fold(1e-9, f64::max);
        let forward = -towards;
        let right = unit(forward.cross(Vec3::new(0.0, 1.0, 0.0)));
        let mut camera = Self {
            eye: centre + towards * (reach * 3.2),
            right,
            up: right.cross(forward),
            forward,
            nearest: 0.2 * reach,
            scale: 1.0,
            middle: [0.0; 2],
            offset: [size[0] / 2.0, size[1] / 2.0],
        };
        let places: Vec<Place> = fit.iter().map(|&p| camera.project(p)).collect();
        let mut scale = f64::INFINITY;
        for (k, room) in size.into_iter().enumerate() {
            let low = places.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
            let high = places.iter().map(|p| p[k]).fold(-f64::INFINITY, f64::max);
            camera.middle[k] = 0.5 * (low + high);
            scale = scale.min((room - 2.0 * margin) / (high - low));
        }
        camera.scale = scale;
        camera
    }

    /// Where a point is in the picture; it must lie before the eye.
    pub(crate) fn place(&self, p: Vec3<f64>) -> Place {
        let [x, y] = self.project(p);
        [
            self.offset[0] + (x - self.middle[0]) * self.scale,
            self.offset[1] + (y - self.middle[1]) * self.scale,
        ]
    }

    /// Whether a plane's side that this normal points to is seen.
    pub(crate) fn sees(&self, point: Vec3<f64>, normal: Vec3<f64>) -> bool {
        normal.dot(self.eye - point) > 0.0
    }

    /// The parameters of what of a line lies well before the eye.
    pub(crate) fn before_eye(&self, p: Vec3<f64>, q: Vec3<f64>) -> Option<[f64; 2]> {
        let [a, b] = [p, q].map(|p| self.forward.dot(p - self.eye) - self.nearest);
        match (a < 0.0, b < 0.0) {
            (true, true) => None,
            (true, false) => Some([a / (a - b), 1.0]),
            (false, true) => Some([0.0, a / (a - b)]),
            (false, false) => Some([0.0, 1.0]),
        }
    }

    fn project(&self, p: Vec3<f64>) -> Place {
        let d = p - self.eye;
        let depth = self.forward.dot(d);
        [self.right.dot(d) / depth, -self.up.dot(d) / depth]
    }
}

fn length(v: Vec3<f64>) -> f64 {
    v.dot(v).sqrt()
}

fn unit(v: Vec3<f64>) -> Vec3<f64> {
    v * (1.0 / length(v))
}
