//! A register of singles as two of doubles, and numbers looked up for each lane.

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f32x16, f64x4, f64x8, u8x64, u32x8, u32x16};

/// A register of singles.
pub(super) trait Widen<S: Simd>: SimdFloat<S, Element = f32> {
    /// Half of its lanes, in doubles.
    type Half: SimdFloat<S, Element = f64>;

    /// Eight doubles.
    type Table;

    fn table(simd: S, numbers: [f64; 8]) -> Self::Table;

    fn halves(self) -> [Self::Half; 2];

    /// Each rounded to the nearest single.
    fn whole(halves: [Self::Half; 2]) -> Self;

    /// Of each table the number at a place, for each lane: of the first half, then of the
    /// second.
    fn look_up(tables: &[Self::Table; 4], places: Self::Bits) -> [[Self::Half; 4]; 2];
}

/// Eight doubles, whole and as lower and upper words.
pub(super) struct Eight {
    numbers: [f64; 8],
    words: [[u32; 8]; 2],
}

impl<S: Simd> Widen<S> for f32x8<S> {
    type Half = f64x4<S>;
    type Table = Eight;

    fn table(_: S, numbers: [f64; 8]) -> Eight {
        Eight {
            numbers,
            words: [
                numbers.map(|n| n.to_bits() as u32),
                numbers.map(|n| (n.to_bits() >> 32) as u32),
            ],
        }
    }

    #[inline(always)]
    fn halves(self) -> [f64x4<S>; 2] {
        let (first, second) = self.widen();
        [first, second]
    }

    #[inline(always)]
    fn whole([first, second]: [f64x4<S>; 2]) -> Self {
        f64x4::narrow(first, second)
    }

    #[inline(always)]
    fn look_up(tables: &[Eight; 4], places: u32x8<S>) -> [[f64x4<S>; 4]; 2] {
        let simd = places.token();
        let [x, y, z, offset] = tables;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = simd.level().as_avx2() {
            let places = avx2::in_turn(avx2, places.into());
            let x = avx2::look_up(avx2, x.words, places);
            let y = avx2::look_up(avx2, y.words, places);
            let z = avx2::look_up(avx2, z.words, places);
            let offset = avx2::look_up(avx2, offset.words, places);
            return [
                [
                    x[0].simd_into(simd),
                    y[0].simd_into(simd),
                    z[0].simd_into(simd),
                    offset[0].simd_into(simd),
                ],
                [
                    x[1].simd_into(simd),
                    y[1].simd_into(simd),
                    z[1].simd_into(simd),
                    offset[1].simd_into(simd),
                ],
            ];
        }
        let [a, b, c, d, e, f, g, h]: [u32; 8] = places.into();
        let (first, second) = ([a, b, c, d], [e, f, g, h]);
        [
            [
                four(simd, x, first),
                four(simd, y, first),
                four(simd, z, first),
                four(simd, offset, first),
            ],
            [
                four(simd, x, second),
                four(simd, y, second),
                four(simd, z, second),
                four(simd, offset, second),
            ],
        ]
    }
}

/// Four of eight numbers.
#[inline(always)]
fn four<S: Simd>(simd: S, table: &Eight, [a, b, c, d]: [u32; 4]) -> f64x4<S> {
    let at = |place: u32| table.numbers[place as usize & 7];
    [at(a), at(b), at(c), at(d)].simd_into(simd)
}

/// Doubles are looked up by their words.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod avx2 {
    use fearless_simd::prelude::*;
    use fearless_simd::{f64x4, kernel, u32x8};
    #[cfg(target_arch = "x86")]
    use std::arch::x86::*;
    #[cfg(target_arch = "x86_64")]
    use std::arch::x86_64::*;

    kernel!(
        /// Places 0, 1, 4, 5, 2, 3, 6, 7: words that are interleaved then come in order.
        #[inline(always)]
        pub(super) fn in_turn(avx2: Avx2, places: [u32; 8]) -> [u32; 8] {
            let places = u32x8::simd_from(avx2, places).into();
            let places = _mm256_permute4x64_epi64::<0b11_01_10_00>(places);
            u32x8::simd_from(avx2, places).into()
        }
    );

    kernel!(
        /// The numbers with these words at eight places in turn.
        #[inline(always)]
        pub(super) fn look_up(avx2: Avx2, words: [[u32; 8]; 2], places: [u32; 8]) -> [[f64; 4]; 2] {
            let places = u32x8::simd_from(avx2, places).into();
            let [low, high] = words;
            let low: __m256i = u32x8::simd_from(avx2, low).into();
            let high: __m256i = u32x8::simd_from(avx2, high).into();
            let low = _mm256_permutevar8x32_epi32(low, places);
            let high = _mm256_permutevar8x32_epi32(high, places);
            let first = _mm256_castsi256_pd(_mm256_unpacklo_epi32(low, high));
            let second = _mm256_castsi256_pd(_mm256_unpackhi_epi32(low, high));
            [
                f64x4::simd_from(avx2, first).into(),
                f64x4::simd_from(avx2, second).into(),
            ]
        }
    );
}

impl<S: Simd> Widen<S> for f32x16<S> {
    type Half = f64x8<S>;
    type Table = f64x8<S>;

    fn table(simd: S, numbers: [f64; 8]) -> f64x8<S> {
        numbers.simd_into(simd)
    }

    #[inline(always)]
    fn halves(self) -> [f64x8<S>; 2] {
        let (first, second) = self.widen();
        [first, second]
    }

    #[inline(always)]
    fn whole([first, second]: [f64x8<S>; 2]) -> Self {
        f64x8::narrow(first, second)
    }

    #[inline(always)]
    fn look_up(tables: &[f64x8<S>; 4], places: u32x16<S>) -> [[f64x8<S>; 4]; 2] {
        let simd = places.token();
        let [x, y, z, offset] = *tables;
        let bytes: u8x64<S> = (places << 3).bitcast();
        let each = u8x64::simd_from(simd, BYTES);
        let first = bytes.swizzle_dyn(u8x64::simd_from(simd, LOWEST_BYTES[0])) + each;
        let second = bytes.swizzle_dyn(u8x64::simd_from(simd, LOWEST_BYTES[1])) + each;
        [
            [
                x.swizzle_dyn(first),
                y.swizzle_dyn(first),
                z.swizzle_dyn(first),
                offset.swizzle_dyn(first),
            ],
            [
                x.swizzle_dyn(second),
                y.swizzle_dyn(second),
                z.swizzle_dyn(second),
                offset.swizzle_dyn(second),
            ],
        ]
    }
}

/// For each byte of eight doubles the lowest one of the single of its lane: of the first half
/// of a register, and of the second.
const LOWEST_BYTES: [[u8; 64]; 2] = {
    let mut all = [[0; 64]; 2];
    let mut i = 0;
    while i < 64 {
        all[0][i] = 4 * (i as u8 / 8);
        all[1][i] = 32 + all[0][i];
        i += 1;
    }
    all
};

/// The bytes of a double, eight times.
const BYTES: [u8; 64] = {
    let mut all = [0; 64];
    let mut i = 0;
    while i < 64 {
        all[i] = i as u8 % 8;
        i += 1;
    }
    all
};
