//! A test of one box as a program uses it: in a loop that lists the indices of the visible boxes.
//!
//! frusta's batches make such a list, so the other libraries' tests are timed with the loop that
//! their users write. The test may be inlined into the loop.

use super::GridBox;
use super::ours::PIECE;
use crate::peer::{Peer, Who};
use std::hint::black_box;

/// A test of one box that can be put into a loop.
pub trait BoxTest: Peer<Case = GridBox> {
    /// The name of the loop around it.
    fn list_name(&self) -> &'static str;

    /// Whether the box may be visible.
    fn sees(&mut self, input: &Self::Input) -> bool;
}

/// The loop around a test; lists of up to 4,096 boxes, in memory that is used again.
pub struct Listed<P> {
    peer: P,
    list: Vec<u32>,
}

impl<P: BoxTest> Listed<P> {
    /// The loop around this test.
    pub fn new(peer: P) -> Self {
        let list = Vec::new();
        Self { peer, list }
    }

    #[inline(never)]
    fn list(&mut self, inputs: &[P::Input]) {
        self.list.clear();
        for (i, input) in inputs.iter().enumerate() {
            if self.peer.sees(input) {
                self.list.push(i as u32);
            }
        }
    }
}

impl<P: BoxTest> Peer for Listed<P> {
    type Case = GridBox;
    type Input = P::Input;
    type Output<'a>
        = bool
    where
        Self: 'a;

    fn who(&self) -> Who {
        Who {
            function: self.peer.list_name(),
            ..self.peer.who()
        }
    }

    fn prepare(&self, block: &GridBox) -> P::Input {
        self.peer.prepare(block)
    }

    fn run(&mut self, input: &P::Input) -> bool {
        self.peer.sees(input)
    }

    fn answer(&mut self, block: &GridBox) -> Option<bool> {
        self.peer.answer(block)
    }

    fn answers(&mut self, blocks: &[GridBox]) -> Vec<Option<bool>> {
        let mut all = Vec::with_capacity(blocks.len());
        for piece in blocks.chunks(PIECE) {
            let inputs: Vec<P::Input> = piece.iter().map(|b| self.peer.prepare(b)).collect();
            self.list(&inputs);
            let start = all.len();
            all.resize(start + piece.len(), Some(false));
            for &i in &self.list {
                all[start + i as usize] = Some(true);
            }
        }
        all
    }

    fn pass(&mut self, inputs: &[P::Input]) {
        for piece in inputs.chunks(PIECE) {
            self.list(piece);
            black_box(&self.list);
        }
    }
}
