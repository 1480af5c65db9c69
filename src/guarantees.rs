//! What is guaranteed, and how it is known. A page to read; there is no code here.
//!
//! # What plain arithmetic does
//!
//! One cell is one input: the next cell to the right has an end of the segment one
//! unit in the last place (ulp) farther along x, the next one above one ulp farther along z. The
//! model is near the world's origin, where doubles are dense, and the camera stands
//! off and is turned: nothing unusual. Left, projection reduction in `f64`; right, the
//! same with exact decisions, which draws each line where it is.
//!
//! Near a face, of segments that end there:
//!
//! <div>
#![doc = include_str!("../docs/map-face.svg")]
//! </div>
//!
//! Near an edge, of segments that pass by:
//!
//! <div>
#![doc = include_str!("../docs/map-edge.svg")]
//! </div>
//!
//! Near a vertex:
//!
//! <div>
#![doc = include_str!("../docs/map-vertex.svg")]
//! </div>
//!
//! Blocks are inputs that round to the same numbers on the way. A corner that is clipped
//! like this loses edges that are there, keeps some that are not, and says another
//! thing when the ends are swapped. An epsilon would move the ragged line elsewhere.
//! `frusta samples map` makes these pictures.
//!
//! # What is guaranteed
//!
//! The crate's first page lists the guarantees by number, G1 to G8. They hold for *every* finite
//! input in `f32` and `f64`, subnormal or 1e308, against the closed sets that the given
//! numbers define in exact arithmetic: the segment S, and the frustum F as
//! [`Frustum::new`](crate::Frustum::new) takes it. They say nothing of the real numbers that were
//! rounded to make that input: a frustum from a [`Camera`](crate::Camera) has been rounded once, and is
//! exactly what it then is.
//!
//! In exact arithmetic, with each [`Accuracy`](crate::Accuracy):
//!
//! - classes, face sets and flags are the true ones, in all algorithms, and so the same;
//! - `Fast` points are within `8 u` of the segment's largest coordinate, so they may be
//!   outside F by that much; `Nearest` ones by half an ulp; `Inward` ones are not, or say so;
//! - whatever is computed for a segment does not depend on which end comes first, on the
//!   algorithm, on the processor, or on the segments beside it in a slice.
//!
//! In [`Arithmetic::Plain`](crate::Arithmetic::Plain) the only promise is a finite answer without a panic: the
//! textbooks' algorithms are there to be compared with.
//!
//! # How it is known
//!
//! **By construction.** Two predicates decide everything: on which side of a face a point is, and
//! which of two crossings comes first. Each is first evaluated in floating point with a
//! bound on its error; where the value does not exceed the bound the next stage takes
//! over: double-double, then expansions, then integers of any length, which are exact.
//! [`StageCounts`](crate::StageCounts) says which stages a segment needed, and a test shows that each is
//! reached. Points are constructed afterwards, by one rule that does not know how the
//! decision was made.
//!
//! **By proof.** The error bounds are derived in the files that use them; `proofs/` has what the
//! proof assistant Gappa can express of them, and a check that weaker constants are
//! *not* proved.
//!
//! **By an independent truth.** [`oracle`](https://docs.rs/frusta/latest/frusta/oracle/) clips with rational numbers and shares no
//! arithmetic with the rest. `frusta verify` holds millions of cases against it, at least half of them
//! within 4 ulp of a vertex, an edge or a face: G1 to G6, in both scalar types, in 40
//! families of singular, stiff and extreme cases ([`samples`](crate::samples)). `frusta report` does so for
//! every algorithm and arithmetic, and measures error against run time.
//!
//! **By symmetry.** Swapped ends, permuted and mirrored axes, scaling by powers of two: answers
//! must change with the input, to the bit.
//!
//! **By breaking it.** `scripts/mutants` turns each sign, threshold and bound of the predicates, one
//! at a time, and expects a test to fail; those that change no answer are listed with the reason.
//!
//! **By chance.** Fuzz targets compare all algorithms with the oracle and with each other, and feed
//! the command's readers with damaged files; every find is kept as a named test.
//!
//! **On the machine.** No fused multiply-add is used where it would change a bit; recorded answers
//! are compared in builds with and without AVX2 and FMA, slices with single segments at
//! every vector width. Miri runs the core. `unsafe` code is forbidden.
//!
//! What is *not* known: that the compiler, the processor and the libraries for integers and
//! vector registers are right. Time is not guaranteed, either: an input made for the
//! purpose can need integers of 2,000 bits for each sign.
