//! Exactly right and fast clipping and culling against view frusta.

pub mod clip;
mod exact;
pub mod frustum;
pub mod math;
#[cfg(feature = "oracle")]
pub mod oracle;
pub mod samples;

pub use clip::{
    Accuracy, Arithmetic, Class, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, Part,
    PartEnd, SegmentClip, SegmentClipper, SixPlanes, StageCounts, VwProjection,
};
pub use frustum::{
    Camera, Direction, EndRect, Face, FaceSet, Frustum, FrustumError, Projection, Shape,
};
pub use math::{Axis, End, NonFinite, Pose, Real, Rect, Segment, Vec3};
