//! A CAD viewer's frame: the pixel coordinates of a model's edges, none of them outside of the window.
//!
//! `cargo run --release --example viewer`

use frusta::clip::IndexedEdges;
use frusta::{Accuracy, Camera, Projection, Projector, Vec3};

/// A torus as models are stored: `f32` points that edges share.
fn torus(around: u16, across: u16) -> (Vec<Vec3<f32>>, Vec<[u32; 2]>) {
    let (mut points, mut edges) = (Vec::new(), Vec::new());
    let turn = |k: u16, n: u16| (f32::from(k) / f32::from(n) * std::f32::consts::TAU).sin_cos();
    let index = |i: u16, j: u16| u32::from(i % around * across + j % across);
    for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let ((sin, cos), (z, r)) = (turn(i, around), turn(j, across));
        points.push([(3.0 + r) * cos, (3.0 + r) * sin, z].into());
        edges.push([index(i, j), index(i + 1, j)]);
        edges.push([index(i, j), index(i, j + 1)]);
    }
    (points, edges)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (points, edges) = torus(96, 24);
    let edges = IndexedEdges::new(&points, &edges)?;
    let (fovy, aspect) = (0.9, 1.5);
    let projection = Projection::Perspective { fovy, aspect };
    let (eye, target, up) = ([4.5_f32, -1.0, 1.5], [1.0, 2.5, 0.0], [0.0, 0.0, 1.0]);
    let frustum = Camera::new(eye, target, up, projection, 0.05, 50.0).frustum()?;
    let screen = Projector::new(&frustum).pixels(900, 600);

    // Buffers that serve every frame.
    let (mut clips, mut ends, mut pixels) = (Vec::new(), Vec::new(), Vec::new());
    frustum.clip_segments(edges, Accuracy::Inward, &mut clips)?;
    for part in clips.iter().filter_map(|clip| clip.part.as_ref()) {
        ends.extend([part.entry.point, part.exit.point]);
    }
    screen.project_points(&ends, &mut pixels)?;

    for line in pixels.chunks_exact(2) {
        // Ends in the frustum have an image, and it is in the window.
        let [Some(a), Some(b)] = line else { continue };
        println!("{:.2},{:.2} to {:.2},{:.2}", a.x, a.y, b.x, b.y);
        for pixel in [a, b] {
            assert!((0.0..=900.0).contains(&pixel.x) && (0.0..=600.0).contains(&pixel.y));
        }
    }
    let count = pixels.len() / 2;
    println!("{count} of {} edges are in the window", edges.len());
    assert!(count > 100 && count < edges.len() && pixels.iter().all(Option::is_some));
    Ok(())
}
