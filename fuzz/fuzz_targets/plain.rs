//! The plain tiers: finite numbers out of finite numbers, errors out of others.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| frusta_fuzz::plain(data));
