//! The interface of a library that takes part.
//!
//! Everything that a program would prepare once (planes, matrices, its own types) is not timed.
//! Every library is called the same way, for one case at a time, in a call that is not inlined into
//! the loop; one that works on slices or makes lists has its own [`Peer::pass`] and
//! [`Peer::answers`].

use std::hint::black_box;
use std::time::Instant;

/// A library and how it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Who {
    /// The crate, as its registry names it.
    pub library: &'static str,
    /// The function that is called.
    pub function: &'static str,
    /// The scalar type in which it works: `f32` or `f64`.
    pub scalar: &'static str,
    /// What a reader must know about this use; empty if nothing.
    pub note: &'static str,
}

/// A question whose true answer can be computed.
pub trait Case: Clone + Send + Sync {
    /// The answer.
    type Answer;
}

/// A library doing a job.
pub trait Peer {
    /// The question.
    type Case: Case;
    /// The question in the library's own types.
    type Input;
    /// The answer in the library's own types.
    type Output<'a>
    where
        Self: 'a;

    /// The library and how it is used.
    fn who(&self) -> Who;

    /// Turns a question into the library's own types; not timed.
    fn prepare(&self, case: &Self::Case) -> Self::Input;

    /// The job; this is what is timed.
    fn run(&mut self, input: &Self::Input) -> Self::Output<'_>;

    /// The job's answer; not timed.
    fn answer(&mut self, case: &Self::Case) -> <Self::Case as Case>::Answer;

    /// The answers to many cases; libraries that work on slices are called with slices.
    fn answers(&mut self, cases: &[Self::Case]) -> Vec<<Self::Case as Case>::Answer> {
        cases.iter().map(|case| self.answer(case)).collect()
    }

    /// The job on all inputs.
    fn pass(&mut self, inputs: &[Self::Input]) {
        for input in inputs {
            let _ = black_box(&call(self, input));
        }
    }
}

/// A call like any other: whether the compiler would inline a function into the
/// loop that times it says nothing about the function.
#[inline(never)]
fn call<'a, P: Peer + ?Sized>(peer: &'a mut P, input: &P::Input) -> P::Output<'a> {
    peer.run(input)
}

/// Something that can be timed.
pub trait Timed {
    /// The library and how it is used.
    fn who(&self) -> Who;

    /// Does the job once for each loaded case.
    fn pass(&mut self);

    /// How many cases are loaded.
    fn loaded(&self) -> usize;

    /// Nanoseconds a case in one pass. Another pass precedes it: the contestant before has swept
    /// these cases out of the caches, and memory is not compared.
    fn time(&mut self) -> f64 {
        self.pass();
        let start = Instant::now();
        self.pass();
        start.elapsed().as_nanos().max(1) as f64 / self.loaded().max(1) as f64
    }
}

/// Something that answers questions of one kind and can be timed on them.
pub trait Contestant<C: Case>: Timed {
    /// Its answer to one case.
    fn ask(&mut self, case: &C) -> C::Answer;

    /// Its answers to many, in their order.
    fn ask_all(&mut self, cases: &[C]) -> Vec<C::Answer>;

    /// Prepares the cases that passes go over.
    fn load(&mut self, cases: &[C]);
}

/// A peer with its prepared inputs.
struct Loaded<P: Peer> {
    peer: P,
    inputs: Vec<P::Input>,
}

/// Enters a peer in a contest.
pub fn enter<'a, P: Peer + 'a>(peer: P) -> Box<dyn Contestant<P::Case> + 'a> {
    let inputs = Vec::new();
    Box::new(Loaded { peer, inputs })
}

impl<P: Peer> Timed for Loaded<P> {
    fn who(&self) -> Who {
        self.peer.who()
    }

    fn pass(&mut self) {
        self.peer.pass(&self.inputs);
    }

    fn loaded(&self) -> usize {
        self.inputs.len()
    }
}

impl<P: Peer> Contestant<P::Case> for Loaded<P> {
    fn ask(&mut self, case: &P::Case) -> <P::Case as Case>::Answer {
        self.peer.answer(case)
    }

    fn ask_all(&mut self, cases: &[P::Case]) -> Vec<<P::Case as Case>::Answer> {
        self.peer.answers(cases)
    }

    fn load(&mut self, cases: &[P::Case]) {
        self.inputs = cases.iter().map(|case| self.peer.prepare(case)).collect();
    }
}
