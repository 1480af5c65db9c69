//! The inputs, what the peers make of them, and what frusta does.

use crate::boxes::{Collision, GridBox, TreeCuller};
use crate::peer::Peer;
use crate::scene::{Block, Camera};
use crate::segments::{
    CohenSutherland2, Found, Ours, ParryBox64, ParryCall, Prepared, cube_matrix,
};
use bevy_math::{Mat4, Vec4};
use bevy_shape::ViewFrustum;
use cgmath::Ortho;
use collision::Projection;
use frusta::clip::VwProjection;
use frusta::{Accuracy, EndRect, Frustum, Pose, Real, Segment, Shape, Vec3};
use frusta_lab::mixes;

/// An input, with who answers it.
pub struct Input {
    /// The crate.
    pub library: &'static str,
    /// What of it is called.
    pub what: &'static str,
    /// With what, in words.
    pub input: &'static str,
    /// Asks the crate; may never end.
    pub theirs: fn() -> String,
    /// Asks frusta; empty where it has no such question.
    pub ours: fn() -> String,
}

/// All inputs.
pub const INPUTS: &[Input] = &[
    Input {
        library: "parry3d-f64",
        what: "Aabb::clip_segment",
        input: "the cube from -1 to 1, (-10,0,0) to (-5,0,0)",
        theirs: || parry([[-10.0, 0.0, 0.0], [-5.0, 0.0, 0.0]]),
        ours: || ours(&Block::CUBE, [[-10.0, 0.0, 0.0], [-5.0, 0.0, 0.0]]),
    },
    Input {
        library: "parry3d-f64",
        what: "Aabb::clip_segment",
        input: "the cube from -1 to 1, (0,0,0) to (NaN,0,0)",
        theirs: || parry([[0.0; 3], [f64::NAN, 0.0, 0.0]]),
        ours: || ours(&Block::CUBE, [[0.0; 3], [f64::NAN, 0.0, 0.0]]),
    },
    Input {
        library: "parry3d-f64",
        what: "Aabb::clip_segment",
        input: "the cube from -1 to 1, (-1e308,0,0) to (1e308,0,0)",
        theirs: || parry([[-1e308, 0.0, 0.0], [1e308, 0.0, 0.0]]),
        ours: || ours(&Block::CUBE, [[-1e308, 0.0, 0.0], [1e308, 0.0, 0.0]]),
    },
    Input {
        library: "retrofire-core",
        what: "view_frustum::clip",
        input: "clip space, w = 1, (1,0,0) to (3,0,0)",
        theirs: || retrofire([[1.0, 0.0, 0.0], [3.0, 0.0, 0.0]]),
        ours: || ours(&Block::CUBE, [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0]]),
    },
    Input {
        library: "retrofire-core",
        what: "view_frustum::clip",
        input: "clip space, w = 1, (0,0,0) to (NaN,0,0)",
        theirs: || retrofire([[0.0; 3], [f32::NAN, 0.0, 0.0]]),
        ours: || ours(&Block::CUBE, [[0.0; 3], [f64::NAN, 0.0, 0.0]]),
    },
    Input {
        library: "line-clipping",
        what: "cohen_sutherland::clip_line",
        input: "a window from -2 to 2 and, reversed, 1 to -1; (0,0) to (1,NaN)",
        theirs: || line_clipping(&REVERSED, [[0.0; 2], [1.0, f64::NAN]]),
        ours: || reversed([[0.0; 3], [1.0, f64::NAN, 0.0]]),
    },
    Input {
        library: "line-clipping",
        what: "cohen_sutherland::clip_line",
        input: "the window from -1 to 1, (-1e200,-1e200) to (1e200,1e200)",
        theirs: || line_clipping(&Block::CUBE, [[-1e200; 2], [1e200; 2]]),
        ours: || ours(&Block::CUBE, [[-1e200, -1e200, 0.0], [1e200, 1e200, 0.0]]),
    },
    Input {
        library: "line-clipping",
        what: "cohen_sutherland::clip_line",
        input: "the window from -1 to 1, (-inf,0) to (inf,0)",
        theirs: || {
            line_clipping(
                &Block::CUBE,
                [[f64::NEG_INFINITY, 0.0], [f64::INFINITY, 0.0]],
            )
        },
        ours: || {
            let ends = [f64::NEG_INFINITY, f64::INFINITY];
            ours(&Block::CUBE, ends.map(|x| [x, 0.0, 0.0]))
        },
    },
    Input {
        library: "plane-split",
        what: "Polygon::from_points",
        input: "a square of side 1e-8",
        theirs: tiny_square,
        ours: String::new,
    },
    Input {
        library: "treeculler",
        what: "Frustum::from_modelview_projection",
        input: "f32, near 1e-6, far 1e6; a box at depth 1e9",
        theirs: deep_view,
        ours: || {
            let deep = Vec3::new(0.0, 0.0, -1e9);
            match DEEP.frustum().contains(deep) {
                Ok(inside) => format!("the point there: inside = {inside}"),
                Err(error) => error.to_string(),
            }
        },
    },
    Input {
        library: "collision",
        what: "Projection::to_frustum of Ortho",
        input: "an orthographic view from -1 to 1, a small box in its middle",
        theirs: centred_box,
        ours: || ours(&Block::CUBE, [[-0.25; 3], [0.25; 3]]),
    },
    Input {
        library: "bevy_shape",
        what: "ViewFrustum::from_clip_from_world",
        input: "infinite reversed depth, near 1, looking along -z; a point at z = -0.5",
        theirs: reversed_depth,
        ours: infinite_near,
    },
];

/// A window whose bottom is above its top.
const REVERSED: Block = Block {
    min: [-2.0, 1.0, -1.0],
    max: [2.0, -1.0, 1.0],
};

/// Near over far is 1e-12.
const DEEP: Camera = Camera {
    slopes: [1.0, 1.0],
    depths: [1e-6, 1e6],
    direction: -1.0,
    pose: Pose::IDENTITY,
};

fn segment<T: Real>(ends: [[T; 3]; 2]) -> Segment<T> {
    let [start, end] = ends.map(Vec3::from);
    Segment::new(start, end)
}

/// An answer in words.
fn say<T: Real>(found: &Found<T>) -> String {
    match found {
        Found::Nothing => "nothing inside".to_owned(),
        Found::Refused => "ends that are not finite".to_owned(),
        Found::Part(ends) => {
            let [a, b] = ends.map(|end| {
                let [x, y, z] = end.point.to_f64().to_array();
                format!("({x:?}, {y:?}, {z:?})")
            });
            format!("inside from {a} to {b}")
        }
    }
}

fn parry(ends: [[f64; 3]; 2]) -> String {
    let mut cube = ParryBox64::new(&Block::CUBE, ParryCall::ClipSegment);
    say(&cube.answer(&segment(ends)))
}

fn retrofire(ends: [[f32; 3]; 2]) -> String {
    say(&Prepared::new(cube_matrix()).answer(&segment(ends)))
}

fn line_clipping(window: &Block, ends: [[f64; 2]; 2]) -> String {
    let ends = ends.map(|[x, y]| [x, y, 0.0]);
    say(&CohenSutherland2::new(window).answer(&segment(ends)))
}

/// To the nearest: `Fast` is as exact as the segment's coordinates are large.
fn clipped(frustum: &Frustum, ends: [[f64; 3]; 2]) -> String {
    let nearest = VwProjection::exact(Accuracy::Nearest);
    let s = segment(ends);
    match frustum.clip_segment(&s) {
        Err(error) => format!("refused: {error}"),
        Ok(_) => say(&Ours::new(frustum, nearest, "").answer(&s)),
    }
}

fn ours(block: &Block, ends: [[f64; 3]; 2]) -> String {
    clipped(&block.frustum(), ends)
}

/// frusta refuses the window itself.
fn reversed(ends: [[f64; 3]; 2]) -> String {
    let ([x0, y0, _], [x1, y1, _]) = (REVERSED.min, REVERSED.max);
    let end = |z| EndRect::new(z, x0, x1, y0, y1);
    let shape = Shape::Finite {
        near: end(1.0),
        far: end(-1.0),
    };
    match Frustum::new(Pose::IDENTITY, shape) {
        Err(error) => format!("refused: {error}"),
        Ok(frustum) => clipped(&frustum, ends),
    }
}

fn tiny_square() -> String {
    use euclid::default::Point3D;
    let side = 1e-8;
    let corners = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
    let points = corners.map(|[x, y]| Point3D::new(x, y, 0.0));
    match plane_split::Polygon::from_points(points, ()) {
        Some(_) => "a polygon".to_owned(),
        None => "no polygon".to_owned(),
    }
}

fn deep_view() -> String {
    let block = GridBox {
        min: [-1.0, -1.0, -1e9],
        max: [1.0, 1.0, -1e9],
    };
    let far = TreeCuller::new(&DEEP, false).far_plane();
    let seen = TreeCuller::new(&DEEP, false).answer(&block) == Some(true);
    format!("the far plane is {far:?}; seen = {seen}")
}

fn centred_box() -> String {
    let (left, right) = (-1.0, 1.0);
    let ortho = Ortho {
        left,
        right,
        bottom: left,
        top: right,
        near: left,
        far: right,
    };
    let block = GridBox {
        min: [-0.25; 3],
        max: [0.25; 3],
    };
    let mut peer = Collision::of(ortho.to_frustum());
    let input = peer.prepare(&block);
    format!("Relation::{:?}", peer.run(&input))
}

/// bevy's own kind of matrix: `w = -z`, depth `near / w`.
fn reversed_depth() -> String {
    let near = 1.0;
    let matrix = Mat4::from_cols(
        Vec4::new(1.0, 0.0, 0.0, 0.0),
        Vec4::new(0.0, 1.0, 0.0, 0.0),
        Vec4::new(0.0, 0.0, 0.0, -1.0),
        Vec4::new(0.0, 0.0, near, 0.0),
    );
    let frustum = ViewFrustum::from_clip_from_world(&matrix);
    let plane = frustum.half_spaces[ViewFrustum::NEAR_PLANE_IDX].normal_d();
    let distance = plane.dot(Vec4::new(0.0, 0.0, -0.5, 1.0));
    format!("its near half space is {plane:?}; the point is {distance} inside of it")
}

fn infinite_near() -> String {
    let shape = Shape::Infinite {
        near: EndRect::new(-1.0, -1.0, 1.0, -1.0, 1.0),
        slopes: frusta::Rect::centred(1.0, 1.0),
        direction: frusta::Direction::MinusZ,
    };
    let frustum = mixes::frustum(shape, &Pose::IDENTITY);
    match frustum.contains([0.0, 0.0, -0.5]) {
        Ok(inside) => format!("inside = {inside}"),
        Err(error) => error.to_string(),
    }
}
