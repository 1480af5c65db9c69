//! Exactly right and fast clipping and culling against view frusta.

pub mod clip;
mod exact;
pub mod frustum;
mod interop;
pub mod math;
#[cfg(feature = "oracle")]
pub mod oracle;
#[cfg(feature = "report")]
pub mod report;
pub mod samples;

pub use clip::{
    Accuracy, Arithmetic, Class, CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, Part,
    PartEnd, SegmentClip, SegmentClipper, SixPlanes, StageCounts, VwProjection,
};
pub use frustum::{
    Camera, ClipSpace, ClipY, Corners, DepthRange, Deviation, Direction, EndRect, Face, FaceSet,
    FarCorners, Frustum, FrustumError, MatrixFrustum, MatrixLayout, Plane, Projection, Shape,
    SixPoints, Trapezoid, TrapezoidEnd, ViewProjection,
};
pub use math::{Axis, End, Interval, NonFinite, Pose, Real, Rect, Segment, Vec3};
