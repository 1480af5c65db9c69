//! What a clipper's answer can have wrong, and how to say it.

use crate::math::End;
use std::fmt;

/// Which promise an answer breaks. G1 to G6 are the guarantees of the exact
/// clippers, as the crate's documentation numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum ViolationKind {
    /// G1: the class, or whether there is a part at all.
    Class,
    /// G1: the entry, exit or coplanar set, or whether an end was clipped.
    Set,
    /// G2: an end that was not clipped did not come back bit for bit, or its
    /// parameter is not 0 or 1, or it is not called inward.
    UnclippedEnd,
    /// G2: a near or far hit in the identity pose has another `z`.
    EndDepth,
    /// G3: a point further from the exact one than the accuracy allows, or not
    /// finite.
    Point,
    /// G3: a parameter further from the exact one than the accuracy allows.
    Parameter,
    /// G4: a point said to be inward lies outside the frustum.
    NotInward,
    /// G3: a point said not to be inward although another could have been.
    InwardMissed,
    /// A clipped end called inward by an accuracy that does not promise it.
    InwardFlag,
    /// The entry's parameter is greater than the exit's, or one is not in 0..=1.
    Order,
    /// G5: swapping the ends does not swap the result.
    Swapped,
    /// G6: an inward result does not clip to itself.
    Idempotence,
    /// A valid input was refused.
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

/// One thing that is wrong with a clipper's answer.
///
/// Displays with hexadecimal floats, so that nothing of a witness is lost.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Which promise is broken.
    pub kind: ViolationKind,
    /// At which end of the part (`Start` is the entry), if at one.
    pub end: Option<End>,
    /// What was found and what would have been right.
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
