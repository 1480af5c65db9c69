//! Cameras, matrices, six points, windows: a frustum or an error, never a panic.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| frusta_fuzz::constructors(data));
