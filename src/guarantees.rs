//! The guarantees, and the evidence for them. This module is a page of documentation; it has no code.
//!
//! # What plain arithmetic does
//!
//! Each cell is one input: in the next cell to the right an end of the segment is one
//! unit in the last place (ulp) farther along x, in the next cell above one ulp farther along z. The
//! model is near the world's origin, where `f64` values are dense, and the camera is some
//! distance away and rotated: nothing unusual. On the left is projection reduction in `f64`, on the
//! right the same with exact decisions, whose lines are where they should be.
//!
//! Segments that end near a face:
//!
//! <div>
#![doc = include_str!("../docs/map-face.svg")]
//! </div>
//!
//! Segments that pass near an edge:
//!
//! <div>
#![doc = include_str!("../docs/map-edge.svg")]
//! </div>
//!
//! Segments near a vertex:
//!
//! <div>
#![doc = include_str!("../docs/map-vertex.svg")]
//! </div>
//!
//! A block is a set of inputs with the same rounded intermediate results. Clipping like this at a
//! corner loses edges that are in view, keeps some that are not, and gives another answer when the
//! ends are swapped. An epsilon would only move the ragged line elsewhere.
//! `frusta samples map face -o map.svg` (or `edge`, `vertex`) makes these pictures.
//!
//! # What is guaranteed
//!
//! The crate's first page lists the guarantees by number, G1 to G8. They hold for *every* finite
//! input in `f32` and `f64`, from subnormal to 1e308. The reference is the pair of closed sets that the
//! given numbers define in exact arithmetic: the segment S, and the frustum F as
//! [`Frustum::new`](crate::Frustum::new) takes it. They do not cover the rounding that produced
//! the input: a frustum from a [`Camera`](crate::Camera) has been rounded once, and the guarantees
//! hold for the rounded one.
//!
//! In exact arithmetic, for each [`Accuracy`](crate::Accuracy):
//!
//! - classes and face sets are the true ones, and so the same in all algorithms; so is the flag
//!   `clipped` of each end;
//! - each coordinate of a `Fast` point is within `8 u` times the segment's largest coordinate, plus the
//!   smallest subnormal, of the exact one, each parameter within `4 u`. So a point may be outside
//!   F by that much. `Nearest` points and parameters are correctly rounded, so a coordinate is off by
//!   at most half an ulp. `Inward` points are in F and within 2 ulp per coordinate; if no representable
//!   point is, the end is the `Nearest` one and its flag `inward` is false;
//! - points, classes, sets and flags do not depend on the order of the segment's ends. Parameters are
//!   measured from the start, so those of the reversed segment are rounded separately;
//! - no result depends on the algorithm, the processor, the number of threads, or the other segments of
//!   a slice.
//!
//! In [`Arithmetic::Plain`](crate::clip::Arithmetic::Plain) the only promise is a finite answer without a panic: the
//! textbook algorithms are there for comparison.
//!
//! # How it is known
//!
//! **By construction.** Two predicates decide everything: the side of a face on which a point is, and
//! the order of two crossings. Each is first evaluated in floating point with a
//! bound on its error; if the value does not exceed the bound, the next stage
//! decides: double-double, then expansions, then integers of any length, which are exact.
//! [`StageCounts`](crate::StageCounts) reports the stages that a segment needed, and a test shows that
//! each is reached. Points are constructed afterwards, by one rule that does not depend on the stage
//! that decided.
//!
//! **By proof.** The error bounds are derived in the files that use them; `proofs/` has those parts
//! of them that the proof assistant Gappa can express, and a check that weaker constants are
//! *not* proved.
//!
//! **By an independent implementation.** [`oracle`](https://docs.rs/frusta/latest/frusta/oracle/) clips with rational numbers and shares no
//! arithmetic with the rest. `frusta verify` compares millions of cases with it, at least half of them
//! within 4 ulp of a vertex, an edge or a face: G1 to G6, in `f64` on 40 families
//! of singular, stiff and extreme cases (module `samples`), in `f32` on the 32 that survive rounding. `frusta report` does so for
//! every algorithm and arithmetic, and measures error against run time.
//!
//! **By symmetry.** Swapped ends, permuted and mirrored axes, scaling by powers of two: the answers
//! must change with the input, to the bit.
//!
//! **By mutation.** `scripts/mutants` changes each sign, threshold and bound of the predicates, one
//! at a time, and expects a test to fail; mutants that change no answer are listed with the reason.
//!
//! **By fuzzing.** Fuzz targets compare all algorithms with the oracle and with each other, and give
//! damaged files to the command's readers; every find is kept as a named test.
//!
//! **By recorded results.** No fused multiply-add is used where it would change a bit; recorded answers
//! are compared in builds with and without AVX2 and FMA, and slices with the same segments one by one
//! at every vector width. Miri runs the core. `unsafe` code is forbidden,
//! except in the feature `bytemuck`.
//!
//! The evidence does *not* cover the compiler, the processor, and the libraries for integers and
//! vector registers. Nor is run time guaranteed: an adversarial input can need integers of 2,000 bits for
//! each sign.
