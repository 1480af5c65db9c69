//! Many frusta with few boxes each: those of a frame's shadows, made from matrices.
//!
//! Beside it stand six planes taken from the matrix in `f32`, as engines do, and a loop. Answers are compared
//! with one box a call first.

use super::{row, timed};
use frusta::samples::Random;
use frusta::{
    Aabb, Camera, ClipSpace, Containment, Culler, MatrixLayout, Projection, Vec3, ViewProjection,
};

/// Frusta, as of eight cascades or faces for each of 24 lights.
const FRUSTA: usize = 192;
const BOXES: usize = 2_000;

const CLIP: ClipSpace = ClipSpace::ZERO_TO_ONE;

fn matrices() -> Vec<ViewProjection<f32>> {
    let mut random = Random::new(&[192]);
    let mut point = |reach: f64| Vec3::from([(); 3].map(|()| random.between(-reach, reach)));
    let matrix = |i: usize| {
        let projection = match i % 2 {
            0 => Projection::Perspective {
                fovy: 1.6,
                aspect: 1.0,
            },
            _ => Projection::Orthographic {
                height: 40.0,
                aspect: 1.0,
            },
        };
        let (eye, ahead) = (point(50.0), point(1.0));
        let camera = Camera::new(eye, eye + ahead, [0.0, 1.0, 0.0], projection, 0.1, 60.0);
        camera.view_projection(CLIP).expect("a camera").to_f32()
    };
    (0..FRUSTA).map(matrix).collect()
}

fn boxes() -> Vec<Aabb<f32>> {
    let mut random = Random::new(&[2_000]);
    let mut point = |reach: f64| Vec3::from([(); 3].map(|()| random.between(-reach, reach) as f32));
    (0..BOXES)
        .map(|_| Aabb::from_center(point(100.0), [1.0; 3]))
        .collect()
}

/// Six planes by sums of the matrix's rows.
fn planes(matrix: &ViewProjection<f32>) -> [[f32; 4]; 6] {
    let [x, y, z, w] = matrix.to_array(MatrixLayout::RowMajorColumnVectors);
    let sum = |a: [f32; 4], sign: f32| std::array::from_fn(|i| w[i] + sign * a[i]);
    [
        sum(x, 1.0),
        sum(x, -1.0),
        sum(y, 1.0),
        sum(y, -1.0),
        z,
        sum(z, -1.0),
    ]
}

fn is_visible(planes: &[[f32; 4]; 6], b: &Aabb<f32>) -> bool {
    planes.iter().all(|&[x, y, z, d]| {
        let pick = |n: f32, min: f32, max: f32| n * if n > 0.0 { max } else { min };
        let (a, b) = (b.min, b.max);
        pick(x, a.x, b.x) + pick(y, a.y, b.y) + pick(z, a.z, b.z) + d >= 0.0
    })
}

pub(super) fn print(rounds: usize) {
    println!("\n{FRUSTA} frusta from matrices: ns a frustum (times as fast as the first)");
    let (matrices, boxes) = (&matrices(), &boxes());
    let culler =
        |m: &ViewProjection<f32>| Culler::new(&m.frustum(CLIP).expect("a frustum").frustum);
    let (mut differ, mut seen) = (0, 0);
    let mut visible = Vec::new();
    for matrix in matrices {
        let (culler, planes) = (culler(matrix), planes(matrix));
        culler.over(boxes).visible(&mut visible).expect("boxes");
        for (i, b) in boxes.iter().enumerate() {
            let is_in_list = visible.binary_search(&(i as u32)).is_ok();
            assert_eq!(culler.classify(*b) != Ok(Containment::Outside), is_in_list);
            differ += usize::from(is_visible(&planes, b) != is_in_list);
            seen += usize::from(is_in_list);
        }
    }
    // Planes of rounded sums are off by rounding.
    assert!(seen > 10_000 && differ < seen / 1_000, "{seen} {differ}");

    let made = timed(FRUSTA, || {
        for matrix in matrices {
            std::hint::black_box(culler(matrix));
        }
    });
    row("frustum and culler", rounds, vec![("exact", made)]);
    let mut list = Vec::with_capacity(BOXES);
    let naive = timed(FRUSTA, || {
        for matrix in matrices {
            let planes = planes(matrix);
            list.clear();
            let found = boxes
                .iter()
                .enumerate()
                .filter(|(_, b)| is_visible(&planes, b));
            list.extend(found.map(|(i, _)| i as u32));
            std::hint::black_box(&list);
        }
    });
    let exact = timed(FRUSTA, || {
        for matrix in matrices {
            culler(matrix)
                .over(boxes)
                .visible(&mut visible)
                .expect("boxes");
            std::hint::black_box(&visible);
        }
    });
    row(
        "with 2,000 boxes each",
        rounds,
        vec![("planes, loop", naive), ("exact", exact)],
    );
}
