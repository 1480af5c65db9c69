//! Culls boxes a few millimetres in size on a globe of 6,378 km: answers of `f64` in the time of `f32`.
//!
//! `cargo run --release --example large_world`

use frusta::cull::RelativeBoxes;
use frusta::{Aabb, Camera, Containment, Culler, Projection};

/// Where the bench with the screws stands, in metres from the earth's centre.
const BENCH: [f64; 3] = [4_200_000.0, 170_000.0, 4_780_000.25];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A thousand screws of 2 mm, a centimetre apart.
    let screw = |i: u32| {
        let [x, y, z] = BENCH;
        let center = [x + 0.5, y + 0.01 * (f64::from(i) - 500.0), z];
        Aabb::new(center.map(|c| c - 0.001), center.map(|c| c + 0.001))
    };
    let screws: Vec<_> = (0..1000).map(screw).collect();

    // Relative to a place near them; move it with `move_to` when the eye goes far away.
    let relative = RelativeBoxes::new(BENCH, &screws)?;
    let camera = Camera {
        eye: BENCH.into(),
        target: [BENCH[0] + 0.5, BENCH[1], BENCH[2]].into(),
        up: [0.0, 0.0, 1.0].into(),
        projection: Projection::Perspective {
            fovy: 0.1,
            aspect: 1.0,
        },
        near: 0.1,
        far: 10.0,
    };
    let culler = Culler::new(&camera.frustum()?);
    let mut visible = Vec::new();
    culler.over(&relative).visible(&mut visible)?;
    println!("{} of {} screws are in view", visible.len(), screws.len());

    // Exactly the answers for the boxes in f64.
    for (i, screw) in screws.iter().enumerate() {
        let is_visible = culler.classify(*screw)? != Containment::Outside;
        assert_eq!(is_visible, visible.contains(&(i as u32)));
    }

    // In f32, x and z have steps of half a metre there and y of 1.6 cm: screws a centimetre apart
    // fall together.
    let narrow = |b: &Aabb<f64>| (b.min.x as f32, b.min.y as f32);
    let mut places: Vec<_> = screws.iter().map(narrow).collect();
    places.dedup();
    println!("rounded to f32 they stand in {} places", places.len());
    assert!(places.len() < 1000);
    Ok(())
}
