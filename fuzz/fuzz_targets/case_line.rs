//! A case as a line of text, there and back; and any text.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| frusta_fuzz::case_line(data));
