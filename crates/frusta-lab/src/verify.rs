//! Every family's cases through an exact clipper, compared with the oracle.
//!
//! For each case and each [`Accuracy`]: the answer is checked against rational
//! arithmetic (G1 to G4), against the answer for the swapped ends (G5) and, if
//! inward, against the clip of itself (G6). Only the G7 distance is sampled.
//! Blocks of cases that share a frustum are dealt to the threads; counts do not
//! depend on the number of threads, and the witness kept is the first by index.
//! A clipper that refuses a valid case or panics is a finding and does not end the run.

use super::CaseLine;
use frusta::clip::{Accuracy, SegmentClip, StageCounts};
use frusta::frustum::Frustum;
use frusta::math::{NonFinite, Real, Segment};
use frusta::oracle::{
    Oracle, OracleClip, Violation, ViolationKind, check_idempotent, check_swapped,
};
use frusta::samples::{BLOCK, Family, Scene};
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// A clipper that claims to be exact.
pub trait Subject: Sync {
    /// Clips in `f64`, and adds the stages that its predicates needed to `counts`, if it
    /// counts them.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    fn clip_f64(
        &self,
        frustum: &Frustum,
        segment: &Segment<f64>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<f64>, NonFinite>;

    /// The same in `f32`.
    ///
    /// # Errors
    /// A coordinate of the segment is infinite or NaN.
    fn clip_f32(
        &self,
        frustum: &Frustum,
        segment: &Segment<f32>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<f32>, NonFinite>;
}

/// The crate's own exact clipper: [`Frustum::clip_segment_counted`].
#[derive(Clone, Copy, Debug, Default)]
pub struct ExactClipper;

impl Subject for ExactClipper {
    fn clip_f64(
        &self,
        frustum: &Frustum,
        segment: &Segment<f64>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<f64>, NonFinite> {
        frustum.clip_segment_counted(segment, accuracy, counts)
    }

    fn clip_f32(
        &self,
        frustum: &Frustum,
        segment: &Segment<f32>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<f32>, NonFinite> {
        frustum.clip_segment_counted(segment, accuracy, counts)
    }
}

/// What to verify, and how much of it.
#[derive(Clone, Debug)]
pub struct Options {
    /// The families, in order.
    pub families: Vec<Family>,
    /// How many cases of each, in each scalar type.
    pub cases: u64,
    /// The seed of all cases.
    pub seed: u64,
    /// How many threads; 0 counts as 1.
    pub threads: usize,
    /// Whether to verify `f32` as well, where a family has it.
    pub with_f32: bool,
}

impl Default for Options {
    /// 1,000 cases of every family, both scalar types, one thread.
    fn default() -> Self {
        Self {
            families: Family::ALL.to_vec(),
            cases: 1_000,
            seed: 1,
            threads: 1,
            with_f32: true,
        }
    }
}

impl Options {
    /// The number of cases in all families and scalar types.
    pub fn total(&self) -> u64 {
        let types = |f: &Family| 1 + u64::from(self.with_f32 && f.has_f32());
        self.cases * self.families.iter().map(types).sum::<u64>()
    }
}

/// The findings in one family in one scalar type.
#[derive(Clone, Debug, PartialEq)]
pub struct FamilyRow {
    /// The family.
    pub family: Family,
    /// `f64` or `f32`.
    pub scalar: &'static str,
    /// How many cases were tried, each with three accuracies.
    pub cases: u64,
    /// In how many cases each kind of violation was found, in the order of
    /// [`ViolationKind::ALL`].
    pub violations: [u64; ViolationKind::ALL.len()],
    /// Cases within 4 ulp of a singular one: [`Oracle::is_near`].
    pub near: u64,
    /// Cases that the floating-point filter did not settle (with `Fast`).
    pub filter_failures: u64,
    /// Cases that needed expansions (with `Fast`).
    pub expansions: u64,
    /// Cases that needed big integers (with `Fast`).
    pub integers: u64,
    /// `Inward` ends that were clipped.
    pub inward_ends: u64,
    /// Of these, the ends where no inward point was found.
    pub not_inward: u64,
    /// G7: by how many ulps an inward end could still move outwards, at most.
    pub room_max: f64,
    /// The sum of these distances over the measured ends.
    pub room_sum: f64,
    /// How many ends were measured for G7: those of every eighth case.
    pub room_ends: u64,
    /// The first case with a violation.
    pub witness: Option<Witness>,
}

impl FamilyRow {
    /// In how many cases this kind of violation was found.
    pub fn count(&self, kind: ViolationKind) -> u64 {
        self.violations[kind as usize]
    }

    /// Whether nothing was found.
    pub fn is_clean(&self) -> bool {
        self.violations.iter().all(|&n| n == 0)
    }

    /// The mean of the G7 distance; 0 if no end was measured.
    pub fn room_mean(&self) -> f64 {
        self.room_sum / self.room_ends.max(1) as f64
    }

    fn new(family: Family, scalar: &'static str) -> Self {
        Self {
            family,
            scalar,
            cases: 0,
            violations: [0; ViolationKind::ALL.len()],
            near: 0,
            filter_failures: 0,
            expansions: 0,
            integers: 0,
            inward_ends: 0,
            not_inward: 0,
            room_max: 0.0,
            room_sum: 0.0,
            room_ends: 0,
            witness: None,
        }
    }

    /// Adds another row's counts, and keeps the earlier witness.
    pub fn merge(&mut self, other: FamilyRow) {
        self.cases += other.cases;
        for (a, b) in self.violations.iter_mut().zip(other.violations) {
            *a += b;
        }
        self.near += other.near;
        self.filter_failures += other.filter_failures;
        self.expansions += other.expansions;
        self.integers += other.integers;
        self.inward_ends += other.inward_ends;
        self.not_inward += other.not_inward;
        self.room_max = self.room_max.max(other.room_max);
        self.room_sum += other.room_sum;
        self.room_ends += other.room_ends;
        let later = |a: &Witness, b: &Witness| a.index > b.index;
        match (&self.witness, other.witness) {
            (Some(a), Some(b)) if later(a, &b) => self.witness = Some(b),
            (None, found) => self.witness = found,
            _ => {}
        }
    }
}

/// A case with a violation, in a form that can be replayed alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// The case's index in its family.
    pub index: u64,
    /// The accuracy.
    pub accuracy: Accuracy,
    /// The violation.
    pub violation: Violation,
    /// Frustum and segment: a [`CaseLine`].
    pub input: String,
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (index, accuracy, violation) = (self.index, self.accuracy, &self.violation);
        write!(f, "case {index}, {accuracy:?}: {violation}; {}", self.input)
    }
}

/// Runs families through a clipper; `on_row` is called with each finished row.
///
/// ```
/// use frusta_lab::{ExactClipper, Options, verify};
/// use frusta::samples::Family;
/// let options = Options { families: vec![Family::Bumps], cases: 64, ..Options::default() };
/// let rows = verify(&ExactClipper, &options, |row| assert!(row.is_clean()));
/// assert_eq!(rows.len(), 2);
/// ```
pub fn verify(
    subject: &dyn Subject,
    options: &Options,
    on_row: impl FnMut(&FamilyRow),
) -> Vec<FamilyRow> {
    verify_watched(subject, options, &|_| {}, on_row)
}

/// As [`verify`]; `on_cases` is called, from every thread, with the number of cases that were done
/// since its last call, at most [`BLOCK`]; in all [`Options::total`].
pub fn verify_watched(
    subject: &dyn Subject,
    options: &Options,
    on_cases: &(dyn Fn(u64) + Sync),
    mut on_row: impl FnMut(&FamilyRow),
) -> Vec<FamilyRow> {
    let mut rows = Vec::new();
    for &family in &options.families {
        let mut add = |row: FamilyRow| {
            on_row(&row);
            rows.push(row);
        };
        add(verify_family::<f64>(subject, options, family, on_cases));
        if options.with_f32 && family.has_f32() {
            add(verify_family::<f32>(subject, options, family, on_cases));
        }
    }
    rows
}

/// A scalar type that a subject clips in.
trait Scalar: Real {
    const NAME: &'static str;

    fn clip(
        subject: &dyn Subject,
        frustum: &Frustum,
        segment: &Segment<Self>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<Self>, NonFinite>;
}

macro_rules! scalar {
    ($t:ident, $clip:ident) => {
        impl Scalar for $t {
            const NAME: &'static str = stringify!($t);

            fn clip(
                subject: &dyn Subject,
                frustum: &Frustum,
                segment: &Segment<Self>,
                accuracy: Accuracy,
                counts: &mut StageCounts,
            ) -> Result<SegmentClip<Self>, NonFinite> {
                subject.$clip(frustum, segment, accuracy, counts)
            }
        }
    };
}

scalar!(f64, clip_f64);
scalar!(f32, clip_f32);

fn verify_family<T: Scalar>(
    subject: &dyn Subject,
    options: &Options,
    family: Family,
    on_cases: &(dyn Fn(u64) + Sync),
) -> FamilyRow {
    let blocks = options.cases.div_ceil(BLOCK);
    let next = AtomicU64::new(0);
    let total = Mutex::new(FamilyRow::new(family, T::NAME));
    let work = || {
        let mut row = FamilyRow::new(family, T::NAME);
        loop {
            let block = next.fetch_add(1, Ordering::Relaxed);
            if block >= blocks {
                break;
            }
            let scene = family.scene(options.seed, block);
            let mut run = Run::<T>::new(subject, &scene, &mut row);
            let cases = block * BLOCK..((block + 1) * BLOCK).min(options.cases);
            for index in cases.clone() {
                let segment = family.segment::<T>(&scene, options.seed, index);
                run.case(&segment, index);
            }
            on_cases(cases.end - cases.start);
        }
        // A thread that panicked added nothing, so the total is whole.
        let mut total = total.lock().unwrap_or_else(|e| e.into_inner());
        total.merge(row);
    };
    std::thread::scope(|scope| {
        for _ in 1..options.threads.max(1) {
            scope.spawn(work);
        }
        work();
    });
    total.into_inner().unwrap_or_else(|e| e.into_inner())
}

/// The cases of one frustum.
struct Run<'a, T> {
    subject: &'a dyn Subject,
    frustum: &'a Frustum,
    oracle: Oracle,
    row: &'a mut FamilyRow,
    scalar: std::marker::PhantomData<T>,
}

/// Violations of a case, each with its accuracy.
type Findings = Vec<(Accuracy, Violation)>;

impl<'a, T: Scalar> Run<'a, T> {
    fn new(subject: &'a dyn Subject, scene: &'a Scene, row: &'a mut FamilyRow) -> Self {
        let frustum = scene.frustum();
        Self {
            subject,
            frustum,
            oracle: Oracle::new(frustum),
            row,
            scalar: std::marker::PhantomData,
        }
    }

    fn clip(
        &self,
        segment: &Segment<T>,
        accuracy: Accuracy,
        counts: &mut StageCounts,
    ) -> Result<SegmentClip<T>, NonFinite> {
        T::clip(self.subject, self.frustum, segment, accuracy, counts)
    }

    fn case(&mut self, segment: &Segment<T>, index: u64) {
        let mut found = Findings::new();
        // A family's cases are finite, so there always is a truth.
        let Ok(truth) = self.oracle.clip(segment) else {
            return;
        };
        for accuracy in [Accuracy::Fast, Accuracy::Nearest, Accuracy::Inward] {
            let attempt = AssertUnwindSafe(|| self.accuracy(&truth, segment, accuracy, index));
            match catch_unwind(attempt) {
                Ok(violations) => found.extend(violations.into_iter().map(|v| (accuracy, v))),
                Err(_) => found.push((accuracy, refused("it panicked".into()))),
            }
        }
        self.row.cases += 1;
        self.row.near += u64::from(self.oracle.is_near(segment));
        for (i, &kind) in ViolationKind::ALL.iter().enumerate() {
            let any = found.iter().any(|(_, v)| v.kind == kind);
            self.row.violations[i] += u64::from(any);
        }
        if let Some((accuracy, violation)) = found.into_iter().next() {
            let earlier = self.row.witness.as_ref().is_some_and(|w| w.index < index);
            if !earlier {
                self.row.witness = Some(Witness {
                    index,
                    accuracy,
                    violation,
                    input: CaseLine::new(self.frustum, segment).to_string(),
                });
            }
        }
    }

    fn accuracy(
        &mut self,
        truth: &OracleClip,
        segment: &Segment<T>,
        accuracy: Accuracy,
        index: u64,
    ) -> Vec<Violation> {
        let mut counts = StageCounts::default();
        let answer = match self.clip(segment, accuracy, &mut counts) {
            Ok(answer) => answer,
            Err(refusal) => return vec![refused(refusal.to_string())],
        };
        if accuracy == Accuracy::Fast {
            self.count_stages(&counts);
        }
        let mut found = self.oracle.check(truth, segment, accuracy, &answer);
        let mut ignored = StageCounts::default();
        match self.clip(&segment.reversed(), accuracy, &mut ignored) {
            Ok(reversed) => found.extend(check_swapped(&answer, &reversed)),
            Err(refusal) => found.push(refused(refusal.to_string())),
        }
        if accuracy == Accuracy::Inward {
            let again = |s: &Segment<T>| self.clip(s, accuracy, &mut ignored);
            found.extend(check_idempotent(&answer, again));
            self.count_inward(&answer, index);
        }
        found
    }

    fn count_stages(&mut self, counts: &StageCounts) {
        self.row.filter_failures += u64::from(counts.filter_failures > 0);
        self.row.expansions += u64::from(counts.expansions > 0);
        self.row.integers += u64::from(counts.integers > 0);
    }

    fn count_inward(&mut self, answer: &SegmentClip<T>, index: u64) {
        let Some(part) = &answer.part else {
            return;
        };
        for end in [&part.entry, &part.exit].into_iter().filter(|e| e.clipped) {
            self.row.inward_ends += 1;
            self.row.not_inward += u64::from(!end.inward);
            if end.inward && index.is_multiple_of(8) {
                let room = self.oracle.room_in_ulps(end.faces, end.point);
                self.row.room_max = self.row.room_max.max(room);
                self.row.room_sum += room;
                self.row.room_ends += 1;
            }
        }
    }
}

fn refused(detail: String) -> Violation {
    Violation {
        kind: ViolationKind::Refused,
        end: None,
        detail,
    }
}
