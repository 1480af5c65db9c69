//! Boxes and spheres, one by one and many at once: errors, false accepts, run times.
//!
//! # Errors
//! The culler's answers about hard volumes of every family, one by one and many at once, are
//! compared with integers: [`verify_volumes`].
//!
//! # False accepts
//! A test plane by plane accepts boxes that are beyond an edge or a corner: no face plane rejects
//! them. Boxes of up to a size, in and around a turned camera's frustum, are tested plane by plane
//! and exactly; the share is that of the accepted boxes that the exact test rejects. It depends on
//! the distribution of boxes: here even where a box of that size can touch the frustum's bounding
//! box.
//!
//! # Times
//! The same everyday boxes, spheres and segments, one a call and [`VolumeSurvey::PIECE`] a call, in
//! [turns](super::turns).

use super::turns::{Timing, Turns};
use super::verify_volumes::{VolumeKind, VolumeTally, verify_volumes};
use frusta::clip::{SegmentArrays, SegmentIntervals};
use frusta::cull::{Aabb, Containment, Culler, Obb, Sphere};
use frusta::cull::{BoxArrays, BoxSet, ContainmentMasks, SphereArrays};
use frusta::frustum::{Camera, FarCorners, Frustum, Projection};
use frusta::math::{Pose, Segment, Vec3};
use frusta::samples::{Family, Mix, Random};
use std::hint::black_box;
use std::time::Instant;

/// The results on volumes.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeSurvey {
    /// Sums over families, a row a kind.
    pub errors: Vec<(VolumeKind, VolumeTally)>,
    /// By size and field of view.
    pub accepts: Vec<FalseAccepts>,
    /// Run times, a row a function; the others of a job are compared with its first.
    pub times: Vec<VolumeTime>,
    /// Number of volumes of each kind that were timed.
    pub timed: usize,
    /// Number of rounds.
    pub rounds: u32,
}

/// How much is measured.
#[derive(Clone, Debug)]
pub struct VolumePlan {
    /// Families whose hard volumes are tried.
    pub families: Vec<Family>,
    /// Volumes of each kind and family.
    pub cases: u64,
    /// Which ones.
    pub seed: u64,
    /// Threads that try them.
    pub threads: usize,
    /// Boxes of each size and field of view.
    pub boxes: u64,
    /// How many are timed.
    pub timed: usize,
    /// Rounds of timing.
    pub rounds: u32,
}

impl VolumePlan {
    /// The sum of all steps passed to `on_step`.
    pub fn steps(&self) -> u64 {
        let tried = self.families.len() as u64 * VolumeKind::ALL.len() as u64 * self.cases;
        let timed = u64::from(self.rounds) * TIMED_STEP;
        tried + VIEWS.len() as u64 * (self.boxes / BOXES_STEP) + timed
    }
}

/// Boxes that count as one step.
const BOXES_STEP: u64 = 16;
/// Steps that a round of timing counts as.
const TIMED_STEP: u64 = 400;

/// Half extents up to this part of the depth, and fields of view in radians.
const VIEWS: [(f64, f64); 6] = [
    (0.02, 1.0),
    (0.1, 1.0),
    (0.5, 1.0),
    (1.0, 1.0),
    (0.1, 0.1),
    (0.5, 0.1),
];

/// Boxes that no face plane rejects, and those of them that the exact test rejects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FalseAccepts {
    /// Half extents are up to this part of the far distance.
    pub size: f64,
    /// The angle of view, upwards and across, in radians.
    pub field_of_view: f64,
    /// Number of boxes.
    pub boxes: u64,
    /// Number of boxes that no face plane rejects.
    pub accepted: u64,
    /// Number of these that are separate from the frustum.
    pub falsely: u64,
}

impl FalseAccepts {
    /// The share of false accepts in what is accepted.
    pub fn share(&self) -> f64 {
        self.falsely as f64 / self.accepted.max(1) as f64
    }
}

/// A function's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeTime {
    /// The kind of volume, all in `f32`: `box`, `oriented box`, `sphere` or `segment`.
    pub job: &'static str,
    /// The function and, of many, the source.
    pub function: &'static str,
    /// The time a volume; the ratio is to the job's first function.
    pub timing: Timing,
}

impl VolumeSurvey {
    /// Number of volumes a call, in queries over many.
    pub const PIECE: usize = 4096;

    /// Whether every answer is right.
    pub fn is_right(&self) -> bool {
        self.errors.iter().all(|(_, tally)| tally.is_clean())
    }
}

/// Tries, counts and times.
///
/// ```
/// use frusta::report::{VolumePlan, volumes};
/// use frusta::samples::Family;
/// let plan = VolumePlan {
///     families: vec![Family::Random],
///     cases: 20,
///     seed: 1,
///     threads: 1,
///     boxes: 2_000,
///     timed: 5_000,
///     rounds: 1,
/// };
/// let found = volumes(&plan, &|_| {});
/// assert!(found.is_right());
/// // More than a fifth of large boxes in a narrow view are accepted falsely.
/// assert!(found.accepts.last().unwrap().share() > 0.2);
/// ```
pub fn volumes(plan: &VolumePlan, on_step: &(dyn Fn(u64) + Sync)) -> VolumeSurvey {
    let mut errors = VolumeKind::ALL.map(|kind| (kind, VolumeTally::default()));
    for &family in &plan.families {
        for row in verify_volumes(family, plan.cases, plan.seed, plan.threads, on_step) {
            errors[row.kind as usize].1 += row.tally;
        }
    }
    let accepts = VIEWS.iter().filter_map(|&(size, view)| {
        let found = false_accepts(size, view, plan);
        on_step(plan.boxes / BOXES_STEP);
        found
    });
    VolumeSurvey {
        errors: errors.to_vec(),
        accepts: accepts.collect(),
        times: times(plan, on_step),
        timed: plan.timed,
        rounds: plan.rounds,
    }
}

/// The far distance of these views.
const FAR: f64 = 100.0;

/// A square view from 1 to 100, along none of the axes, which boxes lie along: as cameras do.
fn view(field_of_view: f64) -> Option<Frustum> {
    let camera = Camera {
        eye: Vec3::default(),
        target: Vec3::new(3.0, 2.0, 1.0),
        up: Vec3::new(0.0, 0.0, 1.0),
        projection: Projection::Perspective {
            fovy: field_of_view,
            aspect: 1.0,
        },
        near: 1.0,
        far: FAR,
    };
    camera.frustum().ok()
}

/// A box of up to a half extent, evenly where one can touch the frustum's bounds.
fn any_box(random: &mut Random, [low, high]: [Vec3<f64>; 2], most: f64) -> Aabb<f64> {
    let mut pick = |k: usize| random.between(low[k] - most, high[k] + most);
    let middle = Vec3::new(pick(0), pick(1), pick(2));
    let mut half = || random.between(0.0, most);
    let half = Vec3::new(half(), half(), half());
    Aabb::new(middle - half, middle + half)
}

/// The least and the greatest corner of a frustum's bounding box.
fn bounds(frustum: &Frustum) -> Option<[Vec3<f64>; 2]> {
    let corners = frustum.corners();
    let FarCorners::Points(far) = corners.far else {
        return None;
    };
    let Aabb { min, max } = Aabb::around(corners.near.into_iter().chain(far))?;
    Some([min, max])
}

fn false_accepts(size: f64, field_of_view: f64, plan: &VolumePlan) -> Option<FalseAccepts> {
    let frustum = view(field_of_view)?;
    let culler = Culler::new(&frustum);
    let bounds = bounds(&frustum)?;
    let mut random = Random::new(&[plan.seed, size.to_bits(), field_of_view.to_bits()]);
    let (mut accepted, mut falsely) = (0, 0);
    for _ in 0..plan.boxes {
        let volume = any_box(&mut random, bounds, size * FAR);
        if culler.classify(volume) != Ok(Containment::Outside) {
            accepted += 1;
            let is_separate = culler.classify_exact(volume) == Ok(Containment::Outside);
            falsely += u64::from(is_separate);
        }
    }
    Some(FalseAccepts {
        size,
        field_of_view,
        boxes: plan.boxes,
        accepted,
        falsely,
    })
}

/// The volumes and segments that are timed, as structures and as arrays.
struct Scene {
    culler: Culler,
    boxes: Vec<Aabb<f32>>,
    box_columns: [Vec<f32>; 6],
    sets: Vec<BoxSet<f32>>,
    oriented: Vec<Obb<f32>>,
    spheres: Vec<Sphere<f32>>,
    sphere_columns: [Vec<f32>; 4],
    segments: Vec<Segment<f32>>,
    segment_columns: [Vec<f32>; 6],
}

fn columns<V, const K: usize>(all: &[V], of: impl Fn(&V) -> [f32; K]) -> [Vec<f32>; K] {
    let mut columns = [const { Vec::new() }; K];
    for one in all {
        for (column, component) in columns.iter_mut().zip(of(one)) {
            column.push(component);
        }
    }
    columns
}

fn components(a: Vec3<f32>, b: Vec3<f32>) -> [f32; 6] {
    [a.x, a.y, a.z, b.x, b.y, b.z]
}

impl Scene {
    fn new(plan: &VolumePlan) -> Option<Self> {
        let frustum = Frustum::new(Pose::IDENTITY, Mix::shape()).ok()?;
        let mut random = Random::new(&[plan.seed, 3]);
        let bounds = bounds(&frustum)?;
        let most = 0.02 * (bounds[1].z - bounds[0].z);
        let mut single = || {
            let volume = any_box(&mut random, bounds, most);
            Aabb::new(
                Vec3::<f32>::from_f64(volume.min),
                Vec3::<f32>::from_f64(volume.max),
            )
        };
        let boxes: Vec<Aabb<f32>> = (0..plan.timed).map(|_| single()).collect();
        let sphere = |b: &Aabb<f32>| Sphere::new(b.min, b.max.x - b.min.x);
        let spheres: Vec<Sphere<f32>> = boxes.iter().map(sphere).collect();
        // Turned about two axes.
        let turned = |v: Vec3<f32>| {
            let v = Vec3::new(0.8 * v.x - 0.6 * v.y, 0.6 * v.x + 0.8 * v.y, v.z);
            Vec3::new(v.x, 0.8 * v.y - 0.6 * v.z, 0.6 * v.y + 0.8 * v.z)
        };
        let oriented = boxes.iter().map(|b| {
            let v = Obb::from(*b);
            Obb::new(v.center, v.half_axes.map(turned))
        });
        let segments: Vec<Segment<f32>> = Mix::ALL[1].segments(plan.timed, &Pose::IDENTITY);
        let sets = boxes.chunks(VolumeSurvey::PIECE);
        Some(Self {
            culler: Culler::new(&frustum),
            box_columns: columns(&boxes, |b| components(b.min, b.max)),
            sets: sets
                .map(|some| BoxSet::new(some.iter().copied()))
                .collect::<Result<_, _>>()
                .ok()?,
            sphere_columns: columns(&spheres, |s| [s.center.x, s.center.y, s.center.z, s.radius]),
            segment_columns: columns(&segments, |s| components(s.start, s.end)),
            oriented: oriented.collect(),
            boxes,
            spheres,
            segments,
        })
    }

    fn pieces(&self) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let len = self.boxes.len();
        let starts = (0..len).step_by(VolumeSurvey::PIECE);
        starts.map(move |start| start..len.min(start + VolumeSurvey::PIECE))
    }
}

/// Buffers that functions write to.
#[derive(Default)]
struct Buffers {
    masks: ContainmentMasks,
    list: Vec<u32>,
    intervals: SegmentIntervals<f32>,
}

/// A job, the name of a function, and a run of it over all volumes.
type Timed = (&'static str, &'static str, fn(&Scene, &mut Buffers));

/// Results are ignored: all volumes are valid.
const TIMED: [Timed; 13] = [
    ("box", "classify", |scene, _| {
        for volume in &scene.boxes {
            let _ = black_box(scene.culler.classify(*volume));
        }
    }),
    ("box", "classify_exact", |scene, _| {
        for volume in &scene.boxes {
            let _ = black_box(scene.culler.classify_exact(*volume));
        }
    }),
    ("box", "masks of arrays", |scene, to| {
        for range in scene.pieces() {
            let [a, b, c, d, e, f] = scene.box_columns.each_ref().map(|v| &v[range.clone()]);
            let (min, max) = ([a, b, c], [d, e, f]);
            let query = scene.culler.over(BoxArrays { min, max });
            let _ = query.masks(&mut to.masks);
        }
    }),
    ("box", "masks of a set", |scene, to| {
        for set in &scene.sets {
            let _ = scene.culler.over(set).masks(&mut to.masks);
        }
    }),
    ("box", "visible in a set", |scene, to| {
        for set in &scene.sets {
            let _ = scene.culler.over(set).visible(&mut to.list);
        }
    }),
    ("oriented box", "classify", |scene, _| {
        for volume in &scene.oriented {
            let _ = black_box(scene.culler.classify(*volume));
        }
    }),
    ("oriented box", "classify_exact", |scene, _| {
        for volume in &scene.oriented {
            let _ = black_box(scene.culler.classify_exact(*volume));
        }
    }),
    ("sphere", "classify", |scene, _| {
        for volume in &scene.spheres {
            let _ = black_box(scene.culler.classify(*volume));
        }
    }),
    ("sphere", "classify_exact", |scene, _| {
        for volume in &scene.spheres {
            let _ = black_box(scene.culler.classify_exact(*volume));
        }
    }),
    ("sphere", "masks of arrays", |scene, to| {
        for range in scene.pieces() {
            let [a, b, c, radius] = scene.sphere_columns.each_ref().map(|v| &v[range.clone()]);
            let center = [a, b, c];
            let query = scene.culler.over(SphereArrays { center, radius });
            let _ = query.masks(&mut to.masks);
        }
    }),
    ("segment", "clip_segment", |scene, _| {
        for segment in &scene.segments {
            let _ = black_box(scene.culler.frustum().clip_segment(segment));
        }
    }),
    ("segment", "clip_intervals, slice", |scene, to| {
        for piece in scene.segments.chunks(VolumeSurvey::PIECE) {
            let _ = scene.culler.clip_intervals(piece, &mut to.intervals);
        }
    }),
    ("segment", "clip_intervals, arrays", |scene, to| {
        for range in scene.pieces() {
            let [a, b, c, d, e, f] = scene.segment_columns.each_ref().map(|v| &v[range.clone()]);
            let (start, end) = ([a, b, c], [d, e, f]);
            let arrays = SegmentArrays { start, end };
            let _ = scene.culler.clip_intervals(arrays, &mut to.intervals);
        }
    }),
];

fn times(plan: &VolumePlan, on_step: &dyn Fn(u64)) -> Vec<VolumeTime> {
    let Some(scene) = Scene::new(plan) else {
        return Vec::new();
    };
    let mut to = Buffers::default();
    let mut jobs: Vec<Turns> = Vec::new();
    let of = |job: &str| {
        TIMED
            .iter()
            .filter(|timed| timed.0 == job)
            .collect::<Vec<_>>()
    };
    let names = ["box", "oriented box", "sphere", "segment"];
    let fields: Vec<Vec<&Timed>> = names.iter().map(|name| of(name)).collect();
    fields
        .iter()
        .for_each(|field| jobs.push(Turns::new(field.len(), 0)));
    for _ in 0..plan.rounds {
        for (field, turns) in fields.iter().zip(&mut jobs) {
            turns.round(|i| {
                let start = Instant::now();
                (field[i].2)(&scene, &mut to);
                black_box((&to.masks, &to.list, &to.intervals));
                start.elapsed().as_nanos() as f64 / plan.timed.max(1) as f64
            });
        }
        on_step(TIMED_STEP);
    }
    let rows = fields.into_iter().zip(jobs).flat_map(|(field, turns)| {
        let medians = turns.medians().into_iter();
        field
            .into_iter()
            .zip(medians)
            .map(|(timed, timing)| VolumeTime {
                job: timed.0,
                function: timed.1,
                timing,
            })
    });
    rows.collect()
}
