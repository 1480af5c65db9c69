//! A rubber band: what a rectangle of pixels touches, and what it holds, of boxes and of edges.
//!
//! `cargo run --release --example rubber_band`

use frusta::clip::{IndexedEdges, SegmentIntervals};
use frusta::{Aabb, Camera, Class, Containment, Culler, Projection, Projector};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A yard of 40 x 40 crates, and the fence around it.
    let crates: Vec<Aabb<f64>> = (0..1600)
        .map(|i| Aabb::from_center([f64::from(i % 40), f64::from(i / 40), 0.3], [0.3; 3]))
        .collect();
    let posts = [
        [-1.0, -1.0, 0.0],
        [40.0, -1.0, 0.0],
        [40.0, 40.0, 0.0],
        [-1.0, 40.0, 0.0],
    ];
    let (posts, rails) = (posts.map(Into::into), [[0, 1], [1, 2], [2, 3], [3, 0]]);

    let projection = Projection::Perspective {
        fovy: 0.8,
        aspect: 1.5,
    };
    let (eye, target) = ([20.0, -25.0, 20.0], [20.0, 15.0, 0.0]);
    let camera = Camera::new(eye, target, [0.0, 0.0, 1.0], projection, 0.1, f64::INFINITY);
    let screen = Projector::new(&camera.frustum()?).pixels(1200, 800);

    // Two corners in pixels, in the order in which the mouse met them.
    let band = screen.window([700.0, 300.0], [150.0, 520.0])?;

    // Boxes: exactly, so that none is taken that only its planes could not reject.
    let mut classes = Vec::new();
    Culler::new(&band)
        .over(&crates)
        .exact()
        .classes(&mut classes)?;
    let count = |class| classes.iter().filter(|&&c| c == class).count();
    let (whole, cut) = (count(Containment::Inside), count(Containment::Crossing));
    println!(
        "crates: {whole} in the band, {cut} more touched by it, of {}",
        crates.len()
    );

    // Edges: the class is enough.
    let mut intervals = SegmentIntervals::default();
    band.clip_intervals(IndexedEdges::new(&posts, &rails)?, &mut intervals)?;
    for (rail, class) in rails.iter().zip(intervals.classes()) {
        println!("rail {rail:?}: {class}");
    }
    let touched = intervals
        .classes()
        .iter()
        .filter(|&&c| c != Class::Outside)
        .count();
    println!("{touched} of {} rails are selected", rails.len());

    assert!(whole > 0 && cut > 0 && touched > 0);
    Ok(())
}
