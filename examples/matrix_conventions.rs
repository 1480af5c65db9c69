//! Makes the same frustum from matrices of OpenGL, Vulkan and wgpu conventions.
//!
//! `cargo run --release --example matrix_conventions`

use frusta::{ClipSpace, Face, MatrixLayout, Segment, ViewProjection};

const NEAR: f64 = 1.0;
const FAR: f64 = 9.0;

/// A square perspective of 90 degrees, from two entries that map depth, as rows times columns.
fn perspective(a: f64, b: f64, y: f64) -> [[f64; 4]; 4] {
    [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, y, 0.0, 0.0],
        [0.0, 0.0, a, b],
        [0.0, 0.0, -1.0, 0.0],
    ]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Depth as A z + B over -z. OpenGL: -1 at near, 1 at far; the others 0 and 1.
    let span = NEAR - FAR;
    let (gl, zero_to_one) = (
        ((FAR + NEAR) / span, 2.0 * FAR * NEAR / span),
        (FAR / span, FAR * NEAR / span),
    );
    let reversed = (-NEAR / span, -FAR * NEAR / span);
    let conventions = [
        ("OpenGL", perspective(gl.0, gl.1, 1.0), ClipSpace::OPENGL),
        (
            "wgpu",
            perspective(zero_to_one.0, zero_to_one.1, 1.0),
            ClipSpace::ZERO_TO_ONE,
        ),
        (
            "Vulkan",
            perspective(zero_to_one.0, zero_to_one.1, -1.0),
            ClipSpace::VULKAN,
        ),
        (
            "wgpu, reversed depth",
            perspective(reversed.0, reversed.1, 1.0),
            ClipSpace::ZERO_TO_ONE.reversed(),
        ),
    ];

    // From the axis upwards, half way between near and far: it leaves through the top.
    let edge = Segment::new([0.0, 0.0, -5.0], [0.0, 10.0, -5.0]);
    for (name, rows, clip_space) in conventions {
        // The arrays above are rows. glam's `to_cols_array_2d` is `ColumnMajorColumnVectors`.
        let matrix = ViewProjection::new(rows, MatrixLayout::RowMajorColumnVectors);
        let found = matrix.frustum(clip_space)?;
        let part = found
            .frustum
            .clip_segment(&edge)?
            .part
            .ok_or("the edge is outside")?;
        println!(
            "{name}: the edge leaves through {} at y = {}; sides off by at most {:e} in clip space",
            part.exit.faces,
            part.exit.point.y,
            found.deviation().sides
        );
        assert!(part.exit.faces.contains(Face::Top));
        assert_eq!(part.exit.point.y, 5.0);
    }
    Ok(())
}
