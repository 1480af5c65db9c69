//! Every family's hard volumes through the culler, compared with the oracle.
//!
//! Boxes in `f64` and `f32`, oriented boxes and spheres, at least half of them within 4 ulp of
//! touching the frustum. Each is classified alone, boxes and spheres also in a batch: both must
//! agree with integer arithmetic, plane by plane; the exact answer must agree with separating axes
//! and distances in integers. Blocks that share a frustum are dealt to the threads; counts do not
//! depend on the number of threads.

use frusta::cull::{Aabb, Containment, Culler, Sphere, Volume, VolumeCounts};
use frusta::math::Real;
use frusta::oracle::Oracle;
use frusta::samples::{BLOCK, Family, Scene, hard_box, hard_obb, hard_sphere};
use std::fmt;
use std::ops::AddAssign;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// A kind of volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VolumeKind {
    /// Axis-aligned boxes in `f64`.
    Box,
    /// Axis-aligned boxes in `f32`.
    BoxF32,
    /// Oriented boxes in `f64`.
    Obb,
    /// Spheres in `f64`.
    Sphere,
    /// Spheres in `f32`.
    SphereF32,
}

impl VolumeKind {
    /// All kinds.
    pub const ALL: [VolumeKind; 5] = [
        VolumeKind::Box,
        VolumeKind::BoxF32,
        VolumeKind::Obb,
        VolumeKind::Sphere,
        VolumeKind::SphereF32,
    ];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        ["box", "box-f32", "obb", "sphere", "sphere-f32"][self as usize]
    }

    /// The kinds that a family has: those in `f32` only where it has `f32`.
    pub fn of_family(family: Family) -> impl Iterator<Item = VolumeKind> + Clone {
        let has = move |kind: &VolumeKind| family.has_f32() || !kind.is_single();
        Self::ALL.into_iter().filter(has)
    }

    const fn is_single(self) -> bool {
        matches!(self, VolumeKind::BoxF32 | VolumeKind::SphereF32)
    }
}

/// The findings on one kind, in one family or in all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VolumeTally {
    /// Number of volumes.
    pub cases: u64,
    /// How many of these are outside, crossing and inside, plane by plane.
    pub classes: [u64; 3],
    /// Classes, of one volume alone, that differ from integer arithmetic's.
    pub wrong: u64,
    /// Those among them that are wrongly outside.
    pub wrongly_outside: u64,
    /// Classes in a batch that differ from integer arithmetic's.
    pub wrong_in_batch: u64,
    /// Wrong answers of the exact test.
    pub wrong_exact: u64,
    /// The stages that the answers needed.
    pub counts: VolumeCounts,
}

impl VolumeTally {
    /// Whether nothing is wrong.
    pub fn is_clean(&self) -> bool {
        self.wrong + self.wrong_in_batch + self.wrong_exact == 0
    }
}

impl AddAssign for VolumeTally {
    fn add_assign(&mut self, other: Self) {
        self.cases += other.cases;
        for (sum, n) in self.classes.iter_mut().zip(other.classes) {
            *sum += n;
        }
        self.wrong += other.wrong;
        self.wrongly_outside += other.wrongly_outside;
        self.wrong_in_batch += other.wrong_in_batch;
        self.wrong_exact += other.wrong_exact;
        self.counts += other.counts;
    }
}

/// A family's tally of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VolumeRow {
    /// The family.
    pub family: Family,
    /// The kind.
    pub kind: VolumeKind,
    /// The results.
    pub tally: VolumeTally,
}

impl VolumeRow {
    /// The columns' names.
    pub fn heading() -> String {
        format!(
            "{:<18} {:<10} {:>8} {:>6} {:>7} {:>6} {:>6} {:>9} {:>5} {:>6} {:>6} {:>5} {:>7}",
            "family",
            "",
            "cases",
            "wrong",
            "outside",
            "batch",
            "exact",
            "out%",
            "in%",
            "false%",
            "filt.%",
            "exp.%",
            "int.%"
        )
    }
}

impl fmt::Display for VolumeRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:<18} {:<10} {}",
            self.family.name(),
            self.kind.name(),
            self.tally
        )
    }
}

impl fmt::Display for VolumeTally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |n: u64| 100.0 * n as f64 / self.cases.max(1) as f64;
        let c = &self.counts;
        write!(
            f,
            "{:>8} {:>6} {:>7} {:>6} {:>6} {:>9.1} {:>5.1} {:>6.2} {:>6.1} {:>5.1} {:>7.1}",
            self.cases,
            self.wrong,
            self.wrongly_outside,
            self.wrong_in_batch,
            self.wrong_exact,
            percent(self.classes[0]),
            percent(self.classes[2]),
            percent(c.false_accepts),
            percent(c.filter_failures),
            percent(c.expansions),
            percent(c.integers),
        )
    }
}

/// Verifies this many volumes of each kind in a family; `on_cases` is called, from every thread,
/// with the number of volumes that were done since its last call.
///
/// ```
/// use frusta_lab::{VolumeKind, verify_volumes};
/// use frusta::samples::Family;
/// let rows = verify_volumes(Family::OffAxis, 200, 1, 1, &|_| {});
/// assert_eq!(rows.len(), VolumeKind::ALL.len());
/// assert!(rows.iter().all(|row| row.tally.is_clean() && row.tally.cases == 200));
/// ```
pub fn verify_volumes(
    family: Family,
    cases: u64,
    seed: u64,
    threads: usize,
    on_cases: &(dyn Fn(u64) + Sync),
) -> Vec<VolumeRow> {
    let kinds = VolumeKind::of_family(family);
    let next = AtomicU64::new(0);
    let all = kinds.clone().map(|kind| VolumeRow {
        family,
        kind,
        tally: VolumeTally::default(),
    });
    let rows = Mutex::new(all.collect::<Vec<_>>());
    let work = || {
        loop {
            let block = next.fetch_add(1, Ordering::Relaxed);
            if block >= cases.div_ceil(BLOCK) {
                break;
            }
            let scene = family.scene(seed, block);
            let indices = block * BLOCK..((block + 1) * BLOCK).min(cases);
            let bench = Bench::new(&scene, seed);
            for (i, kind) in kinds.clone().enumerate() {
                let tally = bench.tally(kind, indices.clone());
                on_cases(tally.cases);
                let mut rows = rows.lock().unwrap_or_else(|e| e.into_inner());
                rows[i].tally += tally;
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.max(1) {
            scope.spawn(work);
        }
        work();
    });
    rows.into_inner().unwrap_or_else(|e| e.into_inner())
}

/// A scene, its culler and its oracle.
struct Bench<'a> {
    scene: &'a Scene,
    seed: u64,
    culler: Culler,
    oracle: Oracle,
}

impl<'a> Bench<'a> {
    fn new(scene: &'a Scene, seed: u64) -> Self {
        Self {
            scene,
            seed,
            culler: Culler::new(scene.frustum()),
            oracle: Oracle::new(scene.frustum()),
        }
    }

    fn tally(&self, kind: VolumeKind, indices: std::ops::Range<u64>) -> VolumeTally {
        let (scene, seed) = (self.scene, self.seed);
        match kind {
            VolumeKind::Box => self.boxes(indices.map(|n| hard_box::<f64>(scene, seed, n))),
            VolumeKind::BoxF32 => self.boxes(indices.map(|n| hard_box::<f32>(scene, seed, n))),
            VolumeKind::Obb => {
                let mut tally = VolumeTally::default();
                for n in indices {
                    self.alone(hard_obb::<f64>(scene, seed, n).into(), &mut tally);
                }
                tally
            }
            VolumeKind::Sphere => self.spheres(indices.map(|n| hard_sphere::<f64>(scene, seed, n))),
            VolumeKind::SphereF32 => {
                self.spheres(indices.map(|n| hard_sphere::<f32>(scene, seed, n)))
            }
        }
    }

    /// Compares the answer for one volume with the truth, plane by plane, and returns the truth.
    fn alone(&self, volume: Volume, tally: &mut VolumeTally) -> Containment {
        let truth = self.oracle.classify(&volume);
        let found = self.culler.classify_counted(volume, &mut tally.counts);
        tally.cases += 1;
        tally.classes[truth as usize] += 1;
        tally.wrong += u64::from(found != Ok(truth));
        let is_outside = found == Ok(Containment::Outside);
        tally.wrongly_outside += u64::from(is_outside && truth != Containment::Outside);
        self.exactly(volume, truth, tally);
        truth
    }

    /// Compares the exact test's answer, given the class by planes.
    fn exactly(&self, volume: Volume, by_planes: Containment, tally: &mut VolumeTally) {
        let truth = match by_planes {
            Containment::Crossing if !self.oracle.intersects(&volume) => Containment::Outside,
            class => class,
        };
        let mut counts = VolumeCounts::default();
        let found = self.culler.classify_exact_counted(volume, &mut counts);
        tally.wrong_exact += u64::from(found != Ok(truth));
        tally.counts.exact_tests += counts.exact_tests;
        tally.counts.false_accepts += counts.false_accepts;
    }

    fn boxes<T: Real>(&self, boxes: impl Iterator<Item = Aabb<T>>) -> VolumeTally {
        let (boxes, mut classes) = (boxes.collect::<Vec<_>>(), Vec::new());
        let done = self.culler.over(&boxes).classes(&mut classes);
        self.together(&boxes, &classes, done.is_ok())
    }

    fn spheres<T: Real>(&self, spheres: impl Iterator<Item = Sphere<T>>) -> VolumeTally {
        let (spheres, mut classes) = (spheres.collect::<Vec<_>>(), Vec::new());
        let done = self.culler.over(&spheres).classes(&mut classes);
        self.together(&spheres, &classes, done.is_ok())
    }

    /// Compares each volume alone, and its class of a query over all.
    fn together<V: Copy + Into<Volume>>(
        &self,
        volumes: &[V],
        classes: &[Containment],
        is_done: bool,
    ) -> VolumeTally {
        let mut tally = VolumeTally::default();
        for (i, &volume) in volumes.iter().enumerate() {
            let truth = self.alone(volume.into(), &mut tally);
            let class = classes.get(i).filter(|_| is_done);
            tally.wrong_in_batch += u64::from(class != Some(&truth));
        }
        tally
    }
}
