//! glTF and GLB, as the command reads them: read or refused.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| frusta_fuzz::readers::read_gltf(data));
