//! Clips the edges of a wireframe, one by one and as a slice, and reads the answer: which part is
//! inside, and which faces cut it.
//!
//! `cargo run --release --example clip_edges`

use frusta::{Accuracy, Camera, Class, Projection, Segment};

/// The twelve edges of a cube.
fn cube(half: f64) -> Vec<Segment<f64>> {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { -half } else { half });
    let mut edges = Vec::new();
    for k in 0..8 {
        for axis in [1, 2, 4] {
            if k & axis == 0 {
                edges.push(Segment::new(corner(k), corner(k | axis)));
            }
        }
    }
    edges
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let camera = Camera {
        eye: [3.0, 2.0, 4.0].into(),
        target: [0.5, 0.5, 0.0].into(),
        up: [0.0, 1.0, 0.0].into(),
        projection: Projection::Perspective {
            fovy: 0.5,
            aspect: 1.5,
        },
        near: 0.1,
        far: 6.0,
    };
    let frustum = camera.frustum()?;
    let edges = cube(1.0);

    for edge in &edges {
        let clip = frustum.clip_segment(edge)?;
        let Some(part) = clip.part else {
            println!("{:?}: outside", edge.start.to_array());
            continue;
        };
        // An end that is not clipped is the edge's own, bit for bit.
        assert!(part.entry.clipped || part.entry.point == edge.start);
        println!(
            "{:?}: {} from t = {:.3} ({}) to {:.3} ({})",
            edge.start.to_array(),
            clip.class,
            part.entry.t,
            part.entry.faces,
            part.exit.t,
            part.exit.faces,
        );
    }

    // Many at once into a buffer that is used again: the same bits, in less time.
    let mut clips = Vec::new();
    frustum.clip_segments(&edges, Accuracy::Fast, &mut clips)?;
    for (edge, clip) in edges.iter().zip(&clips) {
        assert_eq!(*clip, frustum.clip_segment(edge)?);
    }
    let cut = clips
        .iter()
        .filter(|clip| clip.class == Class::Cross)
        .count();
    let outside = clips
        .iter()
        .filter(|clip| clip.class == Class::Outside)
        .count();
    println!(
        "{cut} of {} edges are cut, {outside} are outside",
        edges.len()
    );
    assert!(cut > 0 && cut + outside <= edges.len());
    Ok(())
}
