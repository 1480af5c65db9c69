//! A frustum's JSON, as the command reads it: read or refused.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| frusta_fuzz_readers::read_frustum(data));
