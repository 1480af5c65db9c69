//! Points to pixels, beside a view-projection matrix and a division.
//!
//! All write one image for each point into the same buffer, a thousand points at a time, and take
//! turns. First every image is compared with that of the matrix.

use super::{Mix, Real};
use frusta::{Accuracy, ClipSpace, Frustum, MatrixLayout, Projector, Vec3};
use frusta_lab::mixes::{COUNT, Form, frustum};
use frusta_lab::turns::{Pass, take_turns};
use std::hint::black_box;
use std::time::Instant;

/// Points projected with one call.
const PIECE: usize = 1024;

const WIDTH: u32 = 1920;
const HEIGHT: u32 = 1080;

type Image<T> = Option<Vec3<T>>;

/// What programs do without a library.
struct Matrix<T> {
    rows: [[T; 4]; 4],
    half: [T; 2],
}

impl<T: Real> Matrix<T> {
    fn new(frustum: &Frustum) -> Self {
        let matrix = frustum.view_projection(ClipSpace::ZERO_TO_ONE);
        let rows = matrix
            .expect("it has an eye")
            .to_array(MatrixLayout::RowMajorColumnVectors);
        Self {
            rows: rows.map(|row| row.map(T::from_f64)),
            half: [WIDTH, HEIGHT].map(|side| T::from_f64(0.5 * f64::from(side))),
        }
    }

    #[inline]
    fn project(&self, p: Vec3<T>) -> Image<T> {
        let [x, y, z, w] = self
            .rows
            .map(|r| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]);
        let [half_width, half_height] = self.half;
        let (x, y) = (x / w * half_width, y / w * half_height);
        (w > T::ZERO).then(|| Vec3::new(half_width + x, half_height - y, z / w))
    }
}

fn pass<T: Real>(all: &[Vec3<T>], mut project: impl FnMut(&[Vec3<T>], &mut Vec<Image<T>>)) -> f64 {
    let mut images = Vec::with_capacity(PIECE);
    let start = Instant::now();
    for piece in all.chunks(PIECE) {
        project(piece, &mut images);
        black_box(&images);
    }
    start.elapsed().as_nanos() as f64 / all.len() as f64
}

/// Asserts that a point in the frustum has the matrix's pixel, up to the matrix's rounding, and that all images of a slice are
/// those of its points.
fn assert_same<T: Real>(screen: &Projector, matrix: &Matrix<f64>, all: &[Vec3<T>]) {
    let mut images = Vec::new();
    screen.project_points(all, &mut images).expect("finite");
    for (&point, image) in all.iter().zip(images) {
        assert_eq!(screen.project(point).expect("finite"), image);
        if !screen.frustum().contains(point).expect("finite") {
            continue;
        }
        let image = image.expect("in front of the eye").to_f64();
        let other = matrix.project(point.to_f64()).expect("in front of the eye");
        let error = (image.x - other.x).abs().max((image.y - other.y).abs());
        assert!(error < 1e-3, "{point}: {image}, {other}");
    }
}

fn row<T: Real>(frustum: &Frustum, all: &[Vec3<T>], rounds: usize) {
    let screen = Projector::new(frustum).pixels(WIDTH, HEIGHT);
    let matrix = Matrix::<T>::new(frustum);
    assert_same(&screen, &Matrix::new(frustum), all);
    let mut passes: [Pass<'_>; 3] = [
        Box::new(|| {
            pass(all, |points, images| {
                images.clear();
                images.extend(points.iter().map(|&p| matrix.project(p)));
            })
        }),
        Box::new(|| {
            pass(all, |points, images| {
                images.clear();
                let project = |&p| screen.project(p).expect("finite");
                images.extend(points.iter().map(project));
            })
        }),
        Box::new(|| {
            pass(all, |points, images| {
                screen.project_points(points, images).expect("finite");
            })
        }),
    ];
    for timing in take_turns(&mut passes, rounds) {
        print!(" {:6.1} ({:5.2})", timing.nanoseconds, timing.ratio.median);
    }
    println!();
}

fn table<T: Real>(scalar: &str, rounds: usize) {
    for (place, pose) in Mix::poses() {
        println!("\n{scalar}, in the {place}");
        println!("{:20} {:>14} {:>14} {:>14}", "", "matrix", "one", "slice");
        let frustum = frustum(Form::Symmetric.shape(), &pose);
        for mix in Mix::ALL {
            let segments = mix.segments::<T>(COUNT, &pose);
            let ends: Vec<_> = segments.iter().map(|segment| segment.end).collect();
            print!("{:20}", mix.name());
            row(&frustum, &ends, rounds);
        }
        // Half of them are on a face, up to rounding.
        let segments = Mix::ALL[1].segments::<T>(COUNT, &pose);
        let mut clips = Vec::new();
        let done = frustum.clip_segments(&segments, Accuracy::Inward, &mut clips);
        done.expect("finite");
        let parts = clips.iter().filter_map(|clip| clip.part.as_ref());
        let ends: Vec<_> = parts.flat_map(|p| [p.entry.point, p.exit.point]).collect();
        print!("{:20}", "ends of parts");
        row(&frustum, &ends, rounds);
    }
}

/// All tables.
pub(super) fn print(rounds: usize) {
    println!("\nPoints to pixels, nanoseconds; in brackets multiples of the matrix's time");
    table::<f64>("f64", rounds);
    table::<f32>("f32", rounds);
}
