//! The vector width, chosen at run time, once for a slice.

/// Runs what is generic over the vector width. On x86 with one of two: more than
/// what AVX2 has there is not used, nor what SSE4.2 adds to SSE2.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
macro_rules! at_width {
    ($level:expr, $simd:ident => $run:expr) => {
        if let Some($simd) = $level.as_avx2() {
            $simd.vectorize(
                #[inline(always)]
                || $run,
            )
        } else {
            let $simd = $level.as_sse2().expect("the crate needs SSE2");
            $run
        }
    };
}
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
macro_rules! at_width {
    ($level:expr, $simd:ident => $run:expr) => {
        fearless_simd::dispatch!($level, $simd => $run)
    };
}

pub(crate) use at_width;
