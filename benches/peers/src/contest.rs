//! The jobs, their inputs, and who takes part.

mod inputs;

use inputs::Source;
pub use inputs::{boxes, quads};

use crate::boxes::{
    Batch, BevyLoop, Collision, GridBox, Listed, OursBatch, OursBox, OursPoint, PackedSpatialIndex,
    REFERENCE_BOX, REFERENCE_BOXES, REFERENCE_SLICE, TreeCuller, Truth,
};
use crate::peer::{Case, Contestant, Timed, enter};
use crate::quads::{PlaneSplit, Quad};
use crate::scene::{Block, Camera};
use crate::segments::{
    Attributed, CohenSutherland2, ParryBox32, ParryBox64, ParryCall, Prepared, REFERENCE,
    REFERENCE_SLICES, Slice, Transformed, contenders, cube_matrix,
};
use crate::tally::{Judge, SegmentJudge, Tally, count};
use frusta::{Frustum, Segment};
use frusta_lab::mixes::{self, Mix};
use frusta_lab::turns::{Spread, Turns};

/// Contestants for one kind of case.
pub type Field<C> = Vec<Box<dyn Contestant<C>>>;

/// How much is judged and timed.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// The seed of random input.
    pub seed: u64,
    /// Cases of a lattice or of uniform input that are judged.
    pub lattice: usize,
    /// Cases of a mix that are judged.
    pub mix: usize,
    /// Cases that are timed.
    pub timed: usize,
    /// Rounds that are timed.
    pub rounds: usize,
}

const _: () = assert!(
    Effort::FULL.timed >= 262_144,
    "branch predictors learn small sets by heart"
);

impl Effort {
    /// For figures.
    pub const FULL: Self = Self {
        seed: 1,
        lattice: 2_000_000,
        mix: 100_000,
        timed: mixes::COUNT,
        rounds: 21,
    };

    /// A trial run: its times flatter branches, since branch predictors learn the few cases.
    pub const QUICK: Self = Self {
        seed: 1,
        lattice: 20_000,
        mix: 4_000,
        timed: 16_384,
        rounds: 3,
    };

    fn cases(&self, of_mix: bool) -> usize {
        if of_mix { self.mix } else { self.lattice }
    }
}

/// What segments are clipped by.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    /// A box, an orthographic frustum.
    Box(Block),
    /// The window of a box, for segments in one plane across the view.
    Window(Block),
    /// A perspective frustum.
    Frustum(Camera),
}

/// The number of references that times are compared with.
pub const REFERENCES: usize = 5;

/// The times of one contestant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Time {
    /// Nanoseconds a case, the median over rounds.
    pub nanoseconds: f64,
    /// As multiples of each reference's time in the same round.
    pub ratios: [Option<Spread>; REFERENCES],
}

/// What one contestant did in one contest.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The contestant.
    pub who: crate::peer::Who,
    /// Its wrong answers; `None` if it was only timed.
    pub tally: Option<Tally>,
    /// Its times.
    pub time: Time,
}

/// A contest that can be run.
pub trait Contest {
    /// The job's name.
    fn job(&self) -> &'static str;

    /// The input's name.
    fn input(&self) -> &str;

    /// Whether frusta cannot do this job yet.
    fn is_without_ours(&self) -> bool {
        false
    }

    /// The number of steps that [`Contest::run`] reports.
    fn steps(&self, effort: &Effort) -> u64;

    /// The wrong answers of all; `None` for those that are only timed.
    fn tallies(&self, effort: &Effort, step: &(dyn Fn(u64) + Sync)) -> Vec<Option<Tally>>;

    /// All contestants, loaded with the cases that are timed.
    fn loaded(&self, effort: &Effort) -> Vec<Box<dyn Timed>>;

    /// Counts and times.
    fn run(&self, effort: &Effort, step: &(dyn Fn(u64) + Sync)) -> Vec<Outcome> {
        let tallies = self.tallies(effort, step);
        outcomes(self.loaded(effort), tallies, effort, step)
    }
}

/// A segment job on an input.
#[derive(Clone, Debug)]
pub struct Segments {
    job: &'static str,
    input: String,
    place: Place,
    source: Source,
}

impl Segments {
    /// The frustum, exactly.
    pub fn frustum(&self) -> Frustum {
        match &self.place {
            Place::Box(block) | Place::Window(block) => block.frustum(),
            Place::Frustum(camera) => camera.frustum(),
        }
    }

    /// The libraries in `f64`; the reference is the first.
    pub fn in_f64(&self) -> Field<Segment<f64>> {
        let mut field = contenders(&self.frustum());
        let parry = |block, call| enter(ParryBox64::new(block, call));
        match &self.place {
            Place::Box(block) => {
                field.push(parry(block, ParryCall::ClipSegment));
                field.push(parry(block, ParryCall::LineClamped));
            }
            Place::Window(block) => field.push(enter(CohenSutherland2::new(block))),
            Place::Frustum(camera) if camera.pose.is_identity() => {
                field.push(parry(&camera.bounds(), ParryCall::BoundingBox));
            }
            Place::Frustum(_) => {}
        }
        field
    }

    /// The libraries in `f32`; the reference is the first, if there are any.
    pub fn in_f32(&self) -> Field<Segment<f32>> {
        let mut field = contenders(&self.frustum());
        let parry = |block, call| enter(ParryBox32::new(block, call));
        match &self.place {
            Place::Box(block) => {
                field.push(parry(block, ParryCall::ClipSegment));
                field.push(parry(block, ParryCall::LineClamped));
                if *block == Block::CUBE {
                    field.push(enter(Prepared::new(cube_matrix())));
                }
            }
            Place::Window(_) => field.clear(),
            Place::Frustum(camera) => {
                let matrix = camera.clip_from_world_f32();
                field.push(enter(Prepared::new(matrix)));
                field.push(enter(Transformed::new(matrix)));
                field.push(enter(Slice::new(matrix)));
                field.push(enter(Attributed::new(matrix)));
                if camera.pose.is_identity() {
                    field.push(parry(&camera.bounds(), ParryCall::BoundingBox));
                }
            }
        }
        field
    }

    fn counted(&self, effort: &Effort) -> usize {
        effort.cases(self.source.is_mix())
    }

    /// Decides the truth.
    pub fn judge(&self) -> SegmentJudge {
        SegmentJudge::new(&self.frustum())
    }
}

/// Wrong answers of a field; `None` for those that are only timed.
fn tallies<C: Case, J: Judge<C>>(
    judge: &J,
    cases: &[C],
    field: impl Fn() -> Field<C> + Sync,
    step: &(dyn Fn(u64) + Sync),
) -> Vec<Option<Tally>> {
    let is_counted = |who: crate::peer::Who| !who.note.contains("times only");
    let all = count(judge, cases, &field, |n| step(n as u64));
    let counted = field().into_iter().map(|c| is_counted(c.who()));
    all.into_iter()
        .zip(counted)
        .map(|(tally, counted)| counted.then_some(tally))
        .collect()
}

fn load<C: Case + 'static>(mut field: Field<C>, cases: &[C]) -> Vec<Box<dyn Timed>> {
    field.iter_mut().for_each(|c| c.load(cases));
    field.into_iter().map(|c| c as Box<dyn Timed>).collect()
}

/// The references' indices: exact-class V/W in `f64` and in `f32`, then both over slices. For
/// boxes: `Culler::classify`, the list of a set, and the list of a plain slice, all in `f32`.
fn references(all: &[Box<dyn Timed>]) -> [Option<usize>; REFERENCES] {
    [
        [(REFERENCE, "f64"), (REFERENCE_BOX, "f32")],
        [(REFERENCE, "f32"), (REFERENCE, "f32")],
        [(REFERENCE_SLICES, "f64"), (REFERENCE_BOXES, "f32")],
        [(REFERENCE_SLICES, "f32"), (REFERENCE_SLICES, "f32")],
        [(REFERENCE_SLICE, "f32"), (REFERENCE_SLICE, "f32")],
    ]
    .map(|references| {
        all.iter().position(|c| {
            let who = c.who();
            references.contains(&(who.function, who.scalar))
        })
    })
}

fn outcomes(
    mut all: Vec<Box<dyn Timed>>,
    tallies: Vec<Option<Tally>>,
    effort: &Effort,
    step: &(dyn Fn(u64) + Sync),
) -> Vec<Outcome> {
    let references = references(&all);
    let mut turns = Turns::new(all.len());
    turns.take(effort.rounds, |i| all[i].time(), || step(0));
    let time = |i: usize| Time {
        nanoseconds: turns.nanoseconds(i),
        ratios: references.map(|reference| Some(turns.ratios(i, reference?))),
    };
    let who = all.iter().map(|c| c.who()).enumerate();
    who.zip(tallies)
        .map(|((i, who), tally)| Outcome {
            who,
            tally,
            time: time(i),
        })
        .collect()
}

impl Contest for Segments {
    fn job(&self) -> &'static str {
        self.job
    }

    fn input(&self) -> &str {
        &self.input
    }

    fn steps(&self, effort: &Effort) -> u64 {
        let scalars = if matches!(self.place, Place::Window(_)) {
            1
        } else {
            2
        };
        scalars * self.counted(effort) as u64
    }

    fn tallies(&self, effort: &Effort, step: &(dyn Fn(u64) + Sync)) -> Vec<Option<Tally>> {
        let (judge, n) = (self.judge(), self.counted(effort));
        let cases = self.source.segments::<f64>(effort.seed, n);
        let mut all = tallies(&judge, &cases, || self.in_f64(), step);
        if !self.in_f32().is_empty() {
            let cases = self.source.segments::<f32>(effort.seed, n);
            all.extend(tallies(&judge, &cases, || self.in_f32(), step));
        }
        all
    }

    fn loaded(&self, effort: &Effort) -> Vec<Box<dyn Timed>> {
        let in_f64 = self.source.segments::<f64>(effort.seed, effort.timed);
        let in_f32 = self.source.segments::<f32>(effort.seed, effort.timed);
        let mut all = load(self.in_f64(), &in_f64);
        all.extend(load(self.in_f32(), &in_f32));
        all
    }
}

/// Boxes or points before a camera.
#[derive(Clone, Debug)]
pub struct Boxes {
    job: &'static str,
    input: &'static str,
    camera: Camera,
    make: fn(&Camera, u64, usize) -> Vec<GridBox>,
}

impl Boxes {
    /// Who takes part.
    pub fn field(&self) -> Field<GridBox> {
        let camera = &self.camera;
        let mut field: Field<GridBox> = vec![
            enter(PackedSpatialIndex::new(camera)),
            enter(TreeCuller::new(camera, false)),
            enter(TreeCuller::new(camera, true)),
            enter(BevyLoop::new(camera)),
        ];
        field.extend(Collision::new(camera).map(enter));
        let frustum = &camera.frustum();
        if self.job == "cull-point" {
            field.push(enter(OursPoint::new(frustum)));
            return field;
        }
        field.extend(lists(camera));
        for exact in [false, true] {
            field.push(enter(OursBox::new(frustum, exact)));
            field.push(enter(Listed::new(OursBox::new(frustum, exact))));
        }
        for batch in [
            Batch::Masks,
            Batch::List,
            Batch::ListOfBoxes,
            Batch::MasksOfSet,
            Batch::ListOfSet,
        ] {
            field.push(Box::new(OursBatch::new(frustum, batch)));
        }
        field
    }

    /// Who looks.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    fn truth(&self) -> Truth {
        Truth::new(&self.camera).expect("the camera's corners are on the grid")
    }

    fn counted(&self, effort: &Effort) -> usize {
        effort.cases(self.input != "half-lattice")
    }
}

/// The other libraries' tests of boxes in a loop that lists what is visible.
fn lists(camera: &Camera) -> Field<GridBox> {
    let mut field: Field<GridBox> = vec![
        enter(Listed::new(PackedSpatialIndex::new(camera))),
        enter(Listed::new(TreeCuller::new(camera, false))),
        enter(Listed::new(TreeCuller::new(camera, true))),
        enter(Listed::new(BevyLoop::new(camera))),
    ];
    field.extend(Collision::new(camera).map(|peer| enter(Listed::new(peer))));
    field
}

impl Contest for Boxes {
    fn job(&self) -> &'static str {
        self.job
    }

    fn input(&self) -> &str {
        self.input
    }

    fn steps(&self, effort: &Effort) -> u64 {
        self.counted(effort) as u64
    }

    fn tallies(&self, effort: &Effort, step: &(dyn Fn(u64) + Sync)) -> Vec<Option<Tally>> {
        let cases = (self.make)(&self.camera, effort.seed, self.counted(effort));
        tallies(&self.truth(), &cases, || self.field(), step)
    }

    fn loaded(&self, effort: &Effort) -> Vec<Box<dyn Timed>> {
        load(
            self.field(),
            &(self.make)(&self.camera, effort.seed, effort.timed),
        )
    }
}

/// Axis-parallel quads by the cube.
#[derive(Clone, Copy, Debug)]
pub struct Quads;

impl Quads {
    /// Who takes part.
    pub fn field(&self) -> Field<Quad> {
        vec![enter(PlaneSplit::new(&Block::CUBE))]
    }
}

impl Contest for Quads {
    fn job(&self) -> &'static str {
        "quad-box"
    }

    fn input(&self) -> &str {
        "half-lattice"
    }

    fn is_without_ours(&self) -> bool {
        true
    }

    fn steps(&self, effort: &Effort) -> u64 {
        effort.mix as u64
    }

    fn tallies(&self, effort: &Effort, step: &(dyn Fn(u64) + Sync)) -> Vec<Option<Tally>> {
        let cases = quads(effort.seed, effort.mix);
        tallies(&Block::CUBE, &cases, || self.field(), step)
    }

    fn loaded(&self, effort: &Effort) -> Vec<Box<dyn Timed>> {
        load(self.field(), &quads(effort.seed, effort.timed))
    }
}

/// The segment contests.
pub fn segments() -> Vec<Segments> {
    let mut all = Vec::new();
    let mut add = |job, input: String, place, source| {
        all.push(Segments {
            job,
            input,
            place,
            source,
        });
    };
    let cube = Place::Box(Block::CUBE);
    let around = Source::AROUND_CUBE;
    add("segment-box", "half-lattice".into(), cube, around);
    add("segment-box", "uniform".into(), cube, Source::Uniform);
    let identity = frusta::Pose::IDENTITY;
    let block = Block::of_mixes();
    for mix in Mix::ALL {
        let source = Source::Mix(mix, identity, None);
        add("segment-box", mix.name().into(), Place::Box(block), source);
    }
    let window = Place::Window(Block::CUBE);
    let flat = Source::AROUND_WINDOW;
    add("segment-window", "half-lattice".into(), window, flat);
    for mix in Mix::ALL {
        // In one plane across the view, in the middle of the box.
        let source = Source::Mix(mix, identity, Some(-50.0));
        let place = Place::Window(block);
        add("segment-window", mix.name().into(), place, source);
    }
    let lattice = Place::Frustum(Camera::LATTICE);
    let around = Source::AROUND_FRUSTUM;
    add("segment-frustum", "half-lattice".into(), lattice, around);
    for (name, pose) in Mix::poses() {
        let place = Place::Frustum(Camera::of_mixes(pose));
        for mix in Mix::ALL {
            let input = match pose.is_identity() {
                true => mix.name().to_owned(),
                false => format!("{}, {name}", mix.name()),
            };
            add(
                "segment-frustum",
                input,
                place,
                Source::Mix(mix, pose, None),
            );
        }
    }
    all
}

/// The box and point contests.
pub fn cullings() -> Vec<Boxes> {
    let contest = |job, input, camera, make| Boxes {
        job,
        input,
        camera,
        make,
    };
    vec![
        contest("cull-point", "half-lattice", Camera::LATTICE, boxes::points),
        contest("cull-box", "half-lattice", Camera::LATTICE, boxes::lattice),
        contest("cull-box", "small", Camera::WIDE, boxes::small),
        contest("cull-box", "large", Camera::WIDE, boxes::large),
        contest("cull-box", "small, turned", Camera::TURNED, boxes::small),
        contest("cull-box", "large, turned", Camera::TURNED, boxes::large),
    ]
}

/// All contests, in the order of the table.
pub fn all() -> Vec<Box<dyn Contest>> {
    let mut all: Vec<Box<dyn Contest>> = Vec::new();
    all.extend(
        segments()
            .into_iter()
            .map(|c| Box::new(c) as Box<dyn Contest>),
    );
    all.push(Box::new(Quads));
    all.extend(
        cullings()
            .into_iter()
            .map(|c| Box::new(c) as Box<dyn Contest>),
    );
    all
}
