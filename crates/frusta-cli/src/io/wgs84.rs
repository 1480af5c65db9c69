//! Longitude, latitude and height on the WGS 84 ellipsoid, and what a camera
//! above it sees of it.
//!
//! Source: NIMA TR8350.2, "Department of Defense World Geodetic System 1984".

use frusta::Vec3;

/// The equatorial radius in metres.
pub(crate) const RADIUS: f64 = 6_378_137.0;
const A: f64 = RADIUS;
/// The flattening.
const F: f64 = 1.0 / 298.257_223_563;
/// The polar radius in metres.
const B: f64 = A * (1.0 - F);

/// Earth-centred, earth-fixed coordinates in metres of a longitude and a
/// latitude in degrees and a height in metres.
///
/// Within a few nanometres: sine and cosine are `libm`'s, so that the bits do not
/// depend on the platform.
pub(crate) fn ecef(longitude: f64, latitude: f64, height: f64) -> Result<Vec3<f64>, String> {
    if !(-90.0..=90.0).contains(&latitude) {
        return Err(format!(
            "latitude {latitude:?} is not within -90 to 90 degrees"
        ));
    }
    if !(-360.0..=360.0).contains(&longitude) {
        return Err(format!(
            "longitude {longitude:?} is not within -360 to 360 degrees"
        ));
    }
    let (sin, cos) = sin_cos(latitude);
    let (east, north) = sin_cos(longitude);
    let e2 = F * (2.0 - F);
    let normal = A / (1.0 - e2 * sin * sin).sqrt();
    let ring = (normal + height) * cos;
    let z = (normal * (1.0 - e2) + height) * sin;
    Ok(Vec3::new(ring * north, ring * east, z))
}

/// Sine and cosine of degrees, exact at multiples of 90.
fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.abs() {
        0.0 | 360.0 => (0.0, 1.0),
        90.0 => (degrees.signum(), 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-degrees.signum(), 0.0),
        _ => libm::sincos(degrees.to_radians()),
    }
}

/// Where the ellipsoid ends for an eye outside it: the direction to look in and
/// the distance in that direction of the plane through the horizon.
///
/// The points where lines through the eye `e` touch the ellipsoid `p.Qp = 1`, with
/// `Q` = diag(1/a^2, 1/a^2, 1/b^2), are those of the plane `p.Qe = 1`. A camera
/// that looks against its normal `Qe` has it as a plane of equal depth: everything
/// nearer is this side of the horizon.
pub(crate) fn horizon(eye: Vec3<f64>) -> Option<(Vec3<f64>, f64)> {
    let q = Vec3::new(eye.x / A / A, eye.y / A / A, eye.z / B / B);
    let excess = eye.dot(q) - 1.0;
    let length = q.dot(q).sqrt();
    let distance = excess / length;
    (distance > 0.0 && distance.is_finite()).then(|| (q * (-1.0 / length), distance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_points() {
        assert_eq!(ecef(0.0, 0.0, 0.0).unwrap(), Vec3::new(A, 0.0, 0.0));
        assert_eq!(ecef(90.0, 0.0, 1.0).unwrap(), Vec3::new(0.0, A + 1.0, 0.0));
        let pole = ecef(123.0, 90.0, 0.0).unwrap();
        assert!((pole.z - 6_356_752.314_245).abs() < 1e-6 && pole.x == 0.0);
        // On the ellipsoid: x^2/a^2 + y^2/a^2 + z^2/b^2 = 1.
        for (lon, lat) in [(11.5, 48.1), (-70.0, -33.0), (179.9, 66.0), (-180.0, 10.0)] {
            let p = ecef(lon, lat, 0.0).unwrap();
            let sum = (p.x * p.x + p.y * p.y) / (A * A) + p.z * p.z / (B * B);
            assert!((sum - 1.0).abs() < 1e-15, "{sum}");
        }
        assert!(ecef(0.0, 91.0, 0.0).is_err() && ecef(400.0, 0.0, 0.0).is_err());
        assert!(ecef(0.0, f64::NAN, 0.0).is_err());
    }

    #[test]
    fn lines_to_the_horizon_touch() {
        let eye = ecef(10.0, 50.0, 1e6).unwrap();
        let (way, distance) = horizon(eye).unwrap();
        assert!((way.dot(way) - 1.0).abs() < 1e-15);
        // On a sphere h (2 r + h) / (r + h): 1,864 km; the earth is nearly one.
        assert!((distance - 1.864e6).abs() < 2e4, "{distance}");
        // A point of the ellipsoid in that plane: its normal is at right angles to
        // the line of sight.
        let foot = eye + way * distance;
        let side = Vec3::new(-way.y, way.x, 0.0);
        let side = side * (1.0 / side.dot(side).sqrt());
        let q = |p: Vec3<f64>| Vec3::new(p.x / A / A, p.y / A / A, p.z / B / B);
        // foot + s side on the ellipsoid.
        let (a, b) = (side.dot(q(side)), foot.dot(q(side)));
        let c = foot.dot(q(foot)) - 1.0;
        let s = (-b + (b * b - a * c).sqrt()) / a;
        let p = foot + side * s;
        let sight = p - eye;
        let cosine = sight.dot(q(p)) / (sight.dot(sight).sqrt() * q(p).dot(q(p)).sqrt());
        assert!(cosine.abs() < 1e-12, "{cosine}");
        assert!(horizon(Vec3::new(A / 2.0, 0.0, 0.0)).is_none());
        assert!(horizon(Vec3::new(0.0, 0.0, 0.0)).is_none());
    }
}
