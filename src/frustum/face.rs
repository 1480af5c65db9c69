//! The six faces and sets of them.

use std::fmt;
use std::iter::FusedIterator;
use std::ops::{BitOr, BitOrAssign};

/// A face of a frustum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[repr(u8)]
pub enum Face {
    /// The face at depth zero.
    Near,
    /// The face at the greatest depth; an infinite frustum has none.
    Far,
    /// The side at smaller frame `x`.
    Left,
    /// The side at larger frame `x`.
    Right,
    /// The side at smaller frame `y`.
    Bottom,
    /// The side at larger frame `y`.
    Top,
}

impl Face {
    /// All six faces, in the order in which ties are broken.
    pub const ALL: [Face; 6] = [
        Face::Near,
        Face::Far,
        Face::Left,
        Face::Right,
        Face::Bottom,
        Face::Top,
    ];

    /// The faces of an infinite frustum.
    pub(crate) const WITHOUT_FAR: [Face; 5] =
        [Face::Near, Face::Left, Face::Right, Face::Bottom, Face::Top];

    /// The face's name in lower case.
    pub const fn name(self) -> &'static str {
        ["near", "far", "left", "right", "bottom", "top"][self as usize]
    }
}

impl fmt::Display for Face {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of faces.
///
/// Displays as names joined by `+`, in the order of [`Face::ALL`]; the empty
/// set as an empty text. With `serde` it is a list of names.
///
/// ```
/// use frusta::{Face, FaceSet};
/// let edge: FaceSet = [Face::Top, Face::Left].into_iter().collect();
/// let mut vertex = edge | Face::Near.into();
/// assert_eq!(vertex.to_string(), "near+left+top");
/// assert!(edge.into_iter().eq([Face::Left, Face::Top]));
/// vertex.remove(Face::Near);
/// assert_eq!(vertex, edge);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FaceSet(u8);

impl FaceSet {
    /// The empty set.
    pub const EMPTY: FaceSet = FaceSet(0);

    /// Creates a set from bits, bit `i` for `Face::ALL[i]`; higher bits are ignored.
    #[must_use]
    #[inline(always)]
    pub const fn from_bits(bits: u8) -> Self {
        FaceSet(bits & 0x3f)
    }

    /// The set as bits, bit `i` for `Face::ALL[i]`.
    #[inline(always)]
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// Whether the face is in the set.
    #[inline(always)]
    pub const fn contains(self, face: Face) -> bool {
        self.0 & (1 << face as u8) != 0
    }

    /// Adds a face.
    #[inline(always)]
    pub const fn insert(&mut self, face: Face) {
        self.0 |= 1 << face as u8;
    }

    /// Removes a face.
    #[inline(always)]
    pub const fn remove(&mut self, face: Face) {
        self.0 &= !(1 << face as u8);
    }

    /// The faces in either set.
    #[must_use]
    #[inline(always)]
    pub const fn union(self, other: Self) -> Self {
        FaceSet(self.0 | other.0)
    }

    /// The faces in both sets.
    #[must_use]
    #[inline(always)]
    pub const fn intersection(self, other: Self) -> Self {
        FaceSet(self.0 & other.0)
    }

    /// The faces in this set and not in the other.
    #[must_use]
    #[inline(always)]
    pub const fn difference(self, other: Self) -> Self {
        FaceSet(self.0 & !other.0)
    }

    /// Whether the set is empty.
    #[inline(always)]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Number of faces in the set.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The faces, in the order of [`Face::ALL`].
    #[must_use]
    #[inline]
    pub const fn iter(self) -> FaceSetIter {
        FaceSetIter(self)
    }

    /// The first face of the set in the order of [`Face::ALL`]; `None` if it is empty.
    #[inline(always)]
    pub fn first(self) -> Option<Face> {
        Face::ALL.get(self.0.trailing_zeros() as usize).copied()
    }
}

impl FromIterator<Face> for FaceSet {
    fn from_iter<I: IntoIterator<Item = Face>>(faces: I) -> Self {
        let mut set = FaceSet::EMPTY;
        set.extend(faces);
        set
    }
}

impl Extend<Face> for FaceSet {
    fn extend<I: IntoIterator<Item = Face>>(&mut self, faces: I) {
        for face in faces {
            self.insert(face);
        }
    }
}

impl BitOr for FaceSet {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        self.union(other)
    }
}

impl BitOrAssign for FaceSet {
    #[inline(always)]
    fn bitor_assign(&mut self, other: Self) {
        *self = self.union(other);
    }
}

impl IntoIterator for FaceSet {
    type Item = Face;
    type IntoIter = FaceSetIter;

    #[inline]
    fn into_iter(self) -> FaceSetIter {
        self.iter()
    }
}

impl IntoIterator for &FaceSet {
    type Item = Face;
    type IntoIter = FaceSetIter;

    #[inline]
    fn into_iter(self) -> FaceSetIter {
        self.iter()
    }
}

/// The faces of a set, in the order of [`Face::ALL`].
#[derive(Clone, Debug)]
pub struct FaceSetIter(FaceSet);

impl Iterator for FaceSetIter {
    type Item = Face;

    #[inline]
    fn next(&mut self) -> Option<Face> {
        let face = self.0.first()?;
        self.0.remove(face);
        Some(face)
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.0.len(), Some(self.0.len()))
    }
}

impl ExactSizeIterator for FaceSetIter {}
impl FusedIterator for FaceSetIter {}

impl From<Face> for FaceSet {
    fn from(face: Face) -> Self {
        FaceSet(1 << face as u8)
    }
}

impl fmt::Display for FaceSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, face) in self.iter().enumerate() {
            if i > 0 {
                f.write_str("+")?;
            }
            f.write_str(face.name())?;
        }
        Ok(())
    }
}
