//! A frustum and a segment as one line of text, to the bit.
//!
//! ```text
//! line    = scalar shape [pose] "segment" point point
//! scalar  = "f64" | "f32"                                     of the segment
//! shape   = "near" end "far" end
//!         | "near" end "slopes" rect ("PlusZ" | "MinusZ")
//! end     = z rect
//! rect    = left right bottom top
//! pose    = "origin" point "axes" point point point           left out: identity
//! ```
//!
//! Words are separated by white space. Numbers are written in hexadecimal
//! ([`frusta::math::hex`]), which hides no bit; decimal ones are read as well, rounded
//! once, so that a person may type a line.

use frusta::frustum::{Direction, EndRect, Frustum, Shape};
use frusta::math::hex::{self, Hex, HexError};
use frusta::math::{Pose, Real, Rect, Segment, Vec3};
use std::fmt;
use std::str::FromStr;

/// A case of a clipper: a frustum and a segment, written as a line of text and read
/// back with the same bits.
///
/// ```
/// use frusta_lab::CaseLine;
/// let typed = "f64 near 1 -1 1 -1 1 far 3 -3 3 -3 3 segment 0 0 2 4 0 0x1p+1";
/// let case: CaseLine = typed.parse()?;
/// let line = case.to_string();
/// assert!(line.ends_with("segment 0x0p+0 0x0p+0 0x1p+1 0x1p+2 0x0p+0 0x1p+1"));
/// assert_eq!(line.parse(), Ok(case));
/// # Ok::<(), frusta_lab::CaseLineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CaseLine {
    /// The frustum.
    pub frustum: Frustum,
    /// The segment.
    pub segment: CaseSegment,
}

/// A segment of either scalar type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CaseSegment {
    /// In `f32`.
    Single(Segment<f32>),
    /// In `f64`.
    Double(Segment<f64>),
}

impl CaseLine {
    /// A case.
    pub fn new<T: Real>(frustum: &Frustum, segment: &Segment<T>) -> Self {
        let wide = segment.to_f64();
        let segment = if T::DIGITS == <f32 as Real>::DIGITS {
            let single = |p: Vec3<f64>| Vec3::<f32>::from_f64(p);
            CaseSegment::Single(Segment::new(single(wide.start), single(wide.end)))
        } else {
            CaseSegment::Double(wide)
        };
        Self {
            frustum: frustum.clone(),
            segment,
        }
    }
}

impl fmt::Display for CaseLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scalar = match self.segment {
            CaseSegment::Single(_) => "f32",
            CaseSegment::Double(_) => "f64",
        };
        write!(f, "{scalar} near ")?;
        match *self.frustum.shape() {
            Shape::Finite { near, far } => {
                write_end(f, near)?;
                f.write_str(" far ")?;
                write_end(f, far)?;
            }
            Shape::Infinite {
                near,
                slopes,
                direction,
            } => {
                write_end(f, near)?;
                f.write_str(" slopes")?;
                write_rect(f, slopes)?;
                write!(f, " {direction:?}")?;
            }
        }
        let pose = self.frustum.pose();
        // By its bits: an origin of -0 equals one of 0.
        if bits(pose) != bits(&Pose::IDENTITY) {
            let [a, b, c] = pose.axes.map(Hex);
            write!(f, " origin {} axes {a} {b} {c}", Hex(pose.origin))?;
        }
        match self.segment {
            CaseSegment::Single(segment) => write!(f, " segment {}", Hex(segment)),
            CaseSegment::Double(segment) => write!(f, " segment {}", Hex(segment)),
        }
    }
}

fn bits(pose: &Pose) -> [[u64; 3]; 4] {
    let [a, b, c] = pose.axes;
    [pose.origin, a, b, c].map(|v| v.to_array().map(f64::to_bits))
}

fn write_end(f: &mut fmt::Formatter<'_>, end: EndRect) -> fmt::Result {
    write!(f, "{}", Hex(end.z))?;
    write_rect(f, end.rect)
}

fn write_rect(f: &mut fmt::Formatter<'_>, rect: Rect) -> fmt::Result {
    rect.to_array()
        .into_iter()
        .try_for_each(|side| write!(f, " {}", Hex(side)))
}

/// Why a text is no [`CaseLine`], and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseLineError {
    column: usize,
    reason: String,
}

impl CaseLineError {
    /// Which character of the line is the first that is wrong, counted from 1.
    pub fn column(&self) -> usize {
        self.column
    }

    /// What is wrong there.
    pub fn reason(&self) -> &str {
        &self.reason
    }
}

impl fmt::Display for CaseLineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "column {}: {}", self.column, self.reason)
    }
}

impl std::error::Error for CaseLineError {}

impl FromStr for CaseLine {
    type Err = CaseLineError;

    fn from_str(line: &str) -> Result<Self, CaseLineError> {
        let mut words = Words { line, at: 0 };
        let single = words.one_of("the segment's type", &["f64", "f32"])? == "f32";
        let shape_at = words.column();
        let shape = words.shape()?;
        let (mut pose, mut pose_at) = (Pose::IDENTITY, shape_at);
        let next = words.column();
        if words.one_of("the pose or the segment", &["origin", "segment"])? == "origin" {
            pose_at = next;
            pose = words.pose()?;
            words.keyword("segment")?;
        }
        let segment = if single {
            CaseSegment::Single(words.segment(hex::parse_f32)?)
        } else {
            CaseSegment::Double(words.segment(hex::parse_f64)?)
        };
        words.end()?;
        // A frustum is refused for its shape first.
        let frustum = Frustum::new(pose, shape).map_err(|refusal| CaseLineError {
            column: match shape.validate() {
                Err(_) => shape_at,
                Ok(()) => pose_at,
            },
            reason: refusal.to_string(),
        })?;
        Ok(Self { frustum, segment })
    }
}

/// Reads a hexadecimal number.
type ReadHex<T> = fn(&str) -> Result<T, HexError>;

/// A line's words, one after the other.
struct Words<'a> {
    line: &'a str,
    /// The byte where what has not been read begins.
    at: usize,
}

impl<'a> Words<'a> {
    /// Skips white space.
    fn skip(&mut self) {
        let rest = &self.line[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    /// Where the next word begins, in characters from 1.
    fn column(&mut self) -> usize {
        self.skip();
        1 + self.line[..self.at].chars().count()
    }

    fn fail<T>(&self, at: usize, reason: impl Into<String>) -> Result<T, CaseLineError> {
        Err(CaseLineError {
            column: 1 + self.line[..at].chars().count(),
            reason: reason.into(),
        })
    }

    /// The next word and the byte where it begins.
    fn next(&mut self, expected: &str) -> Result<(usize, &'a str), CaseLineError> {
        self.skip();
        let begin = self.at;
        let rest = &self.line[begin..];
        let word = &rest[..rest.find(char::is_whitespace).unwrap_or(rest.len())];
        if word.is_empty() {
            return self.fail(begin, format!("the line ends; expected {expected}"));
        }
        self.at += word.len();
        Ok((begin, word))
    }

    fn one_of(
        &mut self,
        what: &str,
        known: &[&'static str],
    ) -> Result<&'static str, CaseLineError> {
        let expected = format!("{what}: {}", known.join(" or "));
        let (at, word) = self.next(&expected)?;
        match known.iter().find(|&&k| k == word) {
            Some(found) => Ok(found),
            None => self.fail(at, format!("expected {expected}; found {}", quoted(word))),
        }
    }

    fn keyword(&mut self, word: &'static str) -> Result<(), CaseLineError> {
        self.one_of("the word", &[word]).map(|_| ())
    }

    fn number<T: Real + FromStr>(
        &mut self,
        name: &str,
        read: ReadHex<T>,
    ) -> Result<T, CaseLineError> {
        let (at, word) = self.next(&format!("the number {name}"))?;
        let value = match read(word) {
            Ok(value) => value,
            Err(HexError::Inexact) => {
                let (word, bits) = (quoted(word), 8 * size_of::<T>());
                return self.fail(at, format!("{name}: no f{bits} equals {word} exactly"));
            }
            // No hexadecimal float: a decimal one.
            Err(_) => match word.parse() {
                Ok(value) => value,
                Err(_) => return self.fail(at, format!("{name}: {} is no number", quoted(word))),
            },
        };
        if value.is_finite() {
            Ok(value)
        } else {
            self.fail(at, format!("{name}: {} is not finite", quoted(word)))
        }
    }

    fn double(&mut self, name: &str) -> Result<f64, CaseLineError> {
        self.number(name, hex::parse_f64)
    }

    fn point<T: Real + FromStr>(
        &mut self,
        name: &str,
        read: ReadHex<T>,
    ) -> Result<Vec3<T>, CaseLineError> {
        Ok(Vec3::new(
            self.number(&format!("{name}.x"), read)?,
            self.number(&format!("{name}.y"), read)?,
            self.number(&format!("{name}.z"), read)?,
        ))
    }

    fn rect(&mut self, name: &str) -> Result<Rect, CaseLineError> {
        Ok(Rect {
            left: self.double(&format!("{name}.left"))?,
            right: self.double(&format!("{name}.right"))?,
            bottom: self.double(&format!("{name}.bottom"))?,
            top: self.double(&format!("{name}.top"))?,
        })
    }

    fn end_rect(&mut self, name: &str) -> Result<EndRect, CaseLineError> {
        let z = self.double(&format!("{name}.z"))?;
        let rect = self.rect(name)?;
        Ok(EndRect { z, rect })
    }

    fn shape(&mut self) -> Result<Shape, CaseLineError> {
        self.keyword("near")?;
        let near = self.end_rect("near")?;
        if self.one_of("the other end", &["far", "slopes"])? == "far" {
            let far = self.end_rect("far")?;
            return Ok(Shape::Finite { near, far });
        }
        let slopes = self.rect("slopes")?;
        let direction = match self.one_of("the direction", &["PlusZ", "MinusZ"])? {
            "MinusZ" => Direction::MinusZ,
            _ => Direction::PlusZ,
        };
        Ok(Shape::Infinite {
            near,
            slopes,
            direction,
        })
    }

    /// What follows the word `origin`.
    fn pose(&mut self) -> Result<Pose, CaseLineError> {
        let origin = self.point("origin", hex::parse_f64)?;
        self.keyword("axes")?;
        let mut axes = [Vec3::default(); 3];
        for (i, axis) in axes.iter_mut().enumerate() {
            *axis = self.point(&format!("axes[{i}]"), hex::parse_f64)?;
        }
        Ok(Pose { origin, axes })
    }

    fn segment<T: Real + FromStr>(
        &mut self,
        read: ReadHex<T>,
    ) -> Result<Segment<T>, CaseLineError> {
        let start = self.point("start", read)?;
        let end = self.point("end", read)?;
        Ok(Segment { start, end })
    }

    fn end(&mut self) -> Result<(), CaseLineError> {
        self.skip();
        let rest = &self.line[self.at..];
        if rest.is_empty() {
            return Ok(());
        }
        self.fail(
            self.at,
            format!("nothing may follow; found {}", quoted(rest)),
        )
    }
}

/// A word of the line for a message, short whatever it is.
fn quoted(word: &str) -> String {
    const LONGEST: usize = 30;
    match word.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{:?}...", &word[..end]),
        None => format!("{word:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frusta::samples::Family;
    use proptest::prelude::*;

    const TYPED: &str = "f64 near 1 -1 1 -1 1 far 3 -3 3 -3 3 segment 0 0 2 4 0 2.5";

    fn same_bits(a: &CaseLine, b: &CaseLine) -> bool {
        // The text has every bit of the case.
        a == b && a.to_string() == b.to_string()
    }

    #[test]
    fn cases_of_all_families_come_back() {
        for &family in Family::ALL {
            for index in (0..1024).step_by(61) {
                let (frustum, segment) = family.case(5, index);
                let case = CaseLine::new(&frustum, &segment);
                let back: CaseLine = case.to_string().parse().unwrap();
                assert!(same_bits(&case, &back), "{case}");
                if let Some((frustum, segment)) = family.case_f32(5, index) {
                    let case = CaseLine::new(&frustum, &segment);
                    assert!(matches!(case.segment, CaseSegment::Single(s) if s == segment));
                    let back: CaseLine = case.to_string().parse().unwrap();
                    assert!(same_bits(&case, &back), "{case}");
                }
            }
        }
    }

    #[test]
    fn signs_of_zeros_come_back() {
        let shape = Shape::Finite {
            near: EndRect::new(-0.0, -0.0, 1.0, -1.0, -0.0),
            far: EndRect::new(1.0, -1.0, 0.0, -0.0, 1.0),
        };
        let mut pose = Pose::IDENTITY;
        pose.origin.y = -0.0;
        let frustum = Frustum::new(pose, shape).unwrap();
        let segment = Segment::new([-0.0, 0.0, 0.5], [1.0, -0.0, 0.5]);
        let line = CaseLine::new(&frustum, &segment).to_string();
        let back: CaseLine = line.parse().unwrap();
        assert_eq!(back.to_string(), line);
        assert!(back.frustum.pose().origin.y.is_sign_negative());
        assert!(line.contains("origin 0x0p+0 -0x0p+0"), "{line}");
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let change = |from: &str, to: &str| TYPED.replacen(from, to, 1);
        for (line, column, part) in [
            (String::new(), 1, "the line ends"),
            (change("f64", "f16"), 1, "f64 or f32; found \"f16\""),
            (
                change("near 1", "near"),
                20,
                "near.top: \"far\" is no number",
            ),
            (
                change("near 1", "near 1e999"),
                10,
                "\"1e999\" is not finite",
            ),
            (
                change("near 1", "near nan"),
                10,
                "near.z: \"nan\" is not finite",
            ),
            (change("near 1", "near 0x1p+2000"), 10, "no f64 equals"),
            (change("far 3", "fat 3"), 22, "far or slopes; found \"fat\""),
            (change("far 3", "far 1"), 5, "near"),
            (change("segment", "pose"), 38, "origin or segment"),
            (
                change("segment", "origin 0 0 0 axes 1 0 0 0 1 0 1 1 0 segment"),
                38,
                "depend",
            ),
            (
                change(" 2.5", ""),
                55,
                "the line ends; expected the number end.z",
            ),
            (
                change("2.5", "2.5 7 é"),
                60,
                "nothing may follow; found \"7 é\"",
            ),
            (change("2.5", "é"), 56, "end.z: \"é\" is no number"),
            (
                change("f64", "f32").replace("2.5", "0x1.000001p+0"),
                56,
                "no f32 equals",
            ),
            (
                change("f64", "f32").replace("2.5", "1e39"),
                56,
                "is not finite",
            ),
        ] {
            let error = line.parse::<CaseLine>().unwrap_err();
            assert_eq!(error.column(), column, "{line}: {error}");
            assert!(error.to_string().contains(part), "{line}: {error}");
        }
        let long = format!("f64 near {}", "x".repeat(100_000));
        assert!(long.parse::<CaseLine>().unwrap_err().to_string().len() < 120);
    }

    /// Hexadecimal or decimal text of any double.
    fn number() -> impl Strategy<Value = String> {
        let bits = any::<u64>().prop_map(f64::from_bits);
        (bits, any::<bool>()).prop_map(|(value, decimal)| {
            if decimal {
                format!("{value:e}")
            } else {
                hex::format(value)
            }
        })
    }

    proptest! {
        #[test]
        fn mutated_lines_are_read_or_refused(
            index in 0_u64..2048, family in 0..Family::ALL.len(), at in any::<prop::sample::Index>(),
            word in prop_oneof![number(), "[a-zA-Z0-9 .+-]{0,6}", "\\PC{0,3}", Just("far".to_owned())],
            how in 0..3,
        ) {
            let (frustum, segment) = Family::ALL[family].case(1, index);
            let line = CaseLine::new(&frustum, &segment).to_string();
            let mut words: Vec<String> = line.split(' ').map(str::to_owned).collect();
            let at = at.index(words.len());
            match how {
                0 => words[at] = word,
                1 => words.insert(at, word),
                _ => words.truncate(at),
            }
            let mutated = words.join(" ");
            match mutated.parse::<CaseLine>() {
                Ok(case) => {
                    let again = case.to_string();
                    prop_assert!(same_bits(&case, &again.parse().unwrap()));
                }
                Err(error) => {
                    prop_assert!((1..=mutated.chars().count() + 1).contains(&error.column()));
                }
            }
        }

        #[test]
        fn any_text_is_read_or_refused(text in "\\PC*") {
            prop_assert!(text.parse::<CaseLine>().is_err());
        }
    }
}
