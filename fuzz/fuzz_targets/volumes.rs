//! Boxes, oriented boxes, balls and batches of them and of segments against the oracle.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| frusta_fuzz::volumes(data));
