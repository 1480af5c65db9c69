//! `serde`: a frustum as its canonical form.
//!
//! ```json
//! {
//!   "origin": [0, 0, 0],
//!   "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
//!   "near": { "z": 1, "left": -1, "right": 1, "bottom": -1, "top": 1 },
//!   "far": { "z": 3, "left": -3, "right": 3, "bottom": -3, "top": 3 }
//! }
//! ```
//!
//! An infinite frustum has, in place of `far`, `"slopes": { "left", "right",
//! "bottom", "top" }` and `"direction": 1` or `-1`. Reading goes through
//! [`Frustum::new`], so that no invalid frustum comes out of a file; other
//! fields are refused. The format needs field names (JSON, TOML, RON; not
//! `bincode`). Text loses nothing if its reader rounds correctly: for
//! `serde_json` that is its feature `float_roundtrip`.

use crate::frustum::{Direction, EndRect, Frustum, Shape};
use crate::math::{Pose, Rect, Vec3};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Canonical {
    origin: Vec3<f64>,
    axes: [Vec3<f64>; 3],
    near: EndRect,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    far: Option<EndRect>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    slopes: Option<Rect>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    direction: Option<i8>,
}

impl Serialize for Frustum {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let pose = self.pose();
        let (far, slopes, direction) = match *self.shape() {
            Shape::Finite { far, .. } => (Some(far), None, None),
            Shape::Infinite {
                slopes, direction, ..
            } => {
                let sign = match direction {
                    Direction::PlusZ => 1,
                    Direction::MinusZ => -1,
                };
                (None, Some(slopes), Some(sign))
            }
        };
        Canonical {
            origin: pose.origin,
            axes: pose.axes,
            near: self.shape().near(),
            far,
            slopes,
            direction,
        }
        .serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Frustum {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Canonical {
            origin,
            axes,
            near,
            far,
            slopes,
            direction,
        } = Canonical::deserialize(deserializer)?;
        let shape = match (far, slopes, direction) {
            (Some(far), None, None) => Shape::Finite { near, far },
            (None, Some(slopes), Some(direction)) => Shape::Infinite {
                near,
                slopes,
                direction: match direction {
                    1 => Direction::PlusZ,
                    -1 => Direction::MinusZ,
                    _ => {
                        return Err(D::Error::custom(format_args!(
                            "direction is {direction}; it must be 1 or -1"
                        )));
                    }
                },
            },
            _ => {
                return Err(D::Error::custom(
                    "a frustum has either `far` or both `slopes` and `direction`",
                ));
            }
        };
        Frustum::new(Pose::new(origin, axes), shape).map_err(D::Error::custom)
    }
}
