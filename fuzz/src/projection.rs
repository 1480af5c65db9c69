//! Projection of a case's ends and of their parts: in the window exactly where a point is in the frustum.

use frusta::{Accuracy, ClipSpace, Frustum, Projector, Real, Rect, Segment, Vec3};

/// Of any width and height, not a power of two, `y` down.
const WINDOW: Rect = Rect::new(-3.0, 1917.0, 1083.0, 3.0);

/// The ends of a segment, and those of its inward part.
pub(crate) fn check<T: Real>(frustum: &Frustum, segment: &Segment<T>) {
    let screen = Projector::new(frustum).onto(WINDOW).expect("a window");
    let mut points = vec![segment.start, segment.end];
    if let Ok(clip) = frustum.clip_segment_with(segment, Accuracy::Inward)
        && let Some(part) = clip.part
    {
        points.extend([part.entry.point, part.exit.point]);
    }
    for &point in &points {
        check_point(&screen, point);
    }
    let mut images = Vec::new();
    match screen.project_points(&points, &mut images) {
        Ok(()) => {
            for (&point, &image) in points.iter().zip(&images) {
                assert_eq!(screen.project(point), Ok(image), "{frustum:?}\n{point:?}");
            }
        }
        Err(error) => assert!(images.is_empty() && !points[error.index].is_finite()),
    }
    check_matrices(frustum);
}

fn check_point<T: Real>(screen: &Projector, point: Vec3<T>) {
    let said = || format!("{:?}\n{point:?}", screen.frustum());
    let image = screen.project(point);
    assert_eq!(image.is_ok(), point.is_finite(), "{}", said());
    let Ok(image) = image else { return };
    let inside = screen.frustum().contains(point).expect("finite");
    let Some(image) = image else {
        return;
    };
    let image = image.to_f64();
    assert!(image.is_finite(), "{image:?}\n{}", said());
    if inside {
        let [left, right, bottom, top] = WINDOW.to_array();
        let is_in_window = (left..=right).contains(&image.x)
            && (top..=bottom).contains(&image.y)
            && (0.0..=1.0).contains(&image.z);
        assert!(is_in_window, "{image:?}\n{}", said());
    }
    for found in [
        screen.ray(image.x, image.y).map(|ray| ray.origin),
        screen.point(image.x, image.y, image.z),
    ] {
        assert!(found.is_none_or(Vec3::is_finite), "{found:?}\n{}", said());
    }
    let _ = screen.window([image.x, image.y], [0.0, 0.0]);
}

/// A matrix of each kind, or an error.
fn check_matrices(frustum: &Frustum) {
    for clip in [ClipSpace::ZERO_TO_ONE, ClipSpace::OPENGL.reversed()] {
        if let Ok(matrix) = frustum.view_projection(clip) {
            let entries = matrix.to_array(frusta::MatrixLayout::RowMajorColumnVectors);
            assert!(
                entries.iter().flatten().all(|m| m.is_finite()),
                "{frustum:?}"
            );
        }
    }
}
