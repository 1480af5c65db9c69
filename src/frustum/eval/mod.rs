//! Constants prepared from a frustum for the evaluation of its boundary functions: private, and
//! used by everything that clips or culls.
//!
//! ```text
//! boundary    the six boundary functions, exactly, over any number type
//! filter      their rounded values, the error bound and the thresholds
//! precise     their values to 106 bits
//! plain       coefficients for plain arithmetic
//! face_coefficients  the same to 106 bits, as linear functions in the world
//! half_space  a face as an exact inequality n . p + d >= 0, with signs in stages
//! planes      the faces' half spaces in a batch's scalar type
//! plane_lanes the same in each lane of a register
//! exact_vec   vectors of dyadic integers
//! ```

pub(crate) mod boundary;
pub(crate) mod exact_vec;
mod face_coefficients;
pub(crate) mod filter;
pub(crate) mod half_space;
pub(crate) mod plain;
#[cfg(simd)]
pub(crate) mod plane_lanes;
pub(crate) mod planes;
pub(crate) mod precise;
