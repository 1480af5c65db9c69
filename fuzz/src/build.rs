//! Frusta by any constructor, from any numbers.

use crate::case::any_number;
use arbitrary::{Result, Unstructured};
use frusta::{
    Camera, ClipSpace, ClipY, DepthRange, Direction, EndRect, Frustum, MatrixLayout, Pose,
    Projection, Rect, Shape, SixPoints, Vec3, ViewProjection,
};

/// A frustum, if the numbers make one.
pub(crate) fn any(u: &mut Unstructured<'_>) -> Result<Option<Frustum>> {
    let frustum = match u.int_in_range(0..=4_u8)? {
        0 => camera(u)?.frustum().ok(),
        1 => matrix(u)?,
        2 => six_points(u)?.frustum().ok(),
        3 => {
            let pose = Pose::new(vector(u)?, [vector(u)?, vector(u)?, vector(u)?]);
            Frustum::new(pose, shape(u)?).ok()
        }
        _ => Frustum::new(Pose::IDENTITY, shape(u)?).ok(),
    };
    let Some(frustum) = frustum else {
        return Ok(None);
    };
    Ok(match u.int_in_range(0..=7_u8)? {
        0 => frustum.window(rect(u)?).ok(),
        1 => frustum.stereo_eye(any_number(u)?, any_number(u)?).ok(),
        _ => Some(frustum),
    })
}

/// A point of the world that is somewhere in the middle of a frustum, or of a
/// part of it; not finite where it is too far away.
pub(crate) fn middle(frustum: &Frustum) -> Vec3<f64> {
    let shape = frustum.shape();
    let near = shape.near();
    let far = shape.far().unwrap_or(near);
    let middle = |a: f64, b: f64| 0.5 * a + 0.5 * b;
    let x = middle(near.rect.left, near.rect.right);
    let y = middle(near.rect.bottom, near.rect.top);
    frustum
        .pose()
        .to_world(Vec3::new(x, y, middle(near.z, far.z)))
}

fn vector(u: &mut Unstructured<'_>) -> Result<Vec3<f64>> {
    Ok(Vec3::new(any_number(u)?, any_number(u)?, any_number(u)?))
}

fn rect(u: &mut Unstructured<'_>) -> Result<Rect> {
    let [a, b] = [any_number(u)?, any_number(u)?];
    let [c, d] = [any_number(u)?, any_number(u)?];
    // In order mostly, or nearly every input would be an error.
    if u.ratio(15, 16)? {
        return Ok(Rect::new(a.min(b), a.max(b), c.min(d), c.max(d)));
    }
    Ok(Rect::new(a, b, c, d))
}

fn shape(u: &mut Unstructured<'_>) -> Result<Shape> {
    let near = EndRect {
        z: any_number(u)?,
        rect: rect(u)?,
    };
    if u.ratio(3, 4)? {
        let far = EndRect {
            z: any_number(u)?,
            rect: rect(u)?,
        };
        return Ok(Shape::Finite { near, far });
    }
    Ok(Shape::Infinite {
        near,
        slopes: rect(u)?,
        direction: if u.arbitrary()? {
            Direction::PlusZ
        } else {
            Direction::MinusZ
        },
    })
}

fn camera(u: &mut Unstructured<'_>) -> Result<Camera> {
    let projection = match u.int_in_range(0..=3_u8)? {
        0 => Projection::Perspective {
            fovy: any_number(u)?,
            aspect: any_number(u)?,
        },
        1 => Projection::OffAxis { rect: rect(u)? },
        2 => Projection::Orthographic {
            height: any_number(u)?,
            aspect: any_number(u)?,
        },
        _ => Projection::OrthographicRect { rect: rect(u)? },
    };
    Ok(Camera {
        eye: vector(u)?,
        target: vector(u)?,
        up: vector(u)?,
        projection,
        near: any_number(u)?,
        far: if u.ratio(1, 4)? {
            f64::INFINITY
        } else {
            any_number(u)?
        },
    })
}

fn matrix(u: &mut Unstructured<'_>) -> Result<Option<Frustum>> {
    let mut entries = [[0.0; 4]; 4];
    // The rows that a projection has anyway, then some other numbers.
    let usual = u.arbitrary::<bool>()?;
    if usual {
        entries = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, -1.0],
            [0.0, 0.0, 1.0, 0.0],
        ];
    }
    for entry in entries.iter_mut().flatten() {
        if !usual || u.ratio(1, 4)? {
            *entry = any_number(u)?;
        }
    }
    let layout = *u.choose(&[
        MatrixLayout::ColumnMajorColumnVectors,
        MatrixLayout::RowMajorColumnVectors,
    ])?;
    let clip = ClipSpace {
        depth: *u.choose(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne])?,
        y: *u.choose(&[ClipY::Up, ClipY::Down])?,
        reversed: u.arbitrary()?,
    };
    let made = if u.arbitrary()? {
        ViewProjection::new(entries.map(|row| row.map(|e| e as f32)), layout).frustum(clip)
    } else {
        ViewProjection::new(entries, layout).frustum(clip)
    };
    Ok(made.ok().map(|made| {
        let d = made.deviation();
        assert!(
            d.sides >= 0.0 && d.near >= 0.0 && d.far >= 0.0,
            "{entries:?}: {d:?}"
        );
        made.frustum
    }))
}

fn six_points(u: &mut Unstructured<'_>) -> Result<SixPoints> {
    let mut v = || vector(u);
    Ok(SixPoints {
        base_centre: v()?,
        top_centre: v()?,
        base_x: v()?,
        base_y: v()?,
        top_x: v()?,
        top_y: v()?,
    })
}
