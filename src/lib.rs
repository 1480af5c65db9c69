//! Exactly right and fast clipping and culling against view frusta.

pub mod clip;
mod exact;
pub mod frustum;
pub mod math;
#[cfg(feature = "oracle")]
pub mod oracle;

pub use clip::{
    Accuracy, Arithmetic, Class, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, Part,
    PartEnd, SegmentClip, SegmentClipper, SixPlanes, StageCounts, VwProjection,
};
pub use frustum::{Direction, EndRect, Face, FaceSet, Frustum, FrustumError, Shape};
pub use math::{Axis, End, NonFinite, Pose, Real, Rect, Segment, Vec3};
