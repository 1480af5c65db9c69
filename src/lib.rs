//! Exactly right and fast clipping and culling against view frusta.

pub mod clip;
pub mod frustum;
pub mod math;

pub use clip::{
    Accuracy, Arithmetic, Class, Part, PartEnd, SegmentClip, SegmentClipper, StageCounts,
};
pub use frustum::{
    Camera, Corners, Direction, EndRect, Face, FaceSet, FarCorners, Frustum, FrustumError, Plane,
    Projection, Shape, SixPoints, Trapezoid, TrapezoidEnd,
};
pub use math::{Axis, End, Interval, NonFinite, Pose, Real, Rect, Segment, Vec3};
