//! A frustum seen from outside.
//!
//! The viewer stands to the right of the frustum, behind its eye and above, at
//! infinite distance: a parallel projection keeps what is parallel, and shows the
//! shape as in a drawing. The view is a frustum, too (a long box), so that
//! everything in the picture is clipped by the same exact clipper as in a camera's
//! view.
//!
//! ```text
//! solid:  the frustum's two ends, the far one where the scene ends, but as deep as wide,
//!         if the frustum goes on far beyond; the apex of its sides
//! axes:   from the solid's own right, up and forward
//! window: all of the solid, and the part of the scene's box that is within twice
//!         the solid's size
//! ```

use super::window::Window;
use crate::failure::Failure;
use crate::io::Bounds;
use frusta::{EndRect, Frustum, Pose, Shape, Vec3};

/// From the solid's middle to the viewer: right, up, forward. If the camera has
/// less than 110 degrees, no side is seen edge-on.
const VIEWER: [f64; 3] = [0.83, 0.46, -0.31];
/// The window's greatest size, of the solid's larger one.
const WIDEST: f64 = 2.0;
/// The window may grow so much to show the apex.
const APEX: f64 = 1.6;
/// A frustum so much deeper than the scene is drawn open.
const ENDLESS: f64 = 1.5;

/// The part of the frustum that is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solid {
    /// Going round, as in [`frusta::Corners`].
    pub(super) near: [Vec3<f64>; 4],
    pub(super) end: [Vec3<f64>; 4],
    /// Where the sides go on to, if the frustum does.
    pub(super) beyond: Option<[Vec3<f64>; 4]>,
    /// Where the sides meet, if they do at one point before the near end.
    pub(super) apex: Option<Vec3<f64>>,
}

/// The viewer's frustum and what it looks at.
#[derive(Debug)]
pub(super) struct Outside {
    pub(super) frustum: Frustum,
    pub(super) solid: Solid,
}

impl Outside {
    /// The view of a frustum among its scene.
    pub(super) fn new(frustum: &Frustum, scene: Option<&Bounds>) -> Result<Self, Failure> {
        let scene = scene.filter(|box_| !box_.is_empty()).map(corners);
        let solid = Solid::new(frustum, scene.as_ref());
        let points = || solid.near.iter().chain(&solid.end);
        if !points().all(|p| p.is_finite()) {
            return Err(too_large());
        }
        let [right, up, forward] = viewer(&solid);
        let centre = middle(&solid.near) * 0.5 + middle(&solid.end) * 0.5;
        let seen = |p: &Vec3<f64>| {
            let p = *p - centre;
            [right.dot(p), up.dot(p), forward.dot(p)]
        };
        let mut window = Window::around(points().chain(solid.beyond.iter().flatten()).map(seen));
        let solid_only = window;
        if let Some(apex) = &solid.apex {
            let with = window.and(Window::around(std::iter::once(seen(apex))));
            if with.within(&window.scaled(APEX)) {
                window = with;
            }
        }
        let mut depth = solid_only.depth();
        if let Some(scene) = &scene {
            let scene = Window::around(scene.iter().map(seen));
            window = window.and(scene.cut(&solid_only.square(WIDEST)));
            depth = depth.max(scene.depth());
        }
        let frustum = window
            .frustum(Pose::new(centre, [right, up, forward]), depth)
            .map_err(|_| too_large())?;
        Ok(Self { frustum, solid })
    }
}

fn too_large() -> Failure {
    Failure::new("no picture from outside: the frustum's vertices are beyond the range of numbers")
}

impl Solid {
    fn new(frustum: &Frustum, scene: Option<&[Vec3<f64>; 8]>) -> Self {
        let (pose, shape) = (frustum.pose(), frustum.shape());
        let sides = Sides::new(shape);
        let end = |depth: f64| sides.at(depth).map(|q| pose.to_world(q));
        let apex_depth = sides.apex();
        let reach = scene
            .and_then(|scene| {
                let depths = scene.map(|p| sides.depth_of(pose.to_frame(p)));
                let deepest = depths.into_iter().fold(f64::MIN, f64::max);
                // A much shallower solid looks like a sheet.
                let least = least_depth(pose, sides.width());
                (deepest.is_finite() && deepest > 0.0).then_some((1.02 * deepest).max(least))
            })
            .unwrap_or_else(|| sides.usual_depth(apex_depth));
        let open = sides.depth > ENDLESS * reach;
        let depth = if open { reach } else { sides.depth };
        Self {
            near: end(0.0),
            end: end(depth),
            beyond: open.then(|| end(1.08 * depth)),
            apex: apex_depth
                .map(|depth| pose.to_world(sides.middle(depth)))
                .filter(|p| p.is_finite()),
        }
    }
}

/// A frustum's sides in its frame, by depth from the near end.
struct Sides {
    near: EndRect,
    /// For each unit of depth.
    slopes: [f64; 4],
    sign: f64,
    /// The far end's depth; infinite if there is no far end.
    depth: f64,
}

impl Sides {
    fn new(shape: &Shape) -> Self {
        let (near, sign) = (shape.near(), shape.direction().sign());
        let (slopes, depth) = match shape {
            Shape::Infinite { slopes, .. } => (slopes.to_array(), f64::INFINITY),
            Shape::Finite { far, .. } => {
                let depth = (far.z - near.z).abs();
                let (n, f) = (near.rect.to_array(), far.rect.to_array());
                (std::array::from_fn(|i| (f[i] - n[i]) / depth), depth)
            }
        };
        Self {
            near,
            slopes,
            sign,
            depth,
        }
    }

    fn bounds(&self, depth: f64) -> [f64; 4] {
        let near = self.near.rect.to_array();
        std::array::from_fn(|i| near[i] + self.slopes[i] * depth)
    }

    /// The corners at a depth, going round.
    fn at(&self, depth: f64) -> [Vec3<f64>; 4] {
        let [left, right, bottom, top] = self.bounds(depth);
        let z = self.near.z + self.sign * depth;
        [(left, bottom), (right, bottom), (right, top), (left, top)]
            .map(|(x, y)| Vec3::new(x, y, z))
    }

    fn middle(&self, depth: f64) -> Vec3<f64> {
        middle(&self.at(depth))
    }

    fn depth_of(&self, q: Vec3<f64>) -> f64 {
        (q.z - self.near.z) * self.sign
    }

    /// The depth, negative, at which both pairs of sides meet.
    fn apex(&self) -> Option<f64> {
        let near = self.near.rect.to_array();
        let meet = |low: usize| {
            let growth = self.slopes[low + 1] - self.slopes[low];
            (near[low] - near[low + 1]) / growth
        };
        let (x, y) = (meet(0), meet(2));
        // As good as the same: rounded slopes.
        let same = (x - y).abs() <= 1e-6 * x.abs().max(y.abs());
        (same && x < 0.0 && x.is_finite()).then_some(0.5 * (x + y))
    }

    /// The near end's larger side.
    fn width(&self) -> f64 {
        let [left, right, bottom, top] = self.near.rect.to_array();
        (right - left).max(top - bottom)
    }

    /// A depth to draw if the scene's extent is unknown.
    fn usual_depth(&self, apex: Option<f64>) -> f64 {
        if self.depth.is_finite() {
            return self.depth;
        }
        let depth = apex.map_or(2.0 * self.width(), |apex| -4.0 * apex);
        if depth > 0.0 && depth.is_finite() {
            depth
        } else {
            1.0
        }
    }
}

/// The depth, in the frame, that is as long in the world as a width is.
fn least_depth(pose: &Pose, width: f64) -> f64 {
    let [across, _, along] = pose.axes.map(|axis| axis.dot(axis).sqrt());
    let depth = width * (along / across);
    if depth.is_finite() { depth } else { 0.0 }
}

/// Right, up and forward of the viewer, unit vectors.
fn viewer(solid: &Solid) -> [Vec3<f64>; 3] {
    let ends = [&solid.end, &solid.near];
    let across = |from: [usize; 2], to: [usize; 2]| {
        let sides =
            ends.map(|e| e[to[0]] * 0.5 + e[to[1]] * 0.5 - (e[from[0]] * 0.5 + e[from[1]] * 0.5));
        sides.into_iter().find_map(unit)
    };
    let right = across([0, 3], [1, 2]).unwrap_or(Vec3::new(1.0, 0.0, 0.0));
    let up = across([0, 1], [3, 2]).unwrap_or(Vec3::new(0.0, 1.0, 0.0));
    let forward = unit(middle(&solid.end) - middle(&solid.near));
    let forward = forward.unwrap_or(Vec3::new(0.0, 0.0, -1.0));
    let [a, b, c] = VIEWER;
    let back = unit(right * a + up * b + forward * c).unwrap_or(right);
    let sideways = unit(up.cross(back)).unwrap_or(forward);
    [sideways, back.cross(sideways), -back]
}

fn corners(bounds: &Bounds) -> [Vec3<f64>; 8] {
    let ends = [bounds.low, bounds.high];
    std::array::from_fn(|i| Vec3::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z))
}

/// The mean of four points, without overflow.
fn middle(points: &[Vec3<f64>; 4]) -> Vec3<f64> {
    let [a, b, c, d] = points.map(|p| p * 0.25);
    a + b + c + d
}

/// The unit vector of any that is not zero, however long.
fn unit(v: Vec3<f64>) -> Option<Vec3<f64>> {
    let largest = v
        .to_array()
        .into_iter()
        .fold(0.0, |m: f64, c| m.max(c.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let v = Vec3::new(v.x / largest, v.y / largest, v.z / largest);
    Some(v * (1.0 / v.dot(v).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::{Camera, Direction, Projection, Rect};

    fn camera(near: f64, far: f64) -> Frustum {
        let projection = Projection::Perspective {
            fovy: 1.0,
            aspect: 1.5,
        };
        Camera {
            eye: [0.0, 0.0, 10.0].into(),
            target: [0.0; 3].into(),
            up: [0.0, 1.0, 0.0].into(),
            projection,
            near,
            far,
        }
        .frustum()
        .unwrap()
    }

    fn cube(half: f64) -> Bounds {
        Bounds {
            low: [-half; 3].into(),
            high: [half; 3].into(),
        }
    }

    /// Everything drawn of the solid is in the viewer's view.
    fn check(frustum: &Frustum, scene: Option<Bounds>) -> Outside {
        let outside = Outside::new(frustum, scene.as_ref()).unwrap();
        let solid = &outside.solid;
        for p in solid
            .near
            .iter()
            .chain(&solid.end)
            .chain(solid.beyond.iter().flatten())
        {
            assert!(outside.frustum.contains(*p).unwrap(), "{p:?}");
        }
        outside
    }

    #[test]
    fn frusta_are_seen_whole_and_deep_ones_as_far_as_the_scene() {
        let closed = check(&camera(5.0, 15.0), Some(cube(3.0)));
        assert!(closed.solid.beyond.is_none());
        let apex = closed.solid.apex.unwrap();
        assert!(
            (apex.z - 10.0).abs() < 1e-9 && apex.x.abs() < 1e-9,
            "{apex:?}"
        );
        assert!(closed.frustum.contains(apex).unwrap());
        for far in [1e9, f64::INFINITY] {
            let open = check(&camera(5.0, far), Some(cube(3.0)));
            assert!(open.solid.beyond.is_some());
            let z = open.solid.end[0].z;
            assert!((-3.5..-3.0).contains(&z), "{z}");
            check(&camera(5.0, far), None);
        }
    }

    #[test]
    fn a_flat_scene_at_the_near_face_leaves_the_frustum_its_depth() {
        let at = |z: f64| Bounds {
            low: [-1.0, -1.0, z].into(),
            high: [1.0, 1.0, z].into(),
        };
        let thin = check(&camera(5.0, 25.0), Some(at(4.999_999)));
        assert!(thin.solid.beyond.is_some());
        let width = thin.solid.near[1].x - thin.solid.near[0].x;
        let depth = thin.solid.near[0].z - thin.solid.end[0].z;
        assert!((depth / width - 1.0).abs() < 1e-9, "{depth} {width}");
        let behind = check(&camera(5.0, 15.0), Some(at(20.0)));
        assert!(behind.solid.beyond.is_none());
    }

    #[test]
    fn pyramids_boxes_sheared_and_extreme_frusta() {
        assert!(
            check(&camera(0.0, 15.0), Some(cube(3.0)))
                .solid
                .apex
                .is_none()
        );
        check(&camera(0.0, f64::INFINITY), None);
        for scale in [1e-300, 1e-160, 1.0, 1e15, 1e300] {
            let near = EndRect::new(-scale, -scale, scale, -scale, scale);
            let far = EndRect::new(-3.0 * scale, 0.0, 4.0 * scale, -scale, scale);
            let shape = Shape::Finite { near, far };
            let frustum = Frustum::new(Pose::IDENTITY, shape).unwrap();
            let outside = check(&frustum, Some(cube(2.0 * scale)));
            assert!(outside.solid.apex.is_none());
            let slopes = Rect::new(0.0, 0.0, 0.0, 1.0);
            let direction = Direction::MinusZ;
            let endless = Shape::Infinite {
                near,
                slopes,
                direction,
            };
            let frustum = Frustum::new(Pose::IDENTITY, endless).unwrap();
            check(&frustum, Some(cube(0.5 * scale)));
            check(&frustum, None);
        }
    }

    #[test]
    fn the_sides_look_as_they_are_called() {
        let outside = check(&camera(5.0, 15.0), None);
        let seen = |p: Vec3<f64>| outside.frustum.pose().to_frame(p);
        let (near, end) = (outside.solid.near, outside.solid.end);
        assert!(seen(end[0]).x > seen(near[0]).x, "forward is to the right");
        assert!(seen(end[3]).y > seen(end[0]).y, "up is upwards");
        assert!(seen(end[1]).z < seen(end[0]).z, "the right side is nearer");
    }
}
