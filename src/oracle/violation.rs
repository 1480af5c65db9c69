//! Violations of the guarantees by a clipper's answer.

use crate::math::End;
use std::fmt;

/// The kind of a violation. G1 to G6 are the guarantees of the exact clippers, as in
/// the crate's documentation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum ViolationKind {
    /// G1: the class is wrong, or whether there is a part.
    Class,
    /// G1: the entry, exit or coplanar set is wrong, or a flag `clipped`.
    Set,
    /// G2: an end that was not clipped differs from the input's in a bit, or its
    /// parameter is not 0 or 1, or its flag `inward` is false.
    UnclippedEnd,
    /// G2: a near or far hit in the identity pose has another `z` than that face.
    EndDepth,
    /// G3: a point is farther from the exact one than the accuracy allows, or not
    /// finite.
    Point,
    /// G3: a parameter is farther from the exact one than the accuracy allows.
    Parameter,
    /// G4: a point with the flag `inward` is outside the frustum.
    NotInward,
    /// G3: a point is without the flag `inward` although a representable point near it is
    /// inside.
    InwardMissed,
    /// A clipped end has the flag `inward`, with an accuracy that does not promise it.
    InwardFlag,
    /// The entry's parameter is greater than the exit's, or one is not in 0..=1.
    Order,
    /// G5: swapping the ends does not swap the result.
    Swapped,
    /// G6: an inward result does not clip to itself.
    Idempotence,
    /// A valid input gave an error.
    Refused,
}

impl ViolationKind {
    /// All kinds, in order.
    pub const ALL: [ViolationKind; 13] = [
        Self::Class,
        Self::Set,
        Self::UnclippedEnd,
        Self::EndDepth,
        Self::Point,
        Self::Parameter,
        Self::NotInward,
        Self::InwardMissed,
        Self::InwardFlag,
        Self::Order,
        Self::Swapped,
        Self::Idempotence,
        Self::Refused,
    ];

    /// The kind's name in lower case with hyphens.
    pub const fn name(self) -> &'static str {
        [
            "class",
            "set",
            "unclipped-end",
            "end-depth",
            "point",
            "parameter",
            "not-inward",
            "inward-missed",
            "inward-flag",
            "order",
            "swapped",
            "idempotence",
            "refused",
        ][self as usize]
    }
}

impl fmt::Display for ViolationKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One violation of a guarantee by a clipper's answer.
///
/// Its text has hexadecimal numbers, so that no bit of a witness is lost.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// The kind of the violation.
    pub kind: ViolationKind,
    /// The end of the part (`Start` is the entry), if it concerns one end.
    pub end: Option<End>,
    /// The value found and the right one.
    pub detail: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = match self.end {
            Some(End::Start) => " at the entry",
            Some(End::End) => " at the exit",
            None => "",
        };
        write!(f, "{}{end}: {}", self.kind, self.detail)
    }
}
