//! What is prepared from a frustum to evaluate its boundary: private, and below everything
//! that clips or culls.
//!
//! ```text
//! boundary    the six boundary functions, exactly, over any number type
//! filter      their rounded values, the error bound and the thresholds
//! precise     the same to 106 bits
//! plain       coefficients for plain arithmetic
//! half_space  a face as n . p + d >= 0, known exactly, with signs in stages
//! planes      the faces' half spaces in a batch's scalar type
//! exact_vec   vectors of dyadic integers
//! ```

pub(crate) mod boundary;
pub(crate) mod exact_vec;
pub(crate) mod filter;
pub(crate) mod half_space;
pub(crate) mod plain;
pub(crate) mod planes;
pub(crate) mod precise;
