//! G8 between machines: the bits of a fixed set of answers, recorded.
//!
//! A test compares them on this machine, also in a build that may use AVX2 and fused multiply-add;
//! the program `frusta-digest` does so wherever it runs, as in an emulator (`scripts/targets`).
//!
//! If a family's cases change on purpose, so do the digests: the one of the inputs tells that from
//! a change of the answers.

use crate::check::{ACCURACIES, bits, exact_clippers};
use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SegmentIntervals,
    SixPlanes, VwProjection,
};
use frusta::cull::{BoxSet, VolumeSource};
use frusta::samples::{
    BLOCK, Family, Mix, Placement, Solid, hard_box, hard_sphere, singular_samples,
};
use frusta::{
    Aabb, Camera, Culler, Frustum, Projection, Projector, Real, Segment, Shape, Sphere, Vec3,
};

/// Answers of some kind, and what was recorded of them.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    /// What was asked.
    pub name: &'static str,
    /// What is answered here.
    pub found: Digests,
    /// What was recorded.
    pub recorded: Digests,
}

impl Record {
    /// Whether all bits are those that were recorded.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.found == self.recorded
    }
}

/// A name, how its digests are found, and what was recorded: inputs, exact, plain.
type Entry = (&'static str, fn() -> Digests, [u64; 3]);

/// All records, computed as they are asked for.
pub fn records() -> impl Iterator<Item = Record> {
    let all: [Entry; 5] = [
        (
            "the 78",
            samples,
            [
                0xaf46_bdeb_8d25_abad,
                0x0ee9_8f86_7371_356d,
                0xd094_5406_4122_53ab,
            ],
        ),
        (
            "families",
            families,
            [
                0xd62f_6c6a_867e_afae,
                0x60df_28de_b5e6_d745,
                0x3563_7404_a803_0ca8,
            ],
        ),
        (
            "cameras",
            cameras,
            [
                0x1dc8_9657_0384_9e5d,
                0x021b_b71b_2d08_61bd,
                0xed5e_dd44_3236_d19e,
            ],
        ),
        (
            "mixes",
            mixes,
            [0x34b0_0701_1792_4fa9, Digest::EMPTY.0, Digest::EMPTY.0],
        ),
        (
            "slices, queries, projection",
            many,
            [
                0xb7a5_9df8_7c0d_e891,
                0x4a14_e634_ae3a_af22,
                0x823d_0dfd_0af3_efc3,
            ],
        ),
    ];
    all.into_iter()
        .map(|(name, find, [inputs, exact, plain])| Record {
            name,
            found: find(),
            recorded: Digests {
                inputs: Digest(inputs),
                exact: Digest(exact),
                plain: Digest(plain),
            },
        })
}

/// FNV-1a of 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(pub u64);

impl Digest {
    const EMPTY: Digest = Digest(0xcbf2_9ce4_8422_2325);

    fn add(&mut self, words: impl IntoIterator<Item = u64>) {
        for byte in words.into_iter().flat_map(u64::to_le_bytes) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// Everything that goes in, and everything that comes out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digests {
    /// Frusta, segments, volumes.
    pub inputs: Digest,
    /// Exact answers.
    pub exact: Digest,
    /// Answers of plain arithmetic.
    pub plain: Digest,
}

impl Digests {
    const EMPTY: Digests = Digests {
        inputs: Digest::EMPTY,
        exact: Digest::EMPTY,
        plain: Digest::EMPTY,
    };

    fn case<T: Real>(&mut self, frustum: &Frustum, segment: &Segment<T>) {
        self.inputs.add(frustum_bits(frustum));
        for p in [segment.start, segment.end] {
            self.inputs.add(words(p));
        }
        for accuracy in ACCURACIES {
            for clipper in exact_clippers::<T>(accuracy) {
                let answer = clipper.clip_segment(frustum, segment).expect("finite");
                self.exact.add(bits(&answer));
            }
        }
        for clipper in plain::<T>() {
            let answer = clipper.clip_segment(frustum, segment).expect("finite");
            self.plain.add(bits(&answer));
        }
    }

    fn both(&mut self, frustum: &Frustum, segment: &Segment<f64>) {
        self.case(frustum, segment);
        let [start, end] = [segment.start, segment.end].map(Vec3::from_f64);
        self.case(frustum, &Segment::<f32>::new(start, end));
    }
}

fn words<T: Real>(p: Vec3<T>) -> [u64; 3] {
    p.to_f64().to_array().map(f64::to_bits)
}

fn frustum_bits(frustum: &Frustum) -> Vec<u64> {
    let pose = frustum.pose();
    let points = [pose.origin].into_iter().chain(pose.axes);
    let mut all: Vec<u64> = points.flat_map(words).collect();
    let (near, far) = match *frustum.shape() {
        Shape::Finite { near, far } => (near, (far.z, far.rect)),
        Shape::Infinite {
            near,
            slopes,
            direction,
        } => (near, (direction.sign(), slopes)),
    };
    for (z, rect) in [(near.z, near.rect), far] {
        all.push(z.to_bits());
        all.extend(rect.to_array().map(f64::to_bits));
    }
    all
}

fn plain<T: Real>() -> [Box<dyn SegmentClipper<T>>; 6] {
    [
        Box::new(VwProjection::plain()),
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Textbook)),
        Box::new(LiangBarsky::plain(LiangBarskyVariant::Tuned)),
        Box::new(CyrusBeck::plain()),
        Box::new(CohenSutherland::plain()),
        Box::new(SixPlanes::plain()),
    ]
}

/// The 78 in 48 orientations and rotated, each also longer and shorter.
fn samples() -> Digests {
    let mut digests = Digests::EMPTY;
    let solid = Solid::SYMMETRIC;
    let mut placements = Placement::signed_permutations();
    for q in [[1, 2, 2, 4], [3, -1, 2, 5], [8, 7, -6, 5]] {
        let moved = Placement::rotated(q).moved_to([11.0, -6.0, 3.0].into());
        placements.extend([Placement::rotated(q), moved.scaled(-9)]);
    }
    for placement in placements {
        let frustum = placement.place(&solid).expect("a frustum");
        for sample in singular_samples(&solid) {
            let Segment { start, end } = sample.segment;
            for by in [-0.25, 0.0, 1.5] {
                let more = (end - start) * by;
                let stretched = Segment::new(start - more, end + more);
                digests.both(&frustum, &placement.segment(&stretched));
            }
        }
    }
    digests
}

/// Half a thousand cases of each family.
fn families() -> Digests {
    let mut digests = Digests::EMPTY;
    for &family in Family::ALL {
        for block in 0..8 {
            let scene = family.scene(8, block);
            for index in block * BLOCK..(block + 1) * BLOCK {
                digests.case::<f64>(scene.frustum(), &family.segment(&scene, 8, index));
                if family.has_f32() {
                    digests.case::<f32>(scene.frustum(), &family.segment(&scene, 8, index));
                }
            }
        }
    }
    digests
}

/// Frusta made by transcendental functions and normalised axes.
fn cameras() -> Digests {
    let mut digests = Digests::EMPTY;
    for k in 1..=40 {
        let turn = f64::from(k);
        let camera = Camera {
            eye: [turn, 0.3 * turn, -2.0].into(),
            target: [0.1, 0.7, 0.1 * turn].into(),
            up: [0.0, 1.0, 0.2].into(),
            projection: Projection::Perspective {
                fovy: 0.07 * turn,
                aspect: 16.0 / 9.0,
            },
            near: 0.1,
            far: if k % 3 == 0 { f64::INFINITY } else { 100.0 },
        };
        let frustum = camera.frustum().expect("a frustum");
        for end in 0..8 {
            let x = f64::from(end);
            digests.both(&frustum, &Segment::new([x, 9.0, -x], [-x, -9.0, turn]));
        }
    }
    digests
}

/// The view that the mixes are made for, and segments of each in both scalar types.
fn mixes() -> Digests {
    fn ends<T: Real>(segments: &[Segment<T>]) -> impl Iterator<Item = u64> {
        let points = segments.iter().flat_map(|s| [s.start, s.end]);
        points.flat_map(words)
    }
    let mut digests = Digests::EMPTY;
    let digest = &mut digests.inputs;
    for (_, pose) in Mix::poses() {
        let frustum = Frustum::new(pose, Mix::shape()).expect("a frustum");
        for mix in Mix::ALL {
            digest.add(ends::<f64>(&mix.segments(4096, &pose)));
            digest.add(ends::<f32>(&mix.segments(4096, &pose)));
            digest.add(frustum_bits(&frustum));
        }
    }
    digests
}

/// Slices, intervals, queries over volumes and projections of one type, of hard and of everyday cases: what
/// goes through vector registers where there are any.
fn many_of<T: Real>(digests: &mut Digests, frustum: &Frustum, segments: &[Segment<T>]) {
    digests.inputs.add(frustum_bits(frustum));
    let mut clips = Vec::new();
    for accuracy in ACCURACIES {
        let done = frustum.clip_segments(segments, accuracy, &mut clips);
        done.expect("finite");
        clips.iter().for_each(|clip| digests.exact.add(bits(clip)));
    }
    let plain = VwProjection::plain().clip_segments(frustum, segments, &mut clips);
    plain.expect("finite");
    clips.iter().for_each(|clip| digests.plain.add(bits(clip)));

    let mut intervals = SegmentIntervals::default();
    let culler = Culler::new(frustum);
    let done = culler.clip_intervals(segments, &mut intervals);
    done.expect("finite");
    for (class, t0, t1) in intervals.iter() {
        let [t0, t1] = [t0, t1].map(|t| t.to_f64().to_bits());
        digests.exact.add([class as u64, t0, t1]);
    }

    let screen = Projector::new(frustum).pixels(1920, 1080);
    let points: Vec<_> = segments.iter().flat_map(|s| [s.start, s.end]).collect();
    points.iter().for_each(|p| digests.inputs.add(words(*p)));
    let mut images = Vec::new();
    screen.project_points(&points, &mut images).expect("finite");
    for image in images {
        digests.exact.add(image.map_or([1; 3], words));
    }
}

/// The classes of volumes by a query, by planes and exactly.
fn classes<S: VolumeSource + Copy>(digests: &mut Digests, culler: &Culler, source: S) {
    let mut classes = Vec::new();
    culler.over(source).classes(&mut classes).expect("valid");
    digests.exact.add(classes.iter().map(|class| *class as u64));
    let query = culler.over(source).exact();
    query.classes(&mut classes).expect("valid");
    digests.exact.add(classes.iter().map(|class| *class as u64));
    let mut visible = Vec::new();
    culler.over(source).visible(&mut visible).expect("valid");
    digests.exact.add(visible.into_iter().map(u64::from));
}

fn volumes_of<T: Real>(
    digests: &mut Digests,
    frustum: &Frustum,
    boxes: &[Aabb<T>],
    spheres: &[Sphere<T>],
) {
    for v in boxes {
        digests.inputs.add(words(v.min));
        digests.inputs.add(words(v.max));
    }
    for v in spheres {
        digests.inputs.add(words(v.center));
        digests.inputs.add([v.radius.to_f64().to_bits()]);
    }
    let culler = Culler::new(frustum);
    classes(digests, &culler, boxes);
    let set = BoxSet::new(boxes.iter().copied()).expect("valid");
    classes(digests, &culler, &set);
    classes(digests, &culler, spheres);
}

fn many() -> Digests {
    fn of<T: Real>(digests: &mut Digests) {
        for &family in Family::ALL.iter().filter(|family| family.has_f32()) {
            let scene = family.scene(14, 0);
            let frustum = scene.frustum();
            let segments: Vec<Segment<T>> =
                (0..BLOCK).map(|i| family.segment(&scene, 14, i)).collect();
            many_of(digests, frustum, &segments);
            let boxes: Vec<Aabb<T>> = (0..16).map(|i| hard_box(&scene, 14, i)).collect();
            let spheres: Vec<Sphere<T>> = (0..16).map(|i| hard_sphere(&scene, 14, i)).collect();
            volumes_of(digests, frustum, &boxes, &spheres);
        }
        for (_, pose) in Mix::poses() {
            let frustum = Frustum::new(pose, Mix::shape()).expect("a frustum");
            for mix in Mix::ALL {
                let segments = mix.segments::<T>(1_000, &pose);
                many_of(digests, &frustum, &segments);
                let boxes: Vec<_> = segments
                    .iter()
                    .filter_map(|s| Aabb::around([s.start, s.end]))
                    .collect();
                let spheres: Vec<_> = segments
                    .iter()
                    .map(|s| Sphere::new(s.start, T::from_f64(0.125)))
                    .collect();
                volumes_of(digests, &frustum, &boxes, &spheres);
            }
        }
    }
    let mut digests = Digests::EMPTY;
    of::<f64>(&mut digests);
    of::<f32>(&mut digests);
    digests
}
