//! Culls a tree of boxes with face masks: a node that is inside of a face settles that face for
//! everything in it.
//!
//! `cargo run --release --example cull_tree`

use frusta::{Aabb, Camera, Containment, Culler, Face, FaceSet, Projection, VolumeError};

/// A node of a tree with eight children each, over a cube of the world.
struct Node {
    bounds: Aabb<f64>,
    children: Vec<Node>,
    /// The face that rejected this node in an earlier frame is tried first.
    hint: Option<Face>,
}

fn tree(min: [f64; 3], size: f64, depth: u32) -> Node {
    let octant = |k: usize| {
        let corner = [0, 1, 2].map(|axis| min[axis] + size / 2.0 * ((k >> axis & 1) as f64));
        tree(corner, size / 2.0, depth - 1)
    };
    Node {
        bounds: Aabb::new(min, min.map(|c| c + size)),
        children: if depth == 0 {
            Vec::new()
        } else {
            (0..8).map(octant).collect()
        },
        hint: None,
    }
}

#[derive(Default)]
struct Tally {
    tests: u32,
    visible_leaves: u32,
}

fn visit(
    culler: &Culler,
    node: &mut Node,
    faces: FaceSet,
    tally: &mut Tally,
) -> Result<(), VolumeError> {
    // Without faces left to ask, the node is wholly inside.
    let mut left = faces;
    if !faces.is_empty() {
        tally.tests += 1;
        let found = culler.classify_masked(node.bounds, faces, &mut node.hint)?;
        if found.containment == Containment::Outside {
            return Ok(());
        }
        left = found.faces;
    }
    tally.visible_leaves += u32::from(node.children.is_empty());
    for child in &mut node.children {
        visit(culler, child, left, tally)?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut root = tree([-64.0; 3], 128.0, 5);
    for frame in 0..3_u8 {
        let angle = 0.05 * f64::from(frame);
        let camera = Camera {
            eye: [0.0, 0.0, 0.0].into(),
            target: [angle.sin(), 0.0, -angle.cos()].into(),
            up: [0.0, 1.0, 0.0].into(),
            projection: Projection::Perspective {
                fovy: 0.8,
                aspect: 1.5,
            },
            near: 0.5,
            far: 50.0,
        };
        let frustum = camera.frustum()?;
        let faces: FaceSet = frustum.faces().iter().copied().collect();
        let mut tally = Tally::default();
        visit(&Culler::new(&frustum), &mut root, faces, &mut tally)?;
        println!(
            "frame {frame}: {} of 32,768 leaves visible, {} boxes tested",
            tally.visible_leaves, tally.tests
        );
        assert!(tally.visible_leaves > 0 && tally.tests < 32_768);
    }
    Ok(())
}
