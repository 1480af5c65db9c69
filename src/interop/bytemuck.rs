//! `bytemuck`: points, segments and volumes as plain bytes, so that slices of them are cast from and
//! to those of other types of the same layout, without a copy.
//!
//! The only unsafe code of the crate, behind a feature that is off by default: `bytemuck`'s traits
//! are promises that the compiler cannot check. The layouts that they rest on are checked below.

use crate::cull::{Aabb, Obb, Sphere};
use crate::math::{Segment, Vec3};
use bytemuck::{Pod, Zeroable};

macro_rules! plain {
    ($($name:ident, $count:literal;)*) => {$(
        plain!($name, f32, $count);
        plain!($name, f64, $count);
    )*};
    ($name:ident, $scalar:ident, $count:literal) => {
        // No padding: as large and as aligned as so many scalars.
        const _: () = assert!(size_of::<$name<$scalar>>() == size_of::<[$scalar; $count]>());
        const _: () = assert!(align_of::<$name<$scalar>>() == align_of::<$scalar>());

        // SAFETY: all fields are floats, for which all bits are valid, or types for which this
        // holds; `repr(C)`, without padding.
        unsafe impl Zeroable for $name<$scalar> {}
        // SAFETY: as above; they are `Copy`, and have no interior mutability and no pointers.
        unsafe impl Pod for $name<$scalar> {}
    };
}

plain! {
    Vec3, 3;
    Segment, 6;
    Aabb, 6;
    Obb, 12;
    Sphere, 4;
}
