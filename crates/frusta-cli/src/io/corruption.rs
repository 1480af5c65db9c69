//! Corrupted files, for tests of readers.
//!
//! A reader gets tens of thousands of variants of good files: bytes and digits
//! changed, lines and words deleted, repeated and inserted. Each must be read, or refused in
//! one short line that names the file; and there are no more segments than bytes.

use super::Input;
use crate::Failure;
use frusta::Segment;

/// What is inserted at a random place.
const PIECES: [&[u8]; 28] = [
    b"nan",
    b"-inf",
    b"1e999",
    b"1e308",
    b"-1e-400",
    b"0x1p1023",
    b"0x",
    b"1_000",
    b".5",
    b"5.",
    b"+1",
    b"-1",
    b" 0 ",
    b"255",
    b"4294967295",
    b"4294967296",
    b"18446744073709551615",
    b"99999999999999999999999999",
    b"\r",
    b"\n",
    b"\\\n",
    b"\0",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"#",
    b"\"",
    b",",
    b"[[[[{",
];

/// The greatest length of a message, in bytes.
const LONGEST_MESSAGE: usize = 400;

/// A pseudorandom sequence of corruptions, the same in each run.
pub(crate) struct Corruption(u64);

impl Corruption {
    pub(crate) fn new() -> Self {
        Self(88_172_645_463_325_252)
    }

    /// A number from 0 to below `most`.
    fn below(&mut self, most: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) as usize % most.max(1)
    }

    /// A variant of a file.
    pub(crate) fn of(&mut self, whole: &[u8]) -> Vec<u8> {
        let mut bytes = whole.to_vec();
        for _ in 0..=self.below(2) {
            self.change(&mut bytes);
        }
        bytes
    }

    fn change(&mut self, bytes: &mut Vec<u8>) {
        let at = self.below(bytes.len());
        let is_digit = |b: &u8| b.is_ascii_digit();
        match self.below(16) {
            // Digits for digits keep the grammar and change the sense.
            0..=7 => {
                if let Some(i) = bytes[at..].iter().position(is_digit) {
                    bytes[at + i] = b"0123456789-."[self.below(12)];
                }
            }
            8 => bytes.splice(at..at, *b" ").for_each(drop),
            9 if !bytes.is_empty() => bytes[at] = self.below(256) as u8,
            10 => bytes.truncate(at),
            11 => {
                let piece = PIECES[self.below(PIECES.len())];
                bytes.splice(at..at, piece.iter().copied());
            }
            12 => {
                let (long, letter) = (self.below(6000), b"9a [/"[self.below(5)]);
                bytes.splice(at..at, std::iter::repeat_n(letter, long));
            }
            13 => {
                let end = (at + 1 + self.below(9)).min(bytes.len());
                bytes.drain(at..end);
            }
            kind => {
                let start = |from: &[u8]| from.iter().rposition(|&b| b == b'\n');
                let first = start(&bytes[..at]).map_or(0, |i| i + 1);
                let length = bytes[first..].iter().position(|&b| b == b'\n');
                let end = length.map_or(bytes.len(), |i| first + i + 1);
                let line: Vec<u8> = bytes.drain(first..end).collect();
                if kind == 14 {
                    for _ in 0..2 {
                        bytes.splice(first..first, line.iter().copied());
                    }
                }
            }
        }
    }
}

/// One line, not too long, that begins with the file's name.
pub(crate) fn check_message(failure: &Failure, name: &str) {
    let message = failure.to_string();
    assert!(message.starts_with(&format!("{name}: ")), "{message}");
    assert!(!message.contains(char::is_control), "{message:?}");
    assert!(message.len() <= LONGEST_MESSAGE, "{message}");
}

/// Reads `rounds` variants of the samples, each of which can be read whole.
pub(crate) fn check(
    name: &str,
    samples: &[Vec<u8>],
    rounds: usize,
    read: impl Fn(&Input) -> Result<Vec<Segment<f64>>, Failure>,
) {
    for sample in samples {
        let segments = read(&Input::from_bytes(name, sample, false).unwrap()).unwrap();
        assert!(!segments.is_empty());
    }
    let mut corruption = Corruption::new();
    let (mut whole, mut refused) = (0, 0);
    for round in 0..rounds {
        let bytes = corruption.of(&samples[round % samples.len()]);
        match read(&Input::from_bytes(name, &bytes, round % 5 == 0).unwrap()) {
            Ok(segments) => {
                whole += 1;
                assert!(segments.len() <= bytes.len());
                for segment in segments {
                    assert!(segment.start.is_finite() && segment.end.is_finite());
                }
            }
            Err(failure) => {
                refused += 1;
                check_message(&failure, name);
            }
        }
    }
    assert!(
        whole > rounds / 20 && refused > rounds / 20,
        "{whole} {refused}"
    );
}
