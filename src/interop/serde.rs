//! `serde`: frusta in their canonical form, and the results of clipping.
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
//! "bottom", "top" }` and `"direction": 1` or `-1`. Deserialization uses
//! [`Frustum::new`], so that an invalid frustum is an error; so is any other field, at
//! every depth. The format needs field names (JSON, TOML, RON; not `bincode`). Text
//! loses nothing if its reader rounds correctly: `serde_json` does with its feature
//! `float_roundtrip`.
//!
//! Results are structures with the names of their fields; the names of classes and faces are
//! those of [`Class::name`](crate::Class::name) and [`Face::name`]:
//!
//! ```json
//! {"class": "cross", "part": {"entry": {"t": 0, "point": [0, 0, 1], "clipped": false,
//!   "faces": [], "inward": true}, "exit": {"t": 0.5, "point": [1, 1, 1], "clipped": true,
//!   "faces": ["right", "top"], "inward": false}, "coplanar": []}}
//! ```

use crate::frustum::{Direction, EndRect, Face, FaceSet, Frustum, Shape};
use crate::math::{Pose, Rect, Vec3};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Canonical {
    origin: Vec3<f64>,
    axes: [Vec3<f64>; 3],
    near: End,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    far: Option<End>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    slopes: Option<Sides>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    direction: Option<Sign>,
}

/// [`EndRect`] without other fields: its own deserializer, which flattens the rectangle,
/// cannot detect them.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    z: f64,
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
}

impl From<EndRect> for End {
    fn from(EndRect { z, rect }: EndRect) -> Self {
        let [left, right, bottom, top] = rect.to_array();
        Self {
            z,
            left,
            right,
            bottom,
            top,
        }
    }
}

impl From<End> for EndRect {
    fn from(end: End) -> Self {
        Self::new(end.z, end.left, end.right, end.bottom, end.top)
    }
}

/// [`Rect`] without other fields.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sides {
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
}

impl From<Rect> for Sides {
    fn from(rect: Rect) -> Self {
        let [left, right, bottom, top] = rect.to_array();
        Self {
            left,
            right,
            bottom,
            top,
        }
    }
}

impl From<Sides> for Rect {
    fn from(sides: Sides) -> Self {
        Self::new(sides.left, sides.right, sides.bottom, sides.top)
    }
}

/// A direction as its sign: serialized as an integer, deserialized from any number, because
/// some writers have no integers.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "i8")]
struct Sign(Direction);

impl From<Sign> for i8 {
    fn from(Sign(direction): Sign) -> Self {
        match direction {
            Direction::PlusZ => 1,
            Direction::MinusZ => -1,
        }
    }
}

impl TryFrom<f64> for Sign {
    type Error = String;

    fn try_from(sign: f64) -> Result<Self, String> {
        match sign {
            1.0 => Ok(Self(Direction::PlusZ)),
            -1.0 => Ok(Self(Direction::MinusZ)),
            other => Err(format!("direction is {other:?}; it must be 1 or -1")),
        }
    }
}

impl Serialize for Frustum {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let pose = self.pose();
        let (far, slopes, direction) = match *self.shape() {
            Shape::Finite { far, .. } => (Some(far.into()), None, None),
            Shape::Infinite {
                slopes, direction, ..
            } => (None, Some(slopes.into()), Some(Sign(direction))),
        };
        Canonical {
            origin: pose.origin,
            axes: pose.axes,
            near: self.shape().near().into(),
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
        let near = near.into();
        let shape = match (far, slopes, direction) {
            (Some(far), None, None) => Shape::Finite {
                near,
                far: far.into(),
            },
            (None, Some(slopes), Some(Sign(direction))) => Shape::Infinite {
                near,
                slopes: slopes.into(),
                direction,
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

impl Serialize for FaceSet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self)
    }
}

impl<'de> Deserialize<'de> for FaceSet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let faces = Vec::<Face>::deserialize(deserializer)?;
        Ok(faces.into_iter().collect())
    }
}
