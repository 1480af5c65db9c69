//! Sets the `simd` configuration: whether the library's code for vector registers is compiled.
//!
//! It is not where the target has no vector registers for certain, and not in unoptimised builds:
//! there each of its small generic functions is a call, which makes it slower than code that takes
//! one segment or volume at a time, and much slower to compile. Answers are the same to the bit.

use std::env;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-check-cfg=cfg(simd)");
    let set = |name| env::var(name).unwrap_or_default();
    let features = set("CARGO_CFG_TARGET_FEATURE");
    let has_registers = features
        .split(',')
        .any(|feature| matches!(feature, "sse2" | "neon" | "simd128"));
    if has_registers && set("OPT_LEVEL") != "0" {
        println!("cargo:rustc-cfg=simd");
    }
}
