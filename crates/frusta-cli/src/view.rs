//! The frustum to clip by: from flags, from a file, or around a part of the scene.

use crate::failure::Failure;
use crate::io::frustum_file;
use crate::io::number::{self, short};
use crate::io::{Bounds, wgs84};
use clap::Args;
use frusta::{Camera, Deviation, Frustum, FrustumError, Projection, Vec3};
use std::fmt::{self, Display};
use std::path::PathBuf;

/// Flags that describe a frustum.
#[derive(Args, Debug, Default)]
#[command(next_help_heading = "View (default: a camera that takes in a part of the scene)")]
pub(crate) struct ViewArgs {
    /// Where the camera is
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    eye: Option<Vec3<f64>>,
    /// What it looks at
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    target: Option<Vec3<f64>>,
    /// What points upwards in the picture [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    up: Option<Vec3<f64>>,
    /// Look down on the earth from above a place, to the horizon and no farther: sets eye, target, up, and the defaults of fovy, near and far. With --ecef
    #[arg(long, value_name = "LON,LAT,HEIGHT", value_parser = point, allow_hyphen_values = true)]
    #[arg(requires = "ecef", conflicts_with_all = ["eye", "target", "up", "ortho"])]
    over: Option<Vec3<f64>>,
    /// Full vertical angle of view [default: 30]
    #[arg(long, value_name = "DEGREES", value_parser = finite, conflicts_with = "ortho", allow_hyphen_values = true)]
    fovy: Option<f64>,
    /// Parallel projection of this full height instead of perspective
    #[arg(long, value_name = "HEIGHT", value_parser = finite, allow_hyphen_values = true)]
    ortho: Option<f64>,
    /// Width over height [default: 1.5]
    #[arg(long, value_name = "RATIO", value_parser = finite, allow_hyphen_values = true)]
    aspect: Option<f64>,
    /// Distance of the near face [default: a hundredth of the target's]
    #[arg(long, value_name = "DISTANCE", value_parser = finite, allow_hyphen_values = true)]
    near: Option<f64>,
    /// Distance of the far face, or `inf` [default: a hundred times the target's]
    #[arg(long, value_name = "DISTANCE", value_parser = distance, allow_hyphen_values = true)]
    far: Option<f64>,
    /// Read the frustum from a JSON file (see below)
    #[arg(long, value_name = "FILE", conflicts_with_all = [
        "eye", "target", "up", "over", "fovy", "ortho", "aspect", "near", "far"
    ])]
    frustum: Option<PathBuf>,
}

/// A frustum and how to get it again.
pub(crate) struct View {
    /// The frustum.
    pub(crate) frustum: Frustum,
    /// For a matrix: the error of its conversion.
    pub(crate) deviation: Option<Deviation>,
    /// Flags that give it again.
    pub(crate) flags: String,
    /// Whether it was chosen from the scene's extent.
    pub(crate) chosen: bool,
}

impl ViewArgs {
    /// The frustum. The scene's extent is asked for only if the flags leave
    /// open where the camera is or what it looks at.
    pub(crate) fn view(
        &self,
        bounds: impl FnOnce() -> Result<Bounds, Failure>,
    ) -> Result<View, Failure> {
        if let Some(file) = &self.frustum {
            let (frustum, deviation) = frustum_file::read(file)?;
            return Ok(View {
                frustum,
                deviation,
                flags: format!("--frustum {}", file.display()),
                chosen: false,
            });
        }
        let up = self.up.unwrap_or(Vec3::new(0.0, 1.0, 0.0));
        let (mut parameters, chosen) = match (self.over, self.eye, self.target) {
            (Some(place), ..) => (Parameters::over(place)?, false),
            (None, Some(eye), Some(target)) if eye == target => {
                return Err(Failure::new("--eye and --target are the same point"));
            }
            (None, Some(eye), Some(target)) => (Parameters::between(eye, target, up), false),
            (None, eye, target) => (Parameters::around(&bounds()?, eye, target, up)?, true),
        };
        if let Some(fovy) = self.fovy {
            // The library's own message is in radians.
            if !(fovy > 0.0 && fovy < 180.0) {
                let why = format!("--fovy is {}; it must be between 0 and 180", short(fovy));
                return Err(Failure::new(why));
            }
            parameters.lens = Lens::Fovy(fovy);
        }
        if let Some(height) = self.ortho {
            parameters.lens = Lens::Ortho(height);
        }
        parameters.aspect = self.aspect.unwrap_or(parameters.aspect);
        parameters.near = self.near.unwrap_or(parameters.near);
        parameters.far = self.far.unwrap_or(parameters.far);
        let frustum = parameters
            .frustum()
            .map_err(|e| Failure::new(format_args!("no frustum from {parameters}: {e}")))?;
        Ok(View {
            frustum,
            deviation: None,
            flags: match self.over {
                Some(place) => self.over_flags(place),
                None => parameters.to_string(),
            },
            chosen,
        })
    }

    /// The flags for a camera above the earth, as they were given: its eye has more
    /// digits than anyone would type.
    fn over_flags(&self, place: Vec3<f64>) -> String {
        let [longitude, latitude, height] = place.to_array().map(short);
        let mut flags = format!("--ecef --over {longitude},{latitude},{height}");
        let given = [
            ("fovy", self.fovy),
            ("aspect", self.aspect),
            ("near", self.near),
            ("far", self.far),
        ];
        for (name, value) in given {
            if let Some(value) = value {
                flags += &format!(" --{name} {}", short(value));
            }
        }
        flags
    }
}

/// What opens the view.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lens {
    /// Perspective, by the full vertical angle in degrees.
    Fovy(f64),
    /// Parallel projection, by the full height.
    Ortho(f64),
}

/// A camera as people write it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameters {
    pub(crate) eye: Vec3<f64>,
    pub(crate) target: Vec3<f64>,
    pub(crate) up: Vec3<f64>,
    pub(crate) lens: Lens,
    pub(crate) aspect: f64,
    pub(crate) near: f64,
    pub(crate) far: f64,
}

impl Parameters {
    /// The frustum.
    pub(crate) fn frustum(&self) -> Result<Frustum, FrustumError> {
        let aspect = self.aspect;
        let projection = match self.lens {
            Lens::Fovy(degrees) => Projection::Perspective {
                fovy: degrees.to_radians(),
                aspect,
            },
            Lens::Ortho(height) => Projection::Orthographic { height, aspect },
        };
        Camera {
            eye: self.eye,
            target: self.target,
            up: self.up,
            projection,
            near: self.near,
            far: self.far,
        }
        .frustum()
    }

    fn between(eye: Vec3<f64>, target: Vec3<f64>, up: Vec3<f64>) -> Self {
        let distance = length(target - eye);
        Self {
            eye,
            target,
            up,
            lens: Lens::Fovy(30.0),
            aspect: 1.5,
            near: distance / 100.0,
            far: distance * 100.0,
        }
    }

    /// A camera above a place of the earth, with north up in the picture. Its far
    /// face lies in the plane of the horizon, and its sides take all of that in, except
    /// from less than 25 km up, where 170 degrees are not enough.
    fn over(place: Vec3<f64>) -> Result<Self, Failure> {
        let fail = |why: &str| Failure::new(format_args!("--over: {why}"));
        let eye = wgs84::ecef(place.x, place.y, place.z).map_err(|why| fail(&why))?;
        let (way, distance) = wgs84::horizon(eye)
            .filter(|_| place.z > 0.0)
            .ok_or_else(|| fail("the height must be above 0, and finite on the earth's scale"))?;
        let foot = eye + way * distance;
        // The radius of the horizon's circle, as if the earth were a sphere.
        let radius = (wgs84::RADIUS * wgs84::RADIUS - foot.dot(foot))
            .max(0.0)
            .sqrt();
        let is_pole = way.x.abs().max(way.y.abs()) < 1e-6;
        let degrees = 2.0 * libm::atan2(radius, distance).to_degrees();
        Ok(Self {
            lens: Lens::Fovy(rounded((degrees * 1.02).clamp(1.0, 170.0), 1e3)),
            near: distance / 100.0,
            far: distance,
            ..Self::between(
                eye,
                foot,
                if is_pole {
                    Vec3::new(1.0, 0.0, 0.0)
                } else {
                    Vec3::new(0.0, 0.0, 1.0)
                },
            )
        })
    }

    /// A camera that sees the middle of the scene: from the front, the right
    /// and above, at 1.5 radii of the sphere around the box, near and far where
    /// that sphere begins and ends, so that only the sides cut. Numbers have
    /// few digits, to be typed again.
    fn around(
        bounds: &Bounds,
        eye: Option<Vec3<f64>>,
        target: Option<Vec3<f64>>,
        up: Vec3<f64>,
    ) -> Result<Self, Failure> {
        let bounds = if bounds.is_empty() {
            &Bounds {
                low: Vec3::new(-1.0, -1.0, -1.0),
                high: Vec3::new(1.0, 1.0, 1.0),
            }
        } else {
            bounds
        };
        let centre = (bounds.low + bounds.high) * 0.5;
        let largest = centre
            .to_array()
            .into_iter()
            .fold(0.0, |m: f64, c| m.max(c.abs()));
        let radius = match length(bounds.high - bounds.low) / 2.0 {
            0.0 if largest == 0.0 => 1.0,
            0.0 => largest / 1024.0,
            radius => radius,
        };
        if !(centre.is_finite() && radius.is_finite() && radius > f64::MIN_POSITIVE) {
            return Err(Failure::new(
                "the scene's extent suits no default camera; give --eye and --target",
            ));
        }
        let round = |v: Vec3<f64>| Vec3::from(v.to_array().map(|c| rounded(c, radius)));
        let target = target.unwrap_or_else(|| round(centre));
        let eye = eye.unwrap_or_else(|| round(target + viewpoint(up) * (1.5 * radius)));
        let distance = length(target - eye);
        Ok(Self {
            near: rounded((distance - radius).max(distance / 100.0), radius),
            far: rounded(distance + radius, radius),
            ..Self::between(eye, target, up)
        })
    }
}

impl Display for Parameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, p) in [("eye", self.eye), ("target", self.target), ("up", self.up)] {
            let [x, y, z] = p.to_array().map(short);
            write!(f, "--{name} {x},{y},{z} ")?;
        }
        match self.lens {
            Lens::Fovy(degrees) => write!(f, "--fovy {} ", short(degrees))?,
            Lens::Ortho(height) => write!(f, "--ortho {} ", short(height))?,
        }
        write!(
            f,
            "--aspect {} --near {} --far {}",
            short(self.aspect),
            short(self.near),
            short(self.far)
        )
    }
}

/// The unit direction from the target to the default eye.
fn viewpoint(up: Vec3<f64>) -> Vec3<f64> {
    let unit = |v: Vec3<f64>| {
        let scale = 1.0 / length(v);
        if scale.is_finite() {
            v * scale
        } else {
            Vec3::new(0.0, 1.0, 0.0)
        }
    };
    let up = unit(up);
    // The axis furthest from `up` serves as front, z before x before y.
    let front = if up.z.abs() <= 0.6 {
        Vec3::new(0.0, 0.0, 1.0)
    } else {
        Vec3::new(0.0, -1.0, 0.0)
    };
    let right = unit(up.cross(front));
    let front = right.cross(up);
    unit(front * 0.8 + right * 0.5 + up * 0.45)
}

/// Without overflow or underflow on the way.
fn length(v: Vec3<f64>) -> f64 {
    let [x, y, z] = v.to_array();
    libm::hypot(libm::hypot(x, y), z)
}

/// To a thousandth of `scale` or a little finer, in decimals.
fn rounded(value: f64, scale: f64) -> f64 {
    let decimals = (3.0 - scale.log10().floor()).clamp(0.0, 330.0) as usize;
    format!("{value:.decimals$}").parse().unwrap_or(value)
}

fn finite(text: &str) -> Result<f64, String> {
    number::parse_finite(text)
}

fn distance(text: &str) -> Result<f64, String> {
    match text {
        "inf" | "infinity" => Ok(f64::INFINITY),
        _ => finite(text),
    }
}

fn point(text: &str) -> Result<Vec3<f64>, String> {
    let mut numbers = text.split(',').map(str::trim).map(number::parse_finite);
    match (
        numbers.next(),
        numbers.next(),
        numbers.next(),
        numbers.next(),
    ) {
        (Some(x), Some(y), Some(z), None) => Ok(Vec3::new(x?, y?, z?)),
        _ => Err("expected three numbers: X,Y,Z".to_owned()),
    }
}
