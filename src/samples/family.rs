//! Named, seeded families of cases.
//!
//! A family, a seed and an index determine a case, with the same bits on any machine,
//! independently of all other cases. [`BLOCK`] consecutive cases share a frustum, because
//! preparing one costs more than clipping by it. In every family at least half of the cases
//! are within 4 ulp of a singular one, where wrong answers are most likely: an end is within
//! 4 ulp per coordinate of a vertex, an edge or a face, or the line passes a vertex or an
//! edge as closely (`oracle::Oracle::is_near` is the exact definition; a line through the
//! middle of a face does not count). A case is one kind of segment (ending near a feature,
//! passing through one, joining two, along a face, ...) with one kind of frustum;
//! [`Family::describe`] gives the property of each family.

use super::scene::Scene;
use super::segments;
use crate::frustum::Frustum;
use crate::math::{Real, Segment};
use std::fmt;
use std::str::FromStr;

/// Number of consecutive cases that share a frustum.
pub const BLOCK: u64 = 64;

macro_rules! families {
    ($($variant:ident $name:literal $describe:literal;)*) => {
        /// A named family of cases.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Family {
            $(#[doc = $describe] $variant,)*
        }

        impl Family {
            /// All families, in the order of tables.
            pub const ALL: &'static [Family] = &[$(Family::$variant,)*];

            /// The family's name, in lower case with hyphens.
            pub const fn name(self) -> &'static str {
                match self { $(Family::$variant => $name,)* }
            }

            /// The special property of the family, in one sentence.
            pub const fn describe(self) -> &'static str {
                match self { $(Family::$variant => $describe,)* }
            }
        }
    };
}

families! {
    Random "random" "Frusta of every kind in any pose, segments near them.";
    Bumps "bumps" "The singular samples and near misses, every coordinate moved by 0 to 4 ulp.";
    Swapped "swapped" "The samples with their ends swapped, every other one moved by an ulp.";
    Permuted "permuted" "The samples under the 48 signed permutations of the coordinates.";
    Collinear "collinear" "The samples, each end moved along the line by exact factors.";
    Rotated "rotated" "The samples rotated by integer quaternions, exactly.";
    Scaled "scaled" "The samples times powers of two from 2^-60 to 2^60, rotated and moved.";
    FreePose "free-pose" "Poses with rounded, skew and scaled axes and any origin.";
    OffAxis "off-axis" "Frusta between two unrelated rectangles.";
    Orthographic "orthographic" "Boxes.";
    Pyramid "pyramid" "Frusta with an end that is a point or an edge, and tetrahedra.";
    Infinite "infinite" "Frusta without a far end, some from a point, some with parallel sides.";
    HalfLattice "half-lattice" "Small integer frusta, ends on half-integer points: most cases are singular.";
    Points "points" "Segments of zero length.";
    NearFarRatio "near-far-ratio" "Near over far from 1e-3 to 1e-30.";
    FlatDepth "flat-depth" "Near and far are adjacent f64 values.";
    NarrowView "narrow-view" "Full fields of view of 1e-3 degrees and 1e-8 radians.";
    WideView "wide-view" "A full field of view of 179.999999 degrees.";
    Aspect "aspect" "Width over height 1e6 and 1e-6.";
    FarFromOrigin "far-from-origin" "Coordinates of 1e15: features of 1e-3, which are not representable there, and of a few ulp (0.125 each).";
    Subnormal "subnormal" "All numbers are small multiples of the least positive f64.";
    ProductsUnderflow "products-underflow" "Coordinates of 1e-160: products underflow.";
    ProductsOverflow "products-overflow" "Coordinates of 1e155: products overflow.";
    Huge "huge" "Coordinates of 1e300: differences may overflow.";
    SingleFar "single-far" "Coordinates of 1e7, 3e10 and 1e15 with features of a few ulp of f32.";
    NearFace "near-face" "Both ends 0, 1 or 2 ulp from one face.";
    NearlyParallel "nearly-parallel" "Along a face, the direction within an ulp of parallel.";
    CrossingNearEnds "crossing-near-ends" "Crossing parameters within 2^-53 of 0 and 1.";
    CrossingEqual "crossing-equal" "Through an edge or a vertex exactly: equal crossing parameters.";
    CrossingClose "crossing-close" "Two crossing parameters that differ by less than 2^-100.";
    Shear "shear" "The far end moved sideways, or the pose's axes sheared, by 1e6 and 1e-6.";
    ApexWidth "apex-width" "A near end of width 0, one ulp, or 5e-324.";
    EarthCentred "earth-centred" "Earth-centred coordinates (6.378e6 m), features from 1e-4 m, rotated poses.";
    Astronomical "astronomical" "Coordinates of 1e18 m, rotated poses.";
    FarEnds "far-ends" "One end 1e3 to 1e12 times farther away than the other.";
    UlpLong "ulp-long" "Segments one ulp long in one or more coordinates.";
    Diagonals "diagonals" "Between opposite vertices, and beyond them.";
    BehindApex "behind-apex" "Passing behind the apex, where the sides' planes open again.";
    MixedScale "mixed-scale" "Exponents from the whole range of f64 in one case.";
    Thin "thin" "Frusta so thin that few or no representable points lie in them.";
}

impl Family {
    /// The scene of a block of cases: its frustum, and its features for aiming.
    pub fn scene(self, seed: u64, block: u64) -> Scene {
        Scene::new(self, seed, block)
    }

    /// The segment of a case, in the scene of the block `index / BLOCK`.
    pub fn segment<T: Real>(self, scene: &Scene, seed: u64, index: u64) -> Segment<T> {
        segments::segment(self, scene, seed, index)
    }

    /// The frustum and the segment of a case.
    pub fn case(self, seed: u64, index: u64) -> (Frustum, Segment<f64>) {
        let scene = self.scene(seed, index / BLOCK);
        let segment = self.segment(&scene, seed, index);
        (scene.frustum().clone(), segment)
    }

    /// The frustum and the segment of a case, the segment in `f32`; `None` if the family
    /// has no cases in `f32`.
    pub fn case_f32(self, seed: u64, index: u64) -> Option<(Frustum, Segment<f32>)> {
        self.has_f32().then(|| {
            let scene = self.scene(seed, index / BLOCK);
            let segment = self.segment(&scene, seed, index);
            (scene.frustum().clone(), segment)
        })
    }

    /// Whether the family has cases in `f32`: their coordinates are in its range, and
    /// singular cases stay singular after rounding.
    pub const fn has_f32(self) -> bool {
        !matches!(
            self,
            Self::Subnormal
                | Self::ProductsUnderflow
                | Self::ProductsOverflow
                | Self::Huge
                | Self::CrossingClose
                | Self::MixedScale
                | Self::FlatDepth
                | Self::FarFromOrigin
        )
    }
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The error for a text that is not the name of a family.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownFamily(String);

impl fmt::Display for UnknownFamily {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = Family::ALL.iter().map(|f| f.name()).collect();
        write!(
            f,
            "there is no family {:?}; the families are {}",
            self.0,
            names.join(", ")
        )
    }
}

impl std::error::Error for UnknownFamily {}

impl FromStr for Family {
    type Err = UnknownFamily;

    fn from_str(name: &str) -> Result<Self, UnknownFamily> {
        let found = Self::ALL.iter().find(|f| f.name() == name);
        found.copied().ok_or_else(|| UnknownFamily(name.to_owned()))
    }
}
