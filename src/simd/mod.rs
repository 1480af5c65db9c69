//! Vector registers: their width, chosen at run time once for a slice, and
//! lists of indices from bits.
//!
//! Without the `simd` configuration (see `build.rs`) there is no such code, and one [`Level`].

pub(crate) mod compaction;

#[cfg(simd)]
pub(crate) use fearless_simd::Level;

/// Stands for a vector width where there is none.
#[cfg(not(simd))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level;

#[cfg(not(simd))]
impl Level {
    pub(crate) fn new() -> Self {
        Self
    }
}

/// Runs code that is generic over the vector width. On x86 there are two widths, those of AVX2 and
/// SSE2, or three with an expression for registers of AVX-512; SSE4.2's instructions are not used.
#[cfg(all(simd, any(target_arch = "x86", target_arch = "x86_64")))]
macro_rules! at_width {
    ($level:expr, $simd:ident => $run:expr, $wide:ident => $run_wide:expr) => {
        if let Some($wide) = $level.as_avx512() {
            $wide.vectorize(
                #[inline(always)]
                || $run_wide,
            )
        } else {
            at_width!($level, $simd => $run)
        }
    };
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
#[cfg(all(simd, not(any(target_arch = "x86", target_arch = "x86_64"))))]
macro_rules! at_width {
    ($level:expr, $simd:ident => $run:expr, $wide:ident => $run_wide:expr) => {
        at_width!($level, $simd => $run)
    };
    ($level:expr, $simd:ident => $run:expr) => {
        fearless_simd::dispatch!($level, $simd => $run)
    };
}

#[cfg(not(simd))]
macro_rules! at_width {
    ($level:expr, $simd:ident => $run:expr) => {{
        let $simd: Level = $level;
        $run
    }};
}

pub(crate) use at_width;

/// Every vector width of this machine that code is compiled for, the widest first.
#[cfg(all(test, simd))]
pub(crate) fn levels() -> Vec<Level> {
    let mut all = vec![Level::new()];
    if cfg!(miri) {
        return all;
    }
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    all.extend(Level::new().as_avx2().map(Level::Avx2));
    all.push(Level::baseline());
    all
}

/// The one level that there is.
#[cfg(all(test, not(simd)))]
pub(crate) fn levels() -> Vec<Level> {
    vec![Level::new()]
}
