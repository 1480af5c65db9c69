//! A renderer's frame: bevy's `glam`, a moving camera in reversed infinite depth, and one object whose bounds are NaN.
//!
//! `cargo run --release --features glam033 --example renderer`

use frusta::cull::BoxSet;
use frusta::{Aabb, ClipSpace, Culler, ViewProjection, VolumeCounts};
use glam033::Vec3;
use glam033::camera::rh::{proj::directx::perspective_infinite_reverse, view::look_to_mat4};

/// Boxes along a street, which runs in -z: a house on each side every ten metres.
fn street() -> Vec<Aabb<f32>> {
    let house = |i: u16| {
        let (side, z) = (f32::from(i % 2) * 20.0 - 10.0, -10.0 * f32::from(i / 2));
        Aabb::from_center(Vec3::new(side, 3.0, z), Vec3::new(4.0, 3.0, 4.0))
    };
    (0..10_000).map(house).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // What does not move is checked once and culled fastest.
    let houses = BoxSet::new(street())?;
    // What moves is read where it is. One of them is broken: it is drawn, and all the others, too.
    let mut cars = street();
    cars[17].max.y = f32::NAN;
    // Depth 1 at the near face, 0 at infinity: the best use of a float depth buffer.
    let projection = perspective_infinite_reverse(1.0, 16.0 / 9.0, 0.1);
    let clip_space = ClipSpace::ZERO_TO_ONE.reversed();

    let (mut visible, mut moving) = (Vec::new(), Vec::new());
    for frame in 0..5_u8 {
        let eye = Vec3::new(0.0, 1.7, -10.0 * f32::from(frame));
        let ahead = Vec3::new(f32::from(frame) * 0.2, 0.0, -1.0);
        let view = look_to_mat4(eye, ahead, Vec3::Y);

        let frustum = ViewProjection::from(projection * view)
            .frustum(clip_space)?
            .frustum;
        let culler = Culler::new(&frustum);
        culler.over(&houses).visible(&mut visible)?;
        let mut counts = VolumeCounts::default();
        let query = culler.over(&cars).keep_invalid().counted(&mut counts);
        query.visible(&mut moving)?;
        println!(
            "frame {frame}: {} houses, {} cars, {} of them invalid",
            visible.len(),
            moving.len(),
            counts.invalid,
        );

        // Answers are exact: a box is listed if no face plane rejects it, touching included.
        let in_front = |&i: &u32| houses.get(i as usize).is_some_and(|b| b.min.z <= eye.z);
        assert!(!visible.is_empty() && visible.iter().all(in_front));
        assert!(moving.contains(&17) && counts.invalid == 1);
    }
    Ok(())
}
