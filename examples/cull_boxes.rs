//! Culls boxes with a moving `glam` camera in reversed infinite depth, as a renderer does.
//!
//! `cargo run --release --features glam --example cull_boxes`

use frusta::cull::BoxSet;
use frusta::{Aabb, ClipSpace, Culler, ViewProjection};
use glam::Vec3;
use glam::camera::rh::{proj::directx::perspective_infinite_reverse, view::look_to_mat4};

/// Boxes along a street, which runs in -z: a house on each side every ten metres.
fn street() -> Vec<Aabb<f32>> {
    let house = |i: u16| {
        let (side, z) = (f32::from(i % 2) * 20.0 - 10.0, -10.0 * f32::from(i / 2));
        Aabb::new([side - 4.0, 0.0, z - 4.0], [side + 4.0, 6.0, z + 4.0])
    };
    (0..10_000).map(house).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Boxes that are kept from frame to frame are checked once and culled fastest.
    let houses = BoxSet::new(street())?;
    // Depth 1 at the near face, 0 at infinity: the best use of a float depth buffer.
    let projection = perspective_infinite_reverse(1.0, 16.0 / 9.0, 0.1);
    let clip_space = ClipSpace::ZERO_TO_ONE.reversed();

    let mut visible = Vec::new();
    for frame in 0..5_u8 {
        let eye = Vec3::new(0.0, 1.7, -10.0 * f32::from(frame));
        let ahead = Vec3::new(f32::from(frame) * 0.2, 0.0, -1.0);
        let view = look_to_mat4(eye, ahead, Vec3::Y);

        let frustum = ViewProjection::from(projection * view)
            .frustum(clip_space)?
            .frustum;
        // Making a culler takes some ten microseconds: once a frame, or once a view.
        Culler::new(&frustum).over(&houses).visible(&mut visible)?;
        println!(
            "frame {frame}: {} of {} houses",
            visible.len(),
            houses.len()
        );

        // Answers are exact: a box is listed if no face plane rejects it, touching included.
        assert!(visible.is_sorted());
        let in_front = |&i: &u32| houses.get(i as usize).is_some_and(|b| b.min.z <= eye.z);
        assert!(!visible.is_empty() && visible.iter().all(in_front));
    }
    Ok(())
}
