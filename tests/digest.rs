//! G8 between machines: the bits of a fixed set of answers, recorded. The same
//! test runs again in a build that may use AVX2 and fused multiply-add.
//!
//! If a family's cases change on purpose, so do the digests: the one of the
//! inputs tells that from a change of the answers.

use frusta::clip::{
    CohenSutherland, CyrusBeck, LiangBarsky, LiangBarskyVariant, SegmentClipper, SixPlanes,
    VwProjection,
};
use frusta::samples::{BLOCK, Family, Mix, Placement, Solid, singular_samples};
use frusta::{Camera, Frustum, Projection, Real, Segment, Shape, Vec3};
use frusta_lab::check::{ACCURACIES, bits, exact_clippers};

/// FNV-1a of 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Digest(u64);

impl Digest {
    const EMPTY: Digest = Digest(0xcbf2_9ce4_8422_2325);

    fn add(&mut self, words: impl IntoIterator<Item = u64>) {
        for byte in words.into_iter().flat_map(u64::to_le_bytes) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// Everything that goes in, and everything that comes out.
#[derive(Debug, PartialEq, Eq)]
struct Digests {
    inputs: Digest,
    exact: Digest,
    plain: Digest,
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
                let answer = clipper.clip_segment(frustum, segment).unwrap();
                self.exact.add(bits(&answer));
            }
        }
        for clipper in plain::<T>() {
            let answer = clipper.clip_segment(frustum, segment).unwrap();
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
        let frustum = placement.place(&solid).unwrap();
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
        let frustum = camera.frustum().unwrap();
        for end in 0..8 {
            let x = f64::from(end);
            digests.both(&frustum, &Segment::new([x, 9.0, -x], [-x, -9.0, turn]));
        }
    }
    digests
}

/// The view that the mixes are made for, and segments of each in both scalar types.
fn mixes() -> Digest {
    fn ends<T: Real>(segments: &[Segment<T>]) -> impl Iterator<Item = u64> {
        let points = segments.iter().flat_map(|s| [s.start, s.end]);
        points.flat_map(words)
    }
    let mut digest = Digest::EMPTY;
    for (_, pose) in Mix::poses() {
        let frustum = Frustum::new(pose, Mix::shape()).unwrap();
        for mix in Mix::ALL {
            digest.add(ends::<f64>(&mix.segments(4096, &pose)));
            digest.add(ends::<f32>(&mix.segments(4096, &pose)));
            digest.add(frustum_bits(&frustum));
        }
    }
    digest
}

#[track_caller]
fn assert_recorded(found: &Digests, inputs: u64, exact: u64, plain: u64) {
    let expected = Digests {
        inputs: Digest(inputs),
        exact: Digest(exact),
        plain: Digest(plain),
    };
    assert!(*found == expected, "{found:#x?}");
}

#[test]
fn g8_the_samples_answers_are_as_recorded() {
    let (inputs, exact) = (0xaf46_bdeb_8d25_abad, 0x0ee9_8f86_7371_356d);
    assert_recorded(&samples(), inputs, exact, 0xd094_5406_4122_53ab);
}

#[test]
fn g8_the_families_answers_are_as_recorded() {
    let (inputs, exact) = (0xd62f_6c6a_867e_afae, 0x60df_28de_b5e6_d745);
    assert_recorded(&families(), inputs, exact, 0x3563_7404_a803_0ca8);
}

#[test]
fn g8_the_cameras_answers_are_as_recorded() {
    let (inputs, exact) = (0x1dc8_9657_0384_9e5d, 0x021b_b71b_2d08_61bd);
    assert_recorded(&cameras(), inputs, exact, 0xed5e_dd44_3236_d19e);
}

/// Times of other days, and counts of instructions, are of these.
#[test]
fn the_mixes_are_as_recorded() {
    let found = mixes();
    assert!(found == Digest(0x34b0_0701_1792_4fa9), "{found:#x?}");
}
